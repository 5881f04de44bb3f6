//! The model as a binary glTF 2.0 file: metres, y up.
//!
//! Every rod is a node of its own name with a shape that it shares with the rods that are cut
//! like it, placed by translation, rotation and scale: the node's origin is end A, its y axis
//! runs along the rod, and its x axis upward as far as it can. Ends are flat: square, or level
//! where the rod stands on the ground. The material tells how a rod ends ([`look`]), or how far it
//! is used up ([`stress`]).
//! Contacts and supports are empty nodes. Figures of each stand in its `extras`, in mm and
//! degrees.
//!
//! Coordinates are single precision, as the format has it: some 6e-8 of the distance
//! from the origin, so a micrometre at ten metres.

mod cylinder;
mod look;
mod materials;
mod parts;
mod plain;
mod steps;
mod stress;

pub use plain::{mesh_glb, mesh_gltf};
pub use steps::assembly_glb;

use super::figure::rounded;
use super::rod_shape::{RodShapes, across};
use super::structure::{
    ContactEntry, ContactKindName, DiameterEntry, EndName, RodEntry, Structure, SupportEntry,
};
use crate::statics::study::Study;
use cylinder::{Cylinder, push_cylinders};
use gltf::binary::{Glb, Header};
use gltf_json::extras::{Extras, RawValue};
use gltf_json::scene::UnitQuaternion;
use gltf_json::{Index, Mesh, Node, Root, Scene};
use look::Look;
use materials::Materials;
use nalgebra::{Matrix3, Point3, Vector3};
use plain::data_uri;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::HashMap;
use stress::{Shown, StressFigures, Stresses};
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

/// The bytes of the model file. With a study of the frame, which has its rods in the same order,
/// rods have the colours of their stresses, and tell them in their extras.
///
/// # Errors
/// [`GlbError`]; a structure that passes [`Structure::check`] gives none.
pub fn glb(structure: &Structure, study: Option<&Study>) -> Result<Vec<u8>, GlbError> {
    let (mut root, buffer) = document(structure, study, |_| None)?;
    if let Some(study) = study {
        root.scenes[0].extras = stress::scene_extras(study)?;
    }
    wrap(&root, buffer)
}

/// The text of a .gltf file that holds its buffer in itself.
///
/// # Errors
/// As [`glb`].
pub fn gltf(structure: &Structure) -> Result<String, GlbError> {
    let (root, _) = document(structure, None, |buffer| Some(data_uri(buffer)))?;
    Ok(gltf_json::serialize::to_string(&root)? + "\n")
}

/// The document and its buffer, which `uri` says how to find.
fn document(
    structure: &Structure,
    study: Option<&Study>,
    uri: impl FnOnce(&[u8]) -> Option<String>,
) -> Result<(Root, Vec<u8>), GlbError> {
    let mut root = Root::default();
    root.asset.generator = Some(generator());
    let shapes = RodShapes::new(structure);
    let (cylinders, buffer) = push_cylinders(&mut root, &shapes.all, uri);
    let stresses = study.map(Stresses::new);
    let rods = rod_nodes(&mut root, structure, &shapes, &cylinders, stresses.as_ref())?;
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
    Ok((root, buffer))
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
    /// From end A on.
    marks: Vec<MarkFigures<'a>>,
    support: Option<EndName>,
}

/// A contact as a rod sees it.
#[derive(Serialize)]
struct MarkFigures<'a> {
    contact: &'a str,
    at_mm: f64,
    /// How the rod lies to its partner: `over`, `under`, or `end` where two ends meet.
    side: &'static str,
    partner: &'a str,
    at_partner_mm: f64,
    angle_deg: f64,
}

fn notes(structure: &Structure) -> HashMap<&str, Notes<'_>> {
    let mut notes: HashMap<&str, Notes<'_>> = HashMap::new();
    for c in &structure.contacts {
        let [over, under] = [(c.over.as_str(), c.at_over), (c.under.as_str(), c.at_under)];
        for (me, other, side) in [(over, under, "over"), (under, over, "under")] {
            let mark = MarkFigures {
                contact: &c.id,
                at_mm: rounded(me.1, DIGITS),
                side: if c.kind == ContactKindName::End { "end" } else { side },
                partner: other.0,
                at_partner_mm: rounded(other.1, DIGITS),
                angle_deg: rounded(c.angle, DIGITS),
            };
            notes.entry(me.0).or_default().marks.push(mark);
        }
    }
    for s in &structure.supports {
        notes.entry(&s.rod).or_default().support = Some(s.end);
    }
    for note in notes.values_mut() {
        note.marks.sort_by(|a, b| a.at_mm.total_cmp(&b.at_mm).then(a.contact.cmp(b.contact)));
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
    marks: &'a [MarkFigures<'a>],
    #[serde(skip_serializing_if = "Option::is_none")]
    support: Option<&'static str>,
    #[serde(flatten)]
    stress: Option<StressFigures>,
}

