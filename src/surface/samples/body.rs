//! Bodies lying on the ground: a peanut and two beetles. Their cross-sections are halves
//! of ellipses along the x axis.

use super::grid::rows;
use crate::surface::{Mesh, Point3};
use std::f64::consts::PI;

/// The upper half of a body from `lo` to `hi` on the x axis; `section(x)` gives half the
/// width, and the height, of its cross-section there.
fn lying(edge: f64, [lo, hi]: [f64; 2], section: impl Fn(f64) -> [f64; 2]) -> Mesh {
    rows(edge, |u, v| {
        let x = lo + (hi - lo) * (1.0 - (PI * u).cos()) / 2.0;
        let [half_width, height] = section(x);
        let (sin, cos) = (PI * v).sin_cos();
        Point3::new(x, -half_width * cos, height * sin)
    })
}

/// A peanut lying on its side: an oval of Cassini turned about its long axis, halved.
///
/// On the oval the product of the distances from two foci, at ±f, is e². With e between
/// f and √2 f it is one curve with a waist.
pub struct Peanut {
    /// Half the length, mm.
    pub half_length: f64,
    /// The ratio e / f: from 1, where the waist closes, to √2, where it vanishes.
    pub fullness: f64,
}

impl Peanut {
    pub const SAMPLE: Self = Self { half_length: 380.0, fullness: 1.14 };

    pub fn mesh(&self) -> Mesh {
        let half = self.half_length;
        lying(13.0, [-half, half], |x| [self.radius(x); 2])
    }

    /// Distance of the oval from its axis, mm.
    pub(super) fn radius(&self, x: f64) -> f64 {
        let ff = self.half_length.powi(2) / (self.fullness.powi(2) + 1.0);
        let ee = self.fullness.powi(2) * ff;
        ((ee * ee + 4.0 * ff * x * x).sqrt() - x * x - ff).max(0.0).sqrt()
    }
}

/// A part of a beetle's body: half an ellipsoid.
pub struct Hump {
    /// Where its middle lies on the x axis, mm.
    pub at: f64,
    /// Half the length, half the width, and the height, mm.
    pub size: [f64; 3],
}

/// A beetle: humps along the x axis that run into each other.
///
/// Width and height are the fourth roots of the sum of the fourth powers of those of the
/// humps. That is nearly the greater of two humps, without a crease between them, and
/// no hump begins with one.
pub struct Bug<const HUMPS: usize> {
    pub humps: [Hump; HUMPS],
    /// Edge length of its mesh, mm.
    pub edge: f64,
}

/// Body and head.
pub const SMALL_BUG: Bug<2> = Bug {
    humps: [
        Hump { at: -60.0, size: [250.0, 205.0, 180.0] },
        Hump { at: 190.0, size: [135.0, 135.0, 115.0] },
    ],
    edge: 13.0,
};

/// Abdomen, thorax and head.
pub const SUPER_BUG: Bug<3> = Bug {
    humps: [
        Hump { at: -190.0, size: [260.0, 215.0, 190.0] },
        Hump { at: 110.0, size: [200.0, 165.0, 155.0] },
        Hump { at: 315.0, size: [125.0, 125.0, 110.0] },
    ],
    edge: 15.0,
};

impl<const HUMPS: usize> Bug<HUMPS> {
    pub fn mesh(&self) -> Mesh {
        let ends = |sign: f64| self.humps.iter().map(move |h| h.at + sign * h.size[0]);
        let lo = ends(-1.0).fold(f64::INFINITY, f64::min);
        let hi = ends(1.0).fold(f64::NEG_INFINITY, f64::max);
        lying(self.edge, [lo, hi], |x| {
            [1, 2].map(|i| {
                let powers = self.humps.iter().map(|h| {
                    let along = (x - h.at) / h.size[0];
                    // The square of the hump's half width or height; none beyond its ends.
                    let square = h.size[i].powi(2) * (1.0 - along * along).max(0.0);
                    square * square
                });
                powers.sum::<f64>().sqrt().sqrt()
            })
        })
    }
}
