//! Length classes: rods that are sawn to the same length.

use super::letters;
use crate::frame::Frame;
use crate::frame::measure::SAME_LENGTH;
use crate::ids::{IdVec, RodId};

/// Rods of one cut length.
#[derive(Clone, PartialEq, Debug)]
pub struct LengthClass {
    /// `A` for the longest, then `B` … `Z`, `AA` …
    pub name: String,
    /// Cut length, mm.
    pub length: f64,
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

/// The cut length of every rod, mm.
pub fn cut_lengths(frame: &Frame) -> IdVec<RodId, f64> {
    frame.rods.iter().map(|rod| rod.axis.length()).collect()
}

/// The length classes of a frame.
pub fn classes(frame: &Frame) -> LengthClasses {
    classes_of(&cut_lengths(frame))
}

/// The length classes of rods of the given lengths, mm.
pub fn classes_of(lengths: &IdVec<RodId, f64>) -> LengthClasses {
    let mut order: Vec<RodId> = lengths.ids().collect();
    order.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]).then(a.cmp(&b)));
    let mut classes: Vec<LengthClass> = Vec::new();
    let mut class_of: IdVec<RodId, usize> = vec![0; lengths.len()].into();
    for rod in order {
        match classes.last_mut() {
            Some(class) if class.length - lengths[rod] <= SAME_LENGTH => class.rods.push(rod),
            _ => classes.push(LengthClass {
                name: letters(classes.len(), 'A'),
                length: lengths[rod],
                rods: vec![rod],
            }),
        }
        class_of[rod] = classes.len() - 1;
    }
    for class in &mut classes {
        class.rods.sort();
    }
    LengthClasses { classes, class_of }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::shop::fixture;
    use proptest::prelude::*;

    #[test]
    fn noise_does_not_split_a_class() {
        let lengths = vec![100.0, 250.5, 100.0 + 1e-9, 250.5 - 1e-9, 90.0].into();
        let classes = classes_of(&lengths);
        let ids = |numbers: &[usize]| numbers.iter().map(|&i| RodId::new(i)).collect::<Vec<_>>();
        let found: Vec<_> = classes.iter().map(|c| (c.name.as_str(), c.rods.clone())).collect();
        assert_eq!(found, [("A", ids(&[1, 3])), ("B", ids(&[0, 2])), ("C", ids(&[4]))]);
        assert_eq!(classes.of(RodId::new(2)).name, "B");
    }

    #[test]
    fn a_regular_circuit_has_one_class() {
        let frame = fixture::circuit(6, 3.0);
        assert_eq!(classes(&frame).len(), 1);
    }

    proptest! {
        #[test]
        fn each_rod_is_in_one_class_and_classes_fall(steps in proptest::collection::vec(1u32..40, 0..80)) {
            let lengths: IdVec<RodId, f64> = steps.iter().map(|&s| f64::from(s) * 0.5).collect();
            let classes = classes_of(&lengths);
            let distinct: std::collections::BTreeSet<_> = steps.iter().collect();
            prop_assert_eq!(classes.len(), distinct.len());
            prop_assert!(classes.classes.windows(2).all(|w| w[0].length > w[1].length));
            let mut seen: Vec<RodId> = classes.iter().flat_map(|c| c.rods.clone()).collect();
            seen.sort();
            prop_assert!(seen.into_iter().eq(lengths.ids()));
            for rod in lengths.ids() {
                prop_assert_eq!(classes.of(rod).length, lengths[rod]);
            }
        }
    }
}
