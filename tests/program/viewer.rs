//! The viewer, made as a user makes it, against the other files of its folder.

use crate::run::{rodwright, sample, structure};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use tempfile::tempdir;

fn page(dir: &Path, args: &[&str]) -> (String, Value) {
    rodwright(dir)
        .args(["build", &sample("igloo.obj"), "-q", "--force", "-o", "out"])
        .args(["--only", "viewer,csv,assembly"])
        .args(args)
        .assert()
        .success();
    let page = std::fs::read_to_string(dir.join("out/viewer.html")).unwrap();
    let (_, rest) = page.split_once(r#"<script id="data" type="application/json">"#).unwrap();
    let data = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    (page, data)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

/// By contact and rod: distance from end A, crossing angle and clock angle.
fn contacts(dir: &Path) -> BTreeMap<(String, String), [f64; 3]> {
    let mut table = csv::Reader::from_path(dir.join("out/contacts.csv")).unwrap();
    let mut found = BTreeMap::new();
    for row in table.deserialize::<BTreeMap<String, String>>() {
        let row = row.unwrap();
        let figure = |name: &str| row[name].parse::<f64>().unwrap();
        for side in ["over", "under"] {
            let [at, clock] =
                ["at_SIDE_mm", "clock_SIDE_deg"].map(|n| figure(&n.replace("SIDE", side)));
            let key = (row["id"].clone(), row[side].clone());
            found.insert(key, [at, figure("angle_deg"), clock]);
        }
    }
    found
}

/// The first figure in a text, with a point or a comma.
fn figure(text: &Value) -> f64 {
    let text = text.as_str().unwrap().replace(',', ".");
    let digits = text.trim_start_matches(|c: char| !c.is_ascii_digit());
    let end = digits.find(|c: char| c != '.' && !c.is_ascii_digit()).unwrap_or(digits.len());
    digits[..end].parse().unwrap()
}

#[test]
fn the_page_says_what_the_tables_say_in_both_languages() {
    for language in ["en", "de"] {
        let dir = tempdir().unwrap();
        let (page, data) = page(dir.path(), &["--language", language]);
        assert!(page.contains(&format!("<html lang=\"{language}\">")));
        assert!(!page.contains("http://") && !page.contains("https://"));
        let structure = structure(&dir.path().join("out"));
        let (rods, table) = (list(&data["rods"]), contacts(dir.path()));
        assert_eq!(rods.len(), list(&structure["rods"]).len());
        let mut marks = 0;
        for (rod, entry) in rods.iter().zip(list(&structure["rods"])) {
            assert_eq!(rod["id"], entry["id"]);
            for mark in list(&rod["marks"]) {
                let name = |v: &Value| v.as_str().unwrap().to_owned();
                let [at, angle, clock] = table[&(name(&mark["contact"]), name(&rod["id"]))];
                // Printed to a tenth; the table is rounded once more.
                assert!((figure(&mark["at"]) - at).abs() < 0.0501, "{mark} {at}");
                assert!((figure(&mark["angle"]) - angle).abs() < 0.0501, "{mark} {angle}");
                let turn = (figure(&mark["clock"]) - clock).rem_euclid(360.0);
                assert!(turn.min(360.0 - turn) < 0.0501, "{mark} {clock}");
                marks += 1;
            }
        }
        assert_eq!(marks, table.len());
    }
}

#[test]
fn its_steps_are_those_of_the_assembly() {
    let dir = tempdir().unwrap();
    let (_, data) = page(dir.path(), &[]);
    let text = std::fs::read(dir.path().join("out/assembly.json")).unwrap();
    let assembly: Value = serde_json::from_slice(&text).unwrap();
    let (shown, steps) = (list(&data["steps"]), list(&assembly["steps"]));
    assert!(steps.len() > 3 && shown.len() == steps.len());
    for (shown, step) in shown.iter().zip(steps) {
        let name = |place: &Value| data["rods"][place.as_u64().unwrap() as usize]["id"].clone();
        let rods: Vec<Value> = list(&shown["rods"]).iter().map(name).collect();
        assert_eq!(rods, list(&step["rods"]));
        let set = |props: &Value| list(props).iter().map(|p| p["id"].clone()).collect::<Vec<_>>();
        let standing = set(&shown["props"]);
        assert!(set(&step["props"]).iter().all(|prop| standing.contains(prop)));
    }
}
