//! Diameter gauges: holes 0.05 mm apart. A stick is as thick as the smallest that it goes
//! through.

use crate::frame::Frame;
use crate::shop::laser::{Board, Curve, Lettering, width_of};
use crate::shop::lengths::diameters;

/// From one hole to the next, mm in diameter.
const STEP: f64 = 0.05;
/// Holes to either side of the nominal one: up to 0.3 mm.
const TO_EITHER_SIDE: i32 = 6;
/// Most gauges, of frames with rods of many diameters.
const MOST: usize = 4;
/// Between holes, and round them, mm.
const FREE: f64 = 4.0;
/// Height of numbers, mm.
const LETTERS: f64 = 2.5;
/// Longest gauge, mm: of thick rods the holes stand in several rows.
const LONGEST: f64 = 200.0;

/// A gauge for each diameter of a frame's rods, thin ones first; of rods that taper, for both
/// ends.
pub fn diameter_gauges(frame: &Frame) -> Vec<Board> {
    let mut all: Vec<f64> = diameters(frame).into_iter().flat_map(|(ends, _)| ends).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all.into_iter().take(MOST).map(gauge).collect()
}

fn gauge(diameter: f64) -> Board {
    let hole = |i: i32| diameter + f64::from(i) * STEP;
    let holes: Vec<f64> =
        (-TO_EITHER_SIDE..=TO_EITHER_SIDE).map(hole).filter(|d| *d > STEP).collect();
    let text = |d: f64| format!("{d:.2}");
    let thick = holes[holes.len() - 1];
    let pitch = (thick + FREE).max(width_of(&text(thick), LETTERS) + 2.0);
    let columns = ((LONGEST - FREE) / pitch).floor().clamp(1.0, holes.len() as f64) as usize;
    let rows = holes.len().div_ceil(columns);
    let row_height = thick + LETTERS + 2.0 * FREE;
    let size = [columns as f64 * pitch + FREE, rows as f64 * row_height + FREE / 2.0];
    let mut board = Board::rectangle(format!("diameter gauge of {diameter} mm"), size);
    for (i, &d) in holes.iter().enumerate() {
        let x = FREE / 2.0 + pitch * ((i % columns) as f64 + 0.5);
        let top = size[1] - row_height * (i / columns) as f64;
        let center = [x, top - FREE - thick / 2.0];
        board.holes.push(Curve::Circle { center, radius: d / 2.0 });
        let line = [x, top - FREE - thick - FREE / 2.0 - LETTERS / 2.0];
        board.score(Lettering::new(LETTERS).centred(line, &text(d)));
    }
    board
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_five_hundredths_apart_and_keep_clear_of_each_other() {
        for diameter in [1.0, 3.0, 12.0, 60.0] {
            let board = gauge(diameter);
            let holes: Vec<_> = board
                .holes
                .iter()
                .map(|h| match h {
                    Curve::Circle { center, radius } => (*center, *radius),
                    Curve::Path(_) => panic!("round holes"),
                })
                .collect();
            assert_eq!(holes.len(), 13);
            assert!((holes[6].1 * 2.0 - diameter).abs() < 1e-12);
            let [_, [w, h]] = board.bounds();
            for (i, ([x, y], r)) in holes.iter().enumerate() {
                assert!(x - r > 1.0 && y - r > 1.0 && x + r < w - 1.0 && y + r < h - 1.0);
                for ([u, v], s) in &holes[..i] {
                    assert!((x - u).hypot(y - v) - r - s > 2.0);
                }
                if i > 0 {
                    assert!((2.0 * (r - holes[i - 1].1) - STEP).abs() < 1e-12);
                }
            }
        }
    }
}
