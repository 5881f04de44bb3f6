//! A frame under loads: what is taken, what comes of it.

use super::framework::{Assumptions, Framework};
use super::joint;
use super::load::Load;
use super::model::Model;
use super::solve::{Response, Solver, StaticsError};
use super::stress::{RodPeak, rod_peaks};
use crate::frame::Frame;
use crate::ids::{ContactId, RodId};
use crate::surface::Vector3;

/// A force on a rod.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PointLoad {
    /// The rod.
    pub rod: RodId,
    /// From its end A, mm of the frame.
    pub at: f64,
    /// N.
    pub force: Vector3,
}

/// A sum of loads with a name, each kind times a factor.
#[derive(Clone, PartialEq, Debug)]
pub struct Combination {
    /// What it is called.
    pub name: String,
    /// Factor of the weight of the rods.
    pub weight: f64,
    /// Factor of the area load.
    pub area: f64,
    /// Factor of the point loads.
    pub points: f64,
}

/// What is asked.
#[derive(Clone, PartialEq, Debug)]
pub struct Question {
    /// What the frame is taken for.
    pub taken: Assumptions,
    /// What its material is called.
    pub material: String,
    /// Forces on rods.
    pub points: Vec<PointLoad>,
    /// Vertical load on the area in plan, MPa.
    pub pressure: f64,
    /// The cases to be solved.
    pub combinations: Vec<Combination>,
    /// Whether feet are added until it stands.
    pub add_feet: bool,
}

/// The answer.
#[derive(Clone, Debug)]
pub struct Study {
    /// What was asked.
    pub question: Question,
    /// The frame as beams.
    pub framework: Framework,
    /// How many of its feet are the frame's own; the others were added until it stood.
    pub own_feet: usize,
    /// The cases, in the order of the combinations.
    pub cases: Vec<Case>,
}

/// A combination of loads and what it does.
#[derive(Clone, Debug)]
pub struct Case {
    /// The combination.
    pub combination: Combination,
    /// All loads together.
    pub load: Load,
    /// Displacements and forces.
    pub response: Response,
    /// The largest stress of each rod, in their order.
    pub rods: Vec<RodPeak>,
}

/// The most feet that are added.
const MOST_FEET: usize = 64;

/// Solves a frame under loads.
///
/// # Errors
/// [`StaticsError`] when it does not stand, or is too large to be solved.
pub fn study(frame: &Frame, question: Question) -> Result<Study, StaticsError> {
    let places: Vec<(RodId, f64)> = question.points.iter().map(|p| (p.rod, p.at)).collect();
    let mut framework = Framework::new(frame, &question.taken, &places);
    let own_feet = framework.model.feet.len();
    if question.add_feet {
        add_feet(&mut framework, &question.taken)?;
    }
    let cases = {
        let model = &framework.model;
        let mut solver = Solver::new(model)?;
        let weight = Load::weight(model);
        let area = Load::area(model, question.pressure);
        let points = on_points(&framework, &question);
        let case = |combination: &Combination| {
            let mut load = Load::none(model);
            load.add(combination.weight, &weight);
            load.add(combination.area, &area);
            load.add(combination.points, &points);
            let response = solver.solve(&load);
            let rods = rod_peaks(model, &load, &response);
            Case { combination: combination.clone(), load, response, rods }
        };
        question.combinations.iter().map(case).collect()
    };
    Ok(Study { question, framework, own_feet, cases })
}

/// Adds a foot where most moves until nothing moves freely.
fn add_feet(framework: &mut Framework, taken: &Assumptions) -> Result<(), StaticsError> {
    for added in 0.. {
        match Solver::new(&framework.model).map(drop) {
            Err(StaticsError::Loose(loose)) if added < MOST_FEET => {
                framework.stand(taken.feet, loose.most, loose.at);
            }
            end => return end,
        }
    }
    Ok(())
}

fn on_points(framework: &Framework, question: &Question) -> Load {
    let mut load = Load::none(&framework.model);
    for point in &question.points {
        let node = framework.node(point.rod, point.at * question.taken.scale);
        let mut force = load.nodes[node].fixed_rows_mut::<3>(0);
        force += point.force;
    }
    load
}

