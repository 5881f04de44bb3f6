//! How far last contacts are off where marks and diameters are not exact.

use crate::run::{rodwright, sample, snapshot};
use serde_json::Value;
use std::path::Path;
use tempfile::tempdir;

fn run(dir: &Path, out: &str, args: &[&str]) -> (String, Value) {
    let output = rodwright(dir)
        .args(["build", &sample("igloo.obj"), "--only", "csv", "-o", out])
        .args(args)
        .assert()
        .success();
    let report = std::fs::read(dir.join(out).join("report.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    let summary = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    (summary, report["tolerance"].clone())
}

const GIVEN: &str = "marks 0.5mm, diameter 0.1mm";

#[test]
fn the_misfit_is_told_in_summary_report_and_table() {
    let dir = tempdir().unwrap();
    let (summary, told) = run(dir.path(), "out", &["--tolerance", GIVEN]);
    let number = |key: &str| told[key].as_f64().unwrap();
    let words = format!(
        "with marks ±0.5 mm and sticks ±0.1 mm, the last contact of a unit will be off by {:.1} mm \
         in the median, {:.1} mm at 95 %; worst U0",
        number("median"),
        number("p95")
    );
    assert!(summary.contains(&words), "{summary}");
    assert!(0.2 < number("median") && number("median") < number("p95"), "{told}");
    assert!(number("p95") < 3.0, "{told}");
    assert_eq!(["trials", "seed"].map(|k| told[k].as_u64().unwrap()), [500, 1]);
    let mut reader = csv::Reader::from_path(dir.path().join("out/tolerance.csv")).unwrap();
    assert_eq!(reader.headers().unwrap(), vec!["unit", "last_contact", "median_mm", "p95_mm"]);
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let units = told["units"].as_array().unwrap();
    assert_eq!(rows.len(), 54);
    for (row, unit) in rows.iter().zip(units) {
        assert_eq!([&row[0], &row[1]], ["id", "last_contact"].map(|k| unit[k].as_str().unwrap()));
        let [median, p95] = [2, 3].map(|i| row[i].parse::<f64>().unwrap());
        assert_eq!([median, p95], ["median", "p95"].map(|k| unit[k].as_f64().unwrap()));
    }
}

#[test]
fn it_is_the_same_each_time_grows_with_the_errors_and_changes_with_the_seed() {
    let dir = tempdir().unwrap();
    let (_, once) = run(dir.path(), "once", &["--tolerance", GIVEN]);
    run(dir.path(), "same", &["--tolerance", GIVEN, "--seed", "1"]);
    run(dir.path(), "file", &["--design", "once/design.toml"]);
    let first = snapshot(&dir.path().join("once"));
    for out in ["same", "file"] {
        let other = snapshot(&dir.path().join(out));
        assert!(first.iter().all(|(name, bytes)| other[name] == *bytes), "{out}");
    }
    let (_, twice) = run(dir.path(), "twice", &["--tolerance", "diameter 0.2mm, marks 0.1cm"]);
    let (_, other) = run(dir.path(), "other", &["--tolerance", GIVEN, "--seed", "2"]);
    let (_, none) = run(dir.path(), "none", &["--tolerance", "marks 0mm"]);
    let p95 = |v: &Value| v["p95"].as_f64().unwrap();
    assert!((p95(&twice) - 2.0 * p95(&once)).abs() < 2e-3, "{twice}");
    assert_ne!(p95(&other), p95(&once));
    assert!((p95(&other) / p95(&once) - 1.0).abs() < 0.1, "{other}");
    assert_eq!(p95(&none), 0.0);
    // The frame is the same with and without.
    let plain = run(dir.path(), "plain", &[]).1;
    assert!(plain.is_null() && !dir.path().join("plain/tolerance.csv").exists());
    let plain = snapshot(&dir.path().join("plain"));
    assert_eq!(plain["structure.json"], first["structure.json"]);
}

#[test]
fn errors_that_cannot_be_are_refused() {
    let dir = tempdir().unwrap();
    for (args, word) in [
        (&["--tolerance", "gaps 1mm"][..], "`gaps 1mm` is none of"),
        (&["--tolerance", "marks"], "marks: "),
        (&["--tolerance", "marks -1mm"], "tolerance = -1mm: must not be negative"),
        (&["--seed", "3"], "seed does nothing here"),
        (&["--tolerance", GIVEN, "--seed", "many"], "many"),
    ] {
        let output = rodwright(dir.path())
            .args(["build", &sample("igloo.obj"), "-o", "out"])
            .args(args)
            .output()
            .unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && message.contains(word), "{args:?}: {message}");
    }
}
