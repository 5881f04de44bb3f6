//! Quick plans: best-fit decreasing, and bars filled one after the other.

use super::knapsack::Knapsack;
use super::stock::fits;
use super::task::{Load, Task, take_one};
use super::work::Work;
use crate::frame::measure::SAME_LENGTH;

/// Best-fit decreasing: pieces go, longest first, where the least room remains. Where none
/// has room, a bar is begun: an offcut, the shortest that holds the piece, or else a bar of one
/// kind, or else the cheapest that is left. Then each bar becomes the cheapest that holds
/// it. This is tried with every kind to begin with; the cheapest plan is given. None if the
/// bars do not suffice.
pub fn best_fit(task: &Task) -> Option<Vec<Load>> {
    let mut begins: Vec<usize> = (0..task.kinds.len()).collect();
    begins.sort_by(|&a, &b| task.kinds[b].room.total_cmp(&task.kinds[a].room));
    let mut best: Option<(f64, Vec<Load>)> = None;
    for begin in begins {
        let Some(loads) = best_fit_from(task, begin) else { continue };
        let loads = task.on_cheapest(loads);
        let cost = task.cost(&loads);
        if best.as_ref().is_none_or(|b| cost < b.0 - 0.5 * task.improvement()) {
            best = Some((cost, loads));
        }
    }
    best.map(|b| b.1)
}

/// A bar that pieces can still go into.
struct Open {
    load: Load,
    /// Room that is left, mm.
    room: f64,
}

fn best_fit_from(task: &Task, begin: usize) -> Option<Vec<Load>> {
    let order = opening_order(task, begin);
    let mut left = task.counts_after(&[]);
    let mut bars: Vec<Open> = Vec::new();
    for (i, &size) in task.sizes.iter().enumerate() {
        for _ in 0..task.demand[i] {
            let tightest = bars
                .iter_mut()
                .filter(|bar| fits(size, bar.room))
                .reduce(|a, b| if b.room < a.room - SAME_LENGTH { b } else { a });
            if let Some(bar) = tightest {
                add(&mut bar.load.pieces, i);
                bar.room -= size;
                continue;
            }
            let has = |k: &&usize| left[**k] != Some(0) && fits(size, task.kinds[**k].room);
            let &kind = order.iter().find(has)?;
            take_one(&mut left[kind]);
            let room = task.kinds[kind].room - size;
            bars.push(Open { load: Load { kind, pieces: vec![(i, 1)] }, room });
        }
    }
    Some(bars.into_iter().map(|bar| bar.load).collect())
}

/// The kinds in the order in which bars are begun: what is free, shortest first; the kind to
/// begin with; the others, cheap ones first.
fn opening_order(task: &Task, begin: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..task.kinds.len()).collect();
    let key = |k: usize| (task.kinds[k].cost > 0.0, task.kinds[k].cost > 0.0 && k != begin);
    order.sort_by(|&a, &b| {
        let [one, other] = [task.kinds[a], task.kinds[b]];
        let by_cost = one.cost.total_cmp(&other.cost).then(one.room.total_cmp(&other.room));
        key(a).cmp(&key(b)).then(by_cost)
    });
    order
}

fn add(pieces: &mut Vec<(usize, usize)>, size: usize) {
    match pieces.iter_mut().find(|p| p.0 == size) {
        Some(piece) => piece.1 += 1,
        None => pieces.push((size, 1)),
    }
}

/// Most entries of tables that [`filled`] fills; more would take a second.
const MOST_ENTRIES: usize = 500_000_000;

/// Fills one bar after the other as full as it goes: the longest piece left, and of the
/// others those that leave least of the bar. Of the kinds of bars it takes the one that costs
/// least for what it holds. None if the bars do not suffice, or it would take too long.
pub fn filled(task: &Task, knapsack: &Knapsack, work: &mut Work) -> Option<Vec<Load>> {
    // Tables get smaller with the pieces left: half the first one in the mean.
    let all: Vec<(usize, usize)> = task.demand.iter().copied().enumerate().collect();
    let longest = task.kinds.iter().map(|k| k.room).fold(0.0, f64::max);
    let bars = (task.taken(&all) / longest).ceil() as usize;
    let needed = bars.saturating_mul(knapsack.entries(&task.demand) / 2);
    if needed > MOST_ENTRIES || !work.spend(needed) {
        return None;
    }
    let mut rest = task.demand.clone();
    let mut left = task.counts_after(&[]);
    let mut loads = Vec::new();
    while let Some(first) = rest.iter().position(|&n| n > 0) {
        rest[first] -= 1;
        let table = knapsack.table(&task.sizes, &rest);
        let mut best: Option<(f64, Load)> = None;
        for (k, kind) in task.kinds.iter().enumerate() {
            if left[k] == Some(0) || !fits(task.sizes[first], kind.room) {
                continue;
            }
            let mut pieces = table.load(knapsack.cells_beside(k, first));
            add(&mut pieces, first);
            pieces.sort_unstable();
            let price = kind.cost / task.taken(&pieces);
            if best.as_ref().is_none_or(|b| price < b.0) {
                best = Some((price, Load { kind: k, pieces }));
            }
        }
        let (_, load) = best?;
        rest[first] += 1;
        load.pieces.iter().for_each(|&(i, n)| rest[i] -= n);
        take_one(&mut left[load.kind]);
        loads.push(load);
    }
    Some(task.on_cheapest(loads))
}
