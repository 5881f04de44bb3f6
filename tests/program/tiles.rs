//! Spheres, polygon meshes, cuts and pieces, as a user asks for them.

use crate::check::check_structure;
use crate::run::{rodwright, sample, snapshot, structure};
use std::path::Path;
use tempfile::tempdir;

fn build(dir: &Path, args: &[&str]) -> (i32, String) {
    let output = rodwright(dir)
        .arg("build")
        .args(args)
        .args(["--only", "structure", "-q", "-o", "out"])
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    (output.status.code().expect("an exit status, not a signal"), message)
}

/// Builds and gives the number of rods and of units.
fn built(dir: &Path, args: &[&str]) -> (usize, usize) {
    let (status, message) = build(dir, args);
    assert_eq!((status, message.as_str()), (0, ""), "{args:?}");
    let structure = structure(&dir.join("out"));
    assert_eq!(structure["report"]["dropped"], serde_json::json!([]), "{args:?}");
    (check_structure(&structure), structure["units"].as_array().unwrap().len())
}

/// Vertices and faces as an OBJ file.
fn obj(points: &[[f64; 3]], faces: &[Vec<usize>]) -> String {
    let vertex = |[x, y, z]: &[f64; 3]| format!("v {x} {y} {z}\n");
    let face = |f: &Vec<usize>| {
        f.iter().fold("f".to_string(), |line, v| line + &format!(" {}", v + 1)) + "\n"
    };
    points.iter().map(vertex).chain(faces.iter().map(face)).collect()
}

/// Quadrilaterals round a tube, `across` on each ring; open at both ends, standing up.
fn tower(rings: usize, across: usize) -> String {
    let mut points = Vec::new();
    for ring in 0..=rings {
        let height = 600.0 * ring as f64 / rings as f64;
        let radius = 200.0 + 60.0 * (height / 600.0 * 3.0).cos();
        for k in 0..across {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / across as f64).sin_cos();
            points.push([radius * cos, radius * sin, height]);
        }
    }
    let at = |ring: usize, k: usize| ring * across + k % across;
    let face =
        |(r, k): (usize, usize)| vec![at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)];
    let cells = (0..rings).flat_map(|r| (0..across).map(move |k| (r, k)));
    obj(&points, &cells.map(face).collect::<Vec<_>>())
}

#[test]
fn spheres_of_every_operator_make_sound_frames() {
    let dir = tempdir().unwrap();
    let cases = [
        ("sphere:aI/2", 240, 122),
        ("sphere:dI/3", 270, 92),
        ("sphere:kC/2", 144, 96),
        ("sphere:tO/2", 144, 50),
        ("sphere:eD", 120, 62),
        ("sphere:sC", 60, 38),
        ("sphere:gD", 150, 60),
        ("sphere:jD", 60, 30),
    ];
    for (surface, rods, units) in cases {
        assert_eq!(built(dir.path(), &[surface, "--force"]), (rods, units), "{surface}");
    }
}

#[test]
fn the_da_vinci_dome_has_195_rods_in_few_lengths_and_stands() {
    let dir = tempdir().unwrap();
    assert_eq!(built(dir.path(), &["--design", &sample("da-vinci-dome.toml")]), (195, 61));
    let text = std::fs::read_to_string(dir.path().join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(report["measures"]["distinct_lengths"].as_u64().unwrap() <= 10);
    assert!(report["measures"]["supports"].as_u64().unwrap() >= 15);
    assert_eq!(report["surface"]["kind"], "sphere");
}

#[test]
fn a_warp_makes_upper_rods_longer() {
    let dir = tempdir().unwrap();
    let ratio = |warp: &str| {
        built(dir.path(), &["sphere:dI/3", "--warp", warp, "--rod", "2mm"]);
        let structure = structure(&dir.path().join("out"));
        let length = |up: bool| {
            let rods = structure["rods"].as_array().unwrap().iter();
            let z =
                |r: &serde_json::Value| r["a"][2].as_f64().unwrap() + r["b"][2].as_f64().unwrap();
            let these: Vec<f64> = rods
                .filter(|r| if up { z(r) > 300.0 } else { z(r) < -300.0 })
                .map(|r| r["length"].as_f64().unwrap())
                .collect();
            these.iter().sum::<f64>() / these.len() as f64
        };
        length(true) / length(false)
    };
    assert!((ratio("1") - 1.0).abs() < 0.02);
    assert!(ratio("1.2") > 1.2);
}

#[test]
fn a_mesh_of_polygons_needs_no_disk() {
    let dir = tempdir().unwrap();
    std::fs::write(dir.path().join("tower.obj"), tower(8, 14)).unwrap();
    let (rods, units) = built(dir.path(), &["tower.obj", "--pattern", "mesh"]);
    assert_eq!((rods, units), (14 * 8 + 14 * 9, 14 * 8));
    // A ring: closed, with a handle; a rod for each edge.
    assert_eq!(built(dir.path(), &["--design", &sample("ring.toml")]), (288, 96));
    // The cut keeps polygons whole.
    let upper = built(dir.path(), &["tower.obj", "--pattern", "mesh", "--cut", "z=45%"]);
    assert_eq!(upper, (14 * 4 + 14 * 5, 14 * 4));
}

#[test]
fn a_closed_model_is_two_options_from_a_dome() {
    let dir = tempdir().unwrap();
    // The dome closed by its own mirror image, and a speck beside it.
    let igloo = std::fs::read_to_string(sample("igloo.obj")).unwrap();
    let vertices = igloo.lines().filter(|l| l.starts_with("v ")).count();
    let mut closed = igloo.clone();
    for line in igloo.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => closed += &format!("v {x} {y} -{z}\n"),
            ["f", a, b, c] => {
                let [a, b, c] = [a, b, c].map(|n| n.parse::<usize>().unwrap() + vertices);
                closed += &format!("f {a} {c} {b}\n");
            }
            _ => {}
        }
    }
    closed += "v 900 0 100\nv 910 0 100\nv 900 10 100\n";
    let n = 2 * vertices;
    closed += &format!("f {} {} {}\n", n + 1, n + 2, n + 3);
    std::fs::write(dir.path().join("egg.obj"), closed).unwrap();
    let (status, message) = build(dir.path(), &["egg.obj"]);
    assert_eq!(status, 1);
    for option in ["--component", "--cut", "closed", "piece"] {
        assert!(message.contains(option), "{message}");
    }
    let (rods, _) = built(dir.path(), &["egg.obj", "--cut", "z=50%", "--component", "largest"]);
    assert!((100..=150).contains(&rods), "{rods}");
}

