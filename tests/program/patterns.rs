//! Patterns: the library, files of one's own, and the check of their rules.

use crate::run::{rodwright, sample, snapshot, structure};
use rodwright::pattern::library;
use serde_json::Value;
use std::path::Path;
use tempfile::{TempDir, tempdir};

/// Exit status, standard output and messages.
fn run(dir: &Path, args: &[&str]) -> (i32, String, String) {
    let output = rodwright(dir).args(args).output().unwrap();
    let [out, messages] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    (output.status.code().expect("an exit status, not a signal"), out, messages)
}

fn patterns(dir: &Path, args: &[&str]) -> (i32, String, String) {
    run(dir, &[&["patterns"], args].concat())
}

/// A pattern file of polygons named by their numbers of sides.
fn file(sides: &[usize], rules: &[&str]) -> String {
    let units = sides.iter().map(|n| format!("[[units]]\nname = \"u{n}\"\nsides = {n}\n"));
    let rules = rules.iter().map(|rule| {
        let (a, b) = rule.split_once('-').unwrap();
        format!("[[rules]]\nunits = [\"u{a}\", \"u{b}\"]\njoin = \"shared\"\n")
    });
    units.chain(rules).collect()
}

/// A folder with pattern files for the tests.
fn folder() -> TempDir {
    let dir = tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    write("mixed.toml", &file(&[3, 4], &["3-3", "3-4"]));
    write("basket.toml", &file(&[3, 6], &["3-6"]));
    write("rows.toml", &file(&[3, 4], &["4.1-3.1", "4.3-3.1", "4.2-4.4", "3.2-3.2", "3.3-3.3"]));
    write("gap.toml", &file(&[4, 6], &["4-6"]));
    write("five.toml", &file(&[5], &["5-5"]));
    write("own.toml", &file(&[4], &["4-4"]).replace("shared", "end"));
    dir
}

#[test]
fn all_patterns_are_listed_in_lines_that_fit() {
    let dir = tempdir().unwrap();
    let (status, page, _) = patterns(dir.path(), &[]);
    assert_eq!(status, 0);
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for pattern in library() {
        let first = |l: &str| l.split_whitespace().next() == Some(&pattern.name);
        let starts = |l: &str| (l.contains('°') || l.contains("fixed")) && first(l);
        let row = page.lines().position(starts);
        let at = row.unwrap_or_else(|| panic!("{} is not in\n{page}", pattern.name));
        let [least, most] = pattern.turn.safe;
        let turns = if least == most { "fixed".into() } else { format!("{least} to {most}°") };
        let start: Vec<&str> = page.lines().skip(at).take(4).collect();
        assert!(start[0].contains(&turns), "{turns}: {}", start[0]);
        let summary: Vec<&str> = pattern.summary.split(' ').take(3).collect();
        assert!(words(start[0]).contains(&summary.join(" ")), "{}", start[0]);
    }
}

#[test]
fn programs_get_the_list_as_json() {
    let dir = tempdir().unwrap();
    let list = |args: &[&str]| -> Value {
        let (status, text, message) = patterns(dir.path(), args);
        assert_eq!(status, 0, "{message}");
        serde_json::from_str(&text).unwrap()
    };
    let all = list(&["--json"]);
    let names: Vec<&str> =
        all.as_array().unwrap().iter().map(|p| p["name"].as_str().unwrap()).collect();
    assert_eq!(names, library().iter().map(|p| p.name.as_str()).collect::<Vec<_>>());
    let one = list(&["3.12.12", "--json"]);
    assert_eq!(one.as_array().unwrap().len(), 1);
    assert_eq!(one[0], all[names.iter().position(|n| *n == "3.12.12").unwrap()]);
    assert_eq!(one[0]["turn"], serde_json::json!({ "usual": 24.0, "safe": [12.0, 44.0] }));
    let unit = serde_json::json!({ "name": "dodecagon", "sides": 12, "mirrored": false });
    assert_eq!(one[0]["units"][1], unit);
    let rule = serde_json::json!({ "units": ["triangle", "dodecagon"], "join": "shared" });
    assert_eq!(one[0]["rules"][0], rule);
}

