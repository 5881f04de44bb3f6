//! Damped Gauss-Newton (Levenberg-Marquardt) on the centres of the units.

use super::energy::{Energy, Term};
use crate::linalg::{LinalgError, SpdSolver, block_entries};
use crate::surface::{Point3, Vector3};

/// Steps before giving up; most surfaces take three to ten.
const MAX_STEPS: usize = 40;

/// A step whose longest move is below this part of a mean link is the last, and not taken.
/// Larger, and figures depend on where centres began; smaller, and rounding of a flat
/// chart is taken for something to be mended.
const STILL: f64 = 1e-5;

/// Gain of a step, as part of the sum, below which it is the last: on coarse meshes, where
/// the direction to the surface jumps from triangle to triangle, steps may creep.
const CREEP: f64 = 1e-4;

/// Longest move in one step, in mean links; longer ones leave the range in which angles
/// are near to linear, and may land on another part of the surface.
const LONGEST: f64 = 0.5;

/// Damping at the start, and the least, against squared weights of about 1.
const DAMPING: [f64; 2] = [1e-3, 1e-9];

/// The damping is multiplied by this where a step does not lessen the sum, and divided
/// by it where it does.
const CHANGE: f64 = 8.0;

/// Tries to lessen the sum before the place is taken for the best.
const TRIES: usize = 8;

/// How a centre may move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Hold {
    /// As it likes.
    Free,
    /// Only across this unit vector: along the border that holds it back.
    Across(Vector3),
    /// Not at all.
    Still,
}

impl Hold {
    /// What is left of a derivative.
    fn part(&self, row: Vector3) -> Vector3 {
        match self {
            Self::Free => row,
            Self::Across(way) => row - way * way.dot(&row),
            Self::Still => Vector3::zeros(),
        }
    }
}

/// Moves the centres to where the energy is least, as far as they may, and says how many
/// steps it took. No step is taken that does not lessen the energy.
///
/// # Errors
/// [`LinalgError::TooLarge`].
pub fn descend(
    energy: &Energy,
    centers: &mut Vec<Point3>,
    holds: &[Hold],
) -> Result<usize, LinalgError> {
    let mut system = System::new(energy, centers)?;
    let mut damping = DAMPING[0];
    let mut now = energy.value(centers);
    for step in 0..MAX_STEPS {
        let terms: Vec<Term> = energy.terms(centers).collect();
        let mut taken = None;
        for _ in 0..TRIES {
            let Some(moves) = system.step(&terms, holds, damping) else {
                damping *= CHANGE;
                continue;
            };
            let longest = moves.iter().map(Vector3::norm).fold(0.0, f64::max);
            if longest < STILL {
                return Ok(step);
            }
            let part = (LONGEST / longest).min(1.0) * energy.mean;
            let tried: Vec<Point3> =
                centers.iter().zip(&moves).map(|(p, m)| p + m * part).collect();
            let value = energy.value(&tried);
            if value < now {
                taken = Some((tried, value));
                damping = (damping / CHANGE).max(DAMPING[1]);
                break;
            }
            damping *= CHANGE;
        }
        let Some((tried, value)) = taken else { return Ok(step) };
        let gain = (now - value) / now;
        *centers = tried;
        now = value;
        if gain < CREEP {
            return Ok(step + 1);
        }
    }
    Ok(MAX_STEPS)
}

/// The normal equations; their pattern is always the same.
struct System {
    solver: SpdSolver,
    values: Vec<f64>,
    nodes: usize,
}

/// The unknowns of a term, in the order of its rows.
fn unknowns(term: &Term) -> [usize; 9] {
    std::array::from_fn(|k| 3 * term.nodes[k / 3] + k % 3)
}

impl System {
    fn new(energy: &Energy, centers: &[Point3]) -> Result<Self, LinalgError> {
        let size = 3 * centers.len();
        let mut entries = Vec::new();
        for term in energy.terms(centers) {
            let at = unknowns(&term);
            entries.extend(block_entries(3 * term.count).map(|(i, j)| (at[i], at[j])));
        }
        entries.extend((0..size).map(|i| (i, i)));
        let solver = SpdSolver::new(size, &entries)?;
        Ok(Self { solver, values: Vec::with_capacity(entries.len()), nodes: centers.len() })
    }

