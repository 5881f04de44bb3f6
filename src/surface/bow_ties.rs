//! Divides vertices in which parts of a surface touch without sharing an edge there, so
//! that every vertex has one fan of triangles.

use crate::ids::{Id, IdVec};
use crate::surface::Mesh;
use crate::surface::topology::{HalfedgeId, Topology};

/// Gives each fan of triangles at a bow-tie a vertex of its own, at the same place.
/// Also counts the vertices that were divided.
///
/// As a set of points the surface stays as it is, so this is certain: parts that touch
/// in a point carry nothing across it. New vertices stand behind the old ones, in the
/// order of their first triangles. Joining vertices by their places undoes it. A mesh
/// whose edges are not sound comes back as it is.
pub fn split_bow_ties(mesh: Mesh) -> (Mesh, usize) {
    let Ok(topology) = Topology::new(&mesh) else { return (mesh, 0) };
    let count = topology.bow_ties().len();
    if count == 0 {
        return (mesh, 0);
    }
    let Mesh { mut points, mut triangles } = mesh;
    let mut taken = vec![false; points.len()];
    let mut seen: IdVec<HalfedgeId, bool> = vec![false; 3 * triangles.len()].into();
    for start in topology.halfedges() {
        if seen[start] {
            continue;
        }
        let v = topology.from(start);
        let mut own = v;
        if std::mem::replace(&mut taken[v.index()], true) {
            own = points.push(points[v]);
        }
        for h in topology.fan(start) {
            seen[h] = true;
            triangles[h.face()][h.side()] = own;
        }
    }
    (Mesh { points, triangles }, count)
}
