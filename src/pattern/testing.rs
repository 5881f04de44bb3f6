//! Units and rules for tests.

use super::{Join, Rule, Slot, UnitKind};
use proptest::prelude::*;

/// A plain unit.
pub fn kind(name: &str, sides: usize) -> UnitKind {
    UnitKind {
        name: name.into(),
        sides,
        mirrored: false,
        radius: None,
        outer: Vec::new(),
        inner: Vec::new(),
    }
}

/// A rule between slots as files name them, such as `square.1`; rods are shared.
pub fn rule(kinds: &[UnitKind], a: &str, b: &str) -> Rule {
    let slot = |text: &str| {
        let (name, side) = text.split_once('.').map_or((text, None), |(n, s)| (n, Some(s)));
        Slot {
            kind: kinds.iter().position(|k| k.name == name).unwrap(),
            side: side.map(|s| s.parse::<usize>().unwrap() - 1),
        }
    };
    Rule { slots: [slot(a), slot(b)], join: Join::Shared }
}

/// Polygons by their numbers of sides, and rules such as `3-4`, `4.1-3.2` between them.
pub fn grammar(sides: &[usize], rules: &[&str]) -> (Vec<UnitKind>, Vec<Rule>) {
    let kinds: Vec<_> = sides.iter().map(|&n| kind(NAMES[n - 3], n)).collect();
    let slot = |text: &str| {
        let (sides, side) = text.split_once('.').map_or((text, None), |(n, s)| (n, Some(s)));
        let name = NAMES[sides.parse::<usize>().unwrap() - 3];
        side.map_or(name.into(), |side| format!("{name}.{side}"))
    };
    let rules = rules.iter().map(|text| {
        let (a, b) = text.split_once('-').unwrap();
        rule(&kinds, &slot(a), &slot(b))
    });
    let rules = rules.collect();
    (kinds, rules)
}

/// Up to four units, and up to six rules between them, sometimes about one side if `named`.
pub fn any_grammar(named: bool) -> impl Strategy<Value = (Vec<UnitKind>, Vec<Rule>)> {
    let sides = prop::sample::select(vec![3usize, 4, 5, 6, 8, 12]);
    let side = if named { (0..24usize).boxed() } else { Just(23).boxed() };
    let slot = (0..4usize, side);
    let slots = (slot.clone(), slot);
    let rules = prop::collection::vec(slots, 1..7);
    (prop::collection::vec(sides, 1..5), rules).prop_map(|(sides, rules)| {
        let kinds: Vec<_> = ('a'..).zip(sides).map(|(c, n)| kind(&format!("{n}{c}"), n)).collect();
        let slot = |(kind, side): (usize, usize)| {
            let kind = kind % kinds.len();
            Slot { kind, side: Some(side).filter(|&s| s < kinds[kind].sides) }
        };
        let rule = |(a, b)| Rule { slots: [slot(a), slot(b)], join: Join::Shared };
        let rules = rules.into_iter().map(rule).collect();
        (kinds, rules)
    })
}

const NAMES: [&str; 10] = [
    "triangle",
    "square",
    "pentagon",
    "hexagon",
    "heptagon",
    "octagon",
    "nonagon",
    "decagon",
    "hendecagon",
    "dodecagon",
];