    /// The damped step, in mean links; none where the system cannot be factored.
    fn step(&mut self, terms: &[Term], holds: &[Hold], damping: f64) -> Option<Vec<Vector3>> {
        self.values.clear();
        let mut x = vec![0.0; 3 * self.nodes];
        for term in terms {
            // Where a centre may not move it has no derivatives, so it has no step.
            let rows: [Vector3; 3] =
                std::array::from_fn(|k| holds[term.nodes[k]].part(term.rows[k]));
            let row: [f64; 9] = std::array::from_fn(|k| rows[k / 3][k % 3]);
            self.values.extend(block_entries(3 * term.count).map(|(i, j)| row[i] * row[j]));
            for (at, row) in unknowns(term).into_iter().zip(row).take(3 * term.count) {
                x[at] -= term.error * row;
            }
        }
        self.values.extend(x.iter().map(|_| damping));
        self.solver.factor(&self.values).ok()?;
        self.solver.solve(&mut x);
        let moves: Vec<Vector3> = x.chunks(3).map(Vector3::from_column_slice).collect();
        moves.iter().flatten().all(|m| m.is_finite()).then_some(moves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::relax::graph::{Corner, Graph, Link};
    use crate::surface::locate::Locator;
    use crate::surface::samples::sample;
    use std::f64::consts::FRAC_PI_2;

    /// A row of squares on a flat sheet, its nodes thrown about, becomes even again; what
    /// is fixed stays; and the energy falls all the way.
    #[test]
    fn a_crooked_grid_becomes_straight() {
        let mesh = sample("flat").expect("a sample");
        let locator = Locator::new(&mesh);
        let (n, unit) = (5, 40.0);
        let at = |i: usize, j: usize| n * i + j;
        let mut graph = Graph::default();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let around: Vec<usize> =
                [(i + 1, j), (i, j + 1), (i.wrapping_sub(1), j), (i, j.wrapping_sub(1))]
                    .into_iter()
                    .map(|(i, j)| if i < n && j < n { at(i, j) } else { usize::MAX })
                    .collect();
            for k in 0..4 {
                let ends = [around[k], around[(k + 1) % 4]];
                if ends.iter().all(|&e| e < usize::MAX) {
                    graph.corners.push(Corner { at: at(i, j), ends, angle: FRAC_PI_2 });
                }
                if k < 2 && around[k] < usize::MAX {
                    graph.links.push(Link { ends: [at(i, j), around[k]], length: 1.0 });
                }
            }
        }
        let start: Vec<Point3> = (0..n * n)
            .map(|k| {
                let (x, y) = ((k / n) as f64, (k % n) as f64);
                let off = [(1.3 * k as f64).sin(), (2.7 * k as f64).cos(), 0.0].map(|d| 9.0 * d);
                Point3::new(x * unit - 80.0, y * unit - 80.0, 0.0) + Vector3::from(off)
            })
            .collect();
        let mean = unit;
        let energy =
            Energy { graph: &graph, mesh: &mesh, locator: &locator, start: &start, unit, mean };
        let mut holds = vec![Hold::Free; n * n];
        holds[0] = Hold::Still;
        holds[7] = Hold::Across(Vector3::x());
        let mut centers = start.clone();
        let mut last = energy.value(&centers);
        let first = last;
        loop {
            // One step at a time, by starting anew.
            let before = centers.clone();
            descend(&energy, &mut centers, &holds).expect("a small system");
            let now = energy.value(&centers);
            assert!(now <= last);
            if before == centers {
                break;
            }
            last = now;
        }
        assert!(last < 1e-3 * first, "{first} {last}");
        assert_eq!(centers[0], start[0]);
        assert!((centers[7] - start[7]).x.abs() < 1e-9 && centers[7] != start[7]);
        assert!(graph.length_errors(&centers, unit).iter().all(|e| e.abs() < 0.01));
        assert!(graph.angle_errors(&centers).iter().all(|e| e.abs() < 1.0));
    }
}
