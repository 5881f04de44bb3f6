//! Convex domes: an igloo, an ellipsoid, a hut with a soft hipped roof.

use super::grid::{revolve, rows};
use crate::surface::{Mesh, Point3, Vector3};
use std::f64::consts::PI;

/// A mesh in place of the upper half of the unit sphere: `place` takes its points.
/// Rows run over the top, from side to side, and close in at both ends of the x axis.
fn over_half_sphere(edge: f64, place: impl Fn(Vector3) -> Point3) -> Mesh {
    rows(edge, |u, v| {
        let ((sin_u, cos_u), (sin_v, cos_v)) = ((PI * u).sin_cos(), (PI * v).sin_cos());
        place(Vector3::new(-cos_u, -sin_u * cos_v, sin_u * sin_v))
    })
}

/// A spherical cap that runs over, with the same tangent, into a rim of smaller
/// radius.
pub struct Igloo {
    /// Radius at the ground, mm.
    pub ground_radius: f64,
    /// Height, mm.
    pub height: f64,
    /// Radius of the rim's arc, mm.
    pub rim_radius: f64,
    /// Slope at the ground, degrees.
    pub foot: f64,
}

impl Igloo {
    pub const SAMPLE: Self =
        Self { ground_radius: 300.0, height: 220.0, rim_radius: 120.0, foot: 82.0 };

    pub fn mesh(&self) -> Mesh {
        let profile = self.profile();
        revolve(profile.length(), 14.0, |s| profile.at(s))
    }

    /// Angles are those of the surface against the ground. Ground radius a, height h, rim
    /// radius r and angle at the ground β are given. With cap radius R and the angle α
    /// where the two arcs meet,
    ///
    /// ```text
    /// (R - r) sin α       = a - r sin β
    /// (R - r) (1 - cos α) = h - r (1 - cos β)
    /// ```
    ///
    /// whose quotient is tan(α / 2).
    pub(super) fn profile(&self) -> TwoArcs {
        let (rim_radius, foot) = (self.rim_radius, self.foot.to_radians());
        let across = self.ground_radius - rim_radius * foot.sin();
        let up = self.height - rim_radius * (1.0 - foot.cos());
        let joint = 2.0 * (up / across).atan();
        TwoArcs { cap_radius: rim_radius + across / joint.sin(), rim_radius, joint, foot }
    }
}

/// The profile of an igloo. Angles in radians.
pub(super) struct TwoArcs {
    pub cap_radius: f64,
    pub rim_radius: f64,
    /// Slope where the arcs meet.
    pub joint: f64,
    /// Slope at the ground.
    pub foot: f64,
}

impl TwoArcs {
    /// Length of the profile from the top to the ground.
    pub fn length(&self) -> f64 {
        self.cap_radius * self.joint + self.rim_radius * (self.foot - self.joint)
    }

    /// Distance from the axis and height above the ground at `s` from the top.
    pub fn at(&self, s: f64) -> [f64; 2] {
        let (big, small) = (self.cap_radius, self.rim_radius);
        let cap = big * self.joint;
        let sink = big - small;
        let (radius, below_top) = if s <= cap {
            let angle = s / big;
            (big * angle.sin(), big * (1.0 - angle.cos()))
        } else {
            let angle = self.joint + (s - cap) / small;
            let (sin, cos) = angle.sin_cos();
            (
                sink * self.joint.sin() + small * sin,
                sink * (1.0 - self.joint.cos()) + small * (1.0 - cos),
            )
        };
        let height = sink * (1.0 - self.joint.cos()) + small * (1.0 - self.foot.cos());
        [radius, height - below_top]
    }
}

/// The top of an ellipsoid with three different axes.
pub struct Ellipsoid {
    /// Half the axes, along x, y and z, mm.
    pub half_axes: [f64; 3],
    /// Height of the cut above the middle, as part of the upright half axis. The lower
    /// it is, the steeper the rim.
    pub cut: f64,
}

impl Ellipsoid {
    pub const SAMPLE: Self = Self { half_axes: [350.0, 240.0, 210.0], cut: 0.15 };

    pub fn mesh(&self) -> Mesh {
        let ([a, b, c], cut) = (self.half_axes, self.cut);
        over_half_sphere(13.0, |p| {
            // The half sphere is pushed up to the part of the sphere above the cut.
            let z = cut + (1.0 - cut) * p.z;
            // √(1 - z²) / √(1 - p.z²) without the quotient of zeros at the top.
            let shrink = ((1.0 - cut) * (1.0 + z) / (1.0 + p.z)).sqrt();
            Point3::new(a * shrink * p.x, b * shrink * p.y, c * (z - cut))
        })
    }
}

/// A hut with leaning walls and a hipped roof, all edges softened.
///
/// With eight planes n·p = h round the hut, p lies inside the sharp-edged one when every
/// n·p / h is at most 1. The soft one takes, instead of the greatest of these figures,
/// the root of the sum of their powers. The larger the power, the sharper the edges.
pub struct Hut {
    /// Half the length and half the width at the ground of the sharp-edged hut, mm.
    pub half_plan: [f64; 2],
    /// Height of its ridge, mm.
    pub ridge_height: f64,
    /// Half the length of its ridge, mm.
    pub half_ridge: f64,
    /// How far the walls lean inwards, degrees from upright.
    pub lean: f64,
    /// Slopes of the roof at the long sides and at the ends, degrees.
    pub slopes: [f64; 2],
    /// The power.
    pub power: f64,
}

impl Hut {
    pub const SAMPLE: Self = Self {
        half_plan: [350.0, 250.0],
        ridge_height: 290.0,
        half_ridge: 157.0,
        lean: 15.0,
        slopes: [38.0, 52.0],
        power: 5.5,
    };

    pub fn mesh(&self) -> Mesh {
        let planes = self.planes();
        over_half_sphere(14.0, |p| {
            let powers = planes.iter().map(|n| n.dot(&p).max(0.0).powf(self.power));
            Point3::from(p / powers.sum::<f64>().powf(1.0 / self.power))
        })
    }

    /// The normals of the planes, divided by their distances from the origin.
    fn planes(&self) -> [Vector3; 8] {
        let wall = self.lean.to_radians().tan();
        let [side, end] = self.slopes.map(|s| s.to_radians().tan());
        let [length, width] = self.half_plan;
        let (top, ridge) = (self.ridge_height, self.half_ridge);
        let round = |s: f64| {
            [
                Vector3::new(s, 0.0, wall) / length,
                Vector3::new(0.0, s, wall) / width,
                Vector3::new(0.0, s * side, 1.0) / top,
                Vector3::new(s * end, 0.0, 1.0) / (top + end * ridge),
            ]
        };
        let [[a, b, c, d], [e, f, g, h]] = [round(1.0), round(-1.0)];
        [a, b, c, d, e, f, g, h]
    }
}
