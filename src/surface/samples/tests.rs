use super::body::Peanut;
use super::dome::Igloo;
use super::grid::Even;
use super::*;
use crate::ids::Id;
use crate::surface::Point3;
use crate::surface::shape::Shape;
use crate::surface::topology::require_disk;
use std::f64::consts::TAU;

fn each() -> impl Iterator<Item = (&'static str, Mesh)> {
    NAMES.iter().map(|(name, _)| (*name, sample(name).expect("listed")))
}

fn smallest_angle(mesh: &Mesh) -> f64 {
    let angles = mesh.triangles.ids().flat_map(|f| {
        let c = mesh.corners(f);
        (0..3).map(move |k| (c[(k + 1) % 3] - c[k]).angle(&(c[(k + 2) % 3] - c[k])).to_degrees())
    });
    angles.fold(f64::INFINITY, f64::min)
}

#[test]
fn unknown_names_are_no_sample() {
    assert_eq!(sample("Igloo"), None);
}

#[test]
fn every_sample_is_a_disk_on_the_ground_with_good_triangles() {
    for (name, mesh) in each() {
        let topology = require_disk(&mesh).expect(name);
        assert!(Shape::new(&mesh, &topology).is_disk());
        assert!((3000..=8000).contains(&mesh.triangles.len()), "{name}");
        let angle = smallest_angle(&mesh);
        println!("{name}: {} triangles, smallest angle {angle:.1} deg", mesh.triangles.len());
        assert!(angle > 32.0, "{name}: {angle}");
        let low = mesh.bounds().expect("not empty")[0].z;
        assert!(low.abs() < 1e-9, "{name}: {low}");
        let up: f64 = mesh.triangles.ids().map(|f| mesh.area_vector(f).z).sum();
        assert!(up > 0.0, "{name} faces down");
    }
}

/// All but the open ones stand on the ground with the whole of their rim.
#[test]
fn rims_lie_on_the_ground() {
    for (name, mesh) in
        each().filter(|(n, _)| !["train-station", "vault", "bridge", "saddle"].contains(n))
    {
        let topology = require_disk(&mesh).expect(name);
        for v in mesh.points.ids().filter(|&v| topology.is_border(v)) {
            assert!(mesh.points[v].z.abs() < 1e-9, "{name}: {}", mesh.points[v]);
        }
    }
}

#[test]
fn sizes_are_as_described() {
    let size = |name| {
        let [lo, hi] = sample(name).expect("listed").bounds().expect("not empty");
        hi - lo
    };
    let near = |name, x, y, z, within| {
        let d = size(name) - nalgebra::Vector3::new(x, y, z);
        assert!(d.amax() < within, "{name}: {:?}", size(name));
    };
    near("igloo", 600.0, 600.0, 220.0, 0.5);
    near("ellipsoid", 692.0, 475.0, 178.5, 0.7);
    near("bridge", 885.0, 372.0, 247.0, 0.7);
    near("hut", 643.0, 490.0, 253.0, 0.7);
    near("train-station", 900.0, 450.0, 220.0, 1.0);
    near("peanut", 760.0, 326.0, 163.0, 0.7);
    near("vase", 620.0, 620.0, 220.0, 0.5);
    near("seashell", 509.0, 501.0, 220.0, 1.0);
    near("small-bug", 635.0, 410.0, 180.0, 1.0);
    near("super-bug", 890.0, 430.0, 190.0, 1.0);
    near("flat", 600.0, 600.0, 0.0, 1e-9);
    near("saddle", 600.0, 600.0, 160.0, 1e-9);
    near("vault", 600.0, 400.0, 167.8, 0.1);
}

#[test]
fn the_igloo_has_no_kink_and_meets_the_ground_as_steeply_as_asked() {
    let dome = Igloo::SAMPLE.profile();
    let length = dome.length();
    let slope = |s: f64| {
        let [[r0, z0], [r1, z1]] = [dome.at(s - 1e-4), dome.at(s + 1e-4)];
        (z0 - z1).atan2(r1 - r0).to_degrees()
    };
    let joint = dome.cap_radius * dome.joint;
    assert!((slope(joint - 0.01) - slope(joint + 0.01)).abs() < 0.02);
    assert!((slope(length) - 82.0).abs() < 1e-3);
    assert!(dome.cap_radius > 2.0 * dome.rim_radius && dome.joint < dome.foot);
    let [radius, z] = dome.at(length);
    assert!((radius - 300.0).abs() < 1e-9 && z.abs() < 1e-9);
}

/// The angle that is missing to a full turn at each inner vertex: its Gaussian curvature
/// times its area.
fn defects(mesh: &Mesh) -> Vec<f64> {
    let topology = require_disk(mesh).expect("a disk");
    let inner = mesh.points.ids().filter(|&v| !topology.is_border(v));
    inner
        .map(|v| {
            let angles = topology.outgoing(v).map(|h| {
                let p = mesh.points[v];
                let to = mesh.points[topology.to(h)] - p;
                to.angle(&(mesh.points[topology.from(h.prev())] - p))
            });
            TAU - angles.sum::<f64>()
        })
        .collect()
}

#[test]
fn convex_samples_bend_one_way() {
    let others = ["saddle", "peanut", "vase", "seashell", "small-bug", "super-bug"];
    for (name, mesh) in each().filter(|(name, _)| !others.contains(name)) {
        let least = defects(&mesh).into_iter().fold(f64::INFINITY, f64::min);
        assert!(least > -2e-3, "{name}: {least}");
    }
}

/// Largest angle between the normals of neighbouring triangles, degrees. At an edge of
/// 13 mm, 15° are a radius of 50 mm.
const CREASE: f64 = 15.0;

#[test]
fn no_sample_has_a_crease() {
    for (name, mesh) in each() {
        let mut normals = std::collections::BTreeMap::new();
        for f in mesh.triangles.ids() {
            let t = mesh.triangles[f];
            for k in 0..3 {
                let (a, b) = (t[k].index(), t[(k + 1) % 3].index());
                let n = mesh.area_vector(f);
                if let Some(other) = normals.insert([a.min(b), a.max(b)], n) {
                    let bend = n.angle(&other).to_degrees();
                    assert!(bend < CREASE, "{name}: {bend} at {}", mesh.points[t[k]]);
                }
            }
        }
    }
}

/// The product of the distances from the foci is the same all along the oval.
#[test]
fn the_peanut_is_an_oval_of_cassini() {
    let Peanut { half_length, fullness } = Peanut::SAMPLE;
    let focus = half_length / (fullness * fullness + 1.0).sqrt();
    for x in [0.0, 0.3, 0.7, 0.95].map(|share| share * half_length) {
        let r = Peanut::SAMPLE.radius(x);
        let product = (x - focus).hypot(r) * (x + focus).hypot(r);
        let expected = (fullness * focus).powi(2);
        assert!((product / expected - 1.0).abs() < 1e-12, "{x}: {product}");
    }
    let waist = Peanut::SAMPLE.radius(0.0);
    assert!(Peanut::SAMPLE.radius(0.6 * half_length) > 1.1 * waist);
}

#[test]
fn even_spacing_is_even_on_a_curve_of_uneven_speed() {
    let even = Even::new(|t| Point3::new(t * t * 90.0, 0.0, 0.0));
    assert!((even.length - 90.0).abs() < 1e-9);
    for share in [0.1, 0.5, 0.9] {
        assert!((even.parameter(share).powi(2) - share).abs() < 1e-5, "{share}");
    }
}
