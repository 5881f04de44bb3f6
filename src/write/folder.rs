//! The output folder: whole or not at all, and nothing of the user's is ever lost.
//!
//! **What may be replaced.** A folder that rodwright wrote holds a list of its files,
//! `.rodwright`, with a fingerprint of each. By it a new run tells
//!
//! - a folder that is not there, or is empty: it is made;
//! - a folder without the list: somebody else's, never replaced, forced or not;
//! - a folder with the list and nothing else: replaced;
//! - one that also holds files that are not on the list, or that were changed since:
//!   replaced only by force, and those files move along into the new folder. Where
//!   the new folder has a file of that name itself, the old one is kept beside it as
//!   `NAME.kept`.
//!
//! A symbolic link is refused: it is not clear which of its two places is meant.
//!
//! **How it is replaced.** All files are collected in memory. Then, beside the final
//! place `OUT`, in a working folder `.OUT.rodwright`:
//!
//! 1. the files are written to `.OUT.rodwright/new` and flushed to the disk;
//! 2. `OUT` is renamed to `.OUT.rodwright/old`;
//! 3. `.OUT.rodwright/new` is renamed to `OUT`;
//! 4. files that are not ours move from `old` to `OUT`;
//! 5. what is left of `old` is renamed to `gone`, and removed with the working folder.
//!
//! A failure in 1 or 2 leaves `OUT` as it was; one in 3 puts the old folder back. A
//! run that is killed leaves the working folder, and what it finds there tells the
//! next run how far it came: without `OUT` there, `old` is put back (killed between 2
//! and 3); with it, 4 and 5 are done now. Until then the old folder stands whole
//! under `old`. On Linux, 2 and 3 are one step where the file system can exchange two
//! folders, and there is no moment without a whole folder in the place.
//!
//! While it works in it, a run holds a lock in the working folder. Of two runs with
//! the same `OUT` the second waits, and its folder stays.

mod manifest;
mod work;

use manifest::{MANIFEST, Manifest, Verdict, verdict};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};
use thiserror::Error;
use work::Workplace;

/// Why an output folder cannot be written.
#[derive(Error, Debug)]
pub enum FolderError {
    /// The path does not end in a name, so nothing can be put in its place.
    #[error("{} does not end in the name of a folder", path.display())]
    NoName {
        /// The path.
        path: PathBuf,
    },
    /// The place is taken by something that is not a folder.
    #[error("{} is a file", path.display())]
    NotAFolder {
        /// The path.
        path: PathBuf,
    },
    /// The place is taken by a symbolic link.
    #[error("{} is a symbolic link", path.display())]
    Link {
        /// The path.
        path: PathBuf,
    },
    /// The folder was not written by this program.
    #[error("{} is a folder that rodwright did not write", path.display())]
    Foreign {
        /// The path.
        path: PathBuf,
    },
    /// The folder holds files that this program did not write, or not like that.
    #[error("{} holds files that rodwright did not write: {}", path.display(), listed(.files))]
    Additions {
        /// The path.
        path: PathBuf,
        /// The files, relative to the folder.
        files: Vec<PathBuf>,
    },
    /// Another run has been writing the same folder for a while.
    #[error("{} is being written by another rodwright", path.display())]
    Busy {
        /// The path.
        path: PathBuf,
    },
    /// A file was to be written under a name that is not a plain relative one.
    #[error("{name:?} is not a name for a file in the output folder")]
    FileName {
        /// The name.
        name: String,
    },
    /// Two files were to be written under one name.
    #[error("{name} was written twice")]
    Twice {
        /// The name.
        name: String,
    },
    /// The system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// Where.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
}

/// How many files a message names before it only counts the rest.
const NAMED: usize = 5;

fn listed(files: &[PathBuf]) -> String {
    let names: Vec<_> = files.iter().take(NAMED).map(|f| f.display().to_string()).collect();
    let names = names.join(", ");
    match files.len().saturating_sub(NAMED) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}

impl FolderError {
    fn io(path: &Path) -> impl Fn(io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    /// What the user can do about it, where there is something.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::NoName { .. } => Some("name a folder to be made, as in `-o out`"),
            Self::NotAFolder { .. } | Self::Foreign { .. } => {
                Some("choose another folder (-o), or move that one away yourself")
            }
            Self::Link { .. } => Some("name the folder itself (-o)"),
            Self::Additions { .. } => {
                Some("choose another folder (-o), or take them along into the new one (--force)")
            }
            Self::Busy { .. } => Some("wait until it is done, or choose another folder (-o)"),
            Self::Io { .. } => Some("choose a place that you may write to (-o)"),
            Self::FileName { .. } | Self::Twice { .. } => None,
        }
    }
}

/// An output folder to be written.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    force: bool,
    files: BTreeMap<String, Vec<u8>>,
}

