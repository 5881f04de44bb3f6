//! The shape of a rod: a cylinder or part of a cone, its ends cut square, or level where it
//! stands on the ground.
//!
//! Shapes are told apart from places: a shape has radius 1 at end A, where its axis begins,
//! and length 1, so that rods that are cut alike share it.

use super::structure::{EndName, RodEntry, Structure};
use crate::surface::{Point3, Vector3};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Sides of the prism that stands for a round rod: smooth to the eye when a rod
/// fills the screen's height, 92 triangles.
pub(super) const SIDES: u16 = 24;

/// The shape of a rod.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct RodShape {
    /// The radius at end B as part of that at end A.
    pub taper: f64,
    /// How far the cuts at ends A and B reach along the rod on its upper side, for a
    /// radius of 1, in rod lengths: 0 for one that is square. On the lower side they reach
    /// as far the other way.
    pub slopes: [f64; 2],
}

/// A rod that rises by less than this is left square at its foot, sine of the angle: a level
/// cut of one that hardly rises would run along its side.
const LEAST_RISE: f64 = 0.1;
/// Level cuts reach along at most this part of the rod; longer ones are left square.
const LONGEST_CUT: f64 = 0.4;
/// Slopes are rounded to this, in rod lengths, so that rods cut alike up to the noise of
/// arithmetic share a shape: half a micrometre off on a rod of a metre.
const SLOPE_STEP: f64 = 1e-6;
/// A rod that leans by less than this has no upper side, sine of the angle.
const UPRIGHT: f64 = 1e-9;

/// The shapes of a structure's rods.
pub(super) struct RodShapes {
    /// The different ones, in the order of the first rods that have them.
    pub all: Vec<RodShape>,
    /// Which one each rod has.
    pub of: Vec<usize>,
}

impl RodShapes {
    pub fn new(structure: &Structure) -> Self {
        let mut level: HashMap<&str, [bool; 2]> = HashMap::new();
        for support in &structure.supports {
            level.entry(&support.rod).or_default()[usize::from(support.end == EndName::B)] = true;
        }
        let mut all = Vec::new();
        let mut places: HashMap<[u64; 3], usize> = HashMap::new();
        let mut place = |rod: &RodEntry| {
            let level = level.get(rod.id.as_str()).copied().unwrap_or_default();
            let shape = RodShape::new(rod, structure.diameters(rod), level);
            let [a, b] = shape.slopes;
            *places.entry([shape.taper, a, b].map(f64::to_bits)).or_insert_with(|| {
                all.push(shape);
                all.len() - 1
            })
        };
        let of = structure.rods.iter().map(&mut place).collect();
        Self { all, of }
    }
}

impl RodShape {
    fn new(rod: &RodEntry, [a, b]: [f64; 2], level: [bool; 2]) -> Self {
        let axis = Point3::from(rod.b) - Point3::from(rod.a);
        let rise = axis.z / axis.norm();
        // A level plane through an end: r · cos(lean) across, −r · cot along, on the upper side.
        let slope = -(a / 2.0) / axis.norm() * (1.0 - rise * rise).max(0.0).sqrt() / rise;
        let slope = (slope / SLOPE_STEP).round() * SLOPE_STEP + 0.0;
        let cut = rise.abs() >= LEAST_RISE && slope.abs() * (b / a).max(1.0) <= LONGEST_CUT;
        Self { taper: b / a, slopes: level.map(|level| if level && cut { slope } else { 0.0 }) }
    }

    /// The corners round an end, A or B: how far each lies along the rod, in rod lengths, and
    /// across it, upward and sideways, in radii of end A.
    pub fn rim(&self, end: usize) -> impl Iterator<Item = [f64; 3]> + use<> {
        let Self { taper, slopes } = *self;
        (0..SIDES).map(move |i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(SIDES)).sin_cos();
            // Sines of multiples of a right angle are zero up to noise.
            let [cos, sin] = [cos, sin].map(|x| if x.abs() < 1e-9 { 0.0 } else { x });
            // The plane, along = end + slope · radius · cos, meets the side, whose radius is
            // 1 + (taper − 1) · along.
            let lean = slopes[end] * cos;
            let along = (end as f64 + lean) / (1.0 - lean * (taper - 1.0));
            let radius = 1.0 + (taper - 1.0) * along;
            [along, radius * cos, radius * sin]
        })
    }
}

