//! A smooth dome for benches.

use nalgebra::Point2;
use rodwright::chart::{Chart, SurfacePoint};

/// A dome: the part of a sphere of this radius, mm, whose stereographic picture lies within a
/// disk of this part of it.
pub struct Dome {
    pub radius: f64,
    pub part: f64,
}

impl Chart for Dome {
    fn bounds(&self) -> [Point2<f64>; 2] {
        let r = self.radius * self.part;
        [Point2::new(-r, -r), Point2::new(r, r)]
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        let q = p.coords / self.radius;
        let far = q.norm_squared();
        // The plane touches the sphere at the top; from the opposite pole it is twice as far.
        let down = 1.0 + far / 4.0;
        let normal = nalgebra::Vector3::new(q.x, q.y, 1.0 - far / 4.0) / down;
        (far <= self.part * self.part)
            .then(|| SurfacePoint { position: (normal * self.radius).into(), normal })
    }
}

/// The tile edge, mm, at which a pattern of squares covers the dome with about so many rods.
pub fn dome_edge(dome: &Dome, rods: f64) -> f64 {
    // Two rods a tile, and some less at the rim.
    let area = std::f64::consts::PI * (dome.radius * dome.part).powi(2);
    (2.0 * area / rods).sqrt() * (1.0 - 0.9 / rods.sqrt())
}
