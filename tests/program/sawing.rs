//! Stock, offcuts and shared lengths, from the command line to the files.

use crate::check::check_structure;
use crate::run::{rodwright, sample, snapshot, structure};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tempfile::tempdir;

fn json(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

fn build(dir: &Path, args: &[&str]) -> String {
    let run = rodwright(dir).arg("build").args(args).assert().success();
    String::from_utf8_lossy(&run.get_output().stdout).into_owned()
        + &String::from_utf8_lossy(&run.get_output().stderr)
}

const STOCK: [&str; 8] = [
    "--stock",
    "1000mm @ 1.20, 2000mm @ 2.10 x 3",
    "--offcuts",
    "430mm,2x610mm",
    "--keep",
    "100mm",
    "--trim",
    "2mm",
];

#[test]
fn prices_counts_and_offcuts_reach_every_file_and_the_design_repeats_them() {
    let dir = tempdir().unwrap();
    let igloo = sample("igloo.obj");
    let mut args =
        vec![igloo.as_str(), "-o", "one", "--class-tolerance", "2mm", "--density", "700"];
    args.extend(STOCK);
    let text = build(dir.path(), &args);
    let plan = json(&dir.path().join("one/cutlist.json"));
    let bars = plan["bars"].as_array().unwrap();
    let length = |b: &Value| b["stock_length"].as_f64().unwrap();
    let count = |l: f64| bars.iter().filter(|b| length(b) == l).count();
    assert!(count(2000.0) <= 3 && count(430.0) <= 1 && count(610.0) <= 2);
    let cost = 1.2 * count(1000.0) as f64 + 2.1 * count(2000.0) as f64;
    assert!((plan["cost"].as_f64().unwrap() - cost).abs() < 1e-9);
    assert!(text.contains(&format!("cost {cost:.2}")), "{text}");
    assert!(plan["least"].as_f64().unwrap() <= cost + 1e-9);
    for bar in bars {
        let last = bar["stops"].as_array().unwrap().last().unwrap().as_f64().unwrap();
        assert!(last <= length(bar) - 2.0 + 1e-6, "{bar}");
        assert_eq!(bar["keep"].as_bool(), Some(bar["left"].as_f64().unwrap() >= 100.0));
        assert_eq!(bar["offcut"].as_bool(), Some(length(bar) < 1000.0));
    }
    build(dir.path(), &["--design", "one/design.toml", "-o", "two"]);
    let [one, two] = ["one", "two"].map(|out| snapshot(&dir.path().join(out)));
    for (name, bytes) in &one {
        assert!(bytes == &two[name], "{name} differs");
    }
}

/// The lengths of all rods, in steps of 1/1000 mm.
fn lengths(structure: &Value) -> BTreeMap<String, i64> {
    let rods = structure["rods"].as_array().unwrap().iter();
    let length = |r: &Value| (r["length"].as_f64().unwrap() * 1e3).round() as i64;
    rods.map(|r| (r["id"].as_str().unwrap().to_owned(), length(r))).collect()
}

#[test]
fn rods_share_lengths_and_no_contact_or_foot_moves() {
    let dir = tempdir().unwrap();
    let dome = sample("igloo.obj");
    build(dir.path(), &[&dome, "-o", "own", "--only", "csv,cutlist"]);
    build(dir.path(), &[&dome, "-o", "four", "--only", "csv,cutlist", "--classes", "4"]);
    let [own, four] = ["own", "four"].map(|out| structure(&dir.path().join(out)));
    check_structure(&four);
    assert_eq!(own["supports"], four["supports"]);
    let (before, after) = (lengths(&own), lengths(&four));
    assert!(before.iter().all(|(rod, length)| after[rod] >= *length));
    assert_eq!(after.values().collect::<BTreeSet<_>>().len(), 4);
    let classes: BTreeSet<&str> =
        four["rods"].as_array().unwrap().iter().map(|r| r["class"].as_str().unwrap()).collect();
    assert_eq!(classes.len(), 4);
    // The saw agrees.
    let plan = std::fs::read_to_string(dir.path().join("four/cutlist.csv")).unwrap();
    let mut table = plan.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    assert!(
        table.all(|row| (row[4].parse::<f64>().unwrap() * 1e3).round() as i64 == after[row[3]])
    );
    // And so does the report.
    let shared = &json(&dir.path().join("four/report.json"))["shared_lengths"];
    assert_eq!((&shared["after"], &shared["own"]), (&Value::from(4), &Value::Array(Vec::new())));
    let extra: i64 = after.values().sum::<i64>() - before.values().sum::<i64>();
    assert!((shared["extra"].as_f64().unwrap() - extra as f64 / 1e3).abs() < 0.01);
}
