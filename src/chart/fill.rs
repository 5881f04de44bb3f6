//! Fills the holes of a surface, for flattening only.
//!
//! The longest border stays the rim. Of the other loops, one of three edges takes a
//! triangle; one whose corners are all seen from their mean takes rings of triangles
//! towards it, each with half as many corners, so that they grow inwards and none is a
//! needle; any other is cut into triangles between its own corners (ear clipping in the
//! plane that fits it best), since no point sees them all and a fan would fold.
//!
//! Left out: holes whose outline crosses itself in that plane, or that cannot be cut
//! without a second edge between two corners. What is left of them takes rings too, and
//! the flattening has to make do with those.

use crate::ids::{Id, VertexId};
use crate::surface::topology::Topology;
use crate::surface::{Mesh, Point3, Vector3};
use nalgebra::{Point2, center};

/// What fills the holes of a surface.
#[derive(Clone, Debug)]
pub struct Filling {
    /// The points of the surface, then new ones; and the triangles that fill.
    pub mesh: Mesh,
    /// The longest border, which stays open.
    pub rim: Vec<VertexId>,
}

/// Fills all borders of a mesh but the longest one.
pub fn fill(mesh: &Mesh, topology: &Topology) -> Filling {
    let loops = topology.border_loops();
    let length = |l: &[VertexId]| -> f64 {
        sides(l).map(|(a, b)| (mesh.points[b] - mesh.points[a]).norm()).sum()
    };
    let lengths: Vec<f64> = loops.iter().map(|l| length(l)).collect();
    let longest = (0..loops.len()).rev().max_by(|&a, &b| lengths[a].total_cmp(&lengths[b]));
    let filling = Mesh { points: mesh.points.clone(), triangles: Default::default() };
    let mut filling = Filling { mesh: filling, rim: Vec::new() };
    for (i, mut around) in loops.into_iter().enumerate() {
        if Some(i) == longest {
            filling.rim = around;
        } else {
            // Border loops have the surface on their left; fillers lie on the other side.
            around.reverse();
            fill_loop(&mut filling.mesh, topology, around);
        }
    }
    filling
}

fn sides(around: &[VertexId]) -> impl Iterator<Item = (VertexId, VertexId)> + '_ {
    (0..around.len()).map(|i| (around[i], around[(i + 1) % around.len()]))
}

fn fill_loop(mesh: &mut Mesh, topology: &Topology, around: Vec<VertexId>) {
    if let [a, b, c] = around[..] {
        mesh.triangles.push([a, b, c]);
        return;
    }
    let flat = in_own_plane(mesh, &around);
    let seen =
        |(i, p): (usize, &Point2<f64>)| p.coords.perp(&flat[(i + 1) % flat.len()].coords) > 0.0;
    if flat.iter().enumerate().all(seen) {
        rings(mesh, around);
    } else {
        let left = Ears::new(topology, around, flat).clip(mesh);
        if left.len() > 2 {
            rings(mesh, left);
        }
    }
}

fn mean(mesh: &Mesh, around: &[VertexId]) -> Point3 {
    let sum: Vector3 = around.iter().map(|&v| mesh.points[v].coords).sum();
    (sum / around.len() as f64).into()
}

/// A loop in the plane across its vector area, about the mean of its corners.
fn in_own_plane(mesh: &Mesh, around: &[VertexId]) -> Vec<Point2<f64>> {
    let middle = mean(mesh, around);
    let arm = |v: VertexId| mesh.points[v] - middle;
    let area: Vector3 = sides(around).map(|(a, b)| arm(a).cross(&arm(b))).sum();
    let normal = area.try_normalize(0.0).unwrap_or_else(Vector3::z);
    // Across the axis from which the normal is farthest, so that the cross is not small.
    let x = Vector3::ith(normal.iamin(), 1.0).cross(&normal).normalize();
    let y = normal.cross(&x);
    around.iter().map(|&v| Point2::new(arm(v).dot(&x), arm(v).dot(&y))).collect()
}

/// Depth of a ring of triangles by the length of its outer sides: between 0.87, where
/// the outer triangles are equilateral, and 1.7, where the inner ones are.
const RING_DEPTH: f64 = 1.2;

/// A loop shrinks to no less than this part of itself at one ring: less, and the fan
/// in the middle has better triangles than the ring.
const LEAST_SHRINK: f64 = 0.35;

