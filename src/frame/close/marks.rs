//! Marks that are held: of rods that are sawn and marked already, contacts have to come to
//! lie where their marks are.
//!
//! A rod slides along itself freely, so one mark only says where its end A is. Of more, it is
//! held how each lies to the mean of all: with p the places of the contacts along the axis and
//! m the marks,
//!
//! ```text
//! p − mean p = m − mean m.
//! ```
//!
//! One of these follows from the others, and those of many rods may contradict each other;
//! so marks give way a little, as bounds do.

use super::bounds::add;
use super::equations::{Equations, Move, pair};
use super::touch::{Place, Touch};
use super::{CloseError, Task};
use crate::frame::axis::Axis;
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::Vector3;
use std::collections::BTreeMap;

/// A rod that is sawn, with the marks on it.
#[derive(Clone, Debug)]
pub struct MarkedRod {
    /// The rod.
    pub rod: RodId,
    /// Contacts, and how far from end A their marks are, mm.
    pub marks: Vec<(ContactId, f64)>,
    /// The height at which its end A stands on the ground, mm, if it does.
    pub foot: Option<f64>,
}

/// The marks that are held.
#[derive(Clone, Copy, Default, Debug)]
pub struct Marks<'a> {
    /// The rods that have some.
    pub rods: &'a [MarkedRod],
    /// How far marks give way in a step, as part of their own row of J Jᵀ. More, and marks that
    /// could be met are not; less, and rods move farther for marks that contradict each other.
    pub give: f64,
}

/// Adds the equations of all marks.
///
/// # Errors
/// A contact whose rods are parallel.
pub(super) fn hold(
    task: &Task,
    axes: &IdVec<RodId, Axis>,
    to: &mut Equations,
) -> Result<(), CloseError> {
    for marked in task.marks.rods.iter().filter(|marked| !marked.marks.is_empty()) {
        let place = |&(contact, _): &(ContactId, f64)| {
            let touch = Touch::new(axes, &task.joints[contact]);
            touch.map(|t| t.place(marked.rod)).ok_or(CloseError::Parallel(contact))
        };
        let places: Vec<Place> = marked.marks.iter().map(place).collect::<Result<_, _>>()?;
        let rod = Rod { axis: &axes[marked.rod], marked, places: &places };
        if places.len() > 1 {
            (0..places.len()).for_each(|i| rod.hold_mark(i, to));
        }
        if let Some(ground) = marked.foot {
            rod.hold_foot(ground, to);
        }
    }
    Ok(())
}

/// A marked rod with the places of its marks as they are.
struct Rod<'a> {
    axis: &'a Axis,
    marked: &'a MarkedRod,
    places: &'a [Place],
}

