//! `rodwright patterns`: the pattern library, and the check of pattern files.

mod check;
mod json;
mod page;
mod pictures;
mod table;
mod trial;

use super::Failure;
use super::terminal::{Terminal, print};
use crate::pattern::{Pattern, PatternError, library};
use std::path::{Path, PathBuf};
use trial::Trial;

#[derive(clap::Args)]
pub struct Args {
    /// Tell everything about these patterns: names of the list, or pattern files (.toml)
    #[arg(value_name = "NAME", group = "what")]
    names: Vec<String>,

    /// Check the rules of a pattern file: which tilings they make, or why none
    #[arg(long, value_name = "RULES.toml", group = "what")]
    check: Option<PathBuf>,

    /// Take this one of the tilings that the rules make
    #[arg(long, value_name = "NAME", requires = "what")]
    cycle: Option<String>,

    /// Draw the pattern in the plane
    #[arg(long, value_name = "FILE.svg", requires = "names", conflicts_with_all = ["json", "check"])]
    svg: Option<PathBuf>,

    /// Draw all patterns on one page, in the plane and on a dome
    #[arg(long, value_name = "FILE.svg", group = "what")]
    gallery: Option<PathBuf>,

    /// Try all patterns on a surface, or on that of a design with its settings, and compare;
    /// with names, try these, and print how well they come out on all surfaces in one table
    #[arg(long, value_name = "SURFACE", conflicts_with_all = ["check", "cycle", "svg", "gallery"])]
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
    if args.cycle.is_some() || args.svg.is_some() {
        only_one(&args.names)?;
    }
    let named = args.names.iter().map(|name| find(name, cycle));
    let named: Vec<Pattern> = named.collect::<Result<_, _>>()?;
    if !args.on.is_empty() {
        let mut patterns: Vec<_> = args.names.iter().map(String::as_str).zip(&named).collect();
        let together = !patterns.is_empty();
        if !together {
            patterns = library().iter().map(|p| (p.name.as_str(), p)).collect();
        }
        let trial = Trial { surfaces: &args.on, patterns, together, json: args.json };
        return trial::run(&trial, terminal);
    }
    if let (Some(file), [pattern]) = (&args.svg, &named[..]) {
        return pictures::one(pattern, file);
    }
    let text = match (&named[..], args.json) {
        ([], true) => json::patterns(library()),
        ([], false) => page::list(terminal),
        (named, true) => json::patterns(named),
        (named, false) => {
            named.iter().map(|p| page::about(p, terminal)).collect::<Vec<_>>().join("\n")
        }
    };
    print(text.as_bytes())
}

/// A picture, and another tiling, are of one pattern.
fn only_one(names: &[String]) -> Result<(), Failure> {
    match names {
        [_, second, ..] => Err(Failure::usage(format!(
            "--svg and --cycle take one pattern. Leave out {second} and what follows"
        ))),
        _ => Ok(()),
    }
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
