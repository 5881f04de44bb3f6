//! The equations against finite differences, and their rank against closed forms.

use super::*;
use crate::frame::End;
use crate::frame::axis::Axis;
use crate::ids::Id;
use crate::shop::fixture;
use nalgebra::{DMatrix, DVector, Rotation3};

/// Rows as a matrix of five columns a rod.
fn matrix(rods: usize, rows: &[Row]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(rows.len(), FREEDOMS * rods);
    for (i, row) in rows.iter().enumerate() {
        for (rod, of) in row.parts() {
            for k in 0..FREEDOMS {
                matrix[(i, FREEDOMS * rod.index() + k)] += of[k];
            }
        }
    }
    matrix
}

/// The number of motions that keep all rows.
fn motions(rods: usize, rows: &[Row]) -> usize {
    let (matrix, all) = (matrix(rods, rows), FREEDOMS * rods);
    let square = matrix.transpose() * matrix;
    let values = square.symmetric_eigenvalues();
    all - values.iter().filter(|&&value| value > SLACK * SLACK).count()
}

fn contacts(frame: &Frame, without: &[usize]) -> Vec<Row> {
    let poses = Pose::all(frame);
    let kept = frame.contacts.ids().filter(|c| !without.contains(&c.index()));
    kept.flat_map(|c| contact_rows(frame, &poses, c)).collect()
}

/// The axis of a rod moved by its freedoms, to first order in them.
fn moved(frame: &Frame, rod: RodId, of: &Five) -> Axis {
    let (axis, pose) = (&frame.rods[rod].axis, Pose::new(frame, rod));
    Axis { a: axis.a + pose.motion(0.0, of), b: axis.b + pose.motion(axis.length(), of) }
}

/// The freedoms of a rod in a motion of the whole.
fn whole(frame: &Frame, rod: RodId, shift: Vector3, turn: Vector3) -> Five {
    let (axis, pose) = (&frame.rods[rod].axis, Pose::new(frame, rod));
    let middle = axis.at(axis.length() / 2.0);
    let at_middle = shift + turn.cross(&middle.coords);
    let tilt = turn.cross(&pose.along) * pose.half;
    let [p, q] = pose.sides.map(|side| side.dot(&tilt));
    Five::new(at_middle.x, at_middle.y, at_middle.z, p, q)
}

/// Two rods whose ends meet, in line or at an angle.
fn meeting(angle: f64) -> Frame {
    let mut frame = fixture::circuit(3, 3.0);
    let [first, second] = [0, 1].map(RodId::new);
    let along = Rotation3::from_axis_angle(&Vector3::y_axis(), angle) * Vector3::x();
    frame.rods[first].axis = Axis { a: [-50.0, 0.0, 0.0].into(), b: Point3::origin() };
    frame.rods[second].axis = Axis { a: Point3::origin(), b: (along * 70.0).into() };
    let contact = &mut frame.contacts[ContactId::new(0)];
    (contact.over, contact.under, contact.kind) =
        (first, second, ContactKind::End([End::B, End::A]));
    (contact.at_over, contact.at_under) = (50.0, 0.0);
    frame
}

#[test]
fn motions_of_the_whole_keep_every_contact() {
    let shift = Vector3::new(0.3, -0.7, 1.1);
    let turn = Vector3::new(0.02, 0.05, -0.03);
    for frame in [
        fixture::circuit(5, 3.0),
        fixture::on_sample("igloo", "zigzag"),
        meeting(0.0),
        meeting(0.4),
    ] {
        let all = frame
            .rods
            .ids()
            .flat_map(|rod| whole(&frame, rod, shift, turn).iter().copied().collect::<Vec<_>>());
        let motion = DVector::from_iterator(FREEDOMS * frame.rods.len(), all);
        let many = frame.contacts.len().min(40);
        let poses = Pose::all(&frame);
        let rows: Vec<Row> =
            (0..many).flat_map(|c| contact_rows(&frame, &poses, ContactId::new(c))).collect();
        let kinds: Vec<_> = frame.contacts.iter().take(many).collect();
        let broken = (matrix(frame.rods.len(), &rows) * motion).amax();
        // Contacts of the made-up frame that are not exact are none of ours.
        let exact = kinds.iter().all(|c| (frame.wanted_gap(c) - c.gap).abs() < 1e-6);
        assert!(!exact || broken < 1e-9, "{broken}");
    }
}

