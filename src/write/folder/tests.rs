use super::*;
use std::collections::BTreeSet;
use tempfile::TempDir;

fn place() -> (TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    (dir, out)
}

/// A folder with a file that holds `text`.
fn folder(out: &Path, force: bool, text: &str) -> Result<OutputFolder, FolderError> {
    let mut folder = OutputFolder::prepare(out, force)?;
    folder.add("structure.json", text).unwrap();
    folder.add("sheets/01.svg", "page").unwrap();
    Ok(folder)
}

fn write(out: &Path, force: bool, text: &str) -> Result<Written, FolderError> {
    folder(out, force, text)?.commit()
}

fn read(out: &Path) -> String {
    fs::read_to_string(out.join("structure.json")).unwrap()
}

/// Everything in a folder, without the list of files.
fn names(dir: &Path) -> BTreeSet<String> {
    fs::read_dir(dir)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|n| n != MANIFEST)
        .collect()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|n| (*n).to_owned()).collect()
}

/// The working folder of `out`, with all that is needed for a second folder in it.
fn work(out: &Path, text: &str) -> (Workplace, BTreeMap<String, Vec<u8>>) {
    let work = Workplace::enter(out).unwrap();
    (work, folder_files(text))
}

fn folder_files(text: &str) -> BTreeMap<String, Vec<u8>> {
    BTreeMap::from([("structure.json".to_owned(), text.into())])
}

#[test]
fn a_folder_is_made_and_replaced() {
    let (dir, out) = place();
    let written = write(&out, false, "one").unwrap();
    assert_eq!(written.files, ["sheets/01.svg", "structure.json"]);
    assert_eq!(read(&out), "one");
    let written = write(&out, false, "two").unwrap();
    assert_eq!((read(&out), written.kept), ("two".into(), vec![]));
    assert_eq!(names(dir.path()), set(&["out"]));
    assert_eq!(names(&out), set(&["sheets", "structure.json"]));
}

#[test]
fn missing_parents_are_made_only_when_it_is_written() {
    let (dir, _) = place();
    let out = dir.path().join("a/b/out");
    let folder = folder(&out, false, "x").unwrap();
    assert_eq!(names(dir.path()), set(&[]));
    folder.commit().unwrap();
    assert_eq!(read(&out), "x");
}

#[test]
fn an_empty_folder_is_taken() {
    let (dir, out) = place();
    fs::create_dir(&out).unwrap();
    write(&out, false, "x").unwrap();
    assert_eq!(names(dir.path()), set(&["out"]));
}

#[test]
fn a_run_that_fails_before_writing_leaves_nothing() {
    let (dir, out) = place();
    drop(folder(&out, false, "x").unwrap());
    assert_eq!(names(dir.path()), set(&[]));
    write(&out, false, "one").unwrap();
    drop(folder(&out, false, "two").unwrap());
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "one".into()));
}

