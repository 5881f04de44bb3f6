use super::*;
use crate::chart::{Method, PlanarChart};
use crate::frame::canvas::PlaneCanvas;
use crate::frame::close::Way;
use crate::frame::crop::{crop, held};
use crate::frame::form::{FormError, FormSettings, Formed, form};
use crate::frame::weave::weave;
use crate::frame::{End, Rod};
use crate::ids::Id;
use crate::pattern::Pattern;
use crate::surface::{samples::sample, topology::require_disk};
use crate::tiling::Placement;
use std::collections::BTreeSet;

fn igloo() -> PlanarChart {
    let mesh = sample("igloo").unwrap();
    let topology = require_disk(&mesh).unwrap();
    PlanarChart::new(mesh, &topology, Method::Abf).unwrap()
}

fn canvas<'a>(chart: &'a PlanarChart, pattern: &str) -> PlaneCanvas<'a, PlanarChart> {
    let pattern = Pattern::named(pattern).unwrap();
    let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 75.0 };
    PlaneCanvas::new(chart, pattern, placement, pattern.usual()).unwrap()
}

fn formed(pattern: &str, round: f64, sizes: SizeTable) -> Result<Formed, FormError> {
    let (diameter, overhang) = (3.0, 6.0);
    let layering = Default::default();
    let settings = FormSettings {
        diameter,
        sizes,
        overhang,
        round,
        share: crate::frame::share::Share::Off,
        layering,
        way: Way::default(),
        surface_low: 0.0,
    };
    form(&canvas(&igloo(), pattern), &settings)
}

fn poles() -> SizeTable {
    SizeTable {
        rods: BTreeMap::from([(RodId::new(1), [2.5, 3.5]), (RodId::new(40), [4.0; 2])]),
        border: Some([6.0, 4.0]),
        all: Some([3.0, 2.8]),
    }
}

/// The diameter of a rod by similar triangles, written apart from the code under test.
fn thick(rod: &Rod, s: f64) -> f64 {
    let [a, b] = rod.diameters;
    let length = (rod.axis.b - rod.axis.a).norm();
    (a * (length - s) + b * s) / length
}

#[test]
fn a_named_rod_comes_before_the_border_and_that_before_all() {
    let chart = igloo();
    let canvas = canvas(&chart, "4.4.4.4");
    let weave = weave(&canvas, &crop(&canvas, &held(&canvas))).unwrap();
    let named = RodId::new(0);
    let table = SizeTable { rods: BTreeMap::from([(named, [2.0, 1.0])]), ..poles() };
    let sizes = Sizes::new(&weave, &table, 3.0).unwrap();
    for (rod, woven) in weave.rods.enumerate() {
        let border = woven.ends.contains(&RodEnd::Free);
        let expected = match (rod == named, border) {
            (true, _) => [2.0, 1.0],
            (false, true) => [6.0, 4.0],
            (false, false) => [3.0, 2.8],
        };
        assert_eq!(sizes.ends[rod], expected, "{rod}");
    }
    assert!(sizes.are_tapered());
    let plain = Sizes::new(&weave, &SizeTable::default(), 3.0).unwrap();
    assert!(!plain.are_tapered() && plain.ends.iter().all(|&ends| ends == [3.0; 2]));
}

#[test]
fn a_rod_that_is_not_there_is_named_with_how_many_there_are() {
    let rods = BTreeMap::from([(RodId::new(998), [4.0; 2])]);
    let error = formed("4.4.4.4", 0.5, SizeTable { rods, ..SizeTable::default() }).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("rod R999, but the frame has "), "{message}");
}

/// Gaps, rods that do not touch, and lengths, with and without rounding.
#[test]
fn tapered_rods_touch_where_they_are_as_thick_as_that() {
    for (pattern, round) in [("4.4.4.4", 0.5), ("4.4.4.4", 0.0), ("3.6.3.6", 5.0)] {
        let Formed { frame, .. } = formed(pattern, round, poles()).unwrap();
        assert!(frame.rods.iter().any(|r| r.border && r.is_tapered()), "{pattern}");
        let mut touching = BTreeSet::new();
        for c in &frame.contacts {
            let [over, under] = [c.over, c.under].map(|r| &frame.rods[r]);
            let sum = (thick(over, c.at_over) + thick(under, c.at_under)) / 2.0;
            assert!((c.gap - sum).abs() < 1e-10, "{pattern}: {} {sum}", c.gap);
            assert!((frame.wanted_gap(c) - sum).abs() < 1e-12);
            touching.insert([c.over.min(c.under), c.over.max(c.under)]);
        }
        for (p, first) in frame.rods.enumerate() {
            let steps = first.axis.length() / round;
            assert!(round == 0.0 || (steps - steps.round()).abs() < 1e-9, "{p}: {steps}");
            for (q, second) in frame.rods.enumerate().skip(p.index() + 1) {
                let ([s, t], distance) = first.axis.nearest(&second.axis);
                let [s, t] = [s * first.axis.length(), t * second.axis.length()];
                let sum = (thick(first, s) + thick(second, t)) / 2.0;
                let clear = touching.contains(&[p, q]) || distance >= sum * (1.0 - 1e-9);
                assert!(clear, "{pattern}: {p} {q} {distance} {sum}");
            }
        }
    }
}

/// A rod that is let down to the ground is thickest there, not where it was cut first.
#[test]
fn the_taper_runs_over_the_finished_rod() {
    let Formed { frame, .. } = formed("4.4.4.4", 0.5, poles()).unwrap();
    assert!(!frame.supports.is_empty());
    for support in &frame.supports {
        let rod = &frame.rods[support.rod];
        assert_eq!((support.end, rod.diameter_of(End::A)), (End::A, rod.diameters[0]));
        assert_eq!(rod.diameter_at(0.0), rod.diameters[0]);
        assert!((rod.diameter_at(rod.axis.length()) - rod.diameters[1]).abs() < 1e-12);
    }
}

#[test]
fn ends_that_meet_meet_however_thick_they_are() {
    let Formed { frame, .. } = formed("squares-end-to-end", 0.5, poles()).unwrap();
    let ends = || frame.contacts.iter().filter(|c| c.kind != ContactKind::Cross);
    assert!(ends().count() > 10);
    for c in ends() {
        assert!(c.gap < 1e-10 && frame.wanted_gap(c) == 0.0, "{}", c.gap);
    }
}

#[test]
fn a_table_of_the_nominal_diameter_changes_nothing() {
    let plain = formed("4.4.4.4", 0.5, SizeTable::default()).unwrap();
    let table = SizeTable { all: Some([3.0; 2]), border: Some([3.0; 2]), ..SizeTable::default() };
    let tabled = formed("4.4.4.4", 0.5, table).unwrap();
    for (rod, other) in plain.frame.rods.iter().zip(&tabled.frame.rods) {
        assert_eq!((rod.axis, rod.diameters), (other.axis, other.diameters));
    }
    assert_eq!(plain.closing, tabled.closing);
}

#[test]
fn straight_rods_of_two_diameters_close_in_one_round() {
    let table = SizeTable { border: Some([5.0; 2]), ..SizeTable::default() };
    let Formed { frame, closing, .. } = formed("4.4.4.4", 0.5, table).unwrap();
    assert!(closing.steps > 0, "one round, which moved the rods: {closing:?}");
    let mut gaps: Vec<f64> = frame.contacts.iter().map(|c| c.gap).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.dedup_by(|a, b| (*a - *b).abs() < 1e-10);
    assert!(gaps.iter().zip([3.0, 4.0, 5.0]).all(|(a, b)| (a - b).abs() < 1e-10), "{gaps:?}");
}
