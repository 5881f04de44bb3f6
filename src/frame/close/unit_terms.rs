//! The terms of one unit's shape as rows of a least-squares problem.

use super::across::{Across, Bases};
use super::shape::{Circuit, LEAST_SIDE, Weights, cosine, height};
use super::touch::{Touch, middle};
use crate::frame::axis::Axis;
use crate::frame::gaps::Joint;
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::{Point3, Vector3};
use nalgebra::Matrix3x4;

/// How the terms of units are put together.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Scale {
    /// Mean tile edge, mm.
    pub edge: f64,
    /// Weights of the terms.
    pub weights: Weights,
    /// Weight of terms that hold the sides of a unit in size and direction, as they are: they
    /// damp moves that distort it, but not those that take it along.
    pub strain: f64,
}

/// The terms of one unit and their gradients; lengths in mm, angles times the tile edge, all
/// times the root of their weight, so that all squares are alike.
#[derive(Clone, Debug, Default)]
pub struct UnitTerms {
    /// The rods of the circuit.
    pub rods: Vec<RodId>,
    /// The terms.
    pub values: Vec<f64>,
    /// The gradient of every term, one after the other, each by the four ways of all rods; none
    /// where only values were wanted.
    pub rows: Vec<f64>,
    corners: Vec<CornerTerm>,
    /// How many of the terms, the last ones, are strains.
    strains: usize,
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
        scale: &Scale,
    ) -> Result<(), ContactId> {
        self.clear();
        for &contact in &circuit.contacts {
            let touch = Touch::new(axes, &joints[contact]).ok_or(contact)?;
            let corner = self.corner(axes, bases, &touch);
            self.corners.push(corner);
        }
        self.push_terms(circuit, scale);
        Ok(())
    }

    /// Fills in the values alone, without gradients.
    ///
    /// # Errors
    /// A contact whose rods are parallel.
    pub fn fill_values(
        &mut self,
        axes: &IdVec<RodId, Axis>,
        joints: &IdVec<ContactId, Joint>,
        circuit: &Circuit,
        scale: &Scale,
    ) -> Result<(), ContactId> {
        self.clear();
        for &contact in &circuit.contacts {
            let at = middle(axes, &joints[contact]).ok_or(contact)?;
            let (rods, moves) = ([0; 2], [Matrix3x4::zeros(); 2]);
            self.corners.push(CornerTerm { at, rods, moves });
        }
        self.push_terms(circuit, scale);
        Ok(())
    }

    fn clear(&mut self) {
        self.rods.clear();
        self.values.clear();
        self.rows.clear();
        self.corners.clear();
    }

    fn push_terms(&mut self, circuit: &Circuit, scale: &Scale) {
        self.push_height(circuit, scale);
        self.push_cosines(circuit, scale);
        self.push_sides(circuit, scale);
        self.push_strains(scale);
    }

    /// Takes the values of the terms where the rods came to lie, and keeps the gradients. Where
    /// a corner came to have no angle any more, or one at last, all stays as it is.
    pub fn revalue(&mut self, there: &Self, scale: &Scale) {
        if self.values.len() != there.values.len() {
            return;
        }
        self.values.clone_from(&there.values);
        let n = self.corners.len();
        let strains = self.values.len() - self.strains;
        let moves: Vec<Vector3> =
            self.corners.iter().zip(&there.corners).map(|(p, q)| q.at - p.at).collect();
        for (i, to) in self.values[strains..].chunks_exact_mut(3).enumerate() {
            let by = (moves[(i + 1) % n] - moves[i]) * scale.strain.sqrt();
            to.copy_from_slice(by.as_slice());
        }
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
        self.values.push(value);
        // Without rods only values are wanted.
        if self.rods.is_empty() {
            return;
        }
        let start = self.rows.len();
        self.rows.resize(start + Across::WAYS * self.rods.len(), 0.0);
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

    fn push_height(&mut self, circuit: &Circuit, scale: &Scale) {
        let n = self.corners.len();
        let corners: Vec<Point3> = self.corners.iter().map(|c| c.at).collect();
        let weight = scale.weights.places.sqrt();
        let normal = circuit.place.normal * (weight / n as f64);
        let by: Vec<(usize, Vector3)> = (0..n).map(|i| (i, normal)).collect();
        self.push(weight * height(&corners, circuit), &by);
    }

    fn push_cosines(&mut self, circuit: &Circuit, scale: &Scale) {
        let n = self.corners.len();
        let weight = scale.weights.angles.sqrt() * scale.edge;
        for i in 0..n {
            let round = [(i + n - 1) % n, i, (i + 1) % n];
            let [p, q, r] = round.map(|k| self.corners[k].at);
            if let Some((cos, by)) = cosine(p, q, r, LEAST_SIDE * scale.edge) {
                let by = [0, 1, 2].map(|k| (round[k], by[k] * weight));
                self.push(weight * (cos - circuit.cosines[i]), &by);
            }
        }
    }

    fn push_sides(&mut self, circuit: &Circuit, scale: &Scale) {
        let n = self.corners.len();
        let weight = scale.weights.sides.sqrt();
        let width = Across::WAYS * self.rods.len();
        let (first, start) = (self.values.len(), self.rows.len());
        for i in 0..n {
            let next = (i + 1) % n;
            let side = (self.corners[next].at - self.corners[i].at) * weight;
            let along = side.try_normalize(LEAST_SIDE * scale.edge * weight).unwrap_or_default();
            self.push(side.norm(), &[(next, along * weight), (i, -along * weight)]);
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

    /// The moves of each corner against the one before, of which there are none yet.
    fn push_strains(&mut self, scale: &Scale) {
        let before = self.values.len();
        if scale.strain > 0.0 {
            let n = self.corners.len();
            for i in 0..n {
                for way in 0..3 {
                    let by = Vector3::ith(way, scale.strain.sqrt());
                    self.push(0.0, &[((i + 1) % n, by), (i, -by)]);
                }
            }
        }
        self.strains = self.values.len() - before;
    }
}
