//! Whether placed rods can move: the rank of the equations of what holds them.
//!
//! A rod has five freedoms; it may spin about its axis as it likes. A contact is closed
//! and tied: both rods stay in touch, each at its mark, and the tie grips them at their
//! angle. That is four equations to first order, which no motion of the frame as a whole
//! breaks. Where two ends meet, a sleeve holds them together, and at their angle. A foot and
//! a prop hold their point.
//!
//! Rods without a motion that keeps all equations are held. This is checked on some rods
//! while the others stand still: rods that are added to a frame that is held are held with
//! it, if they are so against it. Strength is not looked at: a frame that cannot move may
//! still bend under its weight.

use super::start::start;
use crate::frame::{Contact, ContactKind, Frame};
use crate::ids::{ContactId, IdVec, RodId};
use crate::linalg::{BlockSolver, LinalgError, LowerPattern};
use crate::surface::{Point3, Vector3};
use nalgebra::{SMatrix, SVector};
use std::collections::BTreeMap;

/// Freedoms of a rod.
pub const FREEDOMS: usize = 5;
/// A coefficient for each freedom of a rod.
type Five = SVector<f64, FREEDOMS>;

/// A motion is one where all equations together are broken by less than this part of it.
/// Frames of real curvature that are held give 3e-4 or more; loose ones stay below 1e-10,
/// what rounding leaves.
const SLACK: f64 = 1e-5;
/// Added to the diagonal so that loose rods can be factored as well: far below the square
/// of the slack.
const BASE: f64 = 1e-13;
/// Steps of the search for the loosest motion. Each makes it purer by the ratio of the
/// squared looseness of the next one.
const ROUNDS: usize = 4;
/// Sine of the angle below which two rods that meet count as in line: no angle to grip.
const IN_LINE: f64 = 1e-6;

/// Where a rod lies. Its freedoms are the motion of its middle along the axes of space, mm,
/// and the motions of its end B against the middle along the two sides.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    start: Point3,
    /// Unit vector along the rod.
    pub along: Vector3,
    sides: [Vector3; 2],
    half: f64,
}

impl Pose {
    /// The pose of a rod.
    pub fn new(frame: &Frame, rod: RodId) -> Self {
        let axis = &frame.rods[rod].axis;
        let (along, sides) = (axis.direction(), axis.sides());
        Self { start: axis.a, along, sides, half: axis.length() / 2.0 }
    }

    /// The poses of all rods.
    pub fn all(frame: &Frame) -> IdVec<RodId, Self> {
        frame.rods.ids().map(|rod| Self::new(frame, rod)).collect()
    }

    fn at(&self, s: f64) -> Point3 {
        self.start + self.along * s
    }

    /// How far the point `s` from end A moves along a direction.
    pub fn moved(&self, s: f64, direction: &Vector3) -> Five {
        let share = s / self.half - 1.0;
        let [p, q] = self.sides.map(|side| share * side.dot(direction));
        Five::new(direction.x, direction.y, direction.z, p, q)
    }

    /// How fast the rod's direction turns towards another one, per mm.
    fn turned(&self, direction: &Vector3) -> Five {
        let [p, q] = self.sides.map(|side| side.dot(direction) / self.half);
        Five::new(0.0, 0.0, 0.0, p, q)
    }

    /// Two unit vectors square to the rod and to each other.
    pub fn sides(&self) -> [Vector3; 2] {
        self.sides
    }

    /// The equations that hold the point `s` from end A.
    pub fn held(&self, rod: RodId, s: f64) -> Vec<Row> {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        axes.iter().map(|axis| Row::one(rod, self.moved(s, axis))).collect()
    }

    /// The motion of the point `s` from end A.
    pub fn motion(&self, s: f64, of: &Five) -> Vector3 {
        let share = s / self.half - 1.0;
        let middle = Vector3::new(of[0], of[1], of[2]);
        middle + (self.sides[0] * of[3] + self.sides[1] * of[4]) * share
    }
}

/// An equation: the sum of what the freedoms of one rod or two add to it stays zero.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    first: (RodId, Five),
    second: Option<(RodId, Five)>,
}

impl Row {
    /// An equation of one rod.
    pub fn one(rod: RodId, of: Five) -> Self {
        Self { first: (rod, of), second: None }
    }

    fn two(first: (RodId, Five), second: (RodId, Five)) -> Self {
        Self { first, second: Some(second) }
    }

    fn parts(&self) -> impl Iterator<Item = (RodId, Five)> + use<> {
        [Some(self.first), self.second].into_iter().flatten()
    }
}

