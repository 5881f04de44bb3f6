//! Rods become straight (paper, section 4.2): each the line through its two places on
//! the surface, from its outermost contact at one end to that at the other.
//!
//! On a convex surface the ends of a rod then lie above the rods that it ends on
//! by themselves, by the *rise* of each contact.

use super::ContactKind;
use super::axis::{Axis, Crossing};
use super::weave::{Weave, WovenContact};
use crate::ids::{ContactId, IdVec, RodId, UnitId};
use crate::surface::Point3;

/// Rods in space before any contact is met.
#[derive(Clone, Debug)]
pub struct Lifted {
    /// The axes, each from its outermost contact at end A to that at end B.
    pub axes: IdVec<RodId, Axis>,
}

/// A unit whose rods became parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallel(pub UnitId);

/// Makes the rods of a weave straight.
///
/// # Errors
/// The first unit whose rods become parallel.
pub fn lift(weave: &Weave) -> Result<Lifted, Parallel> {
    let axis = |[a, b]: [_; 2]| Axis { a, b };
    let mut lifted = Lifted { axes: weave.rods.iter().map(|r| axis(r.through)).collect() };
    span_contacts(weave, &mut lifted)?;
    Ok(lifted)
}

impl Lifted {
    /// How the ending rod of a contact passes the other one.
    pub fn crossing(&self, contact: &WovenContact) -> Option<Crossing> {
        self.axes[contact.ending].cross(&self.axes[contact.passing], &contact.on.normal)
    }

    /// The rise of every contact: height of the ending rod over the passing one, mm; none
    /// where ends meet.
    pub fn rises(&self, weave: &Weave) -> IdVec<ContactId, Option<f64>> {
        let rise = |c: &WovenContact| match c.kind {
            ContactKind::Cross => Some(self.crossing(c).map_or(f64::NAN, |x| x.rise)),
            ContactKind::End(_) => None,
        };
        weave.contacts.iter().map(rise).collect()
    }

    /// The middle of every contact: half-way between the nearest points of both axes, or
    /// between the ends that are to meet.
    pub fn middles(&self, weave: &Weave) -> IdVec<ContactId, Point3> {
        let middle = |c: &WovenContact| {
            let [ending, passing] = [c.ending, c.passing].map(|rod| &self.axes[rod]);
            let [p, q] = match (c.kind, self.crossing(c)) {
                (ContactKind::Cross, Some(x)) => [ending.at(x.at_first), passing.at(x.at_second)],
                // Axes that do not cross have been refused by then.
                (ContactKind::Cross, None) => [c.on.position; 2],
                (ContactKind::End([e, p]), _) => [ending.end(e), passing.end(p)],
            };
            nalgebra::center(&p, &q)
        };
        weave.contacts.iter().map(middle).collect()
    }
}

/// Lets every axis run from contact to contact, so that later moves of its ends
/// are moves of its contacts.
fn span_contacts(weave: &Weave, lifted: &mut Lifted) -> Result<(), Parallel> {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    let mut spans: IdVec<RodId, [f64; 2]> = weave.rods.iter().map(|_| empty).collect();
    for contact in &weave.contacts {
        let [ending, passing] = [contact.ending, contact.passing];
        let at = match contact.kind {
            ContactKind::Cross => {
                let x = lifted.crossing(contact).ok_or(Parallel(contact.unit))?;
                [x.at_first, x.at_second]
            }
            ContactKind::End([e, p]) => {
                [lifted.axes[ending].place_of(e), lifted.axes[passing].place_of(p)]
            }
        };
        for (rod, at) in [ending, passing].into_iter().zip(at) {
            let [lo, hi] = spans[rod];
            spans[rod] = [lo.min(at), hi.max(at)];
        }
    }
    for (axis, [lo, hi]) in lifted.axes.iter_mut().zip(&spans) {
        *axis = axis.between(*lo, *hi);
    }
    Ok(())
}
