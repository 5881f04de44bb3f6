use super::bounds::{Bounds, Limits};
use super::equations::{Equations, Move, Moves, moved};
use super::marks::Marks;
use super::shape::{Circuit, Weights};
use super::unit_terms::{Scale, UnitTerms};
use super::*;
use crate::chart::SurfacePoint;
use crate::frame::close::across::{Across, Bases};
use crate::frame::close::exact::EXACT;
use crate::frame::gaps::circuit;
use crate::frame::{ContactKind, End};
use crate::ids::Id;
use crate::surface::Vector3;
use std::f64::consts::TAU;

type Axes = IdVec<RodId, Axis>;
type Joints = IdVec<ContactId, Joint>;

/// Two circuits side by side; their nearest rods are `apart` mm from each other.
pub(super) fn two_circuits(n: usize, apart: f64) -> (Axes, Joints) {
    let (mut axes, mut joints) = circuit(n, 3.0);
    let (others, theirs) = circuit(n, 3.0);
    let away = Vector3::new(0.5, 40.0 + apart, 1.0);
    for axis in &others {
        // Askew, so that no two rods are parallel.
        let turned = Vector3::new(1.5, -0.7, 0.9);
        axes.push(Axis { a: axis.a + away, b: axis.b + away + turned });
    }
    let shifted = |r: RodId| RodId::new(r.index() + n);
    for joint in &theirs {
        let (over, under) = (shifted(joint.over), shifted(joint.under));
        joints.push(Joint { over, under, ..joint.clone() });
    }
    (axes, joints)
}

/// The contacts of every rod in order, room for them, and overhangs of 6 mm.
pub(super) fn limits(axes: &Axes, joints: &Joints, room: f64) -> Limits {
    let mut along: IdVec<RodId, Vec<(f64, ContactId)>> = vec![Vec::new(); axes.len()].into();
    for (id, j) in joints.enumerate() {
        let x = axes[j.over].cross(&axes[j.under], &j.outward).unwrap();
        along[j.over].push((x.at_first, id));
        along[j.under].push((x.at_second, id));
    }
    along.iter_mut().for_each(|seats| seats.sort_by(|p, q| p.0.total_cmp(&q.0)));
    Limits {
        along: along.iter().map(|seats| seats.iter().map(|s| s.1).collect()).collect(),
        room: along.iter().map(|seats| vec![room; seats.len()]).collect(),
        beyond: vec![[6.0; 2]; axes.len()].into(),
        thickness: vec![3.0; axes.len()].into(),
        diameter: 3.0,
    }
}

/// How near the rods of two circuits of four come to each other as they are cut, mm.
pub(super) fn nearest(axes: &Axes, joints: &Joints, limits: &Limits) -> f64 {
    let cut = |r: RodId| {
        let x = |c: &ContactId| {
            let j = &joints[*c];
            let x = axes[j.over].cross(&axes[j.under], &j.outward).unwrap();
            if j.over == r { x.at_first } else { x.at_second }
        };
        let along = &limits.along[r];
        axes[r].between(x(&along[0]) - 6.0, x(&along[1]) + 6.0)
    };
    let pairs = (0..4).flat_map(|i| (4..8).map(move |j| [i, j].map(RodId::new)));
    pairs.map(|[i, j]| cut(i).distance(&cut(j))).fold(f64::INFINITY, f64::min)
}

/// The unit of a regular circuit, wanted at a place.
pub(super) fn wanted(joints: &Joints, place: [f64; 3]) -> Circuit {
    let n = joints.len();
    Circuit {
        contacts: joints.ids().collect(),
        place: SurfacePoint { position: place.into(), normal: Vector3::z() },
        cosines: vec![-(TAU / n as f64).cos(); n],
        sides: vec![1.0; n],
    }
}

#[test]
fn circuits_close_exactly() {
    for n in 3..=8 {
        let (mut axes, joints) = circuit(n, 3.0);
        let done = project(&mut axes, &joints).unwrap();
        assert!(done.error <= EXACT && done.steps <= 9, "{n}: {done:?}");
        for joint in &joints {
            let x = axes[joint.over].cross(&axes[joint.under], &joint.outward).unwrap();
            assert!((x.rise - 3.0).abs() < 1e-11, "{n}: {}", x.rise);
        }
    }
}

/// Joined by the ends of one rod of each.
#[test]
fn ends_that_meet_come_together_exactly() {
    let (mut axes, mut joints) = two_circuits(4, 81.0);
    let (over, under) = (RodId::new(0), RodId::new(4));
    let kind = ContactKind::End([End::B, End::A]);
    joints.push(Joint { over, under, outward: Vector3::z(), diameter: 3.0, kind });
    let done = project(&mut axes, &joints).unwrap();
    assert!(done.error <= EXACT && done.steps > 0, "{done:?}");
    assert!((axes[over].b - axes[under].a).norm() < 1e-11);
    let rows = rows(&axes, &joints).unwrap();
    assert_eq!(rows.len(), 8 + 3);
    assert!(rows[..8].iter().all(|row| (row.gap - 3.0).abs() < 1e-11));
}

#[test]
fn a_closed_frame_does_not_move() {
    let (mut axes, joints) = circuit(5, 2.0);
    project(&mut axes, &joints).unwrap();
    let before = axes.clone();
    assert_eq!(project(&mut axes, &joints).unwrap().steps, 0);
    assert_eq!(axes, before);
}

