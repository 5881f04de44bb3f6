//! The working folder beside an output folder, and the steps that replace the one by
//! way of the other.

use super::FolderError;
use super::manifest::{MANIFEST, Manifest, Verdict, verdict};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How long a run waits for another one that writes the same folder. Writing takes
/// seconds at most; longer, and the other one hangs.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time between two looks.
const PAUSE: Duration = Duration::from_millis(20);

/// A working folder, locked. Leaving it removes it, unless it holds what the next
/// run needs.
pub(super) struct Workplace {
    target: PathBuf,
    folder: PathBuf,
    /// Held as long as it is open.
    _lock: Option<File>,
}

impl Workplace {
    /// Makes the working folder of `target`, or takes over one that was left, and
    /// locks it.
    pub fn enter(target: &Path) -> Result<Self, FolderError> {
        let mut name = OsString::from(".");
        name.push(target.file_name().unwrap_or_default());
        name.push(".rodwright");
        let folder = target.with_file_name(name);
        let begun = Instant::now();
        loop {
            // Messages name the folder that the user knows.
            match try_lock(&folder).map_err(FolderError::io(target))? {
                Attempt::Entered(_lock) => {
                    return Ok(Self { target: target.to_owned(), folder, _lock });
                }
                Attempt::Again if begun.elapsed() < PATIENCE => sleep(PAUSE),
                Attempt::Again => return Err(FolderError::Busy { path: target.to_owned() }),
            }
        }
    }

