//! The footprint: drawn of what is laid flat, refused of what is not.

use crate::run::{rodwright, sample, snapshot, structure};
use std::path::Path;
use svg::node::element::tag::Type;
use svg::parser::Event;
use tempfile::tempdir;

/// Builds a sample and gives the footprint's text.
fn footprint(dir: &Path, surface: &str, args: &[&str]) -> String {
    rodwright(dir)
        .args(["build", &sample(surface), "--only", "footprint", "-q", "--force", "-o", "out"])
        .args(args)
        .assert()
        .success();
    std::fs::read_to_string(dir.join("out/footprint.svg")).unwrap()
}

/// The elements of each layer, in order: the layer's name, then of each element its name
/// and its points. Every element must be closed by its own end.
fn layers(text: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut layers = Vec::new();
    let mut open = Vec::new();
    for event in svg::read(text).unwrap() {
        match event {
            Event::Tag(name, Type::End, _) => assert_eq!(open.pop(), Some(name.to_owned())),
            Event::Tag(name, kind, attributes) => {
                let value = |key: &str| attributes.get(key).map(|v| v.to_string());
                if name == "g" {
                    layers.push((value("inkscape:label").unwrap(), Vec::new()));
                } else if let Some((_, items)) = layers.last_mut() {
                    let points = value("d").or_else(|| value("points")).unwrap_or_default();
                    items.push((name.to_owned(), points));
                }
                if kind == Type::Start {
                    open.push(name.to_owned());
                }
            }
            Event::Error(error) => panic!("{error}"),
            _ => {}
        }
    }
    assert!(open.is_empty(), "{open:?}");
    layers
}

fn layer<'a>(layers: &'a [(String, Vec<(String, String)>)], name: &str) -> &'a [(String, String)] {
    &layers.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("no layer {name}")).1
}

#[test]
fn every_unit_and_every_rod_of_the_structure_is_drawn_once() {
    let dir = tempdir().unwrap();
    for (surface, args) in [
        ("igloo.obj", &[][..]),
        ("igloo.obj", &["--pattern", "3.6.3.6", "--rotate", "25", "--origin", "40mm,-60mm"]),
        ("train-station.obj", &["--rotate=-15", "--paper", "letter", "--units", "in"]),
        ("seashell.obj", &["--pattern", "3.3.3.3.6"]),
        ("seashell.obj", &["--pattern", "3.4.6.4", "--relax", "on"]),
        ("flat.obj", &["--pattern", "6.6.6", "--unit", "65mm", "--layer", "reciprocal"]),
    ] {
        let text = footprint(dir.path(), surface, args);
        let structure = structure(&dir.path().join("out"));
        let count = |what: &str| structure[what].as_array().unwrap().len();
        let layers = layers(&text);
        let units = &layer(&layers, "tiles")[0].1;
        assert_eq!(units.matches('M').count(), count("units"), "{surface} {args:?}");
        let rods = layer(&layers, "rods");
        assert_eq!(rods.len(), count("rods"), "{surface} {args:?}");
        assert!(rods.iter().all(|(name, _)| name == "line"));
        assert_eq!(layer(&layers, "outline").len(), 1);
    }
}

#[test]
fn it_comes_alone_where_asked_for_and_as_a_page_of_the_sheets() {
    let dir = tempdir().unwrap();
    let first = footprint(dir.path(), "igloo.obj", &[]);
    let files: Vec<String> = snapshot(&dir.path().join("out")).into_keys().collect();
    for file in &files {
        let of_every_folder = file.ends_with(".json") || file == "design.toml";
        assert!(of_every_folder || file.starts_with('.') || file == "footprint.svg", "{file}");
    }
    assert_eq!(first, footprint(dir.path(), "igloo.obj", &[]), "two runs differ");
    let moved = footprint(dir.path(), "igloo.obj", &["--origin", "10mm,0", "--rotate", "10"]);
    assert!(moved.contains("starts at 10.0, 0.0 mm") && moved.contains("turned by 10.0°"));
    rodwright(dir.path())
        .args(["build", &sample("igloo.obj"), "--only", "sheets", "-q", "-o", "sheets"])
        .assert()
        .success();
    let files = snapshot(&dir.path().join("sheets"));
    assert!(files.contains_key("sheets/04-footprint.svg") && !files.contains_key("footprint.svg"));
}

#[test]
fn what_is_not_laid_flat_has_none() {
    let dir = tempdir().unwrap();
    let cases: [(&[&str], &str); 2] = [
        (&["sphere:dI/3"], "a sphere is not laid flat"),
        (&[&sample("ring.obj"), "--pattern", "mesh"], "the polygons of the mesh are the units"),
    ];
    for (surface, reason) in cases {
        let build = |only: &[&str]| {
            let mut command = rodwright(dir.path());
            command.arg("build").args(surface).args(["-q", "-o", "out"]).args(only);
            command.output().unwrap()
        };
        let refused = build(&["--only", "csv,footprint"]);
        let said = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(1), "{said}");
        assert!(said.contains("only footprint does nothing here") && said.contains(reason));
        assert!(!dir.path().join("out").exists());
        // Not asked for, it is left out without a word.
        let built = build(&[]);
        assert_eq!((built.status.code(), built.stderr.len()), (Some(0), 0));
        let files = snapshot(&dir.path().join("out"));
        assert!(files.contains_key("sheets.pdf"));
        assert!(files.keys().all(|name| !name.contains("footprint")));
        std::fs::remove_dir_all(dir.path().join("out")).unwrap();
    }
}
