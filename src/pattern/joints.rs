//! The rules as a table: which side of which unit may lie at which other.
//!
//! The slots of all units are counted through, those of the first unit first. A unit has
//! a slot for each side where some rule names one of its sides; else all its sides are
//! alike, and it has one slot that stands for all of them.

use super::{Join, Rule, SIDES, Slot, UnitKind};
use thiserror::Error;

/// Units of more kinds than anybody tells apart, and whose table still fits in memory.
pub const MOST_KINDS: usize = 50;

/// Units and rules that do not fit together.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum RulesError {
    /// More kinds of units than [`MOST_KINDS`].
    #[error("{count} units; a pattern has at most {MOST_KINDS}")]
    TooManyUnits { count: usize },
    /// A unit that no tile can host.
    #[error("unit \"{unit}\": {sides} sides; units have 3 to 12")]
    Sides { unit: String, sides: usize },
    /// A rule about a slot that is not there; rules are counted from one.
    #[error("rule {rule} is about a unit or a side that is not there")]
    NoSuchSlot { rule: usize },
}

/// Which slots come together, and how.
pub(super) struct Joints {
    /// The first slot of each kind.
    first: Vec<usize>,
    /// How many slots each kind has.
    told_apart: Vec<usize>,
    /// Kind and, where it has more than one slot, side of each slot.
    owners: Vec<Slot>,
    /// The join of each pair of slots, by the first rule that allows it.
    joins: Vec<Option<Join>>,
    /// The slots that may lie at each slot, ascending.
    partners: Vec<Vec<usize>>,
}

impl Joints {
    /// Makes the table.
    ///
    /// # Errors
    /// Rules about units or sides that are not there; too many units.
    pub fn new(kinds: &[UnitKind], rules: &[Rule]) -> Result<Self, RulesError> {
        check(kinds, rules)?;
        let slots = rules.iter().flat_map(|r| r.slots);
        let mut named = vec![false; kinds.len()];
        slots.filter(|s| s.side.is_some()).for_each(|s| named[s.kind] = true);
        let mut table = Self {
            first: Vec::new(),
            told_apart: Vec::new(),
            owners: Vec::new(),
            joins: Vec::new(),
            partners: Vec::new(),
        };
        for (kind, unit) in kinds.iter().enumerate() {
            let count = if named[kind] { unit.sides } else { 1 };
            table.first.push(table.owners.len());
            table.told_apart.push(count);
            let side = |i| named[kind].then_some(i);
            table.owners.extend((0..count).map(|i| Slot { kind, side: side(i) }));
        }
        let slots = table.owners.len();
        table.joins = vec![None; slots * slots];
        for rule in rules {
            for (a, b) in table.pairs(rule) {
                for at in [a * slots + b, b * slots + a] {
                    table.joins[at].get_or_insert(rule.join);
                }
            }
        }
        let joined = |a: usize| (0..slots).filter(|b| table.join(a, *b).is_some()).collect();
        table.partners = (0..slots).map(joined).collect();
        Ok(table)
    }

    /// How many slots there are.
    pub fn count(&self) -> usize {
        self.owners.len()
    }

    /// The slot of a side, counted on past the last one.
    pub fn slot(&self, kind: usize, side: usize) -> usize {
        self.first[kind] + side % self.told_apart[kind]
    }

    /// Kind and side of a slot; no side where the unit's sides are alike.
    pub fn owner(&self, slot: usize) -> Slot {
        self.owners[slot]
    }

    /// Whether rules tell the sides of a unit apart.
    pub fn is_named(&self, kind: usize) -> bool {
        self.told_apart[kind] > 1
    }

    /// The slot some sides on, counter-clockwise, of the same unit.
    pub fn turned(&self, slot: usize, sides: usize) -> usize {
        let Slot { kind, side } = self.owners[slot];
        self.slot(kind, side.unwrap_or(0) + sides)
    }

    /// How two slots join, if they may.
    pub fn join(&self, a: usize, b: usize) -> Option<Join> {
        self.joins[a * self.count() + b]
    }

