//! What the table and the ground hold, and whether partial frames stand as beams, too.

use super::rests::{anchor, rests};
use super::site::Site;
use super::{Order, OrderSettings, Prop, assembly};
use crate::frame::{Contact, Frame, Support};
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::shop::fixture;
use crate::statics::framework::{Assumptions, Feet, Framework};
use crate::statics::freedom::{Pose, Row, contact_rows, loose};
use crate::statics::joint::Hold;
use crate::statics::material::Material;
use crate::statics::solve::Solver;
use std::collections::BTreeMap;

fn contacts(frame: &Frame, without: &[usize]) -> Vec<Row> {
    let poses = Pose::all(frame);
    let kept = frame.contacts.ids().filter(|c| !without.contains(&c.index()));
    kept.flat_map(|c| contact_rows(frame, &poses, c)).collect()
}

/// A unit with all its rods placed in order.
fn placed(frame: &Frame, order: Order) -> Site<'_> {
    let mut site = Site::new(frame, order);
    frame.rods.ids().for_each(|rod| site.place(rod));
    site
}

#[test]
fn a_triangle_is_held_by_itself_and_loose_without_a_contact() {
    let frame = fixture::circuit(3, 3.0);
    let rods: Vec<RodId> = frame.rods.ids().collect();
    let (site, poses) = (placed(&frame, Order::Crown), Pose::all(&frame));
    let is_loose = |without: &[usize]| {
        let mut rows = contacts(&frame, without);
        rows.extend(anchor(&site, &poses));
        loose(&rods, &rows).unwrap().is_some()
    };
    assert!(!is_loose(&[]));
    (0..3).for_each(|c| assert!(is_loose(&[c])));
}

#[test]
fn larger_units_are_held_by_the_table() {
    for n in 4..=8 {
        let frame = fixture::circuit(n, 3.0);
        let rods: Vec<RodId> = frame.rods.ids().collect();
        let (site, poses) = (placed(&frame, Order::Crown), Pose::all(&frame));
        let mut rows = contacts(&frame, &[]);
        rows.extend(anchor(&site, &poses));
        assert!(loose(&rods, &rows).unwrap().is_some(), "{n}");
        rows.extend(rods.iter().flat_map(|&rod| rests(&site, &poses, rod)));
        assert!(loose(&rods, &rows).unwrap().is_none(), "{n}");
    }
}

#[test]
fn a_unit_on_its_feet_is_held_until_a_foot_goes() {
    let frame = fixture::circuit(4, 3.0);
    let rods: Vec<RodId> = frame.rods.ids().collect();
    let (site, poses) = (placed(&frame, Order::Ground), Pose::all(&frame));
    let feet = |without: usize| {
        let standing = rods.iter().skip(without);
        let mut rows: Vec<Row> = standing.flat_map(|&rod| poses[rod].held(rod, 0.0)).collect();
        rows.extend(contacts(&frame, &[]));
        loose(&rods, &rows).unwrap().is_some()
    };
    assert_eq!([0, 2, 3, 4].map(feet), [false, true, true, true]);
    assert_eq!(rests(&site, &poses, rods[0]).len(), 3);
}

/// The rods that are placed, with the contacts between them, as a frame of their own.
fn placed_part(site: &Site) -> (Frame, BTreeMap<RodId, RodId>) {
    let whole = site.frame;
    let rods: Vec<RodId> = site.sequence().to_vec();
    let number: BTreeMap<RodId, RodId> =
        rods.iter().enumerate().map(|(i, &rod)| (rod, RodId::new(i))).collect();
    let made: Vec<ContactId> = whole.contacts.ids().filter(|&c| site.made(c)).collect();
    let contact = |&c: &ContactId| {
        let c = &whole.contacts[c];
        Contact { over: number[&c.over], under: number[&c.under], ..c.clone() }
    };
    let mut frame = whole.clone();
    frame.contacts = made.iter().map(contact).collect();
    frame.rods = rods.iter().map(|&rod| whole.rods[rod].clone()).collect();
    let mut own: IdVec<RodId, Vec<ContactId>> = rods.iter().map(|_| Vec::new()).collect();
    for (id, c) in frame.contacts.enumerate() {
        own[c.over].push(id);
        own[c.under].push(id);
    }
    for (id, contacts) in own.enumerate() {
        frame.rods[id].contacts = contacts.clone();
    }
    frame.supports.clear();
    (frame, number)
}

/// Every partial frame of an order from the ground up stands as beams with nailed contacts, on
/// its feet and props: none of the modes of its stiffness is free.
#[test]
fn partial_frames_stand_as_beams() {
    for (name, pattern) in [("igloo", "4.4.4.4"), ("train-station", "3.3.3.4.4")] {
        let whole = fixture::on_sample(name, pattern);
        let settings = OrderSettings { order: Some(Order::Ground), step_rods: None };
        let order = assembly(&whole, &[], settings).unwrap();
        let mut site = Site::new(&whole, Order::Ground);
        let last = order.steps.len() - 1;
        for (n, (step, props)) in order.steps.iter().zip(order.standing()).enumerate() {
            step.rods.iter().for_each(|&rod| site.place(rod));
            let (mut frame, number) = placed_part(&site);
            for &rod in site.sequence() {
                let ends = super::rests::resting_ends(&site, rod);
                frame.supports.extend(ends.map(|end| Support {
                    rod: number[&rod],
                    end,
                    point: whole.end(rod, end),
                }));
            }
            let stays = |p: &&Prop| n == last || !step.remove_props.contains(&p.id);
            let props: Vec<&Prop> = props.iter().filter(stays).collect();
            let taken = Assumptions {
                material: Material::default(),
                hold: Hold::Nailed,
                feet: Feet::Pinned,
                scale: 1.0,
            };
            let places: Vec<(RodId, f64)> = props.iter().map(|p| (number[&p.rod], p.at)).collect();
            let mut framework = Framework::new(&frame, &taken, &places);
            for &(rod, at) in &places {
                framework.stand(Feet::Pinned, rod, at);
            }
            let stands = Solver::new(&framework.model).map(drop);
            assert_eq!(stands, Ok(()), "{name}, step {}", n + 1);
            // Without its feet and props it does not.
            framework.model.feet.clear();
            assert!(Solver::new(&framework.model).is_err(), "{name}, step {}", n + 1);
        }
    }
}
