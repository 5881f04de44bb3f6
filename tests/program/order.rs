//! The order of assembly, from the command line to the files.

use crate::run::{rodwright, sample, snapshot, structure};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tempfile::tempdir;

fn json(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

fn texts(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect()
}

/// Checks assembly.json against structure.json: every rod once, every contact once and on its
/// side, every placed rod held by two at each step, no prop left. Returns the assembly.
fn check_assembly(folder: &Path) -> Value {
    let (structure, assembly) = (structure(folder), json(&folder.join("assembly.json")));
    let contacts: BTreeMap<&str, &Value> = structure["contacts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| (c["id"].as_str().unwrap(), c))
        .collect();
    let feet: Vec<&str> = structure["supports"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["rod"].as_str().unwrap())
        .collect();
    let pair = |id: &str| ["over", "under"].map(|side| contacts[id][side].as_str().unwrap());
    let (mut placed, mut made) = (BTreeSet::new(), BTreeSet::new());
    let mut props: BTreeMap<&str, &str> = BTreeMap::new();
    for (n, step) in assembly["steps"].as_array().unwrap().iter().enumerate() {
        assert_eq!(step["n"], n + 1);
        let rods = texts(&step["rods"]);
        rods.iter().for_each(|r| assert!(placed.insert(*r), "{r} is placed twice"));
        for (side, key) in ["over", "under"].iter().enumerate() {
            for id in texts(&step[*key]) {
                assert!(made.insert(id), "{id} is made twice");
                assert!(pair(id).iter().all(|r| placed.contains(r)), "{id} is made too early");
                let mine = pair(id)[side];
                assert!(contacts[id]["kind"] == "end" || rods.contains(&mine), "{id} in step {n}");
            }
        }
        for prop in step["props"].as_array().unwrap() {
            assert_eq!(prop["from"], n + 1);
            props.insert(prop["id"].as_str().unwrap(), prop["rod"].as_str().unwrap());
        }
        let mut held: BTreeMap<&str, usize> = BTreeMap::new();
        let holding = contacts.keys().flat_map(|id| {
            let both = pair(id);
            if both.iter().all(|r| placed.contains(r)) { both.to_vec() } else { Vec::new() }
        });
        for rod in holding.chain(feet.iter().copied()).chain(props.values().copied()) {
            *held.entry(rod).or_default() += 1;
        }
        assert!(placed.iter().all(|r| held.get(r).is_some_and(|&n| n >= 2)), "step {n} drops one");
        for prop in texts(&step["remove_props"]) {
            assert!(props.remove(prop).is_some(), "{prop} does not stand");
        }
    }
    assert_eq!(placed.len(), structure["rods"].as_array().unwrap().len());
    assert_eq!(made.len(), contacts.len());
    assert!(props.is_empty());
    assembly
}

/// Builds a sample in an order, and checks it.
fn ordered(design: &str, order: &str) -> Value {
    let dir = tempdir().unwrap();
    let run = rodwright(dir.path())
        .args(["build", "--design", &sample(design), "--order", order, "--only", "assembly"])
        .args(["-o", "out"])
        .assert()
        .success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let out = dir.path().join("out");
    let assembly = check_assembly(&out);
    assert_eq!(assembly["order"], order);
    let figures = &json(&out.join("report.json"))["assembly"];
    let steps = assembly["steps"].as_array().unwrap();
    assert_eq!(figures["steps"], steps.len(), "{design}");
    assert_eq!(figures["props"], assembly["props"]);
    let lifts: usize = steps.iter().map(|s| s["under"].as_array().unwrap().len()).sum();
    assert_eq!(figures["lifts"], lifts);
    assert!(said.contains(&format!("in {} steps", steps.len())), "{said}");
    assembly
}

#[test]
fn samples_are_put_together_in_both_orders() {
    for design in ["igloo.toml", "flat.toml", "seashell.toml"] {
        let crown = ordered(design, "crown");
        assert_eq!(crown["props"], 0, "{design}");
        ordered(design, "ground");
    }
}

#[test]
#[ignore = "builds all samples twice"]
fn all_samples_are_put_together_in_both_orders() {
    for entry in std::fs::read_dir(sample("")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.ends_with(".toml") {
            assert_eq!(ordered(&name, "crown")["props"], 0, "{name}");
            ordered(&name, "ground");
        }
    }
}

#[test]
fn patterns_with_rods_of_their_own_are_put_together() {
    for pattern in ["zigzag", "hexagons-resting", "window"] {
        for order in ["crown", "ground"] {
            let dir = tempdir().unwrap();
            rodwright(dir.path())
                .args(["build", &sample("igloo.obj"), "--pattern", pattern, "--order", order])
                .args(["--only", "assembly", "-q", "-o", "out"])
                .assert()
                .success();
            check_assembly(&dir.path().join("out"));
        }
    }
}

#[test]
fn steps_are_capped_and_the_design_repeats_it() {
    let dir = tempdir().unwrap();
    let first = ["--order", "ground", "--step-rods", "2", "-o", "one"];
    let again = ["--design", "one/design.toml", "-o", "two"];
    rodwright(dir.path()).args(["build", &sample("igloo.obj")]).args(first).assert().success();
    rodwright(dir.path()).arg("build").args(again).assert().success();
    let assembly = check_assembly(&dir.path().join("one"));
    let steps = assembly["steps"].as_array().unwrap();
    assert!(steps.iter().all(|s| s["rods"].as_array().unwrap().len() <= 2));
    let [one, two] = ["one", "two"].map(|out| snapshot(&dir.path().join(out)));
    for (name, bytes) in &one {
        assert!(bytes == &two[name], "{name} differs");
    }
}

#[test]
fn the_order_is_chosen_where_it_is_not_given() {
    let dir = tempdir().unwrap();
    let build = ["build", &sample("igloo.obj"), "--only", "structure", "-q", "-o", "out"];
    rodwright(dir.path()).args(build).assert().success();
    let design = std::fs::read_to_string(dir.path().join("out/design.toml")).unwrap();
    assert!(design.contains("# order was chosen: crown"), "{design}");
    assert!(!dir.path().join("out/assembly.json").exists());
    for (args, said) in
        [(["--order", "sideways"], "crown"), (["--step-rods", "0"], "at least one rod")]
    {
        let refused = rodwright(dir.path()).args(build).args(args).assert().failure();
        let text = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
        assert!(text.contains(said), "{text}");
    }
}