#[test]
fn everything_is_told_of_one_pattern() {
    let dir = folder();
    let (status, page, _) = patterns(dir.path(), &["3.6.3.6"]);
    assert_eq!(status, 0);
    for text in ["basket work", "Song et al.", "safe from 8 to 24°", "hexagon       6 rods"] {
        assert!(page.contains(text), "{text} is not in\n{page}");
    }
    assert!(page.contains("triangle meets hexagon: one rod serves both"), "{page}");
    let (status, page, _) = patterns(dir.path(), &["rows.toml"]);
    assert_eq!(status, 0);
    assert!(page.starts_with("rows\n") && page.contains("3.3.3.4.4"), "{page}");
    assert!(page.contains("side 1 of u4 meets side 1 of u3"), "{page}");
    let (status, page, _) = patterns(dir.path(), &["3.3.4.3.4", "--cycle", "3.3.3.3.3.3"]);
    assert_eq!((status, page.starts_with("3.3.4.3.4 as 3.3.3.3.3.3\n")), (0, true), "{page}");
}

#[test]
fn names_that_are_wrong_are_answered_with_near_ones() {
    let dir = folder();
    for (args, status, word) in [
        (&["3.6.6.3"][..], 1, "3.6.3.6"),
        (&["none.toml"], 3, "cannot read none.toml"),
        (&["mixed.toml"], 1, "mixed.toml: the rules make 3.3.3.3.3.3, 3.3.4.3.4"),
        (&["3.3.4.3.4", "--cycle", "6.6.6"], 1, "no rule is about a unit of 6 sides"),
        (&["--cycle", "6.6.6"], 2, "--check"),
        (&["4.4.4.4", "--check", "mixed.toml"], 2, "cannot be used with"),
    ] {
        let (code, page, message) = patterns(dir.path(), args);
        assert_eq!((code, page.as_str()), (status, ""), "{args:?}: {message}");
        assert!(message.contains(word), "{args:?}: {message}");
    }
}

#[test]
fn the_check_tells_what_rules_make() {
    let dir = folder();
    let check = |args: &[&str]| {
        let (status, page, message) = patterns(dir.path(), &[&["--check"], args].concat());
        assert_eq!((status, message.as_str()), (0, ""), "{args:?}");
        page
    };
    let page = check(&["mixed.toml"]);
    for line in [
        "  3.3.3.3.3.3  u3, u3, u3, u3, u3, u3\n",
        "  3.3.4.3.4    u3, u3, u4, u3, u4\n",
        "\n  3.3.3.3.3.3+3.3.4.3.4\n",
        "any of these: say which",
    ] {
        assert!(page.contains(line), "{line} is not in\n{page}");
    }
    let page = check(&["mixed.toml", "--cycle", "3.3.4.3.4"]);
    assert!(page.ends_with("The file makes\n  3.3.4.3.4, as asked for\n"), "{page}");
    let page = check(&["basket.toml"]);
    assert!(page.ends_with("The file makes\n  3.6.3.6, the only one\n"), "{page}");
    let found: Value = serde_json::from_str(&check(&["rows.toml", "--json"])).unwrap();
    assert_eq!(found["takes"], "3.3.3.4.4");
    assert_eq!(found["cycles"][0]["units"].as_array().unwrap().len(), 5);
}

#[test]
fn rules_that_make_nothing_are_refused_with_their_walks() {
    let dir = folder();
    let (status, page, message) = patterns(dir.path(), &["--check", "five.toml"]);
    assert_eq!((status, page.as_str()), (1, ""));
    assert!(message.starts_with("error: five.toml: no walk"), "{message}");
    let walk = "\n  u5, u5, u5, u5: 324° without the last, 432° with it, 72° past 360°\n";
    assert!(message.contains(walk), "{message}");
    let (status, _, message) = patterns(dir.path(), &["--check", "gap.toml"]);
    let walk = "\n  u4, u6, u4, u6: 300° without the last, 420° with it, 60° past 360°\n";
    assert_eq!((status, message.contains(walk)), (1, true), "{message}");
    let (status, page, message) =
        patterns(dir.path(), &["--check", "basket.toml", "--cycle", "6.6.6"]);
    assert!(status == 1 && page.contains("3.6.3.6"), "{page}");
    assert!(message.contains("no rule joins two units of 6 sides"), "{message}");
    assert_eq!(patterns(dir.path(), &["--check", "none.toml"]).0, 3);
}

