//! Makes every contact exact: the axes of its rods end up exactly one gap apart (paper,
//! section 5.2).
//!
//! First come [steps] that bring the units into shape while contacts come near, then the
//! [exact] projection onto the contacts. Both keep [bounds]: contacts in order along their
//! rods, and rods that do not touch apart.
//!
//! Sliding a rod along itself changes no gap of a crossing and no unit's shape, so nothing
//! does it but ends that meet.

pub(super) mod across;
pub mod bounds;
pub(super) mod equations;
mod exact;
pub mod marks;
mod normal;
mod outlook;
mod patch;
mod projector;
mod room;
pub mod shape;
mod steps;
mod system;
pub(super) mod touch;
mod unit_terms;

use super::axis::Axis;
use super::gaps::{Joint, Row, rows};
use crate::ids::{ContactId, IdVec, RodId};
use crate::linalg::LinalgError;
use bounds::{Bound, Bounds, Limits};
use exact::exact;
use marks::Marks;
use serde::{Deserialize, Serialize};
use shape::{Circuit, Energy, energy};
use std::collections::BTreeSet;
use steps::{Weighing, settle};

/// How contacts are closed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// Units are kept in shape, then every contact is made exact
    #[default]
    Shape,
    /// Every contact is made exact by the least move of the rods
    Least,
    /// The weighted sum of the paper: contacts only come near
    Paper,
}

/// Bounds for each contact from which they are let be: whoever checks the frame will find
/// it hopeless. More, and hopeless frames take minutes to be refused; fewer, and some with
/// a crowded corner are.
const CROWDED: f64 = 0.1;

/// So many bounds are never too many: a small frame is soon solved with all of them.
const FEW: usize = 12;

/// What is to be closed.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The contacts.
    pub joints: &'a IdVec<ContactId, Joint>,
    /// The inner polygons, as they are wanted.
    pub circuits: &'a [Circuit],
    /// What to keep, if anything.
    pub limits: Option<&'a Limits>,
    /// Rods whose marks are held; steps that shape the units take no heed of them.
    pub marks: Marks<'a>,
    /// How far rod ends may move in the mean for the shape of units, mm; any distance if not
    /// given.
    pub roam: Option<f64>,
    /// Mean tile edge, mm: the unit of lengths.
    pub edge: f64,
}

/// What closing took.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Closing {
    /// Steps that shape the units.
    pub shaping: usize,
    /// Newton steps onto the contacts.
    pub steps: usize,
    /// Largest error of a gap left, as part of the wanted gap.
    pub error: f64,
    /// Shape of the units before and after, summed.
    pub energy: [Energy; 2],
    /// Bounds that hold rods back.
    pub held: usize,
}

/// Why contacts could not be closed.
#[derive(Clone, Debug, PartialEq)]
pub enum CloseError {
    /// The rods of a contact turned parallel.
    Parallel(ContactId),
    /// The steps did not settle; the contacts that were still open.
    Diverged { open: Vec<ContactId> },
    /// Contacts contradict each other.
    Linear(LinalgError),
}

impl From<LinalgError> for CloseError {
    fn from(e: LinalgError) -> Self {
        Self::Linear(e)
    }
}

/// Closes all contacts. The axes should run from contact to contact.
///
/// Where steps that shape the units lead nowhere, the projection starts anew without them,
/// and at last without bounds.
///
/// # Errors
/// [`CloseError`]; the axes are then in no useful state.
pub fn close(axes: &mut IdVec<RodId, Axis>, task: &Task, way: Way) -> Result<Closing, CloseError> {
    let start = axes.clone();
    let free = Task { limits: None, ..*task };
    let first = match way {
        Way::Paper => return approach(axes, task),
        Way::Shape => shaped(axes, task),
        Way::Least => least(axes, task),
    };
    let mut again = |closed: Result<Closing, CloseError>, task: &Task| {
        closed.or_else(|_| {
            axes.clone_from(&start);
            least(axes, task)
        })
    };
    let second = again(first, task);
    again(second, &free)
}

/// The same by projection alone: the least move that meets all contacts, and nothing else.
///
/// # Errors
/// [`CloseError`]; the axes are then in no useful state.
pub fn project(
    axes: &mut IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<Closing, CloseError> {
    least(
        axes,
        &Task {
            joints,
            circuits: &[],
            limits: None,
            marks: Marks::default(),
            roam: None,
            edge: 1.0,
        },
    )
}

fn shaped(axes: &mut IdVec<RodId, Axis>, task: &Task) -> Result<Closing, CloseError> {
    let (before, mut held, mut projector) = (task.energy(axes), BTreeSet::new(), None);
    let weighing = if task.roam.is_some() { &Weighing::NEAR } else { &Weighing::FREE };
    let shaping = settle(axes, task, weighing, &mut held, &mut projector)?;
    let done = exact(axes, task, &mut held, &mut projector)?;
    Ok(task.closing(shaping, done.steps, done.error, [before, task.energy(axes)], &held))
}

fn least(axes: &mut IdVec<RodId, Axis>, task: &Task) -> Result<Closing, CloseError> {
    let (before, mut held) = (task.energy(axes), BTreeSet::new());
    let done = exact(axes, task, &mut held, &mut None)?;
    Ok(task.closing(0, done.steps, done.error, [before, task.energy(axes)], &held))
}

/// The paper's own way.
fn approach(axes: &mut IdVec<RodId, Axis>, task: &Task) -> Result<Closing, CloseError> {
    let (before, mut held) = (task.energy(axes), BTreeSet::new());
    let shaping = settle(axes, task, &Weighing::PAPER, &mut held, &mut None)?;
    let error = worst(&gap_rows(axes, task.joints)?);
    Ok(task.closing(shaping, 0, error, [before, task.energy(axes)], &held))
}

impl<'a> Task<'a> {
    fn energy(&self, axes: &IdVec<RodId, Axis>) -> Energy {
        energy(axes, self.joints, self.circuits, self.edge)
    }

    /// Whether so many bounds are to be held that the frame has no room for its rods.
    fn is_crowded(&self, held: &BTreeSet<Bound>) -> bool {
        held.len() > FEW && held.len() as f64 > CROWDED * self.joints.len() as f64
    }

    fn closing(
        &self,
        shaping: usize,
        steps: usize,
        error: f64,
        energy: [Energy; 2],
        held: &BTreeSet<Bound>,
    ) -> Closing {
        Closing { shaping, steps, error, energy, held: held.len() }
    }

    fn bounds(&self, axes: &IdVec<RodId, Axis>, rows: &[Row]) -> Option<Bounds<'a>> {
        Some(Bounds::new(axes, self.joints, rows, self.limits?))
    }
}

fn gap_rows(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<Vec<Row>, CloseError> {
    rows(axes, joints).map_err(CloseError::Parallel)
}

/// The largest error of a gap, as part of the diameter; not a number is the worst of all.
fn worst(rows: &[Row]) -> f64 {
    let worse = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
    rows.iter().map(Row::error).fold(0.0, worse)
}

#[cfg(test)]
mod tests;
