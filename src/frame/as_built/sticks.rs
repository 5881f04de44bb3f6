//! Measurements, row by row as they were written down, become marks and diameters of rods.

use super::AsBuiltError;
use crate::frame::close::marks::MarkedRod;
use crate::frame::{End, Frame};
use crate::ids::{ContactId, Id, RodId};
use std::collections::BTreeMap;

/// What was measured on one stick: a row of a table. Lengths in mm.
#[derive(Clone, PartialEq, Debug)]
pub struct Measured {
    /// The line of the file that it stands on.
    pub line: u64,
    /// The rod.
    pub rod: RodId,
    /// A mark on it.
    pub mark: Option<MeasuredMark>,
    /// Its diameter at end A and, if it tapers, at end B.
    pub diameter: Option<(f64, Option<f64>)>,
}

/// A mark as it was measured. mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MeasuredMark {
    /// The rod that it is for.
    pub mate: Option<RodId>,
    /// The contact that it is for: this, the mate, or both are given.
    pub contact: Option<ContactId>,
    /// Its distance from end A.
    pub at: f64,
}

/// A mark farther off than one diameter and this part of the stick's length is taken for a slip
/// of row or unit. Smaller, and marks that slipped are refused; larger, and those of the
/// neighbouring row pass.
const SLIP: f64 = 0.05;

/// A diameter off by more than this factor is taken for one of another unit, or for a radius.
const LIKELY: f64 = 1.6;

/// Sticks that are sawn. Lengths in mm.
#[derive(Debug)]
pub struct Sticks {
    /// Each with the marks that were measured on it, by their distance from end A.
    pub sawn: BTreeMap<RodId, BTreeMap<ContactId, f64>>,
    /// Diameters that were measured, at end A and at end B.
    pub diameters: BTreeMap<RodId, [f64; 2]>,
}

impl Sticks {
    /// Those of some rows.
    ///
    /// # Errors
    /// [`AsBuiltError::Row`] for the first row that does not fit the frame.
    pub fn new(frame: &Frame, rows: &[Measured]) -> Result<Self, AsBuiltError> {
        let mut sticks = Self { sawn: BTreeMap::new(), diameters: BTreeMap::new() };
        for row in rows {
            sticks
                .add(frame, row)
                .map_err(|problem| AsBuiltError::Row { line: row.line, problem })?;
        }
        Ok(sticks)
    }

    fn add(&mut self, frame: &Frame, row: &Measured) -> Result<(), String> {
        let rod = row.rod;
        if rod.index() >= frame.rods.len() {
            let last = RodId::new(frame.rods.len() - 1);
            return Err(format!("there is no rod {rod}, the last one is {last}"));
        }
        let marks = self.sawn.entry(rod).or_default();
        if let Some(mark) = &row.mark {
            let contact = contact_of(frame, rod, mark)?;
            require_likely(frame, rod, contact, mark.at)?;
            if let Some(other) = marks.insert(contact, mark.at) {
                return Err(format!(
                    "the mark of {rod} for {contact} was given before, as {other} mm"
                ));
            }
        }
        if let Some(given) = row.diameter {
            let ends = diameters(frame, rod, given)?;
            if self.diameters.insert(rod, ends).is_some() {
                return Err(format!("the diameter of {rod} was given before"));
            }
        }
        Ok(())
    }

    /// The marks with which the planned frame is to be closed again, on a ground of this height.
    /// Where ends meet, the end of a sawn stick is a mark, too.
    pub fn marked(&self, plan: &Frame, ground: f64) -> Vec<MarkedRod> {
        let marked = |(&rod, measured): (&RodId, &BTreeMap<ContactId, f64>)| {
            let length = plan.rods[rod].axis.length();
            let met = plan.rods[rod].contacts.iter().filter_map(|&c| {
                let end = plan.met_end(c, rod)?;
                Some((c, if end == End::A { 0.0 } else { length }))
            });
            let stands = plan.supports.iter().any(|s| s.rod == rod);
            MarkedRod {
                rod,
                marks: met.chain(measured.iter().map(|(&c, &at)| (c, at))).collect(),
                foot: stands.then_some(ground),
            }
        };
        self.sawn.iter().map(marked).collect()
    }
}

/// The contact that a mark is for.
fn contact_of(frame: &Frame, rod: RodId, mark: &MeasuredMark) -> Result<ContactId, String> {
    let on = &frame.rods[rod].contacts;
    let partner = |c: ContactId| frame.seen_from(c, rod).partner;
    let known = || {
        let each = on.iter().map(|&c| format!("{} ({c})", partner(c)));
        each.collect::<Vec<_>>().join(", ")
    };
    let fits = |c: &ContactId| {
        mark.contact.is_none_or(|contact| contact == *c)
            && mark.mate.is_none_or(|mate| partner(*c) == mate)
    };
    let mut found = on.iter().copied().filter(fits);
    let what = match (mark.contact, mark.mate) {
        (Some(contact), Some(mate)) => format!("{mate} at {contact}"),
        (Some(contact), None) => contact.to_string(),
        (None, Some(mate)) => mate.to_string(),
        (None, None) => return Err(format!("a mark of {rod} is for {}", known())),
    };
    match (found.next(), found.next()) {
        (None, _) => Err(format!("{rod} does not touch {what}; it touches {}", known())),
        (Some(_), Some(_)) => {
            Err(format!("{rod} touches {what} twice: say which contact is meant: {}", known()))
        }
        (Some(contact), None) if frame.met_end(contact, rod).is_some() => Err(format!(
            "{rod} meets {} end to end, and that end is where it was sawn: measure marks of rods \
             that cross",
            partner(contact)
        )),
        (Some(contact), None) => Ok(contact),
    }
}

/// Refuses a mark that is far from where it was planned.
fn require_likely(frame: &Frame, rod: RodId, contact: ContactId, at: f64) -> Result<(), String> {
    let seen = frame.seen_from(contact, rod);
    let limit = frame.rods[rod].thickest() + SLIP * frame.rods[rod].axis.length();
    let off = (at - seen.at).abs();
    // Not a number is far off.
    if off <= limit {
        return Ok(());
    }
    Err(format!(
        "the mark of {rod} for {} ({contact}) is given as {at} mm and was planned at {:.1} mm; \
         more than {limit:.1} mm off, it is likely in the wrong row or unit, or measured from end \
         B. Correct it, or leave it out and saw a new stick for {rod}",
        seen.partner, seen.at
    ))
}

/// The diameters of a rod, given one for both ends or two.
fn diameters(frame: &Frame, rod: RodId, (a, b): (f64, Option<f64>)) -> Result<[f64; 2], String> {
    let planned = &frame.rods[rod];
    if planned.is_tapered() && b.is_none() {
        return Err(format!("{rod} tapers: give its diameter_b, at end B, as well"));
    }
    let ends = [a, b.unwrap_or(a)];
    for (end, planned) in ends.into_iter().zip(planned.diameters) {
        if !(planned / LIKELY..=planned * LIKELY).contains(&end) {
            return Err(format!(
                "the diameter of {rod} is given as {end} mm and was planned as {planned} mm: it is \
                 likely in another unit. For other sticks, set their diameter in the design \
                 ([rod.sizes])"
            ));
        }
    }
    Ok(ends)
}