#[test]
fn a_foreign_folder_is_never_replaced() {
    let (dir, out) = place();
    fs::create_dir(&out).unwrap();
    // One that looks like ours, but for the list.
    fs::write(out.join("structure.json"), r#"{"format": "rodwright-structure"}"#).unwrap();
    for force in [false, true] {
        let e = OutputFolder::prepare(&out, force).unwrap_err();
        assert!(matches!(e, FolderError::Foreign { .. }), "{e}");
    }
    // A list of somebody else's.
    fs::write(out.join(MANIFEST), "my rods").unwrap();
    assert!(matches!(OutputFolder::prepare(&out, true), Err(FolderError::Foreign { .. })));
    assert_eq!(names(dir.path()), set(&["out"]));
}

#[test]
fn files_and_links_are_refused() {
    let (dir, out) = place();
    fs::write(&out, "a letter").unwrap();
    assert!(matches!(OutputFolder::prepare(&out, true), Err(FolderError::NotAFolder { .. })));
    let e = OutputFolder::prepare(&out.join("below"), true).unwrap_err();
    assert_eq!(e.to_string(), format!("{} is a file", out.display()));
    for path in ["/", "..", "."] {
        let e = OutputFolder::prepare(Path::new(path), true).unwrap_err();
        assert!(matches!(e, FolderError::NoName { .. }), "{path}: {e}");
    }
    assert_eq!(names(dir.path()), set(&["out"]));
}

#[cfg(unix)]
#[test]
fn a_link_is_refused() {
    let (dir, out) = place();
    let real = dir.path().join("real");
    write(&real, false, "x").unwrap();
    std::os::unix::fs::symlink(&real, &out).unwrap();
    assert!(matches!(OutputFolder::prepare(&out, true), Err(FolderError::Link { .. })));
    fs::remove_dir_all(&real).unwrap();
    assert!(matches!(OutputFolder::prepare(&out, true), Err(FolderError::Link { .. })));
}

#[cfg(target_os = "linux")]
#[test]
fn a_place_without_permission_is_refused_before_any_work() {
    for out in ["/proc/out", "/proc/no/such/out"] {
        let e = OutputFolder::prepare(Path::new(out), false).unwrap_err();
        assert!(matches!(e, FolderError::Io { .. }), "{e}");
        assert!(e.to_string().starts_with("/proc"), "{e}");
    }
}

#[test]
fn additions_are_named_and_move_along_by_force() {
    let (_dir, out) = place();
    write(&out, false, "one").unwrap();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    fs::write(out.join("sheets/extra.svg"), "mine too").unwrap();
    fs::create_dir_all(out.join("photos/day 1")).unwrap();
    fs::write(out.join("photos/day 1/a.jpg"), "jpg").unwrap();
    let e = write(&out, false, "two").unwrap_err();
    assert!(e.to_string().ends_with("did not write: notes.txt, photos, sheets/extra.svg"), "{e}");
    assert_eq!(read(&out), "one");

    let written = write(&out, true, "two").unwrap();
    assert_eq!(written.kept, ["notes.txt", "photos", "sheets/extra.svg"].map(PathBuf::from));
    assert_eq!(read(&out), "two");
    assert_eq!(fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
    assert_eq!(fs::read_to_string(out.join("sheets/extra.svg")).unwrap(), "mine too");
    assert_eq!(fs::read_to_string(out.join("photos/day 1/a.jpg")).unwrap(), "jpg");
}

#[test]
fn a_changed_file_is_kept_beside_the_new_one() {
    let (_dir, out) = place();
    write(&out, false, "one").unwrap();
    for (i, name) in ["structure.json.kept", "structure.json.kept2"].iter().enumerate() {
        fs::write(out.join("structure.json"), format!("edited {i}")).unwrap();
        let e = write(&out, false, "two").unwrap_err();
        assert!(matches!(e, FolderError::Additions { .. }), "{e}");
        let written = write(&out, true, "two").unwrap();
        assert!(written.kept.contains(&PathBuf::from(name)), "{:?}", written.kept);
        assert_eq!(fs::read_to_string(out.join(name)).unwrap(), format!("edited {i}"));
        assert_eq!(read(&out), "two");
    }
    // A file of ours that went missing is no obstacle.
    for name in ["structure.json", "structure.json.kept", "structure.json.kept2"] {
        fs::remove_file(out.join(name)).unwrap();
    }
    write(&out, false, "three").unwrap();
}

#[test]
fn a_file_added_while_the_run_works_stops_it() {
    let (_dir, out) = place();
    write(&out, false, "one").unwrap();
    let folder = folder(&out, false, "two").unwrap();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    assert!(matches!(folder.commit(), Err(FolderError::Additions { .. })));
    assert_eq!(read(&out), "one");
}

#[test]
fn names_of_files_stay_inside() {
    let (_dir, out) = place();
    let mut folder = OutputFolder::prepare(&out, false).unwrap();
    for name in
        ["", "/etc/x", "../x", "a/../x", "./x", "a/./x", "a//x", "a/", MANIFEST, "a\nb", "a\\b"]
    {
        assert!(matches!(folder.add(name, ""), Err(FolderError::FileName { .. })), "{name:?}");
    }
    folder.add("a/b", "").unwrap();
    assert!(matches!(folder.add("a/b", ""), Err(FolderError::Twice { .. })));
}

#[test]
fn killed_while_writing_the_old_folder_stands() {
    let (dir, out) = place();
    write(&out, false, "one").unwrap();
    let (killed, files) = work(&out, "two");
    killed.write(&files).unwrap();
    killed.die();
    assert_eq!(read(&out), "one");
    OutputFolder::prepare(&out, false).unwrap();
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "one".into()));
}

