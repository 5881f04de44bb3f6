use super::*;
use crate::chart::SurfacePoint;
use crate::frame::axis::Axis;
use crate::frame::close::across::Across;
use crate::frame::cut::crossing;
use crate::frame::fixture::{circuit, on_sample};
use crate::frame::{Chirality, Contact, Rod, Unit};
use crate::ids::{Id, RodId};
use crate::surface::{Point3, Vector3};
use nalgebra::{Rotation3, Translation3};

const MARKS: Tolerance = Tolerance { marks: 0.5, diameter: 0.0 };
const BOTH: Tolerance = Tolerance { marks: 0.5, diameter: 0.1 };

fn of(frame: &Frame, tolerance: Tolerance) -> Misfit {
    misfit(frame, tolerance, 1).unwrap().unwrap()
}

/// Two sticks with three across on top of them, at the same distances.
fn ladder() -> Frame {
    let axis = |a: [f64; 3], b: [f64; 3]| Axis { a: a.into(), b: b.into() };
    let rails = [0.0, 70.0].map(|y| axis([-10.0, y, 0.0], [120.0, y, 0.0]));
    let rungs = [0.0, 50.0, 100.0].map(|x| axis([x, -10.0, 3.0], [x, 80.0, 3.0]));
    let unit = UnitId::new(0);
    let contact = |(rail, rung): (usize, usize)| Contact {
        kind: ContactKind::Cross,
        over: RodId::new(2 + rung),
        under: RodId::new(rail),
        at_over: 10.0 + 70.0 * rail as f64,
        at_under: 10.0 + 50.0 * rung as f64,
        angle: 90_f64.to_radians(),
        gap: 3.0,
        normal: Vector3::z(),
        unit,
    };
    let pairs = [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2)];
    let contacts: IdVec<ContactId, Contact> = pairs.into_iter().map(contact).collect();
    let rod = |(r, &axis): (usize, &Axis)| Rod {
        axis,
        diameters: [3.0; 2],
        units: vec![unit],
        border: true,
        contacts: contacts
            .enumerate()
            .filter(|(_, c)| [c.over, c.under].contains(&RodId::new(r)))
            .map(|(id, _)| id)
            .collect(),
    };
    let rods: IdVec<RodId, Rod> = rails.iter().chain(&rungs).enumerate().map(rod).collect();
    let middle = SurfacePoint { position: Point3::origin(), normal: Vector3::z() };
    let unit = Unit {
        center: middle,
        chirality: Chirality::Clockwise,
        sides: 5,
        rods: rods.ids().collect(),
        contacts: contacts.ids().collect(),
    };
    Frame {
        diameter: 3.0,
        ground: 0.0,
        rods,
        contacts,
        units: vec![unit].into(),
        supports: Vec::new(),
        dropped: Vec::new(),
    }
}

/// How much less than with no pull at all the last contact of the ladder is off: five other
/// contacts weigh 11 against its one.
const PULLED: f64 = 1.0 + 11.0 * BY_HAND;

/// The rails are straight, so what lies between them grows evenly from rung to rung: the last
/// mark is off by the second difference of what is marked between them.
#[test]
fn a_ladder_is_off_by_the_second_difference_of_its_marks() {
    let frame = ladder();
    let last = last_contact(&frame, UnitId::new(0)).unwrap();
    assert_eq!(last, ContactId::new(5));
    let mut model = Model::new(&frame).unwrap();
    let end = model.last(last, BY_HAND);
    for k in 0..20 {
        let draw = |i: usize| 0.3 * ((k * 31 + i * 7) as f64).sin();
        let marks = (0..6).map(|c| [draw(2 * c), draw(2 * c + 1)]).collect();
        let errors = Errors { marks, gaps: vec![draw(40); 6].into() };
        let moves = model.put_together(&errors);
        let on_rung = |c: usize| errors.marks[ContactId::new(c)][0];
        let between = [0, 2, 4].map(|c| on_rung(c + 1) - on_rung(c));
        let off = (between[2] - 2.0 * between[1] + between[0]).abs() / PULLED;
        let found = end.off(&model, &errors, &moves);
        assert!((found - off).abs() < 2e-3, "{found} {off}");
    }
}

