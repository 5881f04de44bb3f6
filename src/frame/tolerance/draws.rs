//! Random errors from a seed.

use super::Errors;
use crate::frame::{ContactKind, Frame};
use crate::ids::{IdVec, RodId};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// Draws errors, one frame after the other. The same seed gives the same errors on every
/// machine, and twice the deviation exactly twice the errors.
pub struct Draws {
    random: ChaCha8Rng,
    marks: f64,
    diameter: f64,
}

impl Draws {
    /// Normal errors with these standard deviations, mm.
    pub fn new(seed: u32, marks: f64, diameter: f64) -> Self {
        Self { random: ChaCha8Rng::seed_from_u64(seed.into()), marks, diameter }
    }

    /// The errors of the next frame.
    pub fn errors(&mut self, frame: &Frame) -> Errors {
        let mut normal = || -> f64 { StandardNormal.sample(&mut self.random) };
        let [marks, diameter] = [self.marks, self.diameter];
        let marks = frame.contacts.iter().map(|_| [marks * normal(), marks * normal()]).collect();
        let thicker: IdVec<RodId, f64> = frame.rods.iter().map(|_| diameter * normal()).collect();
        let gap = |c: &crate::frame::Contact| match c.kind {
            ContactKind::Cross => (thicker[c.over] + thicker[c.under]) / 2.0,
            ContactKind::End(_) => 0.0,
        };
        Errors { marks, gaps: frame.contacts.iter().map(gap).collect() }
    }
}
