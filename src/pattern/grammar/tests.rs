use super::*;
use crate::pattern::library;
use crate::pattern::testing::{any_grammar, grammar};
use proptest::prelude::*;
use walk::{FULL, interior};

fn allowed(sides: &[usize], rules: &[&str]) -> Allowed {
    let (kinds, rules) = grammar(sides, rules);
    check(&kinds, &rules).unwrap()
}

fn refused(sides: &[usize], rules: &[&str]) -> String {
    let (kinds, rules) = grammar(sides, rules);
    check(&kinds, &rules).unwrap_err().to_string()
}

fn names(allowed: &Allowed) -> Vec<&str> {
    allowed.tilings.iter().map(|t| t.name).collect()
}

#[test]
fn one_rule_makes_the_regular_tilings_and_one_more() {
    for (sides, rule, wanted) in [
        (&[3][..], "3-3", "3.3.3.3.3.3"),
        (&[4], "4-4", "4.4.4.4"),
        (&[6], "6-6", "6.6.6"),
        (&[3, 6], "3-6", "3.6.3.6"),
    ] {
        let allowed = allowed(sides, &[rule]);
        assert_eq!(allowed.configurations(), [wanted]);
        assert_eq!(names(&allowed), [wanted]);
        assert_eq!(allowed.cycles[0].tiling.unwrap().name, wanted);
        assert_eq!(allowed.choose(None).unwrap().name, wanted);
        assert!(allowed.idle.is_empty());
    }
}

#[test]
fn two_rules_make_one_tiling_or_several() {
    let lace = allowed(&[3, 4, 6], &["3-4", "4-6"]);
    assert_eq!(names(&lace), ["3.4.6.4"]);
    assert_eq!(lace.configurations(), ["3.4.6.4"]);
    assert_eq!(lace.cycles[0].kinds, [0, 1, 2, 1]);

    let mixed = allowed(&[3, 4], &["3-3", "3-4"]);
    assert_eq!(mixed.configurations(), ["3.3.3.3.3.3", "3.3.4.3.4"]);
    assert_eq!(names(&mixed), ["3.3.3.3.3.3", "3.3.4.3.4", "3.3.3.3.3.3+3.3.4.3.4"]);
    let message = mixed.choose(None).unwrap_err().to_string();
    assert!(message.contains("3.3.4.3.4, 3.3.3.3.3.3+3.3.4.3.4. Say which"), "{message}");
    assert_eq!(mixed.choose(Some("3.3.4.3.4")).unwrap().name, "3.3.4.3.4");
}

#[test]
fn what_is_not_made_is_refused_with_the_reason() {
    let mixed = allowed(&[3, 4], &["3-3", "3-4"]);
    for (name, word) in [
        ("4.4.4.4", "no rule joins two units of 4 sides"),
        ("3.6.3.6", "no rule is about a unit of 6 sides"),
        ("3.3.3.4.4+3.3.4.3.4-1", "no rule joins two units of 4 sides"),
        ("3.3.3.3", "there is no tiling 3.3.3.3"),
    ] {
        let message = mixed.choose(Some(name)).unwrap_err().to_string();
        assert!(message.contains(word) && message.contains("3.3.4.3.4"), "{message}");
    }
    let lace = allowed(&[3, 4, 6], &["3-4", "4-6"]);
    let message = lace.choose(Some("3.6.3.6")).unwrap_err().to_string();
    assert!(message.contains("no rule joins a unit of 3 sides to one of 6"), "{message}");
}

/// Round a vertex of 3.4.3.12 all is well, but no tiling has only such vertices.
#[test]
fn cycles_without_a_tiling_are_told() {
    let rings = allowed(&[3, 4, 12], &["3-4", "3-12"]);
    assert_eq!(rings.configurations(), ["3.4.3.12"]);
    assert!(rings.tilings.is_empty() && rings.cycles[0].tiling.is_none());
    let message = rings.choose(None).unwrap_err().to_string();
    assert!(message.contains("3.4.3.12") && message.contains("no tiling"), "{message}");
}

#[test]
fn rules_that_take_no_part_are_known() {
    assert_eq!(allowed(&[3, 5], &["3-3", "3-5"]).idle, [1]);
}

#[test]
fn walks_that_fail_are_shown() {
    insta::assert_snapshot!(refused(&[5], &["5-5"]));
    insta::assert_snapshot!(refused(&[4, 6], &["4-6"]));
    insta::assert_snapshot!(refused(&[5, 10], &["5-5", "5-10"]));
    insta::assert_snapshot!(refused(&[3, 4], &["3.1-4.1", "4.3-4.1", "3.2-3.2"]));
    insta::assert_snapshot!(refused(&[3, 4, 5, 7, 9, 11], &["3-4", "4-5", "5-7", "7-9", "9-11"]));
}

/// Triangles with their first side at a square, squares with every other side at one: rows.
const ROWS: [&str; 5] = ["4.1-3.1", "4.3-3.1", "4.2-4.4", "3.2-3.2", "3.3-3.3"];

