//! `model.mac`: the model and its loads for ANSYS Mechanical APDL.
//!
//! Contacts are MATRIX27 elements: the stiffness of arms and springs in the twelve freedoms of
//! their two nodes, number by number. Arms by CERIG and springs by COMBIN14 would be easier to
//! change, but ask for nodes turned to the line of each contact, which is easy to get wrong.

#[cfg(test)]
mod tests;

use super::deck::{exact, line};
use crate::ids::RodId;
use crate::statics::joint;
use crate::statics::model::{Beam, Model};
use crate::statics::study::{Case, Study};
use crate::surface::Vector3;
use std::collections::BTreeMap;

/// Real constants that the commands R and RMORE take at once.
const AT_ONCE: usize = 6;

/// Rods less than this far from upright, as a part of their length in plan, take x for the
/// direction that tells their axes; others the vertical.
const UPRIGHT: f64 = 1e-3;

/// The labels of displacements and turns, of forces and moments.
const MOVES: [&str; 6] = ["UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"];
const FORCES: [&str; 6] = ["FX", "FY", "FZ", "MX", "MY", "MZ"];

/// The text of an input file that ANSYS reads with `/INPUT,model,mac`.
pub fn ansys(study: &Study) -> String {
    let model = study.model();
    let mut text = head(study);
    let sections = add_material(&mut text, model);
    line(&mut text, "! Nodes: those of statics.json, where they count from 0.");
    for (i, p) in model.nodes.iter().enumerate() {
        line(&mut text, format!("N,{},{}", i + 1, numbers(&p.coords)));
    }
    let turned = add_rods(&mut text, model, &sections);
    add_contacts(&mut text, model);
    add_feet(&mut text, model);
    line(&mut text, "FINISH\n/SOLU\nANTYPE,STATIC\nOUTRES,ALL,ALL");
    for (i, case) in study.cases.iter().enumerate() {
        add_case(&mut text, model, &turned, i + 1, case);
    }
    line(&mut text, "FINISH\n/POST1");
    for i in 1..=study.cases.len() {
        line(&mut text, format!("SET,{i}\nPRNSOL,U,COMP\nPRNSOL,ROT,COMP\nPRRSOL"));
    }
    line(&mut text, "FINISH");
    text
}

fn numbers(of: &Vector3) -> String {
    of.iter().map(|x| exact(*x)).collect::<Vec<_>>().join(",")
}

fn head(study: &Study) -> String {
    let taken = &study.question.taken;
    format!(
        "\
! A reciprocal frame of rods, for ANSYS Mechanical APDL: /INPUT,model,mac
! Units: mm, N, MPa, turns in radians. z is up.
! Contacts are {joint}, feet {feet}, rods taken {scale} times as large as drawn.
! Rods are components R001 ... of BEAM188 elements, contacts components C0001 ... of one
! MATRIX27 element each: rigid arms from both rods to the point of touch, and springs there.
FINISH
/CLEAR
/TITLE,Reciprocal frame of rods
/PREP7
ET,1,BEAM188
KEYOPT,1,3,3                 ! cubic along the element
ET,2,MATRIX27
KEYOPT,2,3,4                 ! a stiffness, symmetric
",
        joint = taken.hold.code(),
        feet = taken.feet.code(),
        scale = taken.scale,
    )
}

/// Material and sections; the number of the section of each diameter.
fn add_material(text: &mut String, model: &Model) -> BTreeMap<u64, usize> {
    let m = &model.material;
    line(text, "! Young's modulus, Poisson's ratio, shear modulus (MPa), density (t/mm3)");
    line(text, format!("MP,EX,1,{}\nMP,PRXY,1,{}", exact(m.young), exact(m.poisson)));
    line(text, format!("MP,GXY,1,{0}\nMP,GXZ,1,{0}", exact(m.shear)));
    line(text, format!("MP,DENS,1,{}", exact(m.density * 1e-12)));
    let mut sections = BTreeMap::new();
    for beam in &model.beams {
        let section = beam.section;
        let next = sections.len() + 1;
        if sections.contains_key(&section.diameter.to_bits()) {
            continue;
        }
        sections.insert(section.diameter.to_bits(), next);
        let shear = exact(m.shear * section.shear_area(m.poisson));
        let (d, radius) = (exact(section.diameter), exact(section.diameter / 2.0));
        line(text, format!("! Diameter {d} mm: the radius; shear stiffness by Cowper, N"));
        line(text, format!("SECTYPE,{next},BEAM,CSOLID\nSECDATA,{radius},16,4"));
        line(text, format!("SECCONTROL,{shear},{shear}"));
    }
    sections
}

