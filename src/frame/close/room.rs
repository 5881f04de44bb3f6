//! Room for rods of a large frame that came too near each other: the units around them give
//! way, each [patch](super::patch) by itself, in place of a step of the whole frame.

use super::bounds::Bound;
use super::equations::moved;
use super::patch::Patch;
use super::shape::Weights;
use super::steps::{State, Weighing};
use super::system::System;
use super::{CloseError, Task};
use std::collections::BTreeSet;

/// Steps of a patch. The first makes room, the next for those who came too near by that; fewer,
/// and some are left too near where rods are crowded.
const ROUNDS: usize = 4;

/// ε of these steps: moves are short, and where units are distorted less damped ones overshoot.
const FIDELITY: f64 = 0.1;

/// Room for which the units of a patch are so many times farther from their shape is none.
const WORSE: f64 = 2.0;

/// How many times firmer contacts are than in other steps, since no correction follows.
const FIRMER: f64 = 100.0;

/// How many times more the sides of units count than in other steps: they are what room is
/// made at the cost of.
const LONGER: f64 = 5.0;

/// Where a frame comes to when rods near those that are too near each other, or are held apart,
/// move until there is room. It stays as it is where that would distort units much.
///
/// # Errors
/// [`CloseError`] where the step of a whole frame would meet it.
pub fn with_room(
    now: State,
    task: &Task,
    weighing: &Weighing,
    held: &mut BTreeSet<Bound>,
) -> Result<State, CloseError> {
    let Some(bounds) = task.bounds(&now.axes, &now.rows) else { return Ok(now) };
    held.extend(bounds.broken(&now.axes, &now.rows));
    if held.is_empty() || task.is_crowded(held) {
        return Ok(now);
    }
    let patch = Patch::around(task, now.axes.len(), held.iter().flat_map(Bound::rods));
    let part = patch.task(task);
    let mut state = State::new(patch.cut_out(&now.axes), &part)?;
    let shape = Weights { sides: LONGER * weighing.shape.sides, ..weighing.shape };
    let (contacts, fidelity) = (FIRMER * weighing.contacts, FIDELITY);
    let weighing = Weighing { contacts, shape, fidelity, ..*weighing };
    let before = state.distortion(&shape);
    let mut held: BTreeSet<Bound> = held.iter().filter_map(|&b| patch.bound(b)).collect();
    for _ in 0..ROUNDS {
        let bounds = part.bounds(&state.axes, &state.rows);
        if let Some(bounds) = &bounds {
            held.extend(bounds.broken(&state.axes, &state.rows));
        }
        let mut none = None;
        let mut system = System::new(weighing, &mut none);
        system.free = patch.free;
        let moves = system.direction(&state, &part, bounds.as_ref(), &mut held)?;
        state = State::new(moved(&state.axes, &moves, 1.0), &part)?;
    }
    let after = state.distortion(&shape);
    if after.is_nan() || after > WORSE * before {
        return Ok(now);
    }
    let mut axes = now.axes;
    patch.put_back(&state.axes, &mut axes);
    State::new(axes, task)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::close::marks::Marks;
    use crate::frame::close::tests::{limits, nearest, two_circuits};
    use crate::frame::close::{project, worst};
    use crate::frame::gaps::{Joint, circuit};
    use crate::ids::{Id, RodId};
    use crate::surface::Vector3;

    /// Of three circuits two are too near each other, and the third has nothing to do with it.
    #[test]
    fn rods_make_room_and_others_stay() {
        let (mut axes, mut joints) = two_circuits(4, 1.5);
        let (others, theirs) = circuit(4, 3.0);
        let away = Vector3::new(900.0, 0.0, 0.0);
        for axis in &others {
            axes.push(crate::frame::axis::Axis { a: axis.a + away, b: axis.b + away });
        }
        for joint in &theirs {
            let [over, under] = [joint.over, joint.under].map(|r| RodId::new(r.index() + 8));
            joints.push(Joint { over, under, ..joint.clone() });
        }
        let limits = limits(&axes, &joints, 3.0);
        project(&mut axes, &joints).unwrap();
        assert!(nearest(&axes, &joints, &limits) < 2.5);
        let (marks, circuits, roam, edge) = (Marks::default(), &[][..], None, 60.0);
        let task = Task { joints: &joints, circuits, limits: Some(&limits), marks, roam, edge };
        let mut held = BTreeSet::new();
        let now = State::new(axes.clone(), &task).unwrap();
        let then = with_room(now, &task, &Weighing::FREE, &mut held).unwrap();
        let room = nearest(&then.axes, &joints, &limits);
        assert!((3.0 - 1e-9..3.01).contains(&room), "{room}");
        assert!(worst(&then.rows) < 1e-6, "{}", worst(&then.rows));
        assert!(!held.is_empty());
        assert!(axes.ids().skip(8).all(|rod| axes[rod] == then.axes[rod]));
        assert!(axes.ids().take(8).any(|rod| axes[rod] != then.axes[rod]));
    }
}
