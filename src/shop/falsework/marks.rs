//! What is scored on the plate: where rods stand and which way they go, and the numbers of
//! stands, units and feet, each where there is room.

use super::boards::slots;
use super::plate::{Piece, Seams};
use super::stand::{Shape, Stand};
use crate::frame::Frame;
use crate::shop::feet::{self, Foot};
use crate::shop::laser::{Board, Curve, Lettering, Point, bounds, height_of, holds, width_of};

/// Height of numbers, mm.
const LETTERS: f64 = 3.0;
/// Height of the letters that name a piece, mm.
const PIECE_LETTERS: f64 = 5.0;
/// Length of the lines that show which way a rod goes, mm.
const TICK: f64 = 6.0;
/// Between a stand or a foot and its line, and round numbers, mm.
const FREE: f64 = 1.5;
/// How far a number may lie from what it numbers, mm.
const FARTHEST: f64 = 45.0;
/// Straight pieces of a circle that is divided over pieces of the plate, and the longest
/// pieces of lines, mm.
const CIRCLE: usize = 32;
const BIT: f64 = 0.5;

/// The pieces of the plate with their slots and what is scored on them.
pub fn plate(
    frame: &Frame,
    seams: &Seams,
    stands: &[(Stand, Shape)],
    thickness: f64,
) -> Vec<Board> {
    let mut boards = plain(seams);
    // A piece that is alone needs no name.
    let named = if boards.len() > 1 { boards.len() } else { 0 };
    let mut taken: Vec<[Point; 2]> = Vec::new();
    for (stand, shape) in stands {
        for slot in slots(stand, shape, thickness) {
            taken.push(bounds(&slot));
            if let Some(at) = boards.iter().position(|b| holds(&b.outline, slot[0])) {
                boards[at].holes.push(Curve::Path(slot));
            }
        }
    }
    let feet = feet::feet(frame);
    let stood = stands.iter().flat_map(|(stand, shape)| stand_ticks(stand, shape, thickness));
    let mut lines: Vec<Vec<Point>> = stood.chain(feet.iter().flat_map(foot_lines)).collect();
    // A line that the slots of another stand would cut says nothing.
    lines.retain(|line| !taken.iter().any(|slot| overlap(&bounds(line), slot)));
    taken.extend(lines.iter().map(|line| bounds(line)));
    taken.extend(seams.bands());
    for piece in &seams.pieces()[..named] {
        let corner = [seams.x[piece.column], seams.y[piece.row]];
        let name = Number { at: corner, lines: &[piece_name(piece)], height: PIECE_LETTERS };
        lines.extend(name.placed(seams, &mut taken));
    }
    for (stand, _) in stands {
        let unit = stand.unit.map(|u| u.to_string());
        let text: Vec<String> = [stand.id.to_string()].into_iter().chain(unit).collect();
        let number = Number { at: stand.foot, lines: &text, height: LETTERS };
        lines.extend(number.placed(seams, &mut taken));
    }
    for foot in &feet {
        let (at, text) = ([foot.x, foot.y], [foot.rod.to_string()]);
        let number = Number { at, lines: &text, height: LETTERS };
        lines.extend(number.placed(seams, &mut taken));
    }
    for line in lines {
        share_out(&line, seams, &mut boards);
    }
    boards
}

/// The pieces as they are cut, without anything on them.
fn plain(seams: &Seams) -> Vec<Board> {
    let pieces = seams.pieces();
    let name = |p: &Piece| match pieces.len() {
        1 => "base plate".to_owned(),
        _ => format!("base plate, piece {}", piece_name(p)),
    };
    pieces.iter().map(|p| Board::new(name(p), seams.outline(*p))).collect()
}

/// The circle of a foot, and a line the way its rod goes.
fn foot_lines(foot: &Foot) -> [Vec<Point>; 2] {
    let (sin, cos) = foot.azimuth.sin_cos();
    let r = foot.diameter / 2.0;
    let along = |d: f64| [foot.x + d * cos, foot.y + d * sin];
    [circle([foot.x, foot.y], r), vec![along(r + FREE), along(r + FREE + TICK)]]
}