/// An output folder that stands.
#[derive(Clone, PartialEq, Debug)]
pub struct Written {
    /// Where it is.
    pub path: PathBuf,
    /// Its files, relative to it, in order; without the list of them.
    pub files: Vec<String>,
    /// Files of the user that moved along, by their names now.
    pub kept: Vec<PathBuf>,
}

impl OutputFolder {
    /// Finds out whether a folder may be written at `path`, before any work is done,
    /// and mends what an earlier run left undone there. Nothing is left behind.
    ///
    /// # Errors
    /// [`FolderError`]: the place is taken, or may not be written to.
    pub fn prepare(path: &Path, force: bool) -> Result<Self, FolderError> {
        let folder = Self { path: path.to_owned(), force, files: BTreeMap::new() };
        if path.file_name().is_none() {
            return Err(FolderError::NoName { path: folder.path });
        }
        let parent = parent(path);
        if parent.is_dir() {
            let work = Workplace::enter(path)?;
            work.recover()?;
            folder.check()?;
        } else {
            try_to_write(parent)?;
        }
        Ok(folder)
    }

    /// Opens a folder that stands, to change files of it. Those on its list stay in it as they
    /// are unless they are replaced; files of the user move along.
    ///
    /// # Errors
    /// [`FolderError`]: it is none of ours, or may not be written to.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        let mut folder = Self::prepare(path, true)?;
        let Some(manifest) = Manifest::read(path)? else {
            return Err(FolderError::Foreign { path: folder.path });
        };
        folder.files = manifest.unchanged(path)?;
        Ok(folder)
    }

    /// A file that is to stand in the folder, as far as it is known.
    pub fn file(&self, name: &str) -> Option<&[u8]> {
        self.files.get(name).map(Vec::as_slice)
    }

    /// Adds a file, or takes the place of one.
    ///
    /// # Errors
    /// [`FolderError::FileName`].
    pub fn replace(&mut self, name: String, bytes: Vec<u8>) -> Result<(), FolderError> {
        self.files.remove(&name);
        self.add(name, bytes)
    }

    /// Where the folder will stand.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a file. Its name is relative to the folder, with `/` between its parts.
    ///
    /// # Errors
    /// [`FolderError::FileName`] or [`FolderError::Twice`].
    pub fn add(
        &mut self,
        name: impl Into<String>,
        bytes: impl Into<Vec<u8>>,
    ) -> Result<(), FolderError> {
        let name = name.into();
        if name == MANIFEST || !name.split('/').all(is_plain) {
            return Err(FolderError::FileName { name });
        }
        if self.files.contains_key(&name) {
            return Err(FolderError::Twice { name });
        }
        self.files.insert(name, bytes.into());
        Ok(())
    }

    /// Writes all files and puts the folder in its place.
    ///
    /// # Errors
    /// [`FolderError`]; the earlier folder is then as it was.
    pub fn commit(self) -> Result<Written, FolderError> {
        let parent = parent(&self.path);
        fs::create_dir_all(parent).map_err(FolderError::io(parent))?;
        let work = Workplace::enter(&self.path)?;
        work.recover()?;
        // It may have changed since it was first looked at.
        self.check()?;
        work.write(&self.files)?;
        if !work.swap()? {
            work.step_aside()?;
            work.step_in()?;
        }
        let kept = work.carry_over()?;
        Ok(Written { path: self.path, files: self.files.into_keys().collect(), kept })
    }

    /// Whether what stands there may be replaced.
    fn check(&self) -> Result<(), FolderError> {
        let path = self.path.clone();
        match verdict(&self.path)? {
            Verdict::Nothing | Verdict::Empty => Ok(()),
            Verdict::File => Err(FolderError::NotAFolder { path }),
            Verdict::Link => Err(FolderError::Link { path }),
            Verdict::Foreign => Err(FolderError::Foreign { path }),
            Verdict::Ours { additions } if additions.is_empty() || self.force => Ok(()),
            Verdict::Ours { additions } => Err(FolderError::Additions { path, files: additions }),
        }
    }
}

/// Whether a part of a file's name is one on every system. A line feed would end its
/// line in the list of files.
fn is_plain(part: &str) -> bool {
    let parts: Vec<Component<'_>> = Path::new(part).components().collect();
    matches!(parts[..], [Component::Normal(_)]) && !part.contains(['\n', '\\', ':'])
}

/// The folder that a path lies in.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Whether a folder that is not there yet could be made: by making one in the
/// nearest folder above that is.
fn try_to_write(missing: &Path) -> Result<(), FolderError> {
    let there = missing.ancestors().find(|p| p.symlink_metadata().is_ok());
    let there = there.unwrap_or(Path::new("."));
    if !there.is_dir() {
        return Err(FolderError::NotAFolder { path: there.to_owned() });
    }
    let probe = there.join(format!(".rodwright-{}", std::process::id()));
    fs::create_dir(&probe).and_then(|()| fs::remove_dir(&probe)).map_err(FolderError::io(there))
}

#[cfg(test)]
mod tests;
