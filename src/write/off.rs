//! OFF (object file format of Geomview): vertices and triangles as text, mm, z up.

use super::figure::exact;
use crate::ids::Id;
use crate::surface::Mesh;
use std::fmt::Write as _;

/// The text of an OFF file. Numbers have the shortest digits that read back the same.
pub fn write_off(mesh: &Mesh) -> String {
    // No remarks: some readers stumble over them.
    format!("OFF\n{} {} 0\n", mesh.points.len(), mesh.triangles.len()) + &body(mesh)
}

/// Points and triangles as OFF and PLY texts have them: a line each, triangles with their
/// number of corners in front.
pub(super) fn body(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in &mesh.points {
        let [x, y, z] = [p.x, p.y, p.z].map(exact);
        writeln!(text, "{x} {y} {z}").expect("writing to a string does not fail");
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v.index());
        writeln!(text, "3 {a} {b} {c}").expect("writing to a string does not fail");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::VertexId;
    use crate::surface::Point3;

    #[test]
    fn a_triangle_is_written() {
        let points = [[0.0, 0.0, -0.0], [1e-7, 0.0, 0.0], [0.0, 0.1 + 0.2, 0.0]];
        let mesh = Mesh {
            points: points.iter().map(|&p| Point3::from(p)).collect(),
            triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
        };
        let text = "OFF\n3 1 0\n0 0 0\n0.0000001 0 0\n0 0.30000000000000004 0\n3 0 1 2\n";
        assert_eq!(write_off(&mesh), text);
    }
}
