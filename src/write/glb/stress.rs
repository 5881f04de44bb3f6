//! Rods in the colour of how far they are used up.
//!
//! Each rod has one colour, in steps: rods of one shape and one step share a mesh, so that the
//! file grows little however many rods there are. A colour for every point would need
//! points of its own for every rod.

use super::look::Look;
use super::{DIGITS, extras};
use crate::drawing::{Color, scale_color};
use crate::ids::{Id, IdVec, RodId};
use crate::statics::along::{RodFigures, most_used, rod_figures, share};
use crate::statics::study::Study;
use crate::write::figure::rounded;
use gltf_json::extras::Extras;
use serde::Serialize;

/// Steps between no stress and the largest. More, and there are more meshes than the eye
/// tells apart.
const STEPS: f64 = 32.0;

/// The stresses of a structure's rods.
pub(super) struct Stresses {
    figures: IdVec<RodId, RodFigures>,
    largest: f64,
}

/// What the material of a rod shows.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Shown {
    /// How it ends.
    Ends(Look),
    /// How far it is used up: the step of the scale.
    Used(u8),
}

#[derive(Serialize)]
pub(super) struct StressFigures {
    stress_mpa: f64,
    /// From end A.
    stress_at_mm: f64,
    utilisation: f64,
}

impl Stresses {
    pub fn new(study: &Study) -> Self {
        let figures = rod_figures(study);
        let largest = most_used(&figures);
        Self { figures, largest }
    }

    /// The figures of the rod in this place of the structure.
    pub fn figures(&self, place: usize) -> StressFigures {
        let rod = &self.figures[RodId::new(place)];
        StressFigures {
            stress_mpa: rounded(rod.stress, DIGITS),
            stress_at_mm: rounded(rod.at, DIGITS),
            utilisation: rounded(rod.utilisation, DIGITS),
        }
    }

    /// The step of the scale that it is in.
    pub fn step(&self, place: usize) -> u8 {
        let used = self.figures[RodId::new(place)].utilisation;
        (share(used, self.largest) * STEPS).round() as u8
    }

    /// The name of the material of a step.
    pub fn name(&self, step: u8) -> String {
        format!("utilisation {}", rounded(self.largest * f64::from(step) / STEPS, DIGITS))
    }
}

/// The colour of a step, linear RGBA.
pub(super) fn color(step: u8) -> [f32; 4] {
    let Color { r, g, b } = scale_color(f64::from(step) / STEPS);
    let [r, g, b] = [r, g, b].map(|part| rounded(Color::linear_part(part), DIGITS) as f32);
    [r, g, b, 1.0]
}

#[derive(Serialize)]
struct SceneFigures {
    statics: StaticsFigures,
}

/// What was taken, and what the colours of the rods say.
#[derive(Serialize)]
struct StaticsFigures {
    colors: &'static str,
    least: EndOfScale,
    most: EndOfScale,
    material: String,
    strength_mpa: f64,
    young_mpa: f64,
    joint: &'static str,
    feet: &'static str,
    /// The size studied, as a multiple of that of the model.
    scale: f64,
}

#[derive(Serialize)]
struct EndOfScale {
    color: String,
    utilisation: f64,
    stress_mpa: f64,
}

/// What the scene tells of a study.
pub(super) fn scene_extras(study: &Study) -> Result<Extras, serde_json::Error> {
    let taken = &study.question.taken;
    let largest = most_used(&rod_figures(study));
    let end = |share: f64| EndOfScale {
        color: scale_color(share).to_string(),
        utilisation: rounded(share * largest, DIGITS),
        stress_mpa: rounded(share * largest * taken.material.strength, DIGITS),
    };
    extras(&SceneFigures {
        statics: StaticsFigures {
            colors: "largest stress of the rod in any case, by the strength",
            least: end(0.0),
            most: end(1.0),
            material: study.question.material.clone(),
            strength_mpa: taken.material.strength,
            young_mpa: taken.material.young,
            joint: taken.hold.code(),
            feet: taken.feet.code(),
            scale: taken.scale,
        },
    })
}
