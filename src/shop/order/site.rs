//! What stands at a moment: the rods that are placed, and the contacts that are made.

use super::Order;
use crate::frame::{End, Frame};
use crate::ids::{ContactId, IdVec, RodId, UnitId};

/// What stands at a moment.
pub struct Site<'a> {
    /// The finished frame.
    pub frame: &'a Frame,
    /// Where assembly begins.
    pub order: Order,
    /// The number of steps so far.
    pub step: usize,
    /// The step in which each rod was placed, counted from zero.
    placed: IdVec<RodId, Option<usize>>,
    /// The rods in the order in which they were placed.
    sequence: Vec<RodId>,
    /// Which end of each rod will stand on the ground.
    feet: IdVec<RodId, Option<End>>,
}

impl<'a> Site<'a> {
    /// An empty one.
    pub fn new(frame: &'a Frame, order: Order) -> Self {
        let mut feet: IdVec<RodId, Option<End>> = vec![None; frame.rods.len()].into();
        for support in &frame.supports {
            feet[support.rod] = Some(support.end);
        }
        let placed = vec![None; frame.rods.len()].into();
        Self { frame, order, step: 0, placed, sequence: Vec::new(), feet }
    }

    /// Places a rod in this step.
    pub fn place(&mut self, rod: RodId) {
        self.placed[rod] = Some(self.step);
        self.sequence.push(rod);
    }

    /// Whether a rod is placed.
    pub fn has(&self, rod: RodId) -> bool {
        self.placed[rod].is_some()
    }

    /// The rods placed, the first one first.
    pub fn sequence(&self) -> &[RodId] {
        &self.sequence
    }

    /// The rods placed in this step or after it, in order.
    pub fn since(&self, step: usize) -> &[RodId] {
        let from = self.sequence.partition_point(|&r| self.placed[r].is_some_and(|at| at < step));
        &self.sequence[from..]
    }

    /// Whether a contact is made: both of its rods are placed.
    pub fn made(&self, contact: ContactId) -> bool {
        let c = &self.frame.contacts[contact];
        self.has(c.over) && self.has(c.under)
    }

    /// The end on which a rod stands in the finished frame.
    pub fn foot(&self, rod: RodId) -> Option<End> {
        self.feet[rod]
    }

    /// The rods of a unit that are not placed yet, in the unit's order.
    pub fn missing(&self, unit: UnitId) -> Vec<RodId> {
        self.frame.units[unit].rods.iter().copied().filter(|&r| !self.has(r)).collect()
    }

    /// How many contacts with placed rods or rods for which `with` holds, and feet, hold a rod.
    pub fn holds(&self, rod: RodId, with: impl Fn(RodId) -> bool) -> usize {
        let holding = |&&c: &&ContactId| {
            let partner = self.frame.seen_from(c, rod).partner;
            self.has(partner) || with(partner)
        };
        let contacts = self.frame.rods[rod].contacts.iter().filter(holding).count();
        contacts + usize::from(self.feet[rod].is_some())
    }

    /// The ends of a placed rod that no rod holds yet: contacts are to come there, or none.
    pub fn free_ends(&self, rod: RodId) -> impl Iterator<Item = End> + use<'_> {
        let r = &self.frame.rods[rod];
        let at = |c: &ContactId| self.frame.seen_from(*c, rod).at;
        let nearest = r.contacts.iter().copied().min_by(|a, b| at(a).total_cmp(&at(b)));
        let farthest = r.contacts.iter().copied().max_by(|a, b| at(a).total_cmp(&at(b)));
        let open = |c: Option<ContactId>| c.is_none_or(|c| !self.made(c));
        let a = (r.border || open(nearest)).then_some(End::A);
        let b = open(farthest).then_some(End::B);
        a.into_iter().chain(b)
    }
}
