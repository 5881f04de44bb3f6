//! `rodwright gallery`: one page with a picture of each of many designs.

use super::progress::Progress;
use super::terminal::Terminal;
use super::{Failure, design_failure, write_result};
use crate::design::{Design, Folders, Settings};
use crate::drawing::svg;
use crate::pipeline;
use crate::sheets::{Exhibit, contact_sheet};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    /// Design files, in the order of the pictures
    #[arg(required = true, value_name = "DESIGN")]
    designs: Vec<PathBuf>,

    /// File to write, SVG [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// Pictures in a row
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..))]
    columns: u8,

    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

pub fn run(args: &Args, terminal: &Terminal) -> Result<(), Failure> {
    let exhibits = args
        .designs
        .iter()
        .map(|file| exhibit(file, args.quiet, terminal))
        .collect::<Result<Vec<_>, _>>()?;
    let page = contact_sheet(&exhibits, args.columns.into()).map_err(Failure::input)?;
    let text = svg::render(&page).map_err(Failure::input)?;
    write_result(args.out.as_deref(), text.as_bytes())
}

/// Makes the model of a design, of which only the frame is kept.
fn exhibit(file: &Path, quiet: bool, terminal: &Terminal) -> Result<Exhibit, Failure> {
    let design = read(file)?;
    let mut progress = Progress::new(quiet);
    let built = pipeline::build(&design, &mut |step| progress.begin(step));
    progress.finish(false, terminal);
    let model = built.map_err(|e| {
        let message = format!("{}: {e}", file.display());
        if e.is_io() { Failure::File(message) } else { Failure::Input(message) }
    })?;
    let rods = model.measures.rods;
    Ok(Exhibit {
        frame: model.formed.frame,
        rims: model.guide.rims(),
        title: file.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        caption: format!("{}, {rods} rods", design.tiles.name()),
    })
}

fn read(file: &Path) -> Result<Design, Failure> {
    // These errors name the file themselves.
    let settings = Settings::read(file).map_err(design_failure)?;
    let folder = file.parent();
    let folders = Folders { surface: folder, pattern: folder, as_built: folder, templates: folder };
    settings.resolve(folders).map_err(|e| {
        let message = format!("{}: {e}", file.display());
        if e.is_io() { Failure::File(message) } else { Failure::Input(message) }
    })
}
