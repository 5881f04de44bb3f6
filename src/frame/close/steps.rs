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
//! units long pass through them, which ε alone would hold back. After the first step, when
//! contacts are near, ε therefore falls at once as low as frames of that many units want it.
//!
//! A term that is larger than it was at the start weighs more, and steps end when none is and
//! rods that came too near each other have had a step to make room, or rods would have to move
//! too far for more. In large frames they make [room](super::room) by themselves.

use super::bounds::Bound;
use super::equations::{Moves, moved};
use super::projector::Projector;
use super::room::with_room;
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
    /// The least ε and κ; ε of a frame of one unit.
    pub least: [f64; 2],
    /// ε and κ are divided by this after good steps.
    pub easing: [f64; 2],
    /// They are multiplied by this after bad ones.
    pub stiffening: f64,
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
        easing: [4.0; 2],
        stiffening: 4.0,
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
        least: [LEAST_FIDELITY, 1e-3],
        easing: [1e3, 10.0],
        stiffening: 10.0,
        steps: 10,
        settled: 0.003,
        ..Self::NEAR
    };

    /// The paper's weights, to stillness.
    pub const PAPER: Self = Self {
        contacts: 500.0,
        fidelity: 1.0,
        easing: [1.0; 2],
        stiffening: 1.0,
        steps: 60,
        settled: 1e-6,
        corrected: false,
        ..Self::NEAR
    };
}

/// The least ε times the number of units to the power of 3/2. Frames are as soft to long waves
/// as something between a membrane, whose softest wave is the softer by the number of units,
/// and a plate, where it is its square. Larger, and large frames creep; smaller, and steps
/// overshoot. Tried on 250, 3,300 and 32,000 units, which take one, three and five steps.
const LEAST_FIDELITY: f64 = 5.0;

/// Frames of so many rods are large: what is done for few of them need not be done for all.
pub const MANY: usize = 2000;

/// A step that is shortened less than this was good.
const WHOLE: f64 = 0.9;

impl Weighing {
    /// The same for a frame of so many units.
    fn of_units(&self, units: usize) -> Self {
        let [fidelity, strain] = self.least;
        let fidelity = fidelity / (units.max(1) as f64).powf(1.5);
        Self { least: [fidelity.min(self.fidelity), strain], ..*self }
    }

    /// After a step of which `part` was taken: less damping where it was good, more where it
    /// was not (Levenberg and Marquardt).
    fn loosen(&mut self, part: f64) {
        let [fidelity, strain] = match part {
            p if p >= WHOLE => self.easing.map(f64::recip),
            p if p < WHOLE / 2.0 => [self.stiffening; 2],
            _ => [1.0; 2],
        };
        self.fidelity = (self.fidelity * fidelity).max(self.least[0]);
        self.strain = (self.strain * strain).max(self.least[1]);
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
    /// Looks at rods.
    ///
    /// # Errors
    /// [`CloseError::Parallel`].
    pub fn new(axes: IdVec<RodId, Axis>, task: &Task) -> Result<Self, CloseError> {
        let rows = gap_rows(&axes, task.joints)?;
        let open = rows.iter().map(|row| ((row.wanted - row.gap) / task.edge).powi(2)).sum();
        let energy = task.energy(&axes);
        Ok(Self { axes, rows, open, energy })
    }

    /// E.
    pub fn distortion(&self, weights: &Weights) -> f64 {
        self.energy.total(weights)
    }

    /// C F1² + E: what steps have to lower.
    fn measure(&self, weighing: &Weighing) -> f64 {
        weighing.contacts * self.open + self.distortion(&weighing.shape)
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
    let mut system = System::new(weighing.of_units(task.circuits.len()), projector);
    if let Some(roam) = task.roam
        && weighing.corrected
        && system.roams(&now, task, roam)?
    {
        return Ok(0);
    }
    // Of many rods, those that came too near each other make room when all are in shape.
    let many = weighing.corrected && now.axes.len() >= MANY;
    let mut bounds = task.bounds(&now.axes, &now.rows);
    if many && let Some(bounds) = bounds.take() {
        let broken = bounds.broken(&now.axes, &now.rows).into_iter().collect();
        if task.is_crowded(&broken) {
            return Ok(0);
        }
    }
    let wanted = now.energy;
    let in_shape = |now: &State| weighing.corrected && now.energy.is_within(&wanted);
    let (mut taken, mut last, mut roomy) = (0, false, !many);
    while taken < weighing.steps && !last {
        let before = held.len();
        if let Some(bounds) = &bounds {
            held.extend(bounds.broken(&now.axes, &now.rows));
        }
        if many && taken > 0 && in_shape(&now) {
            now = with_room(now, task, &system.weighing, held)?;
            roomy = true;
            if in_shape(&now) {
                break;
            }
        }
        // The step after that makes room where rods came too near each other.
        last = taken > 0 && in_shape(&now);
        if task.is_crowded(held) || last && held.len() == before {
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
        (now, roomy) = (next, !many);
        taken += 1;
        if slow {
            break;
        }
    }
    if taken > 0 && !roomy {
        now = with_room(now, task, &system.weighing, held)?;
    }
    *axes = now.axes;
    Ok(taken)
}

/// The mean distance between the ends of axes and where they were, mm.
fn mean_move(from: &IdVec<RodId, Axis>, to: &IdVec<RodId, Axis>) -> f64 {
    let ends = |(p, q): (&Axis, &Axis)| p.moves_to(q).iter().sum::<f64>() / 2.0;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// After a good step ε falls at once to what so many units want, κ little by little; bad
    /// steps raise both.
    #[test]
    fn damping_of_large_frames_falls_at_once() {
        let mut weighing = Weighing::FREE.of_units(10_000);
        weighing.loosen(1.0);
        assert_eq!([weighing.fidelity, weighing.strain], [5e-6, 1e-3]);
        weighing.loosen(0.5);
        assert_eq!([weighing.fidelity, weighing.strain], [5e-6, 1e-3]);
        weighing.loosen(0.25);
        assert_eq!([weighing.fidelity, weighing.strain], [5e-5, 1e-2]);
    }

    #[test]
    fn damping_of_small_frames_never_rises_after_good_steps() {
        for units in [0, 1, 10, 100] {
            let mut weighing = Weighing::FREE.of_units(units);
            let before = weighing.fidelity;
            weighing.loosen(1.0);
            assert!(weighing.fidelity <= before, "{units}");
        }
    }
}
