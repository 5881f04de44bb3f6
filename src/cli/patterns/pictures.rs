//! Pictures of patterns.

use super::trial::design;
use crate::chart::PlanarChart;
use crate::cli::{Failure, write_result};
use crate::design::Settings;
use crate::drawing::{Drawing, svg};
use crate::pattern::{Pattern, library};
use crate::pipeline::{Flat, lay};
use crate::sheets::{PatternEntry, pattern_picture, pattern_sheet};
use crate::surface::samples::sample;
use crate::surface::topology::require_chartable;
use std::path::Path;

/// Width and height of the picture of one pattern, mm.
const SIZE: [f64; 2] = [120.0, 130.0];

/// The surface that shows what patterns look like in space.
const DOME: &str = "igloo";

/// Draws one pattern in the plane.
pub fn one(pattern: &Pattern, file: &Path) -> Result<(), Failure> {
    let picture = pattern_picture(pattern, pattern.usual(), SIZE).map_err(Failure::input)?;
    write(&picture, file)
}

/// Draws all patterns, in the plane and on a dome.
pub fn gallery(file: &Path) -> Result<(), Failure> {
    let dome = sample(DOME).ok_or_else(|| Failure::input(format!("no sample {DOME}")))?;
    let topology = require_chartable(&dome).map_err(Failure::input)?;
    let settings = Settings { surface: Some(DOME.into()), ..Settings::default() };
    let on_dome = design(&settings, None, &library()[0].name)?;
    let chart = PlanarChart::new(dome, &topology, on_dome.chart).map_err(Failure::input)?;
    let flat = Flat { chart, notes: Vec::new() };
    let entry = |pattern: &'static Pattern| {
        let design = design(&settings, None, &pattern.name)?;
        let laid = lay(&design, pattern, &flat, &mut |_| {});
        let model = laid.map_err(|e| Failure::input(format!("{}: {e}", pattern.name)))?;
        let rims = model.guide.rims();
        Ok(PatternEntry { pattern, shape: pattern.usual(), frame: model.formed.frame, rims })
    };
    let entries = library().iter().map(entry).collect::<Result<Vec<_>, _>>()?;
    write(&pattern_sheet(&entries).map_err(Failure::input)?, file)
}

fn write(picture: &Drawing, file: &Path) -> Result<(), Failure> {
    let text = svg::render(picture).map_err(Failure::input)?;
    write_result(Some(file), text.as_bytes())
}
