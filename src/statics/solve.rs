//! Displacements, reactions and the forces in beams and contacts: K u = f, by one sparse
//! Cholesky factorisation for all loads.

use super::beam::{self, Twelve};
use super::joint;
use super::load::Load;
use super::loose::{Loose, find_loose};
use super::model::{Beam, Foot, Joint, Model};
use super::system::{System, add_to, both};
use crate::linalg::LinalgError;
use crate::surface::Vector3;
use nalgebra::Vector6;
use thiserror::Error;

/// Why a model cannot be solved.
#[derive(Error, Debug, Clone, PartialEq)]
pub enum StaticsError {
    /// It is held too little.
    #[error(transparent)]
    Loose(#[from] Loose),
    /// The system could not be solved.
    #[error("the stiffness cannot be factored: {0}")]
    Linalg(#[from] LinalgError),
}

/// A model with its stiffness factored.
pub struct Solver<'a> {
    model: &'a Model,
    system: System,
}

/// How a model answers a load.
#[derive(Clone, Debug)]
pub struct Response {
    /// Displacement (mm) and rotation of each node.
    pub moved: Vec<Vector6<f64>>,
    /// What the ground does to each foot: force and moment.
    pub reactions: Vec<Vector6<f64>>,
    /// What the nodes do to each beam, in its own axes (see [`beam::axes`]).
    pub beams: Vec<Twelve>,
    /// What the over rod of each contact does to the under rod at their point of touch, force
    /// and moment: positive along the joint's axis where they are pulled apart.
    pub joints: Vec<Vector6<f64>>,
}

/// How often a solution is refined at most. The first solution has lost the digits by which
/// contacts are stiffer than rods, and those that a soft frame costs; each round wins some back.
const ROUNDS: usize = 12;
/// A correction smaller than this part of the displacements is not worth a round.
const SMALL: f64 = 1e-13;
/// Corrections that shrink by less than this factor win nothing back any more.
const SHRINK: f64 = 0.5;

/// Displacements, and the forces in the springs of the contacts, which cannot be had from
/// them without loss: in a stiff spring they come of a small difference.
struct Solution {
    moved: Vec<f64>,
    joints: Vec<Vector6<f64>>,
}

impl<'a> Solver<'a> {
    /// Assembles and factors a model.
    ///
    /// # Errors
    /// [`StaticsError::Loose`] when rods can move freely.
    pub fn new(model: &'a Model) -> Result<Self, StaticsError> {
        let mut system = System::new(model)?;
        match find_loose(model, &mut system)? {
            Some(loose) => Err(loose.into()),
            None => Ok(Self { model, system }),
        }
    }

    /// The answer to a load.
    pub fn solve(&mut self, load: &Load) -> Response {
        let model = self.model;
        let given = self.given(load);
        let mut found = Solution {
            moved: vec![0.0; given.len()],
            joints: vec![Vector6::zeros(); model.joints.len()],
        };
        // The first correction is the solution itself.
        let mut last = self.refine(&given, &mut found);
        for _ in 1..ROUNDS {
            let correction = self.refine(&given, &mut found);
            // The next one will be smaller than this one by as much as this one is.
            if correction.powi(2) <= SMALL * last || correction > SHRINK * last {
                break;
            }
            last = correction;
        }
        self.response(&found, &given, load)
    }

    /// One round: with u and the forces λ of the springs D, and what of both is missing,
    /// B δ + Aᵀμ = f − B u − Aᵀλ and D A δ − μ = λ − D A u, of which μ is eliminated. Returns the
    /// largest correction as part of the largest displacement or rotation.
    fn refine(&mut self, given: &[f64], found: &mut Solution) -> f64 {
        let model = self.model;
        let nodes = &model.nodes;
        let mut rest = given.to_vec();
        self.inner(found).iter().zip(&mut rest).for_each(|(inner, rest)| *rest -= inner);
        let missing = |(joint, force): (&Joint, &Vector6<f64>)| {
            force - joint::force(joint, nodes, &both(&found.moved, joint.nodes))
        };
        let missing: Vec<Vector6<f64>> =
            model.joints.iter().zip(&found.joints).map(missing).collect();
        for (joint, missing) in model.joints.iter().zip(&missing) {
            add_to(&mut rest, joint.nodes, &joint::on_nodes(joint, nodes, missing));
        }
        self.system.solve(&mut rest);
        for ((joint, force), missing) in model.joints.iter().zip(&mut found.joints).zip(missing) {
            *force += joint::force(joint, nodes, &both(&rest, joint.nodes)) - missing;
        }
        found.moved.iter_mut().zip(&rest).for_each(|(u, more)| *u += more);
        let largest = |of: &[f64]| of.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        match largest(&found.moved) {
            0.0 => 0.0,
            size => largest(&rest) / size,
        }
    }

    /// Forces on the nodes, those of even loads on beams among them.
    fn given(&self, load: &Load) -> Vec<f64> {
        let mut given: Vec<f64> = load.nodes.iter().flat_map(|six| six.iter().copied()).collect();
        for (beam, q) in self.model.beams.iter().zip(&load.beams) {
            add_to(&mut given, beam.nodes, &beam::even_load(&self.model.along(beam), q));
        }
        given
    }

    /// What beams and joints ask of the nodes.
    fn inner(&self, found: &Solution) -> Vec<f64> {
        let mut inner = vec![0.0; found.moved.len()];
        for (nodes, k) in &self.system.beams {
            add_to(&mut inner, *nodes, &(k * both(&found.moved, *nodes)));
        }
        for (joint, force) in self.model.joints.iter().zip(&found.joints) {
            add_to(&mut inner, joint.nodes, &joint::on_nodes(joint, &self.model.nodes, force));
        }
        inner
    }

    fn response(&self, found: &Solution, given: &[f64], load: &Load) -> Response {
        let model = self.model;
        let inner = self.inner(found);
        let reaction = |foot: &Foot| {
            let all = |i: usize| inner[6 * foot.node + i] - given[6 * foot.node + i];
            Vector6::from_fn(|i, _| if foot.held[i] { all(i) } else { 0.0 })
        };
        let in_beam = |(b, q): (&Beam, &Vector3)| {
            let along = model.along(b);
            let k = beam::local_stiffness(along.norm(), b.section, &model.material);
            let axes = beam::axes(&along);
            let own = beam::to_local(&axes, &both(&found.moved, b.nodes));
            k * own - beam::to_local(&axes, &beam::even_load(&along, q))
        };
        Response {
            moved: found.moved.chunks_exact(6).map(Vector6::from_column_slice).collect(),
            reactions: model.feet.iter().map(reaction).collect(),
            beams: model.beams.iter().zip(&load.beams).map(in_beam).collect(),
            joints: found.joints.clone(),
        }
    }
}
