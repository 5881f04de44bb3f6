//! Laser-cut jigs, run as a user runs it.

use crate::run::{rodwright, sample, snapshot};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tempfile::tempdir;

/// Builds the jigs of the igloo with these options; the files by their names.
fn jigs(dir: &Path, args: &[&str]) -> BTreeMap<String, String> {
    rodwright(dir)
        .args(["build", &sample("igloo.obj"), "--only", "jigs", "-q", "--force", "-o", "out"])
        .args(args)
        .assert()
        .success();
    let files = snapshot(&dir.join("out"));
    let texts = files.into_iter().map(|(name, bytes)| (name, String::from_utf8(bytes).unwrap()));
    texts.filter(|(name, _)| name.starts_with("jigs")).collect()
}

/// The value of an attribute of an element.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let rest = line.split_once(&format!(" {name}=\""))?.1;
    rest.split_once('"').map(|(value, _)| value)
}

type Segment = [(i64, i64); 2];

/// The straight pieces of an element, in 0.0001 mm, their ends in order.
fn segments(line: &str) -> Vec<Segment> {
    let Some(points) = attribute(line, "points") else { return Vec::new() };
    let number = |n: &str| (n.parse::<f64>().unwrap() * 1e4).round() as i64;
    let point = |p: &str| {
        let (x, y) = p.split_once(',').unwrap();
        (number(x), number(y))
    };
    let mut points: Vec<_> = points.split(' ').map(point).collect();
    if line.starts_with("<polygon") {
        points.push(points[0]);
    }
    points.windows(2).map(|w| [w[0].min(w[1]), w[0].max(w[1])]).collect()
}

#[test]
fn sheets_are_plain_lines_in_the_order_in_which_they_are_burnt() {
    let dir = tempdir().unwrap();
    let files = jigs(dir.path(), &[]);
    let svgs: Vec<_> = files.iter().filter(|(name, _)| name.ends_with(".svg")).collect();
    assert!(svgs.len() > 2 && files.len() == 2 * svgs.len());
    let (all, sheets): (Vec<_>, Vec<_>) = svgs.into_iter().partition(|f| f.0 == "jigs.svg");
    let figures = |text: &str| text.matches("<poly").count() + text.matches("<circle").count();
    let single: usize = sheets.iter().map(|(_, text)| figures(text)).sum();
    assert_eq!(figures(all[0].1), single);
    // Two columns and three rows, 20 mm apart.
    assert!(sheets.len() == 5 && all[0].1.contains("viewBox=\"0 0 1220 1240\""));
    for (name, text) in sheets {
        assert!(text.contains("width=\"600mm\"") && text.contains("viewBox=\"0 0 600 400\""));
        for word in ["<text", "style", "transform", "clip", "<path", "<line"] {
            assert!(!text.contains(word), "{name} has {word}");
        }
        let labels: Vec<&str> =
            text.lines().filter_map(|line| attribute(line, "inkscape:label")).collect();
        let all = ["ENGRAVE", "SCORE", "CUT inner", "CUT outer"];
        let there: Vec<&str> = all.into_iter().filter(|l| labels.contains(l)).collect();
        assert_eq!(labels, there, "{name}");
        assert!(text.contains("points=\"5,395 105,395 105,385 5,385\""), "{name}");
        let mut seen: BTreeSet<Segment> = BTreeSet::new();
        for line in text.lines() {
            if attribute(line, "stroke") == Some("#FF0000") {
                assert!(line.starts_with("<polygon") || line.starts_with("<circle"), "{line}");
            }
            for segment in segments(line) {
                assert_ne!(segment[0], segment[1], "{name}: {line}");
                assert!(seen.insert(segment), "{name}: {segment:?} twice");
            }
        }
        assert!(seen.len() > 100);
    }
}

/// Group codes and values of a DXF file.
fn pairs(text: &str) -> Vec<(&str, &str)> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines.chunks(2).map(|p| (p[0], p[1])).collect()
}

#[test]
fn cuts_are_closed_in_cad_and_layers_have_their_colours() {
    let dir = tempdir().unwrap();
    for (name, text) in jigs(dir.path(), &["--laser", "ponoko"]) {
        if !name.ends_with(".dxf") {
            continue;
        }
        let pairs = pairs(&text);
        let after = |at: usize, code: &str| pairs[at..].iter().find(|p| p.0 == code).unwrap().1;
        let variable = |v: &str| pairs.iter().position(|p| *p == ("9", v)).unwrap() + 1;
        assert_eq!(pairs[variable("$INSUNITS")], ("70", "4"));
        assert_eq!(pairs[variable("$MEASUREMENT")], ("70", "1"));
        for (i, pair) in pairs.iter().enumerate() {
            match *pair {
                ("2", "CUT") => assert_eq!(after(i, "62"), "1"),
                ("2", "SCORE") => assert_eq!(after(i, "62"), "5"),
                ("2", "ENGRAVE") => assert_eq!(after(i, "62"), "7"),
                ("2", "GUIDE") => assert_eq!(after(i, "62"), "8"),
                ("0", "LWPOLYLINE") if after(i, "8") == "CUT" => {
                    assert_eq!(after(i, "70"), "1", "{name}");
                }
                ("0", "TEXT" | "LINE") => panic!("{name}: letters are strokes of polylines"),
                _ => {}
            }
        }
        assert!(pairs.contains(&("8", "CUT")) && pairs.contains(&("8", "GUIDE")), "{name}");
    }
}

