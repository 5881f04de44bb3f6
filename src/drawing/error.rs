//! What can be wrong with a drawing.

use super::Weight;

/// Why a drawing cannot be measured or rendered.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum DrawingError {
    /// The embedded font has no picture for a character.
    #[error("no {weight} glyph for {character:?} (U+{code:04X}) in {text:?}", code = u32::from(*.character))]
    MissingGlyph {
        /// The character without a glyph.
        character: char,
        /// The whole string it stands in.
        text: String,
        /// The weight that was looked in.
        weight: Weight,
    },
    /// A coordinate, width or size is infinite or not a number.
    #[error("{place}: a coordinate or size is not a finite number")]
    NotFinite {
        /// Which item of which layer.
        place: String,
    },
    /// The sheet has no area, or more than PDF readers accept.
    #[error("a sheet of {width} × {height} mm cannot be rendered")]
    SheetSize {
        /// Width asked for, mm.
        width: f64,
        /// Height asked for, mm.
        height: f64,
    },
    /// The embedded font file could not be read or subset.
    #[error("the embedded {weight} font: {reason}")]
    Font {
        /// The weight that failed.
        weight: Weight,
        /// What the font reader said.
        reason: String,
    },
    /// The PDF could not be assembled.
    #[error("writing the PDF: {0}")]
    Pdf(String),
}

impl DrawingError {
    /// What the user can do about it, where there is something.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::MissingGlyph { .. } => Some("use letters and signs that DejaVu Sans covers"),
            Self::SheetSize { .. } => Some("each side must be above 0 and at most 5080 mm"),
            Self::NotFinite { .. } | Self::Font { .. } | Self::Pdf(_) => None,
        }
    }
}
