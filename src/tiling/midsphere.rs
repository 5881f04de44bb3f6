//! The canonical form of a polyhedron: every edge touches the unit sphere.
//!
//! Then every face has a circle inscribed that touches all its edges, each edge where
//! its neighbour's circle does. So rods through these points, all turned alike from the
//! way to the centres, keep the same distance from the centre of a face: every unit is
//! as regular as its sphere allows (G. Hart, *Canonical Polyhedra*, 1997).
//!
//! The form exists, and but for maps of the sphere onto itself only once, for every
//! polyhedron that Conway's operators make (Koebe, Andreev, Thurston). It is found in
//! two steps: Hart's relaxation comes near; Gauss-Newton on vertices v and face planes
//! w (w · v = 1) makes it exact: w · v = 1 where a vertex lies in a face, and
//! |a × b|² = |a − b|² for the ends of an edge. These are 3 E equations for 3 E + 6
//! unknowns; each step is the least one, so symmetry stays and nothing drifts.

use super::Net;
use super::polyhedron::Polyhedron;
use crate::linalg::{LinalgError, SpdSolver, block_entries};
use crate::surface::Vector3;
use nalgebra::Vector6;

/// A polyhedron whose edges touch the unit sphere.
#[derive(Clone, Debug)]
pub struct Midscribed {
    /// Vertices, outside the sphere.
    pub vertices: Vec<Vector3>,
    /// Which face borders on which.
    pub net: Net,
}

/// The polyhedron could not be made to touch its sphere.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum MidsphereError {
    /// The steps did not settle.
    #[error(
        "the polyhedron could not be made round: after {steps} steps its edges miss the sphere \
         by {error:.1e} of its radius"
    )]
    NoConvergence { steps: usize, error: f64 },
    /// A step has no solution.
    #[error("the polyhedron could not be made round: {0}")]
    Linear(#[from] LinalgError),
}

/// Relaxation steps before Newton's: enough to come within its reach for polyhedra of
/// some thousand faces; each costs little.
const RELAXATIONS: usize = 60;

/// Largest error of an equation at which the form is exact: lengths then agree to a
/// nanometre on a sphere of a kilometre.
const EXACT: f64 = 1e-12;

/// Newton steps before giving up; four to seven are usual.
const MAX_STEPS: usize = 40;

/// Weight of a step's own length against the equations (squared). It makes the system
/// definite; larger, and the last digits come slowly.
const DAMPING: f64 = 1e-9;

/// Brings a polyhedron into its canonical form.
///
/// # Errors
/// [`MidsphereError`] when the steps do not settle.
pub fn midsphere(p: &Polyhedron) -> Result<Midscribed, MidsphereError> {
    let net = p.net();
    let mut vertices = p.vertices.clone();
    for _ in 0..RELAXATIONS {
        relax(&mut vertices, &net);
    }
    let mut newton = Newton::new(&net, vertices)?;
    let mut error = newton.error();
    for _ in 0..MAX_STEPS {
        if error < EXACT {
            break;
        }
        let next = newton.step(error)?;
        // The last steps move within rounding.
        if next >= error {
            break;
        }
        error = next;
    }
    if error.is_nan() || error > GOOD {
        return Err(MidsphereError::NoConvergence { steps: MAX_STEPS, error });
    }
    Ok(Midscribed { vertices: newton.vertices().collect(), net })
}

/// Largest error left where rounding keeps the form from [`EXACT`].
const GOOD: f64 = 1e-9;

/// The point of the line through `a` and `b` nearest to the origin.
pub fn nearest_to_origin(a: &Vector3, b: &Vector3) -> Vector3 {
    let d = b - a;
    a - d * (a.dot(&d) / d.norm_squared())
}

/// How far a relaxation step goes towards flat faces; more, and it overshoots.
const FLATTENING: f64 = 0.3;

/// One step of Hart's relaxation: edges move towards touching the sphere, faces towards
/// being flat, the whole back to the middle.
fn relax(vertices: &mut [Vector3], net: &Net) {
    let mut moves = vec![Vector3::zeros(); vertices.len()];
    let mut middle = Vector3::zeros();
    for edge in &net.edges {
        let [a, b] = edge.ends;
        let touch = nearest_to_origin(&vertices[a], &vertices[b]);
        middle += touch / net.edges.len() as f64;
        let push = touch * ((1.0 - touch.norm()) / 4.0);
        moves[a] += push;
        moves[b] += push;
    }
    for (v, m) in vertices.iter_mut().zip(&moves) {
        *v += m - middle;
    }
    let mut moves = vec![Vector3::zeros(); vertices.len()];
    for tile in &net.tiles {
        let (normal, middle) = plane(vertices, &tile.corners);
        for &v in &tile.corners {
            moves[v] += normal * (FLATTENING * normal.dot(&(middle - vertices[v])));
        }
    }
    for (v, m) in vertices.iter_mut().zip(&moves) {
        *v += m;
    }
}

