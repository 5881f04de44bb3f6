//! The linear system of a step that brings the units into shape: one sparse Cholesky
//! factorisation in four unknowns a rod, which serves for the step and for its correction.
//!
//! Gaps and shapes bend where rods turn, so that a long step opens the contacts that it closed
//! to first order and distorts the units. Two solutions with matrices that are already
//! factored take that back (the second-order correction of Nocedal and Wright, *Numerical
//! Optimization*, section 18.3): first the step that the system itself makes of what is left,
//! which heeds the shapes, then the least move onto the contacts. Without them large frames
//! creep in steps of an eighth; with the second alone, units near the border are distorted.

use super::across::{Across, Bases};
use super::bounds::{Bound, Bounds};
use super::equations::{Equations, Moves, longest, moved};
use super::exact::release;
use super::normal::{Pull, W, normals};
use super::outlook::roams;
use super::projector::Projector;
use super::shape::Circuit;
use super::steps::{LONGEST_MOVE, State, Weighing};
use super::unit_terms::{Scale, UnitTerms};
use super::{CloseError, Task, gap_rows};
use crate::frame::axis::Axis;
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::linalg::{BlockSolver, LinalgError, LowerPattern};
use crate::parallel::in_parallel_with;
use crate::surface::Point3;
use nalgebra::Matrix4;
use std::collections::BTreeSet;

/// Units whose terms are made before they are put into the matrix: enough to keep all cores
/// busy, and a few MB.
const AT_ONCE: usize = 8192;

/// Weight of the moves of rods that stay where they are: far more than of contacts, but not so
/// much that digits get lost.
const FIRM: f64 = 1e9;

/// The system of a step.
pub struct System<'a> {
    /// How its terms are weighed.
    pub weighing: Weighing,
    solver: Option<BlockSolver<W>>,
    step: Option<Step>,
    projector: &'a mut Option<Projector>,
    /// Rods from this number on stay where they are.
    pub free: usize,
}

/// What the last step came from.
struct Step {
    bases: Bases,
    equations: Equations,
    /// What each equation lacks after the whole step, to first order, mm.
    left: Vec<f64>,
    /// The right-hand side, and its solution.
    rhs: Vec<f64>,
    ways: Vec<f64>,
}

impl<'a> System<'a> {
    /// A system; the projector in the slot serves for corrections, and is left there.
    pub fn new(weighing: Weighing, projector: &'a mut Option<Projector>) -> Self {
        Self { weighing, solver: None, step: None, projector, free: usize::MAX }
    }

    /// Whether a step from here would move rods farther than `roam` in the mean, mm, as far as
    /// can be told before it is solved for.
    pub fn roams(&mut self, now: &State, task: &Task, roam: f64) -> Result<bool, CloseError> {
        let scale = self.scale(task);
        roams(now, task, (&scale, self.weighing.fidelity), roam, self.projector)
    }

    fn scale(&self, task: &Task) -> Scale {
        Scale { edge: task.edge, weights: self.weighing.shape, strain: self.weighing.strain }
    }

    /// The move of a Gauss-Newton step; bounds that would pull are let go.
    pub fn direction(
        &mut self,
        now: &State,
        task: &Task,
        bounds: Option<&Bounds>,
        held: &mut BTreeSet<Bound>,
    ) -> Result<Moves, CloseError> {
        let (axes, rows) = (&now.axes, &now.rows);
        let mut equations = Equations::of_contacts(rows);
        if let Some(bounds) = bounds {
            held.retain(|&bound| bounds.hold(bound, axes, &mut equations));
        }
        let bases: Bases = axes.iter().map(Across::new).collect();
        let mut solver = match self.solver.take() {
            Some(solver) if holds(solver.nodes(), &equations, task.joints.len()) => solver,
            _ => {
                let places: Vec<Point3> =
                    axes.iter().map(|axis| nalgebra::center(&axis.a, &axis.b)).collect();
                BlockSolver::placed(pattern(axes.len(), task, &equations)?, &places)?
            }
        };
        let rhs = self.fill(&mut solver, axes, &bases, task, &equations)?;
        solver.factor()?;
        let mut ways = rhs.clone();
        solver.solve(&mut ways);
        let moves = to_moves(&bases, &ways);
        // What a row lacks after the step is what it is pulled by.
        let met = equations.changes(&moves);
        let left: Vec<f64> = equations.lacking.iter().zip(&met).map(|(r, m)| r - m).collect();
        release(held, &left[rows.len()..]);
        self.solver = Some(solver);
        self.step = Some(Step { bases, equations, left, rhs, ways });
        Ok(moves)
    }

    /// The axes after a part of the last step, corrected to second order.
    pub fn corrected(
        &mut self,
        from: &State,
        axes: IdVec<RodId, Axis>,
        part: f64,
        task: &Task,
    ) -> Result<IdVec<RodId, Axis>, CloseError> {
        let most = LONGEST_MOVE * task.edge;
        // A correction that is longer is none: the step was too long.
        let apply = |axes: IdVec<RodId, Axis>, by: &Moves| {
            if longest(by) < most { moved(&axes, by, 1.0) } else { axes }
        };
        let by = self.bend(from, &axes, part, task)?;
        let axes = apply(axes, &by);
        let equations = Equations::of_contacts(&gap_rows(&axes, task.joints)?);
        let (projector, _) = Projector::for_equations(self.projector, &axes, &equations)?;
        projector.factor(&equations, |_| 0.0)?;
        let by = projector.least_moves(&equations).0;
        Ok(apply(axes, &by))
    }

