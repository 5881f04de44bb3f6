//! An own check of a structure, from its axes alone.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

type Vec3 = nalgebra::Vector3<f64>;

/// Both ends of a rod, and its diameters there.
type Rod = ([Vec3; 2], [f64; 2]);

fn vector(v: &Value) -> Vec3 {
    let n: Vec<f64> = v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    Vec3::new(n[0], n[1], n[2])
}

/// The diameters of a rod at both ends.
fn diameters(rod: &Value) -> [f64; 2] {
    match &rod["diameter"] {
        Value::Array(both) => [0, 1].map(|i| both[i].as_f64().unwrap()),
        one => [one.as_f64().unwrap(); 2],
    }
}

/// The radius of a rod at a share of its length.
fn radius((_, [a, b]): Rod, share: f64) -> f64 {
    (a * (1.0 - share) + b * share) / 2.0
}

/// Checks a structure from its axes and diameters alone: gaps, marks, sides, clearances, and
/// that every rod is held twice. Returns the number of rods.
pub fn check_structure(s: &Value) -> usize {
    let w = s["rod_diameter"].as_f64().unwrap();
    let rods: BTreeMap<&str, Rod> = s["rods"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| {
            let ends = [vector(&r["a"]), vector(&r["b"])];
            (r["id"].as_str().unwrap(), (ends, diameters(r)))
        })
        .collect();
    let mut held: BTreeMap<&str, usize> = BTreeMap::new();
    let mut touching = BTreeSet::new();
    for c in s["contacts"].as_array().unwrap() {
        let [over, under] = ["over", "under"].map(|k| c[k].as_str().unwrap());
        check_contact(c, rods[over], rods[under], w);
        touching.insert([over.min(under), over.max(under)]);
        *held.entry(over).or_default() += 1;
        *held.entry(under).or_default() += 1;
    }
    assert!(rods.keys().all(|r| held.get(r).is_some_and(|&n| n >= 2)), "a rod dangles");
    let all: Vec<_> = rods.iter().collect();
    for (i, (p, a)) in all.iter().enumerate() {
        for (q, b) in &all[i + 1..] {
            if !touching.contains(&[**p.min(q), **p.max(q)]) {
                let ([s, t], least) = nearest(a.0, b.0);
                let room = radius(**a, s) + radius(**b, t);
                assert!(least >= room * (1.0 - 1e-6), "{p} and {q} clash: {least}");
            }
        }
    }
    rods.len()
}

fn check_contact(c: &Value, over: Rod, under: Rod, w: f64) {
    let id = &c["id"];
    let ([a0, a1], [b0, b1]) = (over.0, under.0);
    let (u, v) = ((a1 - a0).normalize(), (b1 - b0).normalize());
    let [s, t] = ["at_over", "at_under"].map(|k| c[k].as_f64().unwrap());
    if c["kind"] == "end" {
        let end = |key, a, b| if c[key] == "a" { a } else { b };
        let apart = end("end_over", a0, a1) - end("end_under", b0, b1);
        assert!(apart.norm() <= 1e-9 * w, "{id}: ends {} apart", apart.norm());
        return;
    }
    let apart = (a0 + u * s) - (b0 + v * t);
    let both = radius(over, s / (a1 - a0).norm()) + radius(under, t / (b1 - b0).norm());
    assert!((apart.norm() - both).abs() <= 1e-9 * w, "{id}: gap {}", apart.norm());
    assert!((c["gap"].as_f64().unwrap() - both).abs() <= 1e-9 * w, "{id}: {c}");
    assert!(apart.dot(&u).abs() < 1e-6 && apart.dot(&v).abs() < 1e-6, "{id}: marks");
    assert!(apart.dot(&vector(&c["normal"])) > 0.0, "{id}: over is not over");
    assert!(0.0 < s && s < (a1 - a0).norm() && 0.0 < t && t < (b1 - b0).norm(), "{id}: off");
    let angle = u.dot(&v).abs().acos().to_degrees();
    assert!((angle - c["angle"].as_f64().unwrap()).abs() < 1e-6, "{id}: angle {angle}");
}

/// Where two segments are nearest, as shares of both, and how near: by alternating
/// projection, which converges for convex sets.
fn nearest(a: [Vec3; 2], b: [Vec3; 2]) -> ([f64; 2], f64) {
    let share = |p: Vec3, [q0, q1]: [Vec3; 2]| {
        let d = q1 - q0;
        ((p - q0).dot(&d) / d.norm_squared()).clamp(0.0, 1.0)
    };
    let at = |[q0, q1]: [Vec3; 2], share: f64| q0 + (q1 - q0) * share;
    let (mut s, mut t) = (0.5, 0.5);
    for _ in 0..200 {
        t = share(at(a, s), b);
        s = share(at(b, t), a);
    }
    ([s, t], (at(a, s) - at(b, t)).norm())
}
