//! `statics.json`: the model, the loads and what they do, all that another program needs to
//! repeat it.
//!
//! Lengths in mm at the scale that was studied, forces in N, moments in N mm, stresses in MPa,
//! rotations in radians, full double precision. A node has six freedoms: displacements, then
//! rotations, about x, y, z.

use crate::ids::RodId;
use crate::statics::model::{Foot, Joint, Model};
use crate::statics::study::{Case, Largest, Study};
use crate::statics::{joint, stress::RodPeak};
use crate::surface::Vector3;
use crate::units::GRAVITY;
use crate::write::json::Document;
use nalgebra::{Matrix, RawStorage, U1, Vector6};
use serde::Serialize;

/// The bytes of `statics.json`.
///
/// # Errors
/// What serde says, which no figure of a study causes.
pub fn statics_json(study: &Study) -> Result<String, serde_json::Error> {
    let mut document = Document::new();
    document.value("format", "rodwright-statics")?;
    document.value("version", &1)?;
    document.value("settings", &settings(study))?;
    document.nested("model", model(study)?)?;
    let cases = study.cases.iter().map(|case| one_case(study.model(), case));
    document.nested_list("cases", cases.collect::<Result<_, _>>()?)?;
    document.nested("largest", largest(study)?)?;
    let pulls = study.pulls();
    let pulls: Vec<PullEntry> = pulls
        .iter()
        .map(|(contact, newton)| PullEntry { contact: contact.to_string(), newton: *newton })
        .collect();
    document.list("pulls", &pulls)?;
    Ok(document.finish())
}

#[derive(Serialize)]
struct Settings<'a> {
    material: &'a str,
    young_mpa: f64,
    shear_mpa: f64,
    poisson: f64,
    density_kg_m3: f64,
    strength_mpa: f64,
    joint: &'a str,
    feet: &'a str,
    /// All lengths of the frame are taken this many times as large.
    scale: f64,
    area_load_kpa: f64,
    gravity_m_s2: f64,
}

fn settings(study: &Study) -> Settings<'_> {
    let question = &study.question;
    let taken = &question.taken;
    let material = &taken.material;
    Settings {
        material: &question.material,
        young_mpa: material.young,
        shear_mpa: material.shear,
        poisson: material.poisson,
        density_kg_m3: material.density,
        strength_mpa: material.strength,
        joint: taken.hold.code(),
        feet: taken.feet.code(),
        scale: taken.scale,
        area_load_kpa: question.pressure * 1e3,
        gravity_m_s2: GRAVITY,
    }
}

#[derive(Serialize)]
struct BeamEntry {
    rod: String,
    nodes: [usize; 2],
    diameter: f64,
}

#[derive(Serialize)]
struct JointEntry {
    contact: String,
    /// On the over rod, on the under rod.
    nodes: [usize; 2],
    touch: [f64; 3],
    axis: [f64; 3],
    push: f64,
    twist: f64,
    rock: f64,
}

#[derive(Serialize)]
struct FootEntry {
    rod: String,
    node: usize,
    held: [bool; 6],
    /// Whether it is none of the frame's own.
    added: bool,
}

fn model(study: &Study) -> Result<Document, serde_json::Error> {
    let model = study.model();
    let mut document = Document::new();
    let nodes: Vec<[f64; 3]> = model.nodes.iter().map(|p| p.coords.into()).collect();
    document.list("nodes", &nodes)?;
    let beam = |b: &crate::statics::model::Beam| BeamEntry {
        rod: b.rod.to_string(),
        nodes: b.nodes,
        diameter: b.section.diameter,
    };
    document.list("beams", &model.beams.iter().map(beam).collect::<Vec<_>>())?;
    let joint = |j: &Joint| JointEntry {
        contact: j.contact.to_string(),
        nodes: j.nodes,
        touch: j.touch.coords.into(),
        axis: j.axis.into(),
        push: j.springs.push,
        twist: j.springs.twist,
        rock: j.springs.rock,
    };
    document.list("joints", &model.joints.iter().map(joint).collect::<Vec<_>>())?;
    let foot = |(i, f): (usize, &Foot)| FootEntry {
        rod: f.rod.to_string(),
        node: f.node,
        held: f.held,
        added: i >= study.own_feet,
    };
    document.list("feet", &model.feet.iter().enumerate().map(foot).collect::<Vec<_>>())?;
    Ok(document)
}

