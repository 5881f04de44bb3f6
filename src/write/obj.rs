//! Wavefront OBJ: meshes as text, mm, z up.

use super::figure::{exact, figure};
use crate::ids::{Id, VertexId};
use crate::surface::polygons::PolygonMesh;
use crate::surface::{Mesh, Point3};
use std::fmt::Write as _;

/// Digits after the point of the samples, in mm: a nanometre, far below anything that can
/// be built, and above the last bits that differ between processors.
const DIGITS: usize = 6;

const REMARK: &str = "# millimetres, z up\n";

/// The mesh as the text of an OBJ file, to the nanometre: the same bytes everywhere.
pub fn write_obj(mesh: &Mesh) -> String {
    let mut text = String::from(REMARK);
    add(&mut text, &mesh.points, &mesh.triangles, 0, |x| figure(x, DIGITS));
    text
}

/// The same for a mesh of polygons.
pub fn write_obj_polygons(mesh: &PolygonMesh) -> String {
    let mut text = String::from(REMARK);
    add(&mut text, &mesh.points, &mesh.faces, 0, |x| figure(x, DIGITS));
    text
}

/// The mesh as the text of an OBJ file, with the shortest digits that read back the same.
pub fn write_obj_exact(mesh: &Mesh) -> String {
    let mut text = String::from(REMARK);
    add(&mut text, &mesh.points, &mesh.triangles, 0, exact);
    text
}

/// Several meshes as named objects of one OBJ file.
pub fn write_obj_objects<'a>(objects: impl IntoIterator<Item = (&'a str, Mesh)>) -> String {
    let mut text = String::from(REMARK);
    let mut before = 0;
    for (name, mesh) in objects {
        writeln!(text, "o {name}").expect("writing to a string does not fail");
        add(&mut text, &mesh.points, &mesh.triangles, before, exact);
        before += mesh.points.len();
    }
    text
}

/// Adds vertices and faces; `before` vertices stand in the file already.
fn add(
    text: &mut String,
    points: &[Point3],
    faces: &[impl AsRef<[VertexId]>],
    before: usize,
    number: impl Fn(f64) -> String,
) {
    for p in points {
        let [x, y, z] = [p.x, p.y, p.z].map(&number);
        writeln!(text, "v {x} {y} {z}").expect("writing to a string does not fail");
    }
    for face in faces {
        let corners = face.as_ref().iter().map(|v| format!(" {}", before + v.index() + 1));
        writeln!(text, "f{}", corners.collect::<String>())
            .expect("writing to a string does not fail");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{read, samples};

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
    fn objects_count_their_vertices_on() {
        let mesh = Mesh {
            points: vec![Point3::origin(), Point3::new(0.1 + 0.2, 0.0, 0.0)].into(),
            triangles: vec![[0, 1, 0].map(VertexId::new)].into(),
        };
        let text = write_obj_objects([("R001", mesh.clone()), ("R002", mesh)]);
        let object = "v 0 0 0\nv 0.30000000000000004 0 0\n";
        let all =
            format!("# millimetres, z up\no R001\n{object}f 1 2 1\no R002\n{object}f 3 4 3\n");
        assert_eq!(text, all);
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
