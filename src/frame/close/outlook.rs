//! Whether units could come into shape while rods stay near where they are, found out without
//! the linear system of a step.
//!
//! A step minimises E + ε |Δ|² on the moves that meet the linearised contacts. Conjugate
//! gradients, each projected onto the moves that leave the contacts as they are, go from the
//! least move to that minimum and on the way only get longer (Steihaug, *The conjugate gradient
//! method and trust regions in large scale optimization*, 1983, theorem 2.1). So where rods go
//! too far after a few of them, the step would take them farther, and need not be solved for:
//! of large frames of thin rods this spares most of the time and of the memory.

use super::across::{Across, Bases};
use super::equations::{Equations, Moves, mean};
use super::normal::{Normal, normals};
use super::projector::Projector;
use super::steps::{MANY, State};
use super::unit_terms::Scale;
use super::{CloseError, Task};
use crate::ids::{IdVec, RodId};
use nalgebra::Vector4;

/// Gradients to look ahead by. More cost time where steps are worth it; fewer overlook steps
/// that are not.
const LOOKS: usize = 4;

/// How many times farther than allowed rods have to go: lengths are compared as means, while
/// it is the root of the mean of squares that grows.
const FARTHER: f64 = 1.1;

/// What is left of the square of the slope at the minimum: rounding. Less, and ways are taken
/// that lead nowhere; more, and the minimum is not reached.
const LEVEL: f64 = 1e-16;

/// Whether a step from here would move the ends of rods farther than `roam` in the mean, mm, as
/// far as can be told; ε is `fidelity`.
///
/// # Errors
/// [`CloseError`] where the step itself would meet it.
pub fn roams(
    now: &State,
    task: &Task,
    (scale, fidelity): (&Scale, f64),
    roam: f64,
    projector: &mut Option<Projector>,
) -> Result<bool, CloseError> {
    // Fewer rods are sooner moved than looked at.
    if now.axes.len() < MANY {
        return Ok(false);
    }
    let shape = Shape::new(now, task, scale, fidelity)?;
    let equations = Equations::of_contacts(&now.rows);
    let (projector, _) = Projector::for_equations(projector, &now.axes, &equations)?;
    projector.factor(&equations, |_| 0.0)?;
    Ok(descend(&shape, &equations, projector, LOOKS, |moves| mean(moves) > FARTHER * roam))
}

/// Goes towards the step by so many gradients at most, until moves are far enough. Returns
/// whether they are.
fn descend(
    shape: &Shape,
    equations: &Equations,
    projector: &mut Projector,
    most: usize,
    mut are_far: impl FnMut(&Moves) -> bool,
) -> bool {
    let (mut moves, _) = projector.least_moves(equations);
    let mut slope = shape.slope(&moves);
    let (mut first, mut last): (f64, Option<(Moves, f64)>) = (0.0, None);
    for _ in 0..most {
        if are_far(&moves) {
            return true;
        }
        let mut way = slope.clone();
        projector.keep_contacts(equations, &mut way);
        let gain = dot(&slope, &way);
        first = first.max(gain);
        if gain.is_nan() || gain <= LEVEL * first {
            return false;
        }
        if let Some((last, before)) = &last {
            add(&mut way, last, gain / before);
        }
        let bend = shape.bend(&way);
        let part = gain / dot(&way, &bend);
        add(&mut moves, &way, -part);
        add(&mut slope, &bend, -part);
        last = Some((way, gain));
    }
    are_far(&moves)
}

/// (E + ε |Δ|²) / 2, linearised, as a function of the moves.
struct Shape {
    bases: Bases,
    units: Vec<Normal>,
    fidelity: f64,
}

impl Shape {
    fn new(now: &State, task: &Task, scale: &Scale, fidelity: f64) -> Result<Self, CloseError> {
        let bases: Bases = now.axes.iter().map(Across::new).collect();
        let units = normals(task.circuits, &now.axes, &bases, task.joints, scale)
            .map_err(CloseError::Parallel)?;
        Ok(Self { bases, units, fidelity })
    }

