//! Sticks as they are: measured marks and diameters.

use crate::check::check_structure;
use crate::run::{rodwright, sample, snapshot, structure};
use serde_json::Value;
use std::path::Path;
use tempfile::{TempDir, tempdir};

/// A folder with the igloo as planned in `plan`.
fn planned() -> TempDir {
    let dir = tempdir().unwrap();
    run(dir.path(), &["-o", "plan"]);
    dir
}

fn run(dir: &Path, args: &[&str]) -> String {
    let output = rodwright(dir)
        .args(["build", &sample("igloo.obj"), "--only", "csv"])
        .args(args)
        .assert()
        .success();
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

fn report(dir: &Path, out: &str) -> Value {
    serde_json::from_slice(&std::fs::read(dir.join(out).join("report.json")).unwrap()).unwrap()
}

/// The mate, the contact and the mark of every contact of a rod, as structure.json has them.
fn marks(s: &Value, rod: &str) -> Vec<(String, String, f64)> {
    let text = |v: &Value| v.as_str().unwrap().to_owned();
    let seen = |c: &Value| {
        let side = |mate: &str, at: &str| (text(&c[mate]), text(&c["id"]), c[at].as_f64().unwrap());
        if c["over"] == rod {
            Some(side("under", "at_over"))
        } else if c["under"] == rod {
            Some(side("over", "at_under"))
        } else {
            None
        }
    };
    s["contacts"].as_array().unwrap().iter().filter_map(seen).collect()
}

fn write(dir: &Path, name: &str, rows: &[String]) {
    std::fs::write(dir.join(name), rows.join("\n") + "\n").unwrap();
}

/// Rods, their units and who touches whom: what is written on sticks and cards.
fn numbers(s: &Value) -> Vec<String> {
    let contacts = s["contacts"].as_array().unwrap().iter();
    let pairs = contacts.map(|c| format!("{} {} {}", c["id"], c["over"], c["under"]));
    let rods = s["rods"].as_array().unwrap().iter();
    rods.map(|r| format!("{} {} {}", r["id"], r["units"], r["contacts"])).chain(pairs).collect()
}

fn length(s: &Value, rod: &str) -> f64 {
    let rods = s["rods"].as_array().unwrap();
    let rod = rods.iter().find(|r| r["id"] == rod).unwrap();
    let end = |key: &str| [0, 1, 2].map(|i| rod[key][i].as_f64().unwrap());
    let (a, b) = (end("a"), end("b"));
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn one_mark_that_slipped_is_held_and_the_sticks_to_mark_again_are_named() {
    let dir = planned();
    let plan = structure(&dir.path().join("plan"));
    let of = marks(&plan, "R012");
    let row = |i: usize, off: f64| format!("r12,{},{}mm", of[i].0, of[i].2 + off);
    write(dir.path(), "m.csv", &["rod,mate,mark".into(), row(0, 0.0), row(1, 2.0)]);
    let summary = run(dir.path(), &["--as-built", "m.csv", "-o", "out"]);
    assert!(summary.contains("1 rod sawn; 2 marks held, all met; marks are off by"), "{summary}");
    assert!(summary.contains("mark again ") && summary.contains("R012"), "{summary}");

    let s = structure(&dir.path().join("out"));
    check_structure(&s);
    assert_eq!(numbers(&s), numbers(&plan));
    let built = marks(&s, "R012");
    assert!((built[0].2 - of[0].2).abs() < 1e-9, "{built:?}");
    assert!((built[1].2 - of[1].2 - 2.0).abs() < 1e-9, "{built:?}");
    assert!((length(&s, "R012") - length(&plan, "R012")).abs() < 1e-9);

    let what = &report(dir.path(), "out")["as_built"];
    assert_eq!((&what["sawn"], &what["marks"]), (&serde_json::json!(["R012"]), &2.into()));
    // Its card says so; the moves are those from the plan.
    let papers = ["build", &sample("igloo.obj"), "--only", "sheets", "--as-built", "m.csv", "-q"];
    rodwright(dir.path()).args(papers).args(["-o", "papers"]).assert().success();
    let cards = snapshot(&dir.path().join("papers/sheets"));
    let cards: String = cards.values().map(|bytes| String::from_utf8_lossy(bytes)).collect();
    assert_eq!(cards.matches("sawn already, ").count(), 1);
    let moves = |out: &str| report(dir.path(), out)["measures"]["moves"]["max"].as_f64().unwrap();
    let shift = |p: &serde_json::Value, q: &serde_json::Value| {
        let by = (0..3).map(|i| p[i].as_f64().unwrap() - q[i].as_f64().unwrap());
        by.map(|d| d * d).sum::<f64>().sqrt()
    };
    let rods = |s: &serde_json::Value| s["rods"].as_array().unwrap().clone();
    let most = rods(&plan)
        .iter()
        .zip(&rods(&s))
        .flat_map(|(p, q)| ["a", "b"].map(|end| shift(&p[end], &q[end])))
        .fold(0.0, f64::max);
    assert!((moves("out") - most / 3.0).abs() < 1e-9, "{most} {}", moves("out"));
    assert!(what["deviation"].as_f64().unwrap() < 1e-9, "{what}");
    assert!(what["worst_gap"].as_f64().unwrap() < 1e-9, "{what}");
    // What is told of other sticks is what the files say.
    let mut most = 0.0_f64;
    let mut again = Vec::new();
    for rod in plan["rods"].as_array().unwrap().iter().map(|r| r["id"].as_str().unwrap()) {
        let pairs = marks(&plan, rod).into_iter().zip(marks(&s, rod));
        let held = |c: &str| rod == "R012" && [&of[0].1, &of[1].1].iter().any(|h| **h == *c);
        let changes = pairs.filter(|(p, _)| !held(&p.1)).map(|(p, q)| (p.2 - q.2).abs());
        let change = changes.fold(0.0, f64::max);
        most = most.max(change);
        if change > 0.5 {
            again.push(rod);
        }
    }
    assert!((what["mark_change"].as_f64().unwrap() - most).abs() < 1e-6, "{what} {most}");
    let named = what["mark_again"].as_array().unwrap().iter();
    assert!(named.map(|m| m["rod"].as_str().unwrap()).eq(again), "{what}");
}

#[test]
fn what_the_tables_say_changes_nothing() {
    let dir = planned();
    let plan = structure(&dir.path().join("plan"));
    let mut rows = vec!["rod,contact,mark,diameter".to_owned()];
    for rod in ["R001", "R050", "R099", "R124"] {
        let marks = marks(&plan, rod);
        rows.extend(marks.iter().map(|(_, contact, at)| format!("{rod},{contact},{at},")));
        rows.push(format!("{rod},,,3mm"));
    }
    write(dir.path(), "m.csv", &rows);
    run(dir.path(), &["--as-built", "m.csv", "-o", "out"]);
    let s = structure(&dir.path().join("out"));
    check_structure(&s);
    assert_eq!(numbers(&s), numbers(&plan));
    for (p, q) in plan["rods"].as_array().unwrap().iter().zip(s["rods"].as_array().unwrap()) {
        for (end, i) in ["a", "b"].into_iter().flat_map(|end| [0, 1, 2].map(|i| (end, i))) {
            let off = p[end][i].as_f64().unwrap() - q[end][i].as_f64().unwrap();
            assert!(off.abs() < 1e-6, "{} {end}: {off}", p["id"]);
        }
    }
    // Marks as contacts.csv has them, to a micrometre, of every stick.
    let mut rows = vec!["rod,contact,mark".to_owned()];
    let mut reader = csv::Reader::from_path(dir.path().join("plan/contacts.csv")).unwrap();
    for c in reader.records().map(Result::unwrap) {
        rows.push(format!("{},{},{}", &c[2], &c[0], &c[4]));
        rows.push(format!("{},{},{}", &c[3], &c[0], &c[5]));
    }
    write(dir.path(), "all.csv", &rows);
    let summary = run(dir.path(), &["--as-built", "all.csv", "-o", "all"]);
    assert!(summary.contains("nothing: all rods are sawn"), "{summary}");
    let what = &report(dir.path(), "all")["as_built"];
    assert!(what["deviation"].as_f64().unwrap() < 2e-3, "{what}");
    assert_eq!(what["mark_again"], serde_json::json!([]), "{what}");
}

#[test]
fn a_measured_diameter_wins_and_sawn_sticks_are_not_bought_again() {
    let dir = planned();
    let mut rows = vec!["rod,diameter".to_owned()];
    rows.extend((1..=40).map(|i| format!("R{i:03},{}mm", 3.0 + 0.002 * f64::from(i))));
    write(dir.path(), "m.csv", &rows);
    let args = ["--as-built", "m.csv", "--only", "csv,cutlist", "-o", "out"];
    let build = rodwright(dir.path()).args(["build", &sample("igloo.obj")]).args(args).assert();
    build.success();
    let out = dir.path().join("out");
    let s = structure(&out);
    check_structure(&s);
    assert_eq!(s["rods"][6]["diameter"], serde_json::json!(3.014));
    assert_eq!(s["rods"][60]["diameter"], serde_json::json!(3.0));
    let sawn: Vec<u32> = csv::Reader::from_path(out.join("cutlist.csv"))
        .unwrap()
        .records()
        .map(|row| row.unwrap()[3][1..].parse().unwrap())
        .collect();
    assert_eq!(sawn.len(), 84);
    assert!(sawn.iter().all(|rod| *rod > 40));
}

#[test]
fn the_design_file_takes_it_beside_itself_and_repeats_it() {
    let dir = planned();
    let plan = structure(&dir.path().join("plan"));
    let (mate, _, at) = marks(&plan, "R030")[0].clone();
    std::fs::create_dir(dir.path().join("shop")).unwrap();
    write(dir.path(), "shop/m.csv", &["rod,mate,mark".into(), format!("R030,{mate},{}", at + 1.0)]);
    let text = format!("surface = '{}'\nas_built = 'm.csv'\n", sample("igloo.obj"));
    std::fs::write(dir.path().join("shop/d.toml"), text).unwrap();
    let build = |design: &str, out: &str| {
        let args = ["build", "--design", design, "--only", "structure", "-q", "-o", out];
        rodwright(dir.path()).args(args).assert()
    };
    build("shop/d.toml", "first").success();
    let held = marks(&structure(&dir.path().join("first")), "R030")[0].2;
    assert!((held - at - 1.0).abs() < 1e-9);
    // The path stands as it was given, and is looked up beside the file that names it.
    std::fs::copy(dir.path().join("first/design.toml"), dir.path().join("shop/again.toml"))
        .unwrap();
    build("shop/again.toml", "second").success();
    let [first, second] = ["first", "second"].map(|out| snapshot(&dir.path().join(out)));
    assert_eq!(first["structure.json"], second["structure.json"]);
    assert_eq!(first["design.toml"], second["design.toml"]);
    build("first/design.toml", "third").failure();
}

#[test]
fn rows_that_cannot_be_are_refused_with_file_and_line() {
    let dir = planned();
    let plan = structure(&dir.path().join("plan"));
    let (mate, contact, at) = marks(&plan, "R012")[0].clone();
    let other = marks(&plan, "R100")[0].1.clone();
    let cases = [
        (format!("rod,mate,mark\nR012,{mate},{at}\nR999,R001,5\n"), "line 3: there is no rod R999"),
        (format!("rod,mate,mark\nR012,R100,{at}\n"), "line 2: R012 does not touch R100"),
        (format!("rod,contact,mark\nR012,{other},{at}\n"), "line 2: R012 does not touch"),
        (format!("rod,contact,mark\nR012,{contact},{at}cm\n"), "was planned at"),
        (
            format!("rod,mate,mark\nR012,{mate},{at}\nR012,{mate},{at}\n"),
            "line 3: the mark of R012",
        ),
        ("rod,mate,lenght\nR012,R009,3\n".into(), "line 1: `lenght` is no column"),
        ("rod,diameter\nR012,3 furlongs\n".into(), "line 2: diameter: `furlongs`"),
        ("rod,mate,mark\n".into(), "no row follows"),
    ];
    for (text, words) in cases {
        std::fs::write(dir.path().join("m.csv"), &text).unwrap();
        let args = ["build", &sample("igloo.obj"), "--as-built", "m.csv", "-o", "out"];
        let output = rodwright(dir.path()).args(args).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{text}: {message}");
        assert!(message.contains("m.csv: ") && message.contains(words), "{text}: {message}");
        assert!(!dir.path().join("out").exists());
    }
    let args = ["build", &sample("igloo.obj"), "--as-built", "nowhere.csv", "-o", "out"];
    let output = rodwright(dir.path()).args(args).output().unwrap();
    assert!(String::from_utf8(output.stderr).unwrap().contains("cannot read nowhere.csv"));
    let args = ["--close", "paper", "--as-built", "m.csv"];
    let output =
        rodwright(dir.path()).args(["build", &sample("igloo.obj")]).args(args).output().unwrap();
    assert!(String::from_utf8(output.stderr).unwrap().contains("close = paper leaves gaps"));
}
