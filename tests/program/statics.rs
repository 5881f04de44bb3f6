//! The statics of samples, from the command line to the files.

use crate::run::{rodwright, sample, snapshot, structure};
use serde_json::Value;
use std::path::Path;
use tempfile::tempdir;

fn json(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

/// Builds a sample design with other options besides.
fn build(folder: &Path, name: &str, options: &[&str]) {
    let design = sample(&format!("{name}.toml"));
    let mut command = rodwright(folder);
    command.args(["build", "--design", &design, "-q", "-o", "out"]).args(options);
    command.assert().success();
}

/// Runs `rodwright statics` on the folder; returns what it prints.
fn statics(folder: &Path, options: &[&str]) -> String {
    let run = rodwright(folder).args(["statics", "out"]).args(options).assert().success();
    String::from_utf8(run.get_output().stdout.clone()).unwrap()
}

fn sum(of: &Value, part: usize) -> f64 {
    of.as_array().unwrap().iter().map(|r| r["force"][part].as_f64().unwrap()).sum()
}

/// Reactions carry the weight of all rods and the loads, in every case.
#[test]
fn the_ground_carries_rods_snow_and_loads() {
    let home = tempdir().unwrap();
    build(home.path(), "igloo", &["--only", "csv"]);
    let structure = structure(&home.path().join("out"));
    let volume: f64 = structure["rods"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["length"].as_f64().unwrap() * std::f64::consts::PI * 9.0 / 4.0)
        .sum();
    let weight = volume * 420.0 * 9.80665e-9;
    let options = ["--load", "R012:5N,R020:2N@10mm+x", "--snow", "100Pa"];
    let cases = ["--combine", "weight", "--combine", "1.35 weight + 1.5 snow + 2 loads"];
    for joint in ["nailed", "tied", "notched"] {
        statics(home.path(), &[&options[..], &cases, &["--joint", joint]].concat());
        let found = json(&home.path().join("out/statics.json"));
        let both = &found["cases"];
        let alone = &both[0]["reactions"];
        assert!((sum(alone, 2) - weight).abs() < 1e-9 * weight, "{joint}: {alone}");
        let loaded = &both[1]["reactions"];
        assert!((sum(loaded, 0) + 4.0).abs() < 1e-9 * 10.0, "{joint}");
        // Snow on at most the circle that the igloo covers, and on most of it.
        let snow = (sum(loaded, 2) - 1.35 * weight - 10.0) / 1.5;
        let circle = std::f64::consts::PI * 309.0_f64.powi(2) * 1e-4;
        assert!((0.7 * circle..circle).contains(&snow), "{joint}: {snow} of {circle}");
        assert!(both[1]["unbalanced"].as_f64().unwrap() < 1e-9, "{joint}");
    }
}

#[test]
fn other_loads_change_only_what_is_said_of_statics() {
    let home = tempdir().unwrap();
    let options = ["--only", "csv,glb,viewer,statics", "--load", "top:1N"];
    build(home.path(), "igloo", &options);
    let out = home.path().join("out");
    let built = snapshot(&out);
    // What the design asks for is asked for again.
    let text = statics(home.path(), &[]);
    assert_eq!(snapshot(&out), built);
    assert!(text.contains("contacts       tied") && text.contains("25 pinned"), "{text}");
    std::fs::write(out.join("notes.txt"), "mine").unwrap();
    let text = statics(home.path(), &["--load", "top:1kg", "--rod-material", "steel"]);
    assert!(text.contains("steel: E 210000 MPa"), "{text}");
    let found = json(&out.join("statics.json"));
    assert_eq!(found["settings"]["material"], "steel");
    let changed = snapshot(&out);
    assert_eq!(changed["notes.txt"], b"mine");
    assert_eq!(changed["structure.json"], built["structure.json"]);
    for file in ["statics.json", "model.inp", "model.mac", "model.glb", "viewer.html", "rods.csv"] {
        assert_ne!(changed[file], built[file], "{file}");
    }
    for file in ["contacts.csv", "supports.csv"] {
        assert_eq!(changed[file], built[file], "{file}");
    }
    // The design repeats the first run, not the second.
    assert_eq!(changed["design.toml"], built["design.toml"]);
}

#[test]
fn a_larger_model_is_stressed_by_its_size() {
    let home = tempdir().unwrap();
    build(home.path(), "igloo", &["--statics", "--only", "csv,statics"]);
    let stress = || {
        let found = json(&home.path().join("out/statics.json"));
        let most = &found["largest"];
        ["utilisation", "displacement_mm"].map(|key| most[key]["value"].as_f64().unwrap())
    };
    let [small, moved] = stress();
    statics(home.path(), &["--statics-span", "12m"]);
    let found = json(&home.path().join("out/statics.json"));
    let scale = found["settings"]["scale"].as_f64().unwrap();
    let [large, far] = stress();
    // Weight over section grows with the size, deflection with its square.
    assert!((large / small / scale - 1.0).abs() < 1e-6, "{small} {large} {scale}");
    assert!((far / moved / scale.powi(2) - 1.0).abs() < 1e-6, "{moved} {far} {scale}");
}

/// A frame without feet floats: the refusal names rods, and feet that are added mend it.
#[test]
fn a_frame_that_does_not_stand_is_refused_by_name() {
    let home = tempdir().unwrap();
    build(home.path(), "igloo", &["--only", "csv"]);
    let file = home.path().join("out/structure.json");
    let mut without = json(&file);
    without["supports"] = Value::Array(Vec::new());
    std::fs::write(&file, serde_json::to_string(&without).unwrap()).unwrap();
    let run = rodwright(home.path()).args(["statics", "out"]).assert().failure().code(1);
    let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert!(message.contains("too few supports: R0"), "{message}");
    assert!(message.contains("can move freely"), "{message}");
    assert!(!home.path().join("out/statics.json").exists());
    let text = statics(home.path(), &["--supports", "auto"]);
    assert!(text.contains("0 pinned, and 3 added: R"), "{text}");
}

/// The build itself is not refused: all else is written.
#[test]
fn a_build_that_does_not_stand_says_so_and_is_written() {
    let home = tempdir().unwrap();
    let build = ["build", &sample("flat.obj"), "-o", "out", "--statics", "--feet", "sliding"];
    let run = rodwright(home.path()).args(build).args(["--only", "csv,statics"]).assert().success();
    let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert!(message.contains("statics: too few supports"), "{message}");
    let report = json(&home.path().join("out/report.json"));
    assert!(report["statics"]["refused"].as_str().unwrap().contains("can move freely"));
    assert!(!home.path().join("out/statics.json").exists());
}

#[test]
fn what_cannot_be_asked_is_said() {
    let home = tempdir().unwrap();
    build(home.path(), "igloo", &["--only", "csv"]);
    for (options, code, word) in [
        (&["--load", "R999:1N"][..], 1, "R001 to R124"),
        (&["--load", "R012:1N@900mm"], 1, "mm long"),
        (&["--load", "R012"], 2, "write it as R012:100N"),
        (&["--load", "R012:5 apples"], 2, "kg"),
        (&["--rod-material", "cheese"], 2, "bamboo"),
        (&["--combine", "1.5 wind"], 2, "weight, snow, loads"),
        (&["--combine", "1.5 snow"], 1, "--snow"),
        (&["--snow=-1kPa"], 1, "negative"),
        (&["--statics-span", "0"], 1, "more than nothing"),
    ] {
        let run = rodwright(home.path()).args(["statics", "out"]).args(options).assert();
        let run = run.failure().code(code);
        let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(message.contains(word), "{options:?}: {message}");
    }
    let surface = sample("igloo.obj");
    let run = rodwright(home.path()).args(["statics", &surface]).assert().failure().code(1);
    let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert!(message.contains("rodwright build"), "{message}");
}

/// A frame that is made stiffer is better by what the report says, and the design repeats it.
#[test]
fn a_frame_is_made_stiffer() {
    let home = tempdir().unwrap();
    let options = ["--load", "top:1kg", "--stiffen", "displacement", "--only", "csv,statics"];
    build(home.path(), "vault", &options);
    let out = home.path().join("out");
    let report = json(&out.join("report.json"));
    let [before, after] = ["before", "after"].map(|when| &report["stiffened"][when]);
    assert!(after["value"].as_f64().unwrap() < 0.8 * before["value"].as_f64().unwrap());
    assert_eq!(after["value"], report["statics"]["displacement"]["value"]);
    assert_eq!(report["turn"], after["turn"]);
    // The plain build is the frame before.
    let first = snapshot(&out);
    let design = out.join("design.toml");
    std::fs::rename(&design, home.path().join("again.toml")).unwrap();
    let again = ["build", &sample("vault.obj"), "--design", "again.toml", "-q", "-o", "again"];
    rodwright(home.path()).args(again).assert().success();
    let again = snapshot(&home.path().join("again"));
    assert_eq!(again["structure.json"], first["structure.json"]);
    assert_eq!(again["statics.json"], first["statics.json"]);
    build(home.path(), "vault", &["--load", "top:1kg", "--only", "csv,statics", "--force"]);
    let plain = json(&out.join("report.json"));
    assert_eq!(plain["statics"]["displacement"]["value"], before["value"]);
}
