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
//! Angle by angle it is also a function of that angle alone. Its second derivative times
//! the multipliers of the step before is added to the weights, so that the steps are
//! Newton's, as far as the sum stays positive.
//!
//! The paper raises the weight of angles that leave (0, π) and starts again. Where a
//! whole body goes through a hole of few edges, the least sum of squares has angles below
//! zero, and no step gets there. Here every angle adds [`BARRIER`] · (α / β − log(α / β)),
//! which has no slope at β and no end towards 0, and a triangle whose step is too long
//! takes part of it, alone.
//!
//! Tried on closed bodies open at a hole of three edges, on noise of a third of an edge,
//! and on slivers. Where holes are filled by needles, steps may creep; the last ones are
//! left out once they gain nothing ([`ENOUGH`]).

use super::ChartError;
use super::sheet::Sheet;
use crate::ids::{Id, VertexId};
use crate::linalg::{BlockSolver, LowerPattern};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};
use std::f64::consts::{PI, TAU};

/// Steps before giving up. Gentle surfaces take 3 or 4, whole bodies 5 to 9.
pub(super) const MAX_STEPS: usize = 40;

/// Largest change of an angle in the last step, radians. A step leaves a hundredth of
/// the one before to be done, so that angles are then right to about 1e-7, far below
/// the angle error of any map. Larger, and the figures depend on the start; smaller
/// costs a step for nothing.
const STILL: f64 = 1e-5;

/// Where single triangles creep: the last step, squared and weighted, as a part of the
/// sum to be minimised. Angles then change by a thousandth of their error. Larger, and
/// maps get worse; smaller, and dozens of steps go into a few triangles.
const ENOUGH: f64 = 1e-6;

/// Largest error of a constraint before the last step, radians (or logarithm of a
/// length ratio); a Newton step leaves about its square. Larger, and the layout has to
/// spread what is left over all triangles.
const CLOSED: f64 = 1e-5;

/// A triangle goes at most this part of the way to an angle of zero or π, so that
/// angles stay between the two; nearer to 1 and slivers collapse to zero.
const KEEP_OFF: f64 = 0.9;

/// How much angles shun zero, against 1 for the squares: an angle that the squares alone
/// would bring to zero stays at about this part of its target. Larger, and maps get
/// worse (0.1: by 0.1 %); smaller, and where bodies pass through small holes steps take
/// longer, or end in triangles without area.
const BARRIER: f64 = 0.01;

/// Least second derivative at an angle, as a part of its weight, where the curvature
/// of the constraints takes away more: smaller, and steps are long in directions that
/// the others will undo; larger, and steps creep.
const LEAST_CURVATURE: f64 = 0.1;

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
    /// Those of the step before: at each inner vertex of the sum, then of the lengths.
    multipliers: Vec<f64>,
    solver: BlockSolver<2>,
}

