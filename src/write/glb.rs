//! The model as a binary glTF 2.0 file: metres, y up.
//!
//! Every rod is a node of its own name with one shared cylinder (rods that taper alike share
//! a cone), placed by
//! translation, rotation and scale: the node's origin is end A and its y axis runs
//! along the rod. Contacts and supports are empty nodes. Figures of each stand in its
//! `extras`, in mm and degrees.
//!
//! Coordinates are single precision, as the format has it: some 6e-8 of the distance
//! from the origin, so a micrometre at ten metres.

mod cylinder;
mod parts;
mod plain;

pub(super) use cylinder::SIDES;
pub use plain::{mesh_glb, mesh_gltf};

use super::figure::rounded;
use super::structure::{
    ContactEntry, ContactKindName, DiameterEntry, EndName, RodEntry, Structure, SupportEntry,
};
use cylinder::{Cylinder, push_cylinders};
use gltf::binary::{Glb, Header};
use gltf_json::extras::{Extras, RawValue};
use gltf_json::scene::UnitQuaternion;
use gltf_json::{Index, Material, Mesh, Node, Root, Scene};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use std::borrow::Cow;
use std::collections::HashMap;
use thiserror::Error;

/// Why no model file could be made.
#[derive(Error, Debug)]
pub enum GlbError {
    /// The JSON part could not be written.
    #[error("the model cannot be written as glTF: {0}")]
    Json(#[from] serde_json::Error),
    /// The file could not be put together.
    #[error("the model cannot be written as glTF: {0}")]
    Glb(#[from] gltf::Error),
    /// An element names a rod that is not there.
    #[error("the model cannot be written: there is no rod {0}")]
    MissingRod(String),
}

/// Digits after the point of figures in extras: a nanometre, a millionth of a degree.
const DIGITS: i32 = 6;

/// Colours, linear RGBA.
const INNER: (&str, [f32; 4]) = ("inner rods", [0.63, 0.41, 0.19, 1.0]);
const BORDER: (&str, [f32; 4]) = ("border rods", [0.25, 0.12, 0.05, 1.0]);

/// The bytes of the model file.
///
/// # Errors
/// [`GlbError`]; a structure that passes [`Structure::check`] gives none.
pub fn glb(structure: &Structure) -> Result<Vec<u8>, GlbError> {
    let mut root = Root::default();
    root.asset.generator = Some(generator());
    let tapers = tapers(structure);
    let (cylinders, buffer) = push_cylinders(&mut root, &tapers);
    let notes = notes(structure);
    let rods = rod_nodes(
        &mut root,
        structure,
        &Shapes { tapers: &tapers, cylinders: &cylinders },
        &notes,
    )?;
    let contacts = contact_nodes(&mut root, structure)?;
    let supports = support_nodes(&mut root, structure)?;
    let groups = [("rods", rods), ("contacts", contacts), ("supports", supports)];
    let filled = groups.into_iter().filter(|(_, children)| !children.is_empty());
    let children: Vec<Index<Node>> =
        filled.map(|(name, children)| push_group(&mut root, name, children)).collect();
    let top = push_group(&mut root, "structure", children);
    root.nodes[top.value()].extras = extras(&TopFigures {
        rod_diameter_mm: structure.rod_diameter,
        ground_mm: structure.ground,
        rods: structure.rods.len(),
        contacts: structure.contacts.len(),
        units: structure.units.len(),
    })?;
    let scene =
        Scene { nodes: vec![top], extensions: None, extras: None, name: Some("rodwright".into()) };
    root.scene = Some(root.push(scene));
    wrap(&root, buffer)
}

/// The program's name, as documents carry it.
fn generator() -> String {
    format!("rodwright {}", env!("CARGO_PKG_VERSION"))
}

/// A document and its buffer in one file.
fn wrap(root: &Root, buffer: Vec<u8>) -> Result<Vec<u8>, GlbError> {
    let glb = Glb {
        // The length is worked out when the file is put together.
        header: Header { magic: *b"glTF", version: 2, length: 0 },
        json: Cow::Owned(gltf_json::serialize::to_vec(root)?),
        bin: Some(Cow::Owned(buffer)),
    };
    Ok(glb.to_vec()?)
}

/// What a rod's node tells beside the rod itself.
#[derive(Default)]
struct Notes<'a> {
    contacts: Vec<(f64, &'a str)>,
    support: Option<EndName>,
}

fn notes(structure: &Structure) -> HashMap<&str, Notes<'_>> {
    let mut notes: HashMap<&str, Notes<'_>> = HashMap::new();
    for c in &structure.contacts {
        notes.entry(&c.over).or_default().contacts.push((c.at_over, &c.id));
        notes.entry(&c.under).or_default().contacts.push((c.at_under, &c.id));
    }
    for s in &structure.supports {
        notes.entry(&s.rod).or_default().support = Some(s.end);
    }
    for note in notes.values_mut() {
        note.contacts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(b.1)));
    }
    notes
}

