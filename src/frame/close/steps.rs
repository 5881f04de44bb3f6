//! Steps that bring the units into shape while the contacts come together (paper,
//! section 5.2).
//!
//! A Gauss-Newton step minimises C F1² + E + ε |Δ|² of its linearised terms, lengths in tile
//! edges, with F1 the errors of the gaps and Δ the moves of the rod ends: one sparse
//! Cholesky factorisation in four unknowns a rod. The paper takes C = 500 and ε = 1, and
//! creeps. With C ten times larger contacts come near at once, and with ε smaller after
//! every good step units find their shape in a few. Steps end when the units are shaped no
//! worse than they were, or rods would have to move too far for more.
//!
//! Gaps bend where rods turn, so that a long step opens the contacts that it closed to first
//! order. A projection after each step, which costs a fifth of it, takes that back (the
//! second-order correction of Nocedal and Wright, *Numerical Optimization*, section 18.3);
//! without it large frames creep in steps of an eighth.

use super::across::{Across, Bases};
use super::bounds::{Bound, Bounds};
use super::equations::{Equations, Moves, longest, moved};
use super::exact::release;
use super::projector::Projector;
use super::shape::{UnitTerms, energy};
use super::{CloseError, Task, gap_rows};
use crate::frame::axis::Axis;
use crate::frame::gaps::Row;
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::linalg::{BlockSolver, LinalgError, LowerPattern};
use nalgebra::Matrix4;
use std::collections::BTreeSet;

/// How contacts are weighed against shape, and when to stop.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Weighing {
    /// C: weight of F1², the error of a gap in tile edges.
    contacts: f64,
    /// ε: weight of the moves of rod ends.
    fidelity: f64,
    /// Factor on ε after good and bad steps.
    easing: f64,
    /// Most steps.
    steps: usize,
    /// Steps end when one takes off less than this part of C F1² + E.
    settled: f64,
    /// Whether steps are corrected to second order.
    corrected: bool,
}

impl Weighing {
    /// Contacts as good as firm, moves small: for rods that are to stay near where they are.
    pub const NEAR: Self = Self {
        contacts: 5e3,
        fidelity: 1.0,
        easing: 4.0,
        steps: 5,
        settled: 0.03,
        corrected: true,
    };

    /// The same for rods that may go anywhere.
    pub const FREE: Self =
        Self { fidelity: 1e-3, easing: 10.0, steps: 10, settled: 0.01, ..Self::NEAR };

    /// The paper's weights, to stillness.
    pub const PAPER: Self = Self {
        contacts: 500.0,
        fidelity: 1.0,
        easing: 1.0,
        steps: 60,
        settled: 1e-6,
        corrected: false,
    };
}

/// A step that is shortened less than this was good.
const WHOLE: f64 = 0.9;

impl Weighing {
    /// After a step of which `part` was taken: less fidelity where it was good, more where it
    /// was not (Levenberg and Marquardt).
    fn loosen(&mut self, part: f64) {
        if part >= WHOLE {
            self.fidelity /= self.easing;
        } else if part < WHOLE / 2.0 {
            self.fidelity *= self.easing;
        }
    }
}

/// Longest move of an end in one step, in tile edges.
const LONGEST_MOVE: f64 = 0.25;

/// Times that a step is halved before it is given up.
const HALVINGS: u8 = 4;

/// Takes steps until they change little. Returns their number.
pub fn settle(
    axes: &mut IdVec<RodId, Axis>,
    task: &Task,
    weighing: &Weighing,
    held: &mut BTreeSet<Bound>,
    projector: &mut Option<Projector>,
) -> Result<usize, CloseError> {
    let mut rows = gap_rows(axes, task.joints)?;
    let bounds = task.bounds(axes, &rows);
    let mut system = System { weighing: *weighing, solver: None, projector };
    let start = axes.clone();
    let wanted = task.energy(axes);
    let mut now = system.measure(axes, &rows, task);
    for step in 0..weighing.steps {
        if let Some(bounds) = &bounds {
            held.extend(bounds.broken(axes, &rows));
        }
        if task.is_crowded(held) {
            return Ok(step);
        }
        let moves = system.direction(axes, &rows, task, bounds.as_ref(), held)?;
        let Some(tried) = system.shortened(axes, &moves, task, now) else { return Ok(step) };
        system.weighing.loosen(tried.part);
        if task.roam.is_some_and(|roam| mean_move(&start, &tried.axes) > roam) {
            return Ok(step);
        }
        let slow = tried.part >= WHOLE && now - tried.measure < weighing.settled * now;
        (*axes, rows, now) = (tried.axes, tried.rows, tried.measure);
        if slow || weighing.corrected && task.energy(axes).is_within(&wanted) {
            return Ok(step + 1);
        }
    }
    Ok(weighing.steps)
}

/// The mean distance between the ends of axes and where they were, mm.
fn mean_move(from: &IdVec<RodId, Axis>, to: &IdVec<RodId, Axis>) -> f64 {
    let ends = |(p, q): (&Axis, &Axis)| ((p.a - q.a).norm() + (p.b - q.b).norm()) / 2.0;
    from.iter().zip(to.iter()).map(ends).sum::<f64>() / from.len() as f64
}

/// A step that was tried.
struct Tried {
    axes: IdVec<RodId, Axis>,
    rows: Vec<Row>,
    measure: f64,
    /// How much of it was taken.
    part: f64,
}

/// The system of a step.
struct System<'a> {
    weighing: Weighing,
    solver: Option<BlockSolver<{ Across::WAYS }>>,
    projector: &'a mut Option<Projector>,
}

