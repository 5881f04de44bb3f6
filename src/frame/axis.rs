//! Straight axes in space, and how two of them cross.

use super::End;
use crate::surface::{Point3, Vector3};

/// The axis of a rod: a straight line between two ends, mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Axis {
    /// End A.
    pub a: Point3,
    /// End B.
    pub b: Point3,
}

/// How two axes, taken as infinite lines, pass each other.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Crossing {
    /// From end A of the first axis to its nearest point, mm along the axis.
    pub at_first: f64,
    /// The same on the second axis.
    pub at_second: f64,
    /// Unit vector across both axes, on the outer side of the surface.
    pub across: Vector3,
    /// Height of the first axis over the second along `across`, mm.
    pub rise: f64,
}

/// Sine of the angle between two axes below which they count as parallel: their
/// nearest points are then known to fewer than eight digits.
const PARALLEL: f64 = 1e-8;

impl Axis {
    /// Length, mm.
    pub fn length(&self) -> f64 {
        (self.b - self.a).norm()
    }

    /// Unit direction from A to B.
    pub fn direction(&self) -> Vector3 {
        (self.b - self.a) / self.length()
    }

    /// Two unit vectors across it, at right angles to each other.
    pub fn sides(&self) -> [Vector3; 2] {
        let u = self.direction();
        // From the axis of space that it is farthest from, so that nothing cancels.
        let other = Vector3::ith(u.iamin(), 1.0);
        let first = u.cross(&other).normalize();
        [first, u.cross(&first)]
    }

    /// How far end A and end B lie from those of another axis, mm.
    pub fn moves_to(&self, other: &Self) -> [f64; 2] {
        [(other.a - self.a).norm(), (other.b - self.b).norm()]
    }

    /// The point at a distance from end A, mm; beyond the ends too.
    pub fn at(&self, distance: f64) -> Point3 {
        self.a + self.direction() * distance
    }

    /// The position of an end.
    pub fn end(&self, end: End) -> Point3 {
        match end {
            End::A => self.a,
            End::B => self.b,
        }
    }

    /// How far an end is from end A, mm.
    pub fn place_of(&self, end: End) -> f64 {
        match end {
            End::A => 0.0,
            End::B => self.length(),
        }
    }

    /// The part of the line between two distances from end A, mm.
    pub fn between(&self, from: f64, to: f64) -> Self {
        Self { a: self.at(from), b: self.at(to) }
    }

    /// How this axis passes `other`, with `outward` telling which side is up;
    /// `None` when they are parallel.
    pub fn cross(&self, other: &Self, outward: &Vector3) -> Option<Crossing> {
        self.cross_along(other, [&self.direction(), &other.direction()], outward)
    }

    /// The same, given the directions of both axes.
    pub fn cross_along(
        &self,
        other: &Self,
        [u, v]: [&Vector3; 2],
        outward: &Vector3,
    ) -> Option<Crossing> {
        let normal = u.cross(v);
        let sine = normal.norm();
        if sine.is_nan() || sine < PARALLEL {
            return None;
        }
        let across = normal / if normal.dot(outward) < 0.0 { -sine } else { sine };
        let apart = other.a - self.a;
        Some(Crossing {
            at_first: apart.cross(v).dot(&normal) / (sine * sine),
            at_second: apart.cross(u).dot(&normal) / (sine * sine),
            across,
            rise: -apart.dot(&across),
        })
    }

    /// The point half-way between the nearest points of two axes as infinite lines; `None`
    /// when they are parallel.
    pub fn middle(&self, other: &Self, outward: &Vector3) -> Option<Point3> {
        let x = self.cross(other, outward)?;
        Some(nalgebra::center(&self.at(x.at_first), &other.at(x.at_second)))
    }

    /// The distance between two axes as segments, mm.
    pub fn distance(&self, other: &Self) -> f64 {
        self.nearest(other).1
    }

    /// Where two axes as segments are nearest, as shares of both from end A, and how near,
    /// mm (Ericson, *Real-Time Collision Detection*, 5.1.9).
    pub fn nearest(&self, other: &Self) -> ([f64; 2], f64) {
        let (d1, d2, r) = (self.b - self.a, other.b - other.a, self.a - other.a);
        let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
        let (b, c) = (d1.dot(&d2), d1.dot(&r));
        let denominator = a * e - b * b;
        let mut s = if denominator > PARALLEL * PARALLEL * a * e {
            ((b * f - c * e) / denominator).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let mut t = (b * s + f) / e;
        if t < 0.0 {
            t = 0.0;
            s = (-c / a).clamp(0.0, 1.0);
        } else if t > 1.0 {
            t = 1.0;
            s = ((b - c) / a).clamp(0.0, 1.0);
        }
        ([s, t], ((self.a + d1 * s) - (other.a + d2 * t)).norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axis(a: [f64; 3], b: [f64; 3]) -> Axis {
        Axis { a: a.into(), b: b.into() }
    }

    #[test]
    fn two_crossed_sticks() {
        let first = axis([-1.0, 0.0, 5.0], [3.0, 0.0, 5.0]);
        let second = axis([0.0, -2.0, 1.0], [0.0, 2.0, 1.0]);
        let c = first.cross(&second, &Vector3::z()).unwrap();
        assert_eq!((c.at_first, c.at_second, c.rise), (1.0, 2.0, 4.0));
        assert_eq!(second.cross(&first, &Vector3::z()).unwrap().rise, -4.0);
        assert_eq!(first.cross(&second, &-Vector3::z()).unwrap().rise, -4.0);
        assert!(first.cross(&first, &Vector3::z()).is_none());
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        proptest::array::uniform3(-5.0..5.0f64)
    }

    proptest! {
        #[test]
        fn nearest_points_are_across_both(a in point(), b in point(), c in point(), d in point()) {
            let (first, second) = (axis(a, b), axis(c, d));
            prop_assume!(first.direction().cross(&second.direction()).norm() > 0.01);
            let x = first.cross(&second, &Vector3::z()).unwrap();
            let apart = first.at(x.at_first) - second.at(x.at_second);
            prop_assert!((apart - x.across * x.rise).norm() < 1e-9);
            prop_assert!(apart.dot(&first.direction()).abs() < 1e-9);
        }

        #[test]
        fn segments_are_as_near_as_their_nearest_samples(a in point(), b in point(), c in point(), d in point()) {
            let (first, second) = (axis(a, b), axis(c, d));
            prop_assume!(first.length() > 0.1 && second.length() > 0.1);
            let mut least = f64::INFINITY;
            for i in 0..=60 {
                for j in 0..=60 {
                    let p = first.a + (first.b - first.a) * (i as f64 / 60.0);
                    let q = second.a + (second.b - second.a) * (j as f64 / 60.0);
                    least = least.min((p - q).norm());
                }
            }
            let exact = first.distance(&second);
            prop_assert!(exact <= least + 1e-9);
            prop_assert!(least <= exact + (first.length() + second.length()) / 60.0);
        }
    }
}
