//! Charts of the plane itself: a sheet, and the plane under another chart. They serve
//! pictures of what is laid on a chart before it is wrapped round a surface.

use super::{Chart, SurfacePoint};
use crate::surface::Vector3;
use nalgebra::Point2;

/// A flat sheet: the plane z = 0 between two corners, its border with it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Flat {
    /// The lower corner, mm.
    pub low: Point2<f64>,
    /// The upper corner, mm.
    pub high: Point2<f64>,
}

impl Chart for Flat {
    fn bounds(&self) -> [Point2<f64>; 2] {
        [self.low, self.high]
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        let inside = (0..2).all(|i| self.low[i] <= p[i] && p[i] <= self.high[i]);
        inside.then(|| in_plane(p))
    }
}

/// The plane of another chart: it reaches as far, and has the same holes, but stays flat.
#[derive(Clone, Copy, Debug)]
pub struct Unwrapped<'a, C>(pub &'a C);

impl<C: Chart> Chart for Unwrapped<'_, C> {
    fn bounds(&self) -> [Point2<f64>; 2] {
        self.0.bounds()
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        self.0.lift(p).map(|_| in_plane(p))
    }

    fn crosses_hole(&self, a: Point2<f64>, b: Point2<f64>, half_width: f64) -> bool {
        self.0.crosses_hole(a, b, half_width)
    }
}

/// A point of the plane z = 0, as a place of a surface.
pub fn in_plane(p: Point2<f64>) -> SurfacePoint {
    SurfacePoint { position: [p.x, p.y, 0.0].into(), normal: Vector3::z() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: Flat = Flat { low: Point2::new(-1.0, -2.0), high: Point2::new(3.0, 4.0) };

    #[test]
    fn a_sheet_lifts_its_points_to_themselves_and_ends_at_its_border() {
        for (x, y, inside) in
            [(0.0, 0.0, true), (3.0, 4.0, true), (3.1, 0.0, false), (0.0, -2.1, false)]
        {
            let lifted = SHEET.lift(Point2::new(x, y));
            assert_eq!(lifted.map(|s| s.position), inside.then(|| [x, y, 0.0].into()));
        }
        assert_eq!(SHEET.lift(Point2::new(f64::NAN, 0.0)), None);
    }

    /// A ramp over half of the sheet, with a hole wherever it is asked.
    struct Ramp;

    impl Chart for Ramp {
        fn bounds(&self) -> [Point2<f64>; 2] {
            SHEET.bounds()
        }

        fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
            let position = [p.x, p.y, p.x + 7.0].into();
            SHEET.lift(p).filter(|_| p.x > 0.0).map(|s| SurfacePoint { position, ..s })
        }

        fn crosses_hole(&self, _a: Point2<f64>, _b: Point2<f64>, half_width: f64) -> bool {
            half_width > 1.0
        }
    }

    #[test]
    fn an_unwrapped_chart_is_flat_and_reaches_as_far() {
        let plane = Unwrapped(&Ramp);
        assert_eq!(plane.bounds(), SHEET.bounds());
        assert_eq!(plane.lift(Point2::new(-0.5, 0.0)), None);
        let lifted = plane.lift(Point2::new(0.5, 1.0)).map(|s| s.position);
        assert_eq!(lifted, Some([0.5, 1.0, 0.0].into()));
        let origin = Point2::origin();
        assert!(
            plane.crosses_hole(origin, origin, 2.0) && !plane.crosses_hole(origin, origin, 0.5)
        );
    }
}
