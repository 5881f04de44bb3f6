//! A flat sheet and a saddle: the surfaces on which rods do not rise over each other by
//! themselves.

use super::grid::strip;
use crate::surface::{Mesh, Point3};

/// A square on the ground.
pub struct Flat {
    /// Its side, mm.
    pub side: f64,
}

impl Flat {
    pub const SAMPLE: Self = Self { side: 600.0 };

    pub fn mesh(&self) -> Mesh {
        let side = self.side;
        strip([side, side], side / 50.0, |u, v| {
            Point3::new(side * u - side / 2.0, side * v - side / 2.0, 0.0)
        })
    }
}

/// A hyperbolic paraboloid over a square, high along x.
pub struct Saddle {
    /// Half the side of the square, mm.
    pub half_side: f64,
    /// How far the middle lies above the lowest points of the rim, mm, and the highest
    /// above the middle.
    pub rise: f64,
}

impl Saddle {
    pub const SAMPLE: Self = Self { half_side: 300.0, rise: 80.0 };

    pub fn mesh(&self) -> Mesh {
        strip([620.0, 620.0], 12.5, |u, v| {
            let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
            let z = self.rise * (1.0 + x * x - y * y);
            Point3::new(self.half_side * x, self.half_side * y, z)
        })
    }
}
