use super::*;
use crate::pattern::{Join, Shape, UnitKind, inradius};
use nalgebra::Rotation2;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn kind(sides: usize) -> UnitKind {
    let (outer, inner) = (Vec::new(), Vec::new());
    UnitKind { name: "unit".into(), sides, mirrored: false, radius: None, outer, inner }
}

/// Turns and slides at which a unit has a hole: a tenth of the tile's inradius at least.
fn open(sides: usize, shape: Shape) -> bool {
    let away = inradius(sides) * shape.turn.sin() + shape.slide * shape.turn.cos();
    away.abs() > 0.1 * inradius(sides)
}

fn shape() -> impl Strategy<Value = Shape> {
    (-0.7..0.7f64, -0.3..0.3f64).prop_map(|(turn, slide)| Shape { turn, slide })
}

proptest! {
    #[test]
    fn a_unit_of_n_rods_has_n_contacts_and_looks_the_same_n_times(
        sides in 3usize..=12, shape in shape(),
    ) {
        prop_assume!(open(sides, shape));
        let unit = kind(sides).figure(Join::Shared, shape, true).meetings(&[]).unwrap();
        prop_assert_eq!((unit.all.len(), unit.circuit), (sides, sides));
        let step = Rotation2::new(TAU / sides as f64);
        for i in 0..sides {
            let (here, next) = (&unit.all[i], &unit.all[(i + 1) % sides]);
            prop_assert!((step * here.at - next.at).norm() < 1e-12);
            for (a, b) in here.along.iter().zip(next.along) {
                prop_assert!((a - b).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_mirror_image_of_a_shape_makes_the_mirror_image_of_a_unit(
        sides in 3usize..=12, shape in shape(),
    ) {
        prop_assume!(open(sides, shape));
        let mirrored = Shape { turn: -shape.turn, slide: -shape.slide };
        let unit = |shape| kind(sides).figure(Join::Shared, shape, true).meetings(&[]).unwrap();
        let (one, other) = (unit(shape), unit(mirrored));
        prop_assert_eq!(one.counter_clockwise, !other.counter_clockwise);
        for (i, meeting) in one.all.iter().enumerate() {
            // Between rods i and i + 1; in the mirror between −i and −i − 1.
            let twin = &other.all[(2 * sides - i - 1) % sides];
            let image = Point2::new(meeting.at.x, -meeting.at.y);
            prop_assert!((image - twin.at).norm() < 1e-12);
        }
        // A mirrored unit with rods of its own is the same as one of the mirrored shape.
        let kind = UnitKind { mirrored: true, ..kind(sides) };
        let own = kind.figure(Join::End, shape, true).meetings(&[]).unwrap();
        prop_assert_eq!(own, other);
    }

    #[test]
    fn a_little_more_turn_or_slide_moves_contacts_a_little(
        sides in 3usize..=12, shape in shape(),
    ) {
        prop_assume!(open(sides, shape));
        let unit = |shape| kind(sides).figure(Join::Shared, shape, true).meetings(&[]).unwrap();
        let least = 1e-7;
        let Shape { turn, slide } = shape;
        let before = unit(shape);
        for after in [Shape { turn: turn + least, slide }, Shape { turn, slide: slide + least }] {
            for (p, q) in before.all.iter().zip(&unit(after).all) {
                prop_assert!((p.at - q.at).norm() < 10.0 * inradius(sides) * least);
            }
        }
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Line {
    let (from, to) = (Point2::from(from), Point2::from(to));
    Line { at: from, inward: to - from }
}

/// A square unit of edge one, its hole 0.2 wide, all sides parallel to the axes.
fn pinwheel() -> Figure {
    kind(4).figure(Join::Shared, Shape { turn: 0.0, slide: 0.1 }, true)
}

#[test]
fn a_guest_rests_on_the_rod_that_it_should_reach() {
    let figure = pinwheel();
    // Down from the upper edge, left of all upright rods: the first rod that it meets lies
    // at y = 0.1 or y = -0.1, on the left.
    let guest = |reach| Guest { side: 1, line: line([-0.3, 0.5], [-0.3, 0.0]), reach };
    let met = figure.meetings(&[guest(1)]).unwrap();
    let new = &met.all[met.circuit..];
    assert_eq!(new.len(), 1);
    assert_eq!((new[0].ending, new[0].passing), (Member::Guest(1), Member::Outer(2)));
    assert!((new[0].at.x + 0.3).abs() < 1e-12 && (new[0].at.y.abs() - 0.1).abs() < 1e-12);
    assert_eq!(figure.meetings(&[guest(2)]), Err(Unmet::Guest(1)));
}

#[test]
fn inner_rods_end_on_what_they_lie_across_and_other_rods_pass() {
    let figure = Figure { inner: vec![[[0.0, 0.3].into(), [0.0, -0.3].into()]], ..pinwheel() };
    let met = figure.meetings(&[]).unwrap();
    let new = &met.all[met.circuit..];
    assert_eq!(new.len(), 2);
    assert!(new.iter().all(|m| m.ending == Member::Inner(0)));
    let mut across: Vec<Member> = new.iter().map(|m| m.passing).collect();
    across.sort();
    assert_eq!(across, [Member::Outer(0), Member::Outer(2)]);
}

/// Rods drawn by hand as those of the circuit meet where those do.
#[test]
fn drawn_rods_of_a_circuit_meet_as_the_circuit_does() {
    let shape = Shape { turn: 0.35, slide: 0.0 };
    let plain = kind(6).figure(Join::Shared, shape, true);
    let circuit = plain.meetings(&[]).unwrap();
    let far = circuit.all[0].along[0];
    let drawn = Figure { stops: vec![far + 0.01; 6], ..plain };
    let met = drawn.meetings(&[]).unwrap();
    assert_eq!((met.all.len(), met.circuit), (6, 0));
    assert_eq!(met.counter_clockwise, circuit.counter_clockwise);
    for meeting in &circuit.all {
        let same = |m: &&Meeting| (m.at - meeting.at).norm() < 1e-12;
        let twin = met.all.iter().find(same).unwrap();
        assert_eq!((twin.ending, twin.passing), (meeting.ending, meeting.passing));
    }
}
