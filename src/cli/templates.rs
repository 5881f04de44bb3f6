//! `rodwright templates`: the texts of the papers as files, to be changed.

use super::Failure;
use super::terminal::{Terminal, print};
use crate::sheets::{Language, built_in_files};
use crate::write::file::replace;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
#[command(
    after_help = "Keep the files that you change and delete the others, and name the folder with \
                        `rodwright build --templates FOLDER`. Texts that are not in them are \
                        taken as they come with the program."
)]
pub struct Args {
    /// Folder to write the files to
    #[arg(short, long, value_name = "FOLDER")]
    out: PathBuf,

    /// Language of the texts
    #[arg(long, value_enum, default_value = "en")]
    language: Language,

    /// Write over files that are there
    #[arg(long)]
    force: bool,
}

pub fn run(args: &Args, terminal: &Terminal) -> Result<(), Failure> {
    let files = built_in_files(args.language);
    let there: Vec<&str> =
        files.iter().map(|(name, _)| *name).filter(|name| args.out.join(name).exists()).collect();
    if !there.is_empty() && !args.force {
        return Err(Failure::file(format!(
            "{} has {} already. To write over files of texts, add --force; to keep them, name \
             another folder",
            args.out.display(),
            there.join(", ")
        )));
    }
    std::fs::create_dir_all(&args.out).map_err(|e| cannot_write(&args.out, &e))?;
    for (name, text) in &files {
        let file = args.out.join(name);
        replace(&file, text.as_bytes()).map_err(|e| cannot_write(&file, &e))?;
    }
    if !there.is_empty() {
        terminal.note(&format!("written over: {}", there.join(", ")));
    }
    let list = files.iter().map(|(name, _)| format!("{}\n", args.out.join(name).display()));
    print(list.collect::<String>().as_bytes())
}

fn cannot_write(path: &Path, e: &std::io::Error) -> Failure {
    Failure::file(format!("cannot write {}: {e}", path.display()))
}
