//! The cylinder that rods share, and the cones that tapered rods share: from the origin, with
//! radius 1, to (0, 1, 0).

use super::parts::{accessor, buffer, pad, view};
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::Target;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Buffer, Index, Material, Mesh, Root};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Sides of the prism that stands for a round rod: smooth to the eye when a rod
/// fills the screen's height, 92 triangles.
pub(in crate::write) const SIDES: u16 = 24;

/// Where a shared geometry lies in the file.
pub(super) struct Cylinder {
    positions: Index<Accessor>,
    normals: Index<Accessor>,
    indices: Index<Accessor>,
}

/// Points with their normals, and triangles counter-clockwise from outside.
struct Geometry {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    triangles: Vec<[u16; 3]>,
}

/// A cylinder, or a cone whose radius at the far end is `taper`. Both caps are flat: their
/// corners are points of their own, since a normal belongs to a point.
fn geometry(taper: f64) -> Geometry {
    let mut g = Geometry { positions: Vec::new(), normals: Vec::new(), triangles: Vec::new() };
    let round = |i: u16| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(SIDES)).sin_cos();
        // Sines of multiples of a right angle are zero up to noise.
        [cos, sin].map(|x| if x.abs() < 1e-9 { 0.0 } else { x as f32 })
    };
    let far = taper as f32;
    // The side leans outward by 1 − taper over a length of 1.
    let slant = 1f32.hypot(1.0 - far);
    for i in 0..SIDES {
        let [x, z] = round(i);
        g.positions.extend([[x, 0.0, z], [x * far, 1.0, z * far]]);
        g.normals.extend([[x / slant, (1.0 - far) / slant, z / slant]; 2]);
        let [here, next] = [2 * i, 2 * ((i + 1) % SIDES)];
        g.triangles.extend([[here, here + 1, next], [next, here + 1, next + 1]]);
    }
    for (y, normal) in [(0.0, -1.0), (1.0, 1.0)] {
        let first = 2 * SIDES + if y > 0.0 { SIDES } else { 0 };
        for i in 0..SIDES {
            let radius = if y > 0.0 { far } else { 1.0 };
            let [x, z] = round(i).map(|c| c * radius);
            g.positions.push([x, y, z]);
            g.normals.push([0.0, normal, 0.0]);
        }
        for i in 1..SIDES - 1 {
            let [b, c] = [first + i, first + i + 1];
            g.triangles.push(if y > 0.0 { [first, c, b] } else { [first, b, c] });
        }
    }
    g
}

/// Adds a geometry for each taper to a file; returns where they lie and the bytes of their
/// buffer.
pub(super) fn push_cylinders(root: &mut Root, tapers: &[f64]) -> (Vec<Cylinder>, Vec<u8>) {
    let all: Vec<Geometry> = tapers.iter().map(|&taper| geometry(taper)).collect();
    let mut bytes = Vec::new();
    let mut starts = Vec::with_capacity(all.len());
    for g in &all {
        starts.push(bytes.len());
        for v in g.positions.iter().chain(&g.normals).flatten() {
            bytes.extend(v.to_le_bytes());
        }
        for i in g.triangles.iter().flatten() {
            bytes.extend(i.to_le_bytes());
        }
        pad(&mut bytes);
    }
    let buffer = root.push(buffer(bytes.len(), None));
    let place = |(g, (start, taper))| push_geometry(root, buffer, g, start, taper);
    let cylinders = all.iter().zip(starts.into_iter().zip(tapers.iter().copied())).map(place);
    (cylinders.collect(), bytes)
}

/// Describes the geometry that lies in the buffer from `start` on.
fn push_geometry(
    root: &mut Root,
    buffer: Index<Buffer>,
    g: &Geometry,
    start: usize,
    taper: f64,
) -> Cylinder {
    let vertices = 2 * 3 * size_of::<f32>() * g.positions.len();
    let indices = 3 * size_of::<u16>() * g.triangles.len();
    let points = root.push(view(buffer, start, vertices, Target::ArrayBuffer));
    let corners = root.push(view(buffer, start + vertices, indices, Target::ElementArrayBuffer));
    // As the points hold it: single precision.
    let wide = f64::from(taper.max(1.0) as f32);
    let (low, high) = (vec![-wide, 0.0, -wide], vec![wide, 1.0, wide]);
    let float = (ComponentType::F32, Type::Vec3);
    let positions = Accessor {
        min: Some(low.into()),
        max: Some(high.into()),
        ..accessor(points, 0, g.positions.len(), float)
    };
    let normals = accessor(points, vertices / 2, g.normals.len(), float);
    let short = (ComponentType::U16, Type::Scalar);
    let indices = accessor(corners, 0, 3 * g.triangles.len(), short);
    Cylinder {
        positions: root.push(positions),
        normals: root.push(normals),
        indices: root.push(indices),
    }
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

    #[test]
    fn every_triangle_looks_the_way_of_its_normals() {
        for taper in [1.0, 0.6, 1.5] {
            let g = geometry(taper);
            assert_eq!((g.positions.len(), g.triangles.len()), (96, 92));
            for t in &g.triangles {
                let [a, b, c] = t.map(|i| Vector3::from(g.positions[usize::from(i)]));
                let across = (b - a).cross(&(c - a));
                assert!(across.norm() > 1e-3);
                for i in t {
                    let normal = Vector3::from(g.normals[usize::from(*i)]);
                    assert!((normal.norm() - 1.0).abs() < 1e-6);
                    assert!(across.normalize().dot(&normal) > 0.99);
                }
            }
        }
    }

    #[test]
    fn the_surface_is_closed() {
        for taper in [1.0, 0.6, 1.5] {
            let g = geometry(taper);
            let volume: f32 = g
                .triangles
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|i| Vector3::from(g.positions[usize::from(i)]));
                    a.dot(&b.cross(&c)) / 6.0
                })
                .sum();
            let (sides, far) = (f32::from(SIDES), taper as f32);
            let prism = sides / 2.0 * (std::f32::consts::TAU / sides).sin();
            let cone = prism * (1.0 + far + far * far) / 3.0;
            assert!((volume - cone).abs() < 1e-4, "{volume} {cone}");
        }
    }
}
