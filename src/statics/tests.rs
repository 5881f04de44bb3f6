//! Closed forms.

use super::beam::Twelve;
use super::framework::{Assumptions, Feet, Framework};
use super::joint::{Hold, pull, springs};
use super::load::Load;
use super::material::Material;
use super::model::{Beam, Foot, Joint, Model};
use super::section::Section;
use super::solve::{Response, Solver, StaticsError};
use super::stress::{peak, rod_peaks, stress_at};
use crate::frame::fixture::circuit;
use crate::ids::{ContactId, Id, RodId};
use crate::surface::{Point3, Vector3};
use nalgebra::Vector6;

const ALL: [bool; 6] = [true; 6];
const PINNED: [bool; 6] = [true, true, true, false, false, false];
const D: f64 = 3.0;

/// A rod of `pieces` from the origin to `end`.
fn rod(end: Vector3, pieces: usize) -> Model {
    let at = |i: usize| Point3::from(end * (i as f64 / pieces as f64));
    let beam = |i| Beam { rod: RodId::new(0), nodes: [i, i + 1], section: Section { diameter: D } };
    Model {
        nodes: (0..=pieces).map(at).collect(),
        beams: (0..pieces).map(beam).collect(),
        joints: Vec::new(),
        feet: vec![Foot { rod: RodId::new(0), node: 0, held: ALL }],
        material: Material::named("pine").unwrap(),
    }
}

fn solve(model: &Model, load: &Load) -> Response {
    Solver::new(model).unwrap().solve(load)
}

fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs(), "{found} is not {wanted}");
}

/// EI, κGA, GJ, EA.
fn stiff(model: &Model) -> [f64; 4] {
    let (m, s) = (model.material, Section { diameter: D });
    let shear = m.shear * s.shear_area(m.poisson);
    [m.young * s.inertia(), shear, m.shear * s.polar(), m.young * s.area()]
}

#[test]
fn a_cantilever_bends_and_shears_under_a_load_at_its_tip() {
    for (length, direction) in [(10.0, Vector3::x()), (300.0, Vector3::new(0.6, 0.0, 0.8))] {
        let model = rod(direction * length, 3);
        let across = direction.cross(&Vector3::y());
        let mut load = Load::none(&model);
        load.nodes[3].fixed_rows_mut::<3>(0).copy_from(&(across * 2.0));
        let [ei, ga, ..] = stiff(&model);
        let answer = solve(&model, &load);
        let tip = answer.moved[3].fixed_rows::<3>(0).dot(&across);
        close(tip, 2.0 * length.powi(3) / (3.0 * ei) + 2.0 * length / ga);
        close(answer.reactions[0].fixed_rows::<3>(3).norm(), 2.0 * length);
    }
}

#[test]
fn a_cantilever_turns_under_a_moment_and_twists_and_stretches() {
    let model = rod(Vector3::x() * 100.0, 2);
    let [ei, _, gj, ea] = stiff(&model);
    let mut load = Load::none(&model);
    load.nodes[2] = Vector6::new(5.0, 0.0, 0.0, 7.0, 0.0, 11.0);
    let tip = solve(&model, &load).moved[2];
    close(tip[0], 5.0 * 100.0 / ea);
    close(tip[1], 11.0 * 100.0_f64.powi(2) / (2.0 * ei));
    close(tip[3], 7.0 * 100.0 / gj);
    close(tip[5], 11.0 * 100.0 / ei);
}

/// 5qL⁴/384EI and qL²/8κGA.
#[test]
fn a_span_on_two_supports_sags_under_its_weight() {
    let mut model = rod(Vector3::x() * 200.0, 2);
    let pinned = [true, true, true, true, false, false];
    model.feet = vec![
        Foot { rod: RodId::new(0), node: 0, held: pinned },
        Foot { rod: RodId::new(0), node: 2, held: PINNED },
    ];
    let [ei, ga, ..] = stiff(&model);
    let q = model.material.weight() * Section { diameter: D }.area();
    let answer = solve(&model, &Load::weight(&model));
    let sag = 5.0 * q * 200.0_f64.powi(4) / (384.0 * ei) + q * 200.0_f64.powi(2) / (8.0 * ga);
    close(-answer.moved[1][2], sag);
    close(answer.reactions[0][2], q * 100.0);
}

