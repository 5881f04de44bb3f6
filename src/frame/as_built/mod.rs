//! A frame solved again with what was measured on its sticks: the same rods and contacts, but
//! sawn sticks keep their length, and their contacts come to lie where they are marked.
//!
//! The finished frame is closed again with the marks [held](super::close::marks). Then every
//! stick is [placed](place) on its axis: one that is sawn so that its marks are met; the others
//! are cut anew, at the same length where that will do. Measured diameters change the gaps that
//! are wanted. Where rods taper, or one reaches below the ground, this is done again with what
//! came of it.

mod error;
mod limits;
mod place;
mod sticks;

pub use error::AsBuiltError;
pub use sticks::{Measured, MeasuredMark};

use super::assemble::contact;
use super::axis::Axis;
use super::close::marks::Marks;
use super::close::{CloseError, Task, Way, close};
use super::cut::crossing;
use super::gaps::Joint;
use super::{ContactKind, Frame};
use crate::ids::{ContactId, Id, IdVec, RodId};
use limits::{limits, require_room};
use place::Placing;
use std::collections::BTreeMap;
use sticks::Sticks;

/// Rounds of closing before rods that taper are given up.
const MOST_ROUNDS: usize = 40;

/// A wanted gap that changes by less, as part of the nominal diameter, has settled; see
/// [`Sizes`](super::sizes::Sizes), where frames are closed first.
const SETTLED: f64 = 1e-12;

/// Rods reach below the ground when they do by more than this, as part of the diameter. Less is
/// rounding of the rod that the ground was found by.
const BELOW: f64 = 1e-6;

/// How far marks give way in a step ([`Marks::give`]) where they can be met: a mark that rod ends
/// have to be moved ten times as far for is met to a thousandth in two steps.
const FIRM: f64 = 1e-3;

/// The same where marks contradict each other. With less, rods are moved several diameters for
/// the last tenths of a mm; with more, these are left.
const LOOSE: f64 = 3e-2;

/// Marks contradict each other when one is left farther off than this, mm: a tenth of what is
/// [`SEEN`].
const CONTRADICT: f64 = 0.05;

/// Marks that change by more are to be made again, mm: less is not seen beside the width of a
/// pencil line.
pub const SEEN: f64 = 0.5;

/// Lengths that differ by less are the same cut, mm.
const SAME_CUT: f64 = 1e-6;

/// What became of the measurements. Lengths in mm.
#[derive(Clone, PartialEq, Debug)]
pub struct AsBuilt {
    /// Sticks that are sawn: those with a measurement.
    pub sawn: Vec<RodId>,
    /// Marks that are held.
    pub marks: usize,
    /// Diameters that were measured.
    pub diameters: usize,
    /// Largest distance left between a contact and its held mark, or between the foot of a
    /// sawn stick and the ground.
    pub deviation: f64,
    /// Largest error of a gap, as part of the gap that is wanted.
    pub error: f64,
    /// Largest change of a mark that is not held, against the frame as planned.
    pub mark_change: f64,
    /// Largest change of the length of a stick that is not sawn.
    pub length_change: f64,
    /// Sticks with a mark that is off by more than [`SEEN`] from where it has to be: one that is
    /// held and could not be met, or any other as planned. With it, by how much at most.
    pub mark_again: Vec<(RodId, f64)>,
    /// Sticks, not sawn, whose length is another one.
    pub saw_again: Vec<RodId>,
}

/// How sticks are cut. Lengths in mm.
#[derive(Clone, Copy, Debug)]
pub struct Cutting {
    /// Rod left beyond its last contact.
    pub overhang: f64,
    /// Cut lengths are multiples of this; 0 for any length.
    pub round: f64,
}

/// Solves a frame again with what was measured.
///
/// # Errors
/// [`AsBuiltError`] with the row, or the rods, that are at fault.
pub fn as_built(
    plan: &Frame,
    rows: &[Measured],
    cutting: Cutting,
) -> Result<(Frame, AsBuilt), AsBuiltError> {
    let sticks = Sticks::new(plan, rows)?;
    let mut start = plan.clone();
    for (&rod, &diameters) in &sticks.diameters {
        start.rods[rod].diameters = diameters;
    }
    let again = |give: f64| {
        let (frame, error) =
            Round { plan, sticks: &sticks, cutting, give }.settle(start.clone())?;
        require_room(plan, &frame, &sticks, cutting.overhang)?;
        let what = compare(plan, &frame, &sticks);
        Ok((frame, AsBuilt { error, ..what }))
    };
    match again(FIRM) {
        Ok(firm) if firm.1.deviation <= CONTRADICT => Ok(firm),
        _ => again(LOOSE),
    }
}

struct Round<'a> {
    plan: &'a Frame,
    sticks: &'a Sticks,
    cutting: Cutting,
    give: f64,
}

