//! The deck as an engineer reads it.

use super::super::fixture::three_rods;
use super::*;
use crate::statics::framework::Feet;
use crate::statics::joint::Hold;

/// The fields of all lines with this command.
fn all<'a>(deck: &'a str, command: &str) -> Vec<Vec<&'a str>> {
    let fields = deck.lines().map(|l| l.split('!').next().unwrap().trim().split(',').collect());
    fields.filter(|f: &Vec<&str>| f[0] == command).collect()
}

#[test]
fn the_head_names_units_and_what_is_taken() {
    let deck = ansys(&three_rods(Hold::Tied, Feet::Pinned));
    let head: Vec<&str> = deck.lines().take(12).collect();
    insta::assert_snapshot!(head.join("\n"));
}

#[test]
fn a_section_is_told_by_its_radius() {
    let deck = ansys(&three_rods(Hold::Tied, Feet::Pinned));
    assert_eq!(all(&deck, "SECTYPE"), [["SECTYPE", "1", "BEAM", "CSOLID"]]);
    assert_eq!(all(&deck, "SECDATA")[0][1], "1.5");
}

#[test]
fn rods_and_contacts_are_components() {
    let study = three_rods(Hold::Tied, Feet::Pinned);
    let deck = ansys(&study);
    let names: Vec<&str> = all(&deck, "CM").iter().map(|f| f[1]).collect();
    assert_eq!(names, ["R001", "R002", "R003", "C0001", "C0002", "C0003"]);
    let beams = study.model().beams.len();
    assert_eq!(all(&deck, "EN").len(), beams + 3);
    let last = all(&deck, "ESEL").into_iter().rfind(|f| f.len() > 2).unwrap();
    assert_eq!(last[4], (beams + 3).to_string());
}

#[test]
fn a_contact_has_the_upper_triangle_of_its_stiffness() {
    let study = three_rods(Hold::Notched, Feet::Pinned);
    let deck = ansys(&study);
    let constants: Vec<f64> = deck
        .lines()
        .filter(|l| l.starts_with("R,") || l.starts_with("RMORE,"))
        .take(78 / AT_ONCE)
        .flat_map(|l| l.split(',').skip(if l.starts_with("RMORE") { 1 } else { 2 }))
        .map(|x| x.parse().unwrap())
        .collect();
    assert_eq!(constants.len(), 78);
    let k = joint::stiffness(&study.model().joints[0], &study.model().nodes);
    for (i, at) in [(0, (0, 0)), (11, (0, 11)), (12, (1, 1)), (77, (11, 11))] {
        assert!((constants[i] - k[at]).abs() <= 1e-12 * k[at].abs(), "{i}");
    }
}

#[test]
fn each_case_is_solved_and_printed() {
    let deck = ansys(&three_rods(Hold::Tied, Feet::Fixed));
    assert_eq!((all(&deck, "SOLVE").len(), all(&deck, "SET").len()), (2, 2));
    assert_eq!(all(&deck, "D").len(), 3 * 6);
    assert_eq!(all(&deck, "F").len(), 2, "a force in x and z");
}