#[derive(Serialize)]
struct TopFigures {
    rod_diameter_mm: f64,
    ground_mm: f64,
    rods: usize,
    contacts: usize,
    units: usize,
}

#[derive(Serialize)]
struct RodFigures<'a> {
    length_mm: f64,
    diameter_mm: DiameterEntry,
    class: &'a str,
    border: bool,
    units: &'a [String],
    contacts: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    support: Option<&'static str>,
}

fn rod_nodes(
    root: &mut Root,
    structure: &Structure,
    shapes: &Shapes,
    notes: &HashMap<&str, Notes<'_>>,
) -> Result<Vec<Index<Node>>, GlbError> {
    let none = Notes::default();
    // A mesh without nodes would be left over, so each is made when first needed.
    let mut meshes: Vec<[Option<Index<Mesh>>; 2]> = vec![[None; 2]; shapes.cylinders.len()];
    let mut nodes = Vec::with_capacity(structure.rods.len());
    for rod in &structure.rods {
        let look = if rod.border { BORDER } else { INNER };
        let shape = shapes.of(structure.diameters(rod));
        let mesh = *meshes[shape][usize::from(rod.border)]
            .get_or_insert_with(|| push_mesh(root, &shapes.cylinders[shape], look));
        let note = notes.get(rod.id.as_str()).unwrap_or(&none);
        let figures = RodFigures {
            length_mm: rounded(rod.length, DIGITS),
            diameter_mm: structure.diameters(rod).into(),
            class: &rod.class,
            border: rod.border,
            units: &rod.units,
            contacts: note.contacts.iter().map(|c| c.1).collect(),
            support: note.support.map(EndName::letter),
        };
        let node = Node { mesh: Some(mesh), extras: extras(&figures)?, ..placed(rod, structure) };
        nodes.push(root.push(node));
    }
    Ok(nodes)
}

/// The shapes that rods share, each with its taper: the radius at end B as part of that at
/// end A.
struct Shapes<'a> {
    tapers: &'a [f64],
    cylinders: &'a [Cylinder],
}

impl Shapes<'_> {
    /// The place of the shape of a rod of these diameters.
    fn of(&self, diameters: [f64; 2]) -> usize {
        self.tapers.iter().position(|&t| t == taper(diameters)).unwrap_or_default()
    }
}

fn taper([a, b]: [f64; 2]) -> f64 {
    b / a
}

/// The different tapers of rods, in the order of the first ones.
fn tapers(structure: &Structure) -> Vec<f64> {
    let mut tapers: Vec<f64> = Vec::new();
    for rod in &structure.rods {
        let taper = taper(structure.diameters(rod));
        if !tapers.contains(&taper) {
            tapers.push(taper);
        }
    }
    tapers
}

/// The node of a rod, without its mesh: the shared one runs from the origin to (0, 1, 0),
/// with radius 1 at the origin.
fn placed(rod: &RodEntry, structure: &Structure) -> Node {
    let [a, b] = [metres(rod.a), metres(rod.b)];
    let radius = (structure.diameters(rod)[0] / 2000.0) as f32;
    Node {
        name: Some(rod.id.clone()),
        translation: Some(single(a)),
        rotation: Some(rotation_of_y((b - a).normalize())),
        scale: Some([radius, (b - a).norm() as f32, radius]),
        ..Node::default()
    }
}

/// The shortest rotation that takes the y axis to a unit vector: (y × d, 1 + y·d),
/// normalised.
fn rotation_of_y(d: Vector3<f64>) -> UnitQuaternion {
    let q = nalgebra::Vector4::new(d.z, 0.0, -d.x, 1.0 + d.y);
    // Straight down, where every half turn about a level axis will do.
    let q = q.try_normalize(DOWN).unwrap_or_else(nalgebra::Vector4::x);
    UnitQuaternion([q.x, q.y, q.z, q.w].map(|x| x as f32))
}

/// |(y × d, 1 + y·d)| below which a direction counts as straight down: the sideways
/// part is then no more than the noise of a unit vector.
const DOWN: f64 = 1e-12;

