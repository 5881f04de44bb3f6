//! Patterns tried on surfaces, to choose from.

use super::table::{LARGE, Table, WIDE};
use crate::cli::terminal::{Terminal, print};
use crate::cli::{Failure, design_failure};
use crate::design::{Design, Folders, Settings, Tiles};
use crate::pattern::Pattern;
use crate::pipeline::{BuildError, Model, flatten, lay};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The figures of a trial, as programs read them.
#[derive(Serialize)]
pub struct Figures<'a> {
    pub surface: String,
    pub pattern: &'a str,
    /// Diameter of the rods, mm.
    pub rod: f64,
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of it. Lengths in mm; moves, rises and gaps in rod diameters.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Outcome {
    Made {
        rods: usize,
        units: usize,
        contacts: usize,
        different_lengths: usize,
        total_length: f64,
        tile_edge: f64,
        median_rise: f64,
        median_move: f64,
        mean_move: f64,
        largest_move: f64,
        off_surface: f64,
        worst_gap: f64,
        left_out: usize,
    },
    Failed {
        failed: String,
    },
}

/// What is tried, and how it is told.
pub struct Trial<'a> {
    /// The surfaces, or designs.
    pub surfaces: &'a [PathBuf],
    /// The patterns, each with the name or file that it goes by.
    pub patterns: Vec<(&'a str, &'a Pattern)>,
    /// One table of everything, and not one a surface.
    pub together: bool,
    /// No table.
    pub json: bool,
}

/// Tries patterns on each surface and prints the tables.
pub fn run(trial: &Trial, terminal: &Terminal) -> Result<(), Failure> {
    let mut all = Vec::new();
    for surface in trial.surfaces {
        all.push(on_surface(surface, &trial.patterns)?);
    }
    let text = if trial.json {
        let list: Vec<&Figures> = all.iter().flatten().collect();
        let list = serde_json::to_string_pretty(&list);
        list.expect("names and figures, no maps: these can always be written") + "\n"
    } else if trial.together {
        Table::new(&WIDE, all.iter().flatten()).text()
    } else {
        let titled = |figures: &Vec<Figures>| {
            let title = format!("## {}, {} mm rods", figures[0].surface, figures[0].rod);
            format!("{}\n\n{}", terminal.bold(&title), Table::new(&LARGE, figures).text())
        };
        all.iter().map(titled).collect::<Vec<_>>().join("\n")
    };
    print(text.as_bytes())
}

fn on_surface<'a>(
    surface: &Path,
    patterns: &[(&str, &'a Pattern)],
) -> Result<Vec<Figures<'a>>, Failure> {
    let (settings, folder) = settings(surface)?;
    let first = design(&settings, folder, patterns[0].0)?;
    let flat = flatten(&first, &mut |_| {}).map_err(|e| build_failure(&e, surface))?;
    let figures = |&(name, pattern): &(&str, &'a Pattern)| {
        let design = design(&settings, folder, name)?;
        Ok(Figures {
            surface: surface.display().to_string(),
            pattern: &pattern.name,
            rod: design.rod,
            outcome: outcome(lay(&design, pattern, &flat, &mut |_| {})),
        })
    };
    patterns.iter().map(figures).collect()
}

/// A surface with usual settings, or those of a design but for its pattern.
fn settings(surface: &Path) -> Result<(Settings, Option<&Path>), Failure> {
    if surface.extension().is_none_or(|e| e != "toml") {
        return Ok((Settings { surface: Some(surface.into()), ..Settings::default() }, None));
    }
    let read = Settings::read(surface).map_err(design_failure)?;
    let settings = Settings {
        cycle: None,
        turn: None,
        slide: None,
        templates: None,
        as_built: None,
        tolerance: None,
        seed: None,
        ..read
    };
    Ok((settings, surface.parent()))
}

/// The design of a pattern, by its name or file, with these settings.
pub fn design(settings: &Settings, folder: Option<&Path>, name: &str) -> Result<Design, Failure> {
    let settings = Settings { pattern: Some(name.into()), ..settings.clone() };
    let folders = Folders { surface: folder, ..Folders::default() };
    let design = settings.resolve(folders).map_err(design_failure)?;
    match design.tiles {
        Tiles::Pattern(_) => Ok(design),
        _ => Err(Failure::input("patterns are tried on surfaces that can be laid flat")),
    }
}

fn build_failure(e: &BuildError, surface: &Path) -> Failure {
    let message = format!("{}: {e}", surface.display());
    if e.is_io() { Failure::File(message) } else { Failure::Input(message) }
}

fn outcome(laid: Result<Model, BuildError>) -> Outcome {
    match laid {
        Err(e) => Outcome::Failed { failed: e.to_string() },
        Ok(model) => {
            let m = &model.measures;
            Outcome::Made {
                rods: m.rods,
                units: m.units,
                contacts: m.contacts,
                different_lengths: m.distinct_lengths,
                total_length: m.total_length,
                tile_edge: model.fit.edge,
                median_rise: m.rises.median,
                median_move: m.moves.median,
                mean_move: m.moves.mean,
                largest_move: m.moves.max,
                off_surface: m.from_surface.rms,
                worst_gap: m.worst_gap,
                left_out: model.formed.frame.dropped.len(),
            }
        }
    }
}
