//! Newton projection onto the contacts: in every step the least move of all ends that
//! meets the linearised gaps, and the bounds that would be broken.
//!
//! It converges quadratically; where the last step was a good one, the same factorisation
//! serves for the next.

use super::bounds::{Bound, Bounds};
use super::equations::{Equations, Moves, longest, moved};
use super::marks::hold;
use super::projector::Projector;
use super::{CloseError, Task, gap_rows, worst};
use crate::frame::axis::Axis;
use crate::frame::gaps::Row;
use crate::ids::{ContactId, IdVec, RodId};
use std::collections::BTreeSet;

/// Error of a gap, as part of the diameter, at which closing is done: the last step before
/// this is quadratic, so what is left is rounding. A larger bound would stop one step early
/// and leave errors that marks to 0.1 mm never show but checks do.
pub const EXACT: f64 = 1e-12;

/// Errors up to this do where rounding keeps a large frame from [`EXACT`]: ten times below
/// what the structure file promises.
const GOOD: f64 = 1e-10;

/// What the structure file promises.
const PROMISED: f64 = 1e-9;

/// How many times the rounding of a coordinate shows in a gap, which is computed from some
/// products of differences.
const ROUNDINGS: f64 = 4.0;

/// A step that leaves more than this part of the error has come to rounding.
const STUCK: f64 = 0.2;

/// Steps before giving up; good starts take three to six.
const MAX_STEPS: usize = 40;

/// Steps after which bounds that are still broken are left so: whoever checks the frame
/// finds them.
const BOUND_STEPS: usize = 12;

/// Longest move of an end in one step, as part of the mean length of the axes. Longer moves
/// leave the range in which the linearised gaps say anything; the step is shortened.
const LONGEST_MOVE: f64 = 0.25;

/// A factorisation serves on while every step leaves less than this part of the error, if it
/// was made where the error was less than [`NEAR`].
const SERVES: f64 = 0.05;

/// Error of a gap, as part of the diameter, from which rods turn so little that a factorisation
/// serves for more than one step. Larger, and steps with old ones lead away again; smaller, and
/// more are made than are needed.
const NEAR: f64 = 1e-3;

/// How far bounds give way, as part of their own row of J Jᵀ. Bounds that contradict
/// contacts then bend instead of making the system singular; less, and they throw the rods
/// far off, more, and bounds take more steps to be met.
pub(super) const YIELD: f64 = 1e-3;

/// A mark that is held is met when it is as near as this, as part of the edge. Less, and rounding
/// keeps it from being met; more, and marks are off by what checks show.
const MET: f64 = 1e-11;

/// Steps after which marks are let be that are not met. Where marks contradict each other, rods
/// would else creep on for what is hardly to be gained.
const MARK_STEPS: usize = 12;

/// Marks that contradict each other are as near as they come when a step moves no rod end by
/// more than this, as part of the edge. Less, and many steps are made for nothing; more, and
/// marks that can be met are not.
const STILL: f64 = 1e-9;

/// What projection took.
pub struct Exact {
    /// Newton steps.
    pub steps: usize,
    /// Largest error of a gap left, as part of the diameter.
    pub error: f64,
}

/// Moves the axes by as little as possible until every joint has its gap, marks are where they
/// are held as far as can be, and the bounds hold, those in `held` from the start.
pub fn exact(
    axes: &mut IdVec<RodId, Axis>,
    task: &Task,
    held: &mut BTreeSet<Bound>,
    projector: &mut Option<Projector>,
) -> Result<Exact, CloseError> {
    let mean = axes.iter().map(Axis::length).sum::<f64>() / axes.len() as f64;
    let mut rows = gap_rows(axes, task.joints)?;
    let good = reachable(axes, &rows);
    let mut keeping = Keeping::new(task, task.bounds(axes, &rows), held);
    let mut last = f64::INFINITY;
    let mut still = false;
    for step in 0..=MAX_STEPS {
        let error = worst(&rows);
        let mut equations = Equations::of_contacts(&rows);
        hold(task, axes, &mut equations)?;
        let slip = equations.lacking[rows.len()..].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let broken = match &keeping.bounds {
            Some(bounds) if step < BOUND_STEPS => bounds.broken(axes, &rows),
            _ => Vec::new(),
        };
        // What is left of marks is let be then, but they do not go farther off.
        let settled = slip <= MET * task.edge || still || step >= MARK_STEPS;
        if settled {
            equations.lacking[rows.len()..].fill(0.0);
        }
        if (error <= EXACT || error <= good && error > STUCK * last) && broken.is_empty() && settled
        {
            return Ok(Exact { steps: step, error });
        }
        if step == MAX_STEPS || error.is_nan() {
            return Err(CloseError::Diverged { open: open(&rows, good) });
        }
        // What is left at last is rounding, which new factors do not take away.
        let at_last = error <= good && settled;
        let progress = Progress { error, last, at_last };
        keeping.hold(broken);
        let moves = keeping.least_moves(axes, equations, rows.len(), &progress, projector)?;
        last = error;
        let longest = longest(&moves);
        still = longest <= STILL * task.edge;
        let part = (LONGEST_MOVE * mean / longest).min(1.0);
        *axes = moved(axes, &moves, part);
        rows = gap_rows(axes, task.joints)?;
        if let Some(bounds) = &mut keeping.bounds {
            bounds.follow(axes, &rows, part * longest);
        }
    }
    unreachable!("the last round of the loop returns")
}

