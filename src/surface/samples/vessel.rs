//! Vessels with their opening on the ground: a vase upside down, and a scallop.

use super::grid::rings;
use crate::surface::{Mesh, Point3};
use std::f64::consts::TAU;

/// A vase upside down, a pavilion with a round shoulder, a waist and a flaring rim.
///
/// The profile is a Bézier curve of fourth degree. The first two points are equally high,
/// so the top is smooth.
pub struct Vase {
    /// Its points, from the top to the ground: distance from the axis and height, mm.
    pub profile: [[f64; 2]; 5],
}

impl Vase {
    pub const SAMPLE: Self = Self {
        profile: [[0.0, 220.0], [220.0, 220.0], [345.0, 115.0], [205.0, 80.0], [310.0, 0.0]],
    };

    pub fn mesh(&self) -> Mesh {
        rings(13.0, |s, v| {
            let [radius, z] = self.at(s);
            let (sin, cos) = (TAU * v).sin_cos();
            Point3::new(radius * cos, radius * sin, z)
        })
    }

    /// Distance from the axis and height at a parameter from 0 to 1.
    pub(super) fn at(&self, t: f64) -> [f64; 2] {
        let r = 1.0 - t;
        let weights =
            [r.powi(4), 4.0 * r.powi(3) * t, 6.0 * r * r * t * t, 4.0 * r * t.powi(3), t.powi(4)];
        let sum = |i: usize| self.profile.iter().zip(weights).map(|(p, w)| p[i] * w).sum();
        [sum(0), sum(1)]
    }
}

/// A scallop lying on its opening: highest near the hinge, with a rim that fans out in
/// gentle flutes.
///
/// In polar coordinates about the place below the top, the rim is a limaçon
/// R + ΔR cos θ; flutes are added to it in proportion to the square of the distance from
/// the top, and fade towards the hinge at θ = 180°.
pub struct Seashell {
    /// R and ΔR: half the sum, and half the difference, of the distances from below the
    /// top to the far side and to the hinge, mm.
    pub limacon: [f64; 2],
    /// Height of the top, mm.
    pub height: f64,
    /// Slope at the rim of the unfluted shell if it were a sphere, degrees.
    pub rim: f64,
    /// Number of flutes all round, odd so that one points straight ahead.
    pub flutes: u32,
    /// Their depth at the far side, as part of the distance from below the top.
    pub depth: f64,
}

impl Seashell {
    pub const SAMPLE: Self =
        Self { limacon: [245.0, 75.0], height: 220.0, rim: 80.0, flutes: 7, depth: 0.06 };

    pub fn mesh(&self) -> Mesh {
        let rim = self.rim.to_radians();
        rings(13.0, |s, v| {
            let angle = TAU * v;
            let [mean, more] = self.limacon;
            let fade = (1.0 + angle.cos()) / 2.0;
            let flute = self.depth * s * s * (f64::from(self.flutes) * angle).cos() * fade;
            let reach = (mean + more * angle.cos()) * (1.0 + flute);
            let (sin, cos) = (rim * s).sin_cos();
            let out = reach * sin / rim.sin();
            let z = self.height * (cos - rim.cos()) / (1.0 - rim.cos());
            Point3::new(out * angle.cos(), out * angle.sin(), z)
        })
    }
}