#[derive(Serialize)]
struct Factors {
    weight: f64,
    area: f64,
    points: f64,
}

#[derive(Serialize)]
struct NodeForce {
    node: usize,
    force: [f64; 3],
    moment: [f64; 3],
}

#[derive(Serialize)]
struct ContactForce {
    contact: String,
    force: [f64; 3],
    moment: [f64; 3],
    pull: f64,
}

#[derive(Serialize)]
struct RodEntry {
    rod: String,
    stress_mpa: f64,
    at_mm: f64,
    utilisation: f64,
}

#[derive(Serialize)]
struct LargestEntry<'a> {
    case: &'a str,
    rod: String,
    at_mm: f64,
    value: f64,
}

#[derive(Serialize)]
struct PullEntry {
    contact: String,
    newton: f64,
}

/// Force and moment.
fn halves(six: &Vector6<f64>) -> [[f64; 3]; 2] {
    [[six[0], six[1], six[2]], [six[3], six[4], six[5]]]
}

fn node_force(node: usize, six: &Vector6<f64>) -> NodeForce {
    let [force, moment] = halves(six);
    NodeForce { node, force, moment }
}

fn one_case(model: &Model, case: &Case) -> Result<Document, serde_json::Error> {
    let mut document = Document::new();
    let combination = &case.combination;
    document.value("name", &combination.name)?;
    let (weight, area, points) = (combination.weight, combination.area, combination.points);
    document.value("factors", &Factors { weight, area, points })?;
    let loaded = case.load.nodes.iter().enumerate().filter(|(_, six)| **six != Vector6::zeros());
    let loaded: Vec<NodeForce> = loaded.map(|(node, six)| node_force(node, six)).collect();
    document.list("node_loads", &loaded)?;
    let even: Vec<[f64; 3]> = case.load.beams.iter().map(|q: &Vector3| (*q).into()).collect();
    document.list("beam_loads", &even)?;
    let response = &case.response;
    document.list("displacements", &response.moved.iter().map(row).collect::<Vec<_>>())?;
    let reactions = model.feet.iter().zip(&response.reactions);
    let reactions: Vec<NodeForce> = reactions.map(|(f, six)| node_force(f.node, six)).collect();
    document.list("reactions", &reactions)?;
    document.list("beam_ends", &response.beams.iter().map(row).collect::<Vec<_>>())?;
    let contact = |(j, six): (&Joint, &Vector6<f64>)| {
        let [force, moment] = halves(six);
        let (contact, pull) = (j.contact.to_string(), joint::pull(j, six));
        ContactForce { contact, force, moment, pull }
    };
    let contacts: Vec<ContactForce> =
        model.joints.iter().zip(&response.joints).map(contact).collect();
    document.list("contacts", &contacts)?;
    document.value("unbalanced", &case.unbalanced(model))?;
    let rod = |r: &RodPeak| RodEntry {
        rod: r.rod.to_string(),
        stress_mpa: r.stress,
        at_mm: r.at,
        utilisation: r.utilisation,
    };
    document.list("rods", &case.rods.iter().map(rod).collect::<Vec<_>>())?;
    Ok(document)
}

/// The numbers of a column vector.
fn row<R: nalgebra::Dim, S: RawStorage<f64, R, U1>>(of: &Matrix<f64, R, U1, S>) -> Vec<f64> {
    of.iter().copied().collect()
}

fn largest(study: &Study) -> Result<Document, serde_json::Error> {
    let mut document = Document::new();
    let name = |rod: RodId| rod.to_string();
    let entry = |l: Largest| LargestEntry {
        case: &study.cases[l.case].combination.name,
        rod: name(l.rod),
        at_mm: l.at,
        value: l.value,
    };
    let worst = |of: Vec<Largest>| Largest::of(of).map(entry);
    document.value("utilisation", &worst(study.worst()))?;
    document.value("displacement_mm", &worst(study.displacements()))?;
    Ok(document)
}