/// Unit normal (Newell) and middle of a polygon.
fn plane(vertices: &[Vector3], corners: &[usize]) -> (Vector3, Vector3) {
    let n = corners.len();
    let middle = corners.iter().map(|&v| vertices[v]).sum::<Vector3>() / n as f64;
    let at = |i: usize| vertices[corners[i % n]] - middle;
    ((0..n).map(|i| at(i).cross(&at(i + 1))).sum::<Vector3>().normalize(), middle)
}

impl Midscribed {
    /// The axis of a face: unit vector to the middle of its inscribed circle.
    pub fn axes(&self) -> impl Iterator<Item = Vector3> + '_ {
        self.net.tiles.iter().map(|t| plane(&self.vertices, &t.corners).0)
    }

    /// Enlarges what is on top by the factor `k` and shrinks what is below by it, over a
    /// smooth passage between: tan(ψ′/2) = k tan(ψ/2) for the angle ψ from the top. It is
    /// a projective map that keeps the sphere, so edges still touch it and angles stay.
    pub fn warp(&mut self, k: f64) {
        let beta = (1.0 - k * k) / (1.0 + k * k);
        let gamma = 1.0 / (1.0 - beta * beta).sqrt();
        for v in &mut self.vertices {
            let w = gamma * (1.0 + beta * v.z);
            *v = Vector3::new(v.x, v.y, gamma * (v.z + beta)) / w;
        }
    }
}

/// The equations and their solution so far.
struct Newton<'a> {
    net: &'a Net,
    /// Vertices, then face planes.
    x: Vec<Vector3>,
    vertex_count: usize,
    solver: SpdSolver,
}

/// One equation: its two blocks of unknowns, gradient and value.
struct Equation {
    blocks: [usize; 2],
    gradient: Vector6<f64>,
    value: f64,
}

impl<'a> Newton<'a> {
    fn new(net: &'a Net, vertices: Vec<Vector3>) -> Result<Self, LinalgError> {
        let vertex_count = vertices.len();
        let planes: Vec<Vector3> = net
            .tiles
            .iter()
            .map(|t| {
                let (normal, middle) = plane(&vertices, &t.corners);
                normal / normal.dot(&middle)
            })
            .collect();
        let x: Vec<Vector3> = vertices.into_iter().chain(planes).collect();
        let size = 3 * x.len();
        let mut entries: Vec<(usize, usize)> = (0..size).map(|i| (i, i)).collect();
        for equation in equations(net, vertex_count, &x) {
            entries.extend(block_entries(6).map(|(i, j)| (equation.row(i), equation.row(j))));
        }
        let solver = SpdSolver::new(size, &entries)?;
        Ok(Self { net, x, vertex_count, solver })
    }

    fn vertices(&self) -> impl Iterator<Item = Vector3> + '_ {
        self.x[..self.vertex_count].iter().copied()
    }

    fn error(&self) -> f64 {
        self.equations().map(|e| e.value.abs()).fold(0.0, f64::max)
    }

    fn equations(&self) -> impl Iterator<Item = Equation> + '_ {
        equations(self.net, self.vertex_count, &self.x)
    }

    /// One step, shortened until the error falls; gives the new error.
    fn step(&mut self, error: f64) -> Result<f64, LinalgError> {
        let size = 3 * self.x.len();
        let mut values = vec![DAMPING; size];
        let mut rhs = vec![0.0; size];
        for equation in self.equations() {
            let g = equation.gradient;
            values.extend(block_entries(6).map(|(i, j)| g[i] * g[j]));
            for i in 0..6 {
                rhs[equation.row(i)] -= g[i] * equation.value;
            }
        }
        self.solver.factor(&values)?;
        self.solver.solve(&mut rhs);
        let start = self.x.clone();
        let mut part = 1.0;
        loop {
            for (i, x) in self.x.iter_mut().enumerate() {
                let step = Vector3::new(rhs[3 * i], rhs[3 * i + 1], rhs[3 * i + 2]);
                *x = start[i] + step * part;
            }
            let now = self.error();
            if now < error || part < SHORTEST {
                return Ok(now);
            }
            part /= 2.0;
        }
    }
}

