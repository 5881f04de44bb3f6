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
use super::sheet::Sheet;
use crate::ids::{Id, VertexId};
use crate::linalg::{LowerPattern, PairSolver};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};
use std::f64::consts::{PI, TAU};

/// Steps before giving up. Gentle surfaces take 4, heads and animals 6 to 12.
pub(super) const MAX_STEPS: usize = 40;

/// Largest change of an angle in the last step, radians. A step leaves a hundredth of
/// the one before to be done, so that angles are then right to about 1e-8, far below
/// the angle error of any map. Larger, and the figures depend on the start; smaller
/// costs a step for nothing.
const STILL: f64 = 1e-6;

/// Largest error of a constraint before the last step, radians (or logarithm of a
/// length ratio); a Newton step leaves about its square. Larger, and the layout has to
/// spread what is left over all triangles.
const CLOSED: f64 = 1e-5;

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
    /// Largest error of a constraint before the last step, radians.
    pub residual: f64,
}

/// Planar angles for a sheet.
///
/// # Errors
/// [`ChartError::NoConvergence`] when the constraints cannot be met, and
/// [`ChartError::Linear`] when a step has no solution.
pub fn flatten(sheet: &Sheet) -> Result<Flattening, ChartError> {
    flatten_within(sheet, MAX_STEPS)
}

/// [`flatten`] with another limit to its steps.
pub(super) fn flatten_within(sheet: &Sheet, max_steps: usize) -> Result<Flattening, ChartError> {
    AbfSolver::new(sheet)?.run(max_steps)
}

/// The working state of one flattening.
struct AbfSolver<'a> {
    triangles: &'a [[VertexId; 3]],
    /// Triangles from here on fill holes.
    real: usize,
    /// Number of each inner vertex among the inner vertices, or [`RIM`].
    inner: Vec<u32>,
    inner_count: usize,
    target: Vec<[f64; 3]>,
    angles: Vec<[f64; 3]>,
    solver: PairSolver,
}

/// In place of a number: a vertex on the rim, which has no constraints.
const RIM: u32 = u32::MAX;

/// One triangle, linearised: the six constraints at its corners (at each the sum,
/// then the lengths) against its three angles.
struct Element {
    /// Constraint gradients.
    b: Matrix6x3<f64>,
    /// The triangle's share of the constraint values.
    c: Vector6<f64>,
    /// Inverse weights, projected onto changes that keep the sum of the angles.
    p: Matrix3<f64>,
    /// The change of the angles if no vertex constrained them.
    free: Vector3<f64>,
}

impl<'a> AbfSolver<'a> {
    fn new(sheet: &'a Sheet) -> Result<Self, ChartError> {
        let triangles = &sheet.triangles[..];
        let mut inner_count = 0;
        let mut number = |rim: &bool| {
            if *rim {
                return RIM;
            }
            inner_count += 1;
            inner_count - 1
        };
        let inner: Vec<u32> = sheet.rim.iter().map(&mut number).collect();
        let inner_count = inner_count as usize;
        let pairs = triangles.iter().flat_map(|t| {
            let corners = t.map(|v| inner[v.index()]);
            (0..3).filter_map(move |k| {
                let (i, j) = (corners[k], corners[(k + 1) % 3]);
                (i != RIM && j != RIM).then_some((i as usize, j as usize))
            })
        });
        let solver = PairSolver::new(LowerPattern::new(inner_count, pairs)?)?;
        let target = scaled_targets(sheet);
        // The targets agree round vertices; the start in triangles. From targets, an angle
        // that scaling brings near π begins as a fold that no step opens.
        let closed = |t: &[f64; 3]| t.map(|a| a * PI / t.iter().sum::<f64>());
        let angles = target.iter().map(closed).collect();
        Ok(Self { triangles, real: sheet.real, inner, inner_count, target, angles, solver })
    }