#[test]
fn a_slope_carries_its_weight_along_and_across() {
    let (length, slope) = (150.0, 0.5_f64);
    let model = rod(Vector3::new(slope.cos(), 0.0, slope.sin()) * length, 1);
    let [ei, ga, _, ea] = stiff(&model);
    let q = model.material.weight() * Section { diameter: D }.area();
    let tip = solve(&model, &Load::weight(&model)).moved[1];
    let (along, across) = (q * slope.sin(), q * slope.cos());
    let shortened = along * length.powi(2) / (2.0 * ea);
    let bent = across * (length.powi(4) / (8.0 * ei) + length.powi(2) / (2.0 * ga));
    close(tip[0] * slope.cos() + tip[2] * slope.sin(), -shortened);
    close(tip[2] * slope.cos() - tip[0] * slope.sin(), -bent);
}

/// Two cantilevers that meet at their tips, joined by a contact of length `D`.
fn crossed(hold: Hold) -> Model {
    let mut model = rod(Vector3::x() * 100.0, 1);
    let up = Vector3::z() * D;
    model.nodes.extend([Point3::new(100.0, 100.0, 0.0) + up, Point3::new(100.0, 0.0, 0.0) + up]);
    let section = Section { diameter: D };
    model.beams.push(Beam { rod: RodId::new(1), nodes: [2, 3], section });
    let springs = springs(hold, section, &model.material);
    model.joints.push(Joint {
        contact: ContactId::new(0),
        nodes: [3, 1],
        touch: model.nodes[1] + up / 2.0,
        axis: Vector3::z(),
        springs,
    });
    model.feet.push(Foot { rod: RodId::new(0), node: 2, held: ALL });
    model
}

#[test]
fn forces_and_moments_balance_with_each_kind_of_contact() {
    for hold in [Hold::Nailed, Hold::Tied, Hold::Notched] {
        let model = crossed(hold);
        let mut load = Load::weight(&model);
        load.nodes[3] += Vector6::new(1.0, 2.0, -3.0, 0.0, 0.0, 0.0);
        let answer = solve(&model, &load);
        let mut force = Vector3::new(1.0, 2.0, -3.0);
        let mut moment = model.nodes[3].coords.cross(&force);
        for (beam, q) in model.beams.iter().zip(&load.beams) {
            let weight = q * model.along(beam).norm();
            let middle = nalgebra::center(&model.nodes[beam.nodes[0]], &model.nodes[beam.nodes[1]]);
            force += weight;
            moment += middle.coords.cross(&weight);
        }
        for (foot, reaction) in model.feet.iter().zip(&answer.reactions) {
            let push: Vector3 = reaction.fixed_rows::<3>(0).into();
            force += push;
            moment += model.nodes[foot.node].coords.cross(&push) + reaction.fixed_rows::<3>(3);
        }
        assert!(force.norm() < 1e-9 * 3.0, "{hold:?}: {force}");
        assert!(moment.norm() < 1e-9 * 300.0, "{hold:?}: {moment}");
    }
}

/// Two alike cantilevers share a load on the upper one: each takes half, but for what the
/// springs of the contact give.
#[test]
fn a_contact_that_carries_half_the_load_is_pressed() {
    let model = crossed(Hold::Notched);
    let mut load = Load::none(&model);
    load.nodes[3].z = -2.0;
    let answer = solve(&model, &load);
    let [ei, ga, ..] = stiff(&model);
    let tip = 100.0_f64.powi(3) / (3.0 * ei) + 100.0 / ga;
    let spring = 1.0 / model.joints[0].springs.push;
    close(answer.joints[0].z, -2.0 * tip / (2.0 * tip + spring));
}

#[test]
fn a_rod_on_a_pin_is_refused_by_name() {
    let mut model = crossed(Hold::Notched);
    // The under rod may turn about its foot and carries nothing; the over rod stands.
    model.joints.clear();
    model.feet[0].held = PINNED;
    let error = Solver::new(&model).err().expect("it is a mechanism");
    let StaticsError::Loose(loose) = error else { panic!("{error}") };
    assert_eq!(loose.rods, [RodId::new(0)]);
    assert!(loose.to_string().starts_with("too few supports: R001 can move freely, R001 most"));
    assert_eq!((loose.most, loose.at), (RodId::new(0), 100.0));
}

