//! The list of the files that rodwright wrote into a folder, and what it tells of
//! the folder.

use super::FolderError;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The name of the list.
pub(super) const MANIFEST: &str = ".rodwright";

/// Its first line.
const HEAD: &str = "rodwright output folder, version 1";

/// Names of files with the fingerprints of their bytes.
pub(super) struct Manifest {
    files: BTreeMap<String, String>,
}

impl Manifest {
    /// The list for files that are to be written.
    pub fn of(files: &BTreeMap<String, Vec<u8>>) -> Self {
        let entry = |(name, bytes): (&String, &Vec<u8>)| (name.clone(), fingerprint(bytes));
        Self { files: files.iter().map(entry).collect() }
    }

    /// The text of the list: a fingerprint, a space and a name a line.
    pub fn text(&self) -> String {
        let lines = self.files.iter().map(|(name, print)| format!("{print} {name}\n"));
        format!("{HEAD}\n{}", lines.collect::<String>())
    }

    /// Reads the list of a folder; `None` where there is none of ours.
    pub fn read(folder: &Path) -> Result<Option<Self>, FolderError> {
        let path = folder.join(MANIFEST);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
            // A folder of that name is not ours.
            Err(e) if e.kind() == io::ErrorKind::IsADirectory => return Ok(None),
            Err(e) => return Err(FolderError::io(&path)(e)),
        };
        let text = String::from_utf8_lossy(&bytes);
        let mut lines = text.lines();
        if lines.next() != Some(HEAD) {
            return Ok(None);
        }
        let entry = |line: &str| {
            let (print, name) = line.split_once(' ')?;
            Some((name.to_owned(), print.to_owned()))
        };
        Ok(Some(Self { files: lines.filter_map(entry).collect() }))
    }

    /// Whether a file is on the list, and as it was written.
    fn knows(&self, folder: &Path, name: &str) -> Result<bool, FolderError> {
        let Some(print) = self.files.get(name) else { return Ok(false) };
        let path = folder.join(name);
        let bytes = fs::read(&path).map_err(FolderError::io(&path))?;
        Ok(fingerprint(&bytes) == *print)
    }

    /// The files of the list that stand in the folder as they were written.
    pub fn unchanged(&self, folder: &Path) -> Result<BTreeMap<String, Vec<u8>>, FolderError> {
        let mut files = BTreeMap::new();
        for (name, print) in &self.files {
            let path = folder.join(name);
            match fs::read(&path) {
                Ok(bytes) if fingerprint(&bytes) == *print => {
                    drop(files.insert(name.clone(), bytes))
                }
                Ok(_) => {}
                Err(e) if e.kind() == io::ErrorKind::NotFound => {}
                Err(e) => return Err(FolderError::io(&path)(e)),
            }
        }
        Ok(files)
    }

    /// All folders above the files of the list.
    fn folders(&self) -> BTreeSet<&str> {
        let above = |name| Path::new(name).ancestors().skip(1).filter_map(Path::to_str);
        self.files.keys().flat_map(above).filter(|f| !f.is_empty()).collect()
    }
}

/// FNV-1a, 64 bits, and the length: it tells a changed file, not a forged one.
fn fingerprint(bytes: &[u8]) -> String {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    let hash = bytes.iter().fold(OFFSET, |h, &b| (h ^ u64::from(b)).wrapping_mul(PRIME));
    format!("{hash:016x}-{:x}", bytes.len())
}

/// What stands at the place of an output folder.
#[derive(PartialEq, Debug)]
pub(super) enum Verdict {
    /// Nothing.
    Nothing,
    /// A folder without anything in it.
    Empty,
    /// A file or a device.
    File,
    /// A symbolic link.
    Link,
    /// A folder that is not ours.
    Foreign,
    /// A folder of ours.
    Ours {
        /// Files and folders in it that are not ours, and files that were changed.
        additions: Vec<PathBuf>,
    },
}

/// Looks at the place of an output folder.
pub(super) fn verdict(path: &Path) -> Result<Verdict, FolderError> {
    let kind = match path.symlink_metadata() {
        Ok(meta) => meta.file_type(),
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Verdict::Nothing),
        Err(e) => return Err(FolderError::io(path)(e)),
    };
    if kind.is_symlink() {
        return Ok(Verdict::Link);
    }
    if !kind.is_dir() {
        return Ok(Verdict::File);
    }
    if let Some(manifest) = Manifest::read(path)? {
        let mut additions = Vec::new();
        collect(path, "", &manifest, &manifest.folders(), &mut additions)?;
        additions.sort();
        return Ok(Verdict::Ours { additions });
    }
    let empty = fs::read_dir(path).map_err(FolderError::io(path))?.next().is_none();
    Ok(if empty { Verdict::Empty } else { Verdict::Foreign })
}

/// Gathers what is not ours in a folder, `inner` being its path from the top. A
/// folder that we did not make is one addition, whatever is in it.
fn collect(
    top: &Path,
    inner: &str,
    manifest: &Manifest,
    folders: &BTreeSet<&str>,
    additions: &mut Vec<PathBuf>,
) -> Result<(), FolderError> {
    let here = top.join(inner);
    for entry in fs::read_dir(&here).map_err(FolderError::io(&here))? {
        let entry = entry.map_err(FolderError::io(&here))?;
        let kind = entry.file_type().map_err(FolderError::io(&entry.path()))?;
        let Ok(name) = entry.file_name().into_string() else {
            // A name that is not text cannot be on the list.
            additions.push(Path::new(inner).join(entry.file_name()));
            continue;
        };
        let name = if inner.is_empty() { name } else { format!("{inner}/{name}") };
        if kind.is_dir() && folders.contains(name.as_str()) {
            collect(top, &name, manifest, folders, additions)?;
        } else if name != MANIFEST && !(kind.is_file() && manifest.knows(top, &name)?) {
            additions.push(name.into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingerprints_are_those_of_fnv() {
        // Test vectors of the authors of FNV-1a.
        assert_eq!(fingerprint(b""), "cbf29ce484222325-0");
        assert_eq!(fingerprint(b"foobar"), "85944171f73967e8-6");
    }

    #[test]
    fn folders_are_all_those_above_the_files() {
        let files = BTreeMap::from([("a/b/c.svg".to_owned(), vec![]), ("d".to_owned(), vec![])]);
        let manifest = Manifest::of(&files);
        assert_eq!(manifest.folders(), BTreeSet::from(["a", "a/b"]));
    }
}
