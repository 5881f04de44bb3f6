//! The falsework, put together in space and held against the frame.

use super::*;
use crate::frame::axis::Axis;
use crate::ids::{Id, PropId};
use crate::shop::fixture;
use crate::shop::laser::{Curve, Point, area};
use crate::shop::order::{Order, OrderSettings, assembly};
use crate::surface::Point3;
use std::collections::BTreeSet;

const SHEET: [f64; 2] = [600.0, 400.0];
const PATTERNS: [(&str, &str); 3] =
    [("igloo", "4.4.4.4"), ("igloo", "3.6.3.6"), ("train-station", "4.4.4.4")];

fn board<'a>(work: &'a Falsework, name: &str) -> Option<&'a Board> {
    work.boards.iter().find(|b| b.name == name)
}

/// All slots of the plate: middle, and the unit vector along the longer sides.
fn slots(work: &Falsework) -> Vec<([f64; 2], [f64; 2], Vec<Point>)> {
    let plates = work.boards.iter().filter(|b| b.name.starts_with("base plate"));
    let slot = |hole: &Curve| {
        let Curve::Path(ring) = hole else { panic!("slots are rings") };
        let middle = [0, 1].map(|k| ring.iter().map(|p| p[k]).sum::<f64>() / 4.0);
        let side = [ring[1][0] - ring[0][0], ring[1][1] - ring[0][1]];
        let long = side[0].hypot(side[1]);
        (middle, side.map(|d| d / long), ring.clone())
    };
    plates.flat_map(|b| &b.holes).map(slot).collect()
}

/// Where a board stands by the slots that its tabs are in: the middle between them and the way
/// along it. `across` is a vector that it is to stand across.
fn standing(
    slots: &[([f64; 2], [f64; 2], Vec<Point>)],
    near: [f64; 2],
    across: [f64; 2],
) -> ([f64; 2], [f64; 2]) {
    let off = |m: [f64; 2]| (m[0] - near[0]).hypot(m[1] - near[1]);
    let fits = |way: [f64; 2]| (way[0] * across[0] + way[1] * across[1]).abs() < 1e-6;
    let mut ours: Vec<_> = slots.iter().filter(|s| fits(s.1)).collect();
    ours.sort_by(|a, b| off(a.0).total_cmp(&off(b.0)));
    let (a, b) = (ours[0].0, ours[1].0);
    let gap = (b[0] - a[0]).hypot(b[1] - a[1]);
    ([0, 1].map(|k| (a[k] + b[k]) / 2.0), [0, 1].map(|k| (b[k] - a[k]) / gap))
}

/// From the axis as an endless line.
fn from_line(axis: &Axis, p: Point3) -> f64 {
    (p - axis.a).cross(&axis.direction()).norm()
}

fn from_segment(axis: &Axis, p: Point3) -> f64 {
    let at = (p - axis.a).dot(&axis.direction()).clamp(0.0, axis.length());
    (p - axis.at(at)).norm()
}

/// Points along the edges of a ring, none farther apart than `step`.
fn along(ring: &[Point], step: f64) -> Vec<Point> {
    let next = ring.iter().cycle().skip(1);
    let edge = |(a, b): (&Point, &Point)| {
        let (a, b) = (*a, *b);
        let n = ((b[0] - a[0]).hypot(b[1] - a[1]) / step).ceil().max(1.0) as usize;
        let at = move |i: usize| [0, 1].map(|k| a[k] + (b[k] - a[k]) * i as f64 / n as f64);
        (0..n).map(at).collect::<Vec<_>>()
    };
    ring.iter().zip(next).flat_map(edge).collect()
}

