//! What to measure after a step.

use super::site::Site;
use super::{Check, MarkName, Step};
use crate::ids::{ContactId, RodId};
use crate::shop::marks;
use crate::surface::Point3;
use std::collections::BTreeSet;

/// How many distances are measured after a step.
const COUNT: usize = 2;

/// A point that can be named.
struct Named {
    rod: RodId,
    /// The rods that it is fixed to: both of a contact that is made.
    on: Vec<RodId>,
    new: bool,
    mark: String,
    at: Point3,
}

/// Distances between far points round what a step places. Both points of one are never on
/// the same rod, nor on a rod and one tied to it there: such a distance could not be off.
pub fn checks(site: &Site, step: &Step) -> Vec<Check> {
    let points = points(site, step);
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for (i, p) in points.iter().enumerate() {
        for (j, q) in points[..i].iter().enumerate() {
            if (p.new || q.new) && p.on.iter().all(|rod| !q.on.contains(rod)) {
                pairs.push(((p.at - q.at).norm(), [j, i]));
            }
        }
    }
    // The longest first; of those alike as they come.
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<(f64, [usize; 2])> = Vec::new();
    while chosen.len() < COUNT {
        // What lies across the others says more than what lies along them.
        let worth = |&(length, pair): &(f64, [usize; 2])| {
            let along = |[i, j]: [usize; 2]| (points[j].at - points[i].at).normalize();
            let sine = |other: [usize; 2]| along(pair).cross(&along(other)).norm();
            length * chosen.iter().map(|&(_, other)| sine(other)).fold(1.0, f64::min)
        };
        let mut best: Option<(f64, (f64, [usize; 2]))> = None;
        for &pair in &pairs {
            let worth = worth(&pair);
            if best.is_none_or(|best| worth > best.0 * (1.0 + ALIKE)) {
                best = Some((worth, pair));
            }
        }
        match best {
            Some((worth, pair)) if worth > 0.0 => chosen.push(pair),
            _ => break,
        }
    }
    let name = |i: usize| MarkName { rod: points[i].rod, mark: points[i].mark.clone() };
    chosen.iter().map(|&(distance, pair)| Check { marks: pair.map(name), distance }).collect()
}

/// A distance is only better where it is by more than this part: rounding does not decide.
const ALIKE: f64 = 1e-9;

/// The marks of the rods of a step and of those that they touch; where that is one rod only,
/// its ends, too.
fn points(site: &Site, step: &Step) -> Vec<Named> {
    let frame = site.frame;
    let new: BTreeSet<RodId> = step.rods.iter().copied().collect();
    let made = || step.over.iter().chain(&step.under).map(|&c| &frame.contacts[c]);
    let rods: BTreeSet<RodId> =
        new.iter().copied().chain(made().flat_map(|c| [c.over, c.under])).collect();
    let mut points: Vec<Named> = Vec::new();
    let mut seen: BTreeSet<ContactId> = BTreeSet::new();
    for &rod in &rods {
        for mark in marks::marks(frame, rod) {
            let both = site.made(mark.contact);
            if both && !seen.insert(mark.contact) {
                continue;
            }
            let on = if both { vec![rod, mark.partner] } else { vec![rod] };
            let is_new = on.iter().any(|r| new.contains(r));
            let at = frame.rods[rod].axis.at(mark.at);
            points.push(Named { rod, on, new: is_new, mark: mark.letter, at });
        }
    }
    points
}
