//! What a deck for CalculiX is made of: beams cut to elements, contacts and feet as stiff
//! arms, springs and equations.
//!
//! CalculiX makes a solid of each beam. Turns of its nodes can neither be printed nor tied by
//! equations without error, so that all that holds rods together speaks of displacements:
//! stiff arms stand out from a node, and how far their tips come apart from it is how it turns.

use crate::statics::beam::axes;
use crate::statics::joint::STIFFER;
use crate::statics::model::{Foot, Joint, Model};
use crate::statics::section::Section;
use crate::surface::{Point3, Vector3};

/// Elements in a piece of a rod. With 4, displacements of frames change by less than 1 % when
/// there are more.
pub const ELEMENTS: usize = 4;

/// Nodes nearer together than this part of a diameter lie in one place.
const ONE_PLACE: f64 = 1e-6;

/// Directions less than this part of their arm are left out of equations.
const NOTHING: f64 = 1e-12;

/// All parts. Nodes have numbers from 1: those of the model come first.
pub struct Parts {
    pub nodes: Vec<Point3>,
    /// The nodes of each beam of the model, `2 ELEMENTS + 1` from its first to its second.
    pub beams: Vec<Vec<usize>>,
    pub arms: Vec<Arm>,
    pub springs: Vec<Spring>,
    pub equations: Vec<Equation>,
    /// Node and freedom, 1 to 3.
    pub held: Vec<(usize, usize)>,
    /// What stands for the ground under each foot, against displacement and against turns.
    pub ground: Vec<[Option<usize>; 2]>,
    /// Numbers of arms and of springs of each contact: from, to.
    pub contacts: Vec<[(usize, usize); 2]>,
}

/// A stiff beam.
pub struct Arm {
    pub nodes: [usize; 3],
    pub diameter: f64,
    /// A direction across it.
    pub across: Vector3,
}

/// A spring in one freedom of a node, to the ground or to another node.
pub struct Spring {
    pub node: usize,
    pub other: Option<usize>,
    pub freedom: usize,
    pub stiffness: f64,
}

/// The first term is what the others add up to.
pub struct Equation {
    pub terms: Vec<(usize, usize, f64)>,
}

/// A node of a rod with the tips of its arms, as far as it has them.
struct Side {
    node: usize,
    /// 1 on the over rod, −1 on the under rod.
    sign: f64,
    /// Along the axis of the contact, towards the other rod: with its sense.
    axial: (usize, f64),
    /// Across both rods.
    lateral: Option<usize>,
}

impl Parts {
    /// The parts of a model.
    pub fn new(model: &Model) -> Self {
        let mut parts = Self {
            nodes: model.nodes.clone(),
            beams: Vec::new(),
            arms: Vec::new(),
            springs: Vec::new(),
            equations: Vec::new(),
            held: Vec::new(),
            ground: Vec::new(),
            contacts: Vec::new(),
        };
        for beam in &model.beams {
            parts.cut(model, beam.nodes);
        }
        for joint in &model.joints {
            let before = [parts.arms.len(), parts.springs.len()];
            parts.join(model, joint);
            let after = [parts.arms.len(), parts.springs.len()];
            parts.contacts.push([(before[0], after[0]), (before[1], after[1])]);
        }
        for foot in &model.feet {
            parts.stand(model, foot);
        }
        parts
    }

    fn node(&mut self, place: Point3) -> usize {
        self.nodes.push(place);
        self.nodes.len()
    }

    fn cut(&mut self, model: &Model, [first, second]: [usize; 2]) {
        let (a, b) = (model.nodes[first], model.nodes[second]);
        let mut nodes = vec![first + 1];
        for i in 1..2 * ELEMENTS {
            let part = i as f64 / (2 * ELEMENTS) as f64;
            nodes.push(self.node(a + (b - a) * part));
        }
        nodes.push(second + 1);
        self.beams.push(nodes);
    }

    /// A stiff arm from a node; its tip.
    fn arm(&mut self, node: usize, reach: Vector3, diameter: f64, across: Vector3) -> usize {
        let from = self.nodes[node - 1];
        let middle = self.node(from + reach / 2.0);
        let tip = self.node(from + reach);
        self.arms.push(Arm { nodes: [node, middle, tip], diameter, across });
        tip
    }

