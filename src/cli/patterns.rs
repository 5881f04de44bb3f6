//! `rodwright patterns`: the pattern library, and the check of pattern files.

mod check;
mod json;
mod page;
mod pictures;
mod trial;

use super::Failure;
use super::terminal::{Terminal, print};
use crate::pattern::{Pattern, PatternError, library};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Args {
    /// Tell everything about this pattern: a name of the list, or a pattern file (.toml)
    #[arg(group = "what")]
    name: Option<String>,

    /// Check the rules of a pattern file: which tilings they make, or why none
    #[arg(long, value_name = "RULES.toml", group = "what")]
    check: Option<PathBuf>,

    /// Take this one of the tilings that the rules make
    #[arg(long, value_name = "NAME", requires = "what")]
    cycle: Option<String>,

    /// Draw the pattern in the plane
    #[arg(long, value_name = "FILE.svg", requires = "name", conflicts_with_all = ["json", "check"])]
    svg: Option<PathBuf>,

    /// Draw all patterns on one page, in the plane and on a dome
    #[arg(long, value_name = "FILE.svg", group = "what")]
    gallery: Option<PathBuf>,

    /// Try all patterns on a surface, or on that of a design with its settings, and compare
    #[arg(long, value_name = "SURFACE", group = "what")]
    on: Vec<PathBuf>,

    /// Print JSON
    #[arg(long, conflicts_with = "gallery")]
    json: bool,
}

pub fn run(args: &Args, terminal: &Terminal) -> Result<(), Failure> {
    let cycle = args.cycle.as_deref();
    if let Some(file) = &args.check {
        return check::run(file, cycle, args.json, terminal);
    }
    if let Some(file) = &args.gallery {
        return pictures::gallery(file);
    }
    if !args.on.is_empty() {
        return trial::run(&args.on, args.json, terminal);
    }
    let one = args.name.as_deref().map(|name| find(name, cycle)).transpose()?;
    if let (Some(file), Some(pattern)) = (&args.svg, &one) {
        return pictures::one(pattern, file);
    }
    let text = match (&one, args.json) {
        (Some(pattern), true) => json::patterns(std::slice::from_ref(pattern)),
        (Some(pattern), false) => page::about(pattern, terminal),
        (None, true) => json::patterns(library()),
        (None, false) => page::list(terminal),
    };
    print(text.as_bytes())
}

/// The pattern of a file or of the library, on another tiling if asked for.
fn find(name: &str, cycle: Option<&str>) -> Result<Pattern, Failure> {
    if Pattern::is_file(name) {
        let file = Path::new(name);
        return Pattern::read(file, cycle).map_err(|e| failure(&e, file));
    }
    let pattern = Pattern::named(name).ok_or_else(|| {
        let near = Pattern::near(name).join(", ");
        Failure::input(format!(
            "no pattern is called {name}; the nearest are {near}. `rodwright patterns` lists all; \
             the name of a pattern file ends in .toml"
        ))
    })?;
    match cycle {
        Some(cycle) => pattern.on(cycle).map_err(|e| Failure::input(format!("{name}: {e}"))),
        None => Ok(pattern.clone()),
    }
}

fn failure(e: &PatternError, file: &Path) -> Failure {
    let message = e.in_file(file);
    if e.is_io() { Failure::File(message) } else { Failure::Input(message) }
}
