//! The parts of a model and the sparse system that they add up to.

use super::beam::{self, Stiffness, Twelve};
use super::joint;
use super::model::{Foot, Model};
use crate::linalg::{BlockSolver, LinalgError, LowerPattern};
use crate::parallel::in_parallel;
use nalgebra::Matrix6;

/// A beam or joint: its two nodes and its stiffness between them.
pub type Part = ([usize; 2], Stiffness);

/// The stiffness of a model: first of its beams, then of its joints.
pub struct System {
    /// The beams.
    pub beams: Vec<Part>,
    /// The joints.
    pub joints: Vec<Part>,
    /// Which freedoms of each node are held.
    pub held: Vec<[bool; 6]>,
    solver: BlockSolver<6>,
}

impl System {
    /// Makes the parts of a model and analyses their pattern.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new(model: &Model) -> Result<Self, LinalgError> {
        let beams = in_parallel(&model.beams, |b| {
            (b.nodes, beam::stiffness(&model.along(b), b.section, &model.material))
        });
        let joints = in_parallel(&model.joints, |j| (j.nodes, joint::stiffness(j, &model.nodes)));
        let n = model.nodes.len();
        let between = beams.iter().chain(&joints).map(|(nodes, _)| (nodes[0], nodes[1]));
        let pattern = LowerPattern::new(n, (0..n).map(|i| (i, i)).chain(between))?;
        let mut held = vec![[false; 6]; n];
        for Foot { node, held: foot, .. } in &model.feet {
            for (held, foot) in held[*node].iter_mut().zip(foot) {
                *held |= foot;
            }
        }
        Ok(Self { beams, joints, held, solver: BlockSolver::new(pattern)? })
    }

    /// Sums the parts, `extra` on the diagonal, and factors the sum. A held freedom keeps its
    /// own diagonal and nothing else.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] when something is loose.
    pub fn factor(&mut self, extra: impl Fn(usize) -> f64) -> Result<(), LinalgError> {
        self.solver.clear();
        for (nodes, k) in self.beams.iter().chain(&self.joints) {
            for (i, &row) in nodes.iter().enumerate() {
                for (j, &column) in nodes.iter().enumerate().take(i + 1) {
                    let mut block: Matrix6<f64> = k.fixed_view::<6, 6>(6 * i, 6 * j).into_owned();
                    for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
                        let own = row == column && r == c;
                        if !own && (self.held[row][r] || self.held[column][c]) {
                            block[(r, c)] = 0.0;
                        }
                    }
                    self.solver.add(row, column, &block);
                }
            }
        }
        for node in 0..self.held.len() {
            let own = Matrix6::from_fn(|i, j| if i == j { extra(6 * node + i) } else { 0.0 });
            self.solver.add(node, node, &own);
        }
        self.solver.factor()
    }

    /// Replaces forces on the free freedoms by displacements; held ones stay in place.
    pub fn solve(&mut self, force: &mut [f64]) {
        self.clear_held(force);
        self.solver.solve(force);
    }

    /// Sets what belongs to held freedoms to zero.
    pub fn clear_held(&self, values: &mut [f64]) {
        for (six, held) in values.chunks_exact_mut(6).zip(&self.held) {
            for (value, held) in six.iter_mut().zip(held) {
                if *held {
                    *value = 0.0;
                }
            }
        }
    }
}

/// The displacements of two nodes, one under the other.
pub fn both(moved: &[f64], nodes: [usize; 2]) -> Twelve {
    Twelve::from_fn(|i, _| moved[6 * nodes[i / 6] + i % 6])
}

/// Adds twelve values to those of two nodes.
pub fn add_to(values: &mut [f64], nodes: [usize; 2], twelve: &Twelve) {
    for (i, value) in twelve.iter().enumerate() {
        values[6 * nodes[i / 6] + i % 6] += value;
    }
}
