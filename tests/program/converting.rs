//! Surfaces and structures in other formats.

use crate::run::{rodwright, sample, structure};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

fn convert(dir: &Path, args: &[&str]) {
    rodwright(dir).arg("convert").args(args).assert().success().stdout("").stderr("");
}

/// Exit status and message of a `convert` that must not write anything.
fn refused(dir: &Path, args: &[&str]) -> (i32, String) {
    let before = fs::read_dir(dir).unwrap().count();
    let output = rodwright(dir).arg("convert").args(args).output().unwrap();
    assert_eq!(fs::read_dir(dir).unwrap().count(), before, "{args:?} left something behind");
    assert!(output.stdout.is_empty(), "{args:?}");
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

fn read(dir: &Path, file: &str) -> Vec<u8> {
    fs::read(dir.join(file)).unwrap()
}

#[test]
fn a_surface_goes_through_every_format_that_is_read_and_comes_back() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    let igloo = sample("igloo.obj");
    convert(dir, &[&igloo, "first.obj"]);
    assert!(read(dir, "first.obj") == fs::read(&igloo).unwrap(), "six digits are all it has");
    convert(dir, &[&igloo, "dome.glb"]);
    convert(dir, &["dome.glb", "dome.gltf"]);
    convert(dir, &["dome.gltf", "again.GLB"]);
    assert!(read(dir, "dome.glb") == read(dir, "again.GLB"));
    convert(dir, &["dome.gltf", "second.obj"]);
    let faces = |file: &str| {
        let text = String::from_utf8(read(dir, file)).unwrap();
        text.lines().filter(|l| l.starts_with('f')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(faces("first.obj"), faces("second.obj"));
}

#[test]
fn the_ending_or_the_option_names_the_format() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    let igloo = sample("igloo.obj");
    for (args, start) in [
        (&["a.stl"][..], &b"binary STL"[..]),
        (&["a.bin", "--to", "stl-ascii"], b"solid "),
        (&["a.ply"], b"ply\nformat binary_little_endian 1.0\n"),
        (&["a.ply", "--to", "ply-ascii"], b"ply\nformat ascii 1.0\n"),
        (&["a.off"], b"OFF\n"),
        (&["a.off", "--to", "obj"], b"# millimetres, z up\nv "),
        (&["a.glb"], b"glTF\x02\0\0\0"),
        (&["a.gltf"], b"{"),
        (&["a.dxf"], b"  0\nSECTION\n  2\nHEADER\n"),
    ] {
        convert(dir, &[&[igloo.as_str()], args].concat());
        assert!(read(dir, args[0]).starts_with(start), "{args:?}");
    }
    let output = rodwright(dir).args(["convert", &igloo, "-", "--to", "off"]).output().unwrap();
    convert(dir, &[&igloo, "b.off"]);
    assert!(output.status.success() && output.stdout == read(dir, "b.off"));
}

#[test]
fn a_surface_is_cut_on_the_way() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    convert(dir, &[&sample("igloo.obj"), "cap.obj", "--cut", "z=110", "--component", "1"]);
    let text = String::from_utf8(read(dir, "cap.obj")).unwrap();
    let heights: Vec<f64> = text
        .lines()
        .filter_map(|l| l.strip_prefix("v ")?.split(' ').nth(2)?.parse().ok())
        .collect();
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(lowest, 110.0);
}

