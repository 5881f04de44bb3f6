//! Rods as beams between nodes, contacts as joints between two nodes, feet.

use super::material::Material;
use super::section::Section;
use crate::ids::{ContactId, RodId};
use crate::surface::{Point3, Vector3};

/// A framework of beams. Lengths in mm, forces in N; a node has six freedoms: three
/// displacements, then three rotations, about x, y, z.
#[derive(Clone, Debug)]
pub struct Model {
    /// Where the nodes are.
    pub nodes: Vec<Point3>,
    /// The pieces of the rods, rod by rod, each from its end A to its end B.
    pub beams: Vec<Beam>,
    /// The contacts.
    pub joints: Vec<Joint>,
    /// The feet.
    pub feet: Vec<Foot>,
    /// What all rods are made of.
    pub material: Material,
}

/// A piece of a rod between two nodes. A rod that tapers has pieces of even thickness,
/// each as thick as the rod is in the piece's middle.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// The rod.
    pub rod: RodId,
    /// Its nodes, that nearer to end A first.
    pub nodes: [usize; 2],
    /// Its section.
    pub section: Section,
}

/// Two rods that touch: each node has a rigid arm to the point of touch, and springs hold
/// the ends of the arms together there.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// The contact.
    pub contact: ContactId,
    /// Nodes on the over and on the under rod.
    pub nodes: [usize; 2],
    /// The point of touch: half-way between the axes.
    pub touch: Point3,
    /// From the under rod to the over rod, a unit vector.
    pub axis: Vector3,
    /// Its springs.
    pub springs: Springs,
}

/// The springs of a joint.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Springs {
    /// Against displacement, the same in all directions, N/mm.
    pub push: f64,
    /// Against turns about the joint's axis, N mm; 0 where they are free.
    pub twist: f64,
    /// Against turns about the directions across, N mm.
    pub rock: f64,
}

/// A node that is held.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Foot {
    /// The rod that stands there.
    pub rod: RodId,
    /// The node.
    pub node: usize,
    /// Which of its freedoms are held.
    pub held: [bool; 6],
}

impl Model {
    /// From the first node of a beam to the second.
    pub fn along(&self, beam: &Beam) -> Vector3 {
        self.nodes[beam.nodes[1]] - self.nodes[beam.nodes[0]]
    }

    /// How far a node of a rod lies from the first node of it.
    pub fn from_end_a(&self, rod: RodId, node: usize) -> f64 {
        let first = self.beams.iter().find(|b| b.rod == rod).map_or(node, |b| b.nodes[0]);
        (self.nodes[node] - self.nodes[first]).norm()
    }
}
