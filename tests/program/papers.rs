//! Texts of the papers: languages, texts of the user's, and the handout.

use crate::run::{rodwright, sample, snapshot};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Builds the igloo in a folder with more options, and returns the files.
fn built(folder: &Path, options: &[&str]) -> BTreeMap<String, Vec<u8>> {
    let mut command = rodwright(folder);
    command.args(["build", &sample("igloo.obj"), "-q", "--force", "-o", "out"]).args(options);
    command.assert().success();
    snapshot(&folder.join("out"))
}

fn text<'a>(files: &'a BTreeMap<String, Vec<u8>>, name: &str) -> &'a str {
    str::from_utf8(&files[name]).unwrap()
}

#[test]
fn german_papers_have_german_texts_and_the_data_stays_as_it_is() {
    let here = tempfile::tempdir().unwrap();
    let english = built(here.path(), &["--only", "csv,cutlist,sheets,handout"]);
    let german = built(here.path(), &["--only", "csv,cutlist,sheets,handout", "--language", "de"]);
    let cover = text(&german, "sheets/01-cover.svg");
    assert!(cover.contains("Einkauf") && cover.contains("Seite 1/"), "{cover}");
    assert!(!cover.contains("To buy"));
    assert!(text(&english, "sheets/01-cover.svg").contains("To buy"));
    // Longer texts may take another page.
    let names = |files: &BTreeMap<String, Vec<u8>>| -> Vec<String> {
        files.keys().filter(|name| !name.starts_with("sheets/")).cloned().collect()
    };
    assert_eq!(names(&english), names(&german));
    for data in ["rods.csv", "contacts.csv", "cutlist.csv", "cutlist.json", "structure.json"] {
        assert!(english[data] == german[data], "{data} differs");
    }
    assert!(english["handout.pdf"] != german["handout.pdf"]);
    let design = text(&german, "design.toml");
    assert!(design.contains("language = \"de\""), "{design}");
}

#[test]
fn the_handout_is_written_alone_and_always_the_same() {
    let here = tempfile::tempdir().unwrap();
    let first = built(here.path(), &["--only", "handout"]);
    let names: Vec<&str> = first.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [".rodwright", "design.toml", "handout.pdf", "report.json", "structure.json"]
    );
    assert!(first["handout.pdf"].starts_with(b"%PDF-"));
    assert_eq!(first, built(here.path(), &["--only", "handout"]));
}

#[test]
fn a_text_of_the_users_is_printed_and_the_written_design_repeats_it() {
    let here = tempfile::tempdir().unwrap();
    let own = here.path().join("own");
    fs::create_dir(&own).unwrap();
    fs::write(own.join("cover.toml"), "model = \"The dome of class 6b\"\n").unwrap();
    let options = ["--only", "sheets", "--templates", "own"];
    let files = built(here.path(), &options);
    let cover = text(&files, "sheets/01-cover.svg");
    assert!(cover.contains("The dome of class 6b") && cover.contains("To buy"), "{cover}");
    let mut again = rodwright(here.path());
    again.args(["build", "--design", "out/design.toml", "-q", "-o", "again"]).assert().success();
    assert_eq!(snapshot(&here.path().join("again")), files);
}

#[test]
fn broken_texts_are_refused_with_file_and_line_before_anything_is_written() {
    for (name, content, status, words) in [
        (
            "cover.toml",
            "title = \"x\"\nsize = \"{{ widht }}\"",
            1,
            "cover.toml: line 2: the text size has no value widht",
        ),
        (
            "cut-list.toml",
            "\n\nplan = \"{% if %}\"",
            1,
            "cut-list.toml: line 3: the text plan: syntax error",
        ),
        (
            "handout.md",
            "# A\n\n![b](picture:moon)\n",
            1,
            "handout.md: line 3: `picture:moon`: there is no picture",
        ),
        (
            "handout.md",
            "# A\n\n{{ rodz }}\n",
            1,
            "handout.md: line 3: the text handout has no value rodz",
        ),
        (
            "covers.toml",
            "title = \"x\"",
            1,
            "covers.toml is not a file of texts: there are page.toml, cover.toml",
        ),
        ("page.toml", "\u{0}", 1, "page.toml: line 1: "),
    ] {
        let here = tempfile::tempdir().unwrap();
        let own = here.path().join("own");
        fs::create_dir(&own).unwrap();
        fs::write(own.join(name), content).unwrap();
        let mut command = rodwright(here.path());
        command.args(["build", &sample("igloo.obj"), "--templates", "own", "-o", "out"]);
        let said = command.assert().code(status).get_output().stderr.clone();
        let said = String::from_utf8(said).unwrap();
        assert!(said.contains(words), "{said}\ndoes not say {words}");
        assert!(!here.path().join("out").exists());
    }
    let here = tempfile::tempdir().unwrap();
    let mut command = rodwright(here.path());
    command.args(["build", &sample("igloo.obj"), "--templates", "nowhere", "-o", "out"]);
    let said = command.assert().code(3).get_output().stderr.clone();
    assert!(String::from_utf8(said).unwrap().contains("nowhere"));
    assert!(!here.path().join("out").exists());
}

/// The files that the program writes can be used as they are and change nothing.
#[test]
fn written_templates_are_those_of_the_program() {
    let here = tempfile::tempdir().unwrap();
    let mut command = rodwright(here.path());
    command.args(["templates", "-o", "texts", "--language", "de"]).assert().success();
    let texts = snapshot(&here.path().join("texts"));
    assert!(texts.contains_key("handout.md") && texts.len() > 8, "{:?}", texts.keys());
    let options = ["--only", "sheets,handout", "--language", "de"];
    let german = built(here.path(), &options);
    let own = built(here.path(), &[&options[..], &["--templates", "texts"]].concat());
    for (name, bytes) in &german {
        // The list of files has the sizes of all.
        let other = ["design.toml", ".rodwright"].contains(&name.as_str());
        assert!(other || own[name] == *bytes, "{name} differs");
    }
    fs::write(here.path().join("texts/cover.toml"), "# mine\n").unwrap();
    let mut again = rodwright(here.path());
    let said = again.args(["templates", "-o", "texts"]).assert().code(3).get_output().clone();
    let said = String::from_utf8(said.stderr).unwrap();
    assert!(said.contains("cover.toml") && said.contains("--force"), "{said}");
    assert_eq!(fs::read(here.path().join("texts/cover.toml")).unwrap(), b"# mine\n");
    let mut forced = rodwright(here.path());
    forced.args(["templates", "-o", "texts", "--language", "de", "--force"]).assert().success();
    assert_eq!(snapshot(&here.path().join("texts")), texts);
}
