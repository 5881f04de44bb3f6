//! PLY (Stanford polygon format): vertices as doubles, triangles as lists, mm, z up.

use super::off::body;
use crate::ids::Id;
use crate::surface::Mesh;

/// The bytes of a binary PLY file, little endian.
pub fn write_ply(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = header(mesh, "binary_little_endian").into_bytes();
    bytes.reserve(24 * mesh.points.len() + 13 * mesh.triangles.len());
    for x in mesh.points.iter().flat_map(|p| [p.x, p.y, p.z]) {
        // Adding zero turns -0 into 0.
        bytes.extend((x + 0.0).to_le_bytes());
    }
    for t in &mesh.triangles {
        bytes.push(3);
        for v in t {
            let v = u32::try_from(v.index()).expect("vertices have 32-bit numbers");
            bytes.extend(v.to_le_bytes());
        }
    }
    bytes
}

/// The text of a PLY file. Numbers have the shortest digits that read back the same.
pub fn write_ply_text(mesh: &Mesh) -> String {
    header(mesh, "ascii") + &body(mesh)
}

fn header(mesh: &Mesh, format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment millimetres, z up\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\nelement face {}\n\
         property list uchar uint vertex_indices\nend_header\n",
        mesh.points.len(),
        mesh.triangles.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::VertexId;
    use crate::surface::Point3;

    const HEAD: &str = "ply\nformat FORMAT 1.0\ncomment millimetres, z up\nelement vertex 3\n\
        property double x\nproperty double y\nproperty double z\nelement face 1\n\
        property list uchar uint vertex_indices\nend_header\n";

    fn triangle() -> Mesh {
        let points = [[0.0, 0.0, -0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]];
        Mesh {
            points: points.iter().map(|&p| Point3::from(p)).collect(),
            triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
        }
    }

    #[test]
    fn a_triangle_as_text() {
        let head = HEAD.replace("FORMAT", "ascii");
        assert_eq!(write_ply_text(&triangle()), head + "0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n");
    }

    #[test]
    fn a_triangle_as_bytes() {
        let head = HEAD.replace("FORMAT", "binary_little_endian");
        let bytes = write_ply(&triangle());
        let body = bytes.strip_prefix(head.as_bytes()).expect("the header");
        let numbers = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1, 0.0_f64];
        let expected: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        assert_eq!(body, [&expected[..], &[3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]].concat());
    }
}