#[test]
fn a_structure_becomes_its_rods() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    let build = ["build", &sample("igloo.obj"), "-o", "out", "--only", "structure,glb", "-q"];
    rodwright(dir).args(build).assert().success();
    let rods = structure(&dir.join("out"))["rods"].as_array().unwrap().len();
    convert(dir, &["out", "rods.glb"]);
    assert!(read(dir, "rods.glb") == read(dir, "out/model.glb"));
    convert(dir, &["out/structure.json", "rods.obj"]);
    let text = String::from_utf8(read(dir, "rods.obj")).unwrap();
    assert_eq!(text.lines().filter(|l| l.starts_with("o R")).count(), rods);
    convert(dir, &["out", "rods.stl"]);
    assert_eq!((read(dir, "rods.stl").len() - 84) / 50 % rods, 0);
    // The rods are read back as so many closed pieces.
    let output = rodwright(dir).args(["inspect", "rods.obj"]).output().unwrap();
    let page = String::from_utf8(output.stdout).unwrap();
    assert!(page.contains(&format!("and {} smaller pieces", rods - 12)), "{page}");
    assert!(page.contains("(closed)"), "{page}");
    convert(dir, &["out", "rods.dxf"]);
    let text = String::from_utf8(read(dir, "rods.dxf")).unwrap();
    assert_eq!(text.lines().filter(|l| *l == "LINE").count(), rods);
    convert(dir, &["out", "rods.ply"]);
    convert(dir, &["out", "rods.off"]);
    let [ply, off] =
        ["rods.ply", "rods.off"].map(|f| String::from_utf8_lossy(&read(dir, f)).into_owned());
    let [vertices, faces] = [48 * rods, 92 * rods];
    assert!(ply.contains(&format!("element vertex {vertices}\n")));
    assert!(ply.contains(&format!("element face {faces}\n")));
    assert!(off.starts_with(&format!("OFF\n{vertices} {faces} ")));
    convert(dir, &["out", "rods.gltf"]);
    let text: serde_json::Value = serde_json::from_slice(&read(dir, "rods.gltf")).unwrap();
    assert!(text["nodes"].as_array().unwrap().iter().any(|node| node["name"] == "R001"));
    assert_eq!(refused(dir, &["out", "rods.glb", "--cut", "z=3"]).0, 2);
}

#[test]
fn a_structure_becomes_the_tables_of_its_folder_again() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    let build = ["build", &sample("igloo.obj"), "-o", "out", "--only", "structure,csv", "-q"];
    rodwright(dir).args(build).assert().success();
    for (file, format, same) in [
        ("again.json", "json", "structure.json"),
        ("rods.csv", "csv", "rods.csv"),
        ("contacts.csv", "contacts-csv", "contacts.csv"),
        ("supports.csv", "supports-csv", "supports.csv"),
    ] {
        convert(dir, &["out/structure.json", file, "--to", format]);
        assert!(read(dir, file) == read(&dir.join("out"), same), "{file}");
    }
    convert(dir, &["out", "ending.csv"]);
    assert!(read(dir, "ending.csv") == read(dir, "rods.csv"));
    let (status, message) = refused(dir, &[&sample("igloo.obj"), "dome.csv"]);
    assert_eq!(status, 2);
    assert!(message.contains("surfaces are not written as csv, only as obj"), "{message}");
}

#[test]
fn wrong_usage_and_bad_files_are_refused_and_the_earlier_file_stays() {
    let dir = tempdir().unwrap();
    let dir = dir.path();
    let igloo = sample("igloo.obj");
    fs::write(dir.join("kept.stl"), "kept").unwrap();
    fs::write(dir.join("nan.obj"), "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    fs::create_dir(dir.join("folder.stl")).unwrap();
    for (args, status, word) in [
        (&[igloo.as_str(), "dome.3mf"][..], 2, "obj, stl, stl-ascii, ply, ply-ascii, off, glb"),
        (&[&igloo, "dome"], 2, "--to"),
        (&[&igloo, "-"], 2, "--to"),
        (&[&igloo, "a.stl", "--to", "3mf"], 2, "ply-ascii"),
        (&[&igloo], 2, "OUT"),
        (&["none.obj", "kept.stl"], 3, "none.obj"),
        (&["nan.obj", "kept.stl"], 1, "nan.obj"),
        (&["folder.stl", "kept.stl"], 3, "structure.json"),
        (&[&igloo, "kept.stl", "--cut", "z=1m"], 1, "reaches from 0 to 220 mm"),
        (&[&igloo, "folder.stl"], 3, "cannot write folder.stl"),
        (&[&igloo, "none/dome.stl"], 3, "cannot write none/dome.stl"),
    ] {
        let (found, message) = refused(dir, args);
        assert_eq!(found, status, "{args:?}: {message}");
        assert!(message.contains(word), "{args:?}: {message}");
    }
    assert_eq!(read(dir, "kept.stl"), b"kept");
}

#[test]
fn a_surface_far_away_is_written_with_a_warning() {
    let dir = tempdir().unwrap();
    let text = "v 5000000 0 0\nv 5000001 0 0\nv 5000000 1 0\nf 1 2 3\n";
    fs::write(dir.path().join("far.obj"), text).unwrap();
    let command = |out: &str| {
        let output = rodwright(dir.path()).args(["convert", "far.obj", out]).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(command("far.ply"), "");
    let text = text.replace("5000000 1", "5000000.3 1");
    fs::write(dir.path().join("far.obj"), text).unwrap();
    assert!(command("far.stl").contains("warning: stl holds seven digits"));
}
