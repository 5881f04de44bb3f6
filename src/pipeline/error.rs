//! Why there is no model, and what to try.

use crate::chart::{ChartError, Uneven};
use crate::frame::as_built::AsBuiltError;
use crate::frame::canvas::PlaneError;
use crate::frame::fit::FitError;
use crate::frame::form::FormError;
use crate::linalg::LinalgError;
use crate::shop::JigError;
use crate::shop::saw::CutError;
use crate::statics::wish::LoadError;
use crate::surface::prepare::PrepareError;
use crate::surface::read::ReadError;
use crate::surface::topology::TopologyError;
use crate::tiling::midsphere::MidsphereError;
use std::path::PathBuf;
use thiserror::Error;

/// Why there is no model.
#[derive(Error, Debug)]
pub enum BuildError {
    /// The surface file.
    #[error("{0}. {hint}", hint = sentence(.0.hint()))]
    Read(#[from] ReadError),
    /// The surface, on the way to its place.
    #[error("{0}{hint}", hint = advice(&.0.to_string(), &.0.hint()))]
    Prepare(#[from] PrepareError),
    /// The surface's shape.
    #[error("{0}{hint}", hint = advice(&.0.to_string(), &.0.hint()))]
    Topology(#[from] TopologyError),
    /// The polyhedron.
    #[error(transparent)]
    Midsphere(#[from] MidsphereError),
    /// A sphere that is cut away whole, or not at all.
    #[error(
        "the cut at z = {at:.1} mm passes by the sphere, which reaches from {} to {radius} mm. \
         Cut between these heights, or at a share of them such as --cut z=40%", -radius
    )]
    CutPastSphere {
        /// Height of the cut, mm.
        at: f64,
        /// Radius of the sphere, mm.
        radius: f64,
    },
    /// Rods turned too little or too far for the tiles, in degrees.
    #[error(
        "turn = {turn:.1}deg: with these tiles the frame holds together between {least:.0} and \
         {most:.0} degrees, either way round. Leave --turn out to let it be fitted to the rods"
    )]
    Turn { turn: f64, least: f64, most: f64 },
    /// Rods that slide where tiles do not alternate.
    #[error(
        "slide = {slide}: rods slide where tiles alternate like the fields of a chessboard, with \
         an even number of them round every corner. That is not so here: leave --slide out"
    )]
    Alternate { slide: f64 },
    /// Rods that slide too little or too far.
    #[error(
        "slide = {slide}: with these tiles it leaves no room for the rods. Try another, such as \
         0.2 or -0.2, or thinner rods (--rod)"
    )]
    Slide { slide: f64 },
    /// The chart.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The tile edge.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The pattern on the chart.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The frame.
    #[error(transparent)]
    Form(#[from] FormError),
    /// Any of these, on a surface that is far from even when laid flat.
    #[error("{e}. When the surface is laid flat, {uneven}: {UNEVEN_ADVICE}")]
    Uneven { e: Box<BuildError>, uneven: Uneven },
    /// The frame, with rods that do not suit its units.
    #[error("{e}. Rods of {suits:.1} mm (--rod) would suit these units best")]
    Unsuited { e: FormError, suits: f64 },
    /// What was measured on sticks.
    #[error("{file}: {e}")]
    AsBuilt { file: PathBuf, e: AsBuiltError },
    /// What errors of marks and diameters do.
    #[error("what marks that are off do cannot be found: {0}")]
    Tolerance(LinalgError),
    /// A load that acts on no rod.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The assembly order.
    #[error("the order of assembly cannot be found: {0}")]
    Order(LinalgError),
    /// What a laser cuts.
    #[error(transparent)]
    Jigs(#[from] JigError),
    /// The sawing plan.
    #[error("{0}. {hint}", hint = sentence(&.0.hint()))]
    Cut(#[from] CutError),
}

/// What to do about units of very different size.
pub const UNEVEN_ADVICE: &str = "cut the surface (--cut), or use its own polygons (--pattern mesh)";

/// A hint after a message: in its line, or below where the message ends in a table.
fn advice(message: &str, hint: &str) -> String {
    let between = if message.contains('\n') { "\n" } else { ". " };
    format!("{between}{}", sentence(hint))
}

/// A hint as a sentence of its own.
fn sentence(hint: &str) -> String {
    let mut letters = hint.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}

impl BuildError {
    /// Whether a file that cannot be read, not what it holds, is at fault.
    pub fn is_io(&self) -> bool {
        matches!(self, Self::Read(e) if e.is_io())
    }
}