    /// The slots that may lie at this one.
    pub fn partners(&self, slot: usize) -> &[usize] {
        &self.partners[slot]
    }

    /// The pairs of slots that a rule allows.
    pub fn pairs(&self, rule: &Rule) -> impl Iterator<Item = (usize, usize)> + use<> {
        let [a, b] = rule.slots.map(|slot| {
            let all = self.first[slot.kind]..self.first[slot.kind] + self.told_apart[slot.kind];
            match slot.side {
                Some(side) => all.start + side..all.start + side + 1,
                None => all,
            }
        });
        a.flat_map(move |a| b.clone().map(move |b| (a, b)))
    }
}

fn check(kinds: &[UnitKind], rules: &[Rule]) -> Result<(), RulesError> {
    if kinds.len() > MOST_KINDS {
        return Err(RulesError::TooManyUnits { count: kinds.len() });
    }
    if let Some(kind) = kinds.iter().find(|k| !SIDES.contains(&k.sides)) {
        return Err(RulesError::Sides { unit: kind.name.clone(), sides: kind.sides });
    }
    let is_there = |slot: &Slot| {
        kinds.get(slot.kind).is_some_and(|k| slot.side.is_none_or(|side| side < k.sides))
    };
    match rules.iter().position(|r| !r.slots.iter().all(is_there)) {
        Some(i) => Err(RulesError::NoSuchSlot { rule: i + 1 }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{kind, rule};
    use super::*;

    #[test]
    fn sides_are_told_apart_only_where_a_rule_names_one() {
        let kinds = [kind("triangle", 3), kind("square", 4)];
        let rules = [rule(&kinds, "triangle", "square.2"), rule(&kinds, "square", "square.4")];
        let joints = Joints::new(&kinds, &rules).unwrap();
        assert_eq!(joints.count(), 5);
        assert!(!joints.is_named(0) && joints.is_named(1));
        assert_eq!((joints.slot(0, 2), joints.slot(1, 3), joints.slot(1, 5)), (0, 4, 2));
        assert_eq!(joints.turned(4, 2), 2);
        assert_eq!(joints.turned(0, 2), 0);
        // The triangle lies at side 2; any side at side 4, which is the one of slot 4.
        assert_eq!(joints.partners(0), [2]);
        assert_eq!(joints.partners(2), [0, 4]);
        assert_eq!(joints.partners(4), [1, 2, 3, 4]);
        assert_eq!(joints.join(1, 3), None);
    }

    #[test]
    fn the_first_rule_about_two_slots_counts() {
        let kinds = [kind("square", 4)];
        let mut rules = vec![rule(&kinds, "square.1", "square.1"); 2];
        rules[1].slots[0].side = None;
        rules[1].join = Join::End;
        let joints = Joints::new(&kinds, &rules).unwrap();
        assert_eq!(joints.join(0, 0), Some(Join::Shared));
        assert_eq!(joints.join(3, 0), Some(Join::End));
        assert_eq!(joints.join(0, 3), Some(Join::End));
    }

    #[test]
    fn rules_about_nothing_are_refused() {
        let kinds = [kind("square", 4)];
        let sound = rule(&kinds, "square", "square");
        let refused = |kinds: &[UnitKind], rule: Rule| Joints::new(kinds, &[rule]).err();
        let mut wrong = sound;
        wrong.slots[1].side = Some(4);
        assert_eq!(refused(&kinds, wrong), Some(RulesError::NoSuchSlot { rule: 1 }));
        wrong.slots[1] = Slot { kind: 1, side: None };
        assert_eq!(refused(&kinds, wrong), Some(RulesError::NoSuchSlot { rule: 1 }));
        let sides = RulesError::Sides { unit: "coin".into(), sides: 2 };
        assert_eq!(refused(&[kind("coin", 2)], sound), Some(sides));
        let many = vec![kind("square", 4); MOST_KINDS + 1];
        assert_eq!(refused(&many, sound), Some(RulesError::TooManyUnits { count: 51 }));
    }
}
