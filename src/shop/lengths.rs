//! Sticks as they are sawn, and length classes: rods of the same length and diameter.

use super::letters;
use crate::frame::measure::SAME_LENGTH;
use crate::frame::{Frame, Rod};
use crate::ids::{IdVec, RodId};
use std::cmp::Ordering;

/// What a rod is sawn from and to.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stick {
    /// Cut length, mm.
    pub length: f64,
    /// Diameters at end A and at end B, mm.
    pub diameters: [f64; 2],
}

impl Stick {
    /// Volume, mm³; of a stick that tapers, that of a cone without its tip.
    pub fn volume(&self) -> f64 {
        let [a, b] = self.diameters;
        std::f64::consts::PI / 12.0 * (a * a + a * b + b * b) * self.length
    }
}

/// Which diameters come first in lists: thin before thick.
pub fn thinner([a, b]: &[f64; 2], [c, d]: &[f64; 2]) -> Ordering {
    a.max(*b).total_cmp(&c.max(*d)).then(a.total_cmp(c)).then(b.total_cmp(d))
}

/// Rods of one cut length and diameter.
#[derive(Clone, PartialEq, Debug)]
pub struct LengthClass {
    /// `A` for the longest, then `B` … `Z`, `AA` …
    pub name: String,
    /// Cut length, mm.
    pub length: f64,
    /// Diameters at end A and at end B, mm.
    pub diameters: [f64; 2],
    /// The rods, in the order of their numbers.
    pub rods: Vec<RodId>,
}

/// The length classes of a frame, longest first.
#[derive(Clone, PartialEq, Debug)]
pub struct LengthClasses {
    /// The classes, longest first.
    pub classes: Vec<LengthClass>,
    class_of: IdVec<RodId, usize>,
}

impl LengthClasses {
    /// Number of classes.
    pub fn len(&self) -> usize {
        self.classes.len()
    }

    /// Whether there are no rods at all.
    pub fn is_empty(&self) -> bool {
        self.classes.is_empty()
    }

    /// The class of a rod.
    pub fn of(&self, rod: RodId) -> &LengthClass {
        &self.classes[self.class_of[rod]]
    }

    /// The classes, longest first.
    pub fn iter(&self) -> std::slice::Iter<'_, LengthClass> {
        self.classes.iter()
    }
}

impl<'a> IntoIterator for &'a LengthClasses {
    type Item = &'a LengthClass;
    type IntoIter = std::slice::Iter<'a, LengthClass>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The stick of every rod.
pub fn sticks(frame: &Frame) -> IdVec<RodId, Stick> {
    let stick = |rod: &Rod| Stick { length: rod.axis.length(), diameters: rod.diameters };
    frame.rods.iter().map(stick).collect()
}

/// The diameters of a frame's rods, thin ones first, and how many rods have them.
pub fn diameters(frame: &Frame) -> Vec<([f64; 2], usize)> {
    let mut all: Vec<[f64; 2]> = frame.rods.iter().map(|rod| rod.diameters).collect();
    all.sort_by(thinner);
    all.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).collect()
}

/// Whether the rods of a frame have more than one diameter.
pub fn are_mixed(frame: &Frame) -> bool {
    frame.rods.windows(2).any(|pair| pair[0].diameters != pair[1].diameters)
}

/// The length classes of a frame.
pub fn classes(frame: &Frame) -> LengthClasses {
    classes_of(&sticks(frame))
}

/// The length classes of these sticks.
pub fn classes_of(sticks: &IdVec<RodId, Stick>) -> LengthClasses {
    let mut order: Vec<RodId> = sticks.ids().collect();
    order.sort_by(|&a, &b| sticks[b].length.total_cmp(&sticks[a].length).then(a.cmp(&b)));
    let mut classes: Vec<LengthClass> = Vec::new();
    let mut class_of: IdVec<RodId, usize> = vec![0; sticks.len()].into();
    let mut left = &order[..];
    while let Some(&longest) = left.first() {
        let length = sticks[longest].length;
        let (same, rest) =
            left.split_at(left.partition_point(|&r| length - sticks[r].length <= SAME_LENGTH));
        let mut same = same.to_vec();
        let diameters = |r: RodId| sticks[r].diameters;
        same.sort_by(|&a, &b| thinner(&diameters(a), &diameters(b)).then(a.cmp(&b)));
        for rods in same.chunk_by(|&a, &b| diameters(a) == diameters(b)) {
            let name = letters(classes.len(), 'A');
            rods.iter().for_each(|&rod| class_of[rod] = classes.len());
            let diameters = diameters(rods[0]);
            classes.push(LengthClass { name, length, diameters, rods: rods.to_vec() });
        }
        left = rest;
    }
    LengthClasses { classes, class_of }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::shop::fixture;
    use proptest::prelude::*;

    fn of(lengths: impl IntoIterator<Item = f64>) -> IdVec<RodId, Stick> {
        let stick = |length| Stick { length, diameters: [3.0; 2] };
        lengths.into_iter().map(stick).collect()
    }

    #[test]
    fn noise_does_not_split_a_class() {
        let classes = classes_of(&of([100.0, 250.5, 100.0 + 1e-9, 250.5 - 1e-9, 90.0]));
        let ids = |numbers: &[usize]| numbers.iter().map(|&i| RodId::new(i)).collect::<Vec<_>>();
        let found: Vec<_> = classes.iter().map(|c| (c.name.as_str(), c.rods.clone())).collect();
        assert_eq!(found, [("A", ids(&[1, 3])), ("B", ids(&[0, 2])), ("C", ids(&[4]))]);
        assert_eq!(classes.of(RodId::new(2)).name, "B");
    }

    #[test]
    fn rods_of_one_length_and_several_diameters_are_several_classes() {
        let mut sticks = of([100.0, 100.0 + 1e-9, 100.0 - 1e-9, 100.0, 90.0]);
        for (rod, ends) in [(0, [5.0; 2]), (2, [5.0; 2]), (3, [5.0, 4.0])] {
            sticks[RodId::new(rod)].diameters = ends;
        }
        let classes = classes_of(&sticks);
        let found: Vec<_> = classes.iter().map(|c| (c.diameters, c.rods.len())).collect();
        assert_eq!(found, [([3.0; 2], 1), ([5.0, 4.0], 1), ([5.0; 2], 2), ([3.0; 2], 1)]);
        assert_eq!(classes.of(RodId::new(2)).name, "C");
    }

    #[test]
    fn a_regular_circuit_has_one_class() {
        let frame = fixture::circuit(6, 3.0);
        assert_eq!(classes(&frame).len(), 1);
    }

    proptest! {
        #[test]
        fn each_rod_is_in_one_class_and_classes_fall(steps in proptest::collection::vec(1u32..40, 0..80)) {
            let sticks = of(steps.iter().map(|&s| f64::from(s) * 0.5));
            let classes = classes_of(&sticks);
            let distinct: std::collections::BTreeSet<_> = steps.iter().collect();
            prop_assert_eq!(classes.len(), distinct.len());
            prop_assert!(classes.classes.windows(2).all(|w| w[0].length > w[1].length));
            let mut seen: Vec<RodId> = classes.iter().flat_map(|c| c.rods.clone()).collect();
            seen.sort();
            prop_assert!(seen.into_iter().eq(sticks.ids()));
            for rod in sticks.ids() {
                prop_assert_eq!(classes.of(rod).length, sticks[rod].length);
            }
        }
    }
}
