//! What form finding does for surfaces and settings that are hard for it.

use crate::check::check_structure;
use crate::run::{rodwright, sample, structure};
use serde_json::Value;
use std::path::Path;
use tempfile::tempdir;

/// Builds a sample; returns the report and the number of rods.
fn built(dir: &Path, surface: &str, settings: &[&str]) -> (Value, usize) {
    rodwright(dir)
        .args(["build", &sample(surface), "--only", "structure", "-q", "--force", "-o", "out"])
        .args(settings)
        .assert()
        .success();
    let out = dir.join("out");
    let report = std::fs::read(out.join("report.json")).unwrap();
    (serde_json::from_slice(&report).unwrap(), check_structure(&structure(&out)))
}

/// Turned as far as is safe and far longer than need be, the ends of rods come together round
/// the corners of the triangles.
#[test]
fn rods_with_long_ends_are_kept_apart_or_their_units_left_out_by_name() {
    let dir = tempdir().unwrap();
    let settings = ["--pattern", "3.3.3.3.3.3", "--turn", "24deg", "--overhang", "40mm"];
    let (hut, rods) = built(dir.path(), "hut.obj", &settings);
    assert!(hut["closing"]["held"].as_u64() > Some(0) && rods > 80, "{}", hut["closing"]);
    assert_eq!(hut["dropped"], Value::Array(Vec::new()));
    let (vase, _) = built(dir.path(), "vase.obj", &settings);
    let dropped = vase["dropped"].as_array().unwrap();
    assert!(vase["closing"]["held"].as_u64() > Some(0), "{}", vase["closing"]);
    assert!(!dropped.is_empty() && dropped.len() < 10, "{dropped:?}");
    assert!(dropped.iter().all(|unit| unit["reason"].as_str().is_some_and(|r| r.len() > 20)));
}

/// The hut is sharply curved at its ridge and hardly elsewhere.
#[test]
fn units_are_made_smaller_where_rods_would_have_to_be_moved_far() {
    let dir = tempdir().unwrap();
    let mean_move = |report: &Value| report["measures"]["moves"]["mean"].as_f64().unwrap();
    let (fitted, _) = built(dir.path(), "hut.obj", &["--pattern", "6.6.6"]);
    assert_eq!(fitted["fit"]["by"], "move");
    let edge = fitted["fit"]["edge"].as_f64().unwrap() / 0.9;
    let unit = format!("{edge}mm");
    let (larger, _) = built(dir.path(), "hut.obj", &["--pattern", "6.6.6", "--unit", &unit]);
    assert!(mean_move(&fitted) <= 1.5 && mean_move(&larger) > 1.5);
    let (igloo, _) = built(dir.path(), "igloo.obj", &["--pattern", "6.6.6"]);
    assert_eq!(igloo["fit"]["by"], "rise");
}

/// On the bridge, units of twenty diameters do not work in this pattern.
#[test]
fn smaller_units_are_tried_where_those_that_fit_do_not_work() {
    let dir = tempdir().unwrap();
    let (bridge, rods) = built(dir.path(), "bridge.obj", &["--pattern", "3.3.3.3.6"]);
    assert_eq!(bridge["fit"]["by"], "move");
    assert_eq!(bridge["dropped"], Value::Array(Vec::new()));
    assert!(rods > 200);
}

#[test]
fn no_rods_are_said_to_suit_a_flat_sheet() {
    let dir = tempdir().unwrap();
    let output = rodwright(dir.path())
        .args(["build", &sample("flat.obj"), "--unit", "60mm", "--only", "structure", "-o", "out"])
        .output()
        .unwrap();
    let summary = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert!(output.status.success() && summary.contains("on so flat a surface"), "{summary}");
    assert!(!summary.contains("0.0 mm would suit"), "{summary}");
}
