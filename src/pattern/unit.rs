//! The plane geometry of a unit of shared rods (paper, section 3.1 and Fig. 6a).
//!
//! A rod crosses the middle of its tile edge, turned by φ from the line that joins
//! the two unit centres. Its distance from a centre is d = r sin φ, with r the
//! inradius of the tile; so the rods of an N-gon are tangent to a circle of radius
//! d and enclose a regular inner polygon, whose corners are the contacts.

use std::f64::consts::PI;

/// Lengths of a unit in tile edges, along a rod from the tile edge inwards.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UnitShape {
    /// Inradius of the inner polygon; positive in a counter-clockwise unit.
    pub hole: f64,
    /// To the middle of the rod's side of the inner polygon.
    pub middle: f64,
    /// To the contact in which the rod is passed by the one before it.
    pub passing: f64,
    /// To the contact in which the rod ends on the next one.
    pub ending: f64,
}

impl UnitShape {
    /// The unit of a regular tile with `sides` edges of length one; turn φ in radians.
    pub fn new(sides: usize, turn: f64) -> Self {
        let half_angle = PI / sides as f64;
        let r = 0.5 / half_angle.tan();
        let hole = r * turn.sin();
        let middle = r * turn.cos();
        let half_side = hole.abs() * half_angle.tan();
        Self { hole, middle, passing: middle - half_side, ending: middle + half_side }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contacts from the formula against the crossing of two neighbouring rods,
    /// laid out in the plane.
    #[test]
    fn contacts_lie_where_neighbouring_rods_cross() {
        for sides in 3..=12 {
            for degrees in [-20.0f64, 5.0, 17.0, 25.0] {
                let turn = degrees.to_radians();
                let shape = UnitShape::new(sides, turn);
                let step = 2.0 * PI / sides as f64;
                let r = 0.5 / (step / 2.0).tan();
                // Rod k crosses its edge at angle k·step and runs inwards.
                let rod = |k: f64| {
                    let out = nalgebra::Vector2::new((k * step).cos(), (k * step).sin());
                    let axis = nalgebra::Rotation2::new(turn) * -out;
                    (out * r, axis)
                };
                let ((p, u), (q, v)) = (rod(0.0), rod(1.0));
                let s = (q - p).perp(&v) / u.perp(&v);
                let t = (q - p).perp(&u) / u.perp(&v);
                let (ending, passing) = if s > t { (s, t) } else { (t, s) };
                assert!((ending - shape.ending).abs() < 1e-12, "{sides} {degrees}");
                assert!((passing - shape.passing).abs() < 1e-12, "{sides} {degrees}");
                assert!((p.perp(&u).abs() - shape.hole.abs()).abs() < 1e-12);
            }
        }
    }
}
