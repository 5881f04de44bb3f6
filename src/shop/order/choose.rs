//! Which unit comes next.
//!
//! Levels (rings or rows) are finished one after the other. Within one, the unit comes
//! next whose rods have to be slid under the fewest others, together with the best unit that
//! it leads to; builders go round, so units away from the last one count for worse.

use super::Order;
use super::lay::goes_under;
use super::neighbors::Neighbors;
use super::site::Site;
use crate::frame::Frame;
use crate::ids::{IdVec, RodId, UnitId};

/// So many rods slid under others are taken on, rather than to go elsewhere on the ring.
const JUMP: f64 = 1.5;
/// So many are taken on before a unit of the next row comes.
const ABOVE: f64 = 4.0;
/// Nothing is begun apart from what stands, unless nothing that stands can be built on in its row
/// and the next.
const APART: f64 = 1e6;

/// Chooses one unit after the other.
pub struct Chooser<'a> {
    frame: &'a Frame,
    neighbors: &'a Neighbors,
    /// The units that are left of each level, the current one last.
    levels: Vec<Vec<UnitId>>,
    /// The number of the level of each unit.
    level: IdVec<UnitId, usize>,
    /// What placing a unit costs in rods slid under others, with what it leads to; none
    /// where it has to be counted again.
    cost: IdVec<UnitId, Option<f64>>,
    last: Option<UnitId>,
}

impl<'a> Chooser<'a> {
    /// All units to choose from.
    pub fn new(frame: &'a Frame, neighbors: &'a Neighbors, order: Order) -> Self {
        let mut levels = neighbors.levels(frame, order);
        let mut level: IdVec<UnitId, usize> = vec![0; frame.units.len()].into();
        for (number, units) in levels.iter().enumerate() {
            units.iter().for_each(|&unit| level[unit] = number);
        }
        levels.reverse();
        let cost = vec![None; frame.units.len()].into();
        Self { frame, neighbors, levels, level, cost, last: None }
    }

    /// The unit to be placed next; none when all rods are placed.
    pub fn next(&mut self, site: &Site) -> Option<UnitId> {
        loop {
            let mut units = self.levels.pop()?;
            units.retain(|&unit| !self.is_done(site, unit));
            if units.is_empty() {
                continue;
            }
            let current = self.level[units[0]];
            let ahead = self.ahead(site);
            for &unit in units.iter().chain(&ahead) {
                self.cost[unit] = self.cost[unit].or_else(|| Some(self.count(site, unit)));
            }
            let chosen = units.iter().chain(&ahead).copied().min_by(|&a, &b| {
                let [p, q] = [a, b].map(|unit| self.price(site, unit, current));
                p.0.total_cmp(&q.0).then(p.1.total_cmp(&q.1)).then(a.cmp(&b))
            });
            self.levels.push(units);
            return chosen;
        }
    }

    /// From the ground up, units of the next row that stand on placed ones: rather these than to
    /// begin apart from what stands.
    fn ahead(&self, site: &Site) -> Vec<UnitId> {
        let next = match (site.order, self.levels.last()) {
            (Order::Ground, Some(next)) => next,
            _ => return Vec::new(),
        };
        let joined = |&unit: &UnitId| !self.is_done(site, unit) && self.is_joined(site, unit);
        next.iter().copied().filter(joined).collect()
    }

    /// Whether a unit has a neighbour whose rods are all placed.
    fn is_joined(&self, site: &Site, unit: UnitId) -> bool {
        self.neighbors.of(unit).iter().any(|&near| self.is_done(site, near))
    }

    /// Counts costs again round a unit that was placed.
    pub fn placed(&mut self, unit: UnitId) {
        self.last = Some(unit);
        self.cost[unit] = None;
        for &near in self.neighbors.of(unit) {
            self.cost[near] = None;
            self.neighbors.of(near).iter().for_each(|&far| self.cost[far] = None);
        }
    }

    fn is_done(&self, site: &Site, unit: UnitId) -> bool {
        self.frame.units[unit].rods.iter().all(|&rod| site.has(rod))
    }

    /// What decides between units: their cost, and the distance from the last one, mm.
    fn price(&self, site: &Site, unit: UnitId, current: usize) -> (f64, f64) {
        let cost = self.cost[unit].unwrap_or(0.0);
        let Some(last) = self.last else { return (cost, self.first(unit)) };
        let jump = if self.neighbors.of(last).contains(&unit) { 0.0 } else { JUMP };
        let apart = if self.is_joined(site, unit) { 0.0 } else { APART };
        let above = if self.level[unit] > current { ABOVE } else { 0.0 };
        let [from, to] = [last, unit].map(|u| self.frame.units[u].center.position);
        (cost + jump + apart + above, (to - from).norm())
    }

    /// Among units to begin with: the lowest first, mm.
    fn first(&self, unit: UnitId) -> f64 {
        self.frame.units[unit].center.position.z
    }

    /// How many rods have to be slid under others for a unit and for the best one after it.
    fn count(&self, site: &Site, unit: UnitId) -> f64 {
        let missing = site.missing(unit);
        let now = self.slides(&missing, |rod| site.has(rod));
        let after = |&near: &UnitId| {
            let soon = self.level[near] <= self.level[unit] + 1;
            let rods = site.missing(near).into_iter().filter(|rod| !missing.contains(rod));
            let rods: Vec<RodId> = rods.collect();
            let lies = |rod| site.has(rod) || missing.contains(&rod);
            (soon && !rods.is_empty()).then(|| self.slides(&rods, lies))
        };
        let ahead = self.neighbors.of(unit).iter().filter_map(after).fold(f64::INFINITY, f64::min);
        now + if ahead.is_finite() { ahead / 2.0 } else { 0.0 }
    }

    /// How many contacts go under rods that lie already.
    fn slides(&self, rods: &[RodId], lies: impl Fn(RodId) -> bool) -> f64 {
        let contacts = rods
            .iter()
            .flat_map(|&r| self.frame.rods[r].contacts.iter().map(move |&contact| (r, contact)));
        let slid = contacts.filter(|&(rod, contact)| {
            goes_under(self.frame, contact, rod) && lies(self.frame.contacts[contact].over)
        });
        slid.count() as f64
    }
}
