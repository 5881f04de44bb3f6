//! What can be wrong with texts.

use std::path::PathBuf;

/// Why texts cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TextError {
    /// A file or the folder cannot be read.
    #[error("cannot read {file}: {source}. Check the name and who may read it")]
    Unreadable {
        /// The file or folder.
        file: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The folder holds a file that is not one of texts.
    #[error(
        "{file} is not a file of texts: there are {known}. `rodwright templates` writes them; hidden files and READMEs are passed over"
    )]
    UnknownFile {
        /// The file.
        file: PathBuf,
        /// Those that exist.
        known: String,
    },
    /// Something is wrong at a place in a file.
    #[error("{file}: line {line}: {problem}")]
    At {
        /// The file, or the name of one that the program brings.
        file: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong and what to try.
        problem: String,
    },
    /// A text fails with the values of this model, though not with those it was tried with.
    #[error("{file}: the text {key} cannot be put together: {problem}")]
    Render {
        /// Its file.
        file: &'static str,
        /// Its key.
        key: &'static str,
        /// What is wrong.
        problem: String,
    },
}

impl TextError {
    /// Whether a file cannot be read, as opposed to one with something wrong in it.
    pub fn is_io(&self) -> bool {
        matches!(self, Self::Unreadable { .. })
    }
}
