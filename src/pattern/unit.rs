//! The plane geometry of a unit of shared rods (paper, section 3.1 and Fig. 6a).
//!
//! A rod crosses each edge of a tile. Neighbouring rods cross in a contact, where the
//! one that comes to it later ends; the contacts are the corners of the unit's inner
//! polygon. In a regular tile of inradius r, with rods through the middles of its edges
//! and turned by φ from the way to the centre, that polygon is regular and has the
//! inradius r sin φ. The same construction serves tiles that are not regular.

use nalgebra::{Point2, Vector2};

/// A rod as a tile sees it: where it crosses the tile's edge, and the way inwards.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    /// Where it crosses the edge.
    pub at: Point2<f64>,
    /// The way into the tile, of any length but zero.
    pub inward: Vector2<f64>,
}

/// A unit in the plane of its tile.
#[derive(Clone, PartialEq, Debug)]
pub struct FlatUnit {
    /// Contact i lies between rods i and i + 1.
    pub contacts: Vec<Point2<f64>>,
    /// For each rod, the middle of its side of the inner polygon.
    pub middles: Vec<Point2<f64>>,
    /// Whether rod i + 1 ends on rod i, as in a counter-clockwise unit; else rod i ends
    /// on rod i + 1.
    pub counter_clockwise: bool,
}

impl FlatUnit {
    /// The unit of the rods of a tile, counter-clockwise; `None` where they do not run
    /// round in one circuit, as in tiles that are far from regular.
    pub fn new(rods: &[Line]) -> Option<Self> {
        let n = rods.len();
        // For each contact how far along both rods it lies.
        let mut along = Vec::with_capacity(n);
        for i in 0..n {
            let (p, q) = (rods[i], rods[(i + 1) % n]);
            let apart = q.at - p.at;
            let cross = p.inward.perp(&q.inward);
            along.push([apart.perp(&q.inward) / cross, apart.perp(&p.inward) / cross]);
        }
        let counter_clockwise = along.first().map(|[s, t]| s < t)?;
        let mut middles = Vec::with_capacity(n);
        for i in 0..n {
            let (before, after) = (along[(i + n - 1) % n][1], along[i][0]);
            let in_circuit = if counter_clockwise { after < before } else { before < after };
            if !(in_circuit && before.is_finite() && after.is_finite()) {
                return None;
            }
            middles.push(rods[i].at + rods[i].inward * ((before + after) / 2.0));
        }
        let same_way = |[s, t]: &[f64; 2]| if counter_clockwise { s < t } else { t < s };
        if !along.iter().all(same_way) {
            return None;
        }
        let contacts = rods.iter().zip(&along).map(|(r, [s, _])| r.at + r.inward * *s).collect();
        Some(Self { contacts, middles, counter_clockwise })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation2;
    use std::f64::consts::PI;

    /// The rods of a polygon given by its corners, through the middles of its edges,
    /// turned from the way to its middle.
    fn rods(corners: &[[f64; 2]], turn: f64) -> Vec<Line> {
        let n = corners.len();
        let sum = corners.iter().fold(Vector2::zeros(), |s, &c| s + Vector2::from(c));
        let middle = Point2::from(sum / n as f64);
        let rod = |i: usize| {
            let at = nalgebra::center(&corners[i].into(), &corners[(i + 1) % n].into());
            Line { at, inward: Rotation2::new(turn) * (middle - at) }
        };
        (0..n).map(rod).collect()
    }

    fn regular(sides: usize) -> Vec<[f64; 2]> {
        let radius = 0.5 / (PI / sides as f64).sin();
        let corner = |k: usize| {
            let (sin, cos) = (2.0 * PI * k as f64 / sides as f64).sin_cos();
            [radius * cos, radius * sin]
        };
        (0..sides).map(corner).collect()
    }

    /// Closed forms for a regular tile: inner polygon of inradius r sin φ about the
    /// centre, whose sides have their middles r cos φ along the rods.
    #[test]
    fn units_of_regular_tiles_are_regular() {
        for sides in 3..=12 {
            for degrees in [-20.0f64, 5.0, 17.0, 25.0] {
                let turn = degrees.to_radians();
                let lines = rods(&regular(sides), turn);
                let unit = FlatUnit::new(&lines).expect("a regular tile");
                let r = 0.5 / (PI / sides as f64).tan();
                let corner = r * turn.sin().abs() / (PI / sides as f64).cos();
                assert_eq!(unit.counter_clockwise, turn > 0.0);
                for contact in &unit.contacts {
                    assert!((contact.coords.norm() - corner).abs() < 1e-12);
                }
                for (middle, line) in unit.middles.iter().zip(&lines) {
                    let along = (middle - line.at).norm();
                    assert!((along - r * turn.cos()).abs() < 1e-12, "{sides} {degrees}");
                    assert!((middle.coords.norm() - r * turn.sin().abs()).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn uneven_tiles_have_units_and_hopeless_ones_none() {
        let brick = [[0.0, 0.0], [3.0, 0.0], [3.2, 1.0], [-0.1, 1.1]];
        let unit = FlatUnit::new(&rods(&brick, 0.3)).expect("a brick");
        assert!(unit.counter_clockwise && unit.contacts.len() == 4);
        let spike = [[0.0, 0.0], [10.0, 0.0], [10.0, 0.1], [9.9, 5.0], [9.8, 0.1]];
        assert_eq!(FlatUnit::new(&rods(&spike, 0.3)), None);
        assert_eq!(FlatUnit::new(&[]), None);
        let parallel = Line { at: Point2::origin(), inward: Vector2::x() };
        assert_eq!(FlatUnit::new(&[parallel; 3]), None);
    }
}
