//! Exact points of a tiling: integer combinations of the powers of ζ = e^{iπ/12}.
//!
//! ζ is a primitive 24th root of unity, so ζ² = e^{iπ/6} and ζ³ = e^{iπ/4} are
//! both among its powers and the tilings with octagons need no ring of their own.
//! Equality is equality of integers: no tolerance anywhere.

use nalgebra::Point2;
use std::f64::consts::PI;
use std::ops::{Add, Mul, Sub};

/// Number of unit directions: the powers of ζ.
pub const DIRECTIONS: usize = 24;

/// Rank of the ring: the minimal polynomial of ζ is ζ⁸ − ζ⁴ + 1.
const RANK: usize = 8;

/// An element c₀ + c₁ζ + … + c₇ζ⁷ of the ring of integers of the 24th
/// cyclotomic field, in unique form.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Lattice([i64; RANK]);

impl Lattice {
    /// The origin.
    pub const ZERO: Self = Self([0; RANK]);

    /// The unit step ζ^k, which points at 15° · k.
    pub fn root(k: usize) -> Self {
        let k = k % DIRECTIONS;
        let mut c = [0; RANK];
        match k {
            0..8 => c[k] = 1,
            // ζ⁸ = ζ⁴ − 1
            8..12 => {
                c[k - 4] = 1;
                c[k - 8] = -1;
            }
            // ζ¹² = −1
            _ => return Self::ZERO - Self::root(k - 12),
        }
        Self(c)
    }

    /// As a point of the plane.
    pub fn point(self) -> Point2<f64> {
        let mut p = Point2::origin();
        for (k, &c) in self.0.iter().enumerate() {
            let (sin, cos) = (k as f64 * PI / 12.0).sin_cos();
            p.x += c as f64 * cos;
            p.y += c as f64 * sin;
        }
        p
    }
}

impl Add for Lattice {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Lattice {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul<i64> for Lattice {
    type Output = Self;
    fn mul(self, count: i64) -> Self {
        Self(self.0.map(|c| c * count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_the_24_unit_directions() {
        for k in 0..DIRECTIONS {
            let p = Lattice::root(k).point();
            let (sin, cos) = (k as f64 * PI / 12.0).sin_cos();
            assert!((p.x - cos).abs() < 1e-15 && (p.y - sin).abs() < 1e-15, "{k}: {p}");
        }
    }

    #[test]
    fn roots_of_unity_sum_to_nothing() {
        for step in [2, 3, 4, 6, 8, 12] {
            let sum =
                (0..DIRECTIONS).step_by(step).fold(Lattice::ZERO, |sum, k| sum + Lattice::root(k));
            assert_eq!(sum, Lattice::ZERO, "step {step}");
        }
    }

    #[test]
    fn the_root_of_three_is_a_sum_of_two_roots() {
        let p = (Lattice::root(2) + Lattice::root(22)).point();
        assert!((p.x - 3f64.sqrt()).abs() < 1e-15 && p.y.abs() < 1e-15);
    }
}
