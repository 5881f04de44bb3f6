//! Simple charts for tests.

use crate::chart::{Chart, SurfacePoint, in_plane};
use nalgebra::Point2;

/// The plane itself, from −5 to 5 either way, and beyond where asked.
pub struct Sheet;

impl Chart for Sheet {
    fn bounds(&self) -> [Point2<f64>; 2] {
        [Point2::new(-5.0, -5.0), Point2::new(5.0, 5.0)]
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        Some(in_plane(p))
    }
}

/// Two flat rooms side by side, joined by a passage one tile wide.
pub struct Rooms;

impl Chart for Rooms {
    fn bounds(&self) -> [Point2<f64>; 2] {
        [Point2::new(-5.0, -5.0), Point2::new(20.0, 5.0)]
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        let room = |x0: f64, x1: f64, y: f64| x0 < p.x && p.x < x1 && p.y.abs() < y;
        (room(-4.6, 4.6, 4.6) || room(4.0, 10.0, 0.6) || room(9.0, 13.6, 2.6)).then(|| in_plane(p))
    }
}
