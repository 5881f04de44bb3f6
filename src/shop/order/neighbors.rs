//! Which units are neighbours, and how far they are from where assembly begins.

use super::Order;
use super::rests::lies_on_ground;
use crate::frame::{End, Frame};
use crate::ids::{IdVec, RodId, UnitId};
use std::collections::VecDeque;

/// The cosine of the most that the first unit of a crown may lean from the level: 45°. Steeper,
/// and it does not lie on a table as it lies in the frame.
const LEVEL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The units next to each unit.
pub struct Neighbors {
    around: IdVec<UnitId, Vec<UnitId>>,
}

impl Neighbors {
    /// The neighbours of all units: those that share a rod or touch.
    pub fn new(frame: &Frame) -> Self {
        let mut around: IdVec<UnitId, Vec<UnitId>> = vec![Vec::new(); frame.units.len()].into();
        let mut join = |a: UnitId, b: UnitId| {
            if a != b {
                around[a].push(b);
                around[b].push(a);
            }
        };
        for rod in &frame.rods {
            for (i, &a) in rod.units.iter().enumerate() {
                rod.units[i + 1..].iter().for_each(|&b| join(a, b));
            }
        }
        for contact in &frame.contacts {
            let [over, under] = [contact.over, contact.under].map(|r| &frame.rods[r].units);
            // Rods of one unit touch within it; its neighbours are found above.
            if over.iter().all(|unit| !under.contains(unit)) {
                for &a in over {
                    under.iter().for_each(|&b| join(a, b));
                }
            }
        }
        for units in around.iter_mut() {
            units.sort_unstable();
            units.dedup();
        }
        Self { around }
    }

    /// The units next to a unit, in order.
    pub fn of(&self, unit: UnitId) -> &[UnitId] {
        &self.around[unit]
    }

    /// How many units away each unit is from the nearest of some; none where no way leads.
    fn distances(&self, from: impl Iterator<Item = UnitId>) -> IdVec<UnitId, Option<usize>> {
        let mut distance: IdVec<UnitId, Option<usize>> = vec![None; self.around.len()].into();
        let mut next: VecDeque<(UnitId, usize)> = from.map(|unit| (unit, 0)).collect();
        while let Some((unit, d)) = next.pop_front() {
            if distance[unit].is_none() {
                distance[unit] = Some(d);
                next.extend(self.around[unit].iter().map(|&unit| (unit, d + 1)));
            }
        }
        distance
    }

    /// The rings of the crown, or the rows from the ground up, each with its units. Units to
    /// which no way leads come last.
    pub fn levels(&self, frame: &Frame, order: Order) -> Vec<Vec<UnitId>> {
        let first = match order {
            Order::Crown => self.crown(frame).into_iter().collect(),
            Order::Ground => base(frame),
        };
        let distance = self.distances(first.into_iter());
        let count = distance.iter().flatten().max().map_or(0, |most| most + 1);
        let mut levels = vec![Vec::new(); count];
        let mut apart = Vec::new();
        for (unit, distance) in distance.enumerate() {
            distance.map_or(&mut apart, |d| &mut levels[d]).push(unit);
        }
        levels.push(apart);
        levels
    }

    /// The unit with which a crown begins: the farthest from the border; of several, the
    /// farthest from the feet, and then the highest.
    fn crown(&self, frame: &Frame) -> Option<UnitId> {
        let stands = standing(frame);
        let standing = units_with(frame, |rod| stands[rod]);
        let border = units_with(frame, |rod| frame.rods[rod].border);
        let [feet, border] = [standing, border].map(|units| self.distances(units.into_iter()));
        let height = |unit: UnitId| frame.units[unit].center.position.z;
        frame.units.ids().max_by(|&a, &b| {
            (border[a].cmp(&border[b]))
                .then(feet[a].cmp(&feet[b]))
                .then(height(a).total_cmp(&height(b)))
                .then(b.cmp(&a))
        })
    }

    /// Whether the unit with which a crown begins lies nearly level.
    pub fn has_level_crown(&self, frame: &Frame) -> bool {
        self.crown(frame).is_some_and(|unit| frame.units[unit].center.normal.z > LEVEL)
    }
}

/// The units with which to begin on the ground: those with feet; without any, those with an
/// end on the ground; without such, the lowest.
fn base(frame: &Frame) -> Vec<UnitId> {
    let stands = standing(frame);
    let feet = units_with(frame, |rod| stands[rod]);
    if !feet.is_empty() {
        return feet;
    }
    let lies = |rod| [End::A, End::B].iter().any(|&end| lies_on_ground(frame, rod, end));
    let lying = units_with(frame, lies);
    if !lying.is_empty() {
        return lying;
    }
    let height = |unit: &UnitId| frame.units[*unit].center.position.z;
    frame.units.ids().min_by(|a, b| height(a).total_cmp(&height(b))).into_iter().collect()
}

/// Which rods stand on the ground.
fn standing(frame: &Frame) -> IdVec<RodId, bool> {
    let mut stands: IdVec<RodId, bool> = vec![false; frame.rods.len()].into();
    frame.supports.iter().for_each(|s| stands[s.rod] = true);
    stands
}

/// The units with a rod of some kind.
fn units_with(frame: &Frame, has: impl Fn(RodId) -> bool) -> Vec<UnitId> {
    let units = frame.units.enumerate();
    units.filter(|(_, unit)| unit.rods.iter().any(|&r| has(r))).map(|(id, _)| id).collect()
}
