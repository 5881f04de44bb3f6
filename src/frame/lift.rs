//! From the plane into space (paper, section 4.2): each rod becomes the straight
//! line through the places of its two plane points on the surface.
//!
//! On a convex surface the ends of a rod then lie above the rods that it ends on
//! by themselves, by the *rise* of each contact.

use super::axis::{Axis, Crossing};
use super::weave::{Weave, WovenContact};
use crate::chart::{Chart, SurfacePoint};
use crate::ids::{ContactId, IdVec, RodId, UnitId};
use crate::surface::Vector3;
use crate::tiling::Placement;

/// Rods in space before any contact is met.
#[derive(Clone, Debug)]
pub struct Lifted {
    /// The axes, each from its outermost contact at end A to that at end B.
    pub axes: IdVec<RodId, Axis>,
    /// Outward unit normals of the surface at the contacts.
    pub normals: IdVec<ContactId, Vector3>,
    /// Unit centres on the surface.
    pub centers: IdVec<UnitId, SurfacePoint>,
}

/// Why a weave cannot be lifted: a unit of it that does not lie on the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Unliftable {
    /// The unit.
    pub unit: UnitId,
    /// What is wrong, as a clause.
    pub reason: &'static str,
}

/// Lifts a weave that is placed in the plane of a chart.
///
/// # Errors
/// The first unit that reaches beyond the chart, or whose rods become parallel.
pub fn lift(
    weave: &Weave,
    placement: &Placement,
    chart: &impl Chart,
) -> Result<Lifted, Unliftable> {
    let outside = |unit| Unliftable { unit, reason: "reaches beyond the surface" };
    let place = |p| chart.lift(placement.apply(p));
    let mut axes = IdVec::new();
    for rod in &weave.rods {
        let unit = rod.units[1].or(rod.units[0]).expect("a woven rod belongs to a unit");
        let [a, b] = rod.through.map(place);
        let (a, b) = (a.ok_or(outside(unit))?.position, b.ok_or(outside(unit))?.position);
        axes.push(Axis { a, b });
    }
    let normals = weave
        .contacts
        .iter()
        .map(|c| place(c.at).map(|p| p.normal).ok_or(outside(c.unit)))
        .collect::<Result<_, _>>()?;
    let centers = weave
        .units
        .enumerate()
        .map(|(u, unit)| place(unit.center).ok_or(outside(u)))
        .collect::<Result<_, _>>()?;
    let mut lifted = Lifted { axes, normals, centers };
    span_contacts(weave, &mut lifted)?;
    Ok(lifted)
}

impl Lifted {
    /// How the ending rod of a contact passes the other one.
    pub fn crossing(&self, id: ContactId, contact: &WovenContact) -> Option<Crossing> {
        self.axes[contact.ending].cross(&self.axes[contact.passing], &self.normals[id])
    }

    /// The rise of every contact: height of the ending rod over the passing one, mm.
    pub fn rises(&self, weave: &Weave) -> IdVec<ContactId, f64> {
        let rise = |(id, c)| self.crossing(id, c).map_or(f64::NAN, |x| x.rise);
        weave.contacts.enumerate().map(rise).collect()
    }
}

/// Lets every axis run from contact to contact, so that later moves of its ends
/// are moves of its contacts.
fn span_contacts(weave: &Weave, lifted: &mut Lifted) -> Result<(), Unliftable> {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    let mut spans: IdVec<RodId, [f64; 2]> = weave.rods.iter().map(|_| empty).collect();
    for (id, contact) in weave.contacts.enumerate() {
        let x = lifted
            .crossing(id, contact)
            .ok_or(Unliftable { unit: contact.unit, reason: "has parallel rods" })?;
        for (rod, at) in [(contact.ending, x.at_first), (contact.passing, x.at_second)] {
            let [lo, hi] = spans[rod];
            spans[rod] = [lo.min(at), hi.max(at)];
        }
    }
    for (axis, [lo, hi]) in lifted.axes.iter_mut().zip(&spans) {
        *axis = axis.between(*lo, *hi);
    }
    Ok(())
}
