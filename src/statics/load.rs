//! Loads: forces on nodes and along beams.

use super::meshes::tributary;
use super::model::{Beam, Model};
use crate::surface::Vector3;
use nalgebra::Vector6;

/// Loads on a model.
#[derive(Clone, PartialEq, Debug)]
pub struct Load {
    /// Force (N) and moment (N mm) on each node.
    pub nodes: Vec<Vector6<f64>>,
    /// Even force along each beam, N/mm of its length.
    pub beams: Vec<Vector3>,
}

impl Load {
    /// None.
    pub fn none(model: &Model) -> Self {
        Self {
            nodes: vec![Vector6::zeros(); model.nodes.len()],
            beams: vec![Vector3::zeros(); model.beams.len()],
        }
    }

    /// The weight of the rods, downward along z.
    pub fn weight(model: &Model) -> Self {
        let mut load = Self::none(model);
        for (q, beam) in load.beams.iter_mut().zip(&model.beams) {
            q.z = -model.material.weight() * beam.section.area();
        }
        load
    }

    /// A vertical load on the area that the frame covers in plan, as of snow: `pressure` in
    /// MPa. What falls into a mesh of the frame is carried by the rods round it, each by its
    /// length in plan.
    pub fn area(model: &Model, pressure: f64) -> Self {
        let mut load = Self::none(model);
        if pressure == 0.0 {
            return load;
        }
        let carried = tributary(model);
        for ((q, beam), area) in load.beams.iter_mut().zip(&model.beams).zip(carried) {
            q.z = -pressure * area / model.along(beam).norm();
        }
        load
    }

    /// Adds another, times a factor.
    pub fn add(&mut self, factor: f64, other: &Self) {
        self.nodes.iter_mut().zip(&other.nodes).for_each(|(s, f)| *s += f * factor);
        self.beams.iter_mut().zip(&other.beams).for_each(|(s, q)| *s += q * factor);
    }

    /// The sum of all forces, N.
    pub fn total(&self, model: &Model) -> Vector3 {
        let along = |(q, beam): (&Vector3, &Beam)| q * model.along(beam).norm();
        let nodes = self.nodes.iter().map(|f| Vector3::new(f[0], f[1], f[2]));
        nodes.chain(self.beams.iter().zip(&model.beams).map(along)).sum()
    }
}
