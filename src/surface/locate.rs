//! Where a point lies on a surface: the nearest triangle, what a ray meets, and the
//! triangle of a flat mesh that holds a point of the plane.
//!
//! Nearest point of a triangle by regions, after Ericson, Real-Time Collision
//! Detection (2005), 5.1.5; it needs dot products only, so it serves space and plane
//! alike. Rays after Möller and Trumbore (1997). Each query takes about log n steps
//! through a tree of boxes. Of several triangles at the same distance the first wins,
//! so answers do not depend on the tree.

use crate::ids::{FaceId, Id, VertexId};
use crate::surface::bvh::{Aabb, Bvh};
use crate::surface::{Mesh, Point3, Vector3};
use nalgebra::{Point, Point2};

/// A place on a surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Located {
    /// The triangle.
    pub face: FaceId,
    /// Weights of its three corners; they add up to 1, none is negative.
    pub barycentric: [f64; 3],
    /// The place itself, mm.
    pub point: Point3,
    /// Distance from the point that was asked for, mm.
    pub distance: f64,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    /// The triangle.
    pub face: FaceId,
    /// Weights of its three corners; they add up to 1.
    pub barycentric: [f64; 3],
    /// Where they meet, mm.
    pub point: Point3,
    /// How far along the ray, in lengths of its direction vector.
    pub along: f64,
}

/// How far outside a triangle, in barycentric weight, a point or ray still counts as
/// on it. Smaller, and queries on a shared edge fall between two triangles by
/// rounding; larger, and they are taken by a triangle that they miss.
const EDGE_SLACK: f64 = 1e-10;

/// Nearest points and rays on a mesh, many times. Keeps its own copy of the corners.
#[derive(Clone, Debug)]
pub struct Locator {
    corners: Vec<[Point3; 3]>,
    tree: Bvh<3>,
}

impl Locator {
    /// Builds the tree.
    ///
    /// # Panics
    /// On a mesh without triangles; readers refuse those.
    pub fn new(mesh: &Mesh) -> Self {
        let corners: Vec<_> = mesh.triangles.ids().map(|f| mesh.corners(f)).collect();
        assert!(!corners.is_empty(), "a surface has at least one triangle: readers refuse others");
        let boxes: Vec<_> = corners.iter().map(|c| Aabb::around(c)).collect();
        Self { corners, tree: Bvh::new(&boxes) }
    }

    /// The place of the surface nearest to a finite point.
    pub fn closest(&self, point: Point3) -> Located {
        let on = |face: usize| {
            let weights = closest_on_triangle(&point, &self.corners[face]);
            (weights, blend(&self.corners[face], weights))
        };
        let distance_squared = |face| (on(face).1 - point).norm_squared();
        let found = self.tree.least(|b| b.distance_squared(&point), distance_squared);
        // Only points that are not finite are at no finite distance from any triangle.
        let face = found.map_or(0, |(face, _)| face);
        let (barycentric, at) = on(face);
        let distance = (at - point).norm();
        Located { face: FaceId::new(face), barycentric, point: at, distance }
    }

    /// The first place where a ray meets the surface, from either side. The start
    /// itself counts.
    pub fn ray(&self, origin: Point3, direction: Vector3) -> Option<Hit> {
        let inverse = direction.map(|d| 1.0 / d);
        let meet = |face: usize| ray_triangle(origin, direction, &self.corners[face]);
        let (face, along) = self.tree.least(
            |b| b.ray_entry(&origin, &inverse).unwrap_or(f64::INFINITY),
            |face| meet(face).map_or(f64::INFINITY, |(along, _)| along),
        )?;
        let (_, barycentric) = meet(face)?;
        let point = blend(&self.corners[face], barycentric);
        Some(Hit { face: FaceId::new(face), barycentric, point, along })
    }
}

/// The place of a surface nearest to a point, asked once.
///
/// # Panics
/// On a mesh without triangles.
pub fn closest(mesh: &Mesh, point: Point3) -> Located {
    Locator::new(mesh).closest(point)
}

/// A place in a flat mesh.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlaneLocated {
    /// The triangle.
    pub face: FaceId,
    /// Weights of its three corners; they add up to 1, none is negative.
    pub barycentric: [f64; 3],
}

/// Finds the triangles of a flat mesh that hold points of the plane. Triangles may
/// face either way; where they overlap, the one that holds the point deepest wins.
#[derive(Clone, Debug)]
pub struct PlanarLocator {
    corners: Vec<[Point2<f64>; 3]>,
    tree: Bvh<2>,
}

impl PlanarLocator {
    /// Builds the tree. Every corner must be an index into `positions`.
    pub fn new(positions: &[Point2<f64>], triangles: &[[VertexId; 3]]) -> Self {
        let corners: Vec<_> = triangles.iter().map(|t| t.map(|v| positions[v.index()])).collect();
        // Grown so that the slack in weights never falls outside a box.
        let boxed = |c: &[Point2<f64>; 3]| {
            let tight = Aabb::around(c);
            tight.grown(2.0 * EDGE_SLACK * (tight.hi - tight.lo).norm())
        };
        let boxes: Vec<_> = corners.iter().map(boxed).collect();
        Self { tree: Bvh::new(&boxes), corners }
    }

