//! Linear equations in the moves of rod ends: the contacts, and the bounds that hold.

use crate::frame::axis::Axis;
use crate::frame::gaps::Row;
use crate::ids::{IdVec, RodId};
use nalgebra::Vector6;

/// How the two ends of a rod move, or a gradient with respect to them: A first, then B.
pub type Move = Vector6<f64>;

/// The same for all rods.
pub type Moves = IdVec<RodId, Move>;

/// Rows of J dx = r, each with the few rods that it looks at.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Where the parts of each row begin, and the end.
    starts: Vec<u32>,
    parts: Vec<(RodId, Move)>,
    /// r: what is wanted less what is, mm.
    pub lacking: Vec<f64>,
}

impl Equations {
    /// Those of contacts.
    pub fn of_contacts(rows: &[Row]) -> Self {
        let mut all = Self {
            starts: Vec::with_capacity(rows.len() + 1),
            parts: Vec::with_capacity(2 * rows.len()),
            lacking: Vec::with_capacity(rows.len()),
        };
        all.starts.push(0);
        for row in rows {
            let part = |(rod, over): (RodId, bool)| {
                let at = row.at_rod(over);
                (rod, pair(at.normal * at.at_a, at.normal * at.at_b))
            };
            let [over, under] = row.rods;
            all.push([(over, true), (under, false)].map(part), row.wanted - row.gap);
        }
        all
    }

    /// Adds a row; no rod twice.
    pub fn push(&mut self, parts: impl IntoIterator<Item = (RodId, Move)>, lacking: f64) {
        self.parts.extend(parts);
        self.starts.push(self.parts.len() as u32);
        self.lacking.push(lacking);
    }

    /// Makes a row ask for nothing; it keeps its rods.
    pub fn silence(&mut self, row: usize) {
        let range = self.range(row);
        self.parts[range].iter_mut().for_each(|(_, part)| *part = Move::zeros());
        self.lacking[row] = 0.0;
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.lacking.len()
    }

    /// Where the parts of a row stand among [`parts`](Self::parts).
    pub fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// The gradients of all rows, in their order, each with its rod.
    pub fn parts(&self) -> &[(RodId, Move)] {
        &self.parts
    }

    /// J dx: by how much each row changes, mm.
    pub fn changes(&self, moves: &Moves) -> Vec<f64> {
        (0..self.len())
            .map(|row| {
                let parts = &self.parts[self.range(row)];
                parts.iter().map(|(rod, part)| part.dot(&moves[*rod])).sum()
            })
            .collect()
    }

    /// Adds Jᵀ `pull` times `factor` to the moves.
    pub fn pull(&self, pull: &[f64], factor: f64, moves: &mut Moves) {
        for (row, pull) in pull.iter().enumerate() {
            for (rod, part) in &self.parts[self.range(row)] {
                moves[*rod] += part * (pull * factor);
            }
        }
    }
}

/// The moves of both ends as one.
pub fn pair(a: nalgebra::Vector3<f64>, b: nalgebra::Vector3<f64>) -> Move {
    Move::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// Moves all ends by a part of `moves`.
pub fn moved(axes: &IdVec<RodId, Axis>, moves: &Moves, part: f64) -> IdVec<RodId, Axis> {
    axes.iter()
        .zip(moves.iter())
        .map(|(axis, m)| Axis {
            a: axis.a + m.fixed_rows::<3>(0) * part,
            b: axis.b + m.fixed_rows::<3>(3) * part,
        })
        .collect()
}

/// How far the two ends move, mm.
fn lengths(m: &Move) -> [f64; 2] {
    [m.fixed_rows::<3>(0).norm(), m.fixed_rows::<3>(3).norm()]
}

/// The mean move of an end, mm.
pub fn mean(moves: &Moves) -> f64 {
    let ends = |m: &Move| lengths(m).iter().sum::<f64>() / 2.0;
    moves.iter().map(ends).sum::<f64>() / moves.len() as f64
}

/// The longest move of an end, mm.
pub fn longest(moves: &Moves) -> f64 {
    let ends = |m: &Move| {
        let [a, b] = lengths(m);
        a.max(b)
    };
    // Not a number is longer than all.
    moves
        .iter()
        .map(ends)
        .fold(0.0, |a, b| if b.is_nan() || a.is_nan() { f64::NAN } else { a.max(b) })
}
