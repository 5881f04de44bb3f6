//! `model.inp`: the model and its loads for CalculiX.
//!
//! CalculiX makes a solid of 20-node elements of each beam, with eight nodes round the circle
//! and reduced integration. Such a solid is softer than the circle: with ever smaller elements
//! a cantilever bends 2.4 % more than it should. Frames are as much softer, which
//! `tests/statics/run_ccx.py` checks.

mod parts;
#[cfg(test)]
mod tests;

use super::deck::{line, number};
use crate::ids::RodId;
use crate::statics::beam::axes;
use crate::statics::model::{Beam, Model};
use crate::statics::study::{Case, Study};
use crate::surface::Vector3;
use parts::{Arm, ELEMENTS, Equation, Parts, Spring};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Modulus across a rod as part of that along it, and shear across by that. A beam does not
/// ask for them; the solid needs some.
const ACROSS: f64 = 0.1;

/// Shares of an even load that the three nodes of an element carry.
const SHARES: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];

/// The text of a deck that `ccx` runs as it is.
pub fn calculix(study: &Study) -> String {
    let model = study.model();
    let parts = Parts::new(model);
    let mut text = head(study);
    add_nodes(&mut text, model, &parts);
    add_rods(&mut text, model, &parts);
    add_arms(&mut text, model, &parts);
    add_springs(&mut text, model, &parts);
    add_equations(&mut text, &parts);
    add_feet(&mut text, model, &parts);
    for case in &study.cases {
        add_case(&mut text, model, &parts, case);
    }
    text
}

fn numbers(of: &Vector3) -> String {
    of.iter().map(|x| number(*x)).collect::<Vec<_>>().join(",")
}

fn head(study: &Study) -> String {
    let taken = &study.question.taken;
    format!(
        "\
**
** A reciprocal frame of rods, for CalculiX: ccx -i model
** Units: mm, N, MPa, turns in radians. z is up.
** Contacts are {joint}, feet {feet}, rods taken {scale} times as large as drawn.
**
** Rods (element sets R001 ...) are beams B32R, {ELEMENTS} elements from contact to contact. CalculiX
** makes solids of them, which bend 2.4 % more than round rods do; statics.json is exact.
** Nodes 1 ... {nodes} (node set NODES) are those of statics.json, where they count from 0.
** Contacts (element and node sets C0001 ...): stiff arms stand out from the nodes of both rods,
** along the line through both axes, and across both rods where they must not turn about that
** line. Equations give two nodes of their own how far the rods come apart at the point of
** touch (freedoms 1 to 3) and how they turn against each other (1, 2 about lines across, 3
** about the line through both axes). Springs hold these nodes: with nothing but stiff ones a
** contact is rigid; where freedom 3 has none the rods turn as scissors do; where 1 and 2 have
** soft ones they rock in their notches.
** Feet are held in the same way by nodes that stand for the ground (node set FEET, and TURNS
** for moments): reaction forces and moments are what is printed there. Pinned feet hold three
** displacements, sliding feet one.
**
*HEADING
Reciprocal frame of rods
",
        joint = taken.hold.code(),
        feet = taken.feet.code(),
        scale = taken.scale,
        nodes = study.model().nodes.len(),
    )
}

fn add_nodes(text: &mut String, model: &Model, parts: &Parts) {
    line(text, "*NODE, NSET=ALL");
    for (i, place) in parts.nodes.iter().enumerate() {
        line(text, format!("{},{}", i + 1, numbers(&place.coords)));
    }
    line(text, format!("*NSET, NSET=NODES, GENERATE\n1,{}", model.nodes.len()));
    for joint in &model.joints {
        let [over, under] = joint.nodes;
        line(text, format!("*NSET, NSET={}\n{},{}", joint.contact, over + 1, under + 1));
    }
}

/// The beams of each rod with their places in the model.
fn rods(model: &Model) -> BTreeMap<RodId, Vec<(usize, &Beam)>> {
    let mut rods: BTreeMap<RodId, Vec<(usize, &Beam)>> = BTreeMap::new();
    for (i, beam) in model.beams.iter().enumerate() {
        rods.entry(beam.rod).or_default().push((i, beam));
    }
    rods
}