    /// The move that the system makes of how gaps and shapes differ, after a part of the last
    /// step, from what they should be to first order.
    fn bend(
        &mut self,
        from: &State,
        axes: &IdVec<RodId, Axis>,
        part: f64,
        task: &Task,
    ) -> Result<Moves, CloseError> {
        let scale = self.scale(task);
        let (Some(step), Some(solver)) = (&self.step, &mut self.solver) else {
            return Ok(vec![nalgebra::Vector6::zeros(); axes.len()].into());
        };
        let mut lacking: Vec<f64> =
            gap_rows(axes, task.joints)?.iter().map(|row| row.wanted - row.gap).collect();
        let bounds = step.equations.lacking.iter().zip(&step.left).skip(lacking.len());
        lacking.extend(bounds.map(|(before, after)| before + (after - before) * part));
        let mut rhs = vec![0.0; W * axes.len()];
        add_equations(&mut rhs, &step.equations, &step.bases, &lacking, self.weighing.contacts);
        let pull = |[terms, there]: &mut [UnitTerms; 2], circuit: &Circuit| {
            terms.fill(&from.axes, &step.bases, task.joints, circuit, &scale)?;
            there.fill_values(axes, task.joints, circuit, &scale)?;
            terms.revalue(there, &scale);
            Ok(Pull::new(terms))
        };
        for pull in in_parallel_with(task.circuits, Default::default, pull) {
            take(&mut rhs, &pull.map_err(CloseError::Parallel)?);
        }
        for ((r, before), way) in rhs.iter_mut().zip(&step.rhs).zip(&step.ways) {
            *r -= (1.0 - part) * before + self.weighing.fidelity * part * way;
        }
        solver.solve(&mut rhs);
        Ok(to_moves(&step.bases, &rhs))
    }

    /// Fills in the matrix; returns the right-hand side.
    fn fill(
        &self,
        solver: &mut BlockSolver<W>,
        axes: &IdVec<RodId, Axis>,
        bases: &Bases,
        task: &Task,
        equations: &Equations,
    ) -> Result<Vec<f64>, CloseError> {
        solver.clear();
        let mut rhs = vec![0.0; W * axes.len()];
        for rod in 0..axes.len() {
            let own = if rod < self.free { self.weighing.fidelity } else { FIRM };
            solver.add(rod, rod, &Matrix4::from_diagonal_element(own));
        }
        let weight = self.weighing.contacts;
        add_equations(&mut rhs, equations, bases, &equations.lacking, weight);
        for row in 0..equations.len() {
            let parts = &equations.parts()[equations.range(row)];
            for (i, (rod, part)) in parts.iter().enumerate() {
                let ways = bases[*rod].of(part) * weight;
                for (other, with) in &parts[..=i] {
                    let block = ways * bases[*other].of(with).transpose();
                    solver.add(rod.index(), other.index(), &block);
                }
            }
        }
        let scale = self.scale(task);
        for some in task.circuits.chunks(AT_ONCE) {
            let normals = normals(some, axes, bases, task.joints, &scale);
            for normal in normals.map_err(CloseError::Parallel)? {
                take(&mut rhs, &normal.pull);
                for ((rod, other), block) in normal.pairs().zip(&normal.blocks) {
                    solver.add(rod.index(), other.index(), block);
                }
            }
        }
        Ok(rhs)
    }
}

fn to_moves(bases: &Bases, ways: &[f64]) -> Moves {
    bases.iter().zip(ways.chunks_exact(W)).map(|(basis, ways)| basis.to_move(ways)).collect()
}

/// Adds Jᵀ times what equations lack, times their weight.
fn add_equations(
    rhs: &mut [f64],
    equations: &Equations,
    bases: &Bases,
    lacking: &[f64],
    weight: f64,
) {
    for (row, lacking) in lacking.iter().enumerate() {
        for (rod, part) in &equations.parts()[equations.range(row)] {
            let ways = bases[*rod].of(part) * (weight * lacking);
            for (to, way) in rhs[W * rod.index()..].iter_mut().zip(ways.iter()) {
                *to += way;
            }
        }
    }
}

/// Takes the pull of a unit's terms away.
fn take(rhs: &mut [f64], pull: &Pull) {
    for (rod, part) in pull.rods.iter().zip(&pull.parts) {
        for (to, part) in rhs[W * rod.index()..].iter_mut().zip(part) {
            *to -= part;
        }
    }
}

/// Whether a pattern holds the pairs of rods of all bounds, which stand after the contacts.
fn holds(nodes: &LowerPattern, equations: &Equations, contacts: usize) -> bool {
    (contacts..equations.len()).all(|row| {
        let parts = &equations.parts()[equations.range(row)];
        let pairs =
            parts.iter().enumerate().flat_map(|(i, p)| parts[..i].iter().map(move |q| (p, q)));
        pairs.into_iter().all(|(p, q)| nodes.holds(p.0.index(), q.0.index()))
    })
}

/// Which rods share a term.
fn pattern(rods: usize, task: &Task, equations: &Equations) -> Result<LowerPattern, LinalgError> {
    let rods_of = |c: &ContactId| [task.joints[*c].over, task.joints[*c].under];
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    let mut among = |rods: &[RodId]| {
        for (i, p) in rods.iter().enumerate() {
            pairs.extend(rods[..i].iter().map(|q| (p.index(), q.index())));
        }
    };
    for circuit in task.circuits {
        let mut rods: Vec<RodId> = circuit.contacts.iter().flat_map(rods_of).collect();
        rods.sort_unstable();
        rods.dedup();
        among(&rods);
    }
    for row in 0..equations.len() {
        let parts = &equations.parts()[equations.range(row)];
        among(&parts.iter().map(|part| part.0).collect::<Vec<_>>());
    }
    LowerPattern::new(rods, pairs.iter().copied())
}