#[test]
fn no_rod_crosses_a_window() {
    let dir = tempdir().unwrap();
    // A window of 120 × 110 mm on the side of the dome: triangles with a corner in it go.
    let igloo = std::fs::read_to_string(sample("igloo.obj")).unwrap();
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().skip(1).map(|w| w.parse().unwrap()).collect()
    };
    let points: Vec<Vec<f64>> =
        igloo.lines().filter(|l| l.starts_with("v ")).map(numbers).collect();
    let within = |p: &[f64]| p[0] > 0.0 && p[1].abs() < 60.0 && (60.0..170.0).contains(&p[2]);
    let keep = |line: &&str| {
        !line.starts_with("f ") || !numbers(line).iter().any(|v| within(&points[*v as usize - 1]))
    };
    let text: Vec<&str> = igloo.lines().filter(keep).collect();
    std::fs::write(dir.path().join("window.obj"), text.join("\n")).unwrap();
    built(dir.path(), &["window.obj"]);
    let structure = structure(&dir.path().join("out"));
    for rod in structure["rods"].as_array().unwrap() {
        let end = |e: &str| [0, 1, 2].map(|k| rod[e][k].as_f64().unwrap());
        let (a, b) = (end("a"), end("b"));
        for step in 0..=50 {
            let t = f64::from(step) / 50.0;
            let p = [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            let deep = p[0] > 0.0 && p[1].abs() < 45.0 && (75.0..155.0).contains(&p[2]);
            assert!(!deep, "{} crosses the window at {p:?}", rod["id"]);
        }
    }
}

#[test]
fn design_files_repeat_runs_on_spheres_and_meshes() {
    let dir = tempdir().unwrap();
    let cases: [&[&str]; 3] = [
        &["sphere:aI/2", "--cut", "z=30%", "--warp", "1.1", "--rotate", "10"],
        &["sphere:dI/2", "--turn=-15deg", "--span", "1ft"],
        &[&sample("ring.obj"), "--pattern", "mesh", "--rod", "5mm"],
    ];
    for (i, case) in cases.iter().enumerate() {
        let [first, second] = ["first", "second"].map(|name| format!("{name}{i}"));
        let run = |args: &[&str], out: &str| {
            let mut command = rodwright(dir.path());
            command.arg("build").args(args).args(["-o", out, "-q"]).assert().success();
        };
        run(case, &first);
        run(&["--design", &format!("{first}/design.toml")], &second);
        let [first, second] = [first, second].map(|out| snapshot(&dir.path().join(out)));
        for (name, bytes) in &first {
            assert!(bytes == &second[name], "{name} differs: {case:?}");
        }
    }
}

#[test]
fn what_cannot_be_is_refused_with_the_reason() {
    let dir = tempdir().unwrap();
    let igloo = sample("igloo.obj");
    let ring = sample("ring.obj");
    let cases: [(&[&str], &str); 16] = [
        (&["sphere:axI/2"], "'x' is no operator"),
        (&["sphere:aI/2/3"], "a whole number from 1 to 100"),
        (&["sphere:"], "a seed is missing"),
        (&["sphere:D/2"], "dI/2"),
        (&["sphere:I/90"], "faces"),
        (&["sphere:aI", "--pattern", "6.6.6"], "pattern does nothing here"),
        (&["sphere:aI", "--unit", "50mm"], "unit does nothing here"),
        (&["sphere:aI", "--warp", "9"], "from 0.3125 to 3.2"),
        (&["sphere:aI", "--cut", "z=400mm"], "passes by the sphere"),
        (&["sphere:aI", "--turn", "60"], "and 24 degrees, either way round"),
        (&["sphere:aI/2", "--rod", "90mm"], "rods of at most 15.2 mm"),
        (&[&igloo, "--warp", "1.2"], "warp does nothing here"),
        (&[&igloo, "--cut", "z=900mm"], "reaches from 0 to 220 mm"),
        (&[&igloo, "--component", "3"], "there is no piece 3"),
        (&[&igloo, "--pattern", "mesh"], "a coarser mesh or a larger span"),
        (&[&ring, "--pattern", "mesh", "--origin", "1,1"], "origin does nothing here"),
    ];
    for (args, expected) in cases {
        let (status, message) = build(dir.path(), args);
        assert_eq!(status, 1, "{args:?}: {message}");
        assert!(message.contains(expected), "{args:?}: {message}");
        assert!(!dir.path().join("out").exists(), "{args:?} wrote a folder");
    }
}
