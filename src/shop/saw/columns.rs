//! Column generation (Gilmore and Gomory, *A linear programming approach to the cutting stock
//! problem*, 1961): how many bars are sawn by each pattern, in parts of a bar.
//!
//! The linear program has a column for each pattern that is known, and gives each size a price.
//! The knapsack finds the patterns that are worth more than they cost, which are added. Any
//! prices give a bound (Farley, *A note on bounding a class of linear programming problems*,
//! 1990): they are made smaller until they are sure to keep within the cost of every bar, so no
//! bound hangs on the accuracy of the solver.

use super::knapsack::{Knapsack, Rounding, Table};
use super::simplex::{Column, Simplex};
use super::task::{Kind, Load, Task};
use super::work::Work;
use std::collections::BTreeSet;

/// A pattern is added when it is worth this much more than it costs, in parts of the dearest
/// bar. Smaller, and rounding adds patterns without end; larger, and bounds are lost.
const WORTH: f64 = 1e-7;
/// Most patterns added at once: they have no piece in common.
const AT_ONCE: usize = 4;

/// Patterns are looked for at prices so near to those of the best bound, as part of the way from
/// them to those of the program: these jump about, and take many rounds to settle (Pessoa et
/// al., *Automation and combination of linear-programming based stabilization techniques in
/// column generation*, 2018).
const STEADY: f64 = 0.7;

/// The pieces of a task as knapsack problems.
#[derive(Clone, Debug)]
pub struct Cells {
    /// What it finds can be sawn.
    pub safe: Knapsack,
    /// What it finds may be a little too much; none where the other is exact.
    generous: Option<Knapsack>,
}

impl Cells {
    /// The cells of a task.
    pub fn new(task: &Task) -> Self {
        match Knapsack::exact(task) {
            Some(safe) => Self { safe, generous: None },
            None => Self {
                safe: Knapsack::rounded(task, Rounding::Safe),
                generous: Some(Knapsack::rounded(task, Rounding::Generous)),
            },
        }
    }

    /// The most that pieces fill of a bar of each kind, mm, or a little more.
    pub fn fullest(&self, task: &Task) -> Vec<f64> {
        let cells = self.generous.as_ref().unwrap_or(&self.safe);
        let table = cells.table(&task.sizes, &task.demand);
        let most = |(k, kind): (usize, &Kind)| table.value(cells.room(k)).min(kind.room);
        task.kinds.iter().enumerate().map(most).collect()
    }
}

/// What a piece of each size, and a bar of each kind beyond its cost, is worth. No bar holds
/// pieces worth more than it costs.
#[derive(Clone, Debug)]
pub struct Prices {
    /// By size.
    pub pieces: Vec<f64>,
    /// By kind of bar; 0 where there are as many as needed.
    pub bars: Vec<f64>,
}

/// The solution in parts of bars.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// No plan costs less.
    pub bound: f64,
    /// The prices that show it.
    pub prices: Prices,
    /// The patterns that were found.
    pub columns: Vec<Load>,
    /// How many bars are sawn by which of them, in parts of a bar, most first.
    pub parts: Vec<(f64, Load)>,
}

/// Solves a task in parts of bars. `columns` are patterns to begin with; `known` is the cost of
/// a plan: where the bound reaches it, there is no more to find.
pub fn relax(
    task: &Task,
    cells: &Cells,
    mut columns: Vec<Load>,
    known: f64,
    work: &mut Work,
) -> Relaxed {
    columns.sort();
    columns.dedup();
    let mut held: BTreeSet<Load> = columns.iter().cloned().collect();
    let mut master = Master::new(task);
    columns.iter().for_each(|load| master.add(load));
    let prices = by_length(task);
    let mut found = Relaxed { bound: prices.bound(task), prices, columns, parts: Vec::new() };
    let entries = cells.safe.entries(&task.demand);
    let mut steady = STEADY;
    while master.simplex.solve(work) && work.spend(entries) {
        let wanted = master.prices();
        let tried = found.prices.toward(&wanted, 1.0 - steady);
        let table = cells.safe.table(&tried.pieces, &task.demand);
        if cells.generous.is_none() {
            found.raise(task, &tried.pieces, &cells.safe, &table);
        }
        let (bound, target) = (task.rounded_up(found.bound), task.rounded_up(master.value()));
        if task.is_met(known, bound) || (task.step.is_some() && task.is_met(target, bound)) {
            break;
        }
        let new = worthy(task, &cells.safe, [&tried, &wanted], table, &held, work);
        if new.is_empty() && steady == 0.0 {
            break;
        }
        // Where steady prices find nothing, those of the program may.
        steady = if new.is_empty() { 0.0 } else { STEADY };
        new.iter().for_each(|load| master.add(load));
        held.extend(new.iter().cloned());
        found.columns.extend(new);
    }
    if let Some(generous) = &cells.generous {
        let pieces = master.prices().pieces;
        let table = generous.table(&pieces, &task.demand);
        found.raise(task, &pieces, generous, &table);
    }
    found.parts = master.parts(&found.columns);
    found
}

