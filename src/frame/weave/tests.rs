use super::*;
use crate::frame::canvas::PlaneCanvas;
use crate::frame::canvas::fixture::Sheet;
use crate::pattern::{Join, Pattern, Shape, library};
use crate::surface::Point3;
use crate::tiling::Placement;
use proptest::prelude::*;
use std::collections::BTreeSet;

fn woven(pattern: &Pattern, shape: Shape) -> Weave {
    let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 1.0 };
    let canvas = PlaneCanvas::new(&Sheet, pattern, placement, shape).expect("few tiles");
    let tiles: Vec<TileId> = canvas.net().tiles.ids().collect();
    weave(&canvas, &tiles).unwrap_or_else(|e| panic!("{}: {:?}", pattern.name, e[0]))
}

/// Patterns of nothing but shared rods.
fn shared() -> Vec<&'static Pattern> {
    let plain = |p: &&Pattern| {
        p.rules.iter().all(|r| r.join == Join::Shared) && p.kinds.iter().all(|k| k.inner.is_empty())
    };
    library().iter().filter(plain).collect()
}

/// A pattern and a shape within its safe range.
fn legal(patterns: Vec<&'static Pattern>) -> impl Strategy<Value = (&'static Pattern, Shape)> {
    let within = |[least, most]: [f64; 2], part: f64| least + (most - least) * part;
    let pick = (0..patterns.len(), 0.0..=1.0f64, 0.0..=1.0f64, any::<bool>());
    pick.prop_map(move |(i, turn, slide, mirrored)| {
        let pattern = patterns[i];
        let sign = if mirrored { -1.0 } else { 1.0 };
        let turn = sign * within(pattern.turn.safe, turn).to_radians();
        (pattern, Shape { turn, slide: sign * within(pattern.slide.safe, slide) })
    })
    .prop_filter("not every slide goes with every turn", |(p, shape)| p.check(*shape).is_ok())
}

/// From the first to the last contact of a rod, or from its free end where that is farther.
fn extent(weave: &Weave, rod: &WovenRod) -> [Point3; 2] {
    let contact = |c: &ContactId| weave.contacts[*c].on.position;
    let last = contact(rod.contacts.last().expect("every rod has contacts"));
    let (first, free) = (contact(&rod.contacts[0]), rod.through[0]);
    let farther = rod.ends[0] == RodEnd::Free && (free - last).norm() > (first - last).norm();
    [if farther { free } else { first }, last]
}

