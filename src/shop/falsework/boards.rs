//! The boards of a stand, ready to be cut.

use super::stand::{Shape, Stand};
use crate::shop::laser::{Board, Lettering, Point, height_of, rectangle, width_of};

/// Height of the numbers on stands, mm, where there is room.
const LETTERS: f64 = 3.0;
/// Least height of numbers, mm: smaller ones burn shut.
const LEAST_LETTERS: f64 = 1.5;

/// The prop: foot with tabs and the slot for the brace, head with the saddle.
pub fn prop(stand: &Stand, shape: &Shape, thickness: f64) -> Board {
    let half = thickness / 2.0;
    let (foot, head) = (shape.half_foot, shape.half_head);
    let mut ring = tabbed_foot(shape, thickness, shape.lap().map(|lap| [half, lap]));
    let top = shape.saddle[0][1];
    ring.push([foot, 0.0]);
    ring.push([head, top]);
    ring.extend(shape.saddle.iter().rev());
    ring.push([-head, top]);
    let mut board = Board::new(format!("prop {}", stand.id), ring);
    let low = shape.lap().unwrap_or(0.0) + 1.0;
    let middle = (low + shape.seat - 1.0) / 2.0;
    let lines = [stand.id.to_string(), stand.rod.to_string()];
    let wide = 2.0 * shape.half_width(middle) - 2.0;
    board.score(label(&lines, [0.0, middle], [wide, shape.seat - 1.0 - low]));
    board
}

/// The brace, if the stand has one.
pub fn brace(stand: &Stand, shape: &Shape, thickness: f64) -> Option<Board> {
    let (top, lap) = (shape.brace?, shape.lap()?);
    let (half, head) = (thickness / 2.0, Shape::half_brace_head(thickness));
    // The two slots together are deeper than the brace is high.
    let floor = top - lap;
    let mut ring = tabbed_foot(shape, thickness, None);
    ring.push([shape.half_foot, 0.0]);
    ring.extend([[head, top], [half, top], [half, floor]]);
    ring.extend([[-half, floor], [-half, top], [-head, top]]);
    let mut board = Board::new(format!("brace of prop {}", stand.id), ring);
    let room = [2.0 * shape.tab[0], floor - 2.0];
    board.score(label(&[stand.id.to_string()], [0.0, floor / 2.0], room));
    Some(board)
}

/// The holes in the plate for the tabs of a stand: rings seen from above.
pub fn slots(stand: &Stand, shape: &Shape, thickness: f64) -> Vec<Vec<Point>> {
    let [from, to] = shape.tab;
    let ways = stand.ways();
    let boards = if shape.brace.is_some() { &ways[..] } else { &ways[..1] };
    let mut slots = Vec::new();
    for &[ux, uy] in boards {
        let place =
            |[x, y]: Point| [stand.foot[0] + x * ux - y * uy, stand.foot[1] + x * uy + y * ux];
        for start in [-to, from] {
            let ring = rectangle([start, -thickness / 2.0], [to - from, thickness]);
            slots.push(ring.into_iter().map(place).collect());
        }
    }
    slots
}

/// The lower edge from left to right, with two tabs that go through the plate, and a slot of
/// this half width and depth in the middle.
fn tabbed_foot(shape: &Shape, thickness: f64, slot: Option<[f64; 2]>) -> Vec<Point> {
    let [from, to] = shape.tab;
    let mut ring = vec![[-shape.half_foot, 0.0]];
    ring.extend([[-to, 0.0], [-to, -thickness], [-from, -thickness], [-from, 0.0]]);
    if let Some([half, depth]) = slot {
        ring.extend([[-half, 0.0], [-half, depth], [half, depth], [half, 0.0]]);
    }
    ring.extend([[from, 0.0], [from, -thickness], [to, -thickness], [to, 0.0]]);
    ring
}

/// Lines of text about a point, as large as there is room, and none where they would not be
/// read.
fn label(lines: &[String], middle: Point, [wide, high]: [f64; 2]) -> Vec<Vec<Point>> {
    let by_height = high / height_of(lines, 1.0);
    let by_width = lines.iter().map(|l| wide / width_of(l, 1.0)).fold(LETTERS, f64::min);
    let height = by_width.min(by_height);
    if height < LEAST_LETTERS {
        return Vec::new();
    }
    Lettering::new(height).block(middle, lines)
}
