//! A stand: the prop that carries a rod at one place, and the brace that keeps it upright.
//!
//! The prop is a board across the rod: it stands upright, at right angles to the rod's heading.
//! A rod of radius r that rises at an angle e cuts the plane of such a board in an ellipse with
//! half axes r and r / cos e. Over the thickness t of the board the ellipse moves up and down by
//! ½ t tan e, so a saddle that clears the rod everywhere is the ellipse of the lower face, and the
//! rod rests on the edge of that face. The saddle is as high on both faces: a prop may stand
//! either way round. What a stand's boards are cut to is in [`Shape`].

use crate::frame::Frame;
use crate::ids::{PropId, RodId, UnitId};
use crate::shop::laser::Point;
use std::f64::consts::FRAC_PI_3;

/// The angle to either side of straight down up to which a saddle follows the rod. From there
/// straight cheeks go on: were they to follow it farther, a rod that is a little thick would jam.
const HOLD: f64 = FRAC_PI_3;
/// How far the cheeks reach above the axis, in radii: they keep the rod from being knocked off.
const CHEEK: f64 = 0.5;
/// How far the straight pieces of a saddle may lie beside its curve, mm.
const FLATNESS: f64 = 0.002;
/// Steepest rod that is propped, radians: steeper ones slide down, and stand by themselves.
const STEEPEST: f64 = FRAC_PI_3;
/// Least measure of what is cut from a board, mm: of thin board tabs would break.
const LEAST_DETAIL: f64 = 2.5;
/// A prop without a brace is at most so many thicknesses high: it stands in its slot by one.
const UNBRACED: f64 = 8.0;
/// Height of a prop over half of its foot.
const SLENDER: f64 = 12.0;
/// What the slots of a prop and its brace are deeper than half the brace, together, mm: the tabs
/// are to reach the plate before they meet.
const LAP_PLAY: f64 = 0.5;

/// Where a prop carries a rod. mm and radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stand {
    /// Its number.
    pub id: PropId,
    /// The rod.
    pub rod: RodId,
    /// The unit that it holds, if it was set for one.
    pub unit: Option<UnitId>,
    /// Where along the rod, from end A.
    pub at: f64,
    /// The point of the axis there, from above.
    pub foot: [f64; 2],
    /// Height of the axis there over the ground, which is the upper side of the plate.
    pub height: f64,
    /// The way in which the rod rises, from above, counter-clockwise from +x.
    pub heading: f64,
    /// The angle at which it rises, 0 to π/2.
    pub slope: f64,
    /// Its radius there.
    pub radius: f64,
}

/// What the boards of a stand are cut to. x runs along the board, y up from the plate.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// Half the width at the foot.
    pub half_foot: f64,
    /// Half the width at the head.
    pub half_head: f64,
    /// The saddle with its cheeks, from left to right; its ends are at the height of the head.
    pub saddle: Vec<Point>,
    /// Height of the saddle's lowest point.
    pub seat: f64,
    /// Height of the brace, if there is one.
    pub brace: Option<f64>,
    /// Where the tabs begin and end, to the right of the middle; they are alike to the left.
    pub tab: [f64; 2],
}

/// The measure that details of a board are sized by, mm.
pub fn detail(thickness: f64) -> f64 {
    thickness.max(LEAST_DETAIL)
}

impl Stand {
    /// A stand under a rod at a distance from its end A; `None` where the rod is too steep.
    pub fn under(frame: &Frame, id: PropId, rod: RodId, at: f64) -> Option<Self> {
        let r = &frame.rods[rod];
        let (point, along) = (r.axis.at(at), r.axis.direction());
        let rising = if along.z < 0.0 { -along } else { along };
        let slope = rising.z.atan2(rising.x.hypot(rising.y));
        (slope <= STEEPEST).then(|| Self {
            id,
            rod,
            unit: None,
            at,
            foot: [point.x, point.y],
            height: point.z - frame.ground,
            heading: rising.y.atan2(rising.x),
            slope,
            radius: r.diameter_at(at) / 2.0,
        })
    }

    /// What its boards are cut to, of board so thick; `None` where it would be too low to cut.
    pub fn shape(&self, thickness: f64) -> Option<Shape> {
        let detail = detail(thickness);
        let saddle = self.saddle(thickness);
        let seat = self.height - self.drop(thickness) - self.radius / self.slope.cos();
        if seat < 3.0 * detail {
            return None;
        }
        let half_head = saddle[saddle.len() - 1][0] + detail;
        let half_foot = half_head.max(4.5 * detail).max(self.height / SLENDER);
        Some(Shape {
            half_foot,
            half_head,
            saddle,
            seat,
            brace: (seat > UNBRACED * thickness).then_some(seat / 2.0),
            tab: [half_foot - 3.0 * detail, half_foot - detail],
        })
    }

    /// How much lower the rod is at the lower face of the board than in its middle.
    fn drop(&self, thickness: f64) -> f64 {
        thickness / 2.0 * self.slope.tan()
    }

    /// The curve that the rod rests in, from left to right.
    fn saddle(&self, thickness: f64) -> Vec<Point> {
        let (r, deep) = (self.radius, self.radius / self.slope.cos());
        let middle = self.height - self.drop(thickness);
        // A chord over an angle 2φ strays from its circle by R (1 − cos φ).
        let chord = 2.0 * (1.0 - FLATNESS / deep).max(0.5).acos();
        let pieces = (2.0 * HOLD / chord).ceil().max(4.0) as usize;
        let point = |i: usize| {
            let turn = HOLD * (2.0 * i as f64 / pieces as f64 - 1.0);
            [r * turn.sin(), middle - deep * turn.cos()]
        };
        let curve = (0..=pieces).map(point);
        // The cheeks are tangents, so a rod that rises from the lower face moves away from them.
        let rise = (CHEEK + HOLD.cos()) / HOLD.sin();
        let half = r * (HOLD.sin() + rise * HOLD.cos());
        let top = middle + CHEEK * deep;
        [[-half, top]].into_iter().chain(curve).chain([[half, top]]).collect()
    }

    /// The way along the prop, and the way along its brace, which is the rod's heading: unit
    /// vectors, from above.
    pub fn ways(&self) -> [[f64; 2]; 2] {
        let (sin, cos) = self.heading.sin_cos();
        [[-sin, cos], [cos, sin]]
    }
}

impl Shape {
    /// Depth of the slot in the foot of the prop, up to which the brace reaches in; that in the
    /// brace goes from its top down to the same height, but for some play.
    pub fn lap(&self) -> Option<f64> {
        self.brace.map(|height| (height + LAP_PLAY) / 2.0)
    }

    /// Half the width of the prop at a height.
    pub fn half_width(&self, y: f64) -> f64 {
        let head = self.saddle[0][1];
        self.half_foot + (self.half_head - self.half_foot) * (y / head).clamp(0.0, 1.0)
    }

    /// The prop's corners without tabs and slot: what other rods must keep clear of.
    pub fn body(&self) -> [Point; 4] {
        let (foot, head, top) = (self.half_foot, self.half_head, self.saddle[0][1]);
        [[-foot, 0.0], [foot, 0.0], [head, top], [-head, top]]
    }

    /// Half the width of the brace at its top.
    pub fn half_brace_head(thickness: f64) -> f64 {
        thickness / 2.0 + detail(thickness)
    }

    /// The same of the brace.
    pub fn brace_body(&self, thickness: f64) -> Option<[Point; 4]> {
        let (foot, head) = (self.half_foot, Self::half_brace_head(thickness));
        self.brace.map(|top| [[-foot, 0.0], [foot, 0.0], [head, top], [-head, top]])
    }
}