    fn run(mut self, max_steps: usize) -> Result<Flattening, ChartError> {
        let mut residual = f64::INFINITY;
        for steps in 1..=max_steps {
            let (mut multipliers, before) = self.assemble();
            residual = before;
            if self.inner_count > 0 {
                self.solver.factor()?;
                self.solver.solve(&mut multipliers);
            }
            let change = self.apply(&multipliers);
            if !change.is_finite() {
                break;
            }
            if change < STILL && residual < CLOSED {
                return Ok(Flattening { angles: self.angles, steps, residual });
            }
        }
        Err(ChartError::NoConvergence { steps: max_steps, residual })
    }

    /// Sums up the system at the angles of now; returns its right-hand side and the
    /// largest error of a constraint.
    fn assemble(&mut self) -> (Vec<f64>, f64) {
        // The constraints hold, besides the sums over triangles, −2π a vertex.
        let constant = |row: usize| if row.is_multiple_of(2) { -TAU } else { 0.0 };
        let mut errors: Vec<f64> = (0..2 * self.inner_count).map(constant).collect();
        let mut rhs = vec![0.0; 2 * self.inner_count];
        self.solver.clear();
        for (t, triangle) in self.triangles.iter().enumerate() {
            let e = self.element(t);
            let block: Matrix6<f64> = e.b * e.p * e.b.transpose();
            let load = e.b * e.free;
            let nodes = triangle.map(|v| self.inner[v.index()]);
            for (k, &node) in nodes.iter().enumerate().filter(|(_, n)| **n != RIM) {
                let node = node as usize;
                for half in 0..2 {
                    rhs[2 * node + half] += load[2 * k + half];
                    errors[2 * node + half] += e.c[2 * k + half];
                }
                for (l, &other) in nodes[..=k].iter().enumerate().filter(|(_, n)| **n != RIM) {
                    let part = block.fixed_view::<2, 2>(2 * k, 2 * l).into_owned();
                    self.solver.add(node, other as usize, part);
                }
            }
        }
        let residual = errors.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        for (r, e) in rhs.iter_mut().zip(&errors) {
            *r += e;
        }
        (rhs, residual)
    }