#[test]
fn named_sides_make_rows() {
    let rows = allowed(&[3, 4], &ROWS);
    assert_eq!(rows.configurations(), ["3.3.3.4.4"]);
    assert_eq!(names(&rows), ["3.3.3.4.4"]);
    // Where any two of their other sides may meet, six triangles fit round a vertex; but a
    // tiling must have a place for each first side.
    let loose = ["4.1-3.1", "4.3-3.1", "4.2-4.4", "3.2-3.2", "3.3-3.3", "3.2-3.3"];
    let loose = allowed(&[3, 4], &loose);
    assert_eq!(loose.configurations(), ["3.3.3.3.3.3", "3.3.3.4.4"]);
    assert_eq!(names(&loose), ["3.3.3.4.4"]);
    let unlaid: Vec<_> = loose.unlaid.iter().map(|(t, _)| t.name).collect();
    let wanted = ["3.3.3.3.3.3", "3.3.3.3.3.3+3.3.3.4.4-1", "3.3.3.3.3.3+3.3.3.4.4-2"];
    assert_eq!(unlaid, wanted);
    let message = loose.choose(Some("3.3.3.3.3.3")).unwrap_err().to_string();
    assert!(message.contains("dead end") && message.ends_with("make 3.3.3.4.4"), "{message}");
    // Without names the same meetings make many more.
    assert!(allowed(&[3, 4], &["3-3", "3-4", "4-4"]).tilings.len() > 5);
}

#[test]
fn sides_count_where_a_walk_closes() {
    let message = refused(&[4], &["4.1-4.3"]);
    assert!(
        message.contains("square 2-3, square 1-2: no rule goes on from side 2 of square"),
        "{message}"
    );
    assert_eq!(names(&allowed(&[4], &["4.1-4.3", "4.2-4.4"])), ["4.4.4.4"]);
}

#[test]
fn the_library_makes_its_own_tilings() {
    for pattern in library() {
        let allowed = check(&pattern.kinds, &pattern.rules).unwrap();
        assert_eq!(allowed.obstacle(pattern.tiling), None);
        assert!(allowed.idle.is_empty(), "{}: {:?}", pattern.name, allowed.idle);
    }
}

#[test]
fn the_table_writes_configurations_as_they_are_found() {
    for configuration in UNIFORM.iter().flat_map(|t| t.configurations()) {
        assert_eq!(ways(&configuration, true).min(), Some(configuration));
    }
}

#[test]
fn rules_without_end_are_refused() {
    let (kinds, rules) = grammar(&[3; 12], &["3.1-3", "3-3"]);
    let all = (0..12).flat_map(|a| (0..12).map(move |b| (a, b))).map(|(a, b)| {
        let mut rule = rules[1];
        (rule.slots[0].kind, rule.slots[1].kind) = (a, b);
        rule
    });
    let all: Vec<Rule> = all.chain([rules[0]]).collect();
    assert_eq!(check(&kinds, &all).err(), Some(GrammarError::TooManyWalks));
    assert_eq!(check(&kinds, &[]).err(), Some(GrammarError::NoRules));
    assert_eq!(check(&[], &[]).err(), Some(GrammarError::NoRules));
}

/// All ways to put kinds round a vertex, by trying every sequence.
fn all_rounds(kinds: &[UnitKind], rules: &[Rule]) -> BTreeSet<(Vec<usize>, Vec<usize>)> {
    let joined = |a: usize, b: usize| {
        rules.iter().any(|r| {
            let [c, d] = r.slots.map(|s| s.kind);
            (a, b) == (c, d) || (a, b) == (d, c)
        })
    };
    let known: BTreeSet<Vec<usize>> = UNIFORM.iter().flat_map(|t| t.configurations()).collect();
    let mut found = BTreeSet::new();
    for length in 3..=6 {
        for code in 0..kinds.len().pow(length as u32) {
            let round: Vec<usize> =
                (0..length).map(|i| code / kinds.len().pow(i as u32) % kinds.len()).collect();
            let angle: u32 = round.iter().map(|&k| interior(kinds[k].sides)).sum();
            let closes = (0..length).all(|i| joined(round[i], round[(i + 1) % length]));
            let least = ways(&round, true)
                .map(|r| (r.iter().map(|&k| kinds[k].sides).collect::<Vec<_>>(), r))
                .min()
                .unwrap();
            if angle == FULL && closes && known.contains(&least.0) {
                found.insert(least);
            }
        }
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn cycles_are_those_that_trying_all_finds((kinds, rules) in any_grammar(false)) {
        let wanted = all_rounds(&kinds, &rules);
        match check(&kinds, &rules) {
            Ok(allowed) => {
                let found: Vec<_> =
                    allowed.cycles.iter().map(|c| (c.configuration.clone(), c.kinds.clone())).collect();
                let wanted: Vec<_> = wanted.into_iter().map(|(c, k)| (written(&c), k)).collect();
                prop_assert_eq!(found, wanted);
            }
            Err(GrammarError::NoCycle(walks)) => {
                prop_assert!(wanted.is_empty());
                prop_assert!(!walks.shown.is_empty());
            }
            Err(e) => prop_assert!(false, "{e}"),
        }
    }

    #[test]
    fn named_sides_only_take_cycles_away((kinds, rules) in any_grammar(true)) {
        let wanted = all_rounds(&kinds, &rules);
        match check(&kinds, &rules) {
            Ok(allowed) => for cycle in &allowed.cycles {
                let angle: u32 = cycle.kinds.iter().map(|&k| interior(kinds[k].sides)).sum();
                prop_assert_eq!(angle, FULL);
                let sizes = cycle.kinds.iter().map(|&k| kinds[k].sides).collect();
                prop_assert!(wanted.contains(&(sizes, cycle.kinds.clone())));
            },
            Err(e) => prop_assert!(e.to_string().len() > 30),
        }
    }
}
