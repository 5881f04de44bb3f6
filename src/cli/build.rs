//! `rodwright build`: the main job.

use super::progress::Progress;
use super::statics::does_not_stand;
use super::summary::summary;
use super::terminal::{Terminal, print};
use super::{Failure, design_failure, folder_failure};
use crate::design::{Design, Folders, Settings};
use crate::documents;
use crate::frame::fit::{Fit, FitBy};
use crate::frame::guide::Guide;
use crate::frame::layer::Layering;
use crate::pipeline::{self, Model, Step, UNEVEN_ADVICE};
use crate::write::folder::OutputFolder;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    settings: Settings,

    /// Take settings from a file; options on the command line win
    #[arg(long, value_name = "FILE")]
    design: Option<PathBuf>,

    /// Folder to write [default: the surface's name and -frame]
    #[arg(short, long, value_name = "FOLDER")]
    out: Option<PathBuf>,

    /// Replace a rodwright folder even if it holds other files, which are kept
    #[arg(long)]
    force: bool,

    /// Print the report as JSON instead of the summary
    #[arg(long)]
    json: bool,

    /// Say nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,

    /// Say what was mended and how long each step took
    #[arg(short, long)]
    verbose: bool,
}

pub fn run(args: Args, terminal: &Terminal) -> Result<(), Failure> {
    let design = design(&args)?;
    let out = args.out.clone().unwrap_or_else(|| design.default_folder());
    let mut folder = OutputFolder::prepare(&out, args.force).map_err(folder_failure)?;
    let mut progress = Progress::new(args.quiet);
    let model = pipeline::build(&design, &mut |step| progress.begin(step))
        .map_err(|e| if e.is_io() { Failure::file(e) } else { Failure::input(e) })?;
    progress.begin(Step::Draw);
    let files = documents::files(&design, &model).map_err(Failure::input)?;
    progress.begin(Step::Write);
    let report = files.iter().find(|(name, _)| name == "report.json").map(|f| f.1.clone());
    for (name, bytes) in files {
        folder.add(name, bytes).map_err(folder_failure)?;
    }
    let written = folder.commit().map_err(folder_failure)?;
    progress.finish(args.verbose, terminal);
    if args.verbose {
        model.notes.iter().for_each(|note| terminal.note(note));
    }
    if !args.quiet {
        warnings(&design, &model).iter().for_each(|w| terminal.warning(w));
    }
    if !args.quiet && !written.kept.is_empty() {
        terminal.note(&format!("{} files of yours were kept in the folder", written.kept.len()));
    }
    match report {
        Some(report) if args.json => print(&report),
        _ if args.quiet => Ok(()),
        _ => print(summary(&design, &model, &out, terminal).as_bytes()),
    }
}

fn design(args: &Args) -> Result<Design, Failure> {
    let from_file = match &args.design {
        Some(file) => Settings::read(file).map_err(design_failure)?,
        None => Settings::default(),
    };
    let folder = args.design.as_deref().and_then(Path::parent);
    // What is named on the command line is not looked up beside the design file.
    let folders = Folders {
        surface: folder.filter(|_| args.settings.surface.is_none()),
        pattern: folder.filter(|_| args.settings.pattern.is_none()),
        as_built: folder.filter(|_| args.settings.as_built.is_none()),
        templates: folder.filter(|_| args.settings.templates.is_none()),
    };
    args.settings.clone().or(from_file).resolve(folders).map_err(design_failure)
}

/// What to say of sticks that sit badly in units that were not fitted to them.
fn ill_fitting(design: &Design, fit: &Fit) -> Option<String> {
    let open = match fit.by {
        FitBy::Given if design.unit.is_some() => ", or leave out --unit",
        FitBy::Given => ", or leave out --turn",
        FitBy::TurnLimit => "",
        FitBy::Edge | FitBy::Smaller | FitBy::Turn | FitBy::Plain => return None,
    };
    let ratio = design.rod / fit.rise;
    if fit.is_flat(design.rod) {
        // There the choice of who goes over keeps the frame on the surface.
        return (design.layer != Layering::Auto).then(|| {
            "the surface is too flat to lift the rods over each other: the frame will stand off it"
                .into()
        });
    }
    if (1.0 / ILL_FITTING..=ILL_FITTING).contains(&ratio) {
        return None;
    }
    let thick = if ratio > 1.0 { "thick" } else { "thin" };
    Some(format!(
        "{} mm rods are rather {thick} for units of {:.1} mm on this surface: {:.1} mm would \
         suit{open}",
        design.rod, fit.edge, fit.rise
    ))
}

/// A stick this many times thicker or thinner than the rise sits badly.
const ILL_FITTING: f64 = 2.0;

/// What the builder should know before sawing.
fn warnings(design: &Design, model: &Model) -> Vec<String> {
    let mut warnings = Vec::new();
    warnings.extend(ill_fitting(design, &model.fit));
    if let Guide::Chart { distortion, .. } = &model.guide {
        warnings.extend(distortion.fallback.clone());
        warnings.extend(distortion.uneven().map(|uneven| format!("{uneven}: {UNEVEN_ADVICE}")));
    }
    let frame = &model.formed.frame;
    if frame.supports.len() < 3 {
        warnings.push(format!(
            "{} rods reach the ground: the model needs a stand or a rim to rest on",
            frame.supports.len()
        ));
    }
    if let Some(Err(e)) = &model.statics {
        warnings.push(format!("statics: {}", does_not_stand(e)));
    }
    if !frame.dropped.is_empty() {
        warnings.push(format!(
            "{} units were left out because they do not work; report.json says where and why",
            frame.dropped.len()
        ));
    }
    warnings
}
