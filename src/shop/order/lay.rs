//! The order in which the rods of a step are laid, and what each then lies over and under.

use super::site::Site;
use super::{Closing, Lift, Step};
use crate::frame::{ContactKind, Frame};
use crate::ids::{ContactId, RodId, UnitId};
use std::collections::BTreeSet;

/// Lays the rods of a batch, one after the other, so that few of them have to be slid under
/// others, and ends the step.
pub fn lay(site: &mut Site, batch: Vec<RodId>) -> Step {
    let mut step = Step::default();
    let mut left = batch;
    let closed = circuits(site, &left);
    while !left.is_empty() {
        let rod = left.remove(next(site, &left, step.rods.last().copied()));
        join(site, rod, &mut step);
        site.place(rod);
        step.rods.push(rod);
    }
    let now = circuits(site, &step.rods);
    let closing = |&unit: &UnitId| {
        let u = &site.frame.units[unit];
        let last = step.rods.iter().rev().find(|rod| u.rods[..u.sides].contains(rod));
        last.map(|&rod| Closing { unit, rod })
    };
    step.closes = now.difference(&closed).filter_map(closing).collect();
    site.step += 1;
    step
}

/// Which of the rods that are left is laid next: one that none of them is to go under later,
/// one that touches the last rod laid, and the first of such.
fn next(site: &Site, left: &[RodId], last: Option<RodId>) -> usize {
    let frame = site.frame;
    let rank = |&i: &usize| {
        let rod = left[i];
        let contacts = &frame.rods[rod].contacts;
        let rests = |&&c: &&ContactId| {
            frame.contacts[c].over == rod
                && frame.contacts[c].kind == ContactKind::Cross
                && left.contains(&frame.contacts[c].under)
        };
        let touches = |&c: &ContactId| Some(frame.seen_from(c, rod).partner) == last;
        (contacts.iter().filter(rests).count(), !contacts.iter().any(touches), i)
    };
    (0..left.len()).min_by_key(rank).unwrap_or(0)
}

/// The contacts of a rod with those that lie already.
fn join(site: &Site, rod: RodId, step: &mut Step) {
    let frame = site.frame;
    let mut contacts = frame.rods[rod].contacts.clone();
    contacts.retain(|&c| site.has(frame.seen_from(c, rod).partner));
    contacts.sort_unstable();
    for contact in contacts {
        if goes_under(frame, contact, rod) {
            step.under.push(contact);
            let lifted = frame.contacts[contact].over;
            step.lifts.push(Lift { rod: lifted, below: rod, contact });
        } else {
            step.over.push(contact);
        }
    }
}

/// Whether a rod lies under its partner.
pub fn goes_under(frame: &Frame, contact: ContactId, rod: RodId) -> bool {
    let c = &frame.contacts[contact];
    c.under == rod && c.kind == ContactKind::Cross
}

/// The units of some rods whose circuits are closed.
fn circuits(site: &Site, rods: &[RodId]) -> BTreeSet<UnitId> {
    let frame = site.frame;
    let units = rods.iter().flat_map(|&r| frame.rods[r].units.iter().copied());
    let closed = |unit: &UnitId| {
        let circuit = frame.circuit(&frame.units[*unit]);
        !circuit.is_empty() && circuit.iter().all(|&c| site.made(c))
    };
    units.filter(closed).collect()
}
