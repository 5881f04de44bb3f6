//! Orders of many frames, checked from the frame alone.

use super::*;
use crate::ids::IdVec;
use crate::shop::fixture;
use crate::statics::freedom::{Pose, Row, contact_rows, loose};
use crate::surface::hull::{convex_hull, depth_in};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// Frames of all kinds: shared rods, own rods that meet or rest, rods within units, a sheet,
/// and units alone.
static FRAMES: [LazyLock<(&str, Frame)>; 13] = [
    LazyLock::new(|| ("squares", fixture::on_sample("igloo", "4.4.4.4"))),
    LazyLock::new(|| ("basket work", fixture::on_sample("igloo", "3.6.3.6"))),
    LazyLock::new(|| ("zigzag", fixture::on_sample("igloo", "zigzag"))),
    LazyLock::new(|| ("end to end", fixture::on_sample("igloo", "squares-end-to-end"))),
    LazyLock::new(|| ("crossing", fixture::on_sample("igloo", "crossing"))),
    LazyLock::new(|| ("bug", fixture::on_sample("igloo", "bug"))),
    LazyLock::new(|| ("resting", fixture::on_sample("train-station", "hexagons-resting"))),
    LazyLock::new(|| ("vault", fixture::on_sample("vault", "3.3.4.3.4"))),
    LazyLock::new(|| ("flat", fixture::on_sample("flat", "6.6.6"))),
    LazyLock::new(|| ("saddle", fixture::on_sample("saddle", "4.4.4.4"))),
    LazyLock::new(|| ("three", fixture::circuit(3, 3.0))),
    LazyLock::new(|| ("four", fixture::circuit(4, 3.0))),
    LazyLock::new(|| ("seven", fixture::circuit(7, 3.0))),
];

fn ordered(frame: &Frame, order: Order, step_rods: Option<usize>) -> Assembly {
    assembly(frame, &[], OrderSettings { order: Some(order), step_rods }).unwrap()
}

/// Checks an order from the frame alone; returns what is wrong.
fn faults(frame: &Frame, assembly: &Assembly) -> Vec<String> {
    let mut faults = Vec::new();
    let mut placed: BTreeSet<RodId> = BTreeSet::new();
    let mut made: BTreeMap<ContactId, usize> = BTreeMap::new();
    let mut props: BTreeMap<PropId, RodId> = BTreeMap::new();
    let foot = |rod: RodId| usize::from(frame.supports.iter().any(|s| s.rod == rod));
    for (n, step) in assembly.steps.iter().enumerate() {
        for &rod in &step.rods {
            if !placed.insert(rod) {
                faults.push(format!("step {n} places {rod} again"));
            }
        }
        for (list, under) in [(&step.over, false), (&step.under, true)] {
            for &id in list {
                let c = &frame.contacts[id];
                *made.entry(id).or_default() += 1;
                let mine = if under { c.under } else { c.over };
                let cross = c.kind == crate::frame::ContactKind::Cross;
                if cross && !step.rods.contains(&mine)
                    || ![c.over, c.under].iter().all(|r| placed.contains(r))
                {
                    faults.push(format!("step {n} lists {id} on the wrong side"));
                }
            }
        }
        let slid: Vec<ContactId> = step.lifts.iter().map(|l| l.contact).collect();
        if slid != step.under {
            faults.push(format!("step {n} lifts for {slid:?}, not for {:?}", step.under));
        }
        for lift in &step.lifts {
            let c = &frame.contacts[lift.contact];
            if [lift.rod, lift.below] != [c.over, c.under] {
                faults.push(format!("step {n} lifts {} for {}", lift.rod, lift.below));
            }
        }
        props.extend(step.props.iter().map(|p| (p.id, p.rod)));
        for &rod in &placed {
            let partner = |&&c: &&ContactId| placed.contains(&frame.seen_from(c, rod).partner);
            let contacts = frame.rods[rod].contacts.iter().filter(partner).count();
            let held = contacts + props.values().filter(|&&r| r == rod).count() + foot(rod);
            if held < 2 {
                faults.push(format!("step {n} leaves {rod} with {held}"));
            }
        }
        for prop in &step.remove_props {
            if props.remove(prop).is_none() {
                faults.push(format!("step {n} takes {prop} away, which does not stand"));
            }
        }
    }
    if placed.len() != frame.rods.len() || made.len() != frame.contacts.len() {
        faults.push(format!("{} rods, {} contacts in all", placed.len(), made.len()));
    }
    faults.extend(made.iter().filter(|m| *m.1 != 1).map(|m| format!("{m:?} times")));
    faults.extend(props.keys().map(|prop| format!("{prop} is left")));
    faults
}