impl Rod<'_> {
    /// Means of the places, as part of the axis, and of the marks, mm.
    fn means(&self) -> [f64; 2] {
        let n = self.places.len() as f64;
        let place = self.places.iter().map(|p| p.at).sum::<f64>() / n;
        [place, self.marked.marks.iter().map(|m| m.1).sum::<f64>() / n]
    }

    /// Adds the gradient of the mean place, as part of the axis, times a factor.
    fn add_mean(&self, parts: &mut BTreeMap<RodId, Move>, factor: f64) {
        let share = factor / self.places.len() as f64;
        self.places.iter().for_each(|p| add(parts, &p.slide, share));
    }

    /// The gradient of the length of the axis.
    fn stretch(&self) -> Move {
        let u = self.axis.direction();
        pair(-u, u)
    }

    /// How a mark lies to the mean of all.
    fn hold_mark(&self, i: usize, to: &mut Equations) {
        let ([place, mark], length) = (self.means(), self.axis.length());
        let off = self.places[i].at - place;
        let mut parts = BTreeMap::from([(self.marked.rod, self.stretch() * off)]);
        add(&mut parts, &self.places[i].slide, length);
        self.add_mean(&mut parts, -length);
        to.push(parts, self.marked.marks[i].1 - mark - off * length);
    }

    /// End A at a height.
    fn hold_foot(&self, ground: f64, to: &mut Equations) {
        let ([place, mark], length) = (self.means(), self.axis.length());
        let along = self.axis.b - self.axis.a;
        let at = place - mark / length;
        let up = Vector3::z();
        let own =
            pair(up * (1.0 - at), up * at) + self.stretch() * (along.z * mark / (length * length));
        let mut parts = BTreeMap::from([(self.marked.rod, own)]);
        self.add_mean(&mut parts, along.z);
        to.push(parts, ground - self.axis.a.z - along.z * at);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::close::equations::{Moves, moved};
    use crate::frame::close::{Way, close};
    use crate::frame::gaps::{Joint, circuit};
    use crate::ids::Id;

    const LONG: [f64; 2] = [31.0, 74.5];

    fn task<'a>(joints: &'a IdVec<ContactId, Joint>, marked: &'a [MarkedRod]) -> Task<'a> {
        let marks = Marks { rods: marked, give: 1e-3 };
        Task { joints, circuits: &[], limits: None, marks, roam: None, edge: 3.0 }
    }

    fn marked(rod: usize, n: usize, foot: Option<f64>) -> MarkedRod {
        let contacts = [(rod + n - 1) % n, rod].map(ContactId::new);
        MarkedRod { rod: RodId::new(rod), marks: contacts.into_iter().zip(LONG).collect(), foot }
    }

    /// The gradients of marks and feet against central differences.
    #[test]
    fn gradients_agree_with_finite_differences() {
        let (axes, joints) = circuit(5, 3.0);
        let marked = [marked(1, 5, Some(-2.0)), marked(3, 5, None)];
        let task = task(&joints, &marked);
        let lacking = |axes: &IdVec<RodId, Axis>| {
            let mut equations = Equations::of_contacts(&[]);
            hold(&task, axes, &mut equations).unwrap();
            equations
        };
        let (base, h) = (lacking(&axes), 1e-5);
        assert_eq!(base.len(), 5);
        for rod in axes.ids() {
            for k in 0..6 {
                let mut moves: Moves = vec![Move::zeros(); axes.len()].into();
                moves[rod][k] = 1.0;
                let [plus, minus] = [h, -h].map(|h| lacking(&moved(&axes, &moves, h)).lacking);
                for (row, change) in base.changes(&moves).into_iter().enumerate() {
                    let numeric = (minus[row] - plus[row]) / (2.0 * h);
                    assert!((numeric - change).abs() < 1e-7, "{row}: {numeric} {change}");
                }
            }
        }
    }

    /// Marks that can be met are met, and the contacts stay exact.
    #[test]
    fn marks_and_feet_are_met_exactly() {
        let (mut axes, joints) = circuit(5, 3.0);
        let marked = [marked(1, 5, Some(-2.0)), marked(3, 5, None)];
        let closing = close(&mut axes, &task(&joints, &marked), Way::Least).unwrap();
        assert!(closing.error < 1e-10);
        let place = |rod: usize, c: usize| {
            let touch = Touch::new(&axes, &joints[ContactId::new(c)]).unwrap();
            touch.place(RodId::new(rod)).at * axes[RodId::new(rod)].length()
        };
        for rod in [1, 3] {
            let apart = place(rod, rod) - place(rod, rod - 1);
            assert!((apart - (LONG[1] - LONG[0])).abs() < 1e-9, "{apart}");
        }
        let axis = axes[RodId::new(1)];
        let foot = axis.at(place(1, 1) - LONG[1]);
        assert!((foot.z + 2.0).abs() < 1e-9, "{foot}");
    }

    /// Of marks that contradict each other, all give way alike, and contacts do not.
    #[test]
    fn marks_that_contradict_each_other_share_what_is_left() {
        let (mut axes, joints) = circuit(4, 3.0);
        let twice = |m: f64| MarkedRod {
            rod: RodId::new(1),
            marks: vec![(ContactId::new(0), 30.0), (ContactId::new(1), 30.0 + m)],
            foot: None,
        };
        let marked = [twice(40.0), twice(42.0)];
        let closing = close(&mut axes, &task(&joints, &marked), Way::Least).unwrap();
        assert!(closing.error < 1e-10);
        let at = |c: usize| {
            let touch = Touch::new(&axes, &joints[ContactId::new(c)]).unwrap();
            touch.place(RodId::new(1)).at * axes[RodId::new(1)].length()
        };
        assert!((at(1) - at(0) - 41.0).abs() < 1e-6, "{}", at(1) - at(0));
    }
}
