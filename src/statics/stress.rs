//! Stress at the outer fibre along a beam of circular section.
//!
//! σ = |N|/A + M/W with M the resultant of both bending moments; τ = T/2W + 4V/3A, the
//! torsion at the skin and the largest shear of a solid circle (at its middle) taken
//! together though they lie apart; von Mises √(σ² + 3τ²), so that it is never too small.
//! Under an even load N, V change evenly along the beam and M as a square: the stress may peak
//! within it. An even division and the places where a bending moment peaks tell where, and a
//! golden-section search between the neighbours of the highest finds it.

use super::beam::{self, Twelve};
use super::load::Load;
use super::model::{Beam, Model};
use super::solve::Response;
use crate::ids::RodId;
use crate::surface::Vector3;

/// Even places in a beam that are looked at, besides the peaks of its two bending moments.
const PLACES: usize = 8;
/// Steps of the search for a peak: each leaves 0.618 of the range, all together 1e-9 of it.
const STEPS: usize = 43;
/// A stress larger by this part is larger by more than rounding.
const ROUNDING: f64 = 1e-12;
/// A step inward from an end, as part of the length.
const NEAR: f64 = 1e-6;

/// The largest stress of a beam.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Peak {
    /// Von Mises stress, MPa.
    pub stress: f64,
    /// Distance from the beam's first node, mm.
    pub at: f64,
}

/// The largest stress of a rod.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RodPeak {
    /// The rod.
    pub rod: RodId,
    /// Von Mises stress, MPa.
    pub stress: f64,
    /// Distance from end A, mm.
    pub at: f64,
    /// Stress by strength.
    pub utilisation: f64,
}

/// Force (along, two across) and moment (torsion, two bending) in a section at `s` from the
/// first node, as the part behind holds the part before; `q` in the beam's axes.
fn inside(ends: &Twelve, q: &Vector3, s: f64) -> [Vector3; 2] {
    let force = -Vector3::new(ends[0], ends[1], ends[2]) - q * s;
    let first = Vector3::new(ends[3], ends[4], ends[5]);
    let arm = Vector3::x() * s;
    // Balance about the section of everything before it.
    let start = Vector3::new(ends[0], ends[1], ends[2]);
    let moment = -first + arm.cross(&start) + (arm / 2.0).cross(&(q * s));
    [force, moment]
}

/// Von Mises stress at `s` from the first node, MPa.
pub fn stress_at(beam: &Beam, ends: &Twelve, q: &Vector3, s: f64) -> f64 {
    let [force, moment] = inside(ends, q, s);
    let (area, modulus) = (beam.section.area(), beam.section.modulus());
    let sigma = force.x.abs() / area + moment.y.hypot(moment.z) / modulus;
    let tau = moment.x.abs() / (2.0 * modulus) + 4.0 * force.y.hypot(force.z) / (3.0 * area);
    (sigma.powi(2) + 3.0 * tau.powi(2)).sqrt()
}

/// The largest stress along a beam, from what its nodes do to it and the even load on it,
/// both in its axes.
pub fn peak(beam: &Beam, length: f64, ends: &Twelve, q: &Vector3) -> Peak {
    let even = (0..=PLACES).map(|i| length * i as f64 / PLACES as f64);
    // Where a shear force passes zero its moment peaks.
    let turn = [1, 2].into_iter().filter(|&i| q[i] != 0.0).map(|i| -ends[i] / q[i]);
    let places = even.chain(turn.filter(|s| (0.0..=length).contains(s)));
    let of = |at: f64| Peak { stress: stress_at(beam, ends, q, at), at };
    let higher = |a: Peak, b: Peak| if b.stress > a.stress { b } else { a };
    let most = places.map(of).fold(Peak { stress: -1.0, at: 0.0 }, higher);
    // Without a load between its ends no place is stressed more than they are; nor where it is
    // less from the end inward.
    let inward = (most.at + NEAR * length).min((1.0 - NEAR) * length);
    let falls = (most.at == 0.0 || most.at == length) && of(inward).stress < most.stress;
    if *q == Vector3::zeros() || falls {
        return most;
    }
    let step = length / PLACES as f64;
    let [mut low, mut high] = [(most.at - step).max(0.0), (most.at + step).min(length)];
    let part = 2.0 / (1.0 + 5.0_f64.sqrt());
    for _ in 0..STEPS {
        let [a, b] = [high - part * (high - low), low + part * (high - low)].map(of);
        if a.stress >= b.stress { high = b.at } else { low = a.at }
    }
    // A place that is known exactly is not given up for rounding.
    let found = of((low + high) / 2.0);
    if found.stress > most.stress * (1.0 + ROUNDING) { found } else { most }
}

/// The largest stress of each rod, in their order.
pub fn rod_peaks(model: &Model, load: &Load, response: &Response) -> Vec<RodPeak> {
    let mut rods: Vec<RodPeak> = Vec::new();
    let mut start = 0.0;
    for ((beam, q), ends) in model.beams.iter().zip(&load.beams).zip(&response.beams) {
        let along = model.along(beam);
        if rods.last().is_none_or(|r| r.rod != beam.rod) {
            start = 0.0;
            rods.push(RodPeak { rod: beam.rod, stress: -1.0, at: 0.0, utilisation: 0.0 });
        }
        let found = peak(beam, along.norm(), ends, &(beam::axes(&along) * q));
        if let Some(rod) = rods.last_mut().filter(|r| found.stress > r.stress) {
            rod.stress = found.stress;
            rod.at = start + found.at;
            rod.utilisation = found.stress / model.material.strength;
        }
        start += along.norm();
    }
    rods
}