/// How far inside both segments their lines cross, as the least part of either.
fn overlap(p: [Point3; 2], q: [Point3; 2]) -> f64 {
    let (u, v, apart) = (p[1] - p[0], q[1] - q[0], q[0] - p[0]);
    let cross = u.xy().perp(&v.xy());
    let (s, t) = (apart.xy().perp(&v.xy()) / cross, apart.xy().perp(&u.xy()) / cross);
    if cross.abs() < 1e-12 { -1.0 } else { s.min(1.0 - s).min(t).min(1.0 - t) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn shared_rods_have_four_contacts_and_border_rods_two((pattern, shape) in legal(shared())) {
        let weave = woven(pattern, shape);
        let mut ending = vec![0; weave.rods.len()];
        let mut passing = vec![0; weave.rods.len()];
        for c in &weave.contacts {
            ending[c.ending.index()] += 1;
            passing[c.passing.index()] += 1;
        }
        for (r, rod) in weave.rods.enumerate() {
            let units = rod.units.len();
            prop_assert_eq!((ending[r.index()], passing[r.index()]), (units, units));
            prop_assert_eq!(rod.ends[0] == RodEnd::Free, units == 1);
            prop_assert_eq!(rod.contacts.len(), 2 * units);
        }
        for unit in &weave.units {
            prop_assert_eq!(unit.contacts.len(), unit.sides);
        }
    }

    /// Contacts are all the crossings there are: no rod runs through another without one.
    #[test]
    fn rods_cross_where_they_have_a_contact_and_nowhere_else(
        (pattern, shape) in legal(library().iter().collect()),
    ) {
        let weave = woven(pattern, shape);
        let pairs: BTreeSet<[RodId; 2]> = weave
            .contacts
            .iter()
            .map(|c| [c.ending.min(c.passing), c.ending.max(c.passing)])
            .collect();
        let extents: Vec<[Point3; 2]> = weave.rods.iter().map(|r| extent(&weave, r)).collect();
        for (i, &p) in extents.iter().enumerate() {
            for (j, &q) in extents.iter().enumerate().skip(i + 1) {
                let pair = [RodId::new(i), RodId::new(j)];
                let crosses = overlap(p, q) > 1e-6;
                prop_assert!(!crosses || pairs.contains(&pair), "{} {pair:?}", pattern.name);
            }
        }
        let rods = |c: &WovenContact| [c.ending.index(), c.passing.index()];
        for contact in weave.contacts.iter().filter(|c| c.kind == ContactKind::Cross) {
            let [p, q] = rods(contact).map(|r| extents[r]);
            prop_assert!(overlap(p, q) > -1e-6, "{}", pattern.name);
        }
    }

    /// Turning and sliding a little moves every contact a little, and makes and loses none.
    #[test]
    fn weaves_change_steadily((pattern, shape) in legal(library().iter().collect())) {
        let before = woven(pattern, shape);
        let least = 1e-7;
        let Shape { turn, slide } = shape;
        for after in [Shape { turn: turn + least, slide }, Shape { turn, slide: slide + least }] {
            if pattern.check(after).is_err() {
                continue;
            }
            let after = woven(pattern, after);
            prop_assert_eq!(before.contacts.len(), after.contacts.len());
            for (p, q) in before.contacts.iter().zip(&after.contacts) {
                let moved = (p.on.position - q.on.position).norm();
                prop_assert!(moved < 100.0 * least, "{}: {moved}", pattern.name);
            }
        }
    }
}

/// The contacts of a unit form a regular polygon round its centre, of inradius
/// |r sin φ ± q cos φ| with r that of the tile.
#[test]
fn units_are_regular_and_run_as_the_turn_says() {
    for pattern in shared() {
        let Shape { turn, slide } = pattern.usual();
        for sign in [1.0, -1.0] {
            let weave = woven(pattern, Shape { turn: sign * turn, slide: sign * slide });
            for unit in &weave.units {
                let half_step = std::f64::consts::PI / unit.rods.len() as f64;
                let r = 0.5 / half_step.tan();
                let [plus, minus] = [1.0, -1.0].map(|s| r * turn.sin() + s * slide * turn.cos());
                for &c in &unit.contacts {
                    let middle = weave.contacts[c].on.position - unit.center.position;
                    let hole = middle.norm() * half_step.cos();
                    let found =
                        if unit.chirality == Chirality::CounterClockwise { hole } else { -hole };
                    let near = [plus, minus].iter().any(|d| (sign * found - d).abs() < 1e-12);
                    assert!(near, "{}: {found}, not {plus} or {minus}", pattern.name);
                }
            }
        }
    }
}

/// The grid of Leonardo: right and left units in turn.
#[test]
fn slid_units_run_right_and_left_in_turn() {
    let pattern = Pattern::named("da-vinci").expect("in the library");
    let weave = woven(pattern, pattern.usual());
    for rod in weave.rods.iter().filter(|r| r.units.len() == 2) {
        let [a, b] = [rod.units[0], rod.units[1]].map(|u| weave.units[u].chirality);
        assert_ne!(a, b);
    }
}

/// Rods that meet end to end have two contacts in their unit and one beyond.
#[test]
fn rods_end_to_end_meet_one_other() {
    let pattern = Pattern::named("squares-end-to-end").expect("in the library");
    let weave = woven(pattern, pattern.usual());
    let ends = weave.contacts.iter().filter(|c| c.kind != ContactKind::Cross).count();
    let met = weave.rods.iter().filter(|r| r.ends[0] == RodEnd::Meets).count();
    assert!(ends > 100 && met == 2 * ends);
    for rod in &weave.rods {
        assert_eq!(rod.units.len(), 1);
        assert_eq!(rod.contacts.len(), if rod.ends[0] == RodEnd::Meets { 3 } else { 2 });
    }
}
