//! The whole way, from a design to a finished model. Read this first; what is then
//! drawn and written of the model stands in [`documents`](crate::documents).

use crate::chart::{ChartError, Distortion, PlanarChart};
use crate::design::Design;
use crate::frame::canvas::{PlaneCanvas, TooManyUnits};
use crate::frame::fit::{Fit, FitBy, FitError, fit};
use crate::frame::form::{FormError, FormSettings, Formed, form, median_rise};
use crate::frame::measure::{Measures, measure};
use crate::shop::cutlist::{CutError, CutPlan, Stock, plan};
use crate::shop::lengths::cut_lengths;
use crate::surface::locate::Locator;
use crate::surface::mend::MendError;
use crate::surface::read::{ReadError, read};
use crate::surface::topology::{TopologyError, require_disk};
use crate::surface::up::{upright, with_file_axes};
use crate::surface::{Mesh, Point3};
use crate::tiling::Placement;
use thiserror::Error;

/// A finished model: the frame and everything that was found on the way.
#[derive(Debug)]
pub struct Model {
    /// The guiding surface, mm, z up, scaled.
    pub surface: Mesh,
    /// What was mended in the surface, a sentence each.
    pub notes: Vec<String>,
    /// How much the chart distorts.
    pub distortion: Distortion,
    /// The tile edge and the rise at it.
    pub fit: Fit,
    /// The frame.
    pub formed: Formed,
    /// Its figures.
    pub measures: Measures,
    /// The sawing plan.
    pub plan: CutPlan,
}

/// The steps of a run, as they begin.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// Reading and mending the surface.
    Read,
    /// Flattening it.
    Chart,
    /// Finding the tile edge.
    Fit,
    /// Weaving, lifting and closing the frame.
    Form,
    /// Measuring the result.
    Measure,
    /// Planning the saw cuts.
    Saw,
    /// Drawing and encoding the documents.
    Draw,
    /// Writing the folder.
    Write,
}

/// Makes the model that a design asks for. `begin` is called as each step begins.
///
/// # Errors
/// [`BuildError`] with what is wrong and what to try.
pub fn build(design: &Design, begin: &mut dyn FnMut(Step)) -> Result<Model, BuildError> {
    begin(Step::Read);
    let (surface, notes) = guiding_surface(design)?;
    begin(Step::Chart);
    let topology = require_disk(&surface)?;
    let chart = PlanarChart::new(surface.clone(), &topology)?;
    begin(Step::Fit);
    let fit = tile_edge(design, &chart)?;
    begin(Step::Form);
    let settings = form_settings(design, &surface);
    let placement = placement(design, fit.edge);
    let canvas = PlaneCanvas::new(&chart, design.pattern, placement, design.turn)?;
    let formed = form(&canvas, &settings)?;
    begin(Step::Measure);
    let measures = measure(&formed, &Locator::new(&surface));
    begin(Step::Saw);
    let plan = sawing_plan(design, &formed)?;
    Ok(Model { surface, notes, distortion: chart.distortion(), fit, formed, measures, plan })
}

/// Reads the surface, turns it upright and scales it.
fn guiding_surface(design: &Design) -> Result<(Mesh, Vec<String>), BuildError> {
    let reading = read(&design.surface_file)?;
    let mut mesh = match design.up {
        Some(up) if reading.y_up_metres => upright(&with_file_axes(&reading.mesh), up)?,
        Some(up) => upright(&reading.mesh, up)?,
        None => reading.mesh,
    };
    if let (Some(span), Some([lo, hi])) = (design.span, mesh.bounds()) {
        let longest = (hi.x - lo.x).max(hi.y - lo.y);
        if longest <= 0.0 {
            return Err(BuildError::NoSpan);
        }
        for p in mesh.points.iter_mut() {
            *p = Point3::from(p.coords * (span / longest));
        }
    }
    Ok((mesh, reading.notes))
}

fn placement(design: &Design, edge: f64) -> Placement {
    Placement { origin: design.origin.into(), rotation: design.rotate, edge }
}

/// The tile edge given, or the one that fits.
fn tile_edge(design: &Design, chart: &PlanarChart) -> Result<Fit, BuildError> {
    let Some(edge) = design.unit else {
        let start = placement(design, design.rod);
        return Ok(fit(chart, design.pattern, &start, design.turn, design.rod)?);
    };
    let canvas = PlaneCanvas::new(chart, design.pattern, placement(design, edge), design.turn)?;
    let (units, rise) = median_rise(&canvas).unwrap_or_default();
    Ok(Fit { edge, turn: design.turn, rise, units, by: FitBy::Given })
}

fn form_settings(design: &Design, surface: &Mesh) -> FormSettings {
    FormSettings {
        diameter: design.rod,
        overhang: design.overhang,
        round: design.round,
        layering: design.layer,
        surface_low: surface.bounds().map_or(0.0, |[lo, _]| lo.z),
    }
}

/// Stock that holds every rod where the user names none: 1 m, or the next whole metre.
fn sawing_plan(design: &Design, formed: &Formed) -> Result<CutPlan, BuildError> {
    let lengths = cut_lengths(&formed.frame);
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let stock = if design.stock.is_empty() {
        vec![((longest / METRE).ceil() * METRE).max(METRE)]
    } else {
        design.stock.clone()
    };
    Ok(plan(&lengths, &Stock { lengths: stock, kerf: design.kerf })?)
}

/// Sticks are sold by the metre, mm.
const METRE: f64 = 1000.0;

/// Why there is no model.
#[derive(Error, Debug)]
pub enum BuildError {
    /// The surface file.
    #[error("{0}. {hint}", hint = sentence(.0.hint()))]
    Read(#[from] ReadError),
    /// The surface, once turned.
    #[error("{0}. {hint}", hint = sentence(.0.hint()))]
    Mend(#[from] MendError),
    /// The surface's shape.
    #[error("{0}\n{hint}", hint = sentence(&.0.hint()))]
    Topology(#[from] TopologyError),
    /// A surface that stands on edge has no span.
    #[error(
        "the surface has no horizontal extent, so --span cannot scale it. Set --up to the axis that points up"
    )]
    NoSpan,
    /// The chart.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The tile edge.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The number of units.
    #[error(transparent)]
    Units(#[from] TooManyUnits),
    /// The frame.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The sawing plan.
    #[error("{0}. {hint}", hint = sentence(&.0.hint()))]
    Cut(#[from] CutError),
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
