//! ABF++: the angles of a flat mesh that are nearest to those of a curved one.
//!
//! Sheffer, Lévy, Mogilnitsky, Bogomyakov, *ABF++: Fast and Robust Angle Based
//! Flattening*, ACM TOG 24(2), 2005. Minimises Σ (α − β)² / β² over all triangle
//! angles α, with β the angles on the surface (scaled to 2π round inner vertices),
//! subject to: every triangle sums to π; the angles round every inner vertex sum
//! to 2π; round every inner vertex the edge lengths close.
//!
//! Every step solves the quadratic problem with linearised constraints. The
//! angles and the triangle constraints are eliminated triangle by triangle (the
//! paper's two Schur complements, here one 3 × 3 projection), which leaves two
//! unknowns an inner vertex and a positive definite matrix of fixed pattern.
//!
//! Where this leaves the paper: the length condition is taken in logarithms,
//! Σ log sin α₊ − log sin α₋ = 0, after Zayer, Lévy, Seidel 2007. It is the same
//! condition, but a sum over triangles, so that the matrix is a sum of 6 × 6 blocks.

use super::ChartError;
use crate::ids::{Id, VertexId};
use crate::linalg::{SpdSolver, block_entries};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};
use std::f64::consts::{PI, TAU};

/// Iterations before giving up. Gentle surfaces take 4, heads and animals 6 to 12.
const MAX_STEPS: usize = 60;

/// Largest change of an angle in the last step, radians. Larger and the layout
/// does not close to the precision of the mesh; smaller costs a step for nothing.
const STILL: f64 = 1e-9;

/// Largest remaining error of a constraint, radians (or logarithm of a length
/// ratio). The layout spreads what is left over all triangles.
const CLOSED: f64 = 1e-8;

/// A step goes at most this part of the way to an angle of zero or π, so that
/// angles stay between the two; nearer to 1 and slivers collapse to zero.
const KEEP_OFF: f64 = 0.9;

/// Least surface angle taken at its own size, radians: below, the weight 1 / β²
/// would swamp the sum. A higher floor spoils slivers.
const LEAST_ANGLE: f64 = 1e-5;

/// What the flattening found.
#[derive(Debug, Clone)]
pub struct Flattening {
    /// The planar angle at each corner of each triangle, radians.
    pub angles: Vec<[f64; 3]>,
    /// Steps taken.
    pub steps: usize,
    /// Largest error of a constraint left.
    pub residual: f64,
}

/// Planar angles for a triangle mesh of disk shape.
///
/// `surface` holds the angle at each corner of each triangle, radians;
/// `boundary` says of each vertex whether it lies on the rim.
///
/// # Errors
/// [`ChartError::NoConvergence`] when the constraints cannot be met, and
/// [`ChartError::Linear`] when a step has no solution.
pub fn flatten(
    triangles: &[[VertexId; 3]],
    surface: &[[f64; 3]],
    boundary: &[bool],
) -> Result<Flattening, ChartError> {
    AbfSolver::new(triangles, surface, boundary)?.run()
}

/// The working state of one flattening.
struct AbfSolver<'a> {
    triangles: &'a [[VertexId; 3]],
    /// Number of each inner vertex among the inner vertices.
    inner: Vec<Option<usize>>,
    inner_count: usize,
    target: Vec<[f64; 3]>,
    angles: Vec<[f64; 3]>,
    solver: SpdSolver,
    values: Vec<f64>,
}

/// One triangle, linearised: the six constraints at its corners (three sums,
/// three lengths) against its three angles.
struct Element {
    /// Constraint gradients, rows as in [`AbfSolver::rows`].
    b: Matrix6x3<f64>,
    /// The triangle's share of the constraint values.
    c: Vector6<f64>,
    /// Inverse weights, projected onto changes that keep the sum of the angles.
    p: Matrix3<f64>,
    /// The change of the angles if no vertex constrained them.
    free: Vector3<f64>,
}