/// Across a rod: upward as far as that is possible, and sideways, so that along, upward and
/// sideways are right-handed. `along` is a unit vector, `up` the vertical.
pub(super) fn across(along: &Vector3, up: &Vector3) -> [Vector3; 2] {
    let upward = up - along * along.dot(up);
    let upward = upward.try_normalize(UPRIGHT).unwrap_or_else(|| {
        // The axis that lies farthest from the rod's gives a direction across it.
        Vector3::ith(along.iamin(), 1.0).cross(along).normalize()
    });
    [upward, along.cross(&upward)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture::circuit;
    use crate::shop::lengths::classes;

    fn structure() -> Structure {
        let frame = circuit(5, 8.0);
        Structure::from_frame(&frame, &classes(&frame), &[])
    }

    /// Where the corners of an end lie, mm.
    fn corners(s: &Structure, rod: usize, shape: RodShape, end: usize) -> Vec<Point3> {
        let entry = &s.rods[rod];
        let axis = Point3::from(entry.b) - Point3::from(entry.a);
        let [upward, sideways] = across(&axis.normalize(), &Vector3::z());
        let radius = s.diameters(entry)[0] / 2.0;
        let place = |[along, up, side]: [f64; 3]| {
            Point3::from(entry.a) + axis * along + (upward * up + sideways * side) * radius
        };
        shape.rim(end).map(place).collect()
    }

    #[test]
    fn feet_are_level_on_the_ground_and_other_ends_square() {
        for (taper, swapped) in [(1.0, false), (0.7, false), (1.4, false), (1.0, true), (0.7, true)]
        {
            let mut s = structure();
            for rod in &mut s.rods {
                rod.diameter = Some([8.0, 8.0 * taper].into());
                if swapped {
                    (rod.a, rod.b) = (rod.b, rod.a);
                }
            }
            for support in &mut s.supports {
                support.end = if swapped { EndName::B } else { EndName::A };
            }
            let shapes = RodShapes::new(&s);
            let foot = usize::from(swapped);
            for (i, rod) in s.rods.iter().enumerate() {
                let shape = shapes.all[shapes.of[i]];
                assert!(shape.slopes[foot] != 0.0 && shape.slopes[1 - foot] == 0.0);
                for corner in corners(&s, i, shape, foot) {
                    assert!((corner.z - s.ground).abs() < 1e-4, "{corner}");
                    let [a, b] = [rod.a, rod.b].map(Point3::from);
                    let along = (corner - a).dot(&(b - a).normalize());
                    let off = (corner - a - (b - a).normalize() * along).norm();
                    let radius = 4.0 + 4.0 * (taper - 1.0) * along / (b - a).norm();
                    assert!((off - radius).abs() < 1e-9, "on the side of the rod");
                }
            }
        }
    }

    #[test]
    fn rods_that_are_cut_alike_share_a_shape() {
        let mut s = structure();
        assert_eq!(RodShapes::new(&s).all.len(), 1, "a regular circuit");
        s.supports.remove(2);
        let shapes = RodShapes::new(&s);
        assert_eq!((shapes.all.len(), shapes.of), (2, vec![0, 0, 1, 0, 0]));
        s.rods[1].diameter = Some([8.0, 4.0].into());
        assert_eq!(RodShapes::new(&s).all.len(), 3);
    }

    #[test]
    fn rods_that_hardly_rise_are_left_square() {
        let mut s = structure();
        s.rods[0].b = [s.rods[0].a[0] + 90.0, s.rods[0].a[1], s.rods[0].a[2] + 5.0];
        s.rods[1].b = [s.rods[1].a[0] + 4.0, s.rods[1].a[1], s.rods[1].a[2] + 2.0];
        let shapes = RodShapes::new(&s);
        for rod in [0, 1] {
            assert_eq!(shapes.all[shapes.of[rod]].slopes, [0.0; 2]);
        }
    }

    #[test]
    fn across_is_right_handed_also_straight_up() {
        for along in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, 0.0, 0.8], [0.0, -1.0, 0.0]] {
            let along = Vector3::from(along);
            let [upward, sideways] = across(&along, &Vector3::z());
            assert!((along.cross(&upward) - sideways).norm() < 1e-12);
            assert!((upward.norm() - 1.0).abs() < 1e-12 && upward.dot(&along).abs() < 1e-12);
            assert!(upward.z >= -1e-12);
        }
    }
}