    /// Moves the angles by the solution, as far as they stay angles; returns the
    /// largest change asked for.
    fn apply(&mut self, multipliers: &[f64]) -> f64 {
        let mut changes = Vec::with_capacity(self.triangles.len());
        let mut part = 1.0f64;
        for (t, triangle) in self.triangles.iter().enumerate() {
            let e = self.element(t);
            let nodes = triangle.map(|v| self.inner[v.index()]);
            let mu = Vector6::from_fn(|k, _| match nodes[k / 2] {
                RIM => 0.0,
                node => multipliers[2 * node as usize + k % 2],
            });
            let change = e.free - e.p * (e.b.transpose() * mu);
            for k in 0..3 {
                let angle = self.angles[t][k];
                let room = if change[k] < 0.0 { angle } else { PI - angle };
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

    fn element(&self, t: usize) -> Element {
        let alpha = Vector3::from(self.angles[t]);
        let beta = Vector3::from(self.target[t]);
        let (sin, cos) = (alpha.map(f64::sin), alpha.map(f64::cos));
        let (cot, log) = (cos.component_div(&sin), sin.map(f64::ln));
        let mut b = Matrix6x3::zeros();
        let mut c = Vector6::zeros();
        for j in 0..3 {
            let (next, last) = ((j + 1) % 3, (j + 2) % 3);
            b[(2 * j, j)] = 1.0;
            c[2 * j] = alpha[j];
            b[(2 * j + 1, next)] = cot[next];
            b[(2 * j + 1, last)] = -cot[last];
            c[2 * j + 1] = log[next] - log[last];
        }
        let d = if t < self.real {
            beta.component_mul(&beta)
        } else {
            Vector3::repeat(FILLER_SOFTNESS)
        };
        let sum = d.sum();
        let p = Matrix3::from_diagonal(&d) - d * d.transpose() / sum;
        let to_target = beta - alpha;
        let missing = PI - alpha.sum() - to_target.sum();
        Element { b, c, p, free: to_target + d * (missing / sum) }
    }
}

/// Inverse weight of the angles that fill a hole, square radians, in place of β²: they
/// have no shape to keep. Larger, and rounding tells in the system; smaller, and holes
/// stiffen the surface.
const FILLER_SOFTNESS: f64 = 100.0;

/// Least angle that a filler starts from, radians: smaller, and holes that are far from
/// flat start from needles, which the steps cannot open.
const LEAST_FILLER: f64 = 0.02;

/// Least sum of the angles that fill a hole at one of its corners, radians, where the
/// surface leaves less: smaller, and folds at a hole's edge begin as needles.
const LEAST_GAP: f64 = 0.1;

/// Surface angles, scaled so that they sum to 2π round every inner vertex (paper, 2.1).
/// At the edge of a hole those of the surface stay and the fillers take what is left.
fn scaled_targets(sheet: &Sheet) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 2]; sheet.rim.len()];
    let kind = |t: usize| usize::from(t >= sheet.real);
    let each = || sheet.triangles.iter().zip(&sheet.angles).enumerate();
    for (t, (triangle, angles)) in each() {
        for k in 0..3 {
            sums[triangle[k].index()][kind(t)] += angles[k].max(LEAST_ANGLE);
        }
    }
    let factor = |t: usize, v: VertexId| match (sheet.rim[v.index()], sums[v.index()]) {
        (true, _) => 1.0,
        (_, [all, 0.0] | [0.0, all]) => TAU / all,
        (_, [real, filler]) if t >= sheet.real => (TAU - real).max(LEAST_GAP) / filler,
        _ => 1.0,
    };
    let scaled = |t: usize, v: VertexId, angle: f64| {
        let least = if t < sheet.real { LEAST_ANGLE } else { LEAST_FILLER };
        (angle.max(LEAST_ANGLE) * factor(t, v)).clamp(least, PI - least)
    };
    each().map(|(t, (c, angles))| std::array::from_fn(|k| scaled(t, c[k], angles[k]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of n triangles round one inner vertex, with corner angles made by
    /// the tip of a cone of total angle `total`.
    fn cone(n: usize, total: f64) -> Sheet {
        let v = VertexId::new;
        let triangles = (0..n).map(|i| [v(0), v(1 + i), v(1 + (i + 1) % n)]).collect();
        let tip = total / n as f64;
        let angles = vec![[tip, (PI - tip) / 2.0, (PI - tip) / 2.0]; n];
        let rim = (0..=n).map(|i| i > 0).collect();
        Sheet { triangles, real: n, angles, rim }
    }

    #[test]
    fn a_cone_opens_to_equal_slices() {
        for (n, total) in [(5, 4.0), (6, 5.5), (8, 8.0)] {
            let flat = flatten(&cone(n, total)).unwrap();
            for angle in &flat.angles {
                assert!((angle[0] - TAU / n as f64).abs() < 1e-9, "{angle:?}");
                assert!((angle[1] - angle[2]).abs() < 1e-9, "{angle:?}");
            }
        }
    }

    #[test]
    fn a_flat_fan_stays_as_it_is() {
        let fan = cone(7, TAU);
        let flat = flatten(&fan).unwrap();
        for (found, given) in flat.angles.iter().zip(&fan.angles) {
            for k in 0..3 {
                assert!((found[k] - given[k]).abs() < 1e-12);
            }
        }
    }

    /// The constraint gradients against central differences of the constraints.
    #[test]
    fn gradients_agree_with_finite_differences() {
        let mut fan = cone(5, 4.4);
        fan.angles[2] = [0.7, 1.3, 0.9];
        let solver = AbfSolver::new(&fan).unwrap();
        let exact = solver.element(2).b;
        let h = 1e-6;
        for k in 0..3 {
            let values = [h, -h].map(|h| {
                let mut moved = AbfSolver::new(&fan).unwrap();
                moved.angles[2][k] += h;
                moved.element(2).c
            });
            let numeric = (values[0] - values[1]) / (2.0 * h);
            assert!((numeric - exact.column(k)).norm() < 1e-8, "angle {k}");
        }
    }
}