    /// The gradient after some moves.
    fn slope(&self, moves: &Moves) -> Moves {
        let mut slope = self.bend(moves);
        for unit in &self.units {
            for (rod, part) in unit.pull.rods.iter().zip(&unit.pull.parts) {
                slope[*rod] += self.bases[*rod].to_move(part.as_slice());
            }
        }
        slope
    }

    /// The Hessian times some moves.
    fn bend(&self, moves: &Moves) -> Moves {
        let ways: IdVec<RodId, Vector4<f64>> =
            self.bases.iter().zip(moves.iter()).map(|(basis, by)| basis.of(by)).collect();
        let mut bend: IdVec<RodId, Vector4<f64>> = vec![Vector4::zeros(); ways.len()].into();
        for unit in &self.units {
            for ((rod, other), block) in unit.pairs().zip(&unit.blocks) {
                bend[rod] += block * ways[other];
                if rod != other {
                    bend[other] += block.tr_mul(&ways[rod]);
                }
            }
        }
        let rods = self.bases.iter().zip(bend.iter()).zip(moves.iter());
        rods.map(|((basis, way), by)| basis.to_move(way.as_slice()) + by * self.fidelity).collect()
    }
}

fn dot(moves: &Moves, others: &Moves) -> f64 {
    moves.iter().zip(others.iter()).map(|(p, q)| p.dot(q)).sum()
}

fn add(moves: &mut Moves, more: &Moves, part: f64) {
    moves.iter_mut().zip(more.iter()).for_each(|(to, by)| *to += by * part);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::close::marks::Marks;
    use crate::frame::close::shape::Weights;
    use crate::frame::close::steps::Weighing;
    use crate::frame::close::system::System;
    use crate::frame::close::tests::wanted;
    use crate::frame::gaps::circuit;
    use crate::ids::Id;
    use std::collections::BTreeSet;

    /// As many gradients as there are freedoms lead to the step that the linear system gives
    /// with contacts as good as firm, and on the way moves only get longer.
    #[test]
    fn gradients_lead_to_the_step_and_moves_only_get_longer() {
        let (mut axes, joints) = circuit(5, 3.0);
        axes[RodId::new(1)].a.x += 4.0;
        axes[RodId::new(2)].b.y -= 3.0;
        let circuits = [wanted(&joints, [0.0, 0.0, 5.0])];
        let (limits, marks, roam, edge) = (None, Marks::default(), None, 60.0);
        let task = Task { joints: &joints, circuits: &circuits, limits, marks, roam, edge };
        let now = State::new(axes, &task).unwrap();

        let weighing = Weighing { contacts: 1e8, fidelity: 0.1, ..Weighing::NEAR };
        let mut none = None;
        let mut system = System::new(weighing, &mut none);
        let step = system.direction(&now, &task, None, &mut BTreeSet::new()).unwrap();

        let scale = Scale { edge, weights: Weights::PAPER, strain: 0.0 };
        let shape = Shape::new(&now, &task, &scale, weighing.fidelity).unwrap();
        let equations = Equations::of_contacts(&now.rows);
        let mut slot = None;
        let (projector, _) = Projector::for_equations(&mut slot, &now.axes, &equations).unwrap();
        projector.factor(&equations, |_| 0.0).unwrap();
        let (mut before, mut moves) = (0.0, Moves::new());
        let is_far = |by: &Moves| {
            let length = dot(by, by).sqrt();
            assert!(length >= before * (1.0 - 1e-9), "{length} after {before}");
            (before, moves) = (length, by.clone());
            false
        };
        assert!(!descend(&shape, &equations, projector, 4 * 5 - 5, is_far));
        let mut off = moves.clone();
        add(&mut off, &step, -1.0);
        let (off, length) = (dot(&off, &off).sqrt(), dot(&step, &step).sqrt());
        assert!(length > 1.0 && off < 1e-5 * length, "{off} of {length}");
    }
}
