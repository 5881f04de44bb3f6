//! Bad input gets a sentence, never a panic, and never a folder.

use crate::run::{rodwright, sample, snapshot};
use std::path::Path;
use tempfile::tempdir;

/// Runs `build` on a file and returns exit status and message; nothing may be written.
fn refused(dir: &Path, args: &[&str]) -> (i32, String) {
    let before = std::fs::read_dir(dir).unwrap().count();
    let output = rodwright(dir).arg("build").args(args).args(["-o", "out"]).output().unwrap();
    assert_eq!(std::fs::read_dir(dir).unwrap().count(), before, "{args:?} left something behind");
    let message = String::from_utf8(output.stderr).unwrap();
    (output.status.code().expect("an exit status, not a signal"), message)
}

const TRIANGLE: &str = "v 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n";

#[test]
fn broken_surfaces_are_refused_with_a_reason() {
    let igloo = std::fs::read_to_string(sample("igloo.obj")).unwrap();
    let tetrahedron =
        "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let cases = [
        ("empty.obj", String::new(), 1, "empty"),
        ("text.obj", "Dear builder,\nthis is a letter.\n".into(), 1, ""),
        ("truncated.obj", igloo[..igloo.len() / 2].into(), 1, ""),
        ("nan.obj", TRIANGLE.replace("v 100", "v nan"), 1, "nan"),
        ("infinite.obj", TRIANGLE.replace("v 100", "v 1e999"), 1, ""),
        ("index.obj", TRIANGLE.replace("f 1 2 3", "f 1 2 9"), 1, "9"),
        ("flat.obj", TRIANGLE.replace("0 100 0", "50 0 0"), 1, ""),
        ("closed.obj", tetrahedron.into(), 1, "closed"),
        ("pieces.obj", two_pieces(), 1, "piece"),
        ("fan.obj", three_on_an_edge(), 1, "edge"),
        ("small.obj", TRIANGLE.into(), 1, "--"),
    ];
    for (name, text, status, word) in cases {
        let dir = tempdir().unwrap();
        std::fs::write(dir.path().join(name), text).unwrap();
        let (code, message) = refused(dir.path(), &[name]);
        assert_eq!(code, status, "{name}: {message}");
        assert!(message.starts_with("error: ") && message.len() > 30, "{name}: {message}");
        assert!(message.to_lowercase().contains(word), "{name}: {message}");
    }
}

fn two_pieces() -> String {
    format!("{TRIANGLE}v 500 0 0\nv 600 0 0\nv 500 100 0\nf 4 5 6\n")
}

fn three_on_an_edge() -> String {
    "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 -100 0\nv 0 0 100\nf 1 2 3\nf 2 1 4\nf 1 2 5\n".into()
}

#[test]
fn a_missing_file_is_a_file_error() {
    let dir = tempdir().unwrap();
    let (code, message) = refused(dir.path(), &["nowhere.obj"]);
    assert_eq!(code, 3);
    assert!(message.contains("nowhere.obj"), "{message}");
}

#[test]
fn truncated_and_lying_binary_models_are_refused() {
    let dir = tempdir().unwrap();
    rodwright(dir.path()).args(["build", &sample("igloo.obj"), "-o", "kept"]).assert().success();
    let glb = std::fs::read(dir.path().join("kept/model.glb")).unwrap();
    for (name, bytes) in [
        ("half.glb", glb[..glb.len() / 2].to_vec()),
        ("head.glb", glb[..12].to_vec()),
        ("long.glb", [&glb[..8], &[0xff; 4], &glb[12..]].concat()),
    ] {
        std::fs::write(dir.path().join(name), bytes).unwrap();
        let (code, message) = refused(dir.path(), &[name]);
        assert_eq!(code, 1, "{name}: {message}");
        assert!(message.contains(name), "{message}");
    }
    // A whole frame is many closed rods: read well, but no surface.
    let (code, message) = refused(dir.path(), &["kept/model.glb"]);
    assert_eq!(code, 1);
    assert!(message.contains("closed"), "{message}");
}

