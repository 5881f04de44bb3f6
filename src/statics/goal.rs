//! What is to become small when a frame is stiffened.

use super::study::{Largest, Study};
use serde::{Deserialize, Serialize};

/// What is to become small.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Goal {
    /// The largest stress
    Utilisation,
    /// The largest displacement
    Displacement,
}

impl Goal {
    /// What a frame has of it: utilisation as part of the strength, displacement in mm.
    pub fn of(self, study: &Study) -> f64 {
        let all = match self {
            Self::Utilisation => study.worst(),
            Self::Displacement => study.displacements(),
        };
        Largest::of(all).map_or(0.0, |most| most.value)
    }
}