#[test]
fn props_in_their_slots_carry_every_rod_on_its_axis() {
    for thickness in [1.5, 3.0, 6.0] {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let work = falsework(&frame, None, SHEET, thickness).unwrap();
        let slots = slots(&work);
        assert!(work.choice.stands.len() > 20);
        for (stand, shape) in &work.choice.stands {
            let rod = &frame.rods[stand.rod];
            let u = rod.axis.direction();
            let (foot, way) = standing(&slots, stand.foot, [u.x, u.y]);
            let prop = board(&work, &format!("prop {}", stand.id)).unwrap();
            let normal = [-way[1], way[0]];
            let place = |[x, y]: Point, s: f64| {
                let plan = [0, 1].map(|k| foot[k] + x * way[k] + s * normal[k]);
                Point3::new(plan[0], plan[1], frame.ground + y)
            };
            let (r, half) = (stand.radius, thickness / 2.0);
            let (mut nearest, mut on_curve) = (f64::INFINITY, 0);
            for p in along(&prop.outline, 0.05).into_iter().filter(|p| p[1] >= shape.seat - 1e-9) {
                let faces = [-half, half].map(|s| from_line(&rod.axis, place(p, s)));
                let low = faces[0].min(faces[1]);
                assert!(low > r - 0.01, "{}: {low} at {p:?}", stand.id);
                nearest = nearest.min(low);
                // Up to 60° to either side the saddle lies on the rod all along.
                if p[0].abs() < r * 0.866 && p[1] < stand.height {
                    assert!((low - r).abs() < 0.05, "{}: {low} at {p:?}", stand.id);
                    on_curve += 1;
                }
            }
            assert!((nearest - r).abs() < 0.01 && on_curve > 20, "{}: {nearest}", stand.id);
        }
    }
}

#[test]
fn tabs_fill_their_slots_and_laps_are_as_wide_as_the_board() {
    let (thickness, kerf) = (3.0, 0.2);
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    let work = falsework(&frame, None, SHEET, thickness).unwrap();
    let slots = slots(&work);
    let mut filled = 0;
    for (stand, shape) in &work.choice.stands {
        let names = [format!("prop {}", stand.id), format!("brace of prop {}", stand.id)];
        for (name, across) in names.iter().zip([stand.ways()[1], stand.ways()[0]]) {
            let Some(board) = board(&work, name) else { continue };
            let (foot, way) = standing(&slots, stand.foot, across);
            let tabs: Vec<Point> =
                board.outline.iter().copied().filter(|p| p[1] == -thickness).collect();
            assert_eq!(tabs.len(), 4);
            for tab in tabs.chunks(2) {
                let long = tab[1][0] - tab[0][0];
                let x = (tab[0][0] + tab[1][0]) / 2.0;
                let middle = [0, 1].map(|k| foot[k] + x * way[k]);
                let slot =
                    slots.iter().find(|(m, ..)| (m[0] - middle[0]).hypot(m[1] - middle[1]) < 1e-9);
                let (_, _, ring) = slot.expect("a slot for every tab");
                assert!((area(ring) - long * thickness).abs() < 1e-9);
                filled += 1;
            }
            // The laser takes away half a kerf on either side: the drawn lap is narrower.
            let drawn = board.compensated(kerf).unwrap();
            let grown = area(&drawn.outline) - area(&board.outline);
            assert!(grown > 0.0);
        }
        if let (Some(lap), Some(top)) = (shape.lap(), shape.brace) {
            assert!(2.0 * lap > top && 2.0 * lap < top + 1.0 && lap < shape.seat / 2.0);
        }
    }
    assert_eq!(filled, slots.len());
    for plate in work.boards.iter().filter(|b| b.name.starts_with("base plate")) {
        for (hole, drawn) in plate.holes.iter().zip(plate.compensated(kerf).unwrap().holes) {
            let (Curve::Path(hole), Curve::Path(drawn)) = (hole, drawn) else { panic!("rings") };
            let long = area(hole) / thickness;
            assert!((area(&drawn) - (long - kerf) * (thickness - kerf)).abs() < 1e-9);
        }
    }
}

