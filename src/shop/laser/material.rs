//! What jigs are cut from, and how wide a laser cuts it.

use serde::{Deserialize, Serialize};

/// What jigs are cut from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Material {
    /// Plywood: the laser takes away 0.20 mm
    #[default]
    Ply,
    /// Fibreboard: 0.18 mm
    Mdf,
    /// Acrylic: 0.15 mm
    Acrylic,
    /// Card: 0.15 mm
    Card,
}

impl Material {
    /// Full width of a cut, mm: what lasers of common power take away at 3 mm. The coupon among
    /// the gauges tells that of the laser at hand.
    pub fn kerf(self) -> f64 {
        match self {
            Self::Ply => 0.20,
            Self::Mdf => 0.18,
            Self::Acrylic | Self::Card => 0.15,
        }
    }
}