    /// The triangle that holds a point; `None` outside. On a shared edge, the first.
    pub fn locate(&self, point: Point2<f64>) -> Option<PlaneLocated> {
        let mut best: Option<(f64, usize, [f64; 3])> = None;
        self.tree.visit(
            |b| b.contains(&point),
            |face| {
                let Some(w) = planar_weights(&point, &self.corners[face]) else { return };
                // Depth 0 stands for anything within the slack of an edge.
                let depth = w.into_iter().fold(f64::INFINITY, f64::min);
                let depth = if depth.abs() <= EDGE_SLACK { 0.0 } else { depth };
                let better = |&(d, f, _): &(f64, usize, _)| depth > d || (depth == d && face < f);
                if depth >= 0.0 && best.as_ref().is_none_or(better) {
                    best = Some((depth, face, w));
                }
            },
        );
        let (_, face, weights) = best?;
        Some(PlaneLocated { face: FaceId::new(face), barycentric: clamped(weights) })
    }

    /// The place of the flat mesh nearest to a finite point, inside or outside;
    /// `None` for a mesh without triangles.
    pub fn closest(&self, point: Point2<f64>) -> Option<PlaneLocated> {
        if let Some(inside) = self.locate(point) {
            return Some(inside);
        }
        let weights = |face: usize| closest_on_triangle(&point, &self.corners[face]);
        let (face, _) = self.tree.least(
            |b| b.distance_squared(&point),
            |face| (blend(&self.corners[face], weights(face)) - point).norm_squared(),
        )?;
        Some(PlaneLocated { face: FaceId::new(face), barycentric: weights(face) })
    }
}

/// Whether two segments of the plane, a-b and c-d, cross in the inside of both. Touching
/// is no crossing.
pub fn segments_cross([a, b]: [Point2<f64>; 2], [c, d]: [Point2<f64>; 2]) -> bool {
    let side = |p: Point2<f64>, q: Point2<f64>, r: Point2<f64>| (q - p).perp(&(r - p));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// The point with the given weights of three corners.
pub fn blend<const D: usize>(corners: &[Point<f64, D>; 3], weights: [f64; 3]) -> Point<f64, D> {
    let [a, b, c] = corners;
    (a.coords * weights[0] + b.coords * weights[1] + c.coords * weights[2]).into()
}

/// Weights of the place of a triangle nearest to a point; none negative, sum 1.
/// Needle and point triangles are treated as their sides.
pub fn closest_on_triangle<const D: usize>(
    p: &Point<f64, D>,
    corners: &[Point<f64, D>; 3],
) -> [f64; 3] {
    let weights = closest_by_region(p, corners);
    // Without area the quotients are 0 / 0, or lost in rounding.
    if weights.iter().all(|w| (0.0..=1.0).contains(w)) {
        weights
    } else {
        closest_on_sides(p, corners)
    }
}

/// Ericson 5.1.5: which corner, side or inside is nearest follows from signs of dot
/// products.
fn closest_by_region<const D: usize>(
    p: &Point<f64, D>,
    [a, b, c]: &[Point<f64, D>; 3],
) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    let (ap, bp, cp) = (p - a, p - b, p - c);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    // Twice the signed areas towards the sides ab, ca, bc.
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return [1.0 - t, t, 0.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let (v, w) = (vb / (va + vb + vc), vc / (va + vb + vc));
    [1.0 - v - w, v, w]
}

/// The nearest place of the three sides; where rounding leaves no inside.
fn closest_on_sides<const D: usize>(p: &Point<f64, D>, corners: &[Point<f64, D>; 3]) -> [f64; 3] {
    let mut best = ([1.0, 0.0, 0.0], f64::INFINITY);
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let side = corners[j] - corners[i];
        let length_squared = side.norm_squared();
        let along = (p - corners[i]).dot(&side) / length_squared;
        let t = if length_squared > 0.0 { along.clamp(0.0, 1.0) } else { 0.0 };
        let mut weights = [0.0; 3];
        (weights[i], weights[j]) = (1.0 - t, t);
        let distance = (blend(corners, weights) - p).norm_squared();
        if distance < best.1 {
            best = (weights, distance);
        }
    }
    best.0
}

/// Where a ray meets a triangle: how far along, and the weights.
fn ray_triangle(
    origin: Point3,
    direction: Vector3,
    [a, b, c]: &[Point3; 3],
) -> Option<(f64, [f64; 3])> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(&ac);
    let det = ab.dot(&p);
    // In the plane of the triangle, or no triangle: NaN and infinities end below too.
    if det == 0.0 {
        return None;
    }
    let from_a = origin - a;
    let q = from_a.cross(&ab);
    let (u, v) = (from_a.dot(&p) / det, direction.dot(&q) / det);
    let along = ac.dot(&q) / det;
    let inside = u >= -EDGE_SLACK && v >= -EDGE_SLACK && u + v <= 1.0 + EDGE_SLACK;
    (inside && along >= 0.0).then(|| (along, clamped([1.0 - u - v, u, v])))
}

/// Barycentric weights of a point of the plane; `None` for a triangle without area.
fn planar_weights(p: &Point2<f64>, [a, b, c]: &[Point2<f64>; 3]) -> Option<[f64; 3]> {
    let (pa, pb, pc) = (a - p, b - p, c - p);
    let area = (b - a).perp(&(c - a));
    let weights = [pb.perp(&pc) / area, pc.perp(&pa) / area, pa.perp(&pb) / area];
    weights.iter().all(|w| w.is_finite()).then_some(weights)
}

/// Weights with the slack taken off: none negative, sum 1.
fn clamped(weights: [f64; 3]) -> [f64; 3] {
    let w = weights.map(|w| w.max(0.0));
    let sum: f64 = w.iter().sum();
    w.map(|w| w / sum)
}

#[cfg(test)]
#[path = "locate_tests.rs"]
mod tests;
