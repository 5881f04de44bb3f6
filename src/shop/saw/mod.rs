//! The sawing plan: which pieces are sawn from which bar.
//!
//! A bar of length L holds pieces ℓ when Σℓ + k·(n − 1) ≤ L − 2t, with k the width of the saw
//! cut and t what is trimmed off either end: what one cut takes lies between two pieces. That
//! is bin packing of ℓ + k into L − 2t + k. An offcut is trimmed at one end only: L − t.
//!
//! What is bought is made as small as possible: its price; without prices its length, which is
//! the number of bars where all are alike. Offcuts at hand cost nothing. Four steps, each only
//! where the one before left a gap between plan and bound:
//! 1. quick plans ([`heuristic`]) against the bound of Martello and Toth ([`bound`]);
//! 2. column generation ([`columns`]), for a bound that is met almost always;
//! 3. patterns of it taken whole, the rest solved again ([`finish`]);
//! 4. a search through all plans, up to a number of steps ([`search`]).
//!
//! A plan is proven where it meets the bound. Where it does not, a better one may or may not
//! exist.
//!
//! Rods of different diameters are planned apart: no bar holds two of them. Rods that taper
//! alike count as of one diameter.

mod bound;
mod columns;
mod finish;
mod heuristic;
mod knapsack;
mod plan;
mod search;
mod simplex;
mod stock;
mod task;
mod work;

pub use plan::{Aim, Bar, BarGroup, CutPlan, Piece, Purchase};
pub use stock::{CutError, Offer, Stock};

use super::lengths::{Stick, thinner};
use crate::frame::measure::SAME_LENGTH;
use crate::ids::{IdVec, RodId};
use columns::{Cells, relax};
use finish::{Best, dives};
use heuristic::{best_fit, filled};
use search::search;
use task::{Kind, Load, Task};
use work::Work;

/// Plans how to saw rods from the stock, every diameter for itself, thin ones first. Counts are
/// of bars of each diameter.
///
/// # Errors
/// [`CutError`], if the stock is not usable, rods are longer than it, or there is not
/// enough of it.
pub fn plan(sticks: &IdVec<RodId, Stick>, stock: &Stock) -> Result<CutPlan, CutError> {
    plan_by(sticks, stock, Effort::Full)
}

/// As [`plan`], for some of the rods: those that are not sawn yet.
///
/// # Errors
/// As [`plan`].
pub fn plan_some(
    sticks: &IdVec<RodId, Stick>,
    rods: impl Iterator<Item = RodId>,
    stock: &Stock,
) -> Result<CutPlan, CutError> {
    plan_rods(rods.map(|rod| (rod, sticks[rod])).collect(), stock, Effort::Full)
}

/// How much is done for a good plan.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Effort {
    /// Best-fit decreasing alone.
    BestFit,
    /// All steps.
    Full,
}

/// As [`plan`], with more or less effort.
///
/// # Errors
/// As [`plan`].
pub fn plan_by(
    sticks: &IdVec<RodId, Stick>,
    stock: &Stock,
    effort: Effort,
) -> Result<CutPlan, CutError> {
    plan_rods(sticks.enumerate().map(|(r, s)| (r, *s)).collect(), stock, effort)
}

fn plan_rods(
    mut rods: Vec<(RodId, Stick)>,
    stock: &Stock,
    effort: Effort,
) -> Result<CutPlan, CutError> {
    stock.check()?;
    rods.sort_by(|a, b| thinner(&a.1.diameters, &b.1.diameters).then(a.0.cmp(&b.0)));
    let Stock { kerf, trim, keep, .. } = *stock;
    let aim = aim(stock);
    let (bars, bound, spent, least) = (Vec::new(), 0, 0.0, 0.0);
    let mut plan = CutPlan { kerf, trim, keep, bars, bound, aim, spent, least };
    let mixed = rods.first().map(|r| r.1.diameters) != rods.last().map(|r| r.1.diameters);
    for alike in rods.chunk_by(|a, b| a.1.diameters == b.1.diameters) {
        let diameters = alike[0].1.diameters;
        let named = (mixed || stock.bars.iter().any(|b| b.diameter.is_some())).then_some(diameters);
        let bars = stock.bars.iter().copied().filter(|b| b.is_for(diameters)).collect();
        let stock = Stock { bars, ..stock.clone() };
        if let Some(e) = stock::too_long(alike, &stock, named) {
            return Err(e);
        }
        let batch = Batch::new(alike, &stock, aim);
        let found = batch.plan(effort);
        batch.require(&found, named)?;
        plan.bars.extend(batch.bars(&found.loads, &stock, diameters));
        plan.bound += found.bars;
        plan.spent += found.cost;
        plan.least += found.least;
    }
    if aim == Aim::Bars {
        plan.least = plan.least.round();
        plan.bound = plan.bound.max(plan.least as usize);
    }
    Ok(plan)
}