impl Relaxed {
    /// Takes the bound of prices, if it is better. `table` is of the same prices.
    fn raise(&mut self, task: &Task, pieces: &[f64], cells: &Knapsack, table: &Table) {
        let worth = |k: usize| table.value(cells.room(k));
        let mut part: f64 = 1.0;
        for (k, kind) in task.kinds.iter().enumerate().filter(|(_, kind)| kind.count.is_none()) {
            if worth(k) > kind.cost {
                part = part.min(kind.cost / worth(k));
            }
        }
        let bars: Vec<f64> = (task.kinds.iter().enumerate())
            .map(|(k, kind)| match kind.count {
                Some(_) => (part * worth(k) - kind.cost).max(0.0),
                None => 0.0,
            })
            .collect();
        let prices = Prices { pieces: pieces.iter().map(|y| part * y).collect(), bars };
        let bound = prices.bound(task);
        if bound > self.bound {
            (self.bound, self.prices) = (bound, prices);
        }
    }
}

/// Prices by length alone: every mm is worth the same, as much as gives the best bound.
fn by_length(task: &Task) -> Prices {
    let of = |each: f64| Prices {
        pieces: task.sizes.iter().map(|s| each * s).collect(),
        bars: (task.kinds.iter())
            .map(|k| if k.count.is_some() { (each * k.room - k.cost).max(0.0) } else { 0.0 })
            .collect(),
    };
    let unlimited = task.kinds.iter().filter(|k| k.count.is_none());
    let most = unlimited.map(|k| k.cost / k.room).fold(f64::INFINITY, f64::min);
    let all = task.kinds.iter().map(|k| k.cost / k.room).filter(|&each| each <= most).map(of);
    let best = all.max_by(|a, b| a.bound(task).total_cmp(&b.bound(task)));
    best.unwrap_or_else(|| of(0.0))
}

impl Prices {
    /// Prices part of the way to others.
    fn toward(&self, other: &Self, part: f64) -> Self {
        let mix = |a: &[f64], b: &[f64]| {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect::<Vec<f64>>()
        };
        Self { pieces: mix(&self.pieces, &other.pieces), bars: mix(&self.bars, &other.bars) }
    }

    /// What the pieces of a task cost at least.
    fn bound(&self, task: &Task) -> f64 {
        let pieces: f64 = self.pieces.iter().zip(&task.demand).map(|(y, &d)| y * d as f64).sum();
        let count = |k: usize| task.kinds[k].count.unwrap_or(0) as f64;
        pieces - self.bars.iter().enumerate().map(|(k, z)| z * count(k)).sum::<f64>()
    }

    /// What a bar costs beyond what its pieces are worth.
    pub fn excess(&self, task: &Task, load: &Load) -> f64 {
        let worth: f64 = load.pieces.iter().map(|&(i, n)| self.pieces[i] * n as f64).sum();
        task.kinds[load.kind].cost + self.bars[load.kind] - worth
    }
}