    /// Nodes of their own hold how far the rods come apart and turn against each other, and
    /// springs hold these nodes.
    fn join(&mut self, model: &Model, joint: &Joint) {
        let [over, under] = joint.nodes;
        let [first, second] = joint.nodes.map(|n| rod_at(model, n));
        let thin = first.1.min(second.1);
        let gap = (model.nodes[over] - model.nodes[under]).norm();
        let ends = gap < ONE_PLACE * thin;
        let reach = if ends { thin } else { gap };
        let axis = joint.axis;
        let along = if first.0.dot(&second.0) < 0.0 { -second.0 } else { second.0 };
        let lateral = axis.cross(&(first.0 + along)).try_normalize(NOTHING);
        let lateral = lateral.unwrap_or_else(|| axes(&axis).row(1).transpose());
        let between = lateral.cross(&axis);
        let springs = joint.springs;
        let sides = [(over, 1.0), (under, -1.0)].map(|(node, sign)| {
            let node = node + 1;
            let tip = self.arm(node, -axis * sign * reach, thin, lateral);
            let more = springs.twist > 0.0;
            let more = more.then(|| self.arm(node, lateral * reach, thin, axis));
            Side { node, sign, axial: (tip, -sign), lateral: more }
        });
        let apart = self.node(joint.touch);
        let turned = self.node(joint.touch);
        for freedom in 1..=3 {
            let terms = sides.iter().flat_map(|s| at_touch(s, freedom, ends)).collect();
            self.sum(apart, freedom, terms, springs.push, None);
        }
        // A turn θ moves the tips by θ × axis and θ × lateral.
        for (freedom, direction) in [(1, lateral), (2, between)] {
            let tip = |s: &Side| tip_moved(s, s.axial.0, direction * (s.sign * s.axial.1 / reach));
            let terms = sides.iter().flat_map(tip).collect();
            self.sum(turned, freedom, terms, springs.rock, None);
        }
        if springs.twist > 0.0 {
            let tip =
                |s: &Side| tip_moved(s, s.lateral.unwrap_or(s.node), between * (-s.sign / reach));
            let terms = sides.iter().flat_map(tip).collect();
            self.sum(turned, 3, terms, springs.twist, None);
        } else {
            self.held.push((turned, 3));
        }
    }

    /// A freedom that is the sum of terms, and a spring that holds it.
    fn sum(
        &mut self,
        node: usize,
        freedom: usize,
        mut terms: Vec<(usize, usize, f64)>,
        stiffness: f64,
        other: Option<usize>,
    ) {
        terms.insert(0, (node, freedom, -1.0));
        self.equations.push(Equation { terms });
        self.springs.push(Spring { node, other, freedom, stiffness });
    }

    /// As a contact with the ground: what the ground does is the force in its springs.
    fn stand(&mut self, model: &Model, foot: &Foot) {
        let node = foot.node + 1;
        let place = model.nodes[foot.node];
        let (_, diameter) = rod_at(model, foot.node);
        let section = Section { diameter };
        let per = STIFFER * model.material.young / diameter;
        let (moved, ground) = (self.node(place), self.node(place));
        for freedom in 1..=3 {
            self.held.push((ground, freedom));
            if foot.held[freedom - 1] {
                let terms = vec![(node, freedom, 1.0)];
                self.sum(moved, freedom, terms, per * section.area(), Some(ground));
            } else {
                self.held.push((moved, freedom));
            }
        }
        let mut both = [Some(ground), None];
        if foot.held[3..].contains(&true) {
            let (turned, ground) = (self.node(place), self.node(place));
            let up = self.arm(node, Vector3::z() * diameter, diameter, Vector3::x());
            let aside = self.arm(node, Vector3::x() * diameter, diameter, Vector3::z());
            // θ × z = (θy, −θx, 0), and θ × x = (0, θz, −θy).
            let turns = [(1, up, 2, -1.0), (2, up, 1, 1.0), (3, aside, 2, 1.0)];
            for (freedom, tip, moves, sign) in turns {
                self.held.push((ground, freedom));
                let part = sign / diameter;
                let terms = vec![(tip, moves, part), (node, moves, -part)];
                self.sum(turned, freedom, terms, per * section.inertia(), Some(ground));
            }
            both[1] = Some(ground);
        }
        self.ground.push(both);
    }
}

/// Direction and diameter of the rod at a node.
fn rod_at(model: &Model, node: usize) -> (Vector3, f64) {
    let beam = model.beams.iter().find(|b| b.nodes.contains(&node));
    let of = |b: &crate::statics::model::Beam| (model.along(b).normalize(), b.section.diameter);
    beam.map_or((Vector3::z(), 1.0), of)
}

/// How far a rod moves at the point of touch: half-way along its arm, or where the node is.
fn at_touch(side: &Side, freedom: usize, ends: bool) -> Vec<(usize, usize, f64)> {
    if ends {
        return vec![(side.node, freedom, side.sign)];
    }
    [side.node, side.axial.0].map(|n| (n, freedom, side.sign / 2.0)).to_vec()
}

/// How far a tip moves in a direction, seen from its node.
fn tip_moved(side: &Side, tip: usize, direction: Vector3) -> Vec<(usize, usize, f64)> {
    let size = direction.norm();
    let some = (0..3).filter(|&i| direction[i].abs() > NOTHING * size);
    some.flat_map(|i| [(tip, i + 1, direction[i]), (side.node, i + 1, -direction[i])]).collect()
}