fn rod_nodes(
    root: &mut Root,
    structure: &Structure,
    shapes: &RodShapes,
    cylinders: &[Cylinder],
    stresses: Option<&Stresses>,
) -> Result<Vec<Index<Node>>, GlbError> {
    let (notes, none) = (notes(structure), Notes::default());
    let (materials, made) = (Materials::default(), HashMap::new());
    let mut meshes = Meshes { cylinders, stresses, materials, made };
    let mut nodes = Vec::with_capacity(structure.rods.len());
    for (i, (rod, &shape)) in structure.rods.iter().zip(&shapes.of).enumerate() {
        let note = notes.get(rod.id.as_str()).unwrap_or(&none);
        let look = Look::of(rod, note.marks.iter().map(|m| m.side));
        let shown = stresses.map_or(Shown::Ends(look), |s| Shown::Used(s.step(i)));
        let mesh = meshes.of(root, shape, look, shown);
        let figures = RodFigures {
            length_mm: rounded(rod.length, DIGITS),
            diameter_mm: structure.diameters(rod).into(),
            class: &rod.class,
            border: rod.border,
            units: &rod.units,
            contacts: note.marks.iter().map(|m| m.contact).collect(),
            marks: &note.marks,
            support: note.support.map(EndName::letter),
            stress: stresses.map(|s| s.figures(i)),
        };
        let node = Node { mesh: Some(mesh), extras: extras(&figures)?, ..placed(rod, structure) };
        nodes.push(root.push(node));
    }
    Ok(nodes)
}

/// The meshes of rods: one for each shape in each material that it comes in; it is named by how
/// its rods end.
struct Meshes<'a> {
    cylinders: &'a [Cylinder],
    stresses: Option<&'a Stresses>,
    materials: Materials,
    made: HashMap<(usize, Look, Shown), Index<Mesh>>,
}

impl Meshes<'_> {
    /// A mesh without nodes would be left over, so each is made when first needed.
    fn of(&mut self, root: &mut Root, shape: usize, look: Look, shown: Shown) -> Index<Mesh> {
        let Self { cylinders, stresses, materials, made } = self;
        *made.entry((shape, look, shown)).or_insert_with(|| {
            let material = materials.of(root, shown, *stresses);
            root.push(cylinders[shape].mesh(look.name(), material))
        })
    }
}

/// The node of a rod, without its mesh: the shared one runs from the origin to (0, 1, 0),
/// with radius 1 at the origin.
fn placed(rod: &RodEntry, structure: &Structure) -> Node {
    let [a, b] = [metres(rod.a), metres(rod.b)];
    let radius = (structure.diameters(rod)[0] / 2000.0) as f32;
    Node {
        name: Some(rod.id.clone()),
        translation: Some(single(a)),
        rotation: Some(rotation(&(b - a).normalize())),
        scale: Some([radius, (b - a).norm() as f32, radius]),
        ..Node::default()
    }
}

/// The rotation that takes the y axis to a unit vector, and the x axis upward.
fn rotation(along: &Vector3<f64>) -> UnitQuaternion {
    let [upward, _] = across(along, &Vector3::y());
    let axes = Matrix3::from_columns(&[upward, *along, upward.cross(along)]);
    let turn = nalgebra::Rotation3::from_matrix_unchecked(axes);
    let q = nalgebra::UnitQuaternion::from_rotation_matrix(&turn).into_inner();
    UnitQuaternion([q.i, q.j, q.k, q.w].map(|x| x as f32 + 0.0))
}

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

fn rods_by_name(structure: &Structure) -> HashMap<&str, &RodEntry> {
    structure.rods.iter().map(|r| (r.id.as_str(), r)).collect()
}

fn contact_nodes(root: &mut Root, structure: &Structure) -> Result<Vec<Index<Node>>, GlbError> {
    let rods = rods_by_name(structure);
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
    /// Of the rod above the horizontal.
    elevation_deg: f64,
    /// Where the rod heads from its foot, counter-clockwise from the x axis.
    azimuth_deg: f64,
    /// What is sawn off the square end.
    bevel_deg: f64,
}

fn support_nodes(root: &mut Root, structure: &Structure) -> Result<Vec<Index<Node>>, GlbError> {
    let rods = rods_by_name(structure);
    let mut nodes = Vec::with_capacity(structure.supports.len());
    for (i, s) in structure.supports.iter().enumerate() {
        let SupportEntry { rod, end, point: [x, y, _] } = s;
        let entry = rods.get(rod.as_str()).ok_or_else(|| GlbError::MissingRod(rod.clone()))?;
        let [a, b] = [entry.a, entry.b].map(Vector3::from);
        let up = if *end == EndName::A { b - a } else { a - b };
        let elevation = up.z.atan2(up.x.hypot(up.y)).to_degrees();
        let figures = SupportFigures {
            rod,
            end: end.letter(),
            x_mm: rounded(*x, DIGITS),
            y_mm: rounded(*y, DIGITS),
            elevation_deg: rounded(elevation, DIGITS),
            azimuth_deg: rounded(up.y.atan2(up.x).to_degrees().rem_euclid(360.0), DIGITS),
            bevel_deg: rounded(90.0 - elevation, DIGITS),
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
