//! A plain mesh as glTF 2.0: one node, metres, y up, nothing but positions and triangles.
//!
//! Vertices and triangles keep their order. Coordinates are single precision. Surfaces
//! are seen from both sides; viewers shade them flat, since there are no normals.

use super::parts::{accessor, buffer, pad, view};
use super::{GlbError, generator, metres, single, wrap};
use crate::ids::Id;
use crate::surface::Mesh;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::Target;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Index, Material, Node, Root, Scene};
use std::collections::BTreeMap;

/// The bytes of a .glb file.
///
/// # Errors
/// What the JSON writer says; a mesh of finite points gives none.
pub fn mesh_glb(mesh: &Mesh) -> Result<Vec<u8>, GlbError> {
    let geometry = Geometry::new(mesh);
    let root = document(&geometry, None);
    wrap(&root, geometry.bytes)
}

/// The text of a .gltf file that holds its buffer in itself.
///
/// # Errors
/// As [`mesh_glb`].
pub fn mesh_gltf(mesh: &Mesh) -> Result<String, GlbError> {
    let geometry = Geometry::new(mesh);
    let uri = data_uri(&geometry.bytes);
    Ok(gltf_json::serialize::to_string(&document(&geometry, Some(uri)))? + "\n")
}

/// The buffer, and what its accessors must say.
struct Geometry {
    bytes: Vec<u8>,
    vertices: usize,
    triangles: usize,
    bounds: [[f32; 3]; 2],
}

impl Geometry {
    fn new(mesh: &Mesh) -> Self {
        let mut bytes = Vec::with_capacity(12 * (mesh.points.len() + mesh.triangles.len()));
        let (mut lo, mut hi) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for p in &mesh.points {
            let place = single(metres([p.x, p.y, p.z]));
            for (k, x) in place.into_iter().enumerate() {
                lo[k] = lo[k].min(x);
                hi[k] = hi[k].max(x);
                bytes.extend(x.to_le_bytes());
            }
        }
        for v in mesh.triangles.iter().flatten() {
            let v = u32::try_from(v.index()).expect("vertices have 32-bit numbers");
            bytes.extend(v.to_le_bytes());
        }
        pad(&mut bytes);
        Self {
            bytes,
            vertices: mesh.points.len(),
            triangles: mesh.triangles.len(),
            bounds: [lo, hi],
        }
    }
}

fn document(geometry: &Geometry, uri: Option<String>) -> Root {
    let mut root = Root::default();
    root.asset.generator = Some(generator());
    let buffer = root.push(buffer(geometry.bytes.len(), uri));
    let (points, corners) = (12 * geometry.vertices, 12 * geometry.triangles);
    let points = root.push(view(buffer, 0, points, Target::ArrayBuffer));
    let offset = 12 * geometry.vertices;
    let corners = root.push(view(buffer, offset, corners, Target::ElementArrayBuffer));
    let [lo, hi] = geometry.bounds.map(|p| Some(p.map(f64::from).to_vec().into()));
    let float = (ComponentType::F32, Type::Vec3);
    let positions =
        root.push(Accessor { min: lo, max: hi, ..accessor(points, 0, geometry.vertices, float) });
    let int = (ComponentType::U32, Type::Scalar);
    let indices = root.push(accessor(corners, 0, 3 * geometry.triangles, int));
    let material = root.push(Material {
        name: Some("surface".into()),
        double_sided: true,
        ..Material::default()
    });
    let primitive = Primitive {
        attributes: BTreeMap::from([(Valid(Semantic::Positions), positions)]),
        extensions: None,
        extras: None,
        indices: Some(indices),
        material: Some(material),
        mode: Valid(Mode::Triangles),
        targets: None,
    };
    let mesh = root.push(gltf_json::Mesh {
        extensions: None,
        extras: None,
        name: Some("surface".into()),
        primitives: vec![primitive],
        weights: None,
    });
    let node = Node { mesh: Some(mesh), name: Some("surface".into()), ..Node::default() };
    let nodes: Vec<Index<Node>> = vec![root.push(node)];
    root.scene = Some(root.push(Scene {
        nodes,
        extensions: None,
        extras: None,
        name: Some("surface".into()),
    }));
    root
}

/// A buffer as an address that holds it.
pub(super) fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", base64(bytes))
}

/// Base64 with padding (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::samples;

    #[test]
    fn base64_of_the_rfc() {
        // RFC 4648, section 10.
        let cases = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (n, text) in cases.iter().enumerate() {
            assert_eq!(base64(&b"foobar"[..n]), *text);
        }
    }

    #[test]
    fn the_box_that_is_said_is_that_of_the_numbers() {
        let mesh = samples::sample("vault").expect("a sample");
        let glb = gltf::Gltf::from_slice(&mesh_glb(&mesh).expect("a file")).expect("sound");
        let text = mesh_gltf(&mesh).expect("a file");
        let document = gltf::Gltf::from_slice(text.as_bytes()).expect("sound");
        assert_eq!(document.blob, None);
        let primitive = |g: &gltf::Gltf| {
            let b =
                g.meshes().next().expect("one").primitives().next().expect("one").bounding_box();
            [b.min, b.max]
        };
        assert_eq!(primitive(&glb), primitive(&document));
        let blob = glb.blob.clone().expect("the chunk");
        let numbers: Vec<f32> = blob[..12 * mesh.points.len()]
            .chunks(4)
            .map(|b| f32::from_le_bytes(b.try_into().expect("four bytes")))
            .collect();
        let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        for p in numbers.chunks(3) {
            for k in 0..3 {
                bounds[0][k] = bounds[0][k].min(p[k]);
                bounds[1][k] = bounds[1][k].max(p[k]);
            }
        }
        assert_eq!(primitive(&glb), bounds);
        let y = bounds[1][1];
        assert!((y - 0.1678).abs() < 1e-4, "metres, y up: {y}");
    }
}