/// Patterns that are best at the prices tried, and worth more than they cost at those wanted: the
/// best first, and no piece in two of one kind of bar. `table` is of the prices tried.
fn worthy(
    task: &Task,
    cells: &Knapsack,
    [tried, wanted]: [&Prices; 2],
    mut table: Table,
    held: &BTreeSet<Load>,
    work: &mut Work,
) -> Vec<Load> {
    let dearest = task.kinds.iter().map(|k| k.cost).fold(0.0, f64::max);
    let mut rest = task.demand.clone();
    let mut new: Vec<Load> = Vec::new();
    while new.len() < AT_ONCE {
        let load = |kind| Load { kind, pieces: table.load(cells.room(kind)) };
        let mut found: Vec<(f64, Load)> = (0..task.kinds.len())
            .map(|kind| (wanted.excess(task, &load(kind)), load(kind)))
            .filter(|(excess, l)| {
                *excess < -WORTH * dearest && !held.contains(l) && !new.contains(l)
            })
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, best)) = found.first() else { break };
        best.pieces.iter().for_each(|&(i, n)| rest[i] -= n);
        new.extend(found.into_iter().map(|f| f.1));
        if !work.spend(cells.entries(&rest)) {
            break;
        }
        table = cells.table(&tried.pieces, &rest);
    }
    new
}

/// The linear program of the patterns: every size as often as it is wanted or more, no kind of
/// bar more often than it is there. Costs are in those of the dearest bar.
struct Master {
    simplex: Simplex,
    unit: f64,
    costs: Vec<f64>,
    /// The row of each size that is wanted.
    pieces: Vec<Option<usize>>,
    /// The row of each kind of bar with a count.
    bars: Vec<Option<usize>>,
    /// Columns before those of the patterns.
    before: usize,
}

/// What a piece costs that is in no bar, in dearest bars: more than any price.
const MISSING: f64 = 2.0;
/// Less of a bar is none: noise of the solver.
const NONE: f64 = 1e-5;

impl Master {
    fn new(task: &Task) -> Self {
        let dearest = task.kinds.iter().map(|k| k.cost).fold(0.0, f64::max);
        let unit = if dearest > 0.0 { dearest } else { 1.0 };
        let mut right: Vec<f64> = Vec::new();
        let mut costs: Vec<f64> = Vec::new();
        let mut row = |count: usize, cost: f64| {
            right.push(count as f64);
            costs.push(cost);
            right.len() - 1
        };
        let pieces: Vec<Option<usize>> =
            task.demand.iter().map(|&d| (d > 0).then(|| row(d, MISSING))).collect();
        let bars: Vec<Option<usize>> =
            task.kinds.iter().map(|k| k.count.map(|n| row(n, 0.0))).collect();
        let mut simplex = Simplex::new(right, &costs);
        // More pieces than are wanted.
        for &row in pieces.iter().flatten() {
            simplex.add(Column { cost: 0.0, entries: vec![(row, -1.0)] });
        }
        let before = costs.len() + pieces.iter().flatten().count();
        let costs = task.kinds.iter().map(|k| k.cost / unit).collect();
        Self { simplex, unit, costs, pieces, bars, before }
    }

    fn add(&mut self, load: &Load) {
        let pieces = load.pieces.iter().filter_map(|&(i, n)| Some((self.pieces[i]?, n as f64)));
        let entries = pieces.chain(self.bars[load.kind].map(|row| (row, 1.0))).collect();
        self.simplex.add(Column { cost: self.costs[load.kind], entries });
    }

    fn prices(&self) -> Prices {
        let prices = self.simplex.prices();
        let price = |row: &Option<usize>| row.map_or(0.0, |r| self.unit * prices[r]);
        Prices {
            pieces: self.pieces.iter().map(|r| price(r).max(0.0)).collect(),
            bars: self.bars.iter().map(|r| (-price(r)).max(0.0)).collect(),
        }
    }

    fn value(&self) -> f64 {
        self.unit * self.simplex.value()
    }

    /// How much each of the patterns is used.
    fn parts(&self, columns: &[Load]) -> Vec<(f64, Load)> {
        let pattern = |(c, x): (usize, f64)| Some((x, columns.get(c.checked_sub(self.before)?)?));
        let used = self.simplex.used().filter_map(pattern).filter(|u| u.0 > NONE);
        let mut used: Vec<(f64, Load)> = used.map(|(x, load)| (x, load.clone())).collect();
        used.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        used
    }
}