/// The equations of a contact.
pub fn contact_rows(frame: &Frame, poses: &IdVec<RodId, Pose>, id: ContactId) -> Vec<Row> {
    let c = &frame.contacts[id];
    let (over, under) = (&poses[c.over], &poses[c.under]);
    let pair = |p: Five, q: Five| Row::two((c.over, p), (c.under, q));
    let apart = over.at(c.at_over) - under.at(c.at_under);
    let mut rows = Vec::with_capacity(FREEDOMS);
    let mut stay = |direction: &Vector3, p: Five, q: Five| {
        let [a, b] = [over.moved(c.at_over, direction), under.moved(c.at_under, direction)];
        rows.push(pair(a + p, q - b));
    };
    let none = Five::zeros();
    match c.kind {
        ContactKind::Cross => {
            // The line across both turns with them: what a point of one rod moves along it
            // against the other's is that much less.
            let gap = apart.norm();
            let across = apart / gap;
            stay(&across, none, none);
            stay(&over.along, over.turned(&across) * gap, none);
            stay(&under.along, none, under.turned(&across) * gap);
        }
        ContactKind::End(_) => {
            [Vector3::x(), Vector3::y(), Vector3::z()].iter().for_each(|d| stay(d, none, none));
        }
    }
    rows.extend(grip(c, over, under).map(|(p, q)| pair(p, q)));
    rows
}

/// The equations that keep the angle between two rods, in mm at the end of the shorter one.
/// Rods in line have no angle that changes to first order: both directions are kept.
fn grip(c: &Contact, over: &Pose, under: &Pose) -> impl Iterator<Item = (Five, Five)> + use<> {
    let arm = over.half.min(under.half);
    let sine = over.along.cross(&under.along).norm();
    let both: Vec<(Five, Five)> = if sine > IN_LINE {
        let turned = [over.turned(&under.along), under.turned(&over.along)];
        let [p, q] = turned.map(|five| five * (arm / sine));
        vec![(p, q)]
    } else {
        let sign = -over.along.dot(&under.along).signum();
        let side = |side: &Vector3| (over.turned(side) * arm, under.turned(side) * (arm * sign));
        over.sides.iter().map(side).collect()
    };
    debug_assert!(sine > IN_LINE || matches!(c.kind, ContactKind::End(_)), "parallel rods");
    both.into_iter()
}

/// The loosest motion of some rods, where all others stand still.
#[derive(Clone, Debug)]
pub struct Motion {
    of: BTreeMap<RodId, Five>,
}

impl Motion {
    /// The motion of the point `s` from end A of a rod, as part of the largest of all.
    pub fn at(&self, poses: &IdVec<RodId, Pose>, rod: RodId, s: f64) -> Vector3 {
        self.of.get(&rod).map_or_else(Vector3::zeros, |of| poses[rod].motion(s, of))
    }
}

/// A motion of `rods` that breaks none of the equations, if there is one. Rods of the
/// equations that are not among them stand still.
///
/// # Errors
/// [`LinalgError::TooLarge`] when memory does not suffice.
pub fn loose(rods: &[RodId], rows: &[Row]) -> Result<Option<Motion>, LinalgError> {
    if rods.is_empty() {
        return Ok(None);
    }
    let place: BTreeMap<RodId, usize> = rods.iter().enumerate().map(|(i, &r)| (r, i)).collect();
    let parts = |row: &Row| {
        let mut parts = row.parts().filter_map(|(rod, of)| Some((*place.get(&rod)?, of)));
        (parts.next(), parts.next())
    };
    let rows: Vec<_> = rows.iter().map(parts).collect();
    let pairs = rows.iter().filter_map(|(p, q)| Some((p.as_ref()?.0, q.as_ref()?.0)));
    let mut solver = BlockSolver::<FREEDOMS>::new(LowerPattern::new(rods.len(), pairs)?)?;
    for (first, second) in &rows {
        let parts: Vec<&(usize, Five)> = first.iter().chain(second).collect();
        for (k, (i, p)) in parts.iter().enumerate() {
            for (j, q) in &parts[..=k] {
                solver.add(*i, *j, &(p * q.transpose()));
            }
        }
    }
    let base = SMatrix::<f64, FREEDOMS, FREEDOMS>::identity() * BASE;
    (0..rods.len()).for_each(|i| solver.add(i, i, &base));
    let mut motion = start(FREEDOMS * rods.len());
    let length = norm(&motion);
    motion.iter_mut().for_each(|x| *x /= length);
    if solver.factor().is_err() {
        // Rounding was more than the base: there is a motion; where, is not known.
        return Ok(Some(spread(rods, &motion)));
    }
    let mut looseness = f64::INFINITY;
    for _ in 0..ROUNDS {
        solver.solve(&mut motion);
        looseness = 1.0 / norm(&motion);
        motion.iter_mut().for_each(|x| *x *= looseness);
    }
    Ok((looseness < SLACK * SLACK).then(|| spread(rods, &motion)))
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A motion by rods.
fn spread(rods: &[RodId], motion: &[f64]) -> Motion {
    let of = rods.iter().zip(motion.chunks(FREEDOMS));
    Motion { of: of.map(|(&rod, x)| (rod, Five::from_column_slice(x))).collect() }
}

#[cfg(test)]
mod tests;
