//! Whether the flat mesh overlaps itself.
//!
//! Where no triangle is turned over, the map is one to one near every point; it is so as
//! a whole when its border lines do not cross each other or themselves either.

use crate::ids::{IdVec, VertexId};
use crate::surface::bvh::{Aabb, Bvh};
use crate::surface::locate::segments_cross;
use crate::surface::topology::{HalfedgeId, Topology};
use nalgebra::Point2;

/// The first border edge that another one crosses in the plane.
pub(super) fn first_crossing(
    topology: &Topology,
    flat: &IdVec<VertexId, Point2<f64>>,
) -> Option<HalfedgeId> {
    let border: Vec<HalfedgeId> = topology.border_halfedges().into_iter().flatten().collect();
    let ends = |h: HalfedgeId| [topology.from(h), topology.to(h)];
    let place = |h: HalfedgeId| ends(h).map(|v| flat[v]);
    let boxes: Vec<Aabb<2>> = border.iter().map(|&h| Aabb::around(&place(h))).collect();
    let tree = Bvh::new(&boxes);
    border.iter().copied().find(|&h| {
        let segment = place(h);
        let bounds = Aabb::around(&segment);
        let mut crossed = false;
        tree.visit(
            |near| near.overlaps(&bounds),
            |i| {
                let other = border[i];
                let apart = !ends(h).iter().any(|v| ends(other).contains(v));
                crossed = crossed || (apart && segments_cross(segment, place(other)));
            },
        );
        crossed
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::surface::{Mesh, Point3};

    /// A strip of two rows of points, `turn` times round a circle in the plane, as a
    /// ramp in space.
    fn ramp(turn: f64) -> (Mesh, IdVec<VertexId, Point2<f64>>) {
        let mut mesh = Mesh::default();
        let mut flat = IdVec::new();
        for i in 0..=40 {
            let angle = turn * std::f64::consts::TAU * f64::from(i) / 40.0;
            for radius in [10.0, 14.0] {
                let p = Point2::new(radius * angle.cos(), radius * angle.sin());
                flat.push(p);
                mesh.points.push(Point3::new(p.x, p.y, f64::from(i)));
            }
        }
        for i in 0..40 {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3].map(VertexId::new);
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([b, d, c]);
        }
        (mesh, flat)
    }

    #[test]
    fn a_ramp_of_more_than_one_turn_overlaps() {
        for (turn, overlaps) in [(0.5, false), (0.95, false), (1.3, true)] {
            let (mesh, flat) = ramp(turn);
            let topology = Topology::new(&mesh).expect("a strip");
            assert_eq!(first_crossing(&topology, &flat).is_some(), overlaps, "{turn}");
        }
    }
}