#[test]
fn every_laser_gets_its_colours_and_lines() {
    let dir = tempdir().unwrap();
    for (laser, cut, score, width, dxf) in [
        ("generic", "#FF0000", "#0000FF", "0.01", true),
        ("lightburn", "#FF0000", "#0000FF", "0.01", true),
        ("ponoko", "#0000FF", "#FF0000", "0.01", true),
        ("trotec", "#FF0000", "#0000FF", "0.01", true),
        ("epilog", "#FF0000", "#0000FF", "0.025", true),
        ("glowforge", "#FF0000", "#0000FF", "0.01", false),
    ] {
        // One sheet is one file in the folder itself.
        let files = jigs(dir.path(), &["--laser", laser, "--jigs", "diameter,coupon"]);
        assert_eq!(files.contains_key("jigs.dxf"), dxf, "{laser}");
        assert_eq!(files.len(), if dxf { 2 } else { 1 }, "{laser}");
        let circle = files["jigs.svg"].lines().find(|l| l.starts_with("<circle")).unwrap();
        assert_eq!(attribute(circle, "stroke"), Some(cut), "{laser}");
        assert_eq!(attribute(circle, "stroke-width"), Some(width), "{laser}");
        let scored = files["jigs.svg"].lines().find(|l| l.starts_with("<polyline")).unwrap();
        assert_eq!(attribute(scored, "stroke"), Some(score), "{laser}");
    }
}

#[test]
fn the_cut_goes_by_the_material_and_zero_gives_exact_lines() {
    let dir = tempdir().unwrap();
    let smallest = |args: &[&str]| {
        let files = jigs(dir.path(), &[&["--jigs", "diameter"], args].concat());
        let circles = files["jigs.svg"].lines().filter(|l| l.starts_with("<circle"));
        let radii = circles.map(|l| attribute(l, "r").unwrap().parse::<f64>().unwrap());
        radii.fold(f64::INFINITY, f64::min)
    };
    for (args, kerf) in [
        (&[][..], 0.20),
        (&["--material", "mdf"], 0.18),
        (&["--material", "acrylic"], 0.15),
        (&["--material", "card"], 0.15),
        (&["--material", "card", "--laser-kerf", "0.3mm"], 0.3),
        (&["--laser-kerf", "0"], 0.0),
    ] {
        assert!((2.0 * smallest(args) - (2.7 - kerf)).abs() < 1e-6, "{args:?}");
    }
}

#[test]
fn the_design_file_keeps_what_jigs_are_cut_from() {
    let dir = tempdir().unwrap();
    let given = ["--jigs", "coupon,stops", "--sheet", "30x20cm", "--thickness", "4mm"];
    let first = jigs(dir.path(), &[&given[..], &["--laser", "epilog"]].concat());
    rodwright(dir.path())
        .args(["build", "--design", "out/design.toml", "-q", "-o", "again"])
        .assert()
        .success();
    let again = snapshot(&dir.path().join("again"));
    for (name, text) in &first {
        assert_eq!(again[name], text.as_bytes(), "{name}");
    }
    assert!(first["jigs.svg"].contains("width=\"300mm\""));
}

#[test]
fn jigs_that_do_not_fit_are_left_out_and_refused_where_they_are_named() {
    let dir = tempdir().unwrap();
    let build = |args: &[&str]| {
        let output = rodwright(dir.path())
            .args(["build", &sample("igloo.obj"), "-o", "out", "--force"])
            .args(args)
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let large = ["--span", "3m", "--rod", "15mm"];
    let (code, _) = build(&[&large[..], &["--only", "csv,jigs,cutlist"]].concat());
    assert_eq!(code, Some(1));
    assert!(!dir.path().join("out").exists());
    let (code, message) = build(&[&large[..], &["--only", "jigs"]].concat());
    assert!(code == Some(1) && message.contains("base plate"), "{message}");
    assert!(message.contains("--sheet") && message.contains("--jigs marking,"), "{message}");
    let (code, message) = build(&large);
    assert_eq!(code, Some(0), "{message}");
    let report = std::fs::read(dir.path().join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    assert!(report["jigs"]["left_out"].as_str().unwrap().contains("base plate"));
    assert!(!snapshot(&dir.path().join("out")).keys().any(|name| name.starts_with("jigs")));
}

#[test]
fn settings_that_no_laser_can_keep_are_refused() {
    let dir = tempdir().unwrap();
    for (args, words) in [
        (["--sheet", "100x50mm"], "at least 120 mm"),
        (["--thickness", "0mm"], "more than nothing"),
        (["--thickness", "40mm"], "up to 25 mm"),
        (["--laser-kerf", "2mm"], "--thickness"),
        (["--laser-kerf", "-1mm"], "negative"),
    ] {
        let output = rodwright(dir.path())
            .args(["build", &sample("igloo.obj"), "--only", "jigs", "-o", "none"])
            .arg(format!("{}={}", args[0], args[1]))
            .output()
            .unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}: {message}");
        assert!(message.contains(words), "{args:?}: {message}");
        assert!(!dir.path().join("none").exists());
    }
}
