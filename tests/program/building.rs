//! The main job, run as a user runs it.

use crate::check::check_structure;
use crate::run::{rodwright, sample, snapshot, structure};
use rodwright::pattern::library;
use tempfile::tempdir;

#[test]
fn every_pattern_makes_a_sound_frame_of_the_igloo_and_the_station() {
    let dir = tempdir().unwrap();
    for surface in ["igloo.obj", "train-station.obj"] {
        for pattern in library().iter().map(|p| p.name.as_str()) {
            let out = dir.path().join(pattern);
            rodwright(dir.path())
                .args(["build", &sample(surface), "--pattern", pattern])
                .args(["--only", "structure", "-q", "-o"])
                .arg(&out)
                .assert()
                .success();
            let rods = check_structure(&structure(&out));
            assert!((20..=400).contains(&rods), "{surface} {pattern}: {rods} rods");
        }
    }
}

/// Rods as thick as these run into each other in a fifth of the units; leaving out the
/// twelve-sided one takes away what its neighbours hang on.
#[test]
fn a_frame_that_falls_apart_with_its_largest_unit_is_refused() {
    let dir = tempdir().unwrap();
    let output = rodwright(dir.path())
        .args(["build", &sample("train-station.obj"), "--pattern", "4.6.12", "--turn", "16deg"])
        .args(["--unit", "90mm", "--rod", "9mm", "--only", "structure", "-o", "out"])
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("of 13 units of edge 90.0 mm do not work"), "{message}");
    assert!(message.contains("without --unit") && !dir.path().join("out").exists(), "{message}");
}

/// Settings with which patterns leave nothing out that do so when fitted. Polygons of
/// twelve sides rise more than the small ones beside them and want smaller units; rods that
/// cross at every edge, larger ones.
const LARGER_OR_SMALLER: &[(&str, &[&str])] = &[
    ("3.12.12", &["--unit", "39mm"]),
    ("4.6.12", &["--unit", "41mm"]),
    ("3.3.3.3.3.3+3.3.4.12", &["--unit", "57mm"]),
    ("3.4.3.12+3.12.12", &["--turn", "16deg", "--unit", "47mm"]),
    ("3.4.6.4+4.6.12", &["--rod", "1.5mm", "--unit", "36mm"]),
    ("crossing", &["--unit", "93mm"]),
];

#[test]
fn every_pattern_can_be_built_on_the_igloo_with_nothing_left_out() {
    let dir = tempdir().unwrap();
    for pattern in library() {
        let large = LARGER_OR_SMALLER.iter().find(|(name, _)| *name == pattern.name);
        rodwright(dir.path())
            .args(["build", &sample("igloo.obj"), "--pattern", &pattern.name])
            .args(large.map_or(&[][..], |(_, settings)| settings))
            .args(["--only", "structure", "-q", "--force", "-o", "out"])
            .assert()
            .success();
        let report = std::fs::read(dir.path().join("out/report.json")).unwrap();
        let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
        let left_out = report["dropped"].as_array().unwrap();
        assert!(left_out.is_empty(), "{}: {left_out:?}", pattern.name);
    }
}

#[test]
fn a_run_writes_every_file_of_the_folder_and_the_same_bytes_twice() {
    let dir = tempdir().unwrap();
    let run = |out: &str| {
        rodwright(dir.path()).args(["build", &sample("igloo.obj"), "-o", out]).assert().success();
        snapshot(&dir.path().join(out))
    };
    let (first, second) = (run("one"), run("two"));
    for name in [
        "structure.json",
        "report.json",
        "rods.csv",
        "contacts.csv",
        "supports.csv",
        "cutlist.json",
        "cutlist.csv",
        "model.glb",
        "assembly.json",
        "assembly.glb",
        "viewer.html",
        "sheets.pdf",
        "handout.pdf",
        "support-map.svg",
        "support-map.pdf",
        "support-map.dxf",
        "footprint.svg",
        "pictures/histograms.svg",
        "sheets/02-figures.svg",
        "design.toml",
    ] {
        assert!(first.contains_key(name), "{name} is missing");
    }
    assert!(first.keys().any(|name| name.starts_with("sheets/") && name.ends_with(".svg")));
    assert_eq!(first.keys().collect::<Vec<_>>(), second.keys().collect::<Vec<_>>());
    for (name, bytes) in &first {
        assert!(bytes == &second[name], "{name} differs between two runs");
    }
}

/// Centres of the circles on a layer of a DXF file, with their radii.
fn dxf_circles(text: &str, layer: &str) -> Vec<[f64; 3]> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs: Vec<_> = lines.chunks(2).map(|p| (p[0], p[1])).collect();
    let starts = (0..pairs.len()).filter(|&i| pairs[i] == ("0", "CIRCLE"));
    let circles = starts.map(|i| {
        let end = i + 1 + pairs[i + 1..].iter().position(|p| p.0 == "0").unwrap();
        pairs[i..end].to_vec()
    });
    circles
        .filter(|c| c.contains(&("8", layer)))
        .map(|c| {
            ["10", "20", "40"]
                .map(|code| c.iter().find(|p| p.0 == code).unwrap().1.parse().unwrap())
        })
        .collect()
}