/// Adds the rods; the axes of each, y and z across as ANSYS makes them.
fn add_rods(
    text: &mut String,
    model: &Model,
    sections: &BTreeMap<u64, usize>,
) -> BTreeMap<RodId, [Vector3; 3]> {
    let mut rods: BTreeMap<RodId, Vec<(usize, &Beam)>> = BTreeMap::new();
    for (i, beam) in model.beams.iter().enumerate() {
        rods.entry(beam.rod).or_default().push((i + 1, beam));
    }
    let mut turned = BTreeMap::new();
    line(
        text,
        "! Rods. The third node of an element tells where its z axis points.\nTYPE,1\nMAT,1",
    );
    for (k, (rod, beams)) in rods.iter().enumerate() {
        let (first, last) = (beams[0], beams[beams.len() - 1]);
        let along = model.along(first.1).normalize();
        let plumb = along.xy().norm() < UPRIGHT;
        let aside = if plumb { Vector3::x() } else { Vector3::z() };
        let y = aside.cross(&along).normalize();
        turned.insert(*rod, [along, y, along.cross(&y)]);
        let third = model.nodes.len() + k + 1;
        let reach = aside * model.along(first.1).norm();
        let place = model.nodes[first.1.nodes[0]] + reach;
        line(text, format!("N,{third},{}", numbers(&place.coords)));
        for (element, beam) in beams {
            let section = sections[&beam.section.diameter.to_bits()];
            let [a, b] = beam.nodes.map(|n| n + 1);
            line(text, format!("SECNUM,{section}\nEN,{element},{a},{b},{third}"));
        }
        line(text, format!("ESEL,S,ELEM,,{},{}\nCM,{rod},ELEM", first.0, last.0));
    }
    line(text, "ESEL,ALL");
    turned
}

fn add_contacts(text: &mut String, model: &Model) {
    line(text, "! Contacts: over rod, under rod; the upper triangle of the stiffness by rows");
    line(text, "TYPE,2");
    for (i, of) in model.joints.iter().enumerate() {
        let (set, element) = (i + 1, model.beams.len() + i + 1);
        let k = joint::stiffness(of, &model.nodes);
        let upper = (0..12).flat_map(|row| (row..12).map(move |column| (row, column)));
        let constants: Vec<String> = upper.map(|at| exact(k[at])).collect();
        for (n, six) in constants.chunks(AT_ONCE).enumerate() {
            let command = if n == 0 { format!("R,{set}") } else { "RMORE".into() };
            line(text, format!("{command},{}", six.join(",")));
        }
        let [over, under] = of.nodes.map(|n| n + 1);
        line(text, format!("REAL,{set}\nEN,{element},{over},{under}"));
        line(text, format!("ESEL,S,ELEM,,{element}\nCM,{},ELEM", of.contact));
    }
    line(text, "ESEL,ALL");
}

fn add_feet(text: &mut String, model: &Model) {
    line(text, "! Feet");
    for foot in &model.feet {
        for (label, _) in MOVES.iter().zip(foot.held).filter(|(_, held)| *held) {
            line(text, format!("D,{},{label},0             ! {}", foot.node + 1, foot.rod));
        }
    }
}

fn add_case(
    text: &mut String,
    model: &Model,
    turned: &BTreeMap<RodId, [Vector3; 3]>,
    which: usize,
    case: &Case,
) {
    let c = &case.combination;
    line(text, format!("! Case {which}: {}", c.name));
    line(
        text,
        format!(
            "! {} of the weight, {} of the area load, {} of the point loads",
            c.weight, c.area, c.points
        ),
    );
    line(text, format!("TIME,{which}\nFDELE,ALL,ALL\nSFEDELE,ALL,ALL,ALL"));
    for (i, six) in case.load.nodes.iter().enumerate() {
        for (label, value) in FORCES.iter().zip(six).filter(|(_, v)| **v != 0.0) {
            line(text, format!("F,{},{label},{}", i + 1, exact(*value)));
        }
    }
    line(text, "! Even loads, N/mm: face 1 presses against z, 2 against y, 3 along x of the beam");
    for (i, (beam, q)) in model.beams.iter().zip(&case.load.beams).enumerate() {
        let [x, y, z] = turned[&beam.rod];
        let faces = [(1, -q.dot(&z)), (2, -q.dot(&y)), (3, q.dot(&x))];
        for (face, pressure) in faces.into_iter().filter(|(_, p)| *p != 0.0) {
            line(text, format!("SFBEAM,{},{face},PRES,{}", i + 1, exact(pressure)));
        }
    }
    line(text, "SOLVE");
}
