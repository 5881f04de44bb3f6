//! The deck as an engineer reads it.

use super::super::fixture::{loaded, three_rods};
use super::parts::Parts;
use super::*;
use crate::frame::fixture::circuit;
use crate::statics::framework::Feet;
use crate::statics::joint::Hold;

/// The lines after a card until the next one, of each card that begins so.
fn after<'a>(deck: &'a str, card: &str) -> Vec<Vec<&'a str>> {
    let mut found: Vec<Vec<&str>> = Vec::new();
    let mut within = false;
    for line in deck.lines().filter(|l| !l.starts_with("**")) {
        if line.starts_with('*') {
            within = line.starts_with(card);
            if within {
                found.push(Vec::new());
            }
        } else if within {
            found.last_mut().unwrap().push(line);
        }
    }
    found
}

#[test]
fn a_number_is_never_longer_than_what_is_read() {
    assert_eq!(number(-0.25), "-0.25");
    assert_eq!(number(3.0), "3");
    for x in [-51.596_659_855_910_566, -1.0 / 3e-9, 1.234_567_890_123_456_7e-30, f64::MIN] {
        let text = number(x);
        assert!(text.len() <= 20, "{text}");
        assert!((text.parse::<f64>().unwrap() - x).abs() <= 1e-12 * x.abs(), "{text}");
    }
}

#[test]
fn units_kinds_and_cases_are_named() {
    let deck = calculix(&three_rods(Hold::Notched, Feet::Pinned));
    for words in [
        "** Units: mm, N, MPa, turns in radians. z is up.",
        "** Contacts are notched, feet pinned, rods taken 1 times as large as drawn.",
        "** Case weight: 1 of the weight, 0 of the area load, 0 of the point loads.",
        "** Case weight + loads: 1 of the weight, 0 of the area load, 1 of the point loads.",
    ] {
        assert!(deck.lines().any(|l| l == words), "{words}");
    }
}

#[test]
fn each_rod_and_contact_is_a_set() {
    let study = three_rods(Hold::Nailed, Feet::Pinned);
    let deck = calculix(&study);
    let mut elements = 0;
    for rod in ["R001", "R002", "R003"] {
        let beams = study.model().beams.iter().filter(|b| b.rod.to_string() == rod).count();
        let set = after(&deck, &format!("*ELEMENT, TYPE=B32R, ELSET={rod}"));
        assert_eq!(set.len(), 1);
        assert_eq!(set[0].len(), ELEMENTS * beams, "{rod}");
        elements += set[0].len();
        let section = after(&deck, &format!("*BEAM SECTION, ELSET={rod},"));
        assert_eq!(section[0][0], "3,3", "diameters");
    }
    // Two arms on each side and six springs, as nailed contacts turn about nothing.
    let set = &after(&deck, "*ELSET, ELSET=C0001, GENERATE")[0];
    let springs = elements + 3 * 4;
    assert_eq!(
        *set,
        [format!("{},{}", elements + 1, elements + 4), format!("{},{}", springs + 1, springs + 6)]
    );
    let [over, under] = study.model().joints[0].nodes;
    assert_eq!(after(&deck, "*NSET, NSET=C0001")[0], [format!("{},{}", over + 1, under + 1)]);
}

#[test]
fn scissors_have_no_spring_about_the_line_through_both_axes() {
    let tied = Parts::new(three_rods(Hold::Tied, Feet::Pinned).model());
    let nailed = Parts::new(three_rods(Hold::Nailed, Feet::Pinned).model());
    assert_eq!((nailed.springs.len() - tied.springs.len(), tied.arms.len()), (3, 6));
}

#[test]
fn pinned_sliding_and_fixed_feet_have_three_one_and_six_springs_to_the_ground() {
    for (feet, freedoms) in [(Feet::Pinned, 3), (Feet::Fixed, 6)] {
        let parts = Parts::new(three_rods(Hold::Nailed, feet).model());
        let grounded = parts.springs.iter().filter(|s| s.other.is_some()).count();
        assert_eq!(grounded, 3 * freedoms, "{feet:?}");
    }
    let mut model = three_rods(Hold::Nailed, Feet::Pinned).model().clone();
    model.feet[0].held = [false, false, true, false, false, false];
    let parts = Parts::new(&model);
    assert_eq!(parts.springs.iter().filter(|s| s.other.is_some()).count(), 7);
}