/// A file with the rules of a pattern of the library makes the same frame.
#[test]
fn frames_are_built_of_pattern_files() {
    let dir = folder();
    let igloo = sample("igloo.obj");
    let build = |args: &[&str], out: &str| {
        let args = [&["build", &igloo, "-q", "-o", out][..], args].concat();
        let (status, _, message) = run(dir.path(), &args);
        assert_eq!(status, 0, "{args:?}: {message}");
        structure(&dir.path().join(out))
    };
    let own = build(&["--pattern", "basket.toml", "--only", "structure"], "own");
    let known = build(&["--pattern", "3.6.3.6", "--only", "structure"], "known");
    assert_eq!(own["rods"], known["rods"]);
    let own = build(&["--pattern", "mixed.toml", "--cycle", "3.3.4.3.4"], "first");
    let known = build(&["--pattern", "3.3.4.3.4", "--only", "structure"], "known2");
    assert_eq!(own["rods"], known["rods"]);

    let design = std::fs::read_to_string(dir.path().join("first/design.toml")).unwrap();
    assert!(design.contains("pattern = \"mixed.toml\"\ncycle = \"3.3.4.3.4\"\n"), "{design}");
    let again = ["build", "--design", "first/design.toml", "-q", "-o", "second"];
    assert_eq!(run(dir.path(), &again).0, 0);
    let [first, second] = ["first", "second"].map(|out| snapshot(&dir.path().join(out)));
    assert!(first == second);
}

#[test]
fn pattern_files_are_looked_up_beside_the_design() {
    let dir = folder();
    let inner = dir.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    std::fs::rename(dir.path().join("basket.toml"), inner.join("basket.toml")).unwrap();
    let design = "pattern = \"basket.toml\"\nonly = [\"structure\"]\n";
    std::fs::write(inner.join("design.toml"), design).unwrap();
    let igloo = sample("igloo.obj");
    let build = ["build", &igloo, "--design", "inner/design.toml", "-q", "-o", "out"];
    let (status, _, message) = run(dir.path(), &build);
    assert_eq!(status, 0, "{message}");
    // Named on the command line, it is looked up where we are.
    let named = [&build[..], &["--pattern", "basket.toml"]].concat();
    let (status, _, message) = run(dir.path(), &named);
    assert_eq!(status, 3);
    assert!(message.contains("cannot read basket.toml"), "{message}");
}

#[test]
fn pattern_files_that_cannot_be_built_are_refused() {
    let dir = folder();
    let igloo = sample("igloo.obj");
    for (args, status, word) in [
        (&["--pattern", "none.toml"][..], 3, "cannot read none.toml"),
        (&["--pattern", "five.toml"], 1, "five.toml: no walk"),
        (&["--pattern", "mixed.toml"], 1, "mixed.toml: the rules make"),
        (&["--pattern", "own.toml", "--slide", "0.2"], 1, "its rods do not slide"),
        (&["--slide", "0.2"], 1, "holds together between -0.05 and 0.05 tile edges"),
        (&["--turn", "8deg", "--slide", "0.05"], 1, "holes of every square"),
        (&["--pattern", "basket.toml", "--cycle", "6.6.6"], 1, "basket.toml: the rules do not"),
        (&["--cycle", "6.6.6"], 1, "cycle = 6.6.6: the rules do not make the tiling"),
        (&["--pattern", "mesh", "--cycle", "6.6.6"], 1, "cycle does nothing here"),
    ] {
        let all = [&["build", &igloo, "-o", "out"][..], args].concat();
        let (code, _, message) = run(dir.path(), &all);
        assert_eq!(code, status, "{args:?}: {message}");
        assert!(message.contains(word), "{args:?}: {message}");
        assert!(!dir.path().join("out").exists());
    }
}

