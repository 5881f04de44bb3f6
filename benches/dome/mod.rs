//! A smooth dome for benches.

use nalgebra::Point2;
use rodwright::chart::{Chart, SurfacePoint};
use rodwright::frame::Frame;
use rodwright::frame::canvas::{Canvas, PlaneCanvas};
use rodwright::frame::close::Way;
use rodwright::frame::form::{FormSettings, form, median_rise};
use rodwright::frame::layer::Layering;
use rodwright::frame::share::Share;
use rodwright::pattern::Pattern;
use rodwright::tiling::Placement;

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

/// A frame on a dome that stands on its rim.
#[allow(dead_code, reason = "not every bench has frames that stand")]
pub fn standing_dome(rods: f64) -> Frame {
    let dome = Dome { radius: 300.0, part: 1.0 };
    let pattern = Pattern::named("4.4.4.4").expect("4.4.4.4 is in the library");
    let edge = dome_edge(&dome, rods);
    let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge };
    let canvas = PlaneCanvas::new(&dome, pattern, placement, pattern.usual());
    let canvas = canvas.expect("under a million");
    let (_, diameter) = median_rise(&canvas).expect("there are units");
    // The height of its rim: 3/5 of the radius.
    let settings = settings(diameter, canvas.edge(), 0.6 * dome.radius);
    form(&canvas, &settings).expect("a dome can be built").frame
}

/// How frames of benches are formed; all lengths in mm.
#[allow(dead_code, reason = "not every bench forms frames")]
pub fn settings(diameter: f64, edge: f64, surface_low: f64) -> FormSettings {
    FormSettings {
        sizes: Default::default(),
        diameter,
        overhang: 2.0 * diameter,
        round: 1e-3 * edge,
        share: Share::Off,
        layering: Layering::Auto,
        way: Way::default(),
        surface_low,
    }
}