fn add_rods(text: &mut String, model: &Model, parts: &Parts) {
    let material = &model.material;
    let across = ACROSS * material.young;
    let [along, shear] = [material.young, material.shear].map(number);
    line(text, "** Along the rod, then across it; no transverse strain, as in beams.");
    line(text, "*MATERIAL, NAME=ROD\n*ELASTIC, TYPE=ENGINEERING CONSTANTS");
    let (side, shear_across) = (number(across), number(across / 2.0));
    line(text, format!("{along},{side},{side},0.,0.,0.,{shear},{shear}\n{shear_across},293."));
    line(text, "** t/mm3; the weight stands among the forces of each step.");
    line(text, format!("*DENSITY\n{}", number(material.density * 1e-12)));
    for (rod, beams) in rods(model) {
        line(text, format!("*ELEMENT, TYPE=B32R, ELSET={rod}"));
        for &(i, _) in &beams {
            for (k, nodes) in parts.beams[i].windows(3).step_by(2).enumerate() {
                let [a, b, c] = [nodes[0], nodes[1], nodes[2]];
                line(text, format!("{},{a},{b},{c}", ELEMENTS * i + k + 1));
            }
        }
        add_sections(text, model, rod, &beams);
    }
}

/// Sections of a rod: one, or one a piece where it tapers.
fn add_sections(text: &mut String, model: &Model, rod: RodId, beams: &[(usize, &Beam)]) {
    let Some((_, first)) = beams.first() else { return };
    let own = axes(&model.along(first));
    let [x, y] = [0, 1].map(|i| numbers(&own.row(i).transpose()));
    line(text, format!("*ORIENTATION, NAME={rod}\n{x},{y}"));
    let section = |set: &str, diameter: f64| {
        let d = number(diameter);
        let card = format!("*BEAM SECTION, ELSET={set}, MATERIAL=ROD, SECTION=CIRC");
        format!("** Diameters, and a direction across.\n{card}, ORIENTATION={rod}\n{d},{d}\n{y}")
    };
    let even = beams.iter().all(|(_, b)| b.section == first.section);
    if even {
        return line(text, section(&rod.to_string(), first.section.diameter));
    }
    for (k, (i, beam)) in beams.iter().enumerate() {
        let set = format!("{rod}P{}", k + 1);
        let (from, to) = (ELEMENTS * i + 1, ELEMENTS * (i + 1));
        line(text, format!("*ELSET, ELSET={set}, GENERATE\n{from},{to}"));
        line(text, section(&set, beam.section.diameter));
    }
}

fn add_arms(text: &mut String, model: &Model, parts: &Parts) {
    let stiff = number(crate::statics::joint::STIFFER * model.material.young);
    line(text, format!("** Stiff arms.\n*MATERIAL, NAME=STIFF\n*ELASTIC\n{stiff},0."));
    let before = ELEMENTS * model.beams.len();
    for (i, Arm { nodes: [a, b, c], diameter, across }) in parts.arms.iter().enumerate() {
        let (number_of, d, across) = (before + i + 1, number(*diameter), numbers(across));
        line(text, format!("*ELEMENT, TYPE=B32R, ELSET=ARM{}\n{number_of},{a},{b},{c}", i + 1));
        line(text, format!("*BEAM SECTION, ELSET=ARM{}, MATERIAL=STIFF, SECTION=CIRC", i + 1));
        line(text, format!("{d},{d}\n{across}"));
    }
}