/// What is made as small as possible.
fn aim(stock: &Stock) -> Aim {
    let mut sold = stock.bars.iter().filter(|b| !b.at_hand);
    match sold.next() {
        Some(first) if first.price.is_some() => Aim::Cost,
        Some(first) if sold.any(|b| (b.length - first.length).abs() > SAME_LENGTH) => Aim::Length,
        _ => Aim::Bars,
    }
}

/// Pieces of one diameter.
struct Batch<'a> {
    task: Task,
    /// The rods of each size, in the order of their numbers.
    rods: Vec<Vec<(RodId, f64)>>,
    /// The bars of each kind; none for those that are not there.
    offers: Vec<Option<&'a Offer>>,
}

/// A plan for pieces of one diameter.
struct Found {
    loads: Vec<Load>,
    cost: f64,
    /// No plan costs less.
    least: f64,
    /// No plan has fewer bars.
    bars: usize,
}

/// What a bar costs that is not there, in all the bars that could be needed: a plan that does
/// without is cheaper than any that has one.
const BEYOND: f64 = 1.0;

impl<'a> Batch<'a> {
    fn new(pieces: &[(RodId, Stick)], stock: &'a Stock, aim: Aim) -> Self {
        let kerf = stock.kerf;
        // Lengths that differ by noise only count as equal, so that they are sawn in the
        // order of their numbers.
        let steps = |l: f64| (l / SAME_LENGTH).round();
        let mut pieces: Vec<(RodId, f64)> = pieces.iter().map(|(r, s)| (*r, s.length)).collect();
        pieces.sort_by(|a, b| steps(b.1).total_cmp(&steps(a.1)).then(a.0.cmp(&b.0)));
        let alike = |a: &(RodId, f64), b: &(RodId, f64)| steps(a.1) == steps(b.1);
        let rods: Vec<Vec<(RodId, f64)>> = pieces.chunk_by(alike).map(<[_]>::to_vec).collect();
        let longest = |rods: &Vec<(RodId, f64)>| rods.iter().map(|r| r.1).fold(0.0, f64::max);
        let sizes: Vec<f64> = rods.iter().map(|r| longest(r) + kerf).collect();
        let demand = rods.iter().map(Vec::len).collect();

        let cost = |offer: &Offer| match (offer.at_hand, aim) {
            (true, _) => 0.0,
            (_, Aim::Bars) => 1.0,
            (_, Aim::Length) => offer.length,
            (_, Aim::Cost) => offer.price.unwrap_or(0.0),
        };
        let kind = |o: &Offer| Kind { room: stock.room(o) + kerf, cost: cost(o), count: o.count };
        let mut kinds: Vec<Kind> = stock.bars.iter().map(kind).collect();
        let mut offers: Vec<Option<&Offer>> = stock.bars.iter().map(Some).collect();
        let step = step_of(kinds.iter().map(|k| k.cost));
        let holds_all = |k: &Kind| stock::fits(sizes[0], k.room);
        if !kinds.iter().any(|k| k.count.is_none() && holds_all(k)) {
            let dearest = kinds.iter().map(|k| k.cost).fold(0.0, f64::max);
            let dearest = if dearest > 0.0 { dearest } else { 1.0 };
            let cost = (pieces.len() as f64 + BEYOND) * dearest;
            kinds.push(Kind { room: sizes[0], cost, count: None });
            offers.push(None);
        }
        Self { task: Task { sizes, demand, kinds, step }, rods, offers }
    }

    fn plan(&self, effort: Effort) -> Found {
        let task = &self.task;
        let bars = bound::least_bars(task);
        let one = task.kinds.len() == 1;
        // Where all bars are alike, bars and cost say the same.
        let mut least = if one { bars as f64 * task.kinds[0].cost } else { 0.0 };
        let each = || task.demand.iter().enumerate().flat_map(|(i, &n)| (0..n).map(move |_| i));
        let loads = best_fit(task).unwrap_or_else(|| {
            // Only if no kind of bar holds a piece, and one always does.
            let kind = task.kinds.len() - 1;
            each().map(|i| Load { kind, pieces: vec![(i, 1)] }).collect()
        });
        let mut best = Best { cost: task.cost(&loads), loads };
        if effort == Effort::Full && !task.is_met(best.cost, least) {
            least = least.max(improve(task, &mut best, least));
        }
        let bars = if one { (least / task.kinds[0].cost).round() as usize } else { bars };
        best.loads.sort_by(|a, b| {
            let key = |l: &Load| (task.kinds[l.kind].cost > 0.0, l.kind);
            let first = |l: &Load| l.pieces.iter().map(|&(i, n)| (i, usize::MAX - n)).collect();
            let (one, other): (Vec<_>, Vec<_>) = (first(a), first(b));
            key(a).0.cmp(&key(b).0).then(one.cmp(&other)).then(key(a).1.cmp(&key(b).1))
        });
        Found { least: least.min(best.cost), cost: best.cost, loads: best.loads, bars }
    }

