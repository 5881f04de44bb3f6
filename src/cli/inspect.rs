//! `rodwright inspect`: everything about one rod, contact or unit of a structure, or
//! about a surface before a frame is made on it.

mod structure;
mod surface;

use super::Failure;
use super::input::{Input, Preparation};
use super::terminal::{Terminal, print};
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Args {
    /// A folder written by rodwright, its structure.json, or a surface file
    path: PathBuf,

    /// Tell about this rod, e.g. R012
    #[arg(long, value_name = "ID", group = "what")]
    rod: Option<String>,

    /// Tell about this contact, e.g. C0034
    #[arg(long, value_name = "ID", group = "what")]
    contact: Option<String>,

    /// Tell about this unit, e.g. U007
    #[arg(long, value_name = "ID", group = "what")]
    unit: Option<String>,

    #[command(flatten)]
    preparation: Preparation,
}

pub fn run(args: Args, terminal: &Terminal) -> Result<(), Failure> {
    let text = match Input::read(&args.path)? {
        Input::Structure(structure) => {
            args.preparation.refuse(&args.path)?;
            structure::page(&args, &structure, terminal)?
        }
        Input::Surface(reading) => {
            let what = [("--rod", &args.rod), ("--contact", &args.contact), ("--unit", &args.unit)];
            if let Some((option, _)) = what.iter().find(|w| w.1.is_some()) {
                return Err(Failure::usage(format!(
                    "{option} tells about a finished structure, but {} is a surface: name a \
                     folder written by `rodwright build`",
                    args.path.display()
                )));
            }
            surface::page(&args, *reading, terminal)?
        }
    };
    print(text.as_bytes())
}