/// qL²/8 in the middle, between two even places that are looked at.
#[test]
fn stress_peaks_where_the_moment_does() {
    let mut model = rod(Vector3::x() * 200.0, 1);
    let pinned = [true, true, true, true, false, false];
    model.feet = vec![
        Foot { rod: RodId::new(0), node: 0, held: pinned },
        Foot { rod: RodId::new(0), node: 1, held: PINNED },
    ];
    let mut load = Load::weight(&model);
    let section = Section { diameter: D };
    let q = -load.beams[0].z;
    let peaks = rod_peaks(&model, &load, &solve(&model, &load));
    close(peaks[0].at, 100.0);
    close(peaks[0].stress, q * 200.0_f64.powi(2) / 8.0 / section.modulus());
    close(peaks[0].utilisation, peaks[0].stress / 24.0);
    // A moment at one end moves the place to qL/2 + M/L = q s.
    let moment = 0.013 * q * 200.0_f64.powi(2);
    load.nodes[0][4] = moment;
    let peaks = rod_peaks(&model, &load, &solve(&model, &load));
    close(peaks[0].at, 100.0 - moment / 200.0 / q);
}

/// A beam under a load that is skew to both of its axes, turned at its ends about both: no other
/// of very many places is stressed more than the peak.
#[test]
fn stress_peaks_between_the_peaks_of_both_moments() {
    let beam = rod(Vector3::x() * 200.0, 1).beams[0];
    let q = Vector3::new(0.0, 2e-3, 5e-3);
    for first in [-90.0, -40.0, 10.0, 60.0] {
        // Balanced: what the ends give up to the load, and the moments that they turn with.
        let ends = Twelve::from_row_slice(&[
            0.1, -0.25, -0.4, 3.0, 5.0, first, -0.1, -0.15, -0.6, -3.0, 15.0, 0.0,
        ]);
        let found = peak(&beam, 200.0, &ends, &q);
        let most = (0..=100_000)
            .map(|i| stress_at(&beam, &ends, &q, 200.0 * f64::from(i) / 1e5))
            .fold(0.0, f64::max);
        assert!(found.stress >= most * (1.0 - 1e-12), "{first}: {} {most}", found.stress);
        close(stress_at(&beam, &ends, &q, found.at), found.stress);
    }
}

#[test]
fn stress_of_a_cantilever_is_that_of_its_root() {
    let model = rod(Vector3::new(0.0, 70.0, 0.0), 2);
    let mut load = Load::none(&model);
    load.nodes[2] = Vector6::new(0.0, 3.0, -2.0, 0.0, 90.0, 0.0);
    let section = Section { diameter: D };
    let peaks = rod_peaks(&model, &load, &solve(&model, &load));
    let sigma = 3.0 / section.area() + 140.0 / section.modulus();
    let tau = 90.0 / (2.0 * section.modulus()) + 8.0 / (3.0 * section.area());
    close(peaks[0].stress, (sigma.powi(2) + 3.0 * tau.powi(2)).sqrt());
    assert_eq!(peaks[0].at, 0.0);
}

/// Rods of one circuit, which turns into itself: all are moved and stressed alike.
#[test]
fn an_even_circuit_carries_its_weight_evenly() {
    for (n, feet) in [(3, Feet::Pinned), (5, Feet::Fixed)] {
        let frame = circuit(n, D);
        let material = Material::named("birch").unwrap();
        let taken = Assumptions { material, hold: Hold::Nailed, feet, scale: 10.0 };
        let framework = Framework::new(&frame, &taken, &[]);
        let model = &framework.model;
        assert_eq!((model.joints.len(), model.feet.len()), (n, n));
        let load = Load::weight(model);
        let answer = solve(model, &load);
        let weight: f64 =
            model.beams.iter().zip(&load.beams).map(|(b, q)| -q.z * model.along(b).norm()).sum();
        for reaction in &answer.reactions {
            let share = weight / n as f64;
            assert!((reaction.z - share).abs() < 1e-6 * share, "{} {share}", reaction.z);
        }
        let peaks = rod_peaks(model, &load, &answer);
        assert_eq!(peaks.len(), n);
        for peak in &peaks {
            let off = (peak.stress - peaks[0].stress).abs();
            assert!(off < 1e-5 * peaks[0].stress, "{peak:?} {:?}", peaks[0]);
        }
        for (joint, force) in model.joints.iter().zip(&answer.joints) {
            assert!(pull(joint, force) < 0.0, "a circuit presses its contacts together");
        }
    }
}

