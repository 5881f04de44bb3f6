//! Where the contacts lie along the rods, and where each rod is cut: at its
//! outermost contacts plus the overhang.

use super::axis::{Axis, Crossing};
use super::close::Joint;
use super::fault::Fault;
use super::weave::Weave;
use crate::ids::{ContactId, IdVec, RodId, UnitId};

/// A contact as it lies along one rod.
#[derive(Clone, Copy, Debug)]
pub struct Seat {
    /// The contact.
    pub contact: ContactId,
    /// Distance from the axis' end A, mm.
    pub at: f64,
    unit: UnitId,
    ending: bool,
}

/// The crossing of every joint's two rods, the over rod first.
///
/// # Errors
/// The contact whose rods are parallel, as a fault of its unit.
pub fn crossings(
    weave: &Weave,
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<IdVec<ContactId, Crossing>, Fault> {
    joints
        .enumerate()
        .map(|(id, j)| {
            axes[j.over].cross(&axes[j.under], &j.outward).ok_or_else(|| Fault {
                units: vec![weave.contacts[id].unit],
                reason: "two of its rods became parallel".into(),
            })
        })
        .collect()
}

/// The contacts of each rod, from end A to end B.
pub fn seats(
    weave: &Weave,
    joints: &IdVec<ContactId, Joint>,
    crossings: &IdVec<ContactId, Crossing>,
) -> IdVec<RodId, Vec<Seat>> {
    let mut seats: IdVec<RodId, Vec<Seat>> = vec![Vec::new(); weave.rods.len()].into();
    for (contact, joint) in joints.enumerate() {
        let woven = &weave.contacts[contact];
        let x = &crossings[contact];
        for (rod, at) in [(joint.over, x.at_first), (joint.under, x.at_second)] {
            seats[rod].push(Seat { contact, at, unit: woven.unit, ending: woven.ending == rod });
        }
    }
    for along in seats.iter_mut() {
        along.sort_by(|p, q| p.at.total_cmp(&q.at));
    }
    seats
}

/// Units whose contacts came out of order: towards each end of a rod the contact
/// that passes must come first, then the one in which the rod ends, at least
/// `apart` mm farther out.
pub fn disorder(weave: &Weave, seats: &IdVec<RodId, Vec<Seat>>, apart: f64) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (r, along) in seats.enumerate() {
        let [a, b] = weave.rods[r].units;
        // From end A to end B: ending and passing of unit a, passing and ending of unit b.
        let wanted = [(a, true), (a, false), (b, false), (b, true)];
        let wanted = wanted.into_iter().filter_map(|(u, ending)| u.map(|u| (u, ending)));
        let ordered = wanted.eq(along.iter().map(|s| (s.unit, s.ending)));
        let spaced = along.windows(2).all(|s| s[1].at - s[0].at >= apart);
        if !ordered || !spaced {
            let units = [a, b].into_iter().flatten().collect();
            faults.push(Fault {
                units,
                reason: "contacts came out of order or too close together along one of its rods"
                    .into(),
            });
        }
    }
    faults
}

/// Cuts a rod at its outermost contacts plus the overhang on each side, the length
/// rounded up to a multiple of `round` mm (0: as it is). What rounding adds goes to
/// both ends alike, so no contact moves.
pub fn cut(axis: &Axis, seats: &[Seat], overhang: f64, round: f64) -> Axis {
    let (first, last) = (seats.first(), seats.last());
    let from = first.map_or(0.0, |s| s.at) - overhang;
    let to = last.map_or(axis.length(), |s| s.at) + overhang;
    let extra = rounded_up(to - from, round) - (to - from);
    axis.between(from - extra / 2.0, to + extra / 2.0)
}

/// A length this little above a multiple of the rounding step, in steps, counts as
/// that multiple; less, and rounding twice adds a step for a last bit.
const SAME_STEP: f64 = 1e-6;

/// The least multiple of `step` that is not below `length`, but for rounding noise.
pub fn rounded_up(length: f64, step: f64) -> f64 {
    if step > 0.0 { (length / step - SAME_STEP).ceil() * step } else { length }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_round_up_to_the_step_once() {
        assert_eq!(rounded_up(10.1, 0.5), 10.5);
        assert_eq!(rounded_up(10.5, 0.5), 10.5);
        assert_eq!(rounded_up(10.5 + 1e-9, 0.5), 10.5);
        assert_eq!(rounded_up(10.123, 0.0), 10.123);
    }
}
