//! What the units are wanted to look like, as an energy (paper, section 5.2).
//!
//! With V the corners of a unit's inner polygon and e the mean tile edge,
//!
//! ```text
//! E = 5 F2² + F3² + F4²
//! F2 = (mean of V − place)·n / e,  F3 = cos θ − cos θ⁰,  F4 = (|Vᵢ₊₁ − Vᵢ| − ρᵢ l) / e,
//! ```
//!
//! where l is the mean side of the unit as it is. So a unit keeps its shape but not its
//! size: on a surface of given curvature the sides have to suit the diameter.
//!
//! The paper takes the corners at the ends of the rods. Then ends slide along their own
//! rods, F3 and F4 vanish without any rod coming to lie elsewhere, and contacts drift off
//! the rods. Here the corners are the contacts, midway between the two axes.

use super::touch::middle;
use crate::chart::SurfacePoint;
use crate::frame::axis::Axis;
use crate::frame::gaps::Joint;
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::{Point3, Vector3};
use serde::Serialize;

/// The inner polygon of a unit as it is wanted.
#[derive(Clone, PartialEq, Debug)]
pub struct Circuit {
    /// Its corners, in order.
    pub contacts: Vec<ContactId>,
    /// The place of the surface where its middle belongs, mm, and n, the unit vector that is
    /// up there.
    pub place: SurfacePoint,
    /// cos θ⁰ at each corner.
    pub cosines: Vec<f64>,
    /// ρ: the side from each corner to the next, as part of the mean side; n in all.
    pub sides: Vec<f64>,
}

/// Sums of squares over all units; numbers without a unit.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Energy {
    /// F2: middles off the surface, in tile edges.
    pub places: f64,
    /// F3: cosines of the inner polygons' angles.
    pub angles: f64,
    /// F4: sides of the inner polygons, in tile edges.
    pub sides: f64,
}

/// Weights of the terms.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Weights {
    /// Of F2².
    pub places: f64,
    /// Of F3².
    pub angles: f64,
    /// Of F4².
    pub sides: f64,
}

impl Weights {
    /// Those of E (paper, section 5.2).
    pub const PAPER: Self = Self { places: 5.0, angles: 1.0, sides: 1.0 };

    /// Terms that are larger than `wanted` weigh more, by the square of how many times they
    /// are, at most `most` times.
    pub fn by_excess(&self, now: &Energy, wanted: &Energy, most: f64) -> Self {
        let by = |weight: f64, now: f64, wanted: f64| {
            weight * if now > wanted { (now / wanted).min(most).powi(2) } else { 1.0 }
        };
        Self {
            places: by(self.places, now.places, wanted.places),
            angles: by(self.angles, now.angles, wanted.angles),
            sides: by(self.sides, now.sides, wanted.sides),
        }
    }
}

/// Sides shorter than this, in tile edges, have no direction worth a step: their angles
/// are left alone. Larger, and small units lose their shape; smaller, and a nearly closed
/// hole outweighs all other units.
pub(super) const LEAST_SIDE: f64 = 0.02;

impl Energy {
    /// The sum of its weighted terms.
    pub fn total(&self, weights: &Weights) -> f64 {
        weights.places * self.places + weights.angles * self.angles + weights.sides * self.sides
    }

    /// Whether no term is larger than that of another energy.
    pub fn is_within(&self, other: &Self) -> bool {
        self.places <= other.places && self.angles <= other.angles && self.sides <= other.sides
    }
}

/// cos θ at corner q between p and r, and its gradients by p, q and r; nothing where a side
/// is shorter than `least`.
pub(super) fn cosine(p: Point3, q: Point3, r: Point3, least: f64) -> Option<(f64, [Vector3; 3])> {
    let (back, ahead) = (p - q, r - q);
    let (m, n) = (back.norm(), ahead.norm());
    if !(m > least && n > least) {
        return None;
    }
    let (back, ahead) = (back / m, ahead / n);
    let cos = back.dot(&ahead);
    let (by_p, by_r) = ((ahead - back * cos) / m, (back - ahead * cos) / n);
    Some((cos, [by_p, -by_p - by_r, by_r]))
}

/// Height of the middle of a unit's corners over the surface, mm.
pub(super) fn height(corners: &[Point3], circuit: &Circuit) -> f64 {
    let SurfacePoint { position, normal } = circuit.place;
    corners.iter().map(|p| (p - position).dot(&normal)).sum::<f64>() / corners.len() as f64
}

/// The energy of circuits of tile edge `edge`; contacts whose rods are parallel count
/// as not a number.
pub fn energy(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    circuits: &[Circuit],
    edge: f64,
) -> Energy {
    let mut sum = Energy::default();
    for circuit in circuits {
        let nowhere = Point3::from([f64::NAN; 3]);
        let corner = |c: &ContactId| middle(axes, &joints[*c]).unwrap_or(nowhere);
        let corners: Vec<Point3> = circuit.contacts.iter().map(corner).collect();
        let n = corners.len();
        sum.places += (height(&corners, circuit) / edge).powi(2);
        for i in 0..n {
            let [p, q, r] = [corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]];
            if let Some((cos, _)) = cosine(p, q, r, LEAST_SIDE * edge) {
                sum.angles += (cos - circuit.cosines[i]).powi(2);
            }
        }
        let sides: Vec<f64> = (0..n).map(|i| (corners[(i + 1) % n] - corners[i]).norm()).collect();
        let mean = sides.iter().sum::<f64>() / n as f64;
        let off = |(side, share): (&f64, &f64)| ((side - share * mean) / edge).powi(2);
        sum.sides += sides.iter().zip(&circuit.sides).map(off).sum::<f64>();
    }
    sum
}
