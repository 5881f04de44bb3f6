//! Puts the finished frame together from its parts.

use super::axis::{Axis, Crossing};
use super::cut::{crossings, seats};
use super::fault::Fault;
use super::gaps::Joint;
use super::sizes::Sizes;
use super::weave::{RodEnd, Weave};
use super::{Contact, Frame, Rod, Support, Unit};
use crate::ids::{ContactId, IdVec, RodId, UnitId};

/// What a frame is made of and stands on. Lengths in mm.
#[derive(Clone, Debug)]
pub struct Ground {
    /// How thick the rods are.
    pub sizes: Sizes,
    /// Height of the ground.
    pub ground: f64,
    /// The rods that reach it.
    pub supports: Vec<Support>,
}

/// The contact of a joint whose rods cross so.
pub fn contact(axes: &IdVec<RodId, Axis>, joint: &Joint, x: &Crossing, unit: UnitId) -> Contact {
    let [u, v] = [joint.over, joint.under].map(|r| axes[r].direction());
    Contact {
        kind: joint.kind,
        over: joint.over,
        under: joint.under,
        at_over: x.at_first,
        at_under: x.at_second,
        angle: u.cross(&v).norm().atan2(u.dot(&v).abs()),
        gap: x.rise,
        normal: joint.outward,
        unit,
    }
}

/// The frame of these axes, which are closed and cut; nothing is left out of it yet.
///
/// # Errors
/// The unit of a contact whose rods are parallel.
pub fn assemble(
    weave: &Weave,
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    on: Ground,
) -> Result<Frame, Fault> {
    let crossings = crossings(weave, axes, joints)?;
    let seats = seats(axes.len(), joints, &crossings);
    let contacts = joints
        .enumerate()
        .map(|(id, joint)| contact(axes, joint, &crossings[id], weave.contacts[id].unit))
        .collect();
    let rods = axes
        .enumerate()
        .map(|(r, axis)| Rod {
            axis: *axis,
            diameters: on.sizes.ends[r],
            units: weave.rods[r].units.clone(),
            border: weave.rods[r].ends.contains(&RodEnd::Free),
            contacts: seats[r].iter().map(|s| s.contact).collect(),
        })
        .collect();
    let units = weave
        .units
        .iter()
        .map(|woven| Unit {
            center: woven.center,
            chirality: woven.chirality,
            sides: woven.sides,
            rods: woven.rods.clone(),
            contacts: woven.contacts.clone(),
        })
        .collect();
    let Ground { sizes: Sizes { nominal: diameter, .. }, ground, supports } = on;
    Ok(Frame { diameter, ground, rods, contacts, units, supports, dropped: Vec::new() })
}