impl<'a> AbfSolver<'a> {
    fn new(
        triangles: &'a [[VertexId; 3]],
        surface: &[[f64; 3]],
        boundary: &[bool],
    ) -> Result<Self, ChartError> {
        let mut inner_count = 0;
        let inner: Vec<Option<usize>> = boundary
            .iter()
            .map(|rim| {
                (!rim).then(|| {
                    inner_count += 1;
                    inner_count - 1
                })
            })
            .collect();
        let target = scaled_targets(triangles, surface, boundary);
        let mut entries = Vec::with_capacity(21 * triangles.len());
        for triangle in triangles {
            let rows = rows(triangle, &inner, inner_count);
            for (i, j) in block_entries(6) {
                if let (Some(i), Some(j)) = (rows[i], rows[j]) {
                    entries.push((i, j));
                }
            }
        }
        let solver = SpdSolver::new(2 * inner_count, &entries)?;
        let values = Vec::with_capacity(entries.len());
        let angles = target.clone();
        Ok(Self { triangles, inner, inner_count, target, angles, solver, values })
    }

    fn run(mut self) -> Result<Flattening, ChartError> {
        let mut residual = f64::INFINITY;
        for step in 1..=MAX_STEPS {
            let (change, before) = self.step()?;
            residual = before;
            if !change.is_finite() {
                break;
            }
            if change < STILL && residual < CLOSED {
                return Ok(Flattening { angles: self.angles, steps: step, residual });
            }
        }
        Err(ChartError::NoConvergence { steps: MAX_STEPS, residual })
    }

    /// One step; returns the largest change of an angle and the largest
    /// constraint error before it.
    fn step(&mut self) -> Result<(f64, f64), ChartError> {
        let elements: Vec<Element> = (0..self.triangles.len()).map(|t| self.element(t)).collect();
        let mut rhs = vec![0.0; 2 * self.inner_count];
        let mut errors = self.constant_terms();
        self.values.clear();
        for (triangle, e) in self.triangles.iter().zip(&elements) {
            let rows = rows(triangle, &self.inner, self.inner_count);
            let block: Matrix6<f64> = e.b * e.p * e.b.transpose();
            let load = e.b * e.free;
            for (k, row) in rows.iter().enumerate() {
                if let Some(row) = *row {
                    rhs[row] += load[k];
                    errors[row] += e.c[k];
                }
            }
            for (i, j) in block_entries(6) {
                if rows[i].is_some() && rows[j].is_some() {
                    self.values.push(block[(i, j)]);
                }
            }
        }
        let residual = errors.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        for (r, e) in rhs.iter_mut().zip(&errors) {
            *r += e;
        }
        if self.inner_count > 0 {
            self.solver.factor(&self.values)?;
            self.solver.solve(&mut rhs);
        }
        Ok((self.apply(&elements, &rhs), residual))
    }

    /// Moves the angles by the solution, as far as they stay angles.
    fn apply(&mut self, elements: &[Element], multipliers: &[f64]) -> f64 {
        let mut changes = Vec::with_capacity(elements.len());
        let mut part = 1.0f64;
        for ((triangle, e), angles) in self.triangles.iter().zip(elements).zip(&self.angles) {
            let rows = rows(triangle, &self.inner, self.inner_count);
            let mu = Vector6::from_fn(|k, _| rows[k].map_or(0.0, |row| multipliers[row]));
            let change = e.free - e.p * (e.b.transpose() * mu);
            for k in 0..3 {
                let room = if change[k] < 0.0 { angles[k] } else { PI - angles[k] };
                part = part.min(KEEP_OFF * room / change[k].abs());
            }
            changes.push(change);
        }
        let mut largest = 0.0f64;
        for (angles, change) in self.angles.iter_mut().zip(&changes) {
            for k in 0..3 {
                angles[k] += part * change[k];
                largest = if change[k].is_nan() { f64::NAN } else { largest.max(change[k].abs()) };
            }
        }
        largest
    }

    /// What the vertex constraints hold besides the sums over triangles: −2π a vertex.
    fn constant_terms(&self) -> Vec<f64> {
        let mut c = vec![0.0; 2 * self.inner_count];
        c[..self.inner_count].fill(-TAU);
        c
    }

