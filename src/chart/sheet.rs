//! What is flattened: the triangles of the surface, then those that fill its holes.

use super::fill::{Filling, fill};
use crate::ids::{Id, VertexId};
use crate::surface::Mesh;
use crate::surface::topology::Topology;

/// A disk of triangles with the angles that they have in space.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The corners of each triangle, counter-clockwise.
    pub triangles: Vec<[VertexId; 3]>,
    /// How many triangles belong to the surface; those after them fill holes.
    pub real: usize,
    /// The angle at each corner of each triangle, radians.
    pub angles: Vec<[f64; 3]>,
    /// Of each vertex, whether it lies on the outer border.
    pub rim: Vec<bool>,
}

impl Sheet {
    /// The sheet of a mesh of one piece without handles. Its longest border is the
    /// rim; all others are filled.
    pub fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let Filling { mesh: fillers, rim: outer } = fill(mesh, topology);
        let mut rim = vec![false; fillers.points.len()];
        for v in outer {
            rim[v.index()] = true;
        }
        let mut angles = corner_angles(mesh);
        angles.extend(corner_angles(&fillers));
        let mut triangles = mesh.triangles.to_vec();
        triangles.extend_from_slice(&fillers.triangles);
        Self { triangles, real: mesh.triangles.len(), angles, rim }
    }
}

/// The angle at each corner of each triangle, radians; 0 where sides have no length.
pub fn corner_angles(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.triangles
        .ids()
        .map(|f| {
            let p = mesh.corners(f);
            std::array::from_fn(|k| (p[(k + 1) % 3] - p[k]).angle(&(p[(k + 2) % 3] - p[k])))
        })
        .collect()
}
