//! The shapes that rods share, in a file: from the origin, with radius 1, to (0, 1, 0), the
//! upper side of a level cut towards x.

use super::super::rod_shape::{RodShape, SIDES};
use super::parts::{accessor, buffer, pad, view};
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::Target;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Buffer, Index, Material, Mesh, Root};
use std::collections::BTreeMap;

/// Where a shared geometry lies in the file.
pub(super) struct Cylinder {
    positions: Index<Accessor>,
    normals: Index<Accessor>,
    indices: Index<Accessor>,
}

/// Points with their normals.
struct Geometry {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
}

/// A rod's round side, then its two flat ends: their corners are points of their own, since
/// a normal belongs to a point.
fn geometry(shape: &RodShape) -> Geometry {
    // Adding zero turns -0 into 0.
    let point = |[along, up, side]: [f64; 3]| [up, along, side].map(|x| x as f32 + 0.0);
    let rims = [0, 1].map(|end| shape.rim(end).map(point).collect::<Vec<_>>());
    let mut g = Geometry { positions: Vec::new(), normals: Vec::new() };
    // The side leans outward by 1 − taper over a length of 1.
    let lean = (1.0 - shape.taper) as f32;
    let slant = 1f32.hypot(lean);
    for (a, b) in rims[0].iter().zip(&rims[1]) {
        let [x, _, z] = *a;
        let radius = x.hypot(z);
        g.positions.extend([a, b]);
        g.normals.extend([[x / radius / slant, lean / slant, z / radius / slant]; 2]);
    }
    for (end, (rim, out)) in rims.iter().zip([-1.0, 1.0]).enumerate() {
        let slope = (-out * shape.slopes[end]) as f32;
        let long = slope.hypot(1.0);
        g.positions.extend(rim);
        g.normals.extend(rim.iter().map(|_| [slope / long + 0.0, out as f32 / long, 0.0]));
    }
    g
}

/// The triangles of every shape, counter-clockwise from outside.
fn triangles() -> Vec<[u16; 3]> {
    let mut triangles = Vec::new();
    for i in 0..SIDES {
        let [here, next] = [2 * i, 2 * ((i + 1) % SIDES)];
        triangles.extend([[here, here + 1, next], [next, here + 1, next + 1]]);
    }
    for (first, is_far) in [(2 * SIDES, false), (3 * SIDES, true)] {
        for i in 1..SIDES - 1 {
            let [b, c] = [first + i, first + i + 1];
            triangles.push(if is_far { [first, c, b] } else { [first, b, c] });
        }
    }
    triangles
}

/// Adds the shapes to a file; returns where they lie and the bytes of their buffer.
pub(super) fn push_cylinders(
    root: &mut Root,
    shapes: &[RodShape],
    uri: impl FnOnce(&[u8]) -> Option<String>,
) -> (Vec<Cylinder>, Vec<u8>) {
    let triangles = triangles();
    let mut bytes: Vec<u8> = triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
    pad(&mut bytes);
    let all: Vec<(usize, Geometry)> = shapes
        .iter()
        .map(|shape| {
            let (start, g) = (bytes.len(), geometry(shape));
            bytes.extend(
                g.positions.iter().chain(&g.normals).flatten().flat_map(|x| x.to_le_bytes()),
            );
            (start, g)
        })
        .collect();
    let buffer = root.push(buffer(bytes.len(), uri(&bytes)));
    let length = 3 * size_of::<u16>() * triangles.len();
    let corners = root.push(view(buffer, 0, length, Target::ElementArrayBuffer));
    let short = (ComponentType::U16, Type::Scalar);
    let indices = root.push(accessor(corners, 0, 3 * triangles.len(), short));
    let place = |(start, g): &(usize, Geometry)| push_geometry(root, (buffer, *start), g, indices);
    (all.iter().map(place).collect(), bytes)
}

/// Describes the geometry that lies in a buffer from a place on.
fn push_geometry(
    root: &mut Root,
    (buffer, start): (Index<Buffer>, usize),
    g: &Geometry,
    indices: Index<Accessor>,
) -> Cylinder {
    let half = 3 * size_of::<f32>() * g.positions.len();
    let points = root.push(view(buffer, start, 2 * half, Target::ArrayBuffer));
    let bound = |choose: fn(f32, f32) -> f32| {
        let corner =
            g.positions.iter().copied().reduce(|p, q| [0, 1, 2].map(|i| choose(p[i], q[i])));
        corner.map(|p| p.map(f64::from).to_vec().into())
    };
    let float = (ComponentType::F32, Type::Vec3);
    let positions = Accessor {
        min: bound(f32::min),
        max: bound(f32::max),
        ..accessor(points, 0, g.positions.len(), float)
    };
    let normals = accessor(points, half, g.normals.len(), float);
    Cylinder { positions: root.push(positions), normals: root.push(normals), indices }
}

impl Cylinder {
    /// A mesh of the shared geometry in a material.
    pub fn mesh(&self, name: &str, material: Index<Material>) -> Mesh {
        let attributes = BTreeMap::from([
            (Valid(Semantic::Positions), self.positions),
            (Valid(Semantic::Normals), self.normals),
        ]);
        let primitive = Primitive {
            attributes,
            extensions: None,
            extras: None,
            indices: Some(self.indices),
            material: Some(material),
            mode: Valid(Mode::Triangles),
            targets: None,
        };
        Mesh {
            extensions: None,
            extras: None,
            name: Some(name.to_owned()),
            primitives: vec![primitive],
            weights: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// Square, tapered either way, and with a level cut at either end.
    fn shapes() -> Vec<RodShape> {
        let shape = |taper, slopes| RodShape { taper, slopes };
        vec![
            shape(1.0, [0.0; 2]),
            shape(0.6, [0.0; 2]),
            shape(1.5, [0.0; 2]),
            shape(1.0, [-0.05, 0.0]),
            shape(0.6, [0.0, 0.08]),
            shape(1.5, [-0.02, 0.0]),
        ]
    }

    #[test]
    fn every_triangle_looks_the_way_of_its_normals() {
        for shape in shapes() {
            let (g, triangles) = (geometry(&shape), triangles());
            assert_eq!((g.positions.len(), g.normals.len(), triangles.len()), (96, 96, 92));
            for t in triangles {
                let [a, b, c] = t.map(|i| Vector3::from(g.positions[usize::from(i)]));
                let across = (b - a).cross(&(c - a));
                assert!(across.norm() > 1e-3);
                for i in t {
                    let normal = Vector3::from(g.normals[usize::from(i)]);
                    assert!((normal.norm() - 1.0).abs() < 1e-6);
                    assert!(across.normalize().dot(&normal) > 0.99, "{shape:?}");
                }
            }
        }
    }

    /// A level cut takes off on one side what it leaves on the other, but for the taper.
    #[test]
    fn the_surface_is_closed() {
        for shape in shapes() {
            let g = geometry(&shape);
            let volume: f32 = triangles()
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|i| Vector3::from(g.positions[usize::from(i)]));
                    a.dot(&b.cross(&c)) / 6.0
                })
                .sum();
            let (sides, far) = (f32::from(SIDES), shape.taper as f32);
            let prism = sides / 2.0 * (std::f32::consts::TAU / sides).sin();
            let cone = prism * (1.0 + far + far * far) / 3.0;
            let within = if shape.slopes == [0.0; 2] || far == 1.0 { 1e-4 } else { 1e-2 };
            assert!((volume - cone).abs() < within, "{shape:?}: {volume} {cone}");
        }
    }
}