#[test]
fn circles_of_the_support_map_in_cad_stand_at_the_feet() {
    let dir = tempdir().unwrap();
    rodwright(dir.path())
        .args(["build", &sample("train-station.obj"), "-o", "out", "--only", "support-map"])
        .assert()
        .success();
    let text = std::fs::read_to_string(dir.path().join("out/support-map.dxf")).unwrap();
    let structure = structure(&dir.path().join("out"));
    let feet: Vec<[f64; 2]> = structure["supports"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| [0, 1].map(|i| s["point"][i].as_f64().unwrap()))
        .collect();
    let circles = dxf_circles(&text, "FEET");
    assert!(circles.len() == feet.len() && feet.len() > 10);
    for ([cx, cy, radius], [x, y]) in circles.iter().zip(feet) {
        assert!((cx - x).abs() <= 1e-6 && (cy - y).abs() <= 1e-6, "{cx} {cy}: {x} {y}");
        assert_eq!(*radius, 1.5);
    }
}

#[test]
fn the_design_file_of_a_folder_repeats_its_run() {
    let dir = tempdir().unwrap();
    rodwright(dir.path())
        .args(["build", &sample("igloo.obj"), "-o", "first", "--rod", "1/8in", "--turn=-22deg"])
        .args(["--span", "2ft", "--pattern", "3.6.3.6", "--stock", "900mm,400mm", "--kerf", "1.2"])
        .assert()
        .success();
    rodwright(dir.path())
        .args(["build", "--design", "first/design.toml", "-o", "second"])
        .assert()
        .success();
    let (first, second) =
        (snapshot(&dir.path().join("first")), snapshot(&dir.path().join("second")));
    for (name, bytes) in &first {
        assert!(bytes == &second[name], "{name} differs");
    }
}

#[test]
fn rods_are_sawn_to_the_step_asked_for() {
    let dir = tempdir().unwrap();
    rodwright(dir.path())
        .args(["build", &sample("igloo.obj"), "-o", "out", "--round", "5mm"])
        .assert()
        .success();
    for rod in structure(&dir.path().join("out"))["rods"].as_array().unwrap() {
        let steps = rod["length"].as_f64().unwrap() / 5.0;
        assert!((steps - steps.round()).abs() < 1e-9, "{rod}");
    }
}

#[test]
fn sizes_scale_together() {
    let dir = tempdir().unwrap();
    let build = |out: &str, args: &[&str]| {
        let mut command = rodwright(dir.path());
        command.args(["build", &sample("igloo.obj"), "-o", out, "--only", "structure"]);
        command.args(args).assert().success();
        structure(&dir.path().join(out))
    };
    let small = build("small", &["--round", "0", "--span", "600mm"]);
    let large = build("large", &["--round", "0", "--rod", "30mm", "--span", "6m"]);
    let pairs = small["rods"].as_array().unwrap().iter().zip(large["rods"].as_array().unwrap());
    for (s, l) in pairs {
        let (s, l) = (s["length"].as_f64().unwrap(), l["length"].as_f64().unwrap());
        assert!((l / s - 10.0).abs() < 1e-6, "{s} {l}");
    }
}

#[test]
fn the_summary_tells_what_to_buy_and_json_gives_the_report() {
    let dir = tempdir().unwrap();
    let run = |args: &[&str]| {
        let mut command = rodwright(dir.path());
        command.args(["build", &sample("igloo.obj"), "-o", "out"]).args(args);
        String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
    };
    let summary = run(&[]);
    for word in ["rods", "to buy", "1000 mm", "different", "worst error", "left out"] {
        assert!(summary.contains(word), "{word} is not in\n{summary}");
    }
    let report: serde_json::Value = serde_json::from_str(&run(&["--json"])).unwrap();
    assert!(report["measures"]["worst_gap"].as_f64().unwrap() <= 1e-9);
    assert!(report["measures"]["rods"].as_u64().unwrap() >= 100);
    assert_eq!(run(&["-q"]), "");
}

#[test]
fn inspect_tells_about_rods_contacts_and_units() {
    let dir = tempdir().unwrap();
    rodwright(dir.path()).args(["build", &sample("igloo.obj"), "-o", "out"]).assert().success();
    let inspect = |args: &[&str]| {
        let mut command = rodwright(dir.path());
        let output = command.arg("inspect").arg("out").args(args).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let (status, rod) = inspect(&["--rod", "r12"]);
    assert_eq!(status, Some(0));
    assert!(rod.contains("Rod R012") && rod.contains("clock"), "{rod}");
    assert!(inspect(&["--contact", "C0001"]).1.contains("over"));
    assert!(inspect(&["--unit", "U001"]).1.contains("4: R001"));
    assert!(inspect(&[]).1.contains("Lengths"));
    assert_eq!(inspect(&["--rod", "R999"]).0, Some(1));
}

#[test]
fn completions_and_manual_name_the_commands() {
    let dir = tempdir().unwrap();
    for args in [&["completions", "bash"][..], &["man"]] {
        let output = rodwright(dir.path()).args(args).assert().success();
        let text = String::from_utf8_lossy(&output.get_output().stdout).into_owned();
        assert!(text.contains("build") && text.contains("inspect"), "{args:?}");
    }
}

#[test]
fn rods_slide_on_spheres_whose_tiles_alternate_and_are_refused_elsewhere() {
    let dir = tempdir().unwrap();
    let slid = ["build", "sphere:aD", "--span", "1200mm", "--turn", "0", "--slide", "0.2", "-q"];
    rodwright(dir.path()).args(slid).args(["--only", "structure", "-o", "out"]).assert().success();
    assert!(check_structure(&structure(&dir.path().join("out"))) >= 60);
    let units = &structure(&dir.path().join("out"))["units"];
    let ways =
        |way: &str| units.as_array().unwrap().iter().filter(|u| u["chirality"] == way).count();
    assert!(ways("cw") > 10 && ways("ccw") > 10);
    let refused = ["build", "sphere:dI", "--slide", "0.2", "-o", "none"];
    let output = rodwright(dir.path()).args(refused).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(message.contains("chessboard") && !dir.path().join("none").exists(), "{message}");
}
