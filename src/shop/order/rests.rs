//! What rods rest on besides each other: the table, and the ground.

use super::Order;
use super::site::Site;
use crate::frame::{End, Frame};
use crate::ids::{IdVec, RodId};
use crate::statics::freedom::{Pose, Row};
use crate::surface::Vector3;

/// Sine of the most that a free end may point upwards and yet lie on the table: 12°. Ends on
/// a flat sheet do, those at the open side of a vault do not.
const POINTS_UP: f64 = 0.2;
/// Ends so near to the ground lie on it, with a wedge below, in diameters.
const WEDGE: f64 = 3.0;

/// Whether a rod's end lies on the ground, or nearly so, without being a foot.
pub fn lies_on_ground(frame: &Frame, rod: RodId, end: End) -> bool {
    frame.end(rod, end).z - frame.ground <= WEDGE * frame.rods[rod].diameter_of(end)
}

/// What a placed rod rests on, as equations.
///
/// In crown order the frame lies on a table with the free ends of its rods, as far as they
/// do not point upwards. There the weight holds them where they are flat, and friction where
/// they are steep: they do not move across the surface. In ground order feet stand firm, and
/// other ends that lie on the ground lie there firmly, too.
pub fn rests(site: &Site, poses: &IdVec<RodId, Pose>, rod: RodId) -> Vec<Row> {
    let pose = &poses[rod];
    let at = |end| site.frame.rods[rod].axis.place_of(end);
    match site.order {
        Order::Crown => {
            let across = across(site, rod);
            let out = |end| if end == End::A { -pose.along.z } else { pose.along.z };
            let lying = site.free_ends(rod).filter(|&end| out(end) <= POINTS_UP);
            lying.map(|end| Row::one(rod, pose.moved(at(end), &across))).collect()
        }
        Order::Ground => resting_ends(site, rod).flat_map(|end| pose.held(rod, at(end))).collect(),
    }
}

/// The ends of a rod that bear on the ground: its foot, or without one those that lie there.
pub fn resting_ends(site: &Site, rod: RodId) -> impl Iterator<Item = End> + use<> {
    let foot = site.foot(rod);
    let bears = |end| foot.map_or_else(|| lies_on_ground(site.frame, rod, end), |f| f == end);
    [End::A, End::B].map(|end| bears(end).then_some(end)).into_iter().flatten()
}

/// Six equations that hold a frame as a whole where it lies on the table, and nothing else:
/// both ends of its first rod, and the far end of one that crosses it.
pub fn anchor(site: &Site, poses: &IdVec<RodId, Pose>) -> Vec<Row> {
    let Some(&first) = site.sequence().first() else { return Vec::new() };
    let (pose, rod) = (&poses[first], &site.frame.rods[first]);
    let mut rows = pose.held(first, 0.0);
    rows.extend(pose.sides().map(|side| Row::one(first, pose.moved(rod.axis.length(), &side))));
    if let Some(&contact) = rod.contacts.iter().find(|&&c| site.made(c)) {
        let seen = site.frame.seen_from(contact, first);
        let partner = &site.frame.rods[seen.partner].axis;
        let far = if seen.at_partner < partner.length() / 2.0 { partner.length() } else { 0.0 };
        let arm = partner.at(far) - rod.axis.at(seen.at);
        let round = pose.along.cross(&arm).normalize();
        rows.push(Row::one(seen.partner, poses[seen.partner].moved(far, &round)));
    }
    rows
}

/// The direction across the surface at a rod: the mean of its contacts' normals.
fn across(site: &Site, rod: RodId) -> Vector3 {
    let r = &site.frame.rods[rod];
    let sum: Vector3 = r.contacts.iter().map(|&c| site.frame.contacts[c].normal).sum();
    let along = r.axis.direction();
    let across = sum - along * sum.dot(&along);
    across.try_normalize(0.0).unwrap_or_else(Vector3::z)
}
