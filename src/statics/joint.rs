//! The stiffness of a contact: rigid arms from both axes to the point of touch, and springs
//! there. Forces between the rods act at the point of touch.

use super::beam::{Stiffness, Twelve};
use super::material::Material;
use super::model::{Joint, Springs};
use super::section::Section;
use crate::surface::Point3;
use nalgebra::{Matrix3, Matrix6, SMatrix, Vector6};
use serde::{Deserialize, Serialize};

/// How the rods of a contact hold each other. All kinds hold in every direction against
/// displacement, pushed or pulled; a contact that pulls must be tied, whatever it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    /// Rigid: no turn between the rods
    Nailed,
    /// The rods turn freely about the line through both axes, as scissors do; nothing else
    Tied,
    /// The flanks of the notch hold the angle; it rocks as what it leaves of a rod bends
    Notched,
}

impl Hold {
    /// `nailed`, `tied` or `notched`, as designs name it.
    pub fn code(self) -> &'static str {
        match self {
            Self::Nailed => "nailed",
            Self::Tied => "tied",
            Self::Notched => "notched",
        }
    }
}

/// How much stiffer what is rigid about a contact is than a piece of rod as long as it is
/// thick: EA/d against displacement, EI/d against turns.
pub const STIFFER: f64 = 1e3;

/// Second moment of area of a half circle about the axis through its centroid and along its
/// straight side, as part of r⁴: π/8 − 8/9π. A notch of half depth leaves it.
const HALF_CIRCLE: f64 = std::f64::consts::FRAC_PI_8 - 8.0 / (9.0 * std::f64::consts::PI);

/// The springs of a contact between rods, by the thinner section.
pub fn springs(hold: Hold, section: Section, material: &Material) -> Springs {
    let per = material.young / section.diameter;
    let (push, rigid) = (STIFFER * per * section.area(), STIFFER * per * section.inertia());
    // Notched rods bend where they are cut to half, over a length of one diameter.
    let notch = per * HALF_CIRCLE * (section.diameter / 2.0).powi(4);
    match hold {
        Hold::Nailed => Springs { push, twist: rigid, rock: rigid },
        Hold::Tied => Springs { push, twist: 0.0, rock: rigid },
        Hold::Notched => Springs { push, twist: rigid, rock: notch },
    }
}

/// From displacements of both nodes, over first, to how the arms' ends come apart: three
/// displacements, three rotations.
pub fn parting(joint: &Joint, nodes: &[Point3]) -> SMatrix<f64, 6, 12> {
    let mut a = SMatrix::<f64, 6, 12>::zeros();
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let arm = joint.touch - nodes[joint.nodes[side]];
        let mut part = Matrix6::identity();
        part.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
        a.fixed_view_mut::<6, 6>(0, 6 * side).copy_from(&(part * sign));
    }
    a
}

/// The springs as a matrix of six.
fn spring_matrix(joint: &Joint) -> Matrix6<f64> {
    let Springs { push, twist, rock } = joint.springs;
    let about = joint.axis * joint.axis.transpose();
    let turn = about * twist + (Matrix3::identity() - about) * rock;
    let mut d = Matrix6::zeros();
    d.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * push));
    d.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    d
}

/// The stiffness in the twelve freedoms of the two nodes.
pub fn stiffness(joint: &Joint, nodes: &[Point3]) -> Stiffness {
    let a = parting(joint, nodes);
    a.transpose() * spring_matrix(joint) * a
}

/// Force and moment in the springs: what the over rod does to the under rod at the point of
/// touch, as far as it comes from these displacements.
pub fn force(joint: &Joint, nodes: &[Point3], moved: &Twelve) -> Vector6<f64> {
    spring_matrix(joint) * (parting(joint, nodes) * moved)
}

/// What a force in the springs asks of the two nodes.
pub fn on_nodes(joint: &Joint, nodes: &[Point3], force: &Vector6<f64>) -> Twelve {
    parting(joint, nodes).transpose() * force
}

/// The pull between the rods of a joint along its axis, N, of the force in its springs;
/// negative where they are pressed together.
pub fn pull(joint: &Joint, force: &Vector6<f64>) -> f64 {
    force.fixed_rows::<3>(0).dot(&joint.axis)
}
