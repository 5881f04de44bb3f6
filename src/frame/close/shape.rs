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

use super::across::{Across, Bases};
use super::touch::{Touch, middle};
use crate::chart::SurfacePoint;
use crate::frame::axis::Axis;
use crate::frame::gaps::Joint;
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::{Point3, Vector3};
use nalgebra::Matrix3x4;
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

/// Weight of F2² against F3² and F4² (paper, section 5.2).
const PLACE_WEIGHT: f64 = 5.0;

/// Sides shorter than this, in tile edges, have no direction worth a step: their angles
/// are left alone. Larger, and small units lose their shape; smaller, and a nearly closed
/// hole outweighs all other units.
const LEAST_SIDE: f64 = 0.02;

impl Energy {
    /// 5 F2² + F3² + F4².
    pub fn total(&self) -> f64 {
        PLACE_WEIGHT * self.places + self.angles + self.sides
    }

    /// Whether no term is larger than that of another energy.
    pub fn is_within(&self, other: &Self) -> bool {
        self.places <= other.places && self.angles <= other.angles && self.sides <= other.sides
    }
}

/// cos θ at corner q between p and r, and its gradients by p, q and r; nothing where a side
/// is shorter than `least`.
fn cosine(p: Point3, q: Point3, r: Point3, least: f64) -> Option<(f64, [Vector3; 3])> {
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
fn height(corners: &[Point3], circuit: &Circuit) -> f64 {
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

/// The terms of one unit and their gradients; lengths in mm, angles times the tile edge, all
/// times the root of their weight, so that all squares are alike.
#[derive(Clone, Debug, Default)]
pub struct UnitTerms {
    /// The rods of the circuit.
    pub rods: Vec<RodId>,
    /// The terms.
    pub values: Vec<f64>,
    /// The gradient of every term, one after the other, each by the four ways of all rods.
    pub rows: Vec<f64>,
    corners: Vec<CornerTerm>,
}

/// A corner, and how it moves with two of the unit's rods.
#[derive(Clone, Debug)]
struct CornerTerm {
    at: Point3,
    rods: [usize; 2],
    moves: [Matrix3x4<f64>; 2],
}

impl UnitTerms {
    /// Fills in the terms of a circuit.
    ///
    /// # Errors
    /// A contact whose rods are parallel.
    pub fn fill(
        &mut self,
        axes: &IdVec<RodId, Axis>,
        bases: &Bases,
        joints: &IdVec<ContactId, Joint>,
        circuit: &Circuit,
        edge: f64,
    ) -> Result<(), ContactId> {
        self.rods.clear();
        self.values.clear();
        self.rows.clear();
        self.corners.clear();
        for &contact in &circuit.contacts {
            let touch = Touch::new(axes, &joints[contact]).ok_or(contact)?;
            let corner = self.corner(axes, bases, &touch);
            self.corners.push(corner);
        }
        let n = self.corners.len();
        self.push_height(circuit);
        for i in 0..n {
            let round = [(i + n - 1) % n, i, (i + 1) % n];
            let [p, q, r] = round.map(|k| self.corners[k].at);
            if let Some((cos, by)) = cosine(p, q, r, LEAST_SIDE * edge) {
                let by = [0, 1, 2].map(|k| (round[k], by[k] * edge));
                self.push(edge * (cos - circuit.cosines[i]), &by);
            }
        }
        self.push_sides(circuit, edge);
        Ok(())
    }

    fn corner(&mut self, axes: &IdVec<RodId, Axis>, bases: &Bases, touch: &Touch) -> CornerTerm {
        let points = [0, 1].map(|s| {
            let axis = &axes[touch.rods[s]];
            axis.a + (axis.b - axis.a) * touch.at[s]
        });
        let moves = touch.middle_moves(axes);
        let moves = [0, 1].map(|s| bases[touch.rods[s]].of_point(&moves[s]));
        let rods = touch.rods.map(|rod| {
            self.rods.iter().position(|&known| known == rod).unwrap_or_else(|| {
                self.rods.push(rod);
                self.rods.len() - 1
            })
        });
        CornerTerm { at: nalgebra::center(&points[0], &points[1]), rods, moves }
    }

    /// Adds a term that changes by `by` with these corners.
    fn push(&mut self, value: f64, by: &[(usize, Vector3)]) {
        let width = Across::WAYS * self.rods.len();
        let start = self.rows.len();
        self.rows.resize(start + width, 0.0);
        self.values.push(value);
        let row = &mut self.rows[start..];
        for (corner, force) in by {
            let CornerTerm { rods, moves, .. } = &self.corners[*corner];
            for (rod, moves) in rods.iter().zip(moves) {
                let part = moves.tr_mul(force);
                for (to, part) in row[Across::WAYS * rod..].iter_mut().zip(part.iter()) {
                    *to += part;
                }
            }
        }
    }

    fn push_height(&mut self, circuit: &Circuit) {
        let n = self.corners.len();
        let corners: Vec<Point3> = self.corners.iter().map(|c| c.at).collect();
        let weight = PLACE_WEIGHT.sqrt();
        let normal = circuit.place.normal * (weight / n as f64);
        let by: Vec<(usize, Vector3)> = (0..n).map(|i| (i, normal)).collect();
        self.push(weight * height(&corners, circuit), &by);
    }

    fn push_sides(&mut self, circuit: &Circuit, edge: f64) {
        let n = self.corners.len();
        let width = Across::WAYS * self.rods.len();
        let (first, start) = (self.values.len(), self.rows.len());
        for i in 0..n {
            let next = (i + 1) % n;
            let side = self.corners[next].at - self.corners[i].at;
            let along = side.try_normalize(LEAST_SIDE * edge).unwrap_or_default();
            self.push(side.norm(), &[(next, along), (i, -along)]);
        }
        let mean = self.values[first..].iter().sum::<f64>() / n as f64;
        let rows = &mut self.rows[start..];
        let means: Vec<f64> = (0..width)
            .map(|k| rows.iter().skip(k).step_by(width).sum::<f64>() / n as f64)
            .collect();
        for (i, share) in circuit.sides.iter().enumerate() {
            self.values[first + i] -= share * mean;
            for (to, mean) in rows[i * width..].iter_mut().zip(&means) {
                *to -= share * mean;
            }
        }
    }
}
