//! Surfaces that are open at both ends: a barrel vault, a free-form hall, a footbridge.

use super::grid::{rows, strip};
use crate::surface::{Mesh, Point3};

/// A barrel vault: an arc of a circle, drawn along x.
pub struct Vault {
    /// Along x, mm.
    pub length: f64,
    /// Across at the ground, mm.
    pub width: f64,
    /// The arc to either side of the top, degrees.
    pub reach: f64,
}

impl Vault {
    pub const SAMPLE: Self = Self { length: 600.0, width: 400.0, reach: 80.0 };

    pub fn mesh(&self) -> Mesh {
        let reach = self.reach.to_radians();
        let radius = self.width / 2.0 / reach.sin();
        strip([self.length, 2.0 * reach * radius], 12.0, |u, v| {
            let (sin, cos) = (reach * (2.0 * v - 1.0)).sin_cos();
            Point3::new(self.length * (u - 0.5), radius * sin, radius * (cos - reach.cos()))
        })
    }
}

/// A hall whose cross-sections are arcs of ellipses; width and height swell along it,
/// most a little past its middle.
pub struct TrainStation {
    /// Along x, mm.
    pub length: f64,
    /// Half the greatest width at the ground, mm.
    pub half_width: f64,
    /// Greatest height, mm.
    pub height: f64,
    /// The arc to either side of the top, degrees.
    pub reach: f64,
}

impl TrainStation {
    pub const SAMPLE: Self = Self { length: 900.0, half_width: 225.0, height: 220.0, reach: 80.0 };

    pub fn mesh(&self) -> Mesh {
        let reach = self.reach.to_radians();
        strip([self.length, 610.0], 15.0, |u, v| {
            let swell = (0.75 * (u - 0.55)).cos().powi(3);
            let (half_width, height) = (self.half_width * swell, self.height * swell);
            let (sin, cos) = (reach * (2.0 * v - 1.0)).sin_cos();
            let y = half_width * sin / reach.sin();
            let z = height * (cos - reach.cos()) / (1.0 - reach.cos());
            Point3::new(self.length * (u - 0.5), y, z)
        })
    }
}

/// An arched footbridge: part of a ring of round section, curved along and across, both
/// ends cut level on the ground, narrower in the middle.
pub struct Bridge {
    /// Radius of the crown line, mm.
    pub arch_radius: f64,
    /// The arch to either side of the middle, at the corners, degrees.
    pub reach: f64,
    /// Radius across, mm.
    pub deck_radius: f64,
    /// Half the arc across, degrees: in the middle and at the ends.
    pub half_arc: [f64; 2],
}

impl Bridge {
    pub const SAMPLE: Self =
        Self { arch_radius: 520.0, reach: 50.0, deck_radius: 230.0, half_arc: [40.0, 54.0] };

    pub fn mesh(&self) -> Mesh {
        let [middle, end] = self.half_arc.map(f64::to_radians);
        // Distance from the arch's axis, at an angle across.
        let out = |across: f64| self.arch_radius + self.deck_radius * (across.cos() - 1.0);
        let ground = out(end) * self.reach.to_radians().cos();
        rows(13.0, |u, v| {
            let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
            // Each lengthwise line ends at the angle at which it meets the ground.
            let along = x * (ground / out(end * y)).acos();
            let across = y * (middle + (end - middle) * x * x);
            let r = out(across);
            Point3::new(r * along.sin(), self.deck_radius * across.sin(), r * along.cos() - ground)
        })
    }
}