/// What a step asks for at the triangles of the surface; those of holes may drift.
#[derive(Default)]
struct Step {
    /// Largest change of an angle, radians.
    largest: f64,
    /// Sum of the squares of all changes, weighted.
    squares: f64,
    /// The same sum of the differences from the targets, before the step.
    error: f64,
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
    /// Inverse second derivatives, projected onto changes that keep the sum of the angles.
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
        let solver = BlockSolver::new(LowerPattern::new(inner_count, pairs)?)?;
        let target = scaled_targets(sheet);
        // The targets agree round vertices; the start in triangles. From targets, an angle
        // that scaling brings near π begins as a fold that no step opens.
        let closed = |t: &[f64; 3]| t.map(|a| a * PI / t.iter().sum::<f64>());
        let angles = target.iter().map(closed).collect();
        let multipliers = vec![0.0; 2 * inner_count];
        let real = sheet.real;
        Ok(Self { triangles, real, inner, inner_count, target, angles, multipliers, solver })
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
            let step = self.apply(multipliers);
            if !step.squares.is_finite() {
                break;
            }
            let settled = step.largest < STILL || step.squares < ENOUGH * step.error;
            if settled && residual < CLOSED {
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
                    self.solver.add(node, other as usize, &part);
                }
            }
        }
        let residual = errors.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        for (r, e) in rhs.iter_mut().zip(&errors) {
            *r += e;
        }
        (rhs, residual)
    }

    /// Moves the angles by the solution, each triangle as far as its angles stay angles.
    fn apply(&mut self, multipliers: Vec<f64>) -> Step {
        let mut step = Step::default();
        let mut moved = Vec::with_capacity(self.triangles.len());
        for (t, triangle) in self.triangles.iter().enumerate() {
            let e = self.element(t);
            let nodes = triangle.map(|v| self.inner[v.index()]);
            let mu = Vector6::from_fn(|k, _| match nodes[k / 2] {
                RIM => 0.0,
                node => multipliers[2 * node as usize + k % 2],
            });
            let change = e.free - e.p * (e.b.transpose() * mu);
            let (alpha, beta) = (Vector3::from(self.angles[t]), Vector3::from(self.target[t]));
            let mut part = 1.0f64;
            for (angle, change) in alpha.iter().zip(&change) {
                let room = if *change < 0.0 { *angle } else { PI - angle };
                part = part.min(KEEP_OFF * room / change.abs());
            }
            if t < self.real {
                step.largest = step.largest.max(change.amax());
                step.squares += change.component_div(&beta).norm_squared();
                step.error += (alpha - beta).component_div(&beta).norm_squared();
            }
            moved.push((alpha + change * part).into());
        }
        self.angles = moved;
        self.multipliers = multipliers;
        step
    }

    fn element(&self, t: usize) -> Element {
        let alpha = Vector3::from(self.angles[t]);
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
        let (weight, slope, curvature) = self.energy(t, &alpha);
        let h = curvature + self.bend(t, &sin);
        let d = h.sup(&(weight * LEAST_CURVATURE)).map(f64::recip);
        let sum = d.sum();
        let p = Matrix3::from_diagonal(&d) - d * d.transpose() / sum;
        let free = d * ((PI - alpha.sum()) / sum) - p * slope;
        Element { b, c, p, free }
    }

    /// The weight of each angle of a triangle, and first and second derivative of the sum
    /// to be minimised, w (α − β)² / 2 + [`BARRIER`] (α / β − log(α / β)).
    fn energy(&self, t: usize, alpha: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, Vector3<f64>) {
        let beta = Vector3::from(self.target[t]);
        let weight = if t < self.real {
            beta.map(|b| (b * b).recip())
        } else {
            Vector3::repeat(FILLER_SOFTNESS.recip())
        };
        let shun = alpha.zip_map(&beta, |a, b| BARRIER * (b.recip() - a.recip()));
        let slope = weight.component_mul(&(alpha - beta)) + shun;
        (weight, slope, weight + alpha.map(|a| BARRIER / (a * a)))
    }

    /// Second derivative of the length constraints by each angle of a triangle, times
    /// the multipliers: that of log sin α is −1 / sin² α.
    fn bend(&self, t: usize, sin: &Vector3<f64>) -> Vector3<f64> {
        let length = self.triangles[t].map(|v| match self.inner[v.index()] {
            RIM => 0.0,
            node => self.multipliers[2 * node as usize + 1],
        });
        Vector3::from_fn(|j, _| (length[(j + 1) % 3] - length[(j + 2) % 3]) / (sin[j] * sin[j]))
    }
}

/// Inverse weight of the angles that fill a hole, square radians, in place of β²: they
/// have no shape to keep. Larger, and steps creep or do not settle, since nothing holds
/// angles against the curvature of the constraints; smaller, and holes stiffen the surface.
const FILLER_SOFTNESS: f64 = 10.0;

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

    /// Slope and curvature of the sum and of the constraints against differences.
    #[test]
    fn second_derivatives_agree_with_finite_differences() {
        let tetrahedron = [[0, 1, 2], [0, 2, 3], [0, 3, 1]].map(|t| t.map(VertexId::new));
        let angles = [[0.7, 1.3, PI - 2.0], [0.9, 0.9, PI - 1.8], [1.1, 1.9, PI - 3.0]];
        for real in [3, 0] {
            let (triangles, angles) = (tetrahedron.to_vec(), angles.to_vec());
            let sheet = Sheet { triangles, real, angles, rim: vec![false; 4] };
            let mut solver = AbfSolver::new(&sheet).unwrap();
            solver.multipliers = (0..8).map(|i| 0.3 * f64::from(i * i % 7) - 0.8).collect();
            let alpha = Vector3::new(0.5, 1.0, PI - 1.5);
            let mu = Vector6::from_fn(|k, _| {
                solver.multipliers[2 * tetrahedron[1][k / 2].index() + k % 2]
            });
            let (_, slope, curvature) = solver.energy(1, &alpha);
            let bend = solver.bend(1, &alpha.map(f64::sin));
            let h = 1e-6;
            for k in 0..3 {
                let [more, less] = [h, -h].map(|h| {
                    let mut moved = alpha;
                    moved[k] += h;
                    solver.angles[1] = moved.into();
                    let pull = solver.element(1).b.transpose() * mu;
                    (sum(&solver, 1, &moved), solver.energy(1, &moved).1[k], pull[k])
                });
                assert!(((more.0 - less.0) / (2.0 * h) - slope[k]).abs() < 1e-7, "{k}");
                assert!(((more.1 - less.1) / (2.0 * h) - curvature[k]).abs() < 1e-6, "{k}");
                assert!(((more.2 - less.2) / (2.0 * h) - bend[k]).abs() < 1e-6, "{k}");
            }
        }
    }

    /// What is minimised, of one triangle.
    fn sum(solver: &AbfSolver<'_>, t: usize, alpha: &Vector3<f64>) -> f64 {
        let beta = Vector3::from(solver.target[t]);
        let weight = solver.energy(t, alpha).0;
        let shun = alpha.component_div(&beta).map(|r| BARRIER * (r - r.ln()));
        (alpha - beta).component_mul(&(alpha - beta)).dot(&weight) / 2.0 + shun.sum()
    }
}