    fn element(&self, t: usize) -> Element {
        let alpha = Vector3::from(self.angles[t]);
        let beta = Vector3::from(self.target[t]);
        let mut b = Matrix6x3::zeros();
        let mut c = Vector6::zeros();
        for j in 0..3 {
            let (next, last) = ((j + 1) % 3, (j + 2) % 3);
            b[(j, j)] = 1.0;
            c[j] = alpha[j];
            b[(3 + j, next)] = alpha[next].tan().recip();
            b[(3 + j, last)] = -alpha[last].tan().recip();
            c[3 + j] = alpha[next].sin().ln() - alpha[last].sin().ln();
        }
        let d = beta.component_mul(&beta);
        let sum = d.sum();
        let p = Matrix3::from_diagonal(&d) - d * d.transpose() / sum;
        let to_target = beta - alpha;
        let missing = PI - alpha.sum() - to_target.sum();
        Element { b, c, p, free: to_target + d * (missing / sum) }
    }
}

/// The unknowns that belong to a triangle's six constraints: angle sum at each
/// corner, then length at each corner; `None` at the rim.
fn rows(triangle: &[VertexId; 3], inner: &[Option<usize>], count: usize) -> [Option<usize>; 6] {
    let [a, b, c] = triangle.map(|v| inner[v.index()]);
    let length = |i: Option<usize>| i.map(|i| count + i);
    [a, b, c, length(a), length(b), length(c)]
}

/// Surface angles, scaled so that they sum to 2π round every inner vertex (paper, 2.1).
fn scaled_targets(
    triangles: &[[VertexId; 3]],
    surface: &[[f64; 3]],
    boundary: &[bool],
) -> Vec<[f64; 3]> {
    let mut sums = vec![0.0; boundary.len()];
    for (triangle, angles) in triangles.iter().zip(surface) {
        for k in 0..3 {
            sums[triangle[k].index()] += angles[k].max(LEAST_ANGLE);
        }
    }
    let scaled = |v: VertexId, angle: f64| {
        let angle = angle.max(LEAST_ANGLE);
        if boundary[v.index()] { angle } else { angle * TAU / sums[v.index()] }
    };
    triangles
        .iter()
        .zip(surface)
        .map(|(t, angles)| std::array::from_fn(|k| scaled(t[k], angles[k]).min(PI - LEAST_ANGLE)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of n triangles round one inner vertex, with corner angles made by
    /// the tip of a cone of total angle `total`.
    fn cone(n: usize, total: f64) -> (Vec<[VertexId; 3]>, Vec<[f64; 3]>, Vec<bool>) {
        let v = VertexId::new;
        let triangles = (0..n).map(|i| [v(0), v(1 + i), v(1 + (i + 1) % n)]).collect();
        let tip = total / n as f64;
        let angles = vec![[tip, (PI - tip) / 2.0, (PI - tip) / 2.0]; n];
        let boundary = (0..=n).map(|i| i > 0).collect();
        (triangles, angles, boundary)
    }

    #[test]
    fn a_cone_opens_to_equal_slices() {
        for (n, total) in [(5, 4.0), (6, 5.5), (8, 8.0)] {
            let (triangles, angles, boundary) = cone(n, total);
            let flat = flatten(&triangles, &angles, &boundary).unwrap();
            for angle in &flat.angles {
                assert!((angle[0] - TAU / n as f64).abs() < 1e-9, "{angle:?}");
                assert!((angle[1] - angle[2]).abs() < 1e-9, "{angle:?}");
            }
        }
    }

    #[test]
    fn a_flat_fan_stays_as_it_is() {
        let (triangles, angles, boundary) = cone(7, TAU);
        let flat = flatten(&triangles, &angles, &boundary).unwrap();
        for (found, given) in flat.angles.iter().zip(&angles) {
            for k in 0..3 {
                assert!((found[k] - given[k]).abs() < 1e-12);
            }
        }
    }

    /// The constraint gradients against central differences of the constraints.
    #[test]
    fn gradients_agree_with_finite_differences() {
        let (triangles, mut angles, boundary) = cone(5, 4.4);
        angles[2] = [0.7, 1.3, 0.9];
        let solver = AbfSolver::new(&triangles, &angles, &boundary).unwrap();
        let exact = solver.element(2).b;
        let h = 1e-6;
        for k in 0..3 {
            let values = [h, -h].map(|h| {
                let mut moved = AbfSolver::new(&triangles, &angles, &boundary).unwrap();
                moved.angles[2][k] += h;
                moved.element(2).c
            });
            let numeric = (values[0] - values[1]) / (2.0 * h);
            assert!((numeric - exact.column(k)).norm() < 1e-8, "angle {k}");
        }
    }
}