#[test]
fn killed_between_the_renames_the_old_folder_comes_back() {
    let (dir, out) = place();
    write(&out, false, "one").unwrap();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    let (killed, files) = work(&out, "two");
    killed.write(&files).unwrap();
    killed.step_aside().unwrap();
    killed.die();
    assert!(!out.exists());
    // Even a run that may not replace it puts it back.
    assert!(matches!(OutputFolder::prepare(&out, false), Err(FolderError::Additions { .. })));
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "one".into()));
    assert_eq!(fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
}

#[test]
fn killed_after_the_renames_additions_still_move_along() {
    let (dir, out) = place();
    write(&out, false, "one").unwrap();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    let (killed, files) = work(&out, "two");
    killed.write(&files).unwrap();
    killed.step_aside().unwrap();
    killed.step_in().unwrap();
    killed.die();
    assert_eq!(names(&out), set(&["structure.json"]));
    OutputFolder::prepare(&out, true).unwrap();
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "two".into()));
    assert_eq!(fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
}

#[test]
fn killed_while_removing_the_rest_is_removed() {
    let (dir, out) = place();
    write(&out, false, "one").unwrap();
    let killed = Workplace::enter(&out).unwrap();
    let gone = dir.path().join(".out.rodwright/gone");
    fs::create_dir(&gone).unwrap();
    fs::write(gone.join("structure.json"), "zero").unwrap();
    killed.die();
    write(&out, false, "two").unwrap();
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "two".into()));
}

#[test]
fn a_place_taken_after_a_kill_is_left_alone_with_the_old_folder() {
    let (dir, out) = place();
    write(&out, false, "one").unwrap();
    let killed = Workplace::enter(&out).unwrap();
    killed.step_aside().unwrap();
    killed.die();
    fs::create_dir(&out).unwrap();
    fs::write(out.join("mine"), "").unwrap();
    assert!(matches!(OutputFolder::prepare(&out, true), Err(FolderError::Foreign { .. })));
    assert_eq!(read(&dir.path().join(".out.rodwright/old")), "one");
    fs::remove_dir_all(&out).unwrap();
    OutputFolder::prepare(&out, false).unwrap();
    assert_eq!(read(&out), "one");
}

#[test]
fn two_runs_take_turns() {
    let (dir, out) = place();
    let inside = Workplace::enter(&out).unwrap();
    std::thread::scope(|scope| {
        let second = scope.spawn(|| write(&out, false, "second"));
        std::thread::sleep(std::time::Duration::from_millis(100));
        assert!(!out.exists());
        drop(inside);
        second.join().unwrap().unwrap();
    });
    assert_eq!((names(dir.path()), read(&out)), (set(&["out"]), "second".into()));
}

#[test]
fn many_runs_at_once_leave_one_whole_folder() {
    let (dir, out) = place();
    std::thread::scope(|scope| {
        for i in 0..8 {
            let out = &out;
            scope.spawn(move || write(out, false, &format!("run {i}")).unwrap());
        }
    });
    assert!(read(&out).starts_with("run "));
    assert_eq!(names(dir.path()), set(&["out"]));
    assert!(matches!(verdict(&out), Ok(Verdict::Ours { additions }) if additions.is_empty()));
}