/// How far the steps have come.
struct Progress {
    /// The largest error of a gap, as part of the diameter, and that before the last step.
    error: f64,
    last: f64,
    /// Whether nothing but rounding is left.
    at_last: bool,
}

/// The bounds that are kept from step to step, and what was factored for them.
struct Keeping<'a> {
    task: &'a Task<'a>,
    /// Nothing where there are none, or too many are broken.
    bounds: Option<Bounds<'a>>,
    held: &'a mut BTreeSet<Bound>,
    /// All that ever were held: they keep a row, so that one analysis serves for all steps.
    known: BTreeSet<Bound>,
    /// Those that were held when factors were made, and the error then.
    factored: (BTreeSet<Bound>, f64),
}

impl<'a> Keeping<'a> {
    fn new(task: &'a Task, bounds: Option<Bounds<'a>>, held: &'a mut BTreeSet<Bound>) -> Self {
        let factored = (held.clone(), f64::INFINITY);
        Self { task, bounds, known: held.clone(), held, factored }
    }

    /// Holds those that are broken as well.
    fn hold(&mut self, broken: Vec<Bound>) {
        self.held.extend(broken);
        if self.task.is_crowded(self.held) {
            self.bounds = None;
            self.held.clear();
            self.known.clear();
        }
        self.known.extend(self.held.iter());
    }

    /// The least moves that meet equations, of which those of so many gaps come first, and the
    /// bounds that are held. Bounds that would pull rods towards them are let go.
    fn least_moves(
        &mut self,
        axes: &IdVec<RodId, Axis>,
        mut equations: Equations,
        gaps: usize,
        progress: &Progress,
        projector: &mut Option<Projector>,
    ) -> Result<Moves, CloseError> {
        let with_marks = equations.len();
        if let Some(bounds) = &self.bounds {
            bounds.hold_known(&mut self.known, self.held, axes, &mut equations);
        }
        let (projector, new) = Projector::for_equations(projector, axes, &equations)?;
        if new || !self.serves(progress) {
            let give = |row| match row {
                row if (gaps..with_marks).contains(&row) => self.task.marks.give,
                row => yields(row, gaps),
            };
            projector.factor(&equations, give)?;
            self.factored = (self.held.clone(), progress.error);
        }
        let (moves, pull) = projector.least_moves(&equations);
        if !progress.at_last {
            let pull = self.known.iter().zip(&pull[with_marks..]);
            let of_held = pull.filter(|(bound, _)| self.held.contains(bound));
            let of_held: Vec<f64> = of_held.map(|(_, &pull)| pull).collect();
            release(self.held, &of_held);
        }
        Ok(moves)
    }

    /// Whether the factors made last do for one more step.
    fn serves(&self, Progress { error, last, at_last }: &Progress) -> bool {
        let (held, error_then) = &self.factored;
        self.held == held && (*at_last || *error_then < NEAR && *error < SERVES * last)
    }
}

/// The error that does where steps come to rounding: more than [`GOOD`] for thin rods far from
/// the origin, as their coordinates have no more digits.
fn reachable(axes: &IdVec<RodId, Axis>, rows: &[Row]) -> f64 {
    let farthest = axes.iter().fold(0.0, |far: f64, axis| far.max(axis.a.coords.amax()));
    let thinnest = rows.iter().fold(f64::INFINITY, |thin, row| row.diameter.min(thin));
    (ROUNDINGS * f64::EPSILON * farthest / thinnest).clamp(GOOD, PROMISED)
}

/// S of [`Projector::factor`]: contacts are firm, bounds give way a little. So do marks: what is
/// left of one is pulled at again in the next step, and where marks contradict each other, it
/// tends to the least sum of squares.
pub(super) fn yields(row: usize, contacts: usize) -> f64 {
    if row < contacts { 0.0 } else { YIELD }
}

/// Lets go of bounds that would pull rods towards them.
pub(super) fn release(held: &mut BTreeSet<Bound>, pull: &[f64]) {
    let mut pull = pull.iter();
    held.retain(|_| pull.next().is_none_or(|&p| p >= 0.0));
}

/// The contacts whose gaps are still wrong.
fn open(rows: &[Row], good: f64) -> Vec<ContactId> {
    let wrong = |row: &&Row| row.error().is_nan() || row.error() > good;
    let mut open: Vec<ContactId> = rows.iter().filter(wrong).map(|row| row.contact).collect();
    open.dedup();
    open
}
