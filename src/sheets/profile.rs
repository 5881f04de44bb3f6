//! What laser cutters and their programs expect of a file.

use crate::drawing::Color;
use serde::{Deserialize, Serialize};

/// The laser, or its program, or the service that cuts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum LaserProfile {
    /// Red cuts, blue scores, black areas are engraved; hairlines of 0.01 mm
    #[default]
    Generic,
    /// LightBurn: its colours C02, C01 and C00
    Lightburn,
    /// Ponoko: blue cuts, red scores
    Ponoko,
    /// Trotec: as generic
    Trotec,
    /// Epilog: as generic, with hairlines of 0.025 mm
    Epilog,
    /// Glowforge: as generic, without DXF files, which it cannot read
    Glowforge,
}

const RED: Color = Color::rgb(0xFF, 0x00, 0x00);
const BLUE: Color = Color::rgb(0x00, 0x00, 0xFF);

impl LaserProfile {
    /// The colours of cuts, of scored lines and of engraved areas.
    pub fn colors(self) -> [Color; 3] {
        match self {
            Self::Ponoko => [BLUE, RED, Color::BLACK],
            Self::Generic | Self::Lightburn | Self::Trotec | Self::Epilog | Self::Glowforge => {
                [RED, BLUE, Color::BLACK]
            }
        }
    }

    /// Width of lines, mm: wider ones are taken for areas.
    pub fn stroke(self) -> f64 {
        if self == Self::Epilog { 0.025 } else { 0.01 }
    }

    /// Whether DXF files are of use.
    pub fn reads_dxf(self) -> bool {
        self != Self::Glowforge
    }
}