/// All equations: a corner lies in its face; an edge touches the sphere.
fn equations<'a>(
    net: &'a Net,
    vertex_count: usize,
    x: &'a [Vector3],
) -> impl Iterator<Item = Equation> + 'a {
    let corners = net.tiles.iter().enumerate().flat_map(move |(f, tile)| {
        tile.corners.iter().map(move |&v| {
            let w = vertex_count + f;
            let (p, q) = (x[v], x[w]);
            Equation { blocks: [v, w], gradient: stacked(q, p), value: p.dot(&q) - 1.0 }
        })
    });
    let edges = net.edges.iter().map(move |edge| {
        let [a, b] = edge.ends.map(|v| x[v]);
        let (cross, d) = (a.cross(&b), b - a);
        // Squared distance of the line from the origin. Divided by the edge's length,
        // so that edges cannot meet the equation by vanishing.
        let squared = d.norm_squared();
        let touch = cross.norm_squared() / squared;
        // ∂|a × b|² / ∂a = 2 b × (a × b), and the same about b turned round.
        let by_a = (b.cross(&cross) + d * touch) * (2.0 / squared);
        let by_b = (cross.cross(&a) - d * touch) * (2.0 / squared);
        let value = touch - 1.0;
        Equation { blocks: edge.ends, gradient: stacked(by_a, by_b), value }
    });
    corners.chain(edges)
}

/// Steps are shortened down to this part before they count as failed.
const SHORTEST: f64 = 1.0 / 1024.0;

impl Equation {
    fn row(&self, i: usize) -> usize {
        3 * self.blocks[i / 3] + i % 3
    }
}

fn stacked(a: Vector3, b: Vector3) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tiling::conway::Notation;

    fn form(notation: &str) -> Midscribed {
        let notation: Notation = notation.parse().expect("a notation");
        midsphere(&notation.polyhedron()).unwrap_or_else(|e| panic!("{notation}: {e}"))
    }

    fn worst(m: &Midscribed) -> [f64; 2] {
        let mut worst = [0.0f64; 2];
        for edge in &m.net.edges {
            let [a, b] = edge.ends.map(|v| m.vertices[v]);
            worst[0] = worst[0].max((nearest_to_origin(&a, &b).norm() - 1.0).abs());
        }
        for tile in &m.net.tiles {
            let (normal, middle) = plane(&m.vertices, &tile.corners);
            for &v in &tile.corners {
                worst[1] = worst[1].max(normal.dot(&(m.vertices[v] - middle)).abs());
            }
        }
        worst
    }

    #[test]
    fn edges_touch_the_sphere_and_faces_are_flat() {
        for notation in [
            "T", "O", "C", "D", "I", "aI", "kD", "tO", "eD", "sC", "gT", "dkgD", "I/4", "aI/3",
            "tdC/3", "gkI",
        ] {
            let [touch, flat] = worst(&form(notation));
            assert!(touch < 1e-10 && flat < 1e-10, "{notation}: {touch:e} {flat:e}");
        }
    }

    #[test]
    fn symmetric_polyhedra_stay_about_the_middle() {
        for notation in ["eD", "sI", "aI/3"] {
            let m = form(notation);
            let middle: Vector3 = m.vertices.iter().sum::<Vector3>() / m.vertices.len() as f64;
            assert!(middle.norm() < 1e-9, "{notation}: {middle}");
        }
    }

    /// A face's inscribed circle touches its edges where they touch the sphere.
    #[test]
    fn touching_points_of_a_face_lie_on_a_circle_about_its_axis() {
        let m = form("dkI/2");
        for (tile, axis) in m.net.tiles.iter().zip(m.axes()) {
            let heights: Vec<f64> = tile
                .edges
                .iter()
                .map(|&e| {
                    let [a, b] = m.net.edges[e].ends.map(|v| m.vertices[v]);
                    nearest_to_origin(&a, &b).dot(&axis)
                })
                .collect();
            assert!(heights.iter().all(|h| (h - heights[0]).abs() < 1e-9), "{heights:?}");
        }
    }

    #[test]
    fn a_warp_keeps_the_form_and_moves_latitudes_by_its_rule() {
        let mut m = form("aI/2");
        let before = m.vertices.clone();
        m.warp(1.5);
        let [touch, flat] = worst(&m);
        assert!(touch < 1e-9 && flat < 1e-9, "{touch:e} {flat:e}");
        for k in [1.0 / 1.5, 1.0] {
            m.warp(k);
        }
        for (v, old) in m.vertices.iter().zip(&before) {
            assert!((v - old).norm() < 1e-9);
        }
        // A point of the sphere, as a polyhedron of one vertex.
        let at = |psi: f64| Vector3::new(psi.sin(), 0.0, psi.cos());
        let mut point = Midscribed { vertices: vec![at(0.8)], net: Net::default() };
        point.warp(1.5);
        let wanted = at(2.0 * (1.5 * 0.4f64.tan()).atan());
        assert!((point.vertices[0] - wanted).norm() < 1e-12);
    }
}
