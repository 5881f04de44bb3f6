//! All patterns tried on a surface, to choose from.

use crate::cli::terminal::{Terminal, print};
use crate::cli::{Failure, design_failure};
use crate::design::{Design, Folders, Settings, Tiles};
use crate::pattern::{Pattern, library};
use crate::pipeline::{BuildError, Model, flatten, lay};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;

/// The figures of a trial, as programs read them.
#[derive(Serialize)]
struct Figures<'a> {
    surface: String,
    pattern: &'a str,
    #[serde(flatten)]
    outcome: Outcome,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Outcome {
    Made {
        rods: usize,
        units: usize,
        contacts: usize,
        different_lengths: usize,
        total_length: f64,
        tile_edge: f64,
        median_rise: f64,
        median_move: f64,
        off_surface: f64,
        left_out: usize,
    },
    Failed {
        failed: String,
    },
}

/// Tries all patterns of the library on each surface and prints the tables.
pub fn run(surfaces: &[impl AsRef<Path>], json: bool, terminal: &Terminal) -> Result<(), Failure> {
    let mut all = Vec::new();
    let mut text = String::new();
    for surface in surfaces {
        let surface = surface.as_ref();
        let (settings, folder) = settings(surface)?;
        let first = design(&settings, folder, &library()[0])?;
        let flat = flatten(&first, &mut |_| {}).map_err(|e| build_failure(&e, surface))?;
        let mut figures = Vec::new();
        for pattern in library() {
            let design = design(&settings, folder, pattern)?;
            figures.push(Figures {
                surface: surface.display().to_string(),
                pattern: &pattern.name,
                outcome: outcome(lay(&design, pattern, &flat, &mut |_| {})),
            });
        }
        let rod = first.rod;
        if !text.is_empty() {
            text.push('\n');
        }
        table(&mut text, &format!("{}, {rod} mm rods", surface.display()), &figures, terminal);
        all.extend(figures);
    }
    if json {
        let list = serde_json::to_string_pretty(&all);
        text = list.expect("names and figures, no maps: these can always be written") + "\n";
    }
    print(text.as_bytes())
}

/// A surface with usual settings, or those of a design but for its pattern.
fn settings(surface: &Path) -> Result<(Settings, Option<&Path>), Failure> {
    if surface.extension().is_none_or(|e| e != "toml") {
        return Ok((Settings { surface: Some(surface.into()), ..Settings::default() }, None));
    }
    let read = Settings::read(surface).map_err(design_failure)?;
    let settings = Settings { cycle: None, turn: None, slide: None, ..read };
    Ok((settings, surface.parent()))
}

/// The design of a pattern with these settings.
pub fn design(
    settings: &Settings,
    folder: Option<&Path>,
    pattern: &Pattern,
) -> Result<Design, Failure> {
    let settings = Settings { pattern: Some(pattern.name.clone()), ..settings.clone() };
    let folders = Folders { surface: folder, pattern: None };
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
                off_surface: m.from_surface.rms,
                left_out: model.formed.frame.dropped.len(),
            }
        }
    }
}

/// A table of Markdown, which reads well as it is.
fn table(text: &mut String, title: &str, rows: &[Figures], terminal: &Terminal) {
    const HEADS: [&str; 9] = [
        "pattern",
        "rods",
        "units",
        "lengths",
        "rod in all, m",
        "tile edge, mm",
        "move, diameters",
        "off, mm",
        "left out",
    ];
    writeln!(text, "{}\n", terminal.bold(&format!("## {title}")))
        .expect("writing to a string cannot fail");
    let cells: Vec<[String; 9]> = rows.iter().map(cells).collect();
    let widths: Vec<usize> = (0..HEADS.len())
        .map(|i| cells.iter().map(|c| c[i].chars().count()).fold(HEADS[i].len(), usize::max))
        .collect();
    let mut line = |cells: [&str; 9]| {
        for (i, (cell, width)) in cells.iter().zip(&widths).enumerate() {
            let cell = if i == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") };
            write!(text, "| {cell} ").expect("writing to a string cannot fail");
        }
        text.push_str("|\n");
    };
    line(HEADS);
    let rule: Vec<String> = widths
        .iter()
        .enumerate()
        .map(|(i, width)| if i == 0 { "-".repeat(*width) } else { "-".repeat(width - 1) + ":" })
        .collect();
    line(std::array::from_fn(|i| rule[i].as_str()));
    for row in &cells {
        line(std::array::from_fn(|i| row[i].as_str()));
    }
    for row in rows {
        if let Outcome::Failed { failed } = &row.outcome {
            write!(text, "\n{}: {failed}\n", row.pattern).expect("writing to a string cannot fail");
        }
    }
}

fn cells(row: &Figures) -> [String; 9] {
    let name = row.pattern.to_owned();
    match &row.outcome {
        Outcome::Failed { .. } => {
            std::array::from_fn(|i| if i == 0 { name.clone() } else { "-".into() })
        }
        Outcome::Made {
            rods,
            units,
            different_lengths,
            total_length,
            tile_edge,
            median_move,
            off_surface,
            left_out,
            ..
        } => [
            name,
            rods.to_string(),
            units.to_string(),
            different_lengths.to_string(),
            format!("{:.2}", total_length / 1000.0),
            format!("{tile_edge:.1}"),
            format!("{median_move:.2}"),
            format!("{off_surface:.1}"),
            left_out.to_string(),
        ],
    }
}