/// The largest of something over the rods or nodes of a study.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Largest {
    /// The case.
    pub case: usize,
    /// The rod.
    pub rod: RodId,
    /// From its end A, mm at the model's scale.
    pub at: f64,
    /// How much.
    pub value: f64,
}

impl Study {
    /// The model of the frame.
    pub fn model(&self) -> &Model {
        &self.framework.model
    }

    /// The largest utilisation of each rod in a case.
    pub fn stresses(&self, case: usize) -> Vec<Largest> {
        let of = |p: &RodPeak| Largest { case, rod: p.rod, at: p.at, value: p.utilisation };
        self.cases[case].rods.iter().map(of).collect()
    }

    /// The largest displacement of each rod in a case, at its nodes, mm.
    pub fn moves(&self, case: usize) -> Vec<Largest> {
        let moved = &self.cases[case].response.moved;
        let of = |(rod, nodes): (RodId, &Vec<(f64, usize)>)| {
            let at_node = |&(at, node): &(f64, usize)| Largest {
                case,
                rod,
                at,
                value: moved[node].fixed_rows::<3>(0).norm(),
            };
            nodes.iter().map(at_node).reduce(Largest::larger)
        };
        self.framework.rods.enumerate().filter_map(of).collect()
    }

    /// For each rod the case and place of its largest utilisation.
    pub fn worst(&self) -> Vec<Largest> {
        self.over_cases(Self::stresses)
    }

    /// For each rod the case and place of its largest displacement, mm.
    pub fn displacements(&self) -> Vec<Largest> {
        self.over_cases(Self::moves)
    }

    /// The larger one of each rod, of all cases.
    fn over_cases(&self, of: impl Fn(&Self, usize) -> Vec<Largest>) -> Vec<Largest> {
        let cases = (0..self.cases.len()).map(|case| of(self, case));
        let larger = |a: Vec<Largest>, b: Vec<Largest>| {
            a.into_iter().zip(b).map(|(a, b)| a.larger(b)).collect()
        };
        cases.reduce(larger).unwrap_or_default()
    }

    /// The contacts that pull in some case, with the largest pull of each, N.
    pub fn pulls(&self) -> Vec<(ContactId, f64)> {
        let most = |(i, joint): (usize, &super::model::Joint)| {
            let pulls = self.cases.iter().map(|c| joint::pull(joint, &c.response.joints[i]));
            pulls.reduce(f64::max).map(|pull| (joint.contact, pull))
        };
        let all = self.model().joints.iter().enumerate().filter_map(most);
        all.filter(|(_, pull)| *pull > self.slight()).collect()
    }

    /// The contacts that pull, the strongest first.
    pub fn strongest_pulls(&self) -> Vec<(ContactId, f64)> {
        let mut pulls = self.pulls();
        pulls.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        pulls
    }

    /// Forces below this are rounding: a part of the largest force in a contact.
    fn slight(&self) -> f64 {
        let joints = self.cases.iter().flat_map(|c| &c.response.joints);
        SLIGHT * joints.map(|f| f.fixed_rows::<3>(0).norm()).fold(0.0, f64::max)
    }
}

/// See [`Study::slight`].
const SLIGHT: f64 = 1e-9;

impl Largest {
    /// The largest of some, if there are any.
    pub fn of(some: Vec<Self>) -> Option<Self> {
        some.into_iter().reduce(Self::larger)
    }

    /// The larger of two; of two alike the first.
    pub fn larger(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
}

impl Case {
    /// Loads and reactions together, which is what equilibrium lacks, as part of all loads.
    pub fn unbalanced(&self, model: &Model) -> f64 {
        let reactions = self.response.reactions.iter();
        let held: Vector3 = reactions.map(|r| Vector3::new(r[0], r[1], r[2])).sum();
        let total = self.load.total(model);
        let size = total.norm();
        if size > 0.0 { (total + held).norm() / size } else { held.norm() }
    }
}
