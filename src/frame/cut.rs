//! Where the contacts lie along the rods, and where each rod is cut: at its
//! outermost contacts plus the overhang.

use super::ContactKind;
use super::axis::{Axis, Crossing};
use super::fault::Fault;
use super::gaps::Joint;
use super::weave::{RodEnd, Weave};
use crate::ids::{ContactId, IdVec, RodId};
use std::collections::BTreeMap;

/// A contact as it lies along one rod.
#[derive(Clone, Copy, Debug)]
pub struct Seat {
    /// The contact.
    pub contact: ContactId,
    /// Distance from the axis' end A, mm.
    pub at: f64,
}

/// The crossing of a joint's two rods, the over rod first; `None` where they are parallel.
pub fn crossing(axes: &IdVec<RodId, Axis>, joint: &Joint) -> Option<Crossing> {
    let (over, under) = (&axes[joint.over], &axes[joint.under]);
    match joint.kind {
        ContactKind::Cross => over.cross(under, &joint.outward),
        ContactKind::End([first, second]) => Some(Crossing {
            at_first: over.place_of(first),
            at_second: under.place_of(second),
            across: joint.outward,
            rise: (over.end(first) - under.end(second)).norm(),
        }),
    }
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
        .map(|(id, joint)| {
            crossing(axes, joint).ok_or_else(|| Fault {
                units: vec![weave.contacts[id].unit],
                reason: "two of its rods became parallel".into(),
            })
        })
        .collect()
}

/// The contacts of each rod, from end A to end B.
pub fn seats(
    rods: usize,
    joints: &IdVec<ContactId, Joint>,
    crossings: &IdVec<ContactId, Crossing>,
) -> IdVec<RodId, Vec<Seat>> {
    let mut seats: IdVec<RodId, Vec<Seat>> = vec![Vec::new(); rods].into();
    for (contact, joint) in joints.enumerate() {
        let x = &crossings[contact];
        for (rod, at) in [(joint.over, x.at_first), (joint.under, x.at_second)] {
            seats[rod].push(Seat { contact, at });
        }
    }
    for along in seats.iter_mut() {
        along.sort_by(|p, q| p.at.total_cmp(&q.at));
    }
    seats
}

/// Units of rods along which contacts came out of the order of the pattern, or two of them
/// nearer to each other than the `room` that they need, mm.
pub fn disorder(
    weave: &Weave,
    seats: &IdVec<RodId, Vec<Seat>>,
    room: impl Fn(RodId, [ContactId; 2]) -> f64,
) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (r, along) in seats.enumerate() {
        let rod = &weave.rods[r];
        let ordered = rod.contacts.iter().eq(along.iter().map(|s| &s.contact));
        let spaced =
            along.windows(2).all(|s| s[1].at - s[0].at >= room(r, [s[0].contact, s[1].contact]));
        if !ordered || !spaced {
            faults.push(Fault {
                units: rod.units.clone(),
                reason: "contacts came out of order or too close together along one of its rods"
                    .into(),
            });
        }
    }
    faults
}

/// Cuts a rod at its outermost contacts plus the overhang on each side; `length` gives the
/// length that it gets for the least one, mm. What that adds goes to both ends alike, so
/// no contact moves; but an end that meets another stays where it is.
pub fn cut(
    axis: &Axis,
    ends: [RodEnd; 2],
    seats: &[Seat],
    overhang: f64,
    length: impl FnOnce(f64) -> f64,
) -> Axis {
    let (first, last) = (seats.first(), seats.last());
    let beyond = ends.map(|end| if end == RodEnd::Meets { 0.0 } else { overhang });
    let from = first.map_or(0.0, |s| s.at) - beyond[0];
    let to = last.map_or(axis.length(), |s| s.at) + beyond[1];
    let extra = length(to - from) - (to - from);
    let share = shares(ends, extra);
    axis.between(from - share[0], to + share[1])
}

/// How an extra length goes to end A and end B: to both alike, but none to an end that meets
/// another.
pub fn shares(ends: [RodEnd; 2], extra: f64) -> [f64; 2] {
    match ends {
        [RodEnd::Meets, RodEnd::Meets] => [0.0, 0.0],
        [RodEnd::Meets, _] => [0.0, extra],
        [_, RodEnd::Meets] => [extra, 0.0],
        _ => [extra / 2.0; 2],
    }
}

/// A length this little above a multiple of the rounding step, in steps, counts as
/// that multiple; less, and rounding twice adds a step for a last bit.
const SAME_STEP: f64 = 1e-6;

/// The least multiple of `step` that is not below `length`, but for rounding noise.
pub fn rounded_up(length: f64, step: f64) -> f64 {
    if step > 0.0 { (length / step - SAME_STEP).ceil() * step } else { length }
}

/// Gives rods lengths that are multiples of a step. Asked again for a rod whose least length
/// has changed a little, it gives the same length as before where that will do: lengths
/// near a multiple do not go back and forth then.
#[derive(Clone, Debug)]
pub struct Steps {
    step: f64,
    last: BTreeMap<RodId, f64>,
}

/// A length given before is kept up to so many steps above the least one. With one, a rod could
/// go back and forth; with two, a rod may be sawn a whole step too long.
const SPARE: f64 = 1.5;

impl Steps {
    /// Multiples of `step` mm; 0 for any length.
    pub fn new(step: f64) -> Self {
        Self { step, last: BTreeMap::new() }
    }

    /// The length of a rod that is at least `least` mm long.
    pub fn length(&mut self, rod: RodId, least: f64) -> f64 {
        let kept = self.last.get(&rod).copied().filter(|&last| {
            last >= least - SAME_STEP * self.step && last < least + SPARE * self.step
        });
        let length = kept.unwrap_or_else(|| rounded_up(least, self.step));
        self.last.insert(rod, length);
        length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;

    #[test]
    fn what_rounding_adds_moves_no_end_that_meets_another() {
        let axis = Axis { a: [0.0; 3].into(), b: [40.25, 0.0, 0.0].into() };
        let seat = |contact, at| Seat { contact: ContactId::new(contact), at };
        let seats = [seat(0, 0.0), seat(1, 30.25)];
        let both = cut(&axis, [RodEnd::Rests; 2], &seats, 6.0, |least| rounded_up(least, 0.5));
        assert_eq!((both.a.x, both.b.x), (-6.125, 36.375));
        let met =
            cut(&axis, [RodEnd::Meets, RodEnd::Rests], &seats, 6.0, |least| rounded_up(least, 0.5));
        assert_eq!((met.a.x, met.b.x), (0.0, 36.5));
    }

    #[test]
    fn lengths_round_up_to_the_step_once() {
        assert_eq!(rounded_up(10.1, 0.5), 10.5);
        assert_eq!(rounded_up(10.5, 0.5), 10.5);
        assert_eq!(rounded_up(10.5 + 1e-9, 0.5), 10.5);
        assert_eq!(rounded_up(10.123, 0.0), 10.123);
    }

    #[test]
    fn a_length_near_a_step_does_not_go_back_and_forth() {
        let (mut steps, rod) = (Steps::new(0.5), RodId::new(3));
        let given = [10.499, 10.501, 10.499, 10.501, 9.9].map(|least| steps.length(rod, least));
        assert_eq!(given, [10.5, 11.0, 11.0, 11.0, 10.0]);
        let mut exact = Steps::new(0.0);
        assert_eq!([10.501, 10.499].map(|least| exact.length(rod, least)), [10.501, 10.499]);
    }
}
