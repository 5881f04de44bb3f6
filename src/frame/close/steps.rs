//! Steps that bring the units into shape while the contacts come together (paper,
//! section 5.2).
//!
//! A Gauss-Newton step minimises C F1² + E + ε |Δ|² + κ |δ|² of its linearised terms, lengths
//! in tile edges: F1 are the errors of the gaps, Δ the moves of the rod ends, δ the moves of
//! the corners of each unit against each other. The paper takes C = 500, ε = 1 and κ = 0, and
//! creeps. With C ten times larger contacts come near at once, and with less damping after
//! every good step units find their shape in a few. What has to be damped is that units are
//! distorted, since there the terms bend; where a whole neighbourhood moves, they hardly do.
//! So κ keeps large frames from creeping: their units only come into shape when waves many
//! units long pass through them, which ε alone would hold back.
//!
//! A term that is larger than it was at the start weighs more, and steps end when none is, or
//! rods would have to move too far for more.

use super::bounds::Bound;
use super::equations::{Moves, moved};
use super::projector::Projector;
use super::shape::{Energy, Weights};
use super::system::System;
use super::{CloseError, Task, gap_rows};
use crate::frame::axis::Axis;
use crate::frame::gaps::Row;
use crate::ids::{IdVec, RodId};
use std::collections::BTreeSet;

/// How contacts are weighed against shape, and when to stop.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Weighing {
    /// C: weight of F1², the error of a gap in tile edges.
    pub contacts: f64,
    /// Weights of the terms of E.
    pub shape: Weights,
    /// How many times a term of E that is larger than at the start counts at most.
    pub most: f64,
    /// ε: weight of the moves of rod ends.
    pub fidelity: f64,
    /// κ: weight of the moves of a unit's corners against each other.
    pub strain: f64,
    /// The least ε and κ.
    pub least: [f64; 2],
    /// Factor on ε and κ after good and bad steps.
    pub easing: f64,
    /// Most steps.
    pub steps: usize,
    /// Steps end when one takes off less than this part of C F1² + E.
    pub settled: f64,
    /// Whether steps are corrected to second order.
    pub corrected: bool,
}

impl Weighing {
    /// Contacts as good as firm, moves small: for rods that are to stay near where they are.
    pub const NEAR: Self = Self {
        contacts: 5e3,
        shape: Weights::PAPER,
        most: 1.0,
        fidelity: 1.0,
        strain: 0.0,
        least: [0.0; 2],
        easing: 4.0,
        steps: 5,
        settled: 0.03,
        corrected: true,
    };

    /// The same for rods that may go anywhere. F4 is the last to come down and the smallest:
    /// it weighs more than in the paper.
    pub const FREE: Self = Self {
        shape: Weights { sides: 9.0, ..Weights::PAPER },
        most: 3.0,
        fidelity: 1e-3,
        strain: 1e-2,
        least: [1e-6, 1e-3],
        easing: 10.0,
        steps: 10,
        settled: 0.003,
        ..Self::NEAR
    };

    /// The paper's weights, to stillness.
    pub const PAPER: Self = Self {
        contacts: 500.0,
        fidelity: 1.0,
        easing: 1.0,
        steps: 60,
        settled: 1e-6,
        corrected: false,
        ..Self::NEAR
    };
}

/// A step that is shortened less than this was good.
const WHOLE: f64 = 0.9;

impl Weighing {
    /// After a step of which `part` was taken: less damping where it was good, more where it
    /// was not (Levenberg and Marquardt).
    fn loosen(&mut self, part: f64) {
        let by = match part {
            p if p >= WHOLE => self.easing.recip(),
            p if p < WHOLE / 2.0 => self.easing,
            _ => 1.0,
        };
        let [fidelity, strain] = self.least;
        self.fidelity = (self.fidelity * by).max(fidelity);
        self.strain = (self.strain * by).max(strain);
    }

