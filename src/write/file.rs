//! Puts a single file in its place whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Writes a file beside its place and moves it there when it is complete: a run that
/// fails leaves an earlier file as it was. A link is followed; a device or a pipe is
/// written to as it stands.
///
/// # Errors
/// What the system says.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let place = match fs::metadata(path) {
        Ok(found) if !found.is_file() => return fs::write(path, bytes),
        Ok(_) => path.canonicalize()?,
        Err(_) => path.to_owned(),
    };
    let mut name = OsString::from(".");
    name.push(place.file_name().unwrap_or_default());
    // Two runs at a time do not write to one file.
    name.push(format!(".rodwright-{}", std::process::id()));
    let beside = place.with_file_name(name);
    let written = write_through(&beside, bytes).and_then(|()| fs::rename(&beside, &place));
    if written.is_err() {
        // The first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written
}

fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<OsString> {
        fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").file_name()).collect()
    }

    #[test]
    fn a_file_is_replaced_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.stl");
        for content in [&b"one"[..], b"another"] {
            replace(&file, content).expect("written");
            assert_eq!(fs::read(&file).expect("there"), content);
        }
        assert_eq!(names(folder.path()), ["a.stl"]);
    }

    #[test]
    fn what_cannot_be_written_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("out")).expect("a folder");
        assert!(replace(&folder.path().join("out"), b"x").is_err(), "a folder is in the place");
        assert!(replace(&folder.path().join("none/a.stl"), b"x").is_err());
        assert_eq!(names(folder.path()), ["out"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices_stay() {
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("a.stl"), folder.path().join("b.stl"));
        fs::write(&file, "old").expect("written");
        std::os::unix::fs::symlink("a.stl", &link).expect("a link");
        replace(&link, b"new").expect("written");
        assert_eq!(fs::read(&file).expect("there"), b"new");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        replace(Path::new("/dev/null"), b"gone").expect("written");
        assert!(!fs::metadata("/dev/null").expect("there").is_file());
    }
}
