//! STL: triangles with their corners and normals, nothing shared. In mm, z up, as slicers
//! for printers expect it; the format itself has no unit.
//!
//! Coordinates are single precision in the binary form and shortest exact text in the
//! other. Corners come in the order of the triangles, so that joining them by place
//! gives the mesh back.

use super::figure::exact;
use crate::ids::FaceId;
use crate::surface::{Mesh, Point3};
use std::fmt::Write as _;

/// Bytes of text before the number of triangles. It must not begin with `solid`, which
/// would announce the other form.
const HEADER: &[u8; 80] =
    b"binary STL by rodwright, millimetres, z up                                      ";

/// The bytes of a binary STL file.
pub fn write_stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(84 + 50 * mesh.triangles.len());
    bytes.extend(HEADER);
    // Normals are those of the corners as written.
    let single = |p: &Point3| p.map(|x| f64::from(x as f32));
    let points = mesh.points.iter().map(single).collect();
    let mesh = Mesh { points, triangles: mesh.triangles.clone() };
    let count = u32::try_from(mesh.triangles.len());
    bytes.extend(count.expect("triangles have 32-bit numbers").to_le_bytes());
    for face in mesh.triangles.ids() {
        let corners = mesh.corners(face).map(|p| [p.x, p.y, p.z]);
        for x in [normal(&mesh, face)].iter().chain(&corners).flatten() {
            // Adding zero turns -0 into 0.
            bytes.extend((*x as f32 + 0.0).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// The text of an STL file with one solid.
pub fn write_stl_text(mesh: &Mesh) -> String {
    let mut text = String::from("solid surface\n");
    for face in mesh.triangles.ids() {
        let line = |p: [f64; 3]| p.map(exact).join(" ");
        let n = line(normal(mesh, face).map(|x| f64::from(x as f32)));
        let [a, b, c] = mesh.corners(face).map(|p| line([p.x, p.y, p.z]));
        write!(
            text,
            "facet normal {n}\n outer loop\n  vertex {a}\n  vertex {b}\n  vertex {c}\n \
             endloop\nendfacet\n"
        )
        .expect("writing to a string does not fail");
    }
    text + "endsolid surface\n"
}

/// Unit normal; zero for a triangle without area.
fn normal(mesh: &Mesh, face: FaceId) -> [f64; 3] {
    let n = mesh.area_vector(face);
    n.try_normalize(0.0).map_or([0.0; 3], Into::into)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{Id, VertexId};

    fn triangle() -> Mesh {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, -0.0]];
        Mesh {
            points: points.iter().map(|&p| Point3::from(p)).collect(),
            triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
        }
    }

    #[test]
    fn a_triangle_is_fifty_bytes() {
        let bytes = write_stl(&triangle());
        assert_eq!(
            (bytes.len(), &bytes[..10], &bytes[80..84]),
            (134, &b"binary STL"[..], &[1, 0, 0, 0][..])
        );
        let numbers: Vec<f32> = bytes[84..132]
            .chunks(4)
            .map(|b| f32::from_le_bytes(b.try_into().expect("four bytes")))
            .collect();
        assert_eq!(numbers, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1, 0.0]);
        assert_eq!(bytes[132..], [0, 0]);
    }

    #[test]
    fn a_triangle_is_seven_lines() {
        assert_eq!(
            write_stl_text(&triangle()),
            "solid surface\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  \
             vertex 0 0.1 0\n endloop\nendfacet\nendsolid surface\n"
        );
    }
}
