//! The kerf coupon: slots of which one shows how wide the laser cuts.
//!
//! A slot is drawn narrower than the board is thick, by the figure below it, and comes out wider
//! by the cut. Where a scrap of the same board holds tight, the two are equal.

use crate::shop::laser::{Board, Lettering};

/// From one slot to the next, mm.
const STEP: f64 = 0.05;
/// How many: up to 0.4 mm.
const SLOTS: usize = 9;
/// Depth of a slot, mm.
const DEEP: f64 = 14.0;
/// Board below the slots, mm: room for the figures.
const BELOW: f64 = 8.0;
/// Between slots, mm.
const BETWEEN: f64 = 7.0;
/// Height of figures, mm.
const LETTERS: f64 = 2.5;

/// The coupon for board so thick: cut as it is drawn.
pub fn coupon(thickness: f64) -> Board {
    let pitch = thickness + BETWEEN;
    let (width, height) = (SLOTS as f64 * pitch + BETWEEN, BELOW + DEEP);
    let mut ring = vec![[0.0, 0.0], [width, 0.0], [width, height]];
    let middle = |i: usize| BETWEEN / 2.0 + pitch * (i as f64 + 0.5);
    for i in (0..SLOTS).rev() {
        let half = (thickness - STEP * i as f64) / 2.0;
        let (left, right) = (middle(i) - half, middle(i) + half);
        ring.extend([[right, height], [right, BELOW], [left, BELOW], [left, height]]);
    }
    ring.push([0.0, height]);
    let mut board = Board::new("kerf coupon", ring);
    board.exact = true;
    for i in 0..SLOTS {
        let text = format!("{:.2}", STEP * i as f64);
        let line = [middle(i), BELOW / 2.0];
        board.score(Lettering::new(LETTERS).centred(line, text.trim_start_matches('0')));
    }
    board
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::laser::area;

    #[test]
    fn slots_are_narrower_by_their_figure_and_not_compensated() {
        let board = coupon(3.0);
        let cut = board.compensated(0.2).unwrap();
        let drawn: f64 = (0..SLOTS).map(|i| 3.0 - 0.05 * i as f64).sum();
        let [width, height] = board.size();
        assert!((area(&cut.outline) - (width * height - drawn * DEEP)).abs() < 1e-9);
        assert!(area(&cut.outline) > 0.0);
    }
}
