//! Border rods that reach down are made long enough to stand on the ground.

use super::axis::Axis;
use super::clash::is_clear;
use super::cut::Steps;
use super::weave::{RodEnd, Weave};
use super::{End, Support};
use crate::ids::{IdVec, RodId};
use std::collections::BTreeSet;

/// Least sine of the slope at which a rod is let down to the ground: 30°. Flatter rods
/// slide out rather than stand, and no saw cuts the long bevel that they would need.
const LEAST_SLOPE: f64 = 0.5;

/// The ground below a frame: the lowest point of the surface, or of the rods where
/// they reach lower.
pub fn ground_level(surface_low: f64, axes: &IdVec<RodId, Axis>) -> f64 {
    axes.iter().flat_map(|axis| [axis.a.z, axis.b.z]).fold(surface_low, f64::min)
}

/// How rods may be let down.
#[derive(Clone, Copy, Debug)]
pub struct Standing<'a> {
    /// Height of the ground, mm.
    pub ground: f64,
    /// Longest piece that may be added to a rod, mm.
    pub reach: f64,
    /// Diameters of the rods at end A and at end B, mm.
    pub sizes: &'a IdVec<RodId, [f64; 2]>,
    /// The only rods that may be; none for all.
    pub among: Option<&'a BTreeSet<RodId>>,
}

/// Lengthens border rods at end A down to the ground, one after the other, where
/// they are steep enough, near enough, and stay clear of all other rods.
pub fn stand(
    weave: &Weave,
    axes: &mut IdVec<RodId, Axis>,
    how: &Standing,
    lengths: &mut Steps,
) -> Vec<Support> {
    let mut supports = Vec::new();
    let may = |r: &RodId| how.among.is_none_or(|among| among.contains(r));
    let free = weave.rods.ids().filter(|&r| weave.rods[r].ends[0] == RodEnd::Free);
    for r in free.filter(may) {
        let Some(longer) = let_down(&axes[r], how, |least| lengths.length(r, least)) else {
            continue;
        };
        if is_clear((r, &longer), axes, how.sizes, &with_partners(weave, r)) {
            axes[r] = longer;
            supports.push(Support { rod: r, end: End::A, point: longer.a });
        }
    }
    supports
}

/// A rod and the rods that it touches.
fn with_partners(weave: &Weave, rod: RodId) -> BTreeSet<RodId> {
    let contacts = weave.rods[rod].contacts.iter().map(|&c| &weave.contacts[c]);
    contacts.flat_map(|c| [c.ending, c.passing]).collect()
}

/// The rod with end A on the ground; what its `length` is above the least one goes to end B.
fn let_down(axis: &Axis, how: &Standing, length: impl FnOnce(f64) -> f64) -> Option<Axis> {
    let down = -axis.direction();
    let height = axis.a.z - how.ground;
    if -down.z < LEAST_SLOPE || height < 0.0 {
        return None;
    }
    let added = height / -down.z;
    if added > how.reach {
        return None;
    }
    let mut foot = axis.at(-added);
    foot.z = how.ground;
    let length = length(added + axis.length());
    Some(Axis { a: foot, b: foot - down * length })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::cut::rounded_up;

    fn down(axis: &Axis) -> Option<Axis> {
        let how = Standing { ground: -1.0, reach: 20.0, sizes: &IdVec::new(), among: None };
        let_down(axis, &how, |least| rounded_up(least, 0.5))
    }

    #[test]
    fn a_steep_rod_comes_to_stand_with_a_round_length() {
        let axis = Axis { a: [0.0, 0.0, 5.0].into(), b: [30.0, 0.0, 45.0].into() };
        let down = down(&axis).unwrap();
        assert_eq!(down.a.z, -1.0);
        assert!((down.length() - 57.5).abs() < 1e-9, "50 and 7.5: {}", down.length());
        assert!((down.direction() - axis.direction()).norm() < 1e-12);
    }

    #[test]
    fn flat_far_and_upward_rods_stay_as_they_are() {
        for (a, b) in [
            ([0.0, 0.0, 5.0], [40.0, 0.0, 9.0]),
            ([0.0, 0.0, 50.0], [0.0, 1.0, 90.0]),
            ([0.0, 0.0, 45.0], [0.0, 0.0, 5.0]),
        ] {
            assert!(down(&Axis { a: a.into(), b: b.into() }).is_none());
        }
    }
}
