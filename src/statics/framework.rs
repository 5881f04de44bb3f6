//! A frame as a model: rods cut at their contacts, contacts as joints, feet on the ground.

use super::joint::{self, Hold};
use super::material::Material;
use super::model::{Beam, Foot, Joint, Model};
use super::section::Section;
use crate::frame::{ContactKind, End, Frame};
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::Point3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Nodes of a rod nearer together than this part of its diameter are one: a shorter piece
/// would be stiff beyond measure. The arms of joints make up for it.
const TOGETHER: f64 = 0.01;

/// How feet are held.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Feet {
    /// They stay in place and turn freely
    Pinned,
    /// They stay in place and do not turn
    Fixed,
    /// They slide on the ground and turn freely
    Sliding,
}

impl Feet {
    /// `pinned`, `fixed` or `sliding`, as designs name it.
    pub fn code(self) -> &'static str {
        match self {
            Self::Pinned => "pinned",
            Self::Fixed => "fixed",
            Self::Sliding => "sliding",
        }
    }

    fn held(self) -> [bool; 6] {
        match self {
            Self::Pinned => [true, true, true, false, false, false],
            Self::Fixed => [true; 6],
            Self::Sliding => [false, false, true, false, false, false],
        }
    }
}

/// What a frame is taken for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Assumptions {
    /// What the rods are made of.
    pub material: Material,
    /// How contacts hold.
    pub hold: Hold,
    /// How feet are held.
    pub feet: Feet,
    /// All lengths, diameters too, are taken this many times as large.
    pub scale: f64,
}

/// A model, and where the places of the frame lie in it.
#[derive(Clone, Debug)]
pub struct Framework {
    /// The model.
    pub model: Model,
    /// The nodes of each rod with their distances from end A, mm at the model's scale.
    pub rods: IdVec<RodId, Vec<(f64, usize)>>,
}

impl Framework {
    /// Cuts the rods at contacts and at `places`, where loads act: rod and distance from end
    /// A in mm of the frame, which must lie on the rod.
    pub fn new(frame: &Frame, taken: &Assumptions, places: &[(RodId, f64)]) -> Self {
        let mut model = Model {
            nodes: Vec::new(),
            beams: Vec::new(),
            joints: Vec::new(),
            feet: Vec::new(),
            material: taken.material,
        };
        let mut extra: BTreeMap<RodId, Vec<f64>> = BTreeMap::new();
        for &(rod, at) in places {
            extra.entry(rod).or_default().push(at);
        }
        let mut rods: IdVec<RodId, Vec<(f64, usize)>> = IdVec::new();
        for id in frame.rods.ids() {
            let more = extra.get(&id).map_or(&[][..], Vec::as_slice);
            rods.push(cut_rod(&mut model, frame, id, taken.scale, more));
        }
        let mut framework = Self { model, rods };
        for id in frame.contacts.ids() {
            let joint = framework.joint(frame, taken, id);
            framework.model.joints.push(joint);
        }
        for support in &frame.supports {
            let at = frame.rods[support.rod].axis.place_of(support.end) * taken.scale;
            framework.stand(taken.feet, support.rod, at);
        }
        framework
    }

    /// Puts a foot under a rod, at the node nearest to a distance from its end A, mm at the
    /// model's scale.
    pub fn stand(&mut self, feet: Feet, rod: RodId, at: f64) {
        let node = self.node(rod, at);
        self.model.feet.push(Foot { rod, node, held: feet.held() });
    }

    /// The node of a rod nearest to a distance from its end A, mm at the model's scale.
    pub fn node(&self, rod: RodId, at: f64) -> usize {
        let off = |n: &&(f64, usize)| (n.0 - at).abs();
        let nodes = self.rods[rod].iter();
        nodes.min_by(|p, q| off(p).total_cmp(&off(q))).map_or(0, |n| n.1)
    }

    fn joint(&self, frame: &Frame, taken: &Assumptions, id: ContactId) -> Joint {
        let c = &frame.contacts[id];
        let [over, under] = [(c.over, c.at_over), (c.under, c.at_under)].map(|(rod, at)| {
            let place = frame.met_end(id, rod).map(|end| frame.rods[rod].axis.place_of(end));
            self.node(rod, place.unwrap_or(at) * taken.scale)
        });
        let nodes = &self.model.nodes;
        let across = match c.kind {
            ContactKind::Cross => nodes[over] - nodes[under],
            // Ends that meet lie in one place: the surface tells the axis.
            ContactKind::End(_) => c.normal,
        };
        let axis = across.try_normalize(f64::MIN_POSITIVE).unwrap_or(c.normal);
        let thin = |rod: RodId, at: f64| frame.rods[rod].diameter_at(at);
        let diameter = thin(c.over, c.at_over).min(thin(c.under, c.at_under)) * taken.scale;
        let springs = joint::springs(taken.hold, Section { diameter }, &taken.material);
        let touch = nalgebra::center(&nodes[over], &nodes[under]);
        Joint { contact: id, nodes: [over, under], touch, axis, springs }
    }
}

/// Adds the nodes and pieces of a rod; its nodes by distance from end A.
fn cut_rod(
    model: &mut Model,
    frame: &Frame,
    id: RodId,
    scale: f64,
    more: &[f64],
) -> Vec<(f64, usize)> {
    let rod = &frame.rods[id];
    let length = rod.axis.length();
    let touch = rod.contacts.iter().filter(|&&c| frame.met_end(c, id).is_none());
    let mut places: Vec<f64> = touch.map(|&c| frame.seen_from(c, id).at).collect();
    places.extend(more);
    // Each end keeps its place, and what is near it falls to it.
    let near = TOGETHER * rod.thickest().min(length);
    places.retain(|s| (near..length - near).contains(s));
    places.sort_by(f64::total_cmp);
    places.dedup_by(|next, kept| *next - *kept < near);
    places.insert(0, rod.axis.place_of(End::A));
    places.push(rod.axis.place_of(End::B));
    let first = model.nodes.len();
    for &s in &places {
        model.nodes.push(Point3::from(rod.axis.at(s).coords * scale));
    }
    for (i, pair) in places.windows(2).enumerate() {
        let middle = (pair[0] + pair[1]) / 2.0;
        let section = Section { diameter: rod.diameter_at(middle) * scale };
        model.beams.push(Beam { rod: id, nodes: [first + i, first + i + 1], section });
    }
    places.iter().enumerate().map(|(i, s)| (s * scale, first + i)).collect()
}
