//! What a frame has to keep when it is solved again, and whether it did.

use super::sticks::Sticks;
use super::{AsBuiltError, Cutting};
use crate::frame::axis::Axis;
use crate::frame::clash::clashes;
use crate::frame::close::bounds::Limits;
use crate::frame::finish::ENGAGEMENT;
use crate::frame::sizes::gap_between;
use crate::frame::{End, Frame, Rod};
use crate::ids::{ContactId, IdVec, RodId};
use std::collections::BTreeSet;

/// Of the overhang, so much has to be left beyond the last contact of a sawn stick: there a
/// rubber band still holds.
const LEFT: f64 = 0.5;

/// Room that lacks by less, as part of the diameter, is rounding.
const LACKING: f64 = 1e-6;

/// Contacts in order with room between them, and overhangs.
pub fn limits(frame: &Frame, cutting: Cutting) -> Limits {
    let beyond = |r: RodId| {
        let met = frame.met_ends(r);
        let left = cutting.overhang + cutting.round / 2.0;
        [End::A, End::B].map(|end| if met.contains(&end) { 0.0 } else { left })
    };
    let room = |(r, rod): (RodId, &Rod)| {
        rod.contacts.windows(2).map(|pair| needed(frame, r, [pair[0], pair[1]])).collect()
    };
    Limits {
        along: frame.rods.iter().map(|rod| rod.contacts.clone()).collect(),
        room: frame.rods.enumerate().map(room).collect(),
        beyond: frame.rods.ids().map(beyond).collect(),
        thickness: frame.rods.iter().map(Rod::thickest).collect(),
        diameter: frame.diameter,
    }
}

/// The least distance of two contacts on a rod, mm.
fn needed(frame: &Frame, rod: RodId, pair: [ContactId; 2]) -> f64 {
    ENGAGEMENT
        * gap_between(pair.map(|c| {
            let seen = frame.seen_from(c, rod);
            frame.rods[seen.partner].diameter_at(seen.at_partner)
        }))
}

/// Checks the frame that came out.
///
/// # Errors
/// A stick that is too short, rods without room on a third, or that run into each other.
pub fn require_room(
    plan: &Frame,
    frame: &Frame,
    sticks: &Sticks,
    overhang: f64,
) -> Result<(), AsBuiltError> {
    for &rod in sticks.sawn.keys() {
        require_stick(plan, frame, rod, overhang)?;
    }
    for (r, rod) in frame.rods.enumerate() {
        for pair in rod.contacts.windows(2) {
            let [first, second] = [pair[0], pair[1]].map(|c| frame.seen_from(c, r));
            let (apart, needed) = (second.at - first.at, needed(frame, r, [pair[0], pair[1]]));
            if apart.is_nan() || apart < needed - LACKING * frame.diameter {
                let [first, second] = [first.partner, second.partner];
                return Err(AsBuiltError::NoRoom { rod: r, first, second, apart, needed });
            }
        }
    }
    let axes: IdVec<RodId, Axis> = frame.rods.iter().map(|rod| rod.axis).collect();
    let sizes = frame.rods.iter().map(|rod| rod.diameters).collect();
    let touching: BTreeSet<[RodId; 2]> =
        frame.contacts.iter().map(|c| [c.over.min(c.under), c.over.max(c.under)]).collect();
    match clashes(&axes, &sizes, &touching).first() {
        Some(clash) => Err(AsBuiltError::Clash { rods: clash.rods, distance: clash.distance }),
        None => Ok(()),
    }
}

/// Whether a sawn stick holds all its contacts, and enough beyond the outermost.
fn require_stick(
    plan: &Frame,
    frame: &Frame,
    rod: RodId,
    overhang: f64,
) -> Result<(), AsBuiltError> {
    let (stick, least) = (&frame.rods[rod], LEFT * overhang);
    let stands = plan.supports.iter().any(|s| s.rod == rod);
    let met = frame.met_ends(rod);
    for &contact in stick.contacts.iter().filter(|&&c| frame.met_end(c, rod).is_none()) {
        let seen = frame.seen_from(contact, rod);
        let beyond = |end: End| if met.contains(&end) { 0.0 } else { least };
        let ends = [
            ("A", seen.at, if stands { 0.0 } else { beyond(End::A) }),
            ("B", stick.axis.length() - seen.at, beyond(End::B)),
        ];
        for (end, left, least) in ends {
            if left.is_nan() || left < least - LACKING * frame.diameter {
                let mate = seen.partner;
                return Err(AsBuiltError::FallsOff { rod, mate, contact, end, left, least });
            }
        }
    }
    Ok(())
}
