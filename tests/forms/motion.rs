//! A frame goes with its surface: moved, turned or scaled as a whole, it is the same frame.

use super::case::Case;
use nalgebra::{Point2, Rotation2, Rotation3};
use rodwright::chart::PlanarChart;
use rodwright::frame::Frame;
use rodwright::surface::{Mesh, Point3, Vector3};

/// How far ends of the same rod may lie apart, in diameters. Flattening stops at some 1e-9
/// of the angles; larger, and a real dependence could hide.
const SAME: f64 = 1e-6;

/// The farthest that an end lies from where it should, in diameters. Rods are numbered by
/// the tiles, which lie in another order in a plane that is turned, so rods are found by
/// their place.
pub fn apart(frame: &Frame, other: &Frame, back: impl Fn(Point3) -> Point3) -> f64 {
    assert_eq!(
        [frame.rods.len(), frame.contacts.len(), frame.units.len(), frame.supports.len()],
        [other.rods.len(), other.contacts.len(), other.units.len(), other.supports.len()]
    );
    let others: Vec<[Point3; 2]> =
        other.rods.iter().map(|rod| [back(rod.axis.a), back(rod.axis.b)]).collect();
    let to = |[a, b]: [Point3; 2], [p, q]: [Point3; 2]| (a - p).norm().max((b - q).norm());
    let nearest = frame.rods.iter().map(|rod| {
        let own = [rod.axis.a, rod.axis.b];
        others
            .iter()
            .map(|&[p, q]| to(own, [p, q]).min(to(own, [q, p])))
            .fold(f64::INFINITY, f64::min)
    });
    nearest.fold(0.0, f64::max) / frame.diameter
}

fn moved(mesh: &Mesh, to: impl Fn(&Point3) -> Point3) -> Mesh {
    Mesh { points: mesh.points.iter().map(to).collect(), triangles: mesh.triangles.clone() }
}

/// A case with the edge that fits it, and its frame.
fn fixed(case: Case) -> (Case, Frame) {
    let chart = case.chart().expect("a sample");
    let edge = Some(case.fitted(&chart).expect("a sample"));
    let case = Case { edge, ..case };
    let frame = case.form().expect("a sample").frame;
    (case, frame)
}

fn cases() -> impl Iterator<Item = (Case, Frame)> {
    ["igloo", "saddle"]
        .into_iter()
        .flat_map(|surface| ["4.4.4.4", "3.6.3.6"].map(|pattern| fixed(Case::on(surface, pattern))))
}

/// The plane of a chart turns with the surface about z, so the pattern is turned with it.
#[test]
fn a_turn_about_z_and_a_shift_change_nothing() {
    let (turn, shift) = (0.7, Vector3::new(120.0, -45.0, 33.0));
    let space = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
    for (case, frame) in cases() {
        let mut settings = case.settings.clone();
        settings.surface_low += shift.z;
        let mesh = moved(&case.mesh, |p| space * p + shift);
        let other = Case { mesh, rotation: turn, settings, ..case.clone() }.form();
        let other = other.expect("the same surface").frame;
        let most = apart(&frame, &other, |p| space.inverse() * (p - shift));
        assert!(most < SAME, "{}: {most:e} diameters", case.pattern.name);
    }
}

/// The turn that takes the plane of one chart to that of another of the same mesh.
fn between(chart: &PlanarChart, other: &PlanarChart) -> f64 {
    let pairs = chart.flat().iter().zip(other.flat());
    let (dot, cross) = pairs.fold((0.0, 0.0), |(dot, cross), (p, q): (&Point2<f64>, _)| {
        (dot + p.coords.dot(&q.coords), cross + p.coords.perp(&q.coords))
    });
    let turn = cross.atan2(dot);
    let far = |(p, q): (&Point2<f64>, &Point2<f64>)| (Rotation2::new(turn) * p - q).norm();
    let most = chart.flat().iter().zip(other.flat()).map(far).fold(0.0, f64::max);
    assert!(most < 1e-6, "the charts differ by more than a turn: {most:e} mm");
    turn
}

/// Which way the plane of a chart is turned depends on the axes of space, and rods stand on
/// a ground that is level: the pattern is turned with the plane, and the ground is out of
/// reach.
#[test]
fn any_turn_of_space_changes_nothing_but_the_axes_of_the_plane() {
    let space = Rotation3::from_scaled_axis(Vector3::new(0.9, -0.5, 0.4));
    for (mut case, _) in cases() {
        case.settings.surface_low = -1e6;
        let frame = case.form().expect("a sample").frame;
        let mut other = Case { mesh: moved(&case.mesh, |p| space * p), ..case.clone() };
        let charts = [&case, &other].map(|c| c.chart().expect("the same surface"));
        other.rotation = between(&charts[0], &charts[1]);
        let other = other.form().expect("the same surface").frame;
        let most = apart(&frame, &other, |p| space.inverse() * p);
        assert!(most < SAME, "{}: {most:e} diameters", case.pattern.name);
    }
}

#[test]
fn a_larger_surface_with_thicker_rods_gives_a_larger_frame() {
    for scale in [0.01, 7.3] {
        for (case, frame) in cases() {
            let mut settings = case.settings.clone();
            for length in [&mut settings.diameter, &mut settings.overhang, &mut settings.round] {
                *length *= scale;
            }
            let mesh = moved(&case.mesh, |p| p * scale);
            let edge = case.edge.map(|edge| edge * scale);
            let other = Case { mesh, edge, settings, ..case.clone() }.form();
            let other = other.expect("the same shape").frame;
            let most = apart(&frame, &other, |p| p / scale);
            assert!(most < SAME, "{} by {scale}: {most:e} diameters", case.pattern.name);
        }
    }
}