#[derive(Serialize)]
struct ContactFigures<'a> {
    kind: &'static str,
    over: &'a str,
    under: &'a str,
    at_over_mm: f64,
    at_under_mm: f64,
    angle_deg: f64,
    unit: &'a str,
}

fn contact_nodes(root: &mut Root, structure: &Structure) -> Result<Vec<Index<Node>>, GlbError> {
    let rods: HashMap<&str, &RodEntry> =
        structure.rods.iter().map(|r| (r.id.as_str(), r)).collect();
    let mut nodes = Vec::with_capacity(structure.contacts.len());
    for c in &structure.contacts {
        let figures = ContactFigures {
            kind: c.kind.code(),
            over: &c.over,
            under: &c.under,
            at_over_mm: rounded(c.at_over, DIGITS),
            at_under_mm: rounded(c.at_under, DIGITS),
            angle_deg: rounded(c.angle, DIGITS),
            unit: &c.unit,
        };
        let node = empty(&c.id, contact_point(c, &rods)?, extras(&figures)?);
        nodes.push(root.push(node));
    }
    Ok(nodes)
}

/// Midway between the two axes, mm.
fn contact_point(c: &ContactEntry, rods: &HashMap<&str, &RodEntry>) -> Result<[f64; 3], GlbError> {
    let on = |id: &str, at: f64, end: Option<EndName>| {
        let rod = rods.get(id).ok_or_else(|| GlbError::MissingRod(id.to_owned()))?;
        let [a, b] = [rod.a, rod.b].map(Vector3::from);
        Ok::<_, GlbError>(match (c.kind, end) {
            (ContactKindName::End, Some(EndName::A)) => a,
            (ContactKindName::End, Some(EndName::B)) => b,
            _ => a + (b - a).normalize() * at,
        })
    };
    let over = on(&c.over, c.at_over, c.end_over)?;
    let under = on(&c.under, c.at_under, c.end_under)?;
    Ok(((over + under) / 2.0).into())
}

#[derive(Serialize)]
struct SupportFigures<'a> {
    rod: &'a str,
    end: &'static str,
    x_mm: f64,
    y_mm: f64,
}

fn support_nodes(root: &mut Root, structure: &Structure) -> Result<Vec<Index<Node>>, GlbError> {
    let mut nodes = Vec::with_capacity(structure.supports.len());
    for (i, s) in structure.supports.iter().enumerate() {
        let SupportEntry { rod, end, point: [x, y, _] } = s;
        let figures = SupportFigures {
            rod,
            end: end.letter(),
            x_mm: rounded(*x, DIGITS),
            y_mm: rounded(*y, DIGITS),
        };
        let name = format!("S{:03}-{rod}-{}", i + 1, end.letter());
        let node = empty(&name, s.point, extras(&figures)?);
        nodes.push(root.push(node));
    }
    Ok(nodes)
}

fn empty(name: &str, point: [f64; 3], extras: Extras) -> Node {
    Node {
        name: Some(name.to_owned()),
        translation: Some(single(metres(point))),
        extras,
        ..Node::default()
    }
}

fn push_group(root: &mut Root, name: &str, children: Vec<Index<Node>>) -> Index<Node> {
    let children = (!children.is_empty()).then_some(children);
    root.push(Node { name: Some(name.to_owned()), children, ..Node::default() })
}

fn push_mesh(root: &mut Root, cylinder: &Cylinder, look: (&str, [f32; 4])) -> Index<Mesh> {
    let (name, color) = look;
    let mut material = Material { name: Some(name.to_owned()), ..Material::default() };
    material.pbr_metallic_roughness.base_color_factor.0 = color;
    material.pbr_metallic_roughness.metallic_factor.0 = 0.0;
    material.pbr_metallic_roughness.roughness_factor.0 = 0.8;
    let material = root.push(material);
    root.push(cylinder.mesh(name, material))
}

/// From mm with z up to metres with y up, right-handed both.
fn metres([x, y, z]: [f64; 3]) -> Point3<f64> {
    Point3::new(x, z, -y) / 1000.0
}

fn single(p: Point3<f64>) -> [f32; 3] {
    // Adding zero turns -0 into 0.
    [p.x, p.y, p.z].map(|x| x as f32 + 0.0)
}

fn extras<T: Serialize>(figures: &T) -> Result<Extras, serde_json::Error> {
    Ok(Some(RawValue::from_string(serde_json::to_string(figures)?)?))
}

#[cfg(test)]
mod tests;
