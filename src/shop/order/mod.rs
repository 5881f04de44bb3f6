//! Assembly order: which rods are placed one after the other, and what holds them meanwhile.
//!
//! Units are placed one after the other, each with the rods that are not there yet. In
//! `crown` order they come in rings round the middle: the frame lies on the table, and rises
//! as rings are added. In `ground` order they come in rows from the feet up, and props hold
//! what would move. After each step every placed rod is held by at least two contacts, feet
//! or props, and nothing can move (see [`freedom`](crate::statics::freedom)).
//!
//! It is greedy: of the units of a ring that one comes next which has the fewest rods to be
//! slid under others, and leads to one like it; see [`choose`].

mod batch;
mod brace;
mod checks;
mod choose;
mod lay;
mod neighbors;
mod props;
mod rests;
#[cfg(test)]
mod rests_tests;
mod site;
mod topple;

#[cfg(test)]
mod tests;

use crate::frame::Frame;
use crate::ids::{ContactId, Id, PropId, RodId, UnitId};
use crate::linalg::LinalgError;
use crate::surface::Point3;
use brace::Bracing;
use choose::Chooser;
use neighbors::Neighbors;
use serde::{Deserialize, Serialize};
use site::Site;
use std::collections::BTreeMap;

/// Where assembly begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// From the middle outward, on a table: the frame rises as rings are added
    Crown,
    /// From the feet up; props hold what would move
    Ground,
}

impl Order {
    /// `crown` or `ground`, as designs name it.
    pub fn code(self) -> &'static str {
        match self {
            Self::Crown => "crown",
            Self::Ground => "ground",
        }
    }
}

/// What is asked of an order.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct OrderSettings {
    /// Where it begins; where it is not said, at the crown if no prop is needed then.
    pub order: Option<Order>,
    /// The most rods that a step places, where they hold like that.
    pub step_rods: Option<usize>,
}

/// An assembly order.
#[derive(Clone, PartialEq, Debug)]
pub struct Assembly {
    /// Where it begins.
    pub order: Order,
    /// The steps.
    pub steps: Vec<Step>,
    /// Props that the finished frame cannot do without: it needs a stand.
    pub missed: Vec<PropId>,
}

/// A step: some rods are placed, and what they touch is made.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Step {
    /// The unit that it belongs to.
    pub unit: Option<UnitId>,
    /// The rods, in the order in which they are laid.
    pub rods: Vec<RodId>,
    /// Contacts made in which the rod that is laid goes over, or ends meet.
    pub over: Vec<ContactId>,
    /// Contacts made in which the rod that is laid goes under.
    pub under: Vec<ContactId>,
    /// Rods to be lifted for those.
    pub lifts: Vec<Lift>,
    /// Circuits that are closed.
    pub closes: Vec<Closing>,
    /// Contacts made that would drop apart unless they are tied at once.
    pub ties: Vec<ContactId>,
    /// Props set.
    pub props: Vec<Prop>,
    /// Props taken away when the rods are in place.
    pub remove_props: Vec<PropId>,
    /// What to measure when the rods are in place.
    pub checks: Vec<Check>,
}

/// A rod lies already where another is to go under it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Lift {
    /// The rod to be lifted.
    pub rod: RodId,
    /// The rod that is slid under it.
    pub below: RodId,
    /// Where.
    pub contact: ContactId,
}

/// A rod closes the circuit of a unit: it joins both of its ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Closing {
    /// The unit.
    pub unit: UnitId,
    /// The rod.
    pub rod: RodId,
}

/// A stick on which a rod lies while the frame cannot carry itself. mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Prop {
    /// Its number.
    pub id: PropId,
    /// The rod.
    pub rod: RodId,
    /// Where along the rod, from end A.
    pub at: f64,
    /// Where it touches the rod from below.
    pub point: Point3,
    /// From the ground, or in crown order from the table, to that point.
    pub height: f64,
}

/// A mark or an end of a rod, to measure from.
#[derive(Clone, PartialEq, Debug)]
pub struct MarkName {
    /// The rod.
    pub rod: RodId,
    /// The letter of its mark, or `end A`.
    pub mark: String,
}

