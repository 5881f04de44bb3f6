//! The base plate: how it is divided into pieces that fit a sheet, and their outlines.
//!
//! Pieces of one size lie in columns and rows. Along a seam they hold each other by dovetails:
//! those of a piece reach into the next column and the next row.

use super::stand::detail;
use crate::frame::Frame;
use crate::frame::axis::Axis;
use crate::shop::laser::{GAP, Point, room};
use thiserror::Error;

/// Plate beyond the frame, mm.
const RIM: f64 = 10.0;
/// Most pieces of a plate: one that has more is no work for a laser.
const MOST_PIECES: usize = 16;
/// Depth of a dovetail, in details of the board.
const DEEP: f64 = 3.0;
/// Half the width of a dovetail at its neck and at its head, in depths.
const NECK: f64 = 0.45;
const HEAD: f64 = 0.75;
/// From one dovetail to the next at least, in depths.
const PITCH: f64 = 9.0;
/// Between a seam or a dovetail and a slot, mm.
const BESIDE: f64 = 3.0;

/// Why a plate cannot be cut.
#[derive(Error, Clone, Copy, PartialEq, Debug)]
pub enum PlateError {
    /// It would be of too many pieces.
    #[error(
        "the base plate of the falsework would be {:.0} × {:.0} mm, more than {MOST_PIECES} \
         pieces of {:.0} × {:.0} mm sheet", size[0], size[1], sheet[0], sheet[1]
    )]
    TooLarge {
        /// Its width and depth, mm.
        size: [f64; 2],
        /// The sheet, mm.
        sheet: [f64; 2],
    },
}

/// How the plate is divided. mm, seen from above, y up.
#[derive(Clone, PartialEq, Debug)]
pub struct Seams {
    /// Where columns begin, and where the last one ends.
    pub x: Vec<f64>,
    /// The same of rows.
    pub y: Vec<f64>,
    /// Depth of the dovetails.
    pub deep: f64,
    /// Thickness of the board.
    thickness: f64,
}

/// A piece of the plate: its column and row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Piece {
    /// Counted from the left.
    pub column: usize,
    /// Counted from the front.
    pub row: usize,
}

impl Seams {
    /// Divides the plate below a frame into as few pieces as fit the sheet.
    ///
    /// # Errors
    /// [`PlateError::TooLarge`].
    pub fn of(frame: &Frame, sheet: [f64; 2], thickness: f64) -> Result<Self, PlateError> {
        let [lo, hi] = frame.bounds();
        let rim = RIM + frame.thickest() / 2.0;
        let (low, high) = ([lo.x - rim, lo.y - rim], [hi.x + rim, hi.y + rim]);
        let size = [high[0] - low[0], high[1] - low[1]];
        let deep = DEEP * detail(thickness);
        let fits = |columns: usize, rows: usize| {
            let side =
                |length: f64, n: usize| length / n as f64 + if n > 1 { deep } else { 0.0 } + GAP;
            let (piece, room) = ([side(size[0], columns), side(size[1], rows)], room(sheet));
            let lies = |[w, h]: [f64; 2]| w <= room[0] && h <= room[1];
            lies(piece) || lies([piece[1], piece[0]])
        };
        let all = (1..=MOST_PIECES).flat_map(|c| (1..=MOST_PIECES / c).map(move |r| (c, r)));
        let best = all.filter(|&(c, r)| fits(c, r)).min_by_key(|&(c, r)| (c * r, c.abs_diff(r)));
        let (columns, rows) = best.ok_or(PlateError::TooLarge { size, sheet })?;
        let lines = |from: f64, length: f64, n: usize| {
            (0..=n).map(|i| from + length * i as f64 / n as f64).collect()
        };
        Ok(Self {
            x: lines(low[0], size[0], columns),
            y: lines(low[1], size[1], rows),
            deep,
            thickness,
        })
    }

    /// The pieces, row by row.
    pub fn pieces(&self) -> Vec<Piece> {
        let rows = 0..self.y.len() - 1;
        rows.flat_map(|row| (0..self.x.len() - 1).map(move |column| Piece { column, row }))
            .collect()
    }

    /// Whether the feet of a stand keep clear of all seams.
    pub fn clear(&self, feet: &[Axis]) -> bool {
        let beside = BESIDE + self.thickness / 2.0;
        let apart = |lines: &[f64], [p, q]: [f64; 2]| {
            // The first and the last are the rim, which feet never reach.
            lines[1..lines.len() - 1]
                .iter()
                .all(|&at| p.max(q) < at - beside || p.min(q) > at + self.deep + beside)
        };
        feet.iter().all(|f| apart(&self.x, [f.a.x, f.b.x]) && apart(&self.y, [f.a.y, f.b.y]))
    }

