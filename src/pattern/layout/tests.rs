use super::*;
use crate::ids::Id;
use crate::pattern::grammar::check;
use crate::pattern::testing::{any_grammar, grammar, kind, rule};
use crate::pattern::{Rule, UnitKind, library};
use crate::tiling::{UNIFORM, UniformTiling};
use nalgebra::Point2;
use proptest::prelude::*;
use std::collections::BTreeMap;

fn pattern(kinds: Vec<UnitKind>, rules: Vec<Rule>, tiling: &str) -> Pattern {
    let tiling = UniformTiling::named(tiling).unwrap();
    Pattern { kinds, rules, tiling, ..library()[0].clone() }
}

fn patch(tiling: &UniformTiling, half: f64) -> Tiling {
    tiling.patch(Point2::new(-half, -half), Point2::new(half, half))
}

/// Whether a rule allows what meets at every edge, and how it says that it joins.
fn is_sound(layout: &Layout, pattern: &Pattern, patch: &Tiling) -> bool {
    patch.net.edges.enumerate().all(|(e, edge)| {
        let Some(right) = edge.right else { return layout.joins[e] == Join::Shared };
        let slots = [edge.left, right].map(|t| {
            let at = patch.net.tiles[t].edges.iter().position(|&o| o == e).unwrap();
            let Place { kind, first, .. } = layout.tiles[t];
            (kind, (first + at) % pattern.kinds[kind].sides)
        });
        let matches = |s: &crate::pattern::Slot, (kind, side): (usize, usize)| {
            s.kind == kind && s.side.is_none_or(|s| s == side)
        };
        let rule = pattern.rules.iter().find(|r| {
            let [a, b] = &r.slots;
            (matches(a, slots[0]) && matches(b, slots[1]))
                || (matches(a, slots[1]) && matches(b, slots[0]))
        });
        rule.is_some_and(|r| r.join == layout.joins[e])
    })
}

#[test]
fn the_library_is_laid_on_its_tilings() {
    for pattern in library() {
        let patch = patch(pattern.tiling, 9.0);
        let layout = Layout::new(pattern, &patch).unwrap();
        for (t, place) in layout.tiles.enumerate() {
            assert_eq!(pattern.kinds[place.kind].sides, patch.net.tiles[t].edges.len());
            assert_eq!(place.first, 0);
        }
        assert!(is_sound(&layout, pattern, &patch), "{}", pattern.name);
    }
}

#[test]
fn left_and_right_squares_make_a_checkerboard() {
    let kinds = vec![kind("left", 4), kind("right", 4)];
    let mut rules = vec![rule(&kinds, "left", "right")];
    rules[0].join = Join::Rest { reach: 2 };
    let pattern = pattern(kinds, rules, "4.4.4.4");
    let patch = patch(pattern.tiling, 7.0);
    let layout = Layout::new(&pattern, &patch).unwrap();
    assert!(is_sound(&layout, &pattern, &patch));
    for (t, place) in layout.tiles.enumerate() {
        let parity = (patch.centers[t] - Point2::new(0.5, 0.5)).iter().sum::<f64>().round() as i64;
        assert_eq!(
            (place.kind, place.even),
            ((parity % 2).unsigned_abs() as usize, parity % 2 == 0)
        );
    }
}

#[test]
fn tiles_side_by_side_differ_in_colour_where_two_are_enough() {
    for pattern in library() {
        let patch = patch(pattern.tiling, 9.0);
        let layout = Layout::new(pattern, &patch).unwrap();
        let differ = patch.net.edges.iter().all(|edge| {
            edge.right.is_none_or(|r| layout.tiles[edge.left].even != layout.tiles[r].even)
        });
        assert_eq!(differ, pattern.alternates(), "{}", pattern.name);
        assert!(pattern.alternates() || layout.tiles.iter().all(|p| p.even));
        let distance = |t| (patch.centers[t].coords.norm() * 1e6).round() as i64;
        let nearest = patch.net.tiles.ids().map(distance).min();
        let mut near = patch.net.tiles.ids().filter(|&t| Some(distance(t)) == nearest);
        assert!(near.any(|t| layout.tiles[t].even), "{}", pattern.name);
    }
    let alternating = library()
        .iter()
        .filter(|p| p.alternates() && p.name == p.tiling.name)
        .map(|p| p.name.as_str());
    let wanted = [
        "4.4.4.4",
        "3.3.3.3.3.3",
        "3.6.3.6",
        "3.4.6.4",
        "3.3.3.3.3.3+3.3.4.12",
        "3.3.3.3.3.3+3.3.6.6",
        "3.3.6.6+3.6.3.6",
        "3.4.4.6+3.4.6.4",
        "3.4.4.6+3.6.3.6-1",
        "3.4.4.6+3.6.3.6-2",
    ];
    assert_eq!(alternating.collect::<Vec<_>>(), wanted);
}