/// Equations tell how contacts come apart: rigid motions of both rods together are none.
#[test]
fn a_contact_that_moves_as_a_whole_is_not_strained() {
    let parts = Parts::new(three_rods(Hold::Notched, Feet::Pinned).model());
    let moved = |place: &crate::surface::Point3| {
        Vector3::new(0.1, 0.2, -0.3) + Vector3::new(0.5, -0.4, 0.7).cross(&place.coords)
    };
    let contacts = parts.contacts.last().unwrap()[1].1;
    for (equation, spring) in parts.equations.iter().zip(&parts.springs[..contacts]) {
        let of = |(n, freedom, part): &(usize, usize, f64)| {
            part * moved(&parts.nodes[n - 1])[freedom - 1]
        };
        let apart: f64 = equation.terms[1..].iter().map(of).sum();
        assert!(apart.abs() < 1e-9, "{apart}");
        assert_eq!(equation.terms[0], (spring.node, spring.freedom, -1.0));
    }
}

/// One side turned alone: the equations give the turn about each of the three lines.
#[test]
fn a_rod_that_turns_in_its_contact_strains_it_by_the_turn() {
    let study = three_rods(Hold::Nailed, Feet::Pinned);
    let parts = Parts::new(study.model());
    let joint = &study.model().joints[0];
    let over = joint.nodes[0] + 1;
    let mut moving: Vec<usize> = vec![over];
    moving.extend(parts.arms.iter().filter(|a| a.nodes[0] == over).map(|a| a.nodes[2]));
    let turn = Vector3::new(0.2, -0.1, 0.4);
    let found: Vec<f64> = parts.equations[3..6]
        .iter()
        .map(|e| {
            let moved = |n: usize| {
                let arm = parts.nodes[n - 1] - joint.touch;
                if moving.contains(&n) { turn.cross(&arm) } else { Vector3::zeros() }
            };
            e.terms[1..].iter().map(|(n, i, part)| part * moved(*n)[i - 1]).sum()
        })
        .collect();
    assert!((found[2].abs() - turn.dot(&joint.axis).abs()).abs() < 1e-9, "{found:?}");
    let size = found.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((size - turn.norm()).abs() < 1e-9, "{found:?}");
}

#[test]
fn each_case_is_a_step_with_its_whole_load() {
    let study = three_rods(Hold::Tied, Feet::Fixed);
    let deck = calculix(&study);
    assert_eq!(deck.lines().filter(|l| *l == "*END STEP").count(), 2);
    let loads = after(&deck, "*CLOAD, OP=NEW");
    for (case, loads) in study.cases.iter().zip(loads) {
        let mut sum = Vector3::zeros();
        for load in loads {
            let parts: Vec<&str> = load.split(',').collect();
            sum[parts[1].parse::<usize>().unwrap() - 1] += parts[2].parse::<f64>().unwrap();
        }
        let total = case.load.total(study.model());
        assert!((sum - total).norm() < 1e-9 * total.norm(), "{sum} {total}");
    }
}

/// A rod that tapers has a section a piece, and stays a set.
#[test]
fn a_taper_has_a_section_a_piece() {
    let mut frame = circuit(3, 3.0);
    frame.rods[crate::ids::Id::new(0)].diameters = [4.0, 2.0];
    let deck = calculix(&loaded(&frame, Hold::Nailed, Feet::Pinned));
    assert!(after(&deck, "*BEAM SECTION, ELSET=R001,").is_empty());
    let first = &after(&deck, "*BEAM SECTION, ELSET=R001P1,")[0];
    let second = &after(&deck, "*BEAM SECTION, ELSET=R001P2,")[0];
    let diameter = |of: &[&str]| of[0].split(',').next().unwrap().parse::<f64>().unwrap();
    assert!(diameter(first) > diameter(second), "{first:?} {second:?}");
    assert_eq!(after(&deck, "*ELSET, ELSET=R001P1, GENERATE")[0], [format!("1,{ELEMENTS}")]);
}
