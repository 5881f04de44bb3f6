//! What relaxing makes small (paper, section 5.1), as a sum of squares:
//!
//! Σ (cos θ − cos θ⁰)² + 1.5 Σ ((|Pi − Pj| − l) / l̄)² + fidelity to the surface.
//!
//! The paper keeps one edge fixed so that nothing floats. On a dome that edge would keep
//! its own length, and the rest would come to lie askew round it. Here every centre is held
//! at its first place instead, by next to nothing.

use super::graph::{Corner, Graph, Link};
use crate::surface::locate::Locator;
use crate::surface::{Mesh, Point3, Vector3};

/// Weight of lengths, against 1 for angles, as in the paper.
const LENGTHS: f64 = 1.5;

/// Weight of the squared distances from the surface, in links. The paper gives none.
/// Smaller, and links take short cuts through the surface that are lost when centres come
/// back to it; larger, and on coarse meshes steps end at every edge.
const FIDELITY: f64 = 5.0;

/// Weight of the squared distances from the first places, in links. Larger, and it stiffens
/// surfaces some hundred units across; smaller, and centres drift along a vault by rounding.
const ANCHOR: f64 = 1e-6;

/// Distances from the surface below this part of a link have no direction but that of
/// rounding; the normal of the triangle takes its place.
const ON_SURFACE: f64 = 1e-9;

/// The sum, as a function of the centres of the units.
pub struct Energy<'a> {
    /// The units as they lie in the plane.
    pub graph: &'a Graph,
    /// The surface, and its triangles to look places up.
    pub mesh: &'a Mesh,
    pub locator: &'a Locator,
    /// The first places of the centres.
    pub start: &'a [Point3],
    /// What a link one tile edge long in the plane is to have on the surface, mm.
    pub unit: f64,
    /// Mean length of all links, mm.
    pub mean: f64,
}

/// A summand: the square of `error`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Term {
    /// Its root.
    pub error: f64,
    /// The nodes on which it depends.
    pub nodes: [usize; 3],
    /// How many of them there are.
    pub count: usize,
    /// Derivative of the error by the place of each node, in mean links.
    pub rows: [Vector3; 3],
}

impl Energy<'_> {
    /// The sum.
    pub fn value(&self, centers: &[Point3]) -> f64 {
        self.terms(centers).map(|term| term.error * term.error).sum()
    }

    /// All summands; their nodes and their order are always the same.
    pub fn terms<'a>(&'a self, centers: &'a [Point3]) -> impl Iterator<Item = Term> + 'a {
        let corners = self.graph.corners.iter().map(|corner| self.angle(corner, centers));
        let links = self.graph.links.iter().map(|link| self.length(link, centers));
        let nodes = 0..centers.len();
        corners.chain(links).chain(nodes.clone().map(|i| self.distance(i, centers[i]))).chain(
            nodes.flat_map(|i| {
                let away = (centers[i] - self.start[i]) * (ANCHOR.sqrt() / self.mean);
                (0..3).map(move |k| single(i, away[k], Vector3::ith(k, ANCHOR.sqrt())))
            }),
        )
    }

    /// cos θ − cos θ⁰.
    fn angle(&self, &Corner { at, ends: [i, j], angle }: &Corner, centers: &[Point3]) -> Term {
        let (a, b) = (centers[i] - centers[at], centers[j] - centers[at]);
        let (long_a, long_b) = (a.norm(), b.norm());
        let (a, b) = (a / long_a, b / long_b);
        let cosine = a.dot(&b);
        let by_i = (b - a * cosine) * (self.mean / long_a);
        let by_j = (a - b * cosine) * (self.mean / long_b);
        let error = cosine - angle.cos();
        Term { error, nodes: [at, i, j], count: 3, rows: [-by_i - by_j, by_i, by_j] }
    }

    /// (|Pi − Pj| − l) / l̄.
    fn length(&self, link: &Link, centers: &[Point3]) -> Term {
        let [i, j] = link.ends;
        let way = centers[j] - centers[i];
        let (length, weight) = (way.norm(), LENGTHS.sqrt());
        let error = (length - link.length * self.unit) / self.mean * weight;
        let row = way * (weight / length);
        Term { error, nodes: [i, j, j], count: 2, rows: [-row, row, Vector3::zeros()] }
    }

    /// The distance from the surface. Its direction is that from the nearest place, so that
    /// it is across the surface inside, and towards the border beyond.
    fn distance(&self, i: usize, center: Point3) -> Term {
        let at = self.locator.closest(center);
        let away = center - at.point;
        let across = if at.distance > ON_SURFACE * self.mean {
            away / at.distance
        } else {
            let area = self.mesh.area_vector(at.face);
            area.try_normalize(0.0).unwrap_or_else(Vector3::z)
        };
        let weight = FIDELITY.sqrt();
        single(i, away.dot(&across) / self.mean * weight, across * weight)
    }
}

