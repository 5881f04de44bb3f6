//! Whether a stand has room among the rods of the finished frame and the stands that are there
//! already.

use super::stand::{Shape, Stand};
use crate::frame::axis::Axis;
use crate::frame::{Frame, Rod};
use crate::ids::RodId;
use crate::shop::laser::Point;
use crate::surface::Point3;

/// Between a board and a rod that it does not carry, mm: room for fingers' errors, not for
/// fingers.
pub const CLEARANCE: f64 = 1.0;
/// Between the feet of two stands, mm: the plate keeps its strength there.
pub const BETWEEN_FEET: f64 = 3.0;

/// An upright board, without its thickness: a convex polygon in a plane of its own.
pub struct Upright {
    /// The point of the plate that is its origin, from above.
    pub foot: [f64; 2],
    /// The way of its x, from above.
    pub way: [f64; 2],
    /// Its corners, counter-clockwise.
    pub corners: [Point; 4],
}

impl Upright {
    /// A point of the plane in space, over ground of this height.
    pub fn at(&self, [x, y]: Point, ground: f64) -> Point3 {
        let [fx, fy] = self.foot;
        let [ux, uy] = self.way;
        Point3::new(fx + x * ux, fy + x * uy, ground + y)
    }

    /// The distance of an axis from the board, mm.
    pub fn distance(&self, axis: &Axis, ground: f64) -> f64 {
        let [nx, ny] = [-self.way[1], self.way[0]];
        let aside = |p: Point3| (p.x - self.foot[0]) * nx + (p.y - self.foot[1]) * ny;
        let flat = |p: Point3| {
            let (dx, dy) = (p.x - self.foot[0], p.y - self.foot[1]);
            [dx * self.way[0] + dy * self.way[1], p.z - ground]
        };
        let [a, b] = [aside(axis.a), aside(axis.b)];
        if a * b < 0.0 {
            let through = axis.a + (axis.b - axis.a) * (a / (a - b));
            if self.covers(flat(through)) {
                return 0.0;
            }
        }
        let over =
            |p: Point3, off: f64| if self.covers(flat(p)) { off.abs() } else { f64::INFINITY };
        let ends = over(axis.a, a).min(over(axis.b, b));
        let corner = |i: usize| self.at(self.corners[i % 4], ground);
        let side = |i: usize| Axis { a: corner(i), b: corner(i + 1) }.distance(axis);
        (0..4).map(side).fold(ends, f64::min)
    }

    /// Whether a point of the plane lies on the board.
    fn covers(&self, p: Point) -> bool {
        (0..4).all(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % 4]);
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) >= 0.0
        })
    }
}

/// The boards of a stand: the prop, and the brace if it has one.
pub fn boards(stand: &Stand, shape: &Shape, thickness: f64) -> (Upright, Option<Upright>) {
    let [across, along] = stand.ways();
    let upright = |way, corners| Upright { foot: stand.foot, way, corners };
    let brace = shape.brace_body(thickness).map(|corners| upright(along, corners));
    (upright(across, shape.body()), brace)
}

/// Whether a stand passes no rod of the frame, but for the one that it carries.
pub fn clears_rods(frame: &Frame, stand: &Stand, shape: &Shape, thickness: f64) -> bool {
    let (prop, brace) = boards(stand, shape, thickness);
    let reach = shape.half_foot + thickness / 2.0 + CLEARANCE;
    let clear = |board: &Upright, rod: &Rod| {
        let needed = rod.thickest() / 2.0 + thickness / 2.0 + CLEARANCE;
        board.distance(&rod.axis, frame.ground) >= needed
    };
    let pass = |(id, rod): (RodId, &Rod)| {
        if from_above(&rod.axis, stand.foot) > reach + rod.thickest() / 2.0 {
            return true;
        }
        (id == stand.rod || clear(&prop, rod)) && brace.as_ref().is_none_or(|b| clear(b, rod))
    };
    frame.rods.enumerate().all(pass)
}

/// The distance of an axis from a point, both seen from above, mm.
fn from_above(axis: &Axis, [x, y]: [f64; 2]) -> f64 {
    let (dx, dy) = (axis.b.x - axis.a.x, axis.b.y - axis.a.y);
    let (px, py) = (x - axis.a.x, y - axis.a.y);
    let t = ((px * dx + py * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
    // Of an upright axis t is not a number, and its two ends are one.
    let t = if t.is_nan() { 0.0 } else { t };
    (px - t * dx).hypot(py - t * dy)
}

/// The lines on which a stand's boards stand, from above; on the ground, as axes.
pub fn feet(stand: &Stand, shape: &Shape) -> Vec<Axis> {
    let [fx, fy] = stand.foot;
    let line = |[ux, uy]: [f64; 2]| {
        let end = |x: f64| Point3::new(fx + x * ux, fy + x * uy, 0.0);
        Axis { a: end(-shape.half_foot), b: end(shape.half_foot) }
    };
    let [across, along] = stand.ways();
    let brace = shape.brace.map(|_| line(along));
    [line(across)].into_iter().chain(brace).collect()
}

/// Whether the feet of two stands keep apart.
pub fn clears_feet(ours: &[Axis], theirs: &[Axis], thickness: f64) -> bool {
    let apart = |a: &Axis, b: &Axis| a.distance(b) >= thickness + BETWEEN_FEET;
    ours.iter().all(|a| theirs.iter().all(|b| apart(a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOARD: Upright = Upright {
        foot: [10.0, 20.0],
        way: [0.0, 1.0],
        corners: [[-10.0, 0.0], [10.0, 0.0], [5.0, 40.0], [-5.0, 40.0]],
    };

    fn far(a: [f64; 3], b: [f64; 3]) -> f64 {
        BOARD.distance(&Axis { a: a.into(), b: b.into() }, 100.0)
    }

    #[test]
    fn rods_through_beside_and_above_a_board() {
        assert_eq!(far([0.0, 20.0, 110.0], [30.0, 20.0, 110.0]), 0.0);
        // Beside its face, ending there.
        assert!((far([13.0, 20.0, 110.0], [30.0, 20.0, 110.0]) - 3.0).abs() < 1e-12);
        // Above its head.
        assert!((far([0.0, 20.0, 143.0], [30.0, 20.0, 143.0]) - 3.0).abs() < 1e-12);
        // Past its foot, along the face.
        assert!((far([10.0, 34.0, 100.0], [30.0, 34.0, 100.0]) - 4.0).abs() < 1e-12);
        // Through the plane, but beside the head: at height 20 the board is 7.5 wide.
        let slant = far([0.0, 29.5, 120.0], [30.0, 29.5, 120.0]);
        assert!((slant - 2.0 * 40.0 / 40.0_f64.hypot(5.0)).abs() < 1e-9, "{slant}");
    }
}
