//! Rods that run into each other without being in contact.

use super::axis::Axis;
use crate::ids::{Id, IdVec, RodId};
use crate::surface::bvh::{Aabb, Bvh};
use std::collections::BTreeSet;

/// Two rods whose axes are nearer than a rod's diameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Clash {
    /// The two rods, the lower number first.
    pub rods: [RodId; 2],
    /// Distance of the axes, mm.
    pub distance: f64,
}

/// Axes this much nearer than a diameter still pass, as part of the diameter:
/// less, and rods that just touch are clashes by rounding.
const TOUCHING: f64 = 1e-9;

/// All pairs of rods nearer than `diameter` that are not in `contacts` (lower
/// number first), in the order of their numbers.
pub fn clashes(
    axes: &IdVec<RodId, Axis>,
    diameter: f64,
    contacts: &BTreeSet<[RodId; 2]>,
) -> Vec<Clash> {
    let tree = Bvh::new(&boxes(axes, diameter));
    let mut found = Vec::new();
    for (r, axis) in axes.enumerate() {
        for near in clashes_with(axis, axes, &tree, diameter) {
            if r < near.0 && !contacts.contains(&[r, near.0]) {
                found.push(Clash { rods: [r, near.0], distance: near.1 });
            }
        }
    }
    found.sort_by_key(|c| c.rods);
    found
}

/// Whether an axis keeps a diameter from all axes but those in `except`.
pub fn is_clear(
    axis: &Axis,
    axes: &IdVec<RodId, Axis>,
    diameter: f64,
    except: &BTreeSet<RodId>,
) -> bool {
    let around = bounds(axis, diameter);
    axes.enumerate().all(|(r, other)| {
        except.contains(&r)
            || !bounds(other, 0.0).overlaps(&around)
            || axis.distance(other) >= diameter * (1.0 - TOUCHING)
    })
}

fn bounds(axis: &Axis, margin: f64) -> Aabb<3> {
    Aabb::around(&[axis.a, axis.b]).grown(margin)
}

fn boxes(axes: &IdVec<RodId, Axis>, diameter: f64) -> Vec<Aabb<3>> {
    axes.iter().map(|axis| bounds(axis, diameter / 2.0)).collect()
}

fn clashes_with(
    axis: &Axis,
    axes: &IdVec<RodId, Axis>,
    tree: &Bvh<3>,
    diameter: f64,
) -> Vec<(RodId, f64)> {
    let around = bounds(axis, diameter / 2.0);
    let mut near = Vec::new();
    tree.visit(
        |b| b.overlaps(&around),
        |i| {
            let other = RodId::new(i);
            let distance = axis.distance(&axes[other]);
            if distance < diameter * (1.0 - TOUCHING) {
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
        let found = clashes(&axes, 3.0, &BTreeSet::new());
        let pairs: Vec<_> = found.iter().map(|c| c.rods).collect();
        assert_eq!(pairs, [[id(1), id(2)], [id(3), id(4)]]);
        assert!((found[1].distance - 2.9).abs() < 1e-12);
        let known = BTreeSet::from([[id(1), id(2)]]);
        assert_eq!(clashes(&axes, 3.0, &known).len(), 1);
    }

    #[test]
    fn a_new_rod_is_clear_of_all_but_its_partners() {
        let axes = row(&[0.0, 10.0]);
        let across = Axis { a: [-5.0, 20.0, 2.0].into(), b: [5.0, 20.0, 2.0].into() };
        assert!(!is_clear(&across, &axes, 3.0, &BTreeSet::new()));
        assert!(is_clear(&across, &axes, 3.0, &BTreeSet::from([RodId::new(0)])));
        assert!(is_clear(&across, &axes, 2.0, &BTreeSet::new()));
    }
}