/// Rings of triangles from a loop towards its mean, and a fan in the middle.
fn rings(mesh: &mut Mesh, mut outer: Vec<VertexId>) {
    let middle = mean(mesh, &outer);
    loop {
        let n = outer.len();
        let to_middle = |v: &VertexId| (mesh.points[*v] - middle).norm();
        let radius: f64 = outer.iter().map(to_middle).sum::<f64>() / n as f64;
        let side = |(a, b): (VertexId, VertexId)| (mesh.points[b] - mesh.points[a]).norm();
        let side: f64 = sides(&outer).map(side).sum::<f64>() / n as f64;
        let shrink = 1.0 - RING_DEPTH * side / radius;
        // Also where all corners are in one place and the quotient is undefined.
        if n < 8 || shrink.is_nan() || shrink < LEAST_SHRINK {
            break;
        }
        let at = |v: VertexId, points: &[Point3]| middle + (points[v.index()] - middle) * shrink;
        let inner: Vec<VertexId> = (0..n.div_ceil(2))
            .map(|i| {
                let next = if 2 * i + 1 < n { outer[2 * i + 1] } else { outer[0] };
                let place = center(&at(outer[2 * i], &mesh.points), &at(next, &mesh.points));
                mesh.points.push(place)
            })
            .collect();
        for (i, &here) in inner.iter().enumerate() {
            let [a, b, c] = [0, 1, 2].map(|k| outer[(2 * i + k) % n]);
            let next = inner[(i + 1) % inner.len()];
            mesh.triangles.push([a, b, here]);
            mesh.triangles.push([b, next, here]);
            // The last side of an odd loop has no partner: there is nothing to b's right.
            if 2 * i + 1 < n {
                mesh.triangles.push([b, c, next]);
            }
        }
        outer = inner;
    }
    let tip = mesh.points.push(middle);
    for (a, b) in sides(&outer) {
        mesh.triangles.push([a, b, tip]);
    }
}

/// A polygon being cut into triangles, corner by corner.
struct Ears<'a> {
    topology: &'a Topology,
    around: Vec<VertexId>,
    flat: Vec<Point2<f64>>,
    /// Least angle of the triangle at each corner where it can be cut off, else negative.
    worth: Vec<f64>,
}

/// In place of an angle: a corner that cannot be cut off.
const NO_EAR: f64 = -1.0;

impl<'a> Ears<'a> {
    fn new(topology: &'a Topology, around: Vec<VertexId>, flat: Vec<Point2<f64>>) -> Self {
        let worth = vec![NO_EAR; flat.len()];
        Self { topology, around, flat, worth }
    }

    /// Cuts off the best corner while there is one; returns what is left.
    fn clip(mut self, mesh: &mut Mesh) -> Vec<VertexId> {
        self.weigh_all();
        while self.around.len() > 2 {
            if self.best().1 < 0.0 {
                // Corners that were in the way may be gone by now.
                self.weigh_all();
            }
            let (i, worth) = self.best();
            if worth < 0.0 {
                break;
            }
            let n = self.around.len();
            mesh.triangles.push([
                self.around[(i + n - 1) % n],
                self.around[i],
                self.around[(i + 1) % n],
            ]);
            self.around.remove(i);
            self.flat.remove(i);
            self.worth.remove(i);
            let n = n - 1;
            for corner in [(i + n - 1) % n, i % n] {
                self.worth[corner] = self.weigh(corner);
            }
        }
        self.around
    }

    fn best(&self) -> (usize, f64) {
        let all = self.worth.iter().copied().enumerate();
        all.fold((0, NO_EAR), |best, now| if now.1 > best.1 { now } else { best })
    }

    fn weigh_all(&mut self) {
        self.worth = (0..self.flat.len()).map(|i| self.weigh(i)).collect();
    }

    /// Whether the surface has an edge between two corners already. With a second one
    /// what lies between the two could not be flattened without folds.
    fn joined(&self, a: VertexId, b: VertexId) -> bool {
        let leads = |a, b| self.topology.outgoing(a).any(|h| self.topology.to(h) == b);
        leads(a, b) || leads(b, a)
    }

    /// Least angle of the triangle at a corner, if it turns left, holds no other corner
    /// and can be cut off by a new edge.
    fn weigh(&self, i: usize) -> f64 {
        let n = self.flat.len();
        let (before, after) = ((i + n - 1) % n, (i + 1) % n);
        let [a, b, c] = [before, i, after].map(|k| self.flat[k]);
        let left = |p: Point2<f64>, q: Point2<f64>, r: Point2<f64>| (q - p).perp(&(r - p));
        // Also where the area is undefined.
        if left(a, b, c).is_nan() || left(a, b, c) <= 0.0 {
            return NO_EAR;
        }
        let inside =
            |p: Point2<f64>| left(a, b, p) >= 0.0 && left(b, c, p) >= 0.0 && left(c, a, p) >= 0.0;
        let blocked = (0..n).any(|k| k != before && k != i && k != after && inside(self.flat[k]));
        if blocked || (n > 3 && self.joined(self.around[before], self.around[after])) {
            return NO_EAR;
        }
        let angle = |p: Point2<f64>, q: Point2<f64>, r: Point2<f64>| (q - p).angle(&(r - p));
        angle(a, b, c).min(angle(b, c, a)).min(angle(c, a, b))
    }
}
