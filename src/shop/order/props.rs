//! Where a prop can hold a rod.

use super::Prop;
use crate::frame::Frame;
use crate::ids::{PropId, RodId};
use crate::surface::Vector3;

/// Where props can stand below a rod, from end A, mm, the best place first: outside the holes
/// of its units, in the middle of the longest stretch that is not a side of one. Charlie
/// sticks stand there too: they can be taken away, and the unit's other rods do not press on
/// them.
pub fn places(frame: &Frame, rod: RodId) -> Vec<f64> {
    let r = &frame.rods[rod];
    let mut at: Vec<f64> = r.contacts.iter().map(|&c| frame.seen_from(c, rod).at).collect();
    at.sort_by(f64::total_cmp);
    let stops: Vec<f64> =
        [0.0].into_iter().chain(at.iter().copied()).chain([r.axis.length()]).collect();
    let inside = sides(frame, rod);
    let middle = |pair: &[f64]| (pair[0] + pair[1]) / 2.0;
    let outside = |pair: &&[f64]| {
        let s = middle(pair);
        !inside.iter().any(|side| (side[0]..=side[1]).contains(&s))
    };
    let mut stretches: Vec<&[f64]> = stops.windows(2).filter(outside).collect();
    // Of stretches alike the one nearer to end A: there feet and borders are.
    stretches.sort_by(|a, b| (b[1] - b[0]).total_cmp(&(a[1] - a[0])).then(a[0].total_cmp(&b[0])));
    stretches.into_iter().map(middle).collect()
}

/// The stretches of a rod that are sides of its units' holes.
fn sides(frame: &Frame, rod: RodId) -> Vec<[f64; 2]> {
    let side = |&unit: &crate::ids::UnitId| {
        let circuit = frame.circuit(&frame.units[unit]).iter();
        let mine = circuit.filter(|&&c| {
            let contact = &frame.contacts[c];
            contact.over == rod || contact.under == rod
        });
        let at: Vec<f64> = mine.map(|&c| frame.seen_from(c, rod).at).collect();
        let [from, to] = [f64::min, f64::max].map(|f| at.iter().copied().reduce(f));
        Some([from?, to?])
    };
    frame.rods[rod].units.iter().filter_map(side).collect()
}

/// The prop below a place on a rod, standing on something of this height.
pub fn prop(frame: &Frame, id: PropId, rod: RodId, at: f64, floor: f64) -> Prop {
    let r = &frame.rods[rod];
    let along = r.axis.direction();
    let up = Vector3::z() - along * along.z;
    // A rod that stands upright is held at its side.
    let up = up.try_normalize(UPRIGHT).unwrap_or_else(Vector3::zeros);
    let point = r.axis.at(at) - up * (r.diameter_at(at) / 2.0);
    Prop { id, rod, at, point, height: point.z - floor }
}

/// Sine of the angle from the upright below which a rod has no lower side.
const UPRIGHT: f64 = 1e-6;