impl Round<'_> {
    /// Closes the frame until gaps and ground are as they are wanted; the largest error of a gap
    /// with it.
    fn settle(&self, start: Frame) -> Result<(Frame, f64), AsBuiltError> {
        let mut axes: IdVec<RodId, Axis> = start.rods.iter().map(|rod| rod.axis).collect();
        let mut joints = start.joints();
        let mut frame = start;
        let mut unsettled = Vec::new();
        for _ in 0..MOST_ROUNDS {
            let limits = limits(&frame, self.cutting);
            let marked = self.sticks.marked(self.plan, frame.ground);
            let task = Task {
                joints: &joints,
                circuits: &[],
                limits: Some(&limits),
                marks: Marks { rods: &marked, give: self.give },
                roam: None,
                edge: frame.diameter,
            };
            let closing =
                close(&mut axes, &task, Way::Least).map_err(|e| self.unclosed(e, &joints))?;
            let placing = Placing {
                plan: self.plan,
                sticks: self.sticks,
                cutting: self.cutting,
                ground: frame.ground,
            };
            let low = placing.place(&mut frame, &axes, &joints)?;
            unsettled = refit(&frame, &mut joints);
            if low < frame.ground - BELOW * frame.diameter {
                frame.ground = low;
            } else if unsettled.is_empty() {
                return Ok((frame, closing.error));
            }
        }
        let contact = unsettled.first().copied().unwrap_or(ContactId::new(0));
        Err(AsBuiltError::unsettled(self.plan, contact))
    }

    fn unclosed(&self, e: CloseError, joints: &IdVec<ContactId, Joint>) -> AsBuiltError {
        let open = match e {
            CloseError::Parallel(contact) => vec![contact],
            CloseError::Diverged { open } => open,
            CloseError::Linear(e) => return AsBuiltError::Linear(e),
        };
        AsBuiltError::open(joints, &open)
    }
}

/// Sets the gaps to those that are wanted where contacts lie; the contacts for which that is
/// another one.
fn refit(frame: &Frame, joints: &mut IdVec<ContactId, Joint>) -> Vec<ContactId> {
    let mut changed = Vec::new();
    for (id, contact) in frame.contacts.enumerate() {
        let (gap, joint) = (frame.wanted_gap(contact), &mut joints[id]);
        let off = (gap - joint.diameter).abs() > SETTLED * frame.diameter;
        if contact.kind == ContactKind::Cross && off {
            joint.diameter = gap;
            changed.push(id);
        }
    }
    changed
}

/// The contacts of a frame on axes that were moved.
fn touch_again(
    frame: &mut Frame,
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<(), AsBuiltError> {
    for (id, joint) in joints.enumerate() {
        let x = crossing(axes, joint).ok_or_else(|| AsBuiltError::open(joints, &[id]))?;
        frame.contacts[id] = contact(axes, joint, &x, frame.contacts[id].unit);
    }
    axes.enumerate().for_each(|(r, axis)| frame.rods[r].axis = *axis);
    Ok(())
}

/// What changed between the frame as planned and as it was solved again.
fn compare(plan: &Frame, frame: &Frame, sticks: &Sticks) -> AsBuilt {
    let [mut deviation, mut mark_change, mut length_change] = [0.0_f64; 3];
    let (mut mark_again, mut saw_again) = (Vec::new(), Vec::new());
    for (r, rod) in frame.rods.enumerate() {
        let (marks, mut most) = (sticks.sawn.get(&r), 0.0_f64);
        for &c in &rod.contacts {
            let at = frame.seen_from(c, r).at;
            match marks.and_then(|marks| marks.get(&c)) {
                Some(mark) => {
                    let off = (at - mark).abs();
                    deviation = deviation.max(off);
                    most = most.max(off);
                }
                None => {
                    let change = (at - plan.seen_from(c, r).at).abs();
                    mark_change = mark_change.max(change);
                    most = most.max(change);
                }
            }
        }
        if most > SEEN {
            mark_again.push((r, most));
        }
        let change = (rod.axis.length() - plan.rods[r].axis.length()).abs();
        if marks.is_none() && change > SAME_CUT {
            length_change = length_change.max(change);
            saw_again.push(r);
        }
    }
    let feet = frame.supports.iter().filter(|s| sticks.sawn.contains_key(&s.rod));
    deviation = feet.map(|s| (s.point.z - frame.ground).abs()).fold(deviation, f64::max);
    AsBuilt {
        sawn: sticks.sawn.keys().copied().collect(),
        marks: sticks.sawn.values().map(BTreeMap::len).sum(),
        diameters: sticks.diameters.len(),
        deviation,
        error: 0.0,
        mark_change,
        length_change,
        mark_again,
        saw_again,
    }
}

#[cfg(test)]
mod tests;