    /// Refuses a plan with bars that are not there.
    fn require(&self, found: &Found, diameters: Option<[f64; 2]>) -> Result<(), CutError> {
        let missing = |load: &&Load| self.offers[load.kind].is_none();
        let mut counts = vec![0; self.rods.len()];
        for load in found.loads.iter().filter(missing) {
            load.pieces.iter().for_each(|&(i, n)| counts[i] += n);
        }
        let short = |(rods, &n): (&Vec<(RodId, f64)>, &usize)| rods[rods.len() - n..].to_vec();
        let mut left: Vec<(RodId, f64)> = self.rods.iter().zip(&counts).flat_map(short).collect();
        if left.is_empty() {
            return Ok(());
        }
        left.sort_by_key(|l| l.0);
        let length = left.iter().map(|l| l.1).sum::<f64>() / 1e3;
        let beyond = self.task.kinds.last().map_or(0.0, |k| k.cost);
        let certain = found.least > beyond - 0.5 * self.task.improvement();
        let rods = left.into_iter().map(|l| l.0).collect();
        Err(CutError::NotEnough { rods, length, diameters, certain })
    }

    /// The bars of these loads; rods of a size are taken in the order of their numbers.
    fn bars(&self, loads: &[Load], stock: &Stock, diameters: [f64; 2]) -> Vec<Bar> {
        let mut next: Vec<_> = self.rods.iter().map(|rods| rods.iter()).collect();
        let bar = |load: &Load| {
            let offer = self.offers[load.kind]?;
            let mut pieces = Vec::new();
            let trim = stock.first_trim(offer.at_hand);
            let mut at = trim - stock.kerf;
            for &(size, count) in &load.pieces {
                for &(rod, length) in next[size].by_ref().take(count) {
                    at += stock.kerf + length;
                    pieces.push(Piece { rod, length, stop: at });
                }
            }
            let beyond = offer.length - at;
            let left = if beyond <= stock.kerf + SAME_LENGTH { 0.0 } else { beyond - stock.kerf };
            Some(Bar {
                stock_length: offer.length,
                diameters,
                pieces,
                left,
                at_hand: offer.at_hand,
                price: if offer.at_hand { None } else { offer.price },
                trimmed: trim > 0.0,
            })
        };
        loads.iter().filter_map(bar).collect()
    }
}

/// Looks for better plans than the best so far; gives what a plan costs at least.
fn improve(task: &Task, best: &mut Best, least: f64) -> f64 {
    let (cells, mut work) = (Cells::new(task), Work::default());
    if let Some(loads) = filled(task, &cells.safe, &mut work) {
        best.offer(task, loads);
    }
    if task.is_met(best.cost, least) {
        return least;
    }
    let least = least.max(bound::cheapest_cover(task, &cells.fullest(task)));
    if task.is_met(best.cost, least) {
        return least;
    }
    let relaxed = relax(task, &cells, best.loads.clone(), best.cost, &mut work);
    let bound = least.max(task.rounded_up(relaxed.bound));
    if task.is_met(best.cost, bound) {
        return bound;
    }
    dives(task, &cells, &relaxed, best, bound, &mut work);
    if !task.is_met(best.cost, bound) && search(task, &relaxed, bound, best) {
        return best.cost;
    }
    bound
}

/// Prices and lengths are taken to be multiples of this where they are.
const FINEST_COST: f64 = 1e-4;

/// The largest number that all of these are multiples of; none if there is no such that is
/// written with four decimals.
fn step_of(costs: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let mut paid: Vec<f64> = costs.filter(|&c| c > 0.0).collect();
    paid.dedup();
    if let [one] = paid[..] {
        return Some(one);
    }
    let whole = |c: &f64| {
        let n = (c / FINEST_COST).round();
        ((n * FINEST_COST - c).abs() <= 1e-9 * c && n < 1e15).then_some(n as u64)
    };
    let whole: Option<Vec<u64>> = paid.iter().map(whole).collect();
    Some(whole?.into_iter().reduce(knapsack::divisor)? as f64 * FINEST_COST)
}

#[cfg(test)]
mod tests;
