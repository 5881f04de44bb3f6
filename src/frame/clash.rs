//! Rods that run into each other without being in contact.

use super::axis::Axis;
use super::sizes::{diameter_at, gap_between};
use crate::ids::{Id, IdVec, RodId};
use crate::surface::bvh::{Aabb, Bvh};
use std::collections::BTreeSet;

/// Two rods whose axes are nearer than both radii.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Clash {
    /// The two rods, the lower number first.
    pub rods: [RodId; 2],
    /// Distance of the axes, mm.
    pub distance: f64,
}

/// Axes this much nearer than both radii still pass, as part of them: less, and rods that
/// just touch are clashes by rounding.
const TOUCHING: f64 = 1e-9;

/// All pairs of rods that are nearer than their radii and not in `contacts` (lower number
/// first), in the order of their numbers. `sizes` are the diameters at end A and end B; of
/// rods that taper, those at the nearest points of the axes count.
pub fn clashes(
    axes: &IdVec<RodId, Axis>,
    sizes: &IdVec<RodId, [f64; 2]>,
    contacts: &BTreeSet<[RodId; 2]>,
) -> Vec<Clash> {
    let tree = Bvh::new(&boxes(axes, sizes));
    let mut found = Vec::new();
    for r in axes.ids() {
        for near in clashes_with(r, axes, &tree, sizes) {
            if r < near.0 && !contacts.contains(&[r, near.0]) {
                found.push(Clash { rods: [r, near.0], distance: near.1 });
            }
        }
    }
    found.sort_by_key(|c| c.rods);
    found
}

/// Whether a rod on another axis than its own keeps clear of all rods but those in `except`.
pub fn is_clear(
    (rod, axis): (RodId, &Axis),
    axes: &IdVec<RodId, Axis>,
    sizes: &IdVec<RodId, [f64; 2]>,
    except: &BTreeSet<RodId>,
) -> bool {
    let around = bounds(axis, radius(sizes[rod]));
    axes.enumerate().all(|(r, other)| {
        except.contains(&r)
            || !bounds(other, radius(sizes[r])).overlaps(&around)
            || overlap([axis, other], [sizes[rod], sizes[r]]).is_none()
    })
}

/// The distance of two axes where the rods on them would lie in each other.
fn overlap([first, second]: [&Axis; 2], [one, other]: [[f64; 2]; 2]) -> Option<f64> {
    let ([s, t], distance) = first.nearest(second);
    let gap = gap_between([diameter_at(one, s), diameter_at(other, t)]);
    (distance < gap * (1.0 - TOUCHING)).then_some(distance)
}

/// The radius at the thicker end.
fn radius([a, b]: [f64; 2]) -> f64 {
    a.max(b) / 2.0
}

fn bounds(axis: &Axis, margin: f64) -> Aabb<3> {
    Aabb::around(&[axis.a, axis.b]).grown(margin)
}

fn boxes(axes: &IdVec<RodId, Axis>, sizes: &IdVec<RodId, [f64; 2]>) -> Vec<Aabb<3>> {
    axes.enumerate().map(|(r, axis)| bounds(axis, radius(sizes[r]))).collect()
}

fn clashes_with(
    rod: RodId,
    axes: &IdVec<RodId, Axis>,
    tree: &Bvh<3>,
    sizes: &IdVec<RodId, [f64; 2]>,
) -> Vec<(RodId, f64)> {
    let around = bounds(&axes[rod], radius(sizes[rod]));
    let mut near = Vec::new();
    tree.visit(
        |b| b.overlaps(&around),
        |i| {
            let other = RodId::new(i);
            let pair = [rod, other];
            if let Some(distance) = overlap(pair.map(|r| &axes[r]), pair.map(|r| sizes[r])) {
                near.push((other, distance));
            }
        },
    );
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(offsets: &[f64]) -> IdVec<RodId, Axis> {
        let rod = |&x: &f64| Axis { a: [x, 0.0, 0.0].into(), b: [x, 50.0, 0.0].into() };
        offsets.iter().map(rod).collect()
    }

    #[test]
    fn only_pairs_that_overlap_and_do_not_touch_by_design_clash() {
        let axes = row(&[0.0, 3.0, 5.0, 9.0, 11.9]);
        let id = RodId::new;
        let sizes = vec![[3.0; 2]; axes.len()].into();
        let found = clashes(&axes, &sizes, &BTreeSet::new());
        let pairs: Vec<_> = found.iter().map(|c| c.rods).collect();
        assert_eq!(pairs, [[id(1), id(2)], [id(3), id(4)]]);
        assert!((found[1].distance - 2.9).abs() < 1e-12);
        let known = BTreeSet::from([[id(1), id(2)]]);
        assert_eq!(clashes(&axes, &sizes, &known).len(), 1);
    }

    #[test]
    fn a_new_rod_is_clear_of_all_but_its_partners() {
        let axes = row(&[0.0, 10.0, 90.0]);
        let across = Axis { a: [-5.0, 20.0, 2.0].into(), b: [5.0, 20.0, 2.0].into() };
        let new = (RodId::new(2), &across);
        let sizes = |d: f64| vec![[d; 2]; 3].into();
        assert!(!is_clear(new, &axes, &sizes(3.0), &BTreeSet::new()));
        assert!(is_clear(new, &axes, &sizes(3.0), &BTreeSet::from([RodId::new(0)])));
        assert!(is_clear(new, &axes, &sizes(2.0), &BTreeSet::new()));
    }

    #[test]
    fn rods_are_as_thick_as_they_are_where_they_are_nearest() {
        let along = row(&[0.0]);
        let mut axes = along.clone();
        // Crosses the first at a tenth of its length, 3 mm above it.
        axes.push(Axis { a: [-9.0, 5.0, 3.0].into(), b: [9.0, 5.0, 3.0].into() });
        let clash = |first: [f64; 2], second: [f64; 2]| {
            !clashes(&axes, &vec![first, second].into(), &BTreeSet::new()).is_empty()
        };
        assert!(!clash([2.0; 2], [4.0; 2]) && clash([2.1; 2], [4.0; 2]));
        // 2 mm at a tenth from 1.9 to 2.9, and from 2.1 to 1.1.
        assert!(!clash([1.9, 2.9], [4.0; 2]) && !clash([2.1, 1.1], [4.0; 2]));
        assert!(clash([1.9, 3.0], [4.0; 2]) && clash([2.9, 1.9], [4.0; 2]));
    }
}
