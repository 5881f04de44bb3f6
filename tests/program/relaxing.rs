//! Patterns that are relaxed on their surface.

use crate::check::check_structure;
use crate::run::{rodwright, sample, structure};
use serde_json::Value;
use std::path::Path;
use tempfile::tempdir;

/// Builds a sample and gives its report, once its structure is found sound.
fn report(dir: &Path, args: &[&str]) -> Value {
    rodwright(dir)
        .arg("build")
        .args(args)
        .args(["--only", "footprint", "-q", "--force", "-o", "out"])
        .assert()
        .success();
    check_structure(&structure(&dir.join("out")));
    serde_json::from_slice(&std::fs::read(dir.join("out/report.json")).unwrap()).unwrap()
}

/// On the bug units over body and head come out larger than those over the waists.
#[test]
fn units_of_a_bug_become_more_even() {
    let dir = tempdir().unwrap();
    let bug = sample("super-bug.obj");
    // By the least move, for shaping moves rods as far as it may.
    let args = [bug.as_str(), "--pattern", "3.6.3.6", "--close", "least"];
    let plain = report(dir.path(), &[&args[..], &["--relax", "off"]].concat());
    assert_eq!(plain["relax"], Value::Null);
    let relaxed = report(dir.path(), &[&args[..], &["--relax", "on"]].concat());
    let relax = &relaxed["relax"];
    assert_eq!(relax["used"], true);
    assert!(relax["steps"].as_u64().unwrap() > 0);
    let figure = |key: &str, when: &str, of: &str| relax[key][when][of].as_f64().unwrap();
    assert!(
        figure("length_spread", "after", "rms") < 0.75 * figure("length_spread", "before", "rms")
    );
    let energy = |when: &str| relax["energy"][when].as_f64().unwrap();
    assert!(energy("after") < 0.7 * energy("before"));
    for key in ["angles", "lengths"] {
        let count = |when: &str| {
            let counts = relax[key][when]["counts"].as_array().unwrap();
            counts.iter().map(|n| n.as_u64().unwrap()).sum::<u64>()
        };
        assert!(count("before") > 100 && count("before") == count("after"), "{key}");
    }
    // The size of the units is that of the plain pattern, and none is lost.
    for [key, of] in [["fit", "edge"], ["measures", "units"]] {
        assert_eq!(plain[key][of], relaxed[key][of]);
    }
    let moves = |report: &Value| report["measures"]["moves"]["rms"].as_f64().unwrap();
    assert!(moves(&relaxed) < moves(&plain));
}

#[test]
fn the_design_file_says_whether_a_pattern_is_relaxed() {
    let dir = tempdir().unwrap();
    for (given, line) in [("on", "relax = \"on\""), ("off", "relax = \"off\"")] {
        report(dir.path(), &[&sample("igloo.obj"), "--relax", given]);
        let file = dir.path().join("out/design.toml");
        let text = std::fs::read_to_string(&file).unwrap();
        assert!(text.lines().any(|l| l == line), "{text}");
        let first = structure(&dir.path().join("out"));
        std::fs::copy(&file, dir.path().join("again.toml")).unwrap();
        report(dir.path(), &["--design", "again.toml"]);
        assert!(first == structure(&dir.path().join("out")));
    }
}

#[test]
fn what_has_no_chart_is_not_relaxed() {
    let dir = tempdir().unwrap();
    let ring = sample("ring.obj");
    for args in [&["sphere:aI"][..], &[&ring, "--pattern", "mesh"]] {
        let mut command = rodwright(dir.path());
        let output = command.arg("build").args(args).args(["--relax", "on"]).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains("relax does nothing here"), "{message}");
    }
}
