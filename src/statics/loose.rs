//! What moves freely in a model that is held too little.
//!
//! The mode of least stiffness is sought by inverse iteration on K + σD, where D is the
//! diagonal of K without the contacts; its Rayleigh quotient xᵀKx / xᵀDx tells a
//! mechanism (rounding only) from a soft structure.

use super::joint;
use super::model::Model;
use super::start::start;
use super::system::{System, add_to, both};
use crate::ids::{Id, RodId};
use crate::linalg::LinalgError;
use crate::surface::Vector3;
use std::collections::BTreeMap;
use thiserror::Error;

/// σ: smaller and the shifted matrix may not factor, larger and more steps are needed.
const SHIFT: f64 = 1e-10;
/// Steps of inverse iteration at most.
const STEPS: usize = 20;
/// A quotient has settled when it falls by less than this factor: it is the order of magnitude
/// that counts, and what is free is there at once.
const SETTLED: f64 = 0.5;
/// The quotient below which a mode counts as free, or nearly so: of displacements in a softer
/// structure rounding would leave less than three digits.
const FREE: f64 = 1e-13;
/// What rounding leaves of the quotient of a free mode.
const ROUNDING: f64 = 1e-14;
/// A rod is named when it moves by this share of the largest movement.
const MOVES: f64 = 0.5;
/// How many rods a message names.
const NAMED: usize = 8;

/// Rods that move freely.
#[derive(Error, Debug, Clone, PartialEq)]
#[error(
    "too few supports: {} can move {}freely, {} most: {:.0} mm from its end A it goes {}, and a foot \
     there would help",
    named(.rods), if *.nearly { "almost " } else { "" }, .most, .at, direction(.way)
)]
pub struct Loose {
    /// The rods that move most, in the order of their numbers.
    pub rods: Vec<RodId>,
    /// The one that moves most of all, where a foot would help most.
    pub most: RodId,
    /// How far from its end A, mm at the model's scale.
    pub at: f64,
    /// Which way it moves there, a unit vector; either way round.
    pub way: Vector3,
    /// Whether it is not quite free.
    pub nearly: bool,
}

/// A direction, either way round, in words of the ground and as a vector.
fn direction(way: &Vector3) -> String {
    let word = if way.z.abs() > UPRIGHT { "up and down" } else { "sideways" };
    let [x, y, z] = [way.x, way.y, way.z].map(|c| if c.abs() < 0.005 { 0.0 } else { c });
    format!("{word}, along ({x:.2}, {y:.2}, {z:.2})")
}

/// Directions that rise more than this go up and down.
const UPRIGHT: f64 = 0.7;

fn named(rods: &[RodId]) -> String {
    let names: Vec<String> = rods.iter().take(NAMED).map(RodId::to_string).collect();
    match rods.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

/// Factors a model's system, and looks for a free mode in it. Without one, the system stays
/// factored.
///
/// # Errors
/// [`LinalgError`] where it is out of bounds.
pub fn find_loose(model: &Model, system: &mut System) -> Result<Option<Loose>, LinalgError> {
    let diagonal = diagonal(system);
    // What is loose may be factored all the same, through rounding: the mode tells.
    let shift = match system.factor(|_| 0.0) {
        Ok(()) => 0.0,
        Err(LinalgError::NotPositiveDefinite { .. }) => SHIFT,
        Err(e) => return Err(e),
    };
    if shift > 0.0 {
        system.factor(|i| shift * diagonal[i])?;
    }
    let mode = lowest_mode(&diagonal, system);
    let energy = energy(model, system, &mode);
    let loose = energy < FREE || shift > 0.0;
    Ok(loose.then(|| movers(model, &mode, energy > ROUNDING)))
}

/// The diagonal of the stiffness of the beams alone.
fn diagonal(system: &System) -> Vec<f64> {
    let mut diagonal = vec![0.0; 6 * system.held.len()];
    for (nodes, k) in &system.beams {
        add_to(&mut diagonal, *nodes, &k.diagonal());
    }
    diagonal
}

/// The mode of least stiffness that inverse iteration finds with the system as it is
/// factored; of unit length by D. It is found when the quotient, which falls from step to step,
/// hardly does so any more.
fn lowest_mode(diagonal: &[f64], system: &mut System) -> Vec<f64> {
    let mut mode = start(diagonal.len());
    mode.iter_mut().zip(diagonal).for_each(|(x, d)| *x /= d.sqrt());
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let force: Vec<f64> = mode.iter().zip(diagonal).map(|(x, d)| x * d).collect();
        mode.copy_from_slice(&force);
        system.solve(&mut mode);
        let work: f64 = mode.iter().zip(&force).map(|(x, f)| x * f).sum();
        let square: f64 = mode.iter().zip(diagonal).map(|(x, d)| d * x * x).sum();
        if square == 0.0 {
            break;
        }
        mode.iter_mut().for_each(|x| *x /= square.sqrt());
        let quotient = (work / square).abs();
        if quotient > SETTLED * last {
            break;
        }
        last = quotient;
    }
    mode
}

/// The energy of a mode, each joint's by how far it comes apart: its stiffness as a matrix
/// has rounding errors as large as what is sought.
fn energy(model: &Model, system: &System, mode: &[f64]) -> f64 {
    let beams = system.beams.iter().map(|(nodes, k)| {
        let x = both(mode, *nodes);
        x.dot(&(k * x))
    });
    let joints = model.joints.iter().map(|j| {
        let x = both(mode, j.nodes);
        (joint::parting(j, &model.nodes) * x).dot(&joint::force(j, &model.nodes, &x))
    });
    beams.chain(joints).sum()
}

/// The rods that move in a mode: by displacement, or by a turn at their skin.
fn movers(model: &Model, mode: &[f64], nearly: bool) -> Loose {
    let mut rods: BTreeMap<RodId, f64> = BTreeMap::new();
    let mut most = (0.0, RodId::new(0), 0, Vector3::z());
    for beam in &model.beams {
        for node in beam.nodes {
            let [shift, turn] =
                [0, 3].map(|i| Vector3::from_column_slice(&mode[6 * node + i..6 * node + i + 3]));
            let skin = turn * (beam.section.diameter / 2.0);
            let size = shift.norm() + skin.norm();
            let known = rods.entry(beam.rod).or_default();
            *known = known.max(size);
            if size > most.0 {
                let way = if shift.norm() > skin.norm() { shift } else { skin };
                most = (size, beam.rod, node, way.normalize());
            }
        }
    }
    let (size, rod, node, way) = most;
    let moving = rods.iter().filter(|r| *r.1 >= MOVES * size).map(|r| *r.0).collect();
    // Of both ways round, that which goes up, or along the first axis that it has a share of.
    let sign = [way.z, way.y, way.x].into_iter().find(|c| c.abs() > 0.005).unwrap_or(1.0);
    let way = way * sign.signum();
    Loose { rods: moving, most: rod, at: model.from_end_a(rod, node), way, nearly }
}