fn add_springs(text: &mut String, model: &Model, parts: &Parts) {
    let arms = ELEMENTS * model.beams.len();
    let before = arms + parts.arms.len();
    // By whether they are grounded, their freedom and the bits of their stiffness.
    type Kind = (bool, usize, u64);
    let mut alike: BTreeMap<Kind, Vec<(usize, &Spring)>> = BTreeMap::new();
    for (i, s) in parts.springs.iter().enumerate() {
        let key = (s.other.is_some(), s.freedom, s.stiffness.to_bits());
        alike.entry(key).or_default().push((before + i + 1, s));
    }
    line(text, "** Springs: N/mm, or N mm where they hold turns.");
    for (set, ((grounded, freedom, bits), springs)) in alike.into_iter().enumerate() {
        let kind = if grounded { "SPRING2" } else { "SPRING1" };
        line(text, format!("*ELEMENT, TYPE={kind}, ELSET=SPRINGS{}", set + 1));
        for (element, spring) in springs {
            let other = spring.other.map_or(String::new(), |n| format!(",{n}"));
            line(text, format!("{element},{}{other}", spring.node));
        }
        let freedoms = if grounded { format!("{freedom},{freedom}") } else { freedom.to_string() };
        let stiffness = number(f64::from_bits(bits));
        line(text, format!("*SPRING, ELSET=SPRINGS{}\n{freedoms}\n{stiffness}", set + 1));
    }
    for (joint, ranges) in model.joints.iter().zip(&parts.contacts) {
        line(text, format!("*ELSET, ELSET={}, GENERATE", joint.contact));
        for ((from, to), base) in ranges.iter().zip([arms, before]) {
            line(text, format!("{},{}", base + from + 1, base + to));
        }
    }
}

fn add_equations(text: &mut String, parts: &Parts) {
    for Equation { terms } in &parts.equations {
        line(text, format!("*EQUATION\n{}", terms.len()));
        for four in terms.chunks(4) {
            let term = |(n, freedom, part): &(usize, usize, f64)| {
                format!("{n},{freedom},{}", number(*part))
            };
            line(text, four.iter().map(term).collect::<Vec<_>>().join(","));
        }
    }
}

fn add_feet(text: &mut String, model: &Model, parts: &Parts) {
    for (set, which) in [("FEET", 0), ("TURNS", 1)] {
        let some = parts.ground.iter().zip(&model.feet);
        let some: Vec<_> = some.filter_map(|(g, foot)| Some((g[which]?, foot))).collect();
        if some.is_empty() {
            continue;
        }
        for (_, foot) in &some {
            line(text, format!("** {} at node {}", foot.rod, foot.node + 1));
        }
        line(text, format!("*NSET, NSET={set}"));
        some.iter().for_each(|(ground, _)| line(text, ground.to_string()));
    }
    line(text, "*BOUNDARY");
    for (node, freedom) in &parts.held {
        line(text, format!("{node},{freedom}"));
    }
}

/// Forces on the nodes of a case: those on nodes of the model, and even loads by the shares
/// that the nodes of an element carry. Loads of a study have no moments.
fn forces(model: &Model, parts: &Parts, case: &Case) -> BTreeMap<usize, Vector3> {
    let mut forces: BTreeMap<usize, Vector3> = BTreeMap::new();
    for (i, six) in case.load.nodes.iter().enumerate() {
        *forces.entry(i + 1).or_default() += six.fixed_rows::<3>(0);
    }
    for ((beam, q), nodes) in model.beams.iter().zip(&case.load.beams).zip(&parts.beams) {
        let on_element = q * (model.along(beam).norm() / ELEMENTS as f64);
        for three in nodes.windows(3).step_by(2) {
            for (node, share) in three.iter().zip(SHARES) {
                *forces.entry(*node).or_default() += on_element * share;
            }
        }
    }
    forces
}

fn add_case(text: &mut String, model: &Model, parts: &Parts, case: &Case) {
    let c = &case.combination;
    let name = &c.name;
    writeln!(
        text,
        "**\n** Case {name}: {} of the weight, {} of the area load, {} of the point loads.\n\
         ** Even loads stand as the forces they put on the nodes of the elements.\n\
         *STEP\n*STATIC\n*CLOAD, OP=NEW",
        c.weight, c.area, c.points
    )
    .expect("writing to a string does not fail");
    for (node, force) in forces(model, parts, case) {
        for (i, part) in force.iter().enumerate().filter(|(_, f)| **f != 0.0) {
            line(text, format!("{node},{},{}", i + 1, number(*part)));
        }
    }
    line(text, "*NODE PRINT, NSET=NODES\nU\n*NODE PRINT, NSET=FEET, TOTALS=YES\nRF");
    if parts.ground.iter().any(|g| g[1].is_some()) {
        line(text, "*NODE PRINT, NSET=TURNS\nRF");
    }
    line(text, "*NODE FILE, OUTPUT=3D\nU\n*EL FILE\nS\n*END STEP");
}
