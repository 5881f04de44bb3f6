//! The command line: one file a subcommand.

mod build;
mod complete;
mod convert;
mod gallery;
mod input;
mod inspect;
mod page;
mod patterns;
mod progress;
mod sample;
mod statics;
mod statics_page;
mod summary;
mod templates;
mod terminal;

use crate::design::DesignError;
use crate::write::folder::FolderError;
use clap::{ColorChoice, CommandFactory, Parser, Subcommand};
use std::path::Path;
use std::process::ExitCode;
use terminal::{Terminal, print};

/// Reciprocal frames from sticks: from a surface to the papers for building it
#[derive(Parser)]
#[command(name = "rodwright", version, max_term_width = 100, disable_help_subcommand = true)]
#[command(after_help = "Lengths take a unit (3mm, 12cm, 0.6m, 1/8in, 2ft), a bare number is mm; \
                        angles take deg or rad, a bare number is degrees.")]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// When to use colour
    #[arg(long, global = true, value_enum, default_value = "auto")]
    color: ColorChoice,
}

#[derive(Subcommand)]
enum Command {
    /// Make a frame on a surface and write everything needed to build it
    Build(Box<build::Args>),
    /// List the patterns, tell about one, or check the rules of a pattern file
    Patterns(patterns::Args),
    /// Tell everything about a rod, contact or unit of a finished folder, or about a surface
    Inspect(inspect::Args),
    /// Study a finished frame under loads: stresses, displacements, what the ground carries
    Statics(Box<statics::Args>),
    /// Write a surface or a finished structure in another format
    Convert(convert::Args),
    /// Write a sample surface
    Sample(sample::Args),
    /// Write the texts of the papers as files, to be changed for --templates
    Templates(templates::Args),
    /// Draw the frames of many designs on one page
    Gallery(gallery::Args),
    /// Print a script that completes commands in a shell
    Completions(complete::Args),
    /// Print the manual page
    Man,
}

/// What a command ends with when it fails.
enum Failure {
    /// The input or design cannot give a result: exit status 1.
    Input(String),
    /// Options that do not go together: exit status 2.
    Usage(String),
    /// A file or folder cannot be read or written: exit status 3.
    File(String),
}

impl Failure {
    fn input(message: impl ToString) -> Self {
        Self::Input(message.to_string())
    }

    fn usage(message: impl ToString) -> Self {
        Self::Usage(message.to_string())
    }

    fn file(message: impl ToString) -> Self {
        Self::File(message.to_string())
    }
}

/// Writes the one result of a command to a file, or to standard output.
fn write_result(out: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    match out {
        None => print(bytes),
        Some(file) => std::fs::write(file, bytes)
            .map_err(|e| Failure::file(format!("cannot write {}: {e}", file.display()))),
    }
}

/// A design file that cannot be had, as opposed to one that asks for what cannot be.
fn design_failure(e: DesignError) -> Failure {
    if e.is_io() { Failure::file(e) } else { Failure::input(e) }
}

/// A folder that cannot be written, and what to do about it.
fn folder_failure(e: FolderError) -> Failure {
    Failure::file(match e.hint() {
        Some(hint) => format!("{e}. To mend it, {hint}"),
        None => e.to_string(),
    })
}

/// Runs the program with the arguments of the process.
///
/// Exit status: 0 done; 1 the input or design cannot give a structure; 2 wrong
/// usage; 3 a file could not be read or written.
pub fn run() -> ExitCode {
    let cli = Cli::parse();
    let terminal = Terminal::new(cli.color);
    let done = match cli.command {
        Command::Build(args) => build::run(*args, &terminal),
        Command::Patterns(args) => patterns::run(&args, &terminal),
        Command::Inspect(args) => inspect::run(args, &terminal),
        Command::Statics(args) => statics::run(*args, &terminal),
        Command::Convert(args) => convert::run(&args, &terminal),
        Command::Sample(args) => sample::run(&args),
        Command::Templates(args) => templates::run(&args, &terminal),
        Command::Gallery(args) => gallery::run(&args, &terminal),
        Command::Completions(args) => complete::completions(&args, Cli::command()),
        Command::Man => complete::man(Cli::command()),
    };
    let (message, status) = match done {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Input(message)) => (message, 1),
        Err(Failure::Usage(message)) => (message, 2),
        Err(Failure::File(message)) => (message, 3),
    };
    terminal.error(&message);
    ExitCode::from(status)
}