/// The steps after which the whole could move, from all equations at once.
fn loose_steps(frame: &Frame, assembly: &Assembly) -> Vec<usize> {
    let poses: IdVec<RodId, Pose> = Pose::all(frame);
    let mut site = Site::new(frame, assembly.order);
    let mut props: BTreeMap<PropId, &Prop> = BTreeMap::new();
    let mut found = Vec::new();
    for (n, step) in assembly.steps.iter().enumerate() {
        step.rods.iter().for_each(|&rod| site.place(rod));
        site.step += 1;
        props.extend(step.props.iter().map(|p| (p.id, p)));
        if assembly.order == Order::Ground && n + 1 < assembly.steps.len() {
            // What stands until the next step.
            props.retain(|p, _| !step.remove_props.contains(p));
        }
        let made = frame.contacts.ids().filter(|&c| site.made(c));
        let mut rows: Vec<Row> = made.flat_map(|c| contact_rows(frame, &poses, c)).collect();
        rows.extend(site.sequence().iter().flat_map(|&rod| rests::rests(&site, &poses, rod)));
        rows.extend(props.values().flat_map(|p| poses[p.rod].held(p.rod, p.at)));
        if assembly.order == Order::Crown {
            rows.extend(rests::anchor(&site, &poses));
            props.retain(|p, _| !step.remove_props.contains(p));
        }
        if loose(site.sequence(), &rows).unwrap().is_some() {
            found.push(n);
        }
    }
    found
}

/// The steps after which a body of rods would topple, until the next one.
fn toppling_steps(frame: &Frame, assembly: &Assembly) -> Vec<usize> {
    let mut placed: BTreeSet<RodId> = BTreeSet::new();
    let mut props: BTreeMap<PropId, &Prop> = BTreeMap::new();
    let mut found = Vec::new();
    for (n, step) in assembly.steps.iter().enumerate() {
        placed.extend(&step.rods);
        props.extend(step.props.iter().map(|p| (p.id, p)));
        props.retain(|p, _| !step.remove_props.contains(p));
        let mut left = placed.clone();
        while let Some(first) = left.pop_first() {
            let mut body = vec![first];
            let mut next = 0;
            while next < body.len() {
                let contacts = frame.rods[body[next]].contacts.iter();
                let partners = contacts.map(|&c| frame.seen_from(c, body[next]).partner);
                let touching: Vec<RodId> = partners.filter(|p| left.remove(p)).collect();
                body.extend(touching);
                next += 1;
            }
            let axes = || body.iter().map(|&r| &frame.rods[r].axis);
            let weight: f64 = axes().map(|axis| axis.length()).sum();
            let middle = [0, 1].map(|i| {
                axes().map(|a| a.length() * (a.a[i] + a.b[i]) / 2.0).sum::<f64>() / weight
            });
            let feet = frame.supports.iter().filter(|s| body.contains(&s.rod)).map(|s| s.point);
            let below = props.values().filter(|p| body.contains(&p.rod)).map(|p| p.point);
            let lying = axes().flat_map(|a| [a.a, a.b]).filter(|p| p.z < frame.ground + 10.0);
            let points: Vec<[f64; 2]> =
                feet.chain(below).chain(lying).map(|p| [p.x, p.y]).collect();
            if depth_in(&convex_hull(points), middle) < 0.0 {
                found.push(n);
            }
        }
    }
    // The finished frame is as it is.
    found.retain(|&n| n + 1 < assembly.steps.len());
    found
}

