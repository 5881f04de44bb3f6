//! Wavefront OBJ: a mesh as text, mm, z up, the same bytes every time.

use super::figure::figure;
use crate::ids::Id;
use crate::surface::Mesh;
use std::fmt::Write as _;

/// Digits after the point, in mm: a nanometre, far below anything that can be built,
/// and above the last bits that differ between processors.
const DIGITS: usize = 6;

/// The mesh as the text of an OBJ file.
pub fn write_obj(mesh: &Mesh) -> String {
    let mut text = String::from("# millimetres, z up\n");
    for p in &mesh.points {
        let [x, y, z] = [p.x, p.y, p.z].map(|x| figure(x, DIGITS));
        writeln!(text, "v {x} {y} {z}").expect("writing to a string does not fail");
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v.index() + 1);
        writeln!(text, "f {a} {b} {c}").expect("writing to a string does not fail");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::VertexId;
    use crate::surface::{Point3, read, samples};

    #[test]
    fn a_triangle_is_written() {
        let mesh = Mesh {
            points: vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 2.5, 0.0)]
                .into(),
            triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
        };
        assert_eq!(write_obj(&mesh), "# millimetres, z up\nv 0 0 0\nv 1 0 0\nv 0 2.5 0\nf 1 2 3\n");
    }

    #[test]
    fn every_sample_comes_back_from_its_file() {
        for (name, _) in samples::NAMES {
            let mesh = samples::sample(name).expect("listed");
            let text = write_obj(&mesh);
            let back = read::read_bytes(name, text.as_bytes(), None).expect(name);
            assert_eq!(back.notes, Vec::<String>::new());
            assert_eq!(back.mesh.triangles, mesh.triangles);
            let far = back.mesh.points.iter().zip(&mesh.points).map(|(a, b)| (a - b).norm());
            assert!(far.fold(0.0, f64::max) < 1e-6);
            assert_eq!(write_obj(&back.mesh), text);
        }
    }
}