    /// The longest move of an end in one step, in tile edges.
    fn longest(&self) -> f64 {
        if self.strain > 0.0 { LONGEST_DAMPED } else { LONGEST_MOVE }
    }
}

/// Longest move of an end in one step, in tile edges.
pub const LONGEST_MOVE: f64 = 0.25;

/// The same where units are kept from being distorted: a whole neighbourhood may go farther.
const LONGEST_DAMPED: f64 = 3.0;

/// Times that a step is halved before it is given up.
const HALVINGS: u8 = 4;

/// Where steps have come to.
pub struct State {
    /// The rods.
    pub axes: IdVec<RodId, Axis>,
    /// Their gaps.
    pub rows: Vec<Row>,
    /// F1², summed over the contacts.
    open: f64,
    energy: Energy,
}

impl State {
    fn new(axes: IdVec<RodId, Axis>, task: &Task) -> Result<Self, CloseError> {
        let rows = gap_rows(&axes, task.joints)?;
        let open = rows.iter().map(|row| ((row.wanted - row.gap) / task.edge).powi(2)).sum();
        let energy = task.energy(&axes);
        Ok(Self { axes, rows, open, energy })
    }

    /// C F1² + E: what steps have to lower.
    fn measure(&self, weighing: &Weighing) -> f64 {
        weighing.contacts * self.open + self.energy.total(&weighing.shape)
    }
}

/// Takes steps until they change little. Returns their number.
pub fn settle(
    axes: &mut IdVec<RodId, Axis>,
    task: &Task,
    weighing: &Weighing,
    held: &mut BTreeSet<Bound>,
    projector: &mut Option<Projector>,
) -> Result<usize, CloseError> {
    let mut now = State::new(axes.clone(), task)?;
    let bounds = task.bounds(&now.axes, &now.rows);
    let mut system = System::new(*weighing, projector);
    let wanted = now.energy;
    let mut taken = 0;
    while taken < weighing.steps {
        if let Some(bounds) = &bounds {
            held.extend(bounds.broken(&now.axes, &now.rows));
        }
        if task.is_crowded(held) {
            break;
        }
        system.weighing.shape = weighing.shape.by_excess(&now.energy, &wanted, weighing.most);
        let before = now.measure(&system.weighing);
        let moves = system.direction(&now, task, bounds.as_ref(), held)?;
        let Some((next, part)) = shortened(&mut system, &now, &moves, task) else { break };
        let slow =
            part >= WHOLE && before - next.measure(&system.weighing) < weighing.settled * before;
        system.weighing.loosen(part);
        if task.roam.is_some_and(|roam| mean_move(axes, &next.axes) > roam) {
            break;
        }
        now = next;
        taken += 1;
        if slow || weighing.corrected && now.energy.is_within(&wanted) {
            break;
        }
    }
    *axes = now.axes;
    Ok(taken)
}

/// The mean distance between the ends of axes and where they were, mm.
fn mean_move(from: &IdVec<RodId, Axis>, to: &IdVec<RodId, Axis>) -> f64 {
    let ends = |(p, q): (&Axis, &Axis)| ((p.a - q.a).norm() + (p.b - q.b).norm()) / 2.0;
    from.iter().zip(to.iter()).map(ends).sum::<f64>() / from.len() as f64
}

/// Where a step leads, shortened until it lowers the measure, and how much of it was taken;
/// nothing where no part of it does.
fn shortened(system: &mut System, now: &State, moves: &Moves, task: &Task) -> Option<(State, f64)> {
    let weighing = system.weighing;
    let longest = super::equations::longest(moves);
    let whole = (weighing.longest() * task.edge / longest).min(1.0);
    (0..=HALVINGS).find_map(|halved| {
        let part = whole / f64::from(1 << halved);
        let mut axes = moved(&now.axes, moves, part);
        if weighing.corrected {
            axes = system.corrected(now, axes, part, task).ok()?;
        }
        let next = State::new(axes, task).ok()?;
        (next.measure(&weighing) < now.measure(&weighing)).then_some((next, part))
    })
}