/// The second difference has √12 times the deviation of a mark.
#[test]
fn percentiles_are_those_of_the_normal_distribution() {
    let frame = ladder();
    let all: Vec<Misfit> = (1..=16).map(|s| misfit(&frame, MARKS, s).unwrap().unwrap()).collect();
    let mean = |of: fn(&Off) -> f64| all.iter().map(|m| of(&m.overall)).sum::<f64>() / 16.0;
    let deviation = 12_f64.sqrt() * 0.25 / PULLED;
    for (found, z) in [(mean(|off| off.median), 0.6745), (mean(|off| off.p95), 1.96)] {
        let expected = z * deviation;
        assert!((found / expected - 1.0).abs() < 0.05, "{found} {expected}");
    }
    assert_eq!(all[0].worst().unwrap().off, all[0].overall);
}

#[test]
fn a_unit_by_itself_has_room_to_give() {
    for n in 3..=6 {
        let found = of(&circuit(n, 3.0), BOTH);
        assert!(found.overall.p95 < 0.05, "{n}: {found:?}");
    }
}

#[test]
fn twice_the_errors_are_off_twice_and_none_not_at_all() {
    let frame = on_sample("igloo", "4.4.4.4");
    let [once, twice] =
        [1.0, 2.0].map(|f| of(&frame, Tolerance { marks: 0.5 * f, diameter: 0.1 * f }));
    assert!(once.overall.median > 0.1 && once.overall.p95 < 3.0, "{:?}", once.overall);
    for (p, q) in once.units.iter().zip(&twice.units) {
        assert_eq!((2.0 * p.off.median, 2.0 * p.off.p95), (q.off.median, q.off.p95));
    }
    let none = of(&frame, Tolerance { marks: 0.0, diameter: 0.0 });
    assert_eq!(none.overall, Off { median: 0.0, p95: 0.0 });
    assert_eq!(of(&frame, BOTH), once);
    assert_ne!(misfit(&frame, BOTH, 2).unwrap().unwrap().overall, once.overall);
    let lasts: std::collections::BTreeSet<_> = once.units.iter().map(|u| u.contact).collect();
    assert_eq!(lasts.len(), frame.units.len());
}

#[test]
fn where_the_frame_stands_and_how_it_is_turned_does_not_matter() {
    let frame = on_sample("igloo", "4.4.4.4");
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.83);
    let place = Translation3::new(300.0, -70.0, 40.0) * turn;
    let mut turned = frame.clone();
    for rod in turned.rods.iter_mut() {
        rod.axis = Axis { a: place * rod.axis.a, b: place * rod.axis.b };
    }
    turned.contacts.iter_mut().for_each(|c| c.normal = turn * c.normal);
    let [found, other] = [&frame, &turned].map(|f| of(f, BOTH));
    for (p, q) in found.units.iter().zip(&other.units) {
        assert!((p.off.median - q.off.median).abs() < 1e-5, "{p:?} {q:?}");
        assert!((p.off.p95 - q.off.p95).abs() < 1e-5, "{p:?} {q:?}");
    }
}

/// Places along rods and gaps after the moves, from the axes themselves: what the linear model
/// says of them is wrong by the square of the errors only.
#[test]
fn the_linear_model_agrees_with_the_moved_axes_to_second_order() {
    let frame = on_sample("igloo", "4.4.4.4");
    let mut model = Model::new(&frame).unwrap();
    let mut wrong = |size: f64| {
        let errors = Draws::new(3, size, size / 5.0).errors(&frame);
        let moves = model.put_together(&errors);
        let joints = frame.joints();
        let axis = |(r, rod): (RodId, &Rod)| {
            let ways = &moves[5 * r.index()..][..5];
            let m = Across::new(&rod.axis).to_move(&ways[..4]);
            let along = rod.axis.direction() * ways[4];
            Axis {
                a: rod.axis.a + m.fixed_rows::<3>(0) + along,
                b: rod.axis.b + m.fixed_rows::<3>(3) + along,
            }
        };
        let axes: IdVec<RodId, Axis> = frame.rods.enumerate().map(axis).collect();
        let mut worst = 0.0_f64;
        for (id, joint) in joints.enumerate() {
            let (contact, x) = (&frame.contacts[id], crossing(&axes, joint).unwrap());
            let [over, under] = errors.marks[id];
            let off = model.off_marks(id, &errors, &moves).unwrap();
            worst = worst.max((contact.at_over + over - x.at_first - off.x).abs());
            worst = worst.max((contact.at_under + under - x.at_second - off.y).abs());
            // Contacts are firm, so that their gaps come out as wanted.
            worst = worst.max((contact.gap + errors.gaps[id] - x.rise).abs());
        }
        worst
    };
    let [coarse, fine] = [0.02, 0.01].map(&mut wrong);
    assert!(coarse < 2e-3, "{coarse} mm of errors of 0.02 mm");
    assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
}
