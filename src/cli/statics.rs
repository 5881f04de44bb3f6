//! `rodwright statics`: stresses in a finished frame under other loads.

use super::input::Input;
use super::statics_page::page;
use super::terminal::{Terminal, print};
use super::{Failure, design_failure, folder_failure};
use crate::design::{Design, Folders, Settings, StaticsSettings};
use crate::documents;
use crate::statics::solve::StaticsError;
use crate::statics::study::study;
use crate::write::folder::OutputFolder;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    /// A folder written by rodwright: what its design says of statics holds where nothing else
    /// is given here
    #[arg(value_name = "OUT")]
    folder: PathBuf,

    #[command(flatten)]
    settings: StaticsSettings,

    /// Print statics.json instead of the summary
    #[arg(long)]
    json: bool,

    /// Say nothing but errors
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

pub fn run(args: Args, terminal: &Terminal) -> Result<(), Failure> {
    let Input::Structure(structure) = Input::read(&args.folder)? else {
        return Err(Failure::input(format!(
            "{} is a surface: build a frame on it first, with `rodwright build`",
            args.folder.display()
        )));
    };
    let frame = structure.to_frame().map_err(Failure::input)?;
    let mut folder = OutputFolder::open(&args.folder).map_err(folder_failure)?;
    let design = design(&args.folder)?;
    let built = design.statics_as_given();
    if design.stiffen.is_some() && args.settings.loads.is_none() && built.loads.is_some() {
        return Err(Failure::usage(
            "the loads of design.toml name rods of the frame as it was before it was made stiffer: \
             say with --load where they act now",
        ));
    }
    let given = args.settings.or(built);
    let wish = given.resolve(None).map_err(Failure::input)?;
    let question = wish.about(&frame).map_err(Failure::input)?;
    let study = study(&frame, question).map_err(|e| Failure::input(does_not_stand(&e)))?;
    let files = documents::studied_again(&design, &structure, &study, |name| folder.file(name));
    for (name, bytes) in files.map_err(Failure::input)? {
        folder.replace(name, bytes).map_err(folder_failure)?;
    }
    let json = folder.file("statics.json").map(<[u8]>::to_vec);
    folder.commit().map_err(folder_failure)?;
    match json {
        Some(json) if args.json => print(&json),
        _ if args.quiet => Ok(()),
        _ => print(page(&study, &args.folder, terminal).as_bytes()),
    }
}

/// Why a frame does not stand, and what to try.
pub fn does_not_stand(e: &StaticsError) -> String {
    match e {
        StaticsError::Loose(_) => format!("{e}. --supports auto adds feet until it stands"),
        StaticsError::Linalg(_) => e.to_string(),
    }
}

/// The design that a folder was made by.
fn design(folder: &Path) -> Result<Design, Failure> {
    let settings = Settings::read(&folder.join("design.toml")).map_err(design_failure)?;
    let folders = Folders { templates: Some(folder), ..Folders::default() };
    settings.of_papers().resolve(folders).map_err(design_failure)
}