/// The terms of a unit against central differences.
#[test]
fn gradients_of_shapes_agree_with_finite_differences() {
    let (axes, joints) = circuit(5, 3.0);
    let circuit = wanted(&joints, [1.0, 2.0, 3.0]);
    let bases: Bases = axes.iter().map(Across::new).collect();
    let scale =
        Scale { edge: 40.0, weights: Weights { sides: 2.0, ..Weights::PAPER }, strain: 0.7 };
    let terms = |axes: &Axes| {
        let mut terms = UnitTerms::default();
        terms.fill(axes, &bases, &joints, &circuit, &scale).unwrap();
        terms
    };
    let (base, h) = (terms(&axes), 1e-5);
    let there = |axes: &Axes| {
        let mut moved = base.clone();
        moved.revalue(&terms(axes), &scale);
        moved.values
    };
    assert_eq!(base.values.len(), 1 + 5 + 5 + 3 * 5);
    let width = Across::WAYS * base.rods.len();
    for (i, &rod) in base.rods.iter().enumerate() {
        for way in 0..Across::WAYS {
            let mut ways = [0.0; Across::WAYS];
            ways[way] = 1.0;
            let mut moves: Moves = vec![Move::zeros(); axes.len()].into();
            moves[rod] = bases[rod].to_move(&ways);
            let [plus, minus] = [h, -h].map(|h| there(&moved(&axes, &moves, h)));
            for (k, row) in base.rows.chunks_exact(width).enumerate() {
                let numeric = (plus[k] - minus[k]) / (2.0 * h);
                let exact = row[Across::WAYS * i + way];
                assert!((numeric - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{k}");
            }
        }
    }
}

/// Room along rods, and distances of rods beside and end to end, against central
/// differences.
#[test]
fn gradients_of_bounds_agree_with_finite_differences() {
    for away in [1.5, 11.0] {
        let (axes, joints) = two_circuits(4, away);
        let limits = limits(&axes, &joints, 100.0);
        let rows = rows(&axes, &joints).unwrap();
        let of = |axes: &Axes| Bounds::new(axes, &joints, &rows, &limits);
        let broken = of(&axes).broken(&axes, &rows);
        assert!(broken.len() >= 8, "{broken:?}");
        let h = 1e-5;
        for bound in broken {
            let held = |axes: &Axes| {
                let mut equations = Equations::of_contacts(&[]);
                assert!(of(axes).hold(bound, axes, &mut equations));
                equations
            };
            let base = held(&axes);
            for rod in axes.ids() {
                for k in 0..6 {
                    let mut moves: Moves = vec![Move::zeros(); axes.len()].into();
                    moves[rod][k] = 1.0;
                    let lacking = |h: f64| held(&moved(&axes, &moves, h)).lacking[0];
                    let numeric = -(lacking(h) - lacking(-h)) / (2.0 * h);
                    let exact = base.changes(&moves)[0];
                    assert!((numeric - exact).abs() < 1e-6, "{bound:?} {rod} {k}");
                }
            }
        }
    }
}

#[test]
fn rods_that_would_clash_are_kept_apart() {
    let (start, joints) = two_circuits(4, 1.5);
    let limits = limits(&start, &joints, 3.0);
    let nearest = |axes: &Axes| nearest(axes, &joints, &limits);
    let mut free = start.clone();
    project(&mut free, &joints).unwrap();
    assert!(nearest(&free) < 2.5, "{}", nearest(&free));
    for way in [Way::Least, Way::Shape] {
        let mut axes = start.clone();
        let task = Task {
            joints: &joints,
            circuits: &[],
            limits: Some(&limits),
            marks: Marks::default(),
            roam: None,
            edge: 60.0,
        };
        let done = close(&mut axes, &task, way).unwrap();
        assert!(done.error <= 1e-10 && done.held > 0, "{done:?}");
        assert!(nearest(&axes) >= 3.0 - 1e-9, "{way:?}: {}", nearest(&axes));
        assert!(nearest(&axes) < 3.01, "no farther than need be");
    }
}

/// Four and a half kilometres from the origin a coordinate has no digit below 9e-10 mm, which
/// is 3e-10 of the diameter.
#[test]
fn rods_far_from_the_origin_close_as_far_as_rounding_lets_them() {
    let mut worst: f64 = 0.0;
    for n in 3..12 {
        let (mut axes, joints) = circuit(n, 3.0);
        let away = Vector3::new(4.5e6, -4.3e6, 4.4e6);
        for axis in axes.iter_mut() {
            *axis = Axis { a: axis.a + away, b: axis.b + away };
        }
        worst = worst.max(project(&mut axes, &joints).unwrap().error);
    }
    assert!((1e-10..=1e-9).contains(&worst), "{worst:e}");
}

/// Rods of a square pulled askew come back into shape, at once exact.
#[test]
fn units_are_brought_into_shape() {
    let (mut axes, joints) = circuit(4, 3.0);
    axes[RodId::new(1)].a.x += 4.0;
    axes[RodId::new(2)].b.y -= 3.0;
    let circuits = [wanted(&joints, [0.0; 3])];
    let task = Task {
        joints: &joints,
        circuits: &circuits,
        limits: None,
        marks: Marks::default(),
        roam: None,
        edge: 60.0,
    };
    let total = |way: Way| {
        let done = close(&mut axes.clone(), &task, way).unwrap();
        (done.energy.map(|e| e.total(&Weights::PAPER)), done.error)
    };
    let ([start, shaped], error) = total(Way::Shape);
    let ([_, least], _) = total(Way::Least);
    assert!(error <= EXACT);
    assert!(shaped < 0.5 * start && shaped < 0.5 * least, "{start} {shaped} {least}");
    let near = Task { roam: Some(0.1), ..task };
    assert_eq!(close(&mut axes.clone(), &near, Way::Shape).unwrap().shaping, 0);
    let ([_, paper], error) = total(Way::Paper);
    assert!(paper < start && error < 0.1, "{paper} {error}");
}