impl System<'_> {
    /// C F1² + E: what steps have to lower.
    fn measure(&self, axes: &IdVec<RodId, Axis>, rows: &[Row], task: &Task) -> f64 {
        let open: f64 = rows.iter().map(|row| ((row.wanted - row.gap) / task.edge).powi(2)).sum();
        self.weighing.contacts * open + energy(axes, task.joints, task.circuits, task.edge).total()
    }

    /// A step, shortened until it lowers the measure; nothing where none does.
    fn shortened(
        &mut self,
        axes: &IdVec<RodId, Axis>,
        moves: &Moves,
        task: &Task,
        now: f64,
    ) -> Option<Tried> {
        let whole = (LONGEST_MOVE * task.edge / longest(moves)).min(1.0);
        (0..=HALVINGS).find_map(|halved| {
            let part = whole / f64::from(1 << halved);
            let mut axes = moved(axes, moves, part);
            let mut rows = gap_rows(&axes, task.joints).ok()?;
            if self.weighing.corrected {
                let by = self.correction(&rows, axes.len()).ok()?;
                // A longer one is no correction: the step was too long.
                if longest(&by) < LONGEST_MOVE * task.edge {
                    axes = moved(&axes, &by, 1.0);
                    rows = gap_rows(&axes, task.joints).ok()?;
                }
            }
            let measure = self.measure(&axes, &rows, task);
            (measure < now).then_some(Tried { axes, rows, measure, part })
        })
    }

    /// The least move that closes the contacts to first order.
    fn correction(&mut self, rows: &[Row], rods: usize) -> Result<Moves, LinalgError> {
        let equations = Equations::of_contacts(rows);
        let (projector, _) = Projector::for_equations(self.projector, rods, &equations)?;
        projector.factor(&equations, |_| 0.0)?;
        Ok(projector.least_moves(&equations).0)
    }

    /// The move of a Gauss-Newton step; bounds that would pull are let go.
    fn direction(
        &mut self,
        axes: &IdVec<RodId, Axis>,
        rows: &[Row],
        task: &Task,
        bounds: Option<&Bounds>,
        held: &mut BTreeSet<Bound>,
    ) -> Result<Moves, CloseError> {
        let mut equations = Equations::of_contacts(rows);
        if let Some(bounds) = bounds {
            held.retain(|&bound| bounds.hold(bound, axes, &mut equations));
        }
        let bases: Bases = axes.iter().map(Across::new).collect();
        let mut solver = match self.solver.take() {
            Some(solver) if holds(solver.nodes(), &equations, task.joints.len()) => solver,
            _ => BlockSolver::new(pattern(axes.len(), task, &equations)?)?,
        };
        let mut way = self.fill(&mut solver, axes, &bases, task, &equations)?;
        solver.factor()?;
        solver.solve(&mut way);
        let moves: Moves = bases
            .iter()
            .zip(way.chunks_exact(Across::WAYS))
            .map(|(basis, ways)| basis.to_move(ways))
            .collect();
        // What a row lacks after the step is what it is pulled by.
        let met = equations.changes(&moves);
        let left: Vec<f64> = equations.lacking.iter().zip(&met).map(|(r, m)| r - m).collect();
        self.solver = Some(solver);
        release(held, &left[rows.len()..]);
        Ok(moves)
    }

    /// Fills in the matrix; returns the right-hand side.
    fn fill(
        &self,
        solver: &mut BlockSolver<{ Across::WAYS }>,
        axes: &IdVec<RodId, Axis>,
        bases: &Bases,
        task: &Task,
        equations: &Equations,
    ) -> Result<Vec<f64>, CloseError> {
        const W: usize = Across::WAYS;
        solver.clear();
        let mut rhs = vec![0.0; W * axes.len()];
        let own = Matrix4::identity() * self.weighing.fidelity;
        (0..axes.len()).for_each(|rod| solver.add(rod, rod, &own));
        let weight = self.weighing.contacts;
        for (row, lacking) in equations.lacking.iter().enumerate() {
            let parts = &equations.parts()[equations.range(row)];
            for (i, (rod, part)) in parts.iter().enumerate() {
                let ways = bases[*rod].of(part) * weight;
                for k in 0..W {
                    rhs[W * rod.index() + k] += ways[k] * lacking;
                }
                for (other, with) in &parts[..=i] {
                    let block = ways * bases[*other].of(with).transpose();
                    solver.add(rod.index(), other.index(), &block);
                }
            }
        }
        let mut terms = UnitTerms::default();
        for circuit in task.circuits {
            terms
                .fill(axes, bases, task.joints, circuit, task.edge)
                .map_err(CloseError::Parallel)?;
            add_unit(solver, &mut rhs, &terms);
        }
        Ok(rhs)
    }
}

/// Adds GᵀG of a unit's terms, and takes Gᵀ times the terms from the right-hand side.
fn add_unit(solver: &mut BlockSolver<{ Across::WAYS }>, rhs: &mut [f64], terms: &UnitTerms) {
    const W: usize = Across::WAYS;
    let width = W * terms.rods.len();
    let rows = || terms.rows.chunks_exact(width);
    for (row, value) in rows().zip(&terms.values) {
        for (rod, part) in terms.rods.iter().zip(row.chunks_exact(W)) {
            for (to, part) in rhs[W * rod.index()..].iter_mut().zip(part) {
                *to -= part * value;
            }
        }
    }
    for (i, rod) in terms.rods.iter().enumerate() {
        for (j, other) in terms.rods[..=i].iter().enumerate() {
            let mut block = Matrix4::zeros();
            for row in rows() {
                let (p, q) = (&row[W * i..W * i + W], &row[W * j..W * j + W]);
                for (column, q) in q.iter().enumerate() {
                    for (line, p) in p.iter().enumerate() {
                        block[(line, column)] += p * q;
                    }
                }
            }
            solver.add(rod.index(), other.index(), &block);
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
