//! What `report.json` says of the statics.

use crate::statics::goal::Goal;
use crate::statics::solve::StaticsError;
use crate::statics::study::{Largest, Study};
use serde::Serialize;

/// What became of turn, slide and tile edge where a frame was stiffened.
#[derive(Clone, Debug, Serialize)]
pub struct StiffenedFigures {
    /// `utilisation` or `displacement`.
    pub goal: Goal,
    pub before: TriedFigures,
    pub after: TriedFigures,
    /// How many frames were tried.
    pub tried: usize,
}

/// A frame that was tried.
#[derive(Clone, Debug, Serialize)]
pub struct TriedFigures {
    /// Degrees.
    pub turn: f64,
    /// In tile edges.
    pub slide: f64,
    /// mm.
    pub edge: f64,
    pub rods: usize,
    /// Utilisation as part of the strength, or displacement in mm at the size that was studied.
    pub value: f64,
}

/// What was found, or why the frame does not stand.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum StaticsFigures {
    /// It stands.
    Stands {
        material: String,
        joint: &'static str,
        feet: &'static str,
        scale: f64,
        /// Largest von Mises stress as part of the strength.
        utilisation: Option<LargestFigure>,
        /// mm at the size that was studied.
        displacement: Option<LargestFigure>,
        /// Contacts that pull, and must be tied.
        pulls: Vec<String>,
    },
    /// It does not.
    Refused { refused: String },
}

/// The largest of a figure, and where it is.
#[derive(Clone, Debug, Serialize)]
pub struct LargestFigure {
    pub value: f64,
    pub case: String,
    pub rod: String,
    /// From end A, mm at the size that was studied.
    pub at: f64,
}

/// What `report.json` says of the statics.
pub fn statics_figures(found: &Result<Study, StaticsError>) -> StaticsFigures {
    let study = match found {
        Ok(study) => study,
        Err(e) => return StaticsFigures::Refused { refused: e.to_string() },
    };
    let largest = |of: Vec<Largest>| {
        let most = Largest::of(of)?;
        let case = study.cases[most.case].combination.name.clone();
        Some(LargestFigure { value: most.value, case, rod: most.rod.to_string(), at: most.at })
    };
    let taken = &study.question.taken;
    StaticsFigures::Stands {
        material: study.question.material.clone(),
        joint: taken.hold.code(),
        feet: taken.feet.code(),
        scale: taken.scale,
        utilisation: largest(study.worst()),
        displacement: largest(study.displacements()),
        pulls: study.pulls().iter().map(|(contact, _)| contact.to_string()).collect(),
    }
}
