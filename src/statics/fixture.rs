//! Frames under loads for tests.

use super::framework::{Assumptions, Feet};
use super::joint::Hold;
use super::material::Material;
use super::study::{Combination, PointLoad, Question, Study, study};
use crate::frame::Frame;
use crate::frame::fixture::circuit;
use crate::ids::{Id, RodId};
use crate::surface::Vector3;

/// What is asked of a frame: of pine, tied, pinned; its weight, snow, and a force on the first
/// rod, each alone and all together.
pub(crate) fn question(frame: &Frame, scale: f64) -> Question {
    let rod = RodId::new(0);
    let case = |name: &str, weight, area, points| Combination {
        name: name.to_owned(),
        weight,
        area,
        points,
    };
    Question {
        taken: Assumptions {
            material: Material::named("pine").expect("a material of the table"),
            hold: Hold::Tied,
            feet: Feet::Pinned,
            scale,
        },
        material: "pine".to_owned(),
        points: vec![PointLoad {
            rod,
            at: frame.rods[rod].axis.length() / 3.0,
            force: Vector3::new(0.0, 0.3, -1.0) * scale * scale,
        }],
        pressure: 1e-4,
        combinations: vec![
            case("weight", 1.0, 0.0, 0.0),
            case("snow", 1.0, 1.5, 0.0),
            case("all", 1.0, 1.0, 1.0),
        ],
        add_feet: true,
    }
}

/// A circuit of so many rods, studied at a scale.
pub(crate) fn studied(n: usize, scale: f64) -> (Frame, Study) {
    let frame = circuit(n, 3.0);
    let study = study(&frame, question(&frame, scale)).expect("a circuit on feet stands");
    (frame, study)
}