#[test]
fn patterns_are_drawn_alone_and_together() {
    let dir = tempdir().unwrap();
    assert_eq!(patterns(dir.path(), &["da-vinci", "--svg", "one.svg"]).0, 0);
    let one = std::fs::read_to_string(dir.path().join("one.svg")).unwrap();
    assert!(one.contains("<svg ") && one.contains(">da-vinci<"), "{}", &one[..200]);
    assert_eq!(patterns(dir.path(), &["--gallery", "all.svg"]).0, 0);
    let all = std::fs::read_to_string(dir.path().join("all.svg")).unwrap();
    for pattern in library() {
        assert!(all.contains(&format!(">{}<", pattern.name)), "{}", pattern.name);
    }
    let (status, _, message) = patterns(dir.path(), &["--svg", "one.svg"]);
    assert_eq!(status, 2, "{message}");
    let (status, _, _) = patterns(dir.path(), &["da-vinci", "--svg", "none/one.svg"]);
    assert_eq!(status, 3);
}

#[test]
fn all_patterns_are_tried_on_a_surface() {
    let dir = tempdir().unwrap();
    let igloo = sample("igloo.obj");
    let (status, text, message) = patterns(dir.path(), &["--on", &igloo, "--json"]);
    assert_eq!(status, 0, "{message}");
    let rows: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), library().len());
    for (row, pattern) in rows.iter().zip(library()) {
        assert_eq!(row["pattern"], *pattern.name);
        assert!(row["rods"].as_u64().is_some_and(|n| n > 20), "{row}");
    }
    // The figures are those of a build.
    let built = ["build", &igloo, "--pattern", "bug", "--only", "structure", "-o", "out", "-q"];
    assert_eq!(run(dir.path(), &built).0, 0);
    let report = std::fs::read(dir.path().join("out/structure.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    let bug = rows.iter().find(|r| r["pattern"] == "bug").unwrap();
    assert_eq!(bug["rods"].as_u64(), report["rods"].as_array().map(|r| r.len() as u64));
    let (status, _, message) = patterns(dir.path(), &["--on", "none.obj"]);
    assert_eq!((status, message.contains("none.obj")), (3, true), "{message}");
}

#[test]
fn named_patterns_are_tried_on_several_surfaces_in_one_table() {
    let dir = tempdir().unwrap();
    let on = [sample("igloo.obj"), sample("peanut.toml")];
    let tried = ["4.4.4.4", "3.12.12", "--on", &on[0], "--on", &on[1]];
    let (status, text, message) = patterns(dir.path(), &tried);
    assert_eq!(status, 0, "{message}");
    let rows: Vec<Vec<&str>> = text
        .lines()
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows[0][..3], ["surface", "pattern", "rod, mm"], "{text}");
    let [igloo, peanut] = [0, 1].map(|i| on[i].as_str());
    let all = [
        [igloo, "4.4.4.4", "3"],
        [igloo, "3.12.12", "3"],
        [peanut, "4.4.4.4", "4"],
        [peanut, "3.12.12", "4"],
    ];
    assert_eq!(rows.len(), 2 + all.len(), "{text}");
    for (row, names) in rows[2..].iter().zip(all) {
        assert_eq!(row[..3], names);
        assert!(row[9] == "-" || row[9].parse::<f64>().unwrap() < 1e-9, "{row:?}");
    }
    // Every frame that could not be made has its reason below.
    let failed = rows.iter().filter(|row| row[9] == "-").count();
    assert_eq!(text.lines().filter(|line| line.contains(".12: ")).count(), failed, "{text}");
    for wrong in
        [&["4.4.4.4", "6.6.6", "--svg", "a.svg"][..], &["4.4.4.4", "6.6.6", "--cycle", "x"]]
    {
        let (status, _, message) = patterns(dir.path(), wrong);
        assert_eq!((status, message.contains("Leave out 6.6.6")), (2, true), "{message}");
    }
}

#[test]
fn rods_that_reach_too_far_are_refused_with_the_reason() {
    let dir = tempdir().unwrap();
    let text = "tiling = \"4.4.4.4\"\nslide = { usual = 0.1, safe = [0, 0.3] }\n[[units]]\n\
                name = \"square\"\nsides = 4\n[[rules]]\nunits = [\"square\", \"square\"]\n\
                join = \"rest\"\nreach = 2\n";
    std::fs::write(dir.path().join("far.toml"), text).unwrap();
    let igloo = sample("igloo.obj");
    let (status, _, message) =
        run(dir.path(), &["build", &igloo, "--pattern", "far.toml", "-o", "out"]);
    assert_eq!(status, 1);
    assert!(message.contains("straight rods can meet at once"), "{message}");
    assert!(!dir.path().join("out").exists());
}
