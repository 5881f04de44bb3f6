//! A part of a frame that is brought into shape while the rest stays where it is.
//!
//! On a large frame a few rods that came too near each other concern few others: their units
//! make room in a small system, in place of one step of the whole frame.

use super::Task;
use super::bounds::{Bound, Limits};
use super::marks::Marks;
use super::shape::Circuit;
use crate::frame::axis::Axis;
use crate::frame::gaps::{Joint, touching};
use crate::ids::{ContactId, Id, IdVec, RodId};
use std::collections::BTreeMap;

/// Rods so many contacts away from those that are to make room do so as well. Fewer, and their
/// units are distorted more; more, and it takes longer.
const RINGS: usize = 8;

/// Rods that may move, the rods around them, and all that they share.
pub struct Patch {
    /// The rods of the frame that are in it, those that may move first.
    rods: Vec<RodId>,
    /// How many of them may move.
    pub free: usize,
    joints: IdVec<ContactId, Joint>,
    circuits: Vec<Circuit>,
    limits: Option<Limits>,
    numbers: BTreeMap<RodId, RodId>,
}

impl Patch {
    /// The patch around some of so many rods.
    pub fn around(task: &Task, rods: usize, some: impl IntoIterator<Item = RodId>) -> Self {
        let near = Near::new(task, rods);
        let mut free = near.mask(some);
        (0..RINGS).for_each(|_| free = near.grown(&free));
        let rods_of = |circuit: &Circuit| {
            let joints = circuit.contacts.iter().map(|&c| &task.joints[c]);
            joints.flat_map(|j| [j.over, j.under]).collect::<Vec<RodId>>()
        };
        let touches = |circuit: &&Circuit| rods_of(circuit).iter().any(|rod| free[rod.index()]);
        let circuits: Vec<&Circuit> = task.circuits.iter().filter(touches).collect();
        // Bounds of the rods that share a unit or a contact with them are looked at, which
        // takes the rods that those have contacts with.
        let shared = circuits.iter().flat_map(|&circuit| rods_of(circuit));
        let beside = near.mask(near.of(&near.grown(&free)).into_iter().chain(shared));
        let all = near.of(&near.grown(&beside));
        let (mut rods, fixed): (Vec<RodId>, Vec<RodId>) =
            all.into_iter().partition(|rod| free[rod.index()]);
        let free = rods.len();
        rods.extend(fixed);
        let is_in = |joint: &Joint| [joint.over, joint.under].iter().any(|r| beside[r.index()]);
        let known = task.joints.enumerate().filter(|(_, joint)| is_in(joint)).map(|(id, _)| id);
        let known: Vec<ContactId> = known.collect();
        let (numbers, contacts) = (numbered(&rods), numbered(&known));
        let joint = |id: &ContactId| {
            let joint = &task.joints[*id];
            let [over, under] = [joint.over, joint.under].map(|rod| numbers[&rod]);
            Joint { over, under, ..*joint }
        };
        let circuit = |circuit: &&Circuit| Circuit {
            contacts: circuit.contacts.iter().map(|c| contacts[c]).collect(),
            ..(*circuit).clone()
        };
        let limits = task.limits.map(|limits| part_of(limits, &rods, &beside, &contacts));
        Self {
            free,
            joints: known.iter().map(joint).collect(),
            circuits: circuits.iter().map(circuit).collect(),
            limits,
            numbers,
            rods,
        }
    }

    /// What is to be closed of it.
    pub fn task<'a>(&'a self, whole: &Task<'a>) -> Task<'a> {
        Task {
            joints: &self.joints,
            circuits: &self.circuits,
            limits: self.limits.as_ref(),
            marks: Marks::default(),
            ..*whole
        }
    }

    /// Its axes.
    pub fn cut_out(&self, axes: &IdVec<RodId, Axis>) -> IdVec<RodId, Axis> {
        self.rods.iter().map(|&rod| axes[rod]).collect()
    }

    /// Puts those that may have moved back.
    pub fn put_back(&self, from: &IdVec<RodId, Axis>, axes: &mut IdVec<RodId, Axis>) {
        for (&rod, axis) in self.rods[..self.free].iter().zip(from) {
            axes[rod] = *axis;
        }
    }

    /// A bound as the patch numbers it, if all its rods are there.
    pub fn bound(&self, bound: Bound) -> Option<Bound> {
        let number = |rod: RodId| self.numbers.get(&rod).copied();
        Some(match bound {
            Bound::Room(rod, i) => Bound::Room(number(rod)?, i),
            Bound::Apart([p, q]) => {
                let (p, q) = (number(p)?, number(q)?);
                Bound::Apart([p.min(q), p.max(q)])
            }
        })
    }
}

