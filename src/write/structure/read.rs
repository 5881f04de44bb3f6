//! Reading a structure back.

use super::{FORMAT, Structure, StructureFault, VERSION};
use serde::Deserialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a file gives no structure.
#[derive(Error, Debug)]
pub enum StructureError {
    /// The file could not be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is not JSON, or a key is missing or of another kind.
    #[error("{}:{line}:{column}: {reason}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        reason: String,
    },
    /// The file is JSON, but of another format.
    #[error("{}: it is not a {FORMAT} file{}", path.display(), found.as_ref().map_or_else(String::new, |f| format!(", but {f}")))]
    Format {
        /// The file.
        path: PathBuf,
        /// What its key `format` says, if it has one.
        found: Option<String>,
    },
    /// The file is of a version that this program does not know.
    #[error("{}: it is of version {found}; this program reads version {VERSION}", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: String,
    },
    /// The file holds a structure that does not hang together.
    #[error("{}: {fault}", path.display())]
    Fault {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: StructureFault,
    },
}

impl StructureError {
    /// What the user can do about it, where there is something.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Read { .. } => Some("give a structure.json, as `rodwright build` writes it"),
            Self::Json { .. } | Self::Format { .. } | Self::Fault { .. } => {
                Some("build the structure again, or give another file")
            }
            Self::Version { .. } => {
                Some("read it with the rodwright that wrote it, or build again")
            }
        }
    }
}

/// The keys that say what a file is, whatever else it holds.
#[derive(Deserialize)]
struct Head {
    #[serde(default)]
    format: serde_json::Value,
    #[serde(default)]
    version: serde_json::Value,
}

/// Reads a `structure.json`.
///
/// # Errors
/// [`StructureError`], with the file, and the line or element where there is one.
pub fn read_structure(path: &Path) -> Result<Structure, StructureError> {
    let bytes =
        fs::read(path).map_err(|source| StructureError::Read { path: path.to_owned(), source })?;
    parse_structure(path, &bytes)
}

/// Reads the bytes of a `structure.json`; `path` is for messages only.
///
/// # Errors
/// As [`read_structure`].
pub fn parse_structure(path: &Path, bytes: &[u8]) -> Result<Structure, StructureError> {
    let json = |e: serde_json::Error| json_error(path, &e);
    let head: Head = serde_json::from_slice(bytes).map_err(json)?;
    if head.format != FORMAT {
        let found = head.format.as_str().map(str::to_owned);
        return Err(StructureError::Format { path: path.to_owned(), found });
    }
    if head.version != VERSION {
        let found = head.version.to_string();
        return Err(StructureError::Version { path: path.to_owned(), found });
    }
    let structure: Structure = serde_json::from_slice(bytes).map_err(json)?;
    structure.check().map_err(|fault| StructureError::Fault { path: path.to_owned(), fault })?;
    Ok(structure)
}

fn json_error(path: &Path, e: &serde_json::Error) -> StructureError {
    let text = e.to_string();
    // The place stands before the reason already.
    let reason = text.split(" at line ").next().unwrap_or(&text).to_owned();
    StructureError::Json { path: path.to_owned(), line: e.line(), column: e.column(), reason }
}
