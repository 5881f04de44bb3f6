//! Rods as meshes: closed prisms round their axes, or parts of cones, cut level where they
//! stand on the ground; mm, z up.

use super::obj::write_obj_objects;
use super::rod_shape::{RodShape, RodShapes, SIDES, across};
use super::stl::{write_stl, write_stl_text};
use super::structure::{RodEntry, Structure};
use crate::ids::{Id, VertexId};
use crate::surface::{Mesh, Point3, Vector3};

/// The rods as the text of an OBJ file, an object each, by their names.
pub fn rods_obj(structure: &Structure) -> String {
    let meshes = rod_meshes(structure);
    write_obj_objects(structure.rods.iter().map(|rod| rod.id.as_str()).zip(meshes))
}

/// The rods as the bytes of a binary STL file.
pub fn rods_stl(structure: &Structure) -> Vec<u8> {
    write_stl(&all_rods(structure))
}

/// The rods as the text of an STL file.
pub fn rods_stl_text(structure: &Structure) -> String {
    write_stl_text(&all_rods(structure))
}

/// All rods as one mesh, one after the other; they share no vertices.
pub fn all_rods(structure: &Structure) -> Mesh {
    let mut all = Mesh::default();
    for mesh in rod_meshes(structure) {
        let first = all.points.len();
        mesh.points.iter().for_each(|&p| _ = all.points.push(p));
        for t in &mesh.triangles {
            all.triangles.push(t.map(|v| VertexId::new(first + v.index())));
        }
    }
    all
}

/// A mesh for each rod.
fn rod_meshes(structure: &Structure) -> impl Iterator<Item = Mesh> {
    let RodShapes { all, of } = RodShapes::new(structure);
    let mesh = move |(rod, shape): (&RodEntry, usize)| {
        rod_mesh(rod, structure.diameters(rod)[0] / 2.0, &all[shape])
    };
    structure.rods.iter().zip(of).map(mesh)
}

/// A closed prism with its edges on the rod's round side: the corners of end A, then
/// those of end B. `radius` is that at end A.
fn rod_mesh(rod: &RodEntry, radius: f64, shape: &RodShape) -> Mesh {
    let [a, b] = [rod.a, rod.b].map(Point3::from);
    let [upward, sideways] = across(&(b - a).normalize(), &Vector3::z());
    let sides = usize::from(SIDES);
    let mut mesh = Mesh::default();
    for end in [0, 1] {
        for [along, up, side] in shape.rim(end) {
            mesh.points.push(a + (b - a) * along + (upward * up + sideways * side) * radius);
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
    use std::f64::consts::TAU;

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
            let shape = RodShape { taper: 1.0 / 3.0, slopes: [0.0; 2] };
            let mesh = rod_mesh(&rod, 3.0, &shape);
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