/// By points all over the boards, not by the distances that places are chosen by.
#[test]
fn no_board_touches_another_rod_or_stand() {
    for (surface, pattern) in PATTERNS {
        let thickness = 3.0;
        let frame = fixture::on_sample(surface, pattern);
        let work = falsework(&frame, None, [800.0, 600.0], thickness).unwrap();
        let mut placed: Vec<(PropId, Vec<Point3>)> = Vec::new();
        for (stand, _) in &work.choice.stands {
            let [across, heading] = stand.ways();
            let names = [format!("prop {}", stand.id), format!("brace of prop {}", stand.id)];
            let mut points = Vec::new();
            for (k, (name, way)) in names.iter().zip([across, heading]).enumerate() {
                let Some(board) = board(&work, name) else { continue };
                let outline = along(&board.outline, 2.0);
                // The outline, and the same drawn in to the middle.
                for p in outline.iter().flat_map(|p| [1.0, 0.7, 0.3].map(|f| [p[0] * f, p[1]])) {
                    if p[1] < 0.0 {
                        continue;
                    }
                    let at = |i: usize| stand.foot[i] + p[0] * way[i];
                    let point = Point3::new(at(0), at(1), frame.ground + p[1]);
                    points.push(point);
                    for (id, rod) in frame.rods.enumerate() {
                        if k == 0 && id == stand.rod {
                            continue;
                        }
                        let apart = from_segment(&rod.axis, point) - rod.thickest() / 2.0;
                        assert!(apart >= thickness / 2.0 + 0.9, "{name} and {id}: {apart}");
                    }
                }
            }
            placed.push((stand.id, points));
        }
        for (i, (id, ours)) in placed.iter().enumerate() {
            for (other, theirs) in &placed[..i] {
                let far = (ours[0] - theirs[0]).xy().norm() > 150.0;
                let apart = |p: &Point3| theirs.iter().map(|q| (p - q).norm()).fold(1e9, f64::min);
                assert!(far || ours.iter().all(|p| apart(p) > thickness + 1.0), "{id} {other}");
            }
        }
    }
}

#[test]
fn every_unit_that_is_high_enough_has_a_prop_of_its_own() {
    for (surface, pattern) in PATTERNS {
        let frame = fixture::on_sample(surface, pattern);
        let Choice { stands, unheld, missed } = falsework(&frame, None, SHEET, 3.0).unwrap().choice;
        assert!(missed.is_empty());
        assert_eq!(stands.len() + unheld.len(), frame.units.len());
        assert!(unheld.len() * 10 <= frame.units.len(), "{surface} {pattern}: {unheld:?}");
        let units: BTreeSet<_> = stands.iter().filter_map(|(s, _)| s.unit).collect();
        assert_eq!(units.len(), stands.len());
        for (i, (stand, _)) in stands.iter().enumerate() {
            assert_eq!(stand.id, PropId::new(i));
            assert!(frame.units[stand.unit.unwrap()].rods.contains(&stand.rod));
        }
    }
}

#[test]
fn props_of_the_assembly_from_the_ground_are_taken_up_with_their_numbers() {
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    let settings = OrderSettings { order: Some(Order::Ground), step_rods: None };
    let assembly = assembly(&frame, &[], settings).unwrap();
    let choice = falsework(&frame, Some(&assembly), SHEET, 3.0).unwrap().choice;
    let props: Vec<_> = assembly.steps.iter().flat_map(|s| &s.props).collect();
    assert!(props.len() > 3 && choice.unheld.is_empty() && choice.missed.is_empty());
    assert_eq!(choice.stands.len(), props.len());
    for (stand, _) in &choice.stands {
        let prop = props.iter().find(|p| p.id == stand.id).unwrap();
        assert_eq!(prop.rod, stand.rod);
        // There is room near the place of each.
        assert!((prop.at - stand.at).abs() < 10.0, "{}: {} {}", prop.id, prop.at, stand.at);
    }
}
