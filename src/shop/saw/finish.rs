//! From parts of bars to whole bars: patterns are taken as often as they are used wholly, and
//! what is left is solved again.

use super::columns::{Cells, Relaxed, relax};
use super::heuristic::{best_fit, filled};
use super::task::{Load, Task, take_one};
use super::work::Work;

/// The best plan so far.
#[derive(Clone, Debug)]
pub struct Best {
    /// Its bars.
    pub loads: Vec<Load>,
    /// What they cost.
    pub cost: f64,
}

impl Best {
    /// Takes a plan if it is better.
    pub fn offer(&mut self, task: &Task, loads: Vec<Load>) {
        let cost = task.cost(&loads);
        if cost < self.cost - 0.5 * task.improvement() {
            (self.loads, self.cost) = (loads, cost);
        }
    }
}

/// A part of a bar so near to a whole one is one: noise of the solver.
const WHOLE: f64 = 1e-4;
/// Where no pattern is used for a whole bar, those used for so much of one are taken too, and
/// at least one. Each is tried until a plan meets the bound: which is best differs.
const NEARLY: [f64; 4] = [0.8, 0.6, 1.0, 0.5];

/// Looks for better plans along several ways down, until one costs as little as `bound`.
pub fn dives(
    task: &Task,
    cells: &Cells,
    relaxed: &Relaxed,
    best: &mut Best,
    bound: f64,
    work: &mut Work,
) {
    for nearly in NEARLY {
        if task.is_met(best.cost, bound) {
            return;
        }
        Dive { task, cells, bound, nearly }.go(relaxed, best, work);
    }
}

/// A way down from the relaxed solution.
struct Dive<'a> {
    task: &'a Task,
    cells: &'a Cells,
    bound: f64,
    nearly: f64,
}

impl Dive<'_> {
    /// Takes patterns by how much the relaxed solution uses them, and solves the rest again,
    /// until nothing is left or no better plan can come of it. Every rest is tried with the
    /// quick plans.
    fn go(&self, relaxed: &Relaxed, best: &mut Best, work: &mut Work) {
        let &Self { task, cells, bound, nearly } = self;
        let mut rest = task.clone();
        let mut taken: Vec<Load> = Vec::new();
        let mut now = relaxed.clone();
        while rest.demand.iter().any(|&d| d > 0) {
            if !take(&mut rest, &mut taken, &now.parts, nearly) {
                return;
            }
            let mut columns = now.columns;
            for plan in [best_fit(&rest), filled(&rest, &cells.safe, work)].into_iter().flatten() {
                columns.extend(plan.iter().cloned());
                let whole = taken.iter().cloned().chain(plan).collect();
                best.offer(task, task.on_cheapest(whole));
            }
            if task.is_met(best.cost, bound) {
                return;
            }
            let spent = task.cost(&taken);
            now = relax(&rest, cells, useful(columns, &rest), best.cost - spent, work);
            if task.is_met(best.cost, spent + rest.rounded_up(now.bound)) {
                return;
            }
        }
    }
}

/// Takes whole bars off the rest; where there are none, those nearly whole, and at least one.
fn take(rest: &mut Task, taken: &mut Vec<Load>, parts: &[(f64, Load)], nearly: f64) -> bool {
    let before = taken.len();
    for (part, load) in parts {
        for _ in 0..(part + WHOLE).floor() as usize {
            take_load(rest, taken, load);
        }
    }
    if taken.len() > before {
        return true;
    }
    for (n, (part, load)) in parts.iter().enumerate() {
        if n == 0 || *part >= nearly {
            take_load(rest, taken, load);
        }
    }
    taken.len() > before
}

/// Takes a bar, if it is there and all its pieces are wanted.
fn take_load(rest: &mut Task, taken: &mut Vec<Load>, load: &Load) {
    let wanted = load.pieces.iter().all(|&(i, n)| rest.demand[i] >= n);
    let kind = &mut rest.kinds[load.kind];
    if !wanted || kind.count == Some(0) {
        // More than is wanted may be sawn in parts; then as much as is.
        take_wanted(rest, taken, load);
        return;
    }
    take_one(&mut kind.count);
    load.pieces.iter().for_each(|&(i, n)| rest.demand[i] -= n);
    taken.push(load.clone());
}

/// Takes a bar with those of its pieces that are wanted, if these are most of them.
fn take_wanted(rest: &mut Task, taken: &mut Vec<Load>, load: &Load) {
    let wanted = |&(i, n): &(usize, usize)| (i, n.min(rest.demand[i]));
    let pieces: Vec<(usize, usize)> = load.pieces.iter().map(wanted).filter(|p| p.1 > 0).collect();
    let most = rest.taken(&pieces) > 0.5 * rest.taken(&load.pieces);
    if !most || rest.kinds[load.kind].count == Some(0) {
        return;
    }
    take_one(&mut rest.kinds[load.kind].count);
    pieces.iter().for_each(|&(i, n)| rest.demand[i] -= n);
    taken.push(Load { kind: load.kind, pieces });
}

/// Patterns cut down to what is wanted.
fn useful(columns: Vec<Load>, rest: &Task) -> Vec<Load> {
    let cut = |load: Load| {
        let wanted = load.pieces.iter().map(|&(i, n)| (i, n.min(rest.demand[i])));
        let pieces: Vec<(usize, usize)> = wanted.filter(|p| p.1 > 0).collect();
        (!pieces.is_empty() && rest.kinds[load.kind].count != Some(0))
            .then_some(Load { kind: load.kind, pieces })
    };
    columns.into_iter().filter_map(cut).collect()
}