/// A portal of two posts and a beam, fixed at its feet, pushed sideways at a corner. Half of
/// the push is a sway of both corners alike, half presses them together; for each the frame is
/// cut in its middle, and Castigliano's theorem gives what acts there.
#[test]
fn a_portal_drifts_as_castigliano_says() {
    let (h, half) = (300.0_f64, 200.0_f64);
    let mut model = rod(Vector3::z() * h, 1);
    let section = Section { diameter: D };
    model.nodes.extend([Point3::new(2.0 * half, 0.0, h), Point3::new(2.0 * half, 0.0, 0.0)]);
    for (rod, nodes) in [(1, [1, 2]), (2, [3, 2])] {
        model.beams.push(Beam { rod: RodId::new(rod), nodes, section });
    }
    model.feet.push(Foot { rod: RodId::new(2), node: 3, held: ALL });
    let [ei, ga, _, ea] = stiff(&model);
    let push = 4.0;
    let mut load = Load::none(&model);
    load.nodes[1].x = push;
    // Sway: a shear force acts in the middle.
    let soft = half.powi(3) / (3.0 * ei) + half.powi(2) * h / ei + h / ea + half / ga;
    let shear = push / 2.0 * half * h.powi(2) / (2.0 * ei) / soft;
    let post = h.powi(3) / (3.0 * ei) + h / ga;
    let sway = push / 2.0 * post - shear * half * h.powi(2) / (2.0 * ei);
    // Pressed together: a thrust and a moment act there.
    let stiffened = post - h.powi(4) / (4.0 * ei * (h + half));
    let pressed = push / 2.0 * stiffened / (1.0 + ea * stiffened / half);
    close(solve(&model, &load).moved[1].x, sway + pressed);
}

/// Four rods in a square, joined at their ends, and one that crosses none: 12 × 10 mm² of it
/// are carried by its sides, each by its length in plan.
#[test]
fn a_load_on_an_area_falls_on_the_rods_round_each_mesh() {
    let corners = [[0.0, 0.0], [12.0, 0.0], [12.0, 10.0], [0.0, 10.0]];
    let mut model = rod(Vector3::x(), 1);
    (model.nodes, model.beams) = (Vec::new(), Vec::new());
    let section = Section { diameter: 1.0 };
    for i in 0..4 {
        for [x, y] in [corners[i], corners[(i + 1) % 4]] {
            model.nodes.push(Point3::new(x, y, 0.3 * x));
        }
        let nodes = [2 * i, 2 * i + 1];
        model.beams.push(Beam { rod: RodId::new(i), nodes, section });
    }
    let springs = springs(Hold::Nailed, section, &model.material);
    for i in 0..4 {
        let nodes = [2 * i + 1, (2 * i + 2) % 8];
        let (touch, axis) = (model.nodes[nodes[0]], Vector3::z());
        let joint = Joint { contact: ContactId::new(i), nodes, touch, axis, springs };
        model.joints.push(joint);
    }
    let load = Load::area(&model, 0.5);
    close(load.total(&model).z, -60.0);
    let on = |i: usize| load.beams[i].z * model.along(&model.beams[i]).norm();
    close(on(0), -60.0 * 12.0 / 44.0);
    close(on(3), -60.0 * 10.0 / 44.0);
    // Seen from below it is what lies round the square: nothing carries it.
    model.joints.iter_mut().for_each(|j| j.axis = -Vector3::z());
    assert_eq!(Load::area(&model, 0.5).total(&model).z, 0.0);
}
