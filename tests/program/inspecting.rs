//! What `inspect` tells about surfaces.

use crate::run::{rodwright, sample};
use std::path::Path;
use tempfile::tempdir;

/// Exit status, standard output and standard error of `inspect`.
fn inspect(dir: &Path, args: &[&str]) -> (i32, String, String) {
    let output = rodwright(dir).arg("inspect").args(args).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The value of a row.
fn row<'a>(page: &'a str, label: &str) -> &'a str {
    let line = page.lines().find(|l| l.trim_start().starts_with(label));
    line.unwrap_or_else(|| panic!("no {label} in\n{page}")).trim_start()[label.len()..].trim()
}

/// A closed cube and, at its side, a sheet of one triangle with the larger number.
const CUBE_AND_SHEET: &str = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 10 10 0\n\
    v 0 0 10\nv 10 0 10\nv 0 10 10\nv 10 10 10\n\
    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n\
    v 50 0 0\nv 60 0 0\nv 50 0 8\nf 9 10 11\n";

#[test]
fn a_surface_is_measured_and_found_ready() {
    let dir = tempdir().unwrap();
    let (status, page, _) = inspect(dir.path(), &[&sample("igloo.obj")]);
    assert_eq!(status, 0);
    assert_eq!(row(&page, "triangles"), "5183");
    assert_eq!(row(&page, "size"), "599.9 × 600.0 × 220.0 mm");
    assert_eq!(row(&page, "heights"), "0.0 to 220.0 mm");
    assert!(page.contains("1       5183      1      0"), "{page}");
    assert!(page.contains("ready"), "{page}");
}

#[test]
fn what_cannot_be_used_is_told_with_the_options_that_help() {
    let dir = tempdir().unwrap();
    std::fs::write(dir.path().join("two.obj"), CUBE_AND_SHEET).unwrap();
    let (status, page, _) = inspect(dir.path(), &["two.obj"]);
    assert_eq!(status, 0, "to tell is no failure");
    for word in ["(closed)", "(one border)", "not yet", "--component largest", "--cut z=30%"] {
        assert!(page.contains(word), "{word} is not in\n{page}");
    }
    // Each option is followed, and the other advice stays.
    let (_, page, _) = inspect(dir.path(), &["two.obj", "--component", "largest"]);
    assert!(page.contains("--cut z=30%") && !page.contains("to do          keep one"), "{page}");
    let (_, page, _) = inspect(dir.path(), &["two.obj", "--cut", "z=0"]);
    assert!(page.contains("largest (piece 1)") && !page.contains("--cut z=30%"), "{page}");
    let (_, page, _) = inspect(dir.path(), &["two.obj", "--cut", "z=50%", "--component", "1"]);
    assert_eq!(row(&page, "after"), "--cut z=50% --component 1");
    assert_eq!(row(&page, "heights"), "5.0 to 10.0 mm");
    assert!(page.contains("ready"), "{page}");
    // Above the sheet only the cube is left.
    let (_, page, _) = inspect(dir.path(), &["two.obj", "--cut", "z=9mm"]);
    assert!(page.contains("ready"), "{page}");
    let (_, page, _) = inspect(dir.path(), &["two.obj", "--up", "x", "--cut", "z=90%"]);
    assert_eq!(row(&page, "heights"), "54.0 to 60.0 mm");
}

#[test]
fn options_that_cannot_be_followed_are_refused() {
    let dir = tempdir().unwrap();
    std::fs::write(dir.path().join("two.obj"), CUBE_AND_SHEET).unwrap();
    for (args, status, word) in [
        (&["--cut", "z=11"][..], 1, "reaches from 0 to 10 mm"),
        (&["--component", "3"], 1, "has 2 pieces"),
        (&["--cut", "z=9mm", "--component", "2"], 1, "has 1 piece"),
        (&["--cut", "120mm"], 2, "z=120mm"),
        (&["--component", "0"], 2, "largest"),
        (&["--up", "w"], 2, "x, y or z"),
        (&["--rod", "R001"], 2, "two.obj is a surface"),
        (&["--contact", "C0001"], 2, "--contact"),
        (&["--unit", "U001"], 2, "--unit"),
    ] {
        let (found, page, message) = inspect(dir.path(), &[&["two.obj"], args].concat());
        assert_eq!((found, page.as_str()), (status, ""), "{args:?}: {message}");
        assert!(message.starts_with("error: ") && message.contains(word), "{args:?}: {message}");
    }
    for (file, text, status) in [
        ("none.obj", None, 3),
        ("letter.txt", Some("Dear builder,"), 1),
        ("empty.obj", Some(""), 1),
        ("half.json", Some("{\"format\": \"rodwright-str"), 3),
        ("half.gltf", Some("{\"asset\": {\"version\""), 1),
        ("other.json", Some("{\"name\": \"rodwright\"}"), 3),
    ] {
        if let Some(text) = text {
            std::fs::write(dir.path().join(file), text).unwrap();
        }
        let (found, page, message) = inspect(dir.path(), &[file]);
        assert_eq!((found, page.as_str()), (status, ""), "{file}: {message}");
        assert!(message.contains(file), "{message}");
    }
}

#[test]
fn a_gltf_document_is_a_surface_whatever_its_name() {
    let dir = tempdir().unwrap();
    let convert = ["convert", &sample("igloo.obj"), "dome.json", "--to", "gltf"];
    rodwright(dir.path()).args(convert).assert().success();
    let (status, page, message) = inspect(dir.path(), &["dome.json"]);
    assert_eq!(status, 0, "{message}");
    assert!(page.contains("ready"), "{page}");
    assert!(row(&page, "axes").contains("y up"), "{page}");
    assert_eq!(row(&page, "size"), "599.9 × 600.0 × 220.0 mm");
}

#[test]
fn a_structure_takes_no_options_of_surfaces() {
    let dir = tempdir().unwrap();
    let build = ["build", &sample("igloo.obj"), "-o", "out", "--only", "structure", "-q"];
    rodwright(dir.path()).args(build).assert().success();
    for path in ["out", "out/structure.json"] {
        assert!(inspect(dir.path(), &[path]).1.starts_with("Structure"));
        let (status, _, message) = inspect(dir.path(), &[path, "--cut", "z=40%"]);
        assert_eq!(status, 2);
        assert!(message.contains("--cut is for surfaces"), "{message}");
    }
}