    fn place(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Mends what a killed run left: see the [module](super).
    pub fn recover(&self) -> Result<(), FolderError> {
        self.remove("new")?;
        self.remove("gone")?;
        let old = self.place("old");
        if !exists(&old) {
            return Ok(());
        }
        match verdict(&self.target)? {
            Verdict::Nothing => self.rename(&old, &self.target),
            Verdict::Empty => {
                fs::remove_dir(&self.target).map_err(FolderError::io(&self.target))?;
                self.rename(&old, &self.target)
            }
            Verdict::Ours { .. } => self.carry_over().map(|_| ()),
            // Somebody took the place meanwhile: the old folder waits.
            Verdict::File | Verdict::Link | Verdict::Foreign => Ok(()),
        }
    }

    /// Step 1: writes all files, and the list of them.
    pub fn write(&self, files: &BTreeMap<String, Vec<u8>>) -> Result<(), FolderError> {
        let new = self.place("new");
        fs::create_dir(&new).map_err(FolderError::io(&new))?;
        let list = Manifest::of(files).text();
        let all = files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
        for (name, bytes) in all.chain([(MANIFEST, list.as_bytes())]) {
            let path = new.join(name);
            let folder = path.parent().unwrap_or(&new);
            fs::create_dir_all(folder).map_err(FolderError::io(folder))?;
            write_through(&path, bytes).map_err(FolderError::io(&path))?;
        }
        flush_folders(&new).map_err(FolderError::io(&new))
    }

    /// Steps 2 and 3 at once, where the system can: the new folder and the one that
    /// stands in the place change places. Tells whether it did.
    ///
    /// The new folder waits under the name `old` for it: so a run killed before finds
    /// nothing to do but to remove it, and one killed after finds the old folder there.
    #[cfg(target_os = "linux")]
    pub fn swap(&self) -> Result<bool, FolderError> {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        if !matches!(verdict(&self.target)?, Verdict::Ours { .. }) {
            return Ok(false);
        }
        let (new, old) = (self.place("new"), self.place("old"));
        self.rename(&new, &old)?;
        let swapped = renameat_with(CWD, &old, CWD, &self.target, RenameFlags::EXCHANGE).is_ok();
        if swapped {
            flush_folder(&self.folder).map_err(FolderError::io(&self.folder))?;
        } else {
            self.rename(&old, &new)?;
        }
        Ok(swapped)
    }

    /// Other systems have no such call in the standard library.
    #[cfg(not(target_os = "linux"))]
    pub fn swap(&self) -> Result<bool, FolderError> {
        Ok(false)
    }

    /// Step 2: takes away what stands in the place.
    pub fn step_aside(&self) -> Result<(), FolderError> {
        match verdict(&self.target)? {
            Verdict::Nothing => Ok(()),
            Verdict::Empty => fs::remove_dir(&self.target).map_err(FolderError::io(&self.target)),
            _ => self.rename(&self.target, &self.place("old")),
        }
    }

    /// Step 3: puts the new folder in the place, or else the old one back.
    pub fn step_in(&self) -> Result<(), FolderError> {
        let result = self.rename(&self.place("new"), &self.target);
        let old = self.place("old");
        if result.is_err() && exists(&old) {
            self.rename(&old, &self.target)?;
        }
        result
    }

    /// Steps 4 and 5: moves what is not ours to the new folder, and removes the rest.
    /// Returns the moved files by their names in the new folder.
    pub fn carry_over(&self) -> Result<Vec<PathBuf>, FolderError> {
        let old = self.place("old");
        let mut kept = Vec::new();
        // Not ours any more is only what somebody changed by hand: it stays there.
        let Verdict::Ours { additions } = verdict(&old)? else { return Ok(kept) };
        for name in additions {
            let free = free_name(&name, &self.target, &old);
            let to = self.target.join(&free);
            let folder = to.parent().unwrap_or(&self.target);
            fs::create_dir_all(folder).map_err(FolderError::io(folder))?;
            self.rename(&old.join(&name), &to)?;
            kept.push(free);
        }
        // In one step: half removed, it would not be known as ours.
        self.rename(&old, &self.place("gone"))?;
        self.remove("gone")?;
        Ok(kept)
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), FolderError> {
        fs::rename(from, to).map_err(FolderError::io(from))?;
        for folder in [&self.folder, super::parent(&self.target)] {
            flush_folder(folder).map_err(FolderError::io(folder))?;
        }
        Ok(())
    }

    fn remove(&self, name: &str) -> Result<(), FolderError> {
        let path = self.place(name);
        if exists(&path) {
            fs::remove_dir_all(&path).map_err(FolderError::io(&path))
        } else {
            Ok(())
        }
    }

    /// Leaves as a killed process does: the lock goes, all else stays.
    #[cfg(test)]
    pub fn die(mut self) {
        self._lock = None;
        std::mem::forget(self);
    }
}

impl Drop for Workplace {
    /// What cannot be removed now is removed by the next run: hence no errors.
    fn drop(&mut self) {
        let _ = self.remove("new");
        let _ = self.remove("gone");
        if !exists(&self.place("old")) {
            let _ = fs::remove_file(self.place("lock"));
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

enum Attempt {
    /// The folder is ours; without a lock where the file system has none.
    Entered(Option<File>),
    /// Somebody else is in it, or was a moment ago.
    Again,
}

fn try_lock(folder: &Path) -> io::Result<Attempt> {
    match fs::create_dir(folder) {
        Err(e) if e.kind() != io::ErrorKind::AlreadyExists => return Err(e),
        _ => {}
    }
    match folder.symlink_metadata() {
        Ok(meta) if meta.is_dir() => {}
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Attempt::Again),
        Err(e) => return Err(e),
        Ok(_) => {
            let taken = format!("{} is not a folder", folder.display());
            return Err(io::Error::new(io::ErrorKind::NotADirectory, taken));
        }
    }
    let path = folder.join("lock");
    let file = match OpenOptions::new().create(true).write(true).truncate(false).open(&path) {
        // Its last user removed the folder between the two calls.
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Attempt::Again),
        file => file?,
    };
    match file.try_lock() {
        Ok(()) if is_at(&file, &path)? => Ok(Attempt::Entered(Some(file))),
        Ok(()) | Err(TryLockError::WouldBlock) => Ok(Attempt::Again),
        Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => {
            Ok(Attempt::Entered(None))
        }
        Err(TryLockError::Error(e)) => Err(e),
    }
}

/// Whether an open file is still the one at its path: its last user may have removed
/// it, and another one made it anew.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let open = file.metadata()?;
    Ok(fs::metadata(path).is_ok_and(|m| (m.dev(), m.ino()) == (open.dev(), open.ino())))
}

/// Whether there is still a file: an open one cannot be replaced here.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> io::Result<bool> {
    path.try_exists()
}

/// Whether anything is there, a dangling link too.
fn exists(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

/// The name itself, or with `.kept`, `.kept2` … where the new folder has one like it;
/// not one that waits in the old folder for its turn.
fn free_name(name: &Path, new: &Path, old: &Path) -> PathBuf {
    let with = |suffix: String| {
        let mut text = name.as_os_str().to_owned();
        text.push(suffix);
        PathBuf::from(text)
    };
    let mut others = (1_u32..).map(|i| match i {
        1 => with(".kept".to_owned()),
        _ => with(format!(".kept{i}")),
    });
    if exists(&new.join(name)) {
        let free = others.find(|n| !exists(&new.join(n)) && !exists(&old.join(n)));
        return free.unwrap_or_else(|| name.to_owned());
    }
    name.to_owned()
}

fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Flushes the entries of a folder and of all folders in it.
fn flush_folders(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            flush_folders(&entry.path())?;
        }
    }
    flush_folder(folder)
}

/// Flushes the entries of a folder, where the system does that.
#[cfg(unix)]
fn flush_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        // Some file systems do not know it for folders.
        Err(e) if e.kind() == io::ErrorKind::InvalidInput => Ok(()),
        result => result,
    }
}

#[cfg(not(unix))]
fn flush_folder(_: &Path) -> io::Result<()> {
    Ok(())
}
