//! How far the last contact of a unit will be off where marks and diameters are not exact: a
//! Monte Carlo on the frame, linearised.
//!
//! A frame is put together mark on mark. A rod that is marked with errors cannot lie at all its
//! marks: inside the frame it has four contacts, so its place is given by more marks than it
//! has freedoms. With every error small, the moves x of the rods are those that make
//!
//! ```text
//! Σ (Jm x − e)² + FIRM · Σ (Jg x − d)² + STAY · |x|²
//! ```
//!
//! least: e are the errors of the marks and Jm the gradients of the contacts' places along their
//! rods, Jg those of gaps and d the sums of the errors of the two radii. Sticks are pressed
//! together until they touch; it is the marks that do not come together.
//!
//! In each unit one contact, that of its outermost rods, is looked at as the last one of the
//! whole frame. It is not tied yet: its own marks pull only [`BY_HAND`] as much as the others. How
//! far these two marks are apart then, is how far it is off. A unit that has room to give closes
//! by hand, and is off by next to nothing.

mod draws;
mod model;

use super::{ContactKind, Frame};
use crate::ids::{ContactId, IdVec, UnitId};
use crate::linalg::LinalgError;
use draws::Draws;
use model::{Last, Model};

/// Errors of marks and diameters, ± two standard deviations of a normal distribution: 95 % are
/// smaller. mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// Of a mark along its rod.
    pub marks: f64,
    /// Of the diameter of a stick, the same all along it.
    pub diameter: f64,
}

/// Frames that are put together, each with other errors: percentiles at 95 % are then good to
/// some 5 %.
pub const TRIALS: usize = 500;

/// Standard deviations that a tolerance stands for.
const DEVIATIONS: f64 = 2.0;

/// How much a last contact pulls by hand, as part of one that is tied. More, and what does not
/// fit is spread over the other contacts; less, and units that have room to give do not close.
const BY_HAND: f64 = 1e-2;

/// How far off last contacts are, mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Off {
    /// Half of them are off by less.
    pub median: f64,
    /// 95 % are off by less.
    pub p95: f64,
}

/// The last contact of a unit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UnitOff {
    /// The unit.
    pub unit: UnitId,
    /// The contact.
    pub contact: ContactId,
    /// How far it is off over all trials.
    pub off: Off,
}

/// What errors of marks and diameters do.
#[derive(Clone, PartialEq, Debug)]
pub struct Misfit {
    /// The errors.
    pub tolerance: Tolerance,
    /// Where the random errors started.
    pub seed: u32,
    /// Over all units and trials.
    pub overall: Off,
    /// Of each unit in which rods cross.
    pub units: Vec<UnitOff>,
}

/// Tries what errors of marks and diameters do; nothing where no rods cross in any unit.
///
/// # Errors
/// [`LinalgError`] where a contact's rods are parallel or memory does not suffice.
pub fn misfit(
    frame: &Frame,
    tolerance: Tolerance,
    seed: u32,
) -> Result<Option<Misfit>, LinalgError> {
    let last: Vec<(UnitId, ContactId)> =
        frame.units.ids().filter_map(|u| Some((u, last_contact(frame, u)?))).collect();
    if last.is_empty() {
        return Ok(None);
    }
    let mut model = Model::new(frame)?;
    let ends: Vec<Last> = last.iter().map(|&(_, c)| model.last(c, BY_HAND)).collect();
    let mut off: Vec<Vec<f64>> = vec![Vec::with_capacity(TRIALS); last.len()];
    let mut draws = Draws::new(seed, tolerance.marks / DEVIATIONS, tolerance.diameter / DEVIATIONS);
    for _ in 0..TRIALS {
        let errors = draws.errors(frame);
        let moves = model.put_together(&errors);
        for (off, end) in off.iter_mut().zip(&ends) {
            off.push(end.off(&model, &errors, &moves));
        }
    }
    let overall = quantiles(&mut off.concat());
    let each = last.into_iter().zip(&mut off);
    let units = each.map(|((unit, contact), off)| UnitOff { unit, contact, off: quantiles(off) });
    Ok(Some(Misfit { tolerance, seed, overall, units: units.collect() }))
}

impl Misfit {
    /// The unit that is off by most at 95 %.
    pub fn worst(&self) -> Option<&UnitOff> {
        self.units.iter().reduce(|worst, u| if u.off.p95 > worst.off.p95 { u } else { worst })
    }
}

/// The contact of a unit that is made last: rods are numbered from the middle outwards, so it is
/// that of the highest numbers. Every contact is of one unit, so none is the last of two.
fn last_contact(frame: &Frame, unit: UnitId) -> Option<ContactId> {
    let contacts = frame.units[unit].contacts.iter().copied();
    let crossing = contacts.filter(|&c| frame.contacts[c].kind == ContactKind::Cross);
    crossing.max_by_key(|&c| {
        let c = &frame.contacts[c];
        (c.over.max(c.under), c.over.min(c.under))
    })
}

/// The median and the 95th percentile of some figures, which are sorted.
fn quantiles(off: &mut [f64]) -> Off {
    off.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let at = ((off.len() as f64 * share).ceil() as usize).max(1) - 1;
        off.get(at).copied().unwrap_or(0.0)
    };
    Off { median: at(0.5), p95: at(0.95) }
}

/// The errors of one trial, mm.
#[derive(Clone, PartialEq, Debug)]
pub struct Errors {
    /// How much farther from end A than planned each contact is marked, on its over rod and on
    /// its under rod.
    pub marks: IdVec<ContactId, [f64; 2]>,
    /// How much thicker than planned each contact's two rods are in the mean.
    pub gaps: IdVec<ContactId, f64>,
}

#[cfg(test)]
mod tests;