/// Squares in rows, triangles with their first side at a square.
fn rows() -> Pattern {
    let rules = ["4.1-3.1", "4.3-3.1", "4.2-4.4", "3.2-3.2", "3.3-3.3"];
    let (kinds, rules) = grammar(&[3, 4], &rules);
    pattern(kinds, rules, "3.3.3.4.4")
}

#[test]
fn named_sides_turn_units() {
    let pattern = rows();
    let patch = patch(pattern.tiling, 8.0);
    let layout = Layout::new(&pattern, &patch).unwrap();
    assert!(is_sound(&layout, &pattern, &patch));
    let mut turned = [0; 3];
    for (t, place) in layout.tiles.enumerate().filter(|(_, p)| p.kind == 0) {
        // The edge of side 1 lies along the rows of squares, which run along the x axis.
        let edge = patch.net.tiles[t].edges[(3 - place.first) % 3];
        let [a, b] = patch.net.edges[edge].ends.map(|v| patch.vertices[v]);
        assert!((a - b).y.abs() < 1e-9);
        turned[place.first] += 1;
    }
    assert!(turned.iter().filter(|&&n| n > 10).count() > 1, "{turned:?}");
}

#[test]
fn a_tile_has_the_same_place_in_every_patch() {
    let hexagons = vec![kind("a", 6), kind("b", 6), kind("c", 6)];
    let rules = [("a", "b"), ("b", "c"), ("c", "a")].map(|(x, y)| rule(&hexagons, x, y)).to_vec();
    let three_colours = pattern(hexagons, rules, "6.6.6");
    for pattern in library().iter().chain([&rows(), &three_colours]) {
        let places = |low: Point2<f64>, high: Point2<f64>| -> BTreeMap<[i64; 2], Place> {
            let patch = pattern.tiling.patch(low, high);
            let layout = Layout::new(pattern, &patch).unwrap();
            assert!(is_sound(&layout, pattern, &patch));
            let key = |t| patch.centers[t].coords.map(|x: f64| (x * 1e6).round() as i64).into();
            layout.tiles.enumerate().map(|(t, &place)| (key(t), place)).collect()
        };
        let large = places(Point2::new(-10.0, -9.0), Point2::new(25.0, 9.0));
        for (low, high) in [
            (Point2::new(-6.0, -5.0), Point2::new(5.0, 6.0)),
            (Point2::new(12.0, -3.0), Point2::new(24.0, 8.0)),
        ] {
            let small = places(low, high);
            assert!(small.len() > 8, "{}", pattern.name);
            assert!(small.iter().all(|(at, place)| large.get(at) == Some(place)));
        }
    }
}

/// Four squares fit round a vertex, each with its first side at the second of the next; the
/// other sides fit nowhere.
#[test]
fn units_that_fit_round_a_vertex_may_not_fit_further_out() {
    let (kinds, rules) = grammar(&[4], &["4.1-4.2"]);
    let squares = pattern(kinds, rules, "4.4.4.4");
    let message = Layout::new(&squares, &patch(squares.tiling, 5.0)).unwrap_err().to_string();
    assert!(message.contains("4.4.4.4") && message.contains("the middle"), "{message}");
}

#[test]
fn a_patch_of_another_tiling_is_refused() {
    let patch = patch(UniformTiling::named("6.6.6").unwrap(), 4.0);
    let error = Layout::new(&library()[0], &patch).unwrap_err();
    assert_eq!(error, LayoutError::Foreign { tile: TileId::new(0), tiling: "4.4.4.4" });
}

#[test]
fn all_units_of_the_table_can_be_told_apart_by_their_sides() {
    // With every side named and every pair of sides allowed, anything goes.
    for tiling in UNIFORM {
        let sides: Vec<usize> = tiling.polygons().into_iter().collect();
        let texts: Vec<String> = sides
            .iter()
            .flat_map(|a| sides.iter().map(move |b| format!("{a}.1-{b}")))
            .chain(sides.iter().flat_map(|a| sides.iter().map(move |b| format!("{a}-{b}"))))
            .collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let (kinds, rules) = grammar(&sides, &texts);
        let pattern = pattern(kinds, rules, tiling.name);
        let patch = patch(tiling, 6.0);
        let layout = Layout::new(&pattern, &patch).unwrap();
        assert!(layout.tiles.iter().all(|p| p.first == 0), "{}", tiling.name);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..Default::default() })]

    /// Every tiling that the check finds can be laid, and every edge of it is by a rule.
    #[test]
    fn what_the_check_finds_is_laid_by_the_rules((kinds, rules) in any_grammar(true)) {
        let Ok(allowed) = check(&kinds, &rules) else { return Ok(()) };
        for tiling in allowed.tilings {
            let pattern = pattern(kinds.clone(), rules.clone(), tiling.name);
            let patch = patch(tiling, 5.0);
            let layout = Layout::new(&pattern, &patch).unwrap();
            prop_assert!(is_sound(&layout, &pattern, &patch));
        }
    }
}
