//! How thick each rod is, and how far apart the axes of two rods lie where they touch:
//! by the sum of their radii there.
//!
//! A rod may taper from end A to end B. Its radius at a contact then hangs on where the
//! contact lies along the finished rod, which is known only once the frame is closed and
//! cut. So such frames are closed, cut, and closed again with the radii found. A taper
//! passes on only as much of an error as it is steep, some hundredths, so each round is that
//! much nearer.

use super::ContactKind;
use super::axis::Axis;
use super::cut::crossings;
use super::fault::Fault;
use super::gaps::Joint;
use super::weave::{RodEnd, Weave};
use crate::ids::{ContactId, IdVec, RodId};
use std::collections::BTreeMap;

/// Rods that are not of the nominal diameter, as asked for: diameters at end A and at end
/// B, mm.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SizeTable {
    /// Single rods, by their numbers in the finished frame.
    pub rods: BTreeMap<RodId, [f64; 2]>,
    /// Rods at the border that are not named.
    pub border: Option<[f64; 2]>,
    /// All others.
    pub all: Option<[f64; 2]>,
}

impl SizeTable {
    /// Whether all rods are of the nominal diameter.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// The diameter of a stick at a share of its length, given those at end A and end B.
pub fn diameter_at([a, b]: [f64; 2], share: f64) -> f64 {
    // Exact for straight sticks, whatever the share.
    if a == b { a } else { a + (b - a) * share }
}

/// How far apart two axes are where rods of these diameters touch.
pub fn gap_between(diameters: [f64; 2]) -> f64 {
    (diameters[0] + diameters[1]) / 2.0
}

/// A wanted gap that differs by less from the last one, as part of the nominal diameter,
/// stays: what closing itself counts as exact. Less, and rounding keeps rounds going.
const SETTLED: f64 = 1e-12;

/// The diameters of the rods of a weave.
#[derive(Clone, PartialEq, Debug)]
pub struct Sizes {
    /// The diameter by which errors are measured, mm.
    pub nominal: f64,
    /// Diameters at end A and at end B of every rod, mm.
    pub ends: IdVec<RodId, [f64; 2]>,
}

impl Sizes {
    /// The diameters that a table gives the rods of a weave.
    ///
    /// # Errors
    /// The first rod of the table that the weave does not have.
    pub fn new(weave: &Weave, table: &SizeTable, nominal: f64) -> Result<Self, RodId> {
        let last = weave.rods.ids().next_back();
        if let Some(&missing) = table.rods.keys().find(|&&rod| Some(rod) > last) {
            return Err(missing);
        }
        let unnamed = |r: RodId| {
            let border = table.border.filter(|_| weave.rods[r].ends.contains(&RodEnd::Free));
            border.or(table.all).unwrap_or([nominal; 2])
        };
        let of = |r| table.rods.get(&r).copied().unwrap_or_else(|| unnamed(r));
        Ok(Self { nominal, ends: weave.rods.ids().map(of).collect() })
    }

    /// Whether some rod is thicker at one end than at the other.
    pub fn are_tapered(&self) -> bool {
        self.ends.iter().any(|[a, b]| a != b)
    }

    /// The diameter of a rod half-way along it, mm.
    pub fn middle(&self, rod: RodId) -> f64 {
        diameter_at(self.ends[rod], 0.5)
    }

    /// The diameters of the over and the under rod of every joint where they touch, on axes
    /// that are cut to length, mm.
    ///
    /// # Errors
    /// The unit of a contact whose rods are parallel.
    pub fn at_contacts(
        &self,
        weave: &Weave,
        axes: &IdVec<RodId, Axis>,
        joints: &IdVec<ContactId, Joint>,
    ) -> Result<IdVec<ContactId, [f64; 2]>, Fault> {
        if !self.are_tapered() {
            return Ok(joints.iter().map(|j| [j.over, j.under].map(|r| self.ends[r][0])).collect());
        }
        let crossings = crossings(weave, axes, joints)?;
        let at = |rod: RodId, at: f64| diameter_at(self.ends[rod], at / axes[rod].length());
        let both = joints.iter().zip(crossings.iter());
        Ok(both.map(|(j, x)| [at(j.over, x.at_first), at(j.under, x.at_second)]).collect())
    }

    /// Gives every crossing the gap of rods of these diameters. The contacts for which that is
    /// another one.
    pub fn refit(
        &self,
        joints: &mut IdVec<ContactId, Joint>,
        diameters: &IdVec<ContactId, [f64; 2]>,
    ) -> Vec<ContactId> {
        let mut changed = Vec::new();
        for (contact, &pair) in diameters.enumerate() {
            let (joint, gap) = (&mut joints[contact], gap_between(pair));
            let off = (gap - joint.diameter).abs() > SETTLED * self.nominal;
            if joint.kind == ContactKind::Cross && off {
                joint.diameter = gap;
                changed.push(contact);
            }
        }
        changed
    }
}

#[cfg(test)]
#[path = "sizes_tests.rs"]
mod tests;
