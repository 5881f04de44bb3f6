//! The four ways in which a rod can move but along itself.
//!
//! Moving a rod along its own axis, or stretching it, changes neither gaps nor shapes. What
//! is left are two ways across for each end.

use super::equations::{Move, pair};
use super::touch::PointMove;
use crate::frame::axis::Axis;
use crate::ids::{IdVec, RodId};
use crate::surface::Vector3;
use nalgebra::{Matrix3x4, Vector4};

/// Two unit vectors across a rod, at right angles to each other.
#[derive(Clone, Copy, Debug)]
pub struct Across([Vector3; 2]);

/// Those of all rods.
pub type Bases = IdVec<RodId, Across>;

impl Across {
    /// Number of ways: two for each end.
    pub const WAYS: usize = 4;

    /// Across an axis.
    pub fn new(axis: &Axis) -> Self {
        Self(axis.sides())
    }

    /// A gradient by the ends as one by the four ways.
    pub fn of(&self, part: &Move) -> Vector4<f64> {
        let [e, f] = &self.0;
        let (a, b) = (part.fixed_rows::<3>(0), part.fixed_rows::<3>(3));
        Vector4::new(a.dot(e), a.dot(f), b.dot(e), b.dot(f))
    }

    /// How a point moves, by the four ways.
    pub fn of_point(&self, moves: &PointMove) -> Matrix3x4<f64> {
        let [e, f] = &self.0;
        let (a, b) = (moves.fixed_columns::<3>(0), moves.fixed_columns::<3>(3));
        Matrix3x4::from_columns(&[a * e, a * f, b * e, b * f])
    }

    /// The move of the ends by so much each way.
    pub fn to_move(self, ways: &[f64]) -> Move {
        let [e, f] = self.0;
        pair(e * ways[0] + f * ways[1], e * ways[2] + f * ways[3])
    }
}
