//! Contacts in overlapping patches, so that work on each is small and the whole is
//! linear in their number.

use crate::ids::{ContactId, IdVec, RodId};
use std::collections::VecDeque;

/// Some contacts that lie together.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its own contacts; every contact is in the core of one patch.
    pub core: Vec<ContactId>,
    /// Those round it.
    pub rim: Vec<ContactId>,
}

/// Groups contacts breadth first into cores of at most `core`, each with `rings` rings of
/// neighbours round it. Contacts are neighbours when they share a rod; `rods_of` names
/// the two rods of each of them, out of `rods`.
pub fn patches(
    rods_of: &IdVec<ContactId, [RodId; 2]>,
    rods: usize,
    core: usize,
    rings: usize,
) -> Vec<Patch> {
    let mut on: IdVec<RodId, Vec<ContactId>> = vec![Vec::new(); rods].into();
    for (contact, pair) in rods_of.enumerate() {
        pair.iter().for_each(|&rod| on[rod].push(contact));
    }
    let neighbours = |c: ContactId| rods_of[c].into_iter().flat_map(|rod| &on[rod]).copied();
    // The number of the last patch that saw a contact, one more than its position.
    let mut seen: IdVec<ContactId, usize> = vec![0; rods_of.len()].into();
    let mut taken: IdVec<ContactId, bool> = vec![false; rods_of.len()].into();
    let mut all: Vec<Patch> = Vec::new();
    for start in rods_of.ids() {
        if taken[start] {
            continue;
        }
        let stamp = all.len() + 1;
        let mut queue = VecDeque::from([start]);
        let mut inner = Vec::new();
        taken[start] = true;
        while let Some(contact) = queue.pop_front() {
            inner.push(contact);
            seen[contact] = stamp;
            for other in neighbours(contact) {
                if !taken[other] && inner.len() + queue.len() < core {
                    taken[other] = true;
                    queue.push_back(other);
                }
            }
        }
        let mut rim: Vec<ContactId> = Vec::new();
        let mut ring = inner.clone();
        for _ in 0..rings {
            let mut next = Vec::new();
            for other in ring.iter().flat_map(|&c| neighbours(c)) {
                if seen[other] != stamp {
                    seen[other] = stamp;
                    next.push(other);
                }
            }
            rim.extend(&next);
            ring = next;
        }
        all.push(Patch { core: inner, rim });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use std::collections::BTreeSet;

    /// Contact i joins rods i and i + 1.
    fn chain(n: usize) -> IdVec<ContactId, [RodId; 2]> {
        (0..n).map(|i| [RodId::new(i), RodId::new(i + 1)]).collect()
    }

    #[test]
    fn a_chain_falls_into_runs_with_rims_at_both_ends() {
        let index = |v: &[ContactId]| v.iter().map(|c| c.index()).collect::<BTreeSet<_>>();
        let all = patches(&chain(10), 11, 4, 2);
        let found: Vec<_> = all.iter().map(|p| (index(&p.core), index(&p.rim))).collect();
        let set = |v: &[usize]| v.iter().copied().collect::<BTreeSet<_>>();
        assert_eq!(
            found,
            [
                (set(&[0, 1, 2, 3]), set(&[4, 5])),
                (set(&[4, 5, 6, 7]), set(&[2, 3, 8, 9])),
                (set(&[8, 9]), set(&[6, 7])),
            ]
        );
    }

    #[test]
    fn every_contact_is_in_one_core() {
        for core in [1, 3, 7, 50] {
            let all = patches(&chain(23), 24, core, 1);
            let mut cores: Vec<_> = all.iter().flat_map(|p| &p.core).collect();
            cores.sort();
            assert!(cores.into_iter().map(|c| c.index()).eq(0..23), "{core}");
            assert!(all.iter().all(|p| p.core.len() <= core));
        }
    }
}
