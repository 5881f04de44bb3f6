//! Rods as meshes: closed prisms round their axes, or parts of cones, mm, z up.

use super::glb::SIDES;
use super::obj::write_obj_objects;
use super::stl::{write_stl, write_stl_text};
use super::structure::{RodEntry, Structure};
use crate::ids::{Id, VertexId};
use crate::surface::{Mesh, Point3, Vector3};
use std::f64::consts::TAU;

/// The rods as the text of an OBJ file, an object each, by their names.
pub fn rods_obj(structure: &Structure) -> String {
    let rods = structure.rods.iter();
    write_obj_objects(rods.map(|r| (r.id.as_str(), rod_mesh(r, structure.diameters(r)))))
}

/// The rods as the bytes of a binary STL file.
pub fn rods_stl(structure: &Structure) -> Vec<u8> {
    write_stl(&all_rods(structure))
}

/// The rods as the text of an STL file.
pub fn rods_stl_text(structure: &Structure) -> String {
    write_stl_text(&all_rods(structure))
}

fn all_rods(structure: &Structure) -> Mesh {
    let mut all = Mesh::default();
    for rod in &structure.rods {
        let first = all.points.len();
        let mesh = rod_mesh(rod, structure.diameters(rod));
        mesh.points.iter().for_each(|&p| _ = all.points.push(p));
        for t in &mesh.triangles {
            all.triangles.push(t.map(|v| VertexId::new(first + v.index())));
        }
    }
    all
}

/// A closed prism with its edges on the rod's round side: the corners of end A, then
/// those of end B.
fn rod_mesh(rod: &RodEntry, diameters: [f64; 2]) -> Mesh {
    let [a, b] = [rod.a, rod.b].map(Point3::from);
    let along = (b - a).normalize();
    // The axis that lies farthest from the rod's gives a direction across it.
    let least = along.iamin();
    let across = Vector3::ith(least, 1.0).cross(&along).normalize();
    let sideways = along.cross(&across);
    let sides = usize::from(SIDES);
    let mut mesh = Mesh::default();
    for (end, diameter) in [a, b].into_iter().zip(diameters) {
        let [across, beside] = [across, sideways].map(|v| v * (diameter / 2.0));
        for i in 0..sides {
            let (sin, cos) = (TAU * i as f64 / sides as f64).sin_cos();
            mesh.points.push(end + across * cos + beside * sin);
        }
    }
    let v = VertexId::new;
    for i in 0..sides {
        let next = (i + 1) % sides;
        mesh.triangles.push([v(i), v(next), v(sides + next)]);
        mesh.triangles.push([v(i), v(sides + next), v(sides + i)]);
    }
    for i in 1..sides - 1 {
        mesh.triangles.push([v(0), v(i + 1), v(i)]);
        mesh.triangles.push([v(sides), v(sides + i), v(sides + i + 1)]);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture::circuit;
    use crate::shop::lengths::classes;
    use crate::surface::shape::Shape;
    use crate::surface::topology::Topology;

    fn structure() -> Structure {
        let frame = circuit(5, 3.0);
        Structure::from_frame(&frame, &classes(&frame), &[])
    }

    #[test]
    fn a_rod_is_a_closed_prism_that_faces_out() {
        let mut rod = structure().rods[0].clone();
        for b in [[3.0, 4.0, 12.0], [0.0, 0.0, 7.0], [-7.0, 0.0, 0.0], [0.0, 1e-3, -9.0]] {
            rod.a = [1.0, 2.0, 3.0];
            rod.b = [1.0 + b[0], 2.0 + b[1], 3.0 + b[2]];
            let mesh = rod_mesh(&rod, [6.0, 2.0]);
            let shape = Shape::new(&mesh, &Topology::new(&mesh).expect("sound"));
            let [piece] = &shape.pieces[..] else { panic!("one piece") };
            assert_eq!((piece.borders.len(), piece.genus), (0, 0));
            let six_volumes: f64 = mesh
                .triangles
                .ids()
                .map(|f| {
                    (mesh.corners(f)[0] - mesh.points[VertexId::new(0)]).dot(&mesh.area_vector(f))
                })
                .sum();
            let sides = f64::from(SIDES);
            let area = sides / 2.0 * (TAU / sides).sin();
            // A cone's: its mean section with radii r and s is that of (r² + r s + s²) / 3.
            let area = area * (9.0 + 3.0 + 1.0) / 3.0;
            let volume = area * Vector3::from(b).norm();
            assert!((six_volumes / 6.0 / volume - 1.0).abs() < 1e-9, "{b:?}");
        }
    }

    #[test]
    fn rods_are_objects_by_name_and_triangles_without() {
        let structure = structure();
        let text = rods_obj(&structure);
        let names: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("o ")).collect();
        assert_eq!(names, ["R001", "R002", "R003", "R004", "R005"]);
        let faces = text.lines().filter(|l| l.starts_with("f ")).count();
        assert_eq!(faces, 5 * 92);
        assert_eq!(rods_stl(&structure).len(), 84 + 50 * faces);
        assert_eq!(rods_stl_text(&structure).matches("facet normal").count(), faces);
    }
}