/// The number of each of some elements among them.
fn numbered<I: Id + Ord>(some: &[I]) -> BTreeMap<I, I> {
    some.iter().enumerate().map(|(number, &id)| (id, I::new(number))).collect()
}

/// The limits of some rods. Of those that are not beside any that may move, some contacts are
/// not in the patch, so that they have none.
fn part_of(
    limits: &Limits,
    rods: &[RodId],
    beside: &[bool],
    contacts: &BTreeMap<ContactId, ContactId>,
) -> Limits {
    let along = |rod: &RodId| {
        let along = limits.along[*rod].iter().filter(|_| beside[rod.index()]);
        along.map(|c| contacts[c]).collect()
    };
    Limits {
        along: rods.iter().map(along).collect(),
        room: rods.iter().map(|&rod| limits.room[rod].clone()).collect(),
        beyond: rods.iter().map(|&rod| limits.beyond[rod]).collect(),
        thickness: rods.iter().map(|&rod| limits.thickness[rod]).collect(),
        diameter: limits.diameter,
    }
}

/// Which rods have contacts with which.
struct Near {
    others: IdVec<RodId, Vec<RodId>>,
}

impl Near {
    fn new(task: &Task, rods: usize) -> Self {
        Self { others: touching(rods, task.joints) }
    }

    fn mask(&self, some: impl IntoIterator<Item = RodId>) -> Vec<bool> {
        let mut mask = vec![false; self.others.len()];
        some.into_iter().for_each(|rod| mask[rod.index()] = true);
        mask
    }

    fn of(&self, mask: &[bool]) -> Vec<RodId> {
        self.others.ids().filter(|rod| mask[rod.index()]).collect()
    }

    /// With those that have contacts with some.
    fn grown(&self, mask: &[bool]) -> Vec<bool> {
        let some = self.of(mask);
        self.mask(some.iter().flat_map(|&rod| self.others[rod].iter().copied().chain([rod])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::close::tests::{limits, two_circuits, wanted};

    #[test]
    fn a_patch_holds_what_its_rods_share() {
        let (axes, joints) = two_circuits(40, 9.0);
        let limits = limits(&axes, &joints, 3.0);
        let first: IdVec<ContactId, Joint> = joints.iter().take(40).cloned().collect();
        let circuits = [wanted(&first, [0.0; 3])];
        let (marks, roam, edge) = (Marks::default(), None, 60.0);
        let task =
            Task { joints: &joints, circuits: &circuits, limits: Some(&limits), marks, roam, edge };

        // Of the second circuit rods near one are free; their neighbours do not move.
        let patch = Patch::around(&task, axes.len(), [RodId::new(60)]);
        assert_eq!(patch.free, 2 * RINGS + 1);
        let part = patch.task(&task);
        let there = patch.cut_out(&axes);
        assert_eq!((there.len(), part.joints.len()), (patch.free + 4, patch.free + 3));
        assert!(part.circuits.is_empty());
        let number = patch.numbers[&RodId::new(60)];
        assert_eq!(there[number], axes[RodId::new(60)]);
        assert_eq!(patch.bound(Bound::Room(RodId::new(60), 0)), Some(Bound::Room(number, 0)));
        assert_eq!(patch.bound(Bound::Apart([3, 60].map(RodId::new))), None);
        for joint in part.joints {
            let pair = [joint.over, joint.under].map(|rod| patch.rods[rod.index()]);
            assert!(joints.iter().any(|j| [j.over, j.under] == pair));
        }

        // A unit comes with all of its rods, however far away.
        let patch = Patch::around(&task, axes.len(), [RodId::new(0)]);
        assert_eq!((patch.free, patch.rods.len()), (2 * RINGS + 1, 40));
        assert_eq!(patch.task(&task).circuits[0].contacts.len(), 40);
    }

    #[test]
    fn only_rods_that_may_move_are_put_back() {
        let (axes, joints) = two_circuits(40, 9.0);
        let (marks, roam, edge) = (Marks::default(), None, 60.0);
        let task = Task { joints: &joints, circuits: &[], limits: None, marks, roam, edge };
        let patch = Patch::around(&task, axes.len(), [RodId::new(5)]);
        let mut there = patch.cut_out(&axes);
        there.iter_mut().for_each(|axis| axis.a.z += 1.0);
        let mut back = axes.clone();
        patch.put_back(&there, &mut back);
        let moved = axes.ids().filter(|&rod| back[rod] != axes[rod]).count();
        assert_eq!(moved, patch.free);
    }
}
