//! The papers of the workshop: pages made of drawings.
//!
//! [`sheets`] gives the pages of the workshop document: cover, figures, parts, cut list with
//! sawing plan, rod cards, the steps of assembly and the table of feet. [`histograms`] shows
//! some of the figures. [`statics_sheets`] shows where a frame is stressed. [`support_map`] gives
//! the map of the feet at full size, in one piece and tiled over pages, [`footprint`] the surface laid flat, [`labels`] a label for each rod,
//! [`jigs`] the sheets for a laser, [`viewer`] a page for a browser.
//! [`pattern_picture`], [`pattern_sheet`] and [`contact_sheet`] show what there is to choose
//! from. Nothing here writes files: pages are rendered by [`drawing::pdf`](crate::drawing::pdf) and [`drawing::svg`](crate::drawing::svg).

mod band;
mod contact_sheet;
mod cover;
mod cut_list;
mod figures;
pub mod footprint;
mod format;
pub mod handout;
mod histograms;
pub mod jigs;
pub mod labels;
mod legend;
mod line_picture;
pub mod notes;
mod page;
mod paper;
mod parts;
mod pattern_picture;
mod pattern_sheet;
mod pictures;
mod profile;
mod rod_cards;
pub mod statics;
mod step_labels;
mod step_picture;
mod step_text;
mod step_views;
mod steps;
mod strip;
pub mod support_map;
mod support_tiles;
pub mod text;
mod view;
pub mod viewer;

#[cfg(test)]
mod tests;

pub use contact_sheet::{Exhibit, contact_sheet};
pub use format::{Format, PaperUnits};
pub use histograms::{HistogramPair, histogram_pairs, histograms, relaxing_pairs};
pub use page::{Document, Sheet, document_title};
pub use paper::{Paper, PaperError};
pub use pattern_picture::{PictureError, pattern_picture};
pub use pattern_sheet::{PatternEntry, pattern_sheet};
pub use pictures::pictures;
pub use profile::LaserProfile;
pub use statics::statics_sheets;
pub use text::{Language, TextError, Texts, built_in_files};

use crate::drawing::DrawingError;
use crate::frame::Frame;
use crate::frame::footprint::Footprint;
use crate::frame::measure::Measures;
use crate::ids::RodId;
use crate::shop::{Assembly, CutPlan};
use std::collections::BTreeSet;
use text::message::Message;

/// How the papers look.
#[derive(Clone, PartialEq, Debug)]
pub struct SheetSettings {
    /// Name of the model, on every page.
    pub model: String,
    /// What the pages are printed on.
    pub paper: Paper,
    /// The unit in which lengths are printed.
    pub units: PaperUnits,
    /// Density of the rods, kg/m³.
    pub density: f64,
    /// Rods that are sawn already.
    pub sawn: BTreeSet<RodId>,
    /// Lines printed on the cover, such as the command that repeats the run.
    pub notes: Vec<String>,
    /// What is said on the papers, in their language.
    pub texts: Texts,
}

/// Why there are no papers.
#[derive(Debug, thiserror::Error)]
pub enum SheetError {
    /// A page cannot be drawn.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    /// A text cannot be put together.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The data of a page cannot be written.
    #[error("the data of the viewer cannot be written: {0}")]
    Data(#[from] serde_json::Error),
    /// The paper leaves no room for the pages.
    #[error(
        "paper of {width} × {height} mm is too small: the pages need at least {least_width} × {least_height} mm"
    )]
    PaperTooSmall {
        /// Width of the paper, mm.
        width: f64,
        /// Height of the paper, mm.
        height: f64,
        /// Least width, mm.
        least_width: f64,
        /// Least height, mm.
        least_height: f64,
    },
}

/// The pages of the workshop document; `measures` are the figures of the frame, `plane` is for models on a flattened surface.
///
/// # Errors
/// [`SheetError::PaperTooSmall`]; [`SheetError::Drawing`] if the frame holds numbers
/// that are not finite.
pub fn sheets(
    frame: &Frame,
    measures: &Measures,
    plane: Option<&Footprint>,
    plan: &CutPlan,
    assembly: Option<&Assembly>,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let settings = settings.checked()?;
    let mut leaves = cover::cover(frame, plan, &settings)?;
    leaves.extend(figures::page(measures, &settings)?);
    leaves.extend(parts::parts(frame, &settings)?);
    if let Some(plane) = plane {
        leaves.extend(footprint::page(plane, &settings)?);
    }
    leaves.extend(cut_list::cut_list(frame, plan, &settings)?);
    leaves.extend(rod_cards::rod_cards(frame, &settings)?);
    if let Some(assembly) = assembly {
        leaves.extend(steps::steps(frame, assembly, &settings)?);
    }
    leaves.extend(support_tiles::overview(frame, &settings)?);
    page::stamp(leaves, &settings.format().diameters(frame), &settings)
}

/// The pages of the assembly steps alone, numbered by themselves.
///
/// # Errors
/// As [`sheets`].
pub fn step_sheets(
    frame: &Frame,
    assembly: &Assembly,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let settings = settings.checked()?;
    let leaves = steps::steps(frame, assembly, &settings)?;
    page::stamp(leaves, &settings.format().diameters(frame), &settings)
}

impl SheetSettings {
    /// How figures are printed.
    pub fn format(&self) -> Format {
        Format { units: self.units, decimal: self.texts.decimal() }
    }

    /// Puts a message into words.
    fn say(&self, message: impl Message) -> Result<String, TextError> {
        self.texts.say(message)
    }

    /// The settings with texts that the font can print, if the paper is large enough.
    fn checked(&self) -> Result<Self, SheetError> {
        let [width, height] = self.paper.size();
        let [least_width, least_height] = page::LEAST_PAPER;
        // Negated so that sizes that are not numbers are refused as well.
        if !(width >= least_width && height >= least_height) {
            return Err(SheetError::PaperTooSmall { width, height, least_width, least_height });
        }
        let notes = self.notes.iter().map(|line| page::printable(line)).collect();
        Ok(Self { model: page::printable(&self.model), notes, ..self.clone() })
    }
}