#[test]
fn orders_keep_all_rules_and_nothing_moves() {
    for (name, frame) in FRAMES.iter().map(|f| &**f) {
        for order in [Order::Crown, Order::Ground] {
            let assembly = ordered(frame, order, None);
            let found = faults(frame, &assembly);
            assert!(found.is_empty(), "{name} {order:?}: {found:?}");
            assert_eq!(loose_steps(frame, &assembly), [0; 0], "{name} {order:?}");
            if order == Order::Ground {
                assert_eq!(toppling_steps(frame, &assembly), [0; 0], "{name}");
            }
        }
    }
}

#[test]
fn crowns_of_domes_need_no_props() {
    for (surface, pattern) in [
        ("igloo", "3.3.3.3.3.3"),
        ("igloo", "3.12.12"),
        ("ellipsoid", "4.8.8"),
        ("ellipsoid", "6.6.6"),
    ] {
        let frame = fixture::on_sample(surface, pattern);
        let assembly = assembly(&frame, &[], OrderSettings::default()).unwrap();
        assert_eq!((assembly.order, assembly.props()), (Order::Crown, 0), "{surface} {pattern}");
    }
}

#[test]
fn a_step_places_one_unit_at_most() {
    for (name, frame) in FRAMES.iter().map(|f| &**f).filter(|f| f.0 != "crossing") {
        let most = frame.units.iter().map(|unit| unit.rods.len()).max().unwrap();
        for order in [Order::Crown, Order::Ground] {
            let steps = ordered(frame, order, None).steps;
            assert!(steps.iter().all(|s| (1..=most).contains(&s.rods.len())), "{name} {order:?}");
        }
    }
}

#[test]
fn one_rod_of_each_circuit_closes_it() {
    let frame = &FRAMES[0].1;
    let steps = ordered(frame, Order::Crown, None).steps;
    let mut closed: BTreeSet<UnitId> = BTreeSet::new();
    for step in &steps {
        for closing in &step.closes {
            assert!(closed.insert(closing.unit));
            assert!(step.rods.contains(&closing.rod));
            assert!(frame.units[closing.unit].rods.contains(&closing.rod));
        }
    }
    assert!(closed.into_iter().eq(frame.units.ids()));
    // A unit alone cannot be laid without lifting one rod.
    assert_eq!(steps[0].lifts.len(), 1);
    assert_eq!(steps[0].lifts[0].below, steps[0].closes[0].rod);
}

#[test]
fn rings_of_a_crown_come_one_after_the_other() {
    let frame = &FRAMES[0].1;
    let neighbors = Neighbors::new(frame);
    let levels = neighbors.levels(frame, Order::Crown);
    assert_eq!(levels[0].len(), 1);
    let ring = |unit: UnitId| levels.iter().position(|l| l.contains(&unit)).unwrap();
    let steps = ordered(frame, Order::Crown, None).steps;
    let rings: Vec<usize> = steps.iter().map(|s| ring(s.unit.unwrap())).collect();
    assert!(rings.is_sorted(), "{rings:?}");
    // From the feet up, the units with feet come first.
    let steps = ordered(frame, Order::Ground, None).steps;
    let stands = |s: &Step| s.rods.iter().any(|&r| frame.supports.iter().any(|f| f.rod == r));
    let last = steps.iter().rposition(stands).unwrap();
    assert!(last < steps.len() / 2, "{last} of {}", steps.len());
}

#[test]
fn contacts_to_be_tied_are_named_in_the_step_that_makes_them() {
    let frame = &FRAMES[0].1;
    let tied: Vec<ContactId> = frame.contacts.ids().step_by(5).collect();
    let settings = OrderSettings { order: Some(Order::Crown), step_rods: None };
    let steps = assembly(frame, &tied, settings).unwrap().steps;
    let mut named: Vec<ContactId> = Vec::new();
    for step in &steps {
        assert!(step.ties.iter().all(|c| step.over.contains(c) || step.under.contains(c)));
        named.extend(&step.ties);
    }
    named.sort_unstable();
    assert_eq!(named, tied);
}