    /// Lower left and upper right corner of the piece below a point, but for its dovetails.
    pub fn around(&self, at: Point) -> [Point; 2] {
        let within = |lines: &[f64], at: f64| {
            let last = lines.len() - 2;
            let i = lines.partition_point(|&line| line <= at).saturating_sub(1).min(last);
            [lines[i], lines[i + 1]]
        };
        let ([x0, x1], [y0, y1]) = (within(&self.x, at[0]), within(&self.y, at[1]));
        [[x0, y0], [x1, y1]]
    }

    /// The bands about the seams that dovetails reach into: lower left and upper right corners.
    pub fn bands(&self) -> Vec<[Point; 2]> {
        let inner = |lines: &[f64]| lines[1..lines.len() - 1].to_vec();
        let ([x0, x1], [y0, y1]) = (ends(&self.x), ends(&self.y));
        let upright = inner(&self.x).into_iter().map(|x| [[x, y0], [x + self.deep, y1]]);
        let level = inner(&self.y).into_iter().map(|y| [[x0, y], [x1, y + self.deep]]);
        upright.chain(level).collect()
    }

    /// The outline of a piece, counter-clockwise.
    pub fn outline(&self, Piece { column, row }: Piece) -> Vec<Point> {
        let ([x0, x1], [y0, y1]) =
            ([self.x[column], self.x[column + 1]], [self.y[row], self.y[row + 1]]);
        let joined = |line: usize, lines: &[f64]| 0 < line && line + 1 < lines.len();
        let level = |line: usize| {
            let y = self.y[line];
            let edge = self.edge([x0, x1], joined(line, &self.y));
            edge.into_iter().map(|[u, v]| [u, y + v]).collect::<Vec<Point>>()
        };
        let upright = |line: usize| {
            let x = self.x[line];
            let edge = self.edge([y0, y1], joined(line, &self.x));
            edge.into_iter().map(|[u, v]| [x + v, u]).collect::<Vec<Point>>()
        };
        let (bottom, mut top) = (level(row), level(row + 1));
        let (mut left, right) = (upright(column), upright(column + 1));
        top.reverse();
        left.reverse();
        // Each edge ends where the next one begins.
        let without_end = |mut edge: Vec<Point>| {
            edge.pop();
            edge
        };
        [bottom, right, top, left].into_iter().flat_map(without_end).collect()
    }

    /// An edge along u from one place to another, with dovetails towards v if it is a seam.
    fn edge(&self, [from, to]: [f64; 2], seam: bool) -> Vec<Point> {
        let mut edge = vec![[from, 0.0]];
        if seam {
            let deep = self.deep;
            let count = ((to - from) / (PITCH * deep)).floor().max(1.0);
            for i in 0..count as usize {
                let middle = from + (to - from) * (i as f64 + 0.5) / count;
                let (neck, head) = (NECK * deep, HEAD * deep);
                edge.extend([[middle - neck, 0.0], [middle - head, deep]]);
                edge.extend([[middle + head, deep], [middle + neck, 0.0]]);
            }
        }
        edge.push([to, 0.0]);
        edge
    }
}

/// The first and the last of some lines.
fn ends(lines: &[f64]) -> [f64; 2] {
    [lines[0], lines[lines.len() - 1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use crate::shop::laser::area;

    #[test]
    fn pieces_fill_the_plate_and_fit_the_sheet() {
        let frame = fixture::circuit(5, 3.0);
        for sheet in [[2000.0, 1500.0], [600.0, 400.0], [400.0, 300.0]] {
            let seams = Seams::of(&frame, sheet, 3.0).unwrap();
            let ([x0, x1], [y0, y1]) = (ends(&seams.x), ends(&seams.y));
            let pieces: Vec<_> = seams.pieces().into_iter().map(|p| seams.outline(p)).collect();
            let all: f64 = pieces.iter().map(|p| area(p)).sum();
            assert!((all - (x1 - x0) * (y1 - y0)).abs() < 1e-6, "{sheet:?}");
            let [w, h] = room(sheet);
            for piece in &pieces {
                let span = |i: usize| {
                    let of = piece.iter().map(|p| p[i]);
                    of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
                };
                let (a, b) = (span(0), span(1));
                assert!((a <= w && b <= h) || (b <= w && a <= h), "{sheet:?}: {a} × {b}");
            }
        }
        assert!(Seams::of(&frame, [130.0, 60.0], 3.0).is_err());
    }
}