/// Gap, marks and angle of a contact change as its four equations say.
#[test]
fn the_equations_of_a_contact_agree_with_finite_differences() {
    let frame = fixture::circuit(4, 3.0);
    let poses = Pose::all(&frame);
    let id = ContactId::new(1);
    let c = &frame.contacts[id];
    let cross = |p: &Five, q: &Five| {
        let [over, under] = [moved(&frame, c.over, p), moved(&frame, c.under, q)];
        let x = over.cross(&under, &c.normal).unwrap();
        let angle = over.direction().dot(&under.direction()).acos();
        // From the middle, which stays where the ends part.
        let [s, t] =
            [(x.at_first, &over), (x.at_second, &under)].map(|(at, axis)| at - axis.length() / 2.0);
        [x.rise, s, t, angle]
    };
    let rows = contact_rows(&frame, &poses, id);
    assert_eq!(rows.len(), 4);
    let [u, v] = [poses[c.over].along, poses[c.under].along];
    let cosine = u.dot(&v);
    let arm = poses[c.over].half.min(poses[c.under].half);
    let step = 1e-5;
    for k in 0..2 * FREEDOMS {
        let mut x = [Five::zeros(); 2];
        x[k / FREEDOMS][k % FREEDOMS] = step;
        let [ahead, back] = [cross(&x[0], &x[1]), cross(&-x[0], &-x[1])];
        let change: Vec<f64> =
            ahead.iter().zip(back).map(|(a, b)| (a - b) / (2.0 * step)).collect();
        let said: Vec<f64> = rows
            .iter()
            .map(|row| {
                let [first, second] = [row.first.1, row.second.unwrap().1];
                (first.dot(&x[0]) + second.dot(&x[1])) / step
            })
            .collect();
        // The rods' points part by −δs along the one rod and by δt along the other.
        let [s, t] = [-change[1], change[2]];
        let wanted = [change[0], s + cosine * t, cosine * s + t, -change[3] * arm];
        for (said, wanted) in said.iter().zip(wanted) {
            assert!((said - wanted).abs() < 1e-5, "{k}: {said} {wanted}");
        }
    }
}

/// A symmetric unit has six motions of the whole, and n − 3 in which its rods tilt in turn.
/// Without one contact there is one more for each freedom that the tie no longer takes.
#[test]
fn a_unit_of_n_rods_tilts_in_n_less_3_ways() {
    for n in 3..=8 {
        let frame = fixture::circuit(n, 3.0);
        assert_eq!(motions(n, &contacts(&frame, &[])), 6 + n - 3, "{n}");
        assert_eq!(motions(n, &contacts(&frame, &[0])), 6 + n - 2, "{n}");
        assert_eq!(motions(n, &contacts(&frame, &[0, n / 2])), 6 + n + 2, "{n}");
    }
}

#[test]
fn ends_that_meet_are_held_by_a_sleeve() {
    for (angle, rest) in [(0.0, 5), (0.3, 6), (1.2, 6)] {
        let frame = meeting(angle);
        let rows = contact_rows(&frame, &Pose::all(&frame), ContactId::new(0));
        // Of a straight pair, turning about itself is no motion.
        assert_eq!(motions(2, &rows), rest, "{angle}");
    }
}

#[test]
fn the_loosest_motion_is_where_a_rod_hangs_by_one_contact() {
    let frame = fixture::circuit(5, 3.0);
    let poses = Pose::all(&frame);
    let rods: Vec<RodId> = frame.rods.ids().collect();
    // All feet stand, but rod 2 has lost its foot and what it ends on.
    let hanging = RodId::new(2);
    let mut rows: Vec<Row> = contacts(&frame, &[2]);
    for &rod in rods.iter().filter(|&&rod| rod != hanging) {
        rows.extend(poses[rod].held(rod, 0.0));
    }
    let motion = loose(&rods, &rows).unwrap().expect("it swings");
    let end = |rod: RodId| motion.at(&poses, rod, frame.rods[rod].axis.length()).norm();
    assert!(rods.iter().all(|&rod| rod == hanging || end(rod) < 0.2 * end(hanging)));
}