#[test]
fn props_stand_below_their_rods_and_outside_the_holes() {
    for (name, frame) in FRAMES.iter().map(|f| &**f) {
        for prop in ordered(frame, Order::Ground, None).steps.iter().flat_map(|s| &s.props) {
            let rod = &frame.rods[prop.rod];
            let radius = rod.diameter_at(prop.at) / 2.0;
            let apart = rod.axis.at(prop.at) - prop.point;
            assert!((apart.norm() - radius).abs() < 1e-9 && apart.z > 0.0, "{name} {prop:?}");
            assert!(apart.dot(&rod.axis.direction()).abs() < 1e-9);
            assert!((prop.height - (prop.point.z - frame.ground)).abs() < 1e-9);
            assert!(prop.height > -2.0 * radius, "{name} {prop:?}");
            for &unit in &rod.units {
                let circuit = frame.circuit(&frame.units[unit]).iter();
                let mine = circuit.filter(|c| rod.contacts.contains(c));
                let at: Vec<f64> = mine.map(|&c| frame.seen_from(c, prop.rod).at).collect();
                if let [p, q] = at[..] {
                    assert!(!(p.min(q)..p.max(q)).contains(&prop.at), "{name} {prop:?}");
                }
            }
        }
    }
}

/// Distances after a step are between marks of it, and would change if it lay wrong.
#[test]
fn two_distances_check_each_step() {
    for (name, frame) in FRAMES.iter().map(|f| &**f) {
        for (n, step) in ordered(frame, Order::Crown, None).steps.iter().enumerate() {
            let enough = step.checks.len() == 2;
            assert!(enough || frame.rods.len() < 5, "{name} {n}: {:?}", step.checks);
            for check in &step.checks {
                let at = check.marks.each_ref().map(|m| {
                    let marks = crate::shop::marks(frame, m.rod);
                    let mark = marks.iter().find(|mark| mark.letter == m.mark).unwrap();
                    frame.rods[m.rod].axis.at(mark.at)
                });
                assert!(((at[1] - at[0]).norm() - check.distance).abs() < 1e-9);
                assert_ne!(check.marks[0].rod, check.marks[1].rod);
            }
        }
    }
}

#[test]
fn a_frame_without_rods_takes_no_steps() {
    let mut frame = fixture::circuit(3, 3.0);
    frame.rods = IdVec::new();
    frame.contacts = IdVec::new();
    frame.units = IdVec::new();
    frame.supports.clear();
    let assembly = assembly(&frame, &[], OrderSettings::default()).unwrap();
    assert!(assembly.steps.is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn any_cap_on_rods_keeps_all_rules(
        which in 0..FRAMES.len(),
        most in 1_usize..7,
        ground in proptest::bool::ANY,
    ) {
        let (name, frame) = &*FRAMES[which];
        let order = if ground { Order::Ground } else { Order::Crown };
        let assembly = ordered(frame, order, Some(most));
        let found = faults(frame, &assembly);
        prop_assert!(found.is_empty(), "{} {:?} {}: {:?}", name, order, most, found);
        prop_assert_eq!(&assembly, &ordered(frame, order, Some(most)));
        if ground {
            prop_assert!(assembly.steps.iter().all(|s| s.rods.len() <= most));
        }
    }

    /// Contacts turned over at random: over and under follow the frame.
    #[test]
    fn sides_follow_the_frame(turned in proptest::collection::vec(proptest::bool::ANY, 64)) {
        let mut frame = FRAMES[0].1.clone();
        for (i, contact) in frame.contacts.iter_mut().enumerate() {
            if turned[i % turned.len()] {
                std::mem::swap(&mut contact.over, &mut contact.under);
                std::mem::swap(&mut contact.at_over, &mut contact.at_under);
            }
        }
        for order in [Order::Crown, Order::Ground] {
            let found = faults(&frame, &ordered(&frame, order, None));
            prop_assert!(found.is_empty(), "{:?}", found);
        }
    }
}
