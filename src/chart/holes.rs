//! The holes of a chart in the plane, as the triangles that fill them.

use crate::ids::{Id, VertexId};
use crate::surface::bvh::{Aabb, Bvh};
use crate::surface::locate::{blend, closest_on_triangle, segments_cross};
use nalgebra::{Point2, distance};

/// The triangles that fill the holes, to be kept clear of.
#[derive(Clone, Debug)]
pub struct Holes {
    triangles: Vec<[Point2<f64>; 3]>,
    tree: Bvh<2>,
}

impl Holes {
    /// Of triangles whose corners are indices into `flat`. They may face either way.
    pub fn new(flat: &[Point2<f64>], triangles: &[[VertexId; 3]]) -> Self {
        let triangles: Vec<_> = triangles.iter().map(|t| t.map(|v| flat[v.index()])).collect();
        let boxes: Vec<_> = triangles.iter().map(|t| Aabb::around(t)).collect();
        Self { triangles, tree: Bvh::new(&boxes) }
    }

    /// Whether any is within `reach` of the segment from `a` to `b`.
    pub fn meet(&self, a: Point2<f64>, b: Point2<f64>, reach: f64) -> bool {
        let near = Aabb::around(&[a, b]).grown(reach.max(0.0));
        let mut met = false;
        self.tree.visit(
            |bounds| bounds.overlaps(&near),
            |i| met = met || touches(&self.triangles[i], a, b, reach.max(0.0)),
        );
        met
    }
}

/// Whether a triangle and a segment come within `reach`, both with their borders.
fn touches(triangle: &[Point2<f64>; 3], a: Point2<f64>, b: Point2<f64>, reach: f64) -> bool {
    // Either one holds the other's end, or they cross at a side, or an end or corner is
    // nearest to the other.
    let of_triangle = |p: &Point2<f64>| distance(p, &nearest_of(triangle, p));
    let of_segment = |p: &Point2<f64>| distance(p, &nearest_of(&[a, b, b], p));
    inside(triangle, a)
        || (0..3).any(|k| segments_cross([triangle[k], triangle[(k + 1) % 3]], [a, b]))
        || [a, b].iter().any(|p| of_triangle(p) <= reach)
        || triangle.iter().any(|p| of_segment(p) <= reach)
}

/// Whether a point lies in a triangle of either sense, by signs alone: distances of
/// points inside are nought but for rounding. A triangle without area has no inside.
fn inside(triangle: &[Point2<f64>; 3], p: Point2<f64>) -> bool {
    let side = |k: usize| {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        (b - a).perp(&(p - a))
    };
    let sides = [side(0), side(1), side(2)];
    // On the line of a triangle that is one all are nought, also far from it.
    let within = sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
    within && sides.iter().any(|&s| s != 0.0)
}

fn nearest_of(triangle: &[Point2<f64>; 3], p: &Point2<f64>) -> Point2<f64> {
    blend(triangle, closest_on_triangle(p, triangle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point2<f64>> {
        (-9_i32..9, -9_i32..9).prop_map(|(x, y)| Point2::new(x.into(), y.into()))
    }

    proptest! {
        /// Against the least distance between many points of the segment and the
        /// triangle, which is too large by half a step at most.
        #[test]
        fn a_strip_meets_what_is_within_its_width(
            t in [point(), point(), point()],
            a in point(),
            b in point(),
            reach in 0.0..5.0_f64,
        ) {
            let flat = t.to_vec();
            let holes = Holes::new(&flat, &[[0, 1, 2].map(VertexId::new)]);
            let steps = 2000;
            let least = (0..=steps)
                .map(|i| a + (b - a) * (f64::from(i) / f64::from(steps)))
                .map(|p| distance(&p, &nearest_of(&t, &p)))
                .fold(f64::INFINITY, f64::min);
            let slack = distance(&a, &b) / f64::from(steps);
            if least <= reach {
                prop_assert!(holes.meet(a, b, reach), "{least}");
            } else if least > reach + slack {
                prop_assert!(!holes.meet(a, b, reach), "{least}");
            }
        }
    }
}
