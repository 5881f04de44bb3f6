//! Labels for the rods, run as a user runs it.

use crate::run::{rodwright, sample, snapshot};
use lopdf::Document;
use std::path::Path;
use tempfile::tempdir;

/// Builds the labels of the igloo with these options and reads the file back.
fn labels(dir: &Path, args: &[&str]) -> Document {
    rodwright(dir)
        .args(["build", &sample("igloo.obj"), "--only", "labels", "-q", "--force", "-o", "out"])
        .args(args)
        .assert()
        .success();
    Document::load(dir.join("out/labels.pdf")).unwrap()
}

/// Width and height of the first page, mm, and the numbers of rods on each page.
fn seen(file: &Document) -> ([f64; 2], Vec<usize>) {
    let pages = file.get_pages();
    let page = file.get_dictionary(pages[&1]).unwrap();
    let page_box = page.get(b"MediaBox").unwrap().as_array().unwrap();
    let mm =
        |i: usize| (f64::from(page_box[i].as_float().unwrap()) * 25.4 / 72.0 * 10.0).round() / 10.0;
    let rods = |page: &u32| {
        let text = file.extract_text(&[*page]).unwrap();
        let number = |word: &&str| {
            word.len() == 4
                && word.starts_with('R')
                && word[1..].bytes().all(|b| b.is_ascii_digit())
        };
        let lines = text.lines().map(str::trim);
        lines.filter(|line| number(line)).count()
    };
    ([mm(2), mm(3)], pages.keys().map(rods).collect())
}

#[test]
fn every_sheet_of_labels_has_its_own_size_and_all_rods() {
    let dir = tempdir().unwrap();
    let rods = labels(dir.path(), &[]);
    let rods: usize = seen(&rods).1.iter().sum();
    assert!(rods >= 100);
    for (name, size, on_sheet) in [
        ("L7160", [210.0, 297.0], 21),
        ("l7651", [210.0, 297.0], 65),
        ("l8658", [210.0, 297.0], 189),
        ("5160", [215.9, 279.4], 30),
        ("5167", [215.9, 279.4], 80),
    ] {
        let file = labels(dir.path(), &["--labels", name, "--paper", "a3"]);
        let (paper, pages) = seen(&file);
        assert_eq!(paper, size, "{name}");
        assert_eq!(pages.iter().sum::<usize>(), rods, "{name}");
        assert_eq!(pages[0], rods.min(on_sheet), "{name}");
        let catalog = file.catalog().unwrap();
        let viewing = catalog.get(b"ViewerPreferences").unwrap().as_dict().unwrap();
        assert_eq!(viewing.get(b"PrintScaling").unwrap().as_name().unwrap(), b"None");
    }
}

#[test]
fn a_half_used_sheet_is_begun_where_it_is_free_and_the_design_file_keeps_that() {
    let dir = tempdir().unwrap();
    let file = labels(dir.path(), &["--labels", "l7160", "--label-start", "20"]);
    assert_eq!(seen(&file).1[..2], [2, 21]);
    let first = snapshot(&dir.path().join("out"));
    assert!(first.contains_key("labels/01-labels.svg"));
    rodwright(dir.path())
        .args(["build", "--design", "out/design.toml", "-q", "-o", "again"])
        .assert()
        .success();
    let again = snapshot(&dir.path().join("again"));
    assert!(first["labels.pdf"] == again["labels.pdf"] && first.len() == again.len());
}

#[test]
fn lengths_in_inches_come_as_decimals_or_fractions() {
    let dir = tempdir().unwrap();
    for (units, length) in [("in", "4.70 in"), ("in/16", "4 11/16 in"), ("in/32", "4 23/32 in")] {
        let file = labels(dir.path(), &["--units", units, "--round", "0.5mm"]);
        let pages: Vec<u32> = file.get_pages().into_keys().collect();
        let text = file.extract_text(&pages).unwrap();
        assert!(text.contains(length), "{units}: {text}");
        let design = std::fs::read_to_string(dir.path().join("out/design.toml")).unwrap();
        assert!(design.contains(&format!("units = \"{units}\"")), "{design}");
    }
}

#[test]
fn labels_that_do_not_exist_are_refused_with_those_that_do() {
    let dir = tempdir().unwrap();
    let refused = |args: &[&str]| {
        let output = rodwright(dir.path())
            .args(["build", &sample("igloo.obj"), "-o", "none"])
            .args(args)
            .output()
            .unwrap();
        assert!(!dir.path().join("none").exists());
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, message) = refused(&["--labels", "l9999"]);
    assert_eq!(code, Some(2));
    for name in ["strips", "l7160", "l7651", "l8658", "5160", "5167"] {
        assert!(message.contains(name), "{message}");
    }
    let (code, message) = refused(&["--labels", "5160", "--label-start", "31"]);
    assert!(code == Some(1) && message.contains("1 to 30"), "{message}");
    let (code, message) = refused(&["--label-start", "2"]);
    assert!(code == Some(1) && message.contains("plain paper"), "{message}");
    std::fs::write(dir.path().join("bad.toml"), "labels = \"l9\"\n").unwrap();
    let (code, message) = refused(&["--design", "bad.toml"]);
    assert!(code == Some(1) && message.contains("5167"), "{message}");
}