#[test]
fn settings_out_of_bounds_are_named() {
    let dir = tempdir().unwrap();
    let igloo = sample("igloo.obj");
    for (args, status, word) in [
        (&["--rod", "0mm"][..], 1, "rod"),
        (&["--rod", "three"], 2, "three"),
        (&["--rod", "3 furlongs"], 2, "furlongs"),
        (&["--span=-1m"], 1, "span"),
        (&["--pattern", "5.5.5.5"], 1, "4.4.4.4"),
        (&["--turn", "80deg"], 1, "degrees"),
        (&["--rod", "80mm"], 1, "at most"),
        (&["--rod", "0.0004mm"], 1, "at least"),
        (&["--rod", "0.001mm", "--unit", "0.01mm"], 1, "larger units"),
        (&["--unit", "2m"], 1, "--unit"),
        (&["--unit", "7mm"], 1, "an edge of at least 1"),
        (&["--unit", "12mm"], 1, "--unit"),
        (&["--stock", "50mm"], 1, "R0"),
        (&["--stock", "1000mm x 3"], 1, "10.48 m in all"),
        (&["--stock", "1000mm x 0"], 2, "is no count"),
        (&["--stock", "1000mm @ -1"], 2, "is no price"),
        (&["--stock", "1000mm @ 1,2000mm"], 1, "bars of 2000 mm have no price"),
        (&["--offcuts", "0x430mm"], 2, "is no count"),
        (&["--stock", "1000mm", "--trim", "500mm"], 1, "leaves nothing of bars of 1000 mm"),
        (&["--trim=-1mm"], 1, "trim"),
        (&["--keep", "0mm"], 1, "keep"),
        (&["--density", "0"], 1, "density"),
        (&["--classes", "0"], 1, "classes"),
        (&["--class-tolerance=-1mm"], 1, "class_tolerance"),
        (&["--classes", "3", "--class-tolerance", "1mm"], 2, "cannot be used with"),
        (&["--origin", "1mm"], 1, "origin"),
        (&["--paper", "napkin"], 2, "a4"),
        (&["--only", "cake"], 2, "cake"),
        (&["--colour", "red"], 2, "--color"),
    ] {
        let mut all = vec![igloo.as_str()];
        all.extend(args);
        let (code, message) = refused(dir.path(), &all);
        assert_eq!(code, status, "{args:?}: {message}");
        assert!(message.to_lowercase().contains(&word.to_lowercase()), "{args:?}: {message}");
    }
}

#[test]
fn unknown_keys_of_a_design_are_named() {
    let dir = tempdir().unwrap();
    std::fs::write(dir.path().join("d.toml"), "rod = \"3mm\"\nspam = 4\n").unwrap();
    let (code, message) = refused(dir.path(), &["--design", "d.toml"]);
    assert_eq!(code, 1);
    assert!(message.contains("spam") && message.contains("d.toml"), "{message}");
    let (code, message) = refused(dir.path(), &["--design", "none.toml"]);
    assert_eq!((code, message.contains("none.toml")), (3, true));
}

#[test]
fn folders_of_others_are_never_replaced() {
    let dir = tempdir().unwrap();
    let out = dir.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("thesis.txt"), "ten years").unwrap();
    for force in [&[][..], &["--force"]] {
        let (code, message) =
            refused(dir.path(), &[&[sample("igloo.obj").as_str()], force].concat());
        assert_eq!(code, 3, "{message}");
        assert_eq!(std::fs::read_to_string(out.join("thesis.txt")).unwrap(), "ten years");
    }
}

#[test]
fn a_run_that_fails_leaves_the_earlier_folder_as_it_was() {
    let dir = tempdir().unwrap();
    rodwright(dir.path()).args(["build", &sample("igloo.obj"), "-o", "out"]).assert().success();
    let before = snapshot(&dir.path().join("out"));
    let (code, _) = refused(dir.path(), &[&sample("igloo.obj"), "--rod", "80mm"]);
    assert_eq!(code, 1);
    assert!(snapshot(&dir.path().join("out")) == before);
}

/// Stops the program without warning at many moments, the writing among them.
#[cfg(unix)]
#[test]
fn a_run_that_is_killed_leaves_a_whole_folder() {
    let dir = tempdir().unwrap();
    let igloo = sample("igloo.obj");
    let build = |rod: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_rodwright"));
        command.current_dir(dir.path()).args(["build", &igloo, "-o", "out", "-q", "--rod", rod]);
        command
    };
    let whole = |rod: &str| {
        assert!(build(rod).status().unwrap().success());
        snapshot(&dir.path().join("out"))
    };
    let start = std::time::Instant::now();
    let (thick, thin) = (whole("3.2mm"), whole("3mm"));
    let one_run = start.elapsed() / 2;
    for i in 0..24u32 {
        let mut child = build("3.2mm").spawn().unwrap();
        std::thread::sleep(one_run * (i + 4) / 24);
        // It may have ended by itself, which is as good.
        let _ = child.kill();
        child.wait().unwrap();
        let found = snapshot(&dir.path().join("out"));
        assert!(found == thin || found == thick, "run {i} left a folder that is neither");
        if found == thick {
            assert!(snapshot_after(&build, "3mm", dir.path()) == thin);
        }
    }
    assert!(snapshot_after(&build, "3mm", dir.path()) == thin);
    let left: Vec<_> = std::fs::read_dir(dir.path()).unwrap().map(|e| e.unwrap().path()).collect();
    assert_eq!(left, [dir.path().join("out")], "the next run cleans up");
}

#[cfg(unix)]
fn snapshot_after(
    build: &dyn Fn(&str) -> std::process::Command,
    rod: &str,
    dir: &Path,
) -> std::collections::BTreeMap<String, Vec<u8>> {
    assert!(build(rod).status().unwrap().success());
    snapshot(&dir.join("out"))
}
