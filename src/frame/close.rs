//! Makes every contact exact: the axes of its rods end up exactly one gap apart.
//!
//! Each Newton step makes the least move of all ends that meets the linearised gaps,
//! dx = Jᵀ (J Jᵀ)⁻¹ r, with J of [`gaps`](super::gaps) and one sparse Cholesky
//! factorisation. It converges quadratically.
//!
//! Sliding a rod along itself changes no gap of a crossing, so no step does it but for
//! ends that meet.

use super::axis::Axis;
use super::gaps::{Incidence, Joint, Row, incidence, product, rows};
use crate::ids::{ContactId, IdVec, RodId};
use crate::linalg::{LinalgError, SpdSolver, block_entries};
use crate::surface::Vector3;
use serde::Serialize;

/// What closing took.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Closing {
    /// Newton steps.
    pub steps: usize,
    /// Largest error of a gap left, as part of the wanted gap.
    pub error: f64,
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

/// Error of a gap, as part of it, at which closing is done: the last step before
/// this is quadratic, so what is left is rounding. A larger bound would stop one
/// step early and leave errors that marks to 0.1 mm never show but checks do.
const EXACT: f64 = 1e-12;

/// Errors up to this get one more step, and no more where rounding keeps a large
/// frame from [`EXACT`]: ten times below what the structure file promises.
const GOOD: f64 = 1e-10;

/// Steps before giving up; good starts take three to five.
const MAX_STEPS: usize = 40;

/// Longest move of an end in one step, in diameters. Longer moves leave the range in
/// which the linearised gaps say anything; the step is shortened.
const LONGEST_MOVE: f64 = 8.0;

/// Moves the axes by as little as possible until every joint has its gap.
///
/// The axes should run from contact to contact.
///
/// # Errors
/// [`CloseError`]; the axes are then in no useful state.
pub fn close(
    axes: &mut IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<Closing, CloseError> {
    let mut rows = equations(axes, joints)?;
    let incidence = incidence(axes.len(), &rows);
    let mut entries = Vec::new();
    for around in &incidence {
        entries.extend(block_entries(around.len()).map(|(i, j)| (around[i].row, around[j].row)));
    }
    let mut solver = SpdSolver::new(rows.len(), &entries).map_err(CloseError::Linear)?;
    let mut values = Vec::with_capacity(entries.len());
    let mut last = f64::INFINITY;
    for step in 0..=MAX_STEPS {
        let error = rows.iter().map(Row::error).fold(0.0, worse);
        let polished = error <= GOOD && last <= GOOD;
        if error <= EXACT || polished {
            return Ok(Closing { steps: step, error });
        }
        if step == MAX_STEPS || error.is_nan() {
            return Err(CloseError::Diverged { open: open(&rows) });
        }
        last = error;
        values.clear();
        for around in &incidence {
            values.extend(
                block_entries(around.len()).map(|(i, j)| product(&rows, around[i], around[j])),
            );
        }
        solver.factor(&values).map_err(CloseError::Linear)?;
        let mut pull: Vec<f64> = rows.iter().map(|row| row.wanted - row.gap).collect();
        solver.solve(&mut pull);
        step_ends(axes, &incidence, &rows, &pull);
        rows = equations(axes, joints)?;
    }
    unreachable!("the last round of the loop returns")
}

fn equations(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<Vec<Row>, CloseError> {
    rows(axes, joints).map_err(CloseError::Parallel)
}

/// The contacts whose gaps are still wrong.
fn open(rows: &[Row]) -> Vec<ContactId> {
    let wrong = |row: &&Row| row.error().is_nan() || row.error() > GOOD;
    let mut open: Vec<ContactId> = rows.iter().filter(wrong).map(|row| row.contact).collect();
    open.dedup();
    open
}

/// The larger of two errors; not a number is the worst of all.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Moves the ends by Jᵀ `pull`, shortened where the longest move is too long.
fn step_ends(
    axes: &mut IdVec<RodId, Axis>,
    incidence: &IdVec<RodId, Vec<Incidence>>,
    rows: &[Row],
    pull: &[f64],
) {
    let mut moves = Vec::with_capacity(axes.len());
    let mut part = 1.0f64;
    for around in incidence {
        let (mut a, mut b) = (Vector3::zeros(), Vector3::zeros());
        let mut diameter = f64::INFINITY;
        for i in around {
            let row = rows[i.row].at_rod(i.over);
            let force = row.normal * pull[i.row];
            a += force * row.at_a;
            b += force * row.at_b;
            diameter = diameter.min(rows[i.row].diameter);
        }
        let longest = a.norm().max(b.norm());
        if longest > LONGEST_MOVE * diameter {
            part = part.min(LONGEST_MOVE * diameter / longest);
        }
        moves.push((a, b));
    }
    for (axis, (a, b)) in axes.iter_mut().zip(&moves) {
        axis.a += a * part;
        axis.b += b * part;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::gaps::circuit;
    use crate::frame::{ContactKind, End};
    use crate::ids::Id;

    #[test]
    fn circuits_close_exactly() {
        for n in 3..=8 {
            let (mut axes, joints) = circuit(n, 3.0);
            let done = close(&mut axes, &joints).unwrap();
            assert!(done.error <= EXACT && done.steps <= 6, "{n}: {done:?}");
            for joint in &joints {
                let x = axes[joint.over].cross(&axes[joint.under], &joint.outward).unwrap();
                assert!((x.rise - 3.0).abs() < 1e-11, "{n}: {}", x.rise);
            }
        }
    }

    /// Two circuits side by side, joined by the ends of one rod of each.
    #[test]
    fn ends_that_meet_come_together_exactly() {
        let (mut axes, mut joints) = circuit(4, 3.0);
        let (others, theirs) = circuit(4, 3.0);
        let away = Vector3::new(0.5, 121.0, 1.0);
        for axis in &others {
            axes.push(Axis { a: axis.a + away, b: axis.b + away });
        }
        let shifted = |r: RodId| RodId::new(r.index() + 4);
        for joint in &theirs {
            let (over, under) = (shifted(joint.over), shifted(joint.under));
            joints.push(Joint { over, under, ..joint.clone() });
        }
        let (over, under) = (RodId::new(0), RodId::new(4));
        let kind = ContactKind::End([End::B, End::A]);
        joints.push(Joint { over, under, outward: Vector3::z(), diameter: 3.0, kind });
        let done = close(&mut axes, &joints).unwrap();
        assert!(done.error <= EXACT && done.steps > 0, "{done:?}");
        assert!((axes[over].b - axes[under].a).norm() < 1e-11);
        let rows = rows(&axes, &joints).unwrap();
        assert_eq!(rows.len(), 8 + 3);
        assert!(rows[..8].iter().all(|row| (row.gap - 3.0).abs() < 1e-11));
    }

    #[test]
    fn a_closed_frame_does_not_move() {
        let (mut axes, joints) = circuit(5, 2.0);
        close(&mut axes, &joints).unwrap();
        let before = axes.clone();
        assert_eq!(close(&mut axes, &joints).unwrap().steps, 0);
        assert_eq!(axes, before);
    }
}