/// `A1` is the piece in front on the left, `B1` that to its right.
fn piece_name(piece: &Piece) -> String {
    format!("{}{}", crate::shop::letters(piece.column, 'A'), piece.row + 1)
}

/// Two short lines along the rod, beyond its stand.
fn stand_ticks(stand: &Stand, shape: &Shape, thickness: f64) -> Vec<Vec<Point>> {
    let [_, [ux, uy]] = stand.ways();
    let half = if shape.brace.is_some() { shape.half_foot } else { thickness / 2.0 };
    let along = |d: f64| [stand.foot[0] + d * ux, stand.foot[1] + d * uy];
    let (from, to) = (half + FREE, half + FREE + TICK);
    vec![vec![along(-from), along(-to)], vec![along(from), along(to)]]
}

/// What is written about a point of the plate.
struct Number<'a> {
    at: Point,
    lines: &'a [String],
    height: f64,
}

impl Number<'_> {
    /// Its strokes on the first free place about the point, going outward, on the same piece;
    /// none where there is no place.
    fn placed(&self, seams: &Seams, taken: &mut Vec<[Point; 2]>) -> Vec<Vec<Point>> {
        let [low, high] = seams.around(self.at);
        let wide = self.lines.iter().map(|t| width_of(t, self.height)).fold(0.0, f64::max);
        let tall = height_of(self.lines, self.height);
        let half = [wide / 2.0 + FREE, tall / 2.0 + FREE];
        let far = (0..).map(|i| 3.0 + 1.5 * f64::from(i)).take_while(|far| *far < FARTHEST);
        for (far, turn) in far.flat_map(|far| (0..16).map(move |turn| (far, turn))) {
            let (sin, cos) = (f64::from(turn) * std::f64::consts::TAU / 16.0).sin_cos();
            let middle = [self.at[0] + far * cos, self.at[1] + far * sin];
            let place = [[0, 1].map(|i| middle[i] - half[i]), [0, 1].map(|i| middle[i] + half[i])];
            let inside = (0..2).all(|i| low[i] < place[0][i] && place[1][i] < high[i]);
            if inside && !taken.iter().any(|other| overlap(&place, other)) {
                taken.push(place);
                return Lettering::new(self.height).block(middle, self.lines);
            }
        }
        Vec::new()
    }
}

/// Scores a line on the piece that it lies on, or its parts on theirs.
fn share_out(line: &[Point], seams: &Seams, boards: &mut [Board]) {
    let near = bounds(line);
    if boards.len() == 1 {
        boards[0].score([line.to_vec()]);
        return;
    }
    let on = |p: Point, boards: &[Board]| boards.iter().position(|b| holds(&b.outline, p));
    if !seams.bands().iter().any(|band| overlap(&near, band)) {
        if let Some(at) = on(line[0], boards) {
            boards[at].score([line.to_vec()]);
        }
        return;
    }
    let mut run: Option<(usize, Vec<Point>)> = None;
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let bits = ((b[0] - a[0]).hypot(b[1] - a[1]) / BIT).ceil().max(1.0) as usize;
        let at = |i: f64| [0, 1].map(|k| a[k] + (b[k] - a[k]) * i / bits as f64);
        for i in 0..bits {
            // Whole bits only: the end of one may lie beyond the cut.
            let ends = [i, i + 1].map(|k| on(at(k as f64), boards));
            let Some(here) = ends[0].filter(|_| ends[0] == ends[1]) else { continue };
            match &mut run {
                Some((board, points)) if *board == here => points.push(at(i as f64 + 1.0)),
                _ => {
                    let next = (here, vec![at(i as f64), at(i as f64 + 1.0)]);
                    if let Some((board, points)) = run.replace(next) {
                        boards[board].score([points]);
                    }
                }
            }
        }
    }
    if let Some((board, points)) = run {
        boards[board].score([points]);
    }
}

/// A circle as a line that ends where it begins.
fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    let point = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * (i % CIRCLE) as f64 / CIRCLE as f64).sin_cos();
        [x + radius * cos, y + radius * sin]
    };
    (0..=CIRCLE).map(point).collect()
}

fn overlap([a, b]: &[Point; 2], [c, d]: &[Point; 2]) -> bool {
    (0..2).all(|i| a[i] <= d[i] && c[i] <= b[i])
}
