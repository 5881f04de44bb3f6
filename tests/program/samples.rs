//! The sample surfaces and designs, and the page that shows them.

use crate::check::check_structure;
use crate::run::{rodwright, sample, structure};
use std::path::PathBuf;
use tempfile::tempdir;

/// Files in samples/ with this ending, by name.
fn files(ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(sample("")).unwrap();
    let paths = entries.map(|e| e.unwrap().path());
    let mut files: Vec<PathBuf> =
        paths.filter(|p| p.extension().is_some_and(|e| e == ending)).collect();
    files.sort();
    files
}

fn stem(file: &std::path::Path) -> String {
    file.file_stem().unwrap().to_string_lossy().into_owned()
}

#[test]
fn every_sample_is_listed_kept_on_disk_and_has_a_design() {
    let dir = tempdir().unwrap();
    let output = rodwright(dir.path()).arg("sample").assert().success();
    let list = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(list.lines().count() >= 13, "{list}");
    let designs: Vec<String> = files("toml").iter().map(|f| stem(f)).collect();
    for line in list.lines() {
        let name = line.split_whitespace().next().unwrap();
        let output = rodwright(dir.path()).args(["sample", name]).assert().success();
        let kept = std::fs::read(sample(&format!("{name}.obj"))).unwrap();
        assert!(output.get_output().stdout == kept, "samples/{name}.obj is out of date");
        assert!(designs.iter().any(|d| d == name), "samples/{name}.toml is missing");
    }
}

#[test]
fn every_sample_design_builds_and_leaves_nothing_out() {
    let dir = tempdir().unwrap();
    for file in files("toml") {
        let name = stem(&file);
        let out = dir.path().join(&name);
        rodwright(dir.path())
            .args(["build", "--only", "structure", "-q", "--design"])
            .arg(&file)
            .arg("-o")
            .arg(&out)
            .assert()
            .success()
            .stderr("");
        let structure = structure(&out);
        let rods = check_structure(&structure);
        assert!((50..=300).contains(&rods), "{name}: {rods} rods");
        assert_eq!(structure["report"]["dropped"], serde_json::json!([]), "{name}");
        let report = std::fs::read(out.join("report.json")).unwrap();
        let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
        let moved = report["measures"]["moves"]["median"].as_f64().unwrap();
        assert!(moved < 2.0, "{name}: rods moved by {moved} diameters");
    }
}

#[test]
fn the_gallery_shows_designs_in_the_order_given() {
    let dir = tempdir().unwrap();
    let page = dir.path().join("page.svg");
    rodwright(dir.path())
        .args(["gallery", &sample("vault.toml"), &sample("igloo.toml"), "--columns", "1", "-o"])
        .arg(&page)
        .assert()
        .success()
        .stdout("")
        .stderr("");
    let text = std::fs::read_to_string(&page).unwrap();
    let at = |what: &str| text.find(what).unwrap_or_else(|| panic!("{what} is not on the page"));
    assert!(at(">vault<") < at(">igloo<"));
    assert!(text.contains(">4.4.4.4, 124 rods<") && text.contains(">3.3.4.3.4, 102 rods<"));
    let output = rodwright(dir.path())
        .args(["gallery", &sample("vault.toml"), &sample("igloo.toml"), "--columns", "1"])
        .assert()
        .success();
    assert!(output.get_output().stdout == text.as_bytes(), "two runs differ");
}

/// The page in docs/ is made by `rodwright gallery samples/*.toml -o docs/samples.svg`.
#[test]
fn the_page_of_samples_names_every_design() {
    let page = format!("{}/docs/samples.svg", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(page).unwrap();
    for file in files("toml") {
        assert!(text.contains(&format!(">{}<", stem(&file))), "{} is missing", file.display());
    }
}

#[test]
fn a_gallery_with_a_design_that_fails_names_it_and_writes_nothing() {
    let dir = tempdir().unwrap();
    let surface = sample("igloo.obj").replace('\\', "/");
    std::fs::write(dir.path().join("thick.toml"), format!("surface = '{surface}'\nrod = '90mm'\n"))
        .unwrap();
    std::fs::write(dir.path().join("turned.toml"), format!("surface = '{surface}'\nturn = 80\n"))
        .unwrap();
    std::fs::write(dir.path().join("lost.toml"), "surface = 'nowhere.obj'\n").unwrap();
    for (file, status) in
        [("thick.toml", 1), ("turned.toml", 1), ("lost.toml", 3), ("missing.toml", 3)]
    {
        let output = rodwright(dir.path())
            .args(["gallery", &sample("igloo.toml"), file, "-o", "page.svg"])
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(status), "{file}: {said}");
        assert!(said.contains(file), "{said}");
        assert!(!dir.path().join("page.svg").exists());
    }
    rodwright(dir.path()).arg("gallery").assert().code(2);
    rodwright(dir.path())
        .args(["gallery", &sample("igloo.toml"), "-o", "no/such/page.svg"])
        .assert()
        .code(3);
}