/// A distance to be measured: if it is off, something lies wrong.
#[derive(Clone, PartialEq, Debug)]
pub struct Check {
    /// The two marks.
    pub marks: [MarkName; 2],
    /// Between the axes of the two rods there, mm.
    pub distance: f64,
}

impl Assembly {
    /// How many props are set in all.
    pub fn props(&self) -> usize {
        self.steps.iter().map(|s| s.props.len()).sum()
    }

    /// The most props that stand at once.
    pub fn most_props(&self) -> usize {
        self.standing().map(|props| props.len()).max().unwrap_or(0)
    }

    /// The props that stand while each step is done, in the order in which they were set.
    pub fn standing(&self) -> impl Iterator<Item = Vec<Prop>> {
        self.steps.iter().scan(Vec::new(), |props: &mut Vec<Prop>, step| {
            props.extend(&step.props);
            let now = props.clone();
            props.retain(|prop| !step.remove_props.contains(&prop.id));
            Some(now)
        })
    }

    /// How often a rod is lifted to slide another under it.
    pub fn lifts(&self) -> usize {
        self.steps.iter().map(|s| s.lifts.len()).sum()
    }

    /// Numbers the props in the order in which they are set, without gaps.
    fn number_props(&mut self) {
        let set = self.steps.iter().flat_map(|s| s.props.iter().map(|p| p.id));
        let numbers: BTreeMap<PropId, PropId> =
            set.enumerate().map(|(i, id)| (id, PropId::new(i))).collect();
        for step in &mut self.steps {
            step.props.iter_mut().for_each(|p| p.id = numbers[&p.id]);
            step.remove_props.iter_mut().for_each(|id| *id = numbers[id]);
        }
        self.missed.iter_mut().for_each(|id| *id = numbers[id]);
    }

    /// The step in which each prop is taken away, counted from zero.
    pub fn removal(&self, prop: PropId) -> Option<usize> {
        self.steps.iter().position(|s| s.remove_props.contains(&prop))
    }
}

/// The order in which to put a frame together; `tied` are the contacts that gravity opens.
///
/// # Errors
/// [`LinalgError::TooLarge`] when memory does not suffice.
pub fn assembly(
    frame: &Frame,
    tied: &[ContactId],
    settings: OrderSettings,
) -> Result<Assembly, LinalgError> {
    let neighbors = Neighbors::new(frame);
    let made = |order| assembled(frame, &neighbors, tied, order, settings.step_rods);
    match settings.order {
        Some(order) => made(order),
        None if !neighbors.has_level_crown(frame) => made(Order::Ground),
        None => {
            let crown = made(Order::Crown)?;
            if crown.props() == 0 { Ok(crown) } else { made(Order::Ground) }
        }
    }
}

fn assembled(
    frame: &Frame,
    neighbors: &Neighbors,
    tied: &[ContactId],
    order: Order,
    step_rods: Option<usize>,
) -> Result<Assembly, LinalgError> {
    let mut site = Site::new(frame, order);
    let mut chooser = Chooser::new(frame, neighbors, order);
    let mut bracing = Bracing::new(frame, order);
    let mut steps: Vec<Step> = Vec::new();
    while let Some(unit) = chooser.next(&site) {
        let missing = site.missing(unit);
        for batch in batch::batches(&site, missing, step_rods) {
            let mut step = lay::lay(&mut site, batch);
            step.unit = Some(unit);
            step.ties = ties(&step, tied);
            bracing.brace(&site, &mut step)?;
            step.checks = checks::checks(&site, &step);
            steps.push(step);
        }
        chooser.placed(unit);
    }
    let missed = match steps.last_mut() {
        Some(last) => bracing.clear(last),
        None => Vec::new(),
    };
    let mut assembly = Assembly { order, steps, missed };
    assembly.number_props();
    Ok(assembly)
}

/// The contacts of a step that have to be tied, in order.
fn ties(step: &Step, tied: &[ContactId]) -> Vec<ContactId> {
    let made = step.over.iter().chain(&step.under).copied();
    let mut ties: Vec<ContactId> = made.filter(|c| tied.binary_search(c).is_ok()).collect();
    ties.sort_unstable();
    ties
}
