//! Which rods are propped, and where.
//!
//! Where the frame is put together from the ground up and needs props for that, those are the
//! stands: they hold it in every step, and keep their numbers. Otherwise every unit gets one:
//! under a rod that holds no other unit, that goes under as many of its neighbours as can be, and
//! as near to the middle of the unit as there is room. A stand stays until the frame is closed, so
//! it keeps clear of all rods, of the other stands, and of the seams of the plate.

use super::clear::{clears_feet, clears_rods, feet};
use super::plate::Seams;
use super::stand::{Shape, Stand};
use crate::frame::Frame;
use crate::frame::axis::Axis;
use crate::ids::{Id, PropId, RodId, UnitId};
use crate::shop::{Assembly, Order, order::Prop};
use std::collections::BTreeSet;

/// Places that are tried along a rod.
const PLACES: usize = 40;

/// The stands, and what is left without.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Choice {
    /// The stands with what they are cut to.
    pub stands: Vec<(Stand, Shape)>,
    /// Units without a stand: they lie too low or too steep for one, or there is no room.
    pub unheld: Vec<UnitId>,
    /// Props of the assembly for which there is no room.
    pub missed: Vec<PropId>,
}

/// Chooses the stands of a frame, of board so thick.
pub fn choose(frame: &Frame, assembly: Option<&Assembly>, seams: &Seams, thickness: f64) -> Choice {
    let mut site = Site { frame, seams, thickness, feet: Vec::new(), choice: Choice::default() };
    let ground = assembly.filter(|a| a.order == Order::Ground);
    let mut props: Vec<&Prop> =
        ground.iter().flat_map(|a| &a.steps).flat_map(|s| &s.props).collect();
    if props.is_empty() {
        site.hold_units();
    } else {
        props.sort_by_key(|prop| prop.id);
        props.into_iter().for_each(|prop| site.take_up(prop));
    }
    site.choice
}

struct Site<'a> {
    frame: &'a Frame,
    seams: &'a Seams,
    thickness: f64,
    /// The feet of the stands that are set.
    feet: Vec<Axis>,
    choice: Choice,
}

impl Site<'_> {
    fn hold_units(&mut self) {
        let mut taken = BTreeSet::new();
        for unit in self.frame.units.ids() {
            let id = PropId::new(self.choice.stands.len());
            let mut places: Vec<(RodId, f64)> =
                self.frame.units[unit].rods.iter().flat_map(|&rod| self.places(rod)).collect();
            places.sort_by(|a, b| {
                let key = |&(rod, at): &(RodId, f64)| {
                    (taken.contains(&rod), self.overs(unit, rod), self.off_middle(unit, rod, at))
                };
                let (a, b) = (key(a), key(b));
                (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
            });
            match self.first_clear(id, places) {
                Some((stand, shape)) => {
                    taken.insert(stand.rod);
                    self.set(Stand { unit: Some(unit), ..stand }, shape);
                }
                None => self.choice.unheld.push(unit),
            }
        }
    }

    /// Sets a stand for a prop of the assembly: on its rod, as near to its place as there is room.
    fn take_up(&mut self, prop: &Prop) {
        let off = |&(_, at): &(RodId, f64)| (at - prop.at).abs();
        let mut places = self.places(prop.rod);
        places.push((prop.rod, prop.at));
        places.sort_by(|a, b| off(a).total_cmp(&off(b)));
        match self.first_clear(prop.id, places) {
            Some((stand, shape)) => self.set(stand, shape),
            None => self.choice.missed.push(prop.id),
        }
    }

    fn set(&mut self, stand: Stand, shape: Shape) {
        self.feet.extend(feet(&stand, &shape));
        self.choice.stands.push((stand, shape));
    }

    /// Places along a rod, between its outermost contacts.
    fn places(&self, rod: RodId) -> Vec<(RodId, f64)> {
        let contacts = &self.frame.rods[rod].contacts;
        let at = contacts.iter().map(|&c| self.frame.seen_from(c, rod).at);
        let (from, to) = (at.clone().reduce(f64::min), at.reduce(f64::max));
        let (Some(from), Some(to)) = (from, to) else { return Vec::new() };
        let place = |i: usize| (rod, from + (to - from) * i as f64 / PLACES as f64);
        (1..PLACES).map(place).collect()
    }

    /// How often a rod goes over another one in a unit.
    fn overs(&self, unit: UnitId, rod: RodId) -> usize {
        let contacts = &self.frame.units[unit].contacts;
        contacts.iter().filter(|&&c| self.frame.contacts[c].over == rod).count()
    }

    /// How far a place on a rod is from the middle of a unit, from above, mm.
    fn off_middle(&self, unit: UnitId, rod: RodId, at: f64) -> f64 {
        let off = self.frame.rods[rod].axis.at(at) - self.frame.units[unit].center.position;
        off.x.hypot(off.y)
    }

    /// The first place at which a stand has room.
    fn first_clear(&self, id: PropId, places: Vec<(RodId, f64)>) -> Option<(Stand, Shape)> {
        places.into_iter().find_map(|(rod, at)| {
            let stand = Stand::under(self.frame, id, rod, at)?;
            let shape = stand.shape(self.thickness)?;
            let ours = feet(&stand, &shape);
            let clear = self.seams.clear(&ours)
                && clears_feet(&ours, &self.feet, self.thickness)
                && clears_rods(self.frame, &stand, &shape, self.thickness);
            clear.then_some((stand, shape))
        })
    }
}
