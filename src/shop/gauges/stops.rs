//! Stop blocks: strips as long as the rods that are sawn most, to set the stop of the saw by.

use crate::frame::measure::SAME_LENGTH;
use crate::shop::CutPlan;
use crate::shop::laser::{Board, Lettering};

/// Most blocks: those of the lengths that are sawn most.
const MOST: usize = 12;
/// A block is for so many pieces at least: a single one is measured.
const LEAST: usize = 2;
/// Width of a block, mm.
const WIDTH: f64 = 15.0;
/// Height of numbers, mm.
const LETTERS: f64 = 3.0;

/// The stop blocks of a sawing plan, long ones first.
pub fn stop_blocks(plan: &CutPlan) -> Vec<Board> {
    let mut lengths: Vec<f64> =
        plan.bars.iter().flat_map(|bar| &bar.pieces).map(|piece| piece.length).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    let same = lengths.chunk_by(|a, b| a - b <= SAME_LENGTH).map(|s| (s[0], s.len()));
    let mut blocks: Vec<(f64, usize)> = same.filter(|(_, count)| *count >= LEAST).collect();
    // A stable sort: of lengths sawn as often the longest stay first.
    blocks.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    blocks.truncate(MOST);
    blocks.sort_by(|a, b| b.0.total_cmp(&a.0));
    blocks.into_iter().map(|(length, count)| block(length, count)).collect()
}

fn block(length: f64, count: usize) -> Board {
    let mut board = Board::rectangle(format!("stop block of {length} mm"), [length, WIDTH]);
    let text = format!("{length:.1}  {count}x");
    board.score(Lettering::new(LETTERS).centred([length / 2.0, WIDTH / 2.0], &text));
    board
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::lengths::sticks;
    use crate::shop::saw::{Offer, Stock, plan_some};
    use crate::shop::{classes, fixture};

    #[test]
    fn blocks_are_as_long_as_the_rods_that_are_sawn_most() {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let sticks = sticks(&frame);
        let stock = Stock { bars: vec![Offer::plain(1000.0)], kerf: 1.0, trim: 0.0, keep: None };
        let plan = plan_some(&sticks, sticks.ids(), &stock).unwrap();
        let blocks = stop_blocks(&plan);
        let classes = classes(&frame);
        let mut counts: Vec<usize> = classes.iter().map(|c| c.rods.len()).collect();
        counts.sort_unstable_by(|a, b| b.cmp(a));
        let many = counts.iter().filter(|n| **n >= LEAST).count();
        assert!(many > 0 && blocks.len() == many.min(MOST));
        for block in &blocks {
            let [length, _] = block.size();
            let class = classes.iter().find(|c| (c.length - length).abs() < 1e-9).unwrap();
            assert!(class.rods.len() >= counts[blocks.len() - 1]);
        }
    }
}