fn single(i: usize, error: f64, row: Vector3) -> Term {
    let zero = Vector3::zeros();
    Term { error, nodes: [i; 3], count: 1, rows: [row, zero, zero] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::samples::sample;
    use std::f64::consts::FRAC_PI_2;

    /// Derivatives against differences, term by term, off the surface and beyond its rim.
    #[test]
    fn rows_are_derivatives() {
        let mesh = sample("igloo").expect("a sample");
        let locator = Locator::new(&mesh);
        let centers: Vec<Point3> = [
            [10.0, 4.0, 230.0],
            [71.0, -9.0, 204.0],
            [13.0, 68.0, 208.0],
            [-40.0, -30.0, 214.0],
            [330.0, 20.0, -25.0],
        ]
        .map(Point3::from)
        .to_vec();
        let link = |ends| Link { ends, length: 1.2 };
        let corner = |at, ends| Corner { at, ends, angle: FRAC_PI_2 };
        let graph = Graph {
            links: vec![link([0, 1]), link([0, 2]), link([3, 0]), link([1, 4])],
            corners: vec![corner(0, [1, 2]), corner(0, [2, 3]), corner(1, [4, 0])],
        };
        let start: Vec<Point3> = centers.iter().map(|p| p + Vector3::new(3.0, 1.0, 2.0)).collect();
        let (unit, mean) = (50.0, 60.0);
        let energy =
            Energy { graph: &graph, mesh: &mesh, locator: &locator, start: &start, unit, mean };
        let step = 1e-5;
        for (t, term) in energy.terms(&centers).enumerate() {
            for node in 0..centers.len() {
                let at = (0..term.count).find(|&k| term.nodes[k] == node);
                for k in 0..3 {
                    let error = |sign: f64| {
                        let mut moved = centers.clone();
                        moved[node][k] += sign * step * mean;
                        energy.terms(&moved).nth(t).expect("as many terms").error
                    };
                    let difference = (error(1.0) - error(-1.0)) / (2.0 * step);
                    let row = at.map_or(0.0, |at| term.rows[at][k]);
                    assert!((difference - row).abs() < 1e-6, "{t} {node}: {difference} {row}");
                }
            }
        }
    }

    /// Beyond the rim a centre is drawn back to it, not along the tangent plane.
    #[test]
    fn the_rim_holds_centres_back() {
        let mesh = sample("flat").expect("a sample");
        let locator = Locator::new(&mesh);
        let centers = [Point3::new(310.0, 5.0, 0.0)];
        let graph = Graph::default();
        let (unit, mean) = (1.0, 10.0);
        let energy =
            Energy { graph: &graph, mesh: &mesh, locator: &locator, start: &centers, unit, mean };
        let term = energy.distance(0, centers[0]);
        assert!((term.error - FIDELITY.sqrt()).abs() < 1e-9, "{term:?}");
        assert!((term.rows[0].x - FIDELITY.sqrt()).abs() < 1e-9);
    }
}
