//! Rods of different and of tapering diameter.

use crate::check::check_structure;
use crate::run::{rodwright, sample, snapshot, structure};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tempfile::tempdir;

/// Writes a design of the igloo, or of another surface, with this table of rods.
fn design(dir: &Path, surface: &str, table: &str) {
    let text = format!("surface = '{}'\n{table}", surface.replace('\\', "/"));
    std::fs::write(dir.join("d.toml"), text).unwrap();
}

fn json(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

const POLES: &str = "[rod]\ndiameter = '3mm'\n[rod.sizes]\nborder = '5mm'\nR020 = ['4mm', '2mm']\n";

/// The diameter of every rod, as the structure file says it.
fn diameters(s: &Value) -> BTreeMap<String, Value> {
    let rods = s["rods"].as_array().unwrap().iter();
    rods.map(|r| (r["id"].as_str().unwrap().to_owned(), r["diameter"].clone())).collect()
}

#[test]
fn border_rods_and_a_tapered_one_touch_at_the_sum_of_their_radii() {
    let dir = tempdir().unwrap();
    design(dir.path(), &sample("igloo.obj"), POLES);
    let build = ["build", "--design", "d.toml", "-o", "out"];
    let output = rodwright(dir.path()).args(build).assert().success();
    let summary = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(summary.contains("of 3 mm, 1 of 4→2 mm, "), "{summary}");
    assert!(summary.contains("× 1000 mm of Ø 5 mm"), "{summary}");
    let s = structure(&dir.path().join("out"));
    // Gaps, marks and clearances by each rod's own diameter.
    check_structure(&s);
    for rod in s["rods"].as_array().unwrap() {
        let expected = match (&rod["id"], &rod["border"]) {
            (id, _) if id == "R020" => serde_json::json!([4.0, 2.0]),
            (_, border) if border == true => serde_json::json!(5.0),
            _ => serde_json::json!(3.0),
        };
        assert_eq!(rod["diameter"], expected, "{rod}");
    }
    let gaps: BTreeSet<i64> = s["contacts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| (c["gap"].as_f64().unwrap() * 1e6).round() as i64)
        .collect();
    assert!(gaps.contains(&3_000_000) && gaps.contains(&4_000_000), "{gaps:?}");
    assert_eq!(s["report"]["dropped"], serde_json::json!([]));
}

#[test]
fn no_bar_and_no_class_mixes_diameters_and_the_tables_name_them() {
    let dir = tempdir().unwrap();
    design(dir.path(), &sample("igloo.obj"), POLES);
    rodwright(dir.path()).args(["build", "--design", "d.toml", "-o", "out"]).assert().success();
    let out = dir.path().join("out");
    let of = diameters(&structure(&out));
    let plan = json(&out.join("cutlist.json"));
    let mut sawn = 0;
    for bar in plan["bars"].as_array().unwrap() {
        for rod in bar["rods"].as_array().unwrap() {
            assert_eq!(bar["diameter"], of[rod.as_str().unwrap()], "{bar}");
            sawn += 1;
        }
    }
    assert_eq!(sawn, of.len());
    let mut class: BTreeMap<String, String> = BTreeMap::new();
    let mut reader = csv::Reader::from_path(out.join("rods.csv")).unwrap();
    for row in reader.records().map(Result::unwrap) {
        let ends: Vec<f64> = [2, 12].map(|i| row[i].parse().unwrap()).to_vec();
        let expected = match &of[&row[0]] {
            Value::Array(both) => both.iter().map(|d| d.as_f64().unwrap()).collect(),
            one => vec![one.as_f64().unwrap(); 2],
        };
        assert_eq!(ends, expected, "{row:?}");
        let known = class.entry(row[3].to_owned()).or_insert_with(|| format!("{ends:?}"));
        assert_eq!(*known, format!("{ends:?}"), "class {}", &row[3]);
    }
    let output = rodwright(dir.path()).args(["inspect", "out", "--rod", "R020"]).assert().success();
    let page = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(page.contains("4→2 mm"), "{page}");
    // What is read back is what was written.
    for name in ["one.stl", "two.obj", "three.glb"] {
        rodwright(dir.path()).args(["convert", "out", name]).assert().success();
    }
    assert_eq!(std::fs::read(dir.path().join("three.glb")).unwrap(), {
        std::fs::read(out.join("model.glb")).unwrap()
    });
}

#[test]
fn the_design_file_repeats_the_table_and_the_command_line_changes_the_diameter_only() {
    let dir = tempdir().unwrap();
    design(dir.path(), &sample("igloo.obj"), POLES);
    let run = |args: &[&str]| {
        rodwright(dir.path())
            .arg("build")
            .args(args)
            .args(["--only", "structure"])
            .assert()
            .success();
    };
    run(&["--design", "d.toml", "-o", "first"]);
    run(&["--design", "first/design.toml", "-o", "second"]);
    let [first, second] = ["first", "second"].map(|out| snapshot(&dir.path().join(out)));
    for (name, bytes) in &first {
        assert!(bytes == &second[name], "{name} differs");
    }
    run(&["--design", "d.toml", "--rod", "3.2mm", "-o", "third"]);
    let s = structure(&dir.path().join("third"));
    let mut found: Vec<String> = diameters(&s).values().map(Value::to_string).collect();
    found.sort();
    found.dedup();
    assert_eq!(found, ["3.2", "5.0", "[4.0,2.0]"]);
}

#[test]
fn polygon_meshes_and_spheres_take_rods_of_other_diameters() {
    let dir = tempdir().unwrap();
    let cases = [
        (sample("ring.obj"), "pattern = 'mesh'\n[rod]\ndiameter = 4\n[rod.sizes]\nR007 = [5, 4]\n"),
        (
            "sphere:dI/3".into(),
            "cut = 'z=25%'\nspan = '600mm'\n[rod.sizes]\nborder = [4, 3]\nall = [3, 2.8]\n",
        ),
    ];
    for (surface, table) in cases {
        design(dir.path(), &surface, table);
        rodwright(dir.path())
            .args(["build", "--design", "d.toml", "--only", "structure", "-q", "--force"])
            .args(["-o", "out"])
            .assert()
            .success();
        let s = structure(&dir.path().join("out"));
        check_structure(&s);
        let tapered = diameters(&s).values().filter(|d| d.is_array()).count();
        assert!(tapered > 0, "{surface}");
    }
}

#[test]
fn tables_that_cannot_be_are_refused_with_key_or_rod() {
    let dir = tempdir().unwrap();
    for (table, words) in [
        ("[rod]\ndiameter = 3\nsize = 4\n", &["d.toml", "size"][..]),
        ("[rod.sizes]\nrim = 4\n", &["d.toml", "`rim` names no rods", "R012"]),
        ("[rod.sizes]\nborder = '-1mm'\n", &["d.toml", "-1mm must be more than nothing"]),
        ("[rod]\ndiameter = '0mm'\n", &["rod = 0mm", "more than nothing"]),
        ("[rod.sizes]\nR999 = 4\n", &["rod R999", "the frame has 124 rods", "R124"]),
    ] {
        design(dir.path(), &sample("igloo.obj"), table);
        let build = ["build", "--design", "d.toml", "-o", "out"];
        let output = rodwright(dir.path()).args(build).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{table}: {message}");
        assert!(words.iter().all(|word| message.contains(word)), "{table}: {message}");
        assert!(!dir.path().join("out").exists());
    }
}
