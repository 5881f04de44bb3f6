//! `rodwright sample`: writes a sample surface.

use super::terminal::print;
use super::{Failure, write_result};
use crate::surface::samples::{NAMES, POLYGONS, sample, sample_polygons};
use crate::write::obj::{write_obj, write_obj_polygons};
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Args {
    /// Which surface; without it, the list of them
    name: Option<String>,

    /// File to write, OBJ in mm [default: standard output]
    #[arg(short, long, value_name = "FILE", requires = "name")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let Some(name) = &args.name else {
        let line = |(name, about): &(&str, &str)| format!("{name:<16} {about}\n");
        return print(all().map(line).collect::<String>().as_bytes());
    };
    let text = match (sample(name), sample_polygons(name)) {
        (Some(mesh), _) => write_obj(&mesh),
        (None, Some(mesh)) => write_obj_polygons(&mesh),
        (None, None) => {
            let known: Vec<&str> = all().map(|n| n.0).collect();
            let known = known.join(", ");
            return Err(Failure::input(format!("no sample is called {name}; there are {known}")));
        }
    };
    write_result(args.out.as_deref(), text.as_bytes())
}

fn all() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    NAMES.iter().chain(&POLYGONS)
}
