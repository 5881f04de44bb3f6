//! The normal equations of one unit's terms, by the rods of its circuit.

use super::across::{Across, Bases};
use super::shape::Circuit;
use super::unit_terms::{Scale, UnitTerms};
use crate::frame::axis::Axis;
use crate::frame::gaps::Joint;
use crate::ids::{ContactId, IdVec, RodId};
use crate::parallel::in_parallel_with;
use nalgebra::{Matrix4, Vector4};

/// The four unknowns of a rod.
pub const W: usize = Across::WAYS;

/// Gᵀ times the terms, with G their gradients: how they pull each rod.
pub struct Pull {
    /// The rods of the circuit.
    pub rods: Vec<RodId>,
    /// The part of each.
    pub parts: Vec<Vector4<f64>>,
}

impl Pull {
    /// That of the terms of a unit.
    pub fn new(terms: &UnitTerms) -> Self {
        let mut parts = vec![Vector4::zeros(); terms.rods.len()];
        for (row, value) in terms.rows.chunks_exact(W * parts.len()).zip(&terms.values) {
            for (to, part) in parts.iter_mut().zip(row.chunks_exact(W)) {
                *to += Vector4::from_column_slice(part) * *value;
            }
        }
        Self { rods: terms.rods.clone(), parts }
    }
}

/// Both sides of a unit's normal equations.
pub struct Normal {
    /// Gᵀ times the terms.
    pub pull: Pull,
    /// The blocks of GᵀG in its lower triangle: of each rod with itself and those before it.
    pub blocks: Vec<Matrix4<f64>>,
}

impl Normal {
    /// Those of the terms of a unit.
    pub fn new(terms: &UnitTerms) -> Self {
        let n = terms.rods.len();
        let mut blocks = vec![Matrix4::zeros(); n * (n + 1) / 2];
        for row in terms.rows.chunks_exact(W * n) {
            let part = |i: usize| Vector4::from_column_slice(&row[W * i..W * i + W]);
            let mut block = blocks.iter_mut();
            for i in 0..n {
                let by = part(i);
                for (j, to) in (0..=i).zip(&mut block) {
                    *to += by * part(j).transpose();
                }
            }
        }
        Self { pull: Pull::new(terms), blocks }
    }

    /// The pairs of rods to which the blocks belong.
    pub fn pairs(&self) -> impl Iterator<Item = (RodId, RodId)> {
        let rods = &self.pull.rods;
        (0..rods.len()).flat_map(move |i| (0..=i).map(move |j| (rods[i], rods[j])))
    }
}

/// Those of all circuits, in their order.
///
/// # Errors
/// A contact whose rods are parallel.
pub fn normals(
    circuits: &[Circuit],
    axes: &IdVec<RodId, Axis>,
    bases: &Bases,
    joints: &IdVec<ContactId, Joint>,
    scale: &Scale,
) -> Result<Vec<Normal>, ContactId> {
    let normal = |terms: &mut UnitTerms, circuit: &Circuit| {
        terms.fill(axes, bases, joints, circuit, scale)?;
        Ok(Normal::new(terms))
    };
    in_parallel_with(circuits, UnitTerms::default, normal).into_iter().collect()
}
