//! `rodwright sample`: writes a sample surface.

use super::terminal::print;
use super::{Failure, write_result};
use crate::surface::samples::{NAMES, sample};
use crate::write::obj::write_obj;
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
        let list: String =
            NAMES.iter().map(|(name, about)| format!("{name:<16} {about}\n")).collect();
        return print(list.as_bytes());
    };
    let mesh = sample(name).ok_or_else(|| {
        let known: Vec<&str> = NAMES.iter().map(|n| n.0).collect();
        Failure::input(format!("no sample is called {name}; there are {}", known.join(", ")))
    })?;
    write_result(args.out.as_deref(), write_obj(&mesh).as_bytes())
}
