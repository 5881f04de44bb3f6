//! The exact end: bars are tried one after the other, led by the prices of the relaxed
//! solution, until a plan meets the bound, all is tried, or too much was tried.

use super::columns::{Prices, Relaxed};
use super::finish::Best;
use super::stock::fits;
use super::task::{Load, Task, take_one};

/// Most steps of a search. More, and large frames take seconds; fewer, and small ones
/// are left unproven. Steps are counted, not seconds: the same plan comes on every machine.
const MOST_STEPS: usize = 400_000;
/// Most loads of one bar that are tried side by side.
const MOST_LOADS: usize = 4000;

/// Looks for a better plan than the best so far. Gives true where there is none besides the one
/// that is then the best. No plan costs less than `bound`.
///
/// The longest piece left lies in some bar, and adding pieces to a bar does no harm while
/// they fit: so every full load with that piece is tried, in the order of what it costs beyond what
/// its pieces are worth. The sum of these excesses over a plan is what it costs above the
/// bound, so loads that would take it to the best plan so far are left out.
pub fn search(task: &Task, relaxed: &Relaxed, bound: f64, best: &mut Best) -> bool {
    let prices = &relaxed.prices;
    let smallest = task.sizes.len();
    let mut densest = vec![0.0_f64; smallest + 1];
    for i in (0..smallest).rev() {
        densest[i] = densest[i + 1].max(prices.pieces[i] / task.sizes[i]);
    }
    let rest = task.demand.clone();
    let left = task.counts_after(&[]);
    let mut search =
        Search { task, prices, densest, best, bound, rest, left, loads: Vec::new(), steps: 0 };
    search.complete(relaxed.bound)
}

struct Search<'a> {
    task: &'a Task,
    prices: &'a Prices,
    /// The most that a mm of these and all smaller pieces is worth.
    densest: Vec<f64>,
    best: &'a mut Best,
    bound: f64,
    /// Pieces left of each size.
    rest: Vec<usize>,
    /// Bars left of each kind.
    left: Vec<Option<usize>>,
    loads: Vec<Load>,
    steps: usize,
}

/// Loads of one kind of bar, as they are put together.
struct Filling {
    kind: usize,
    /// Most that a bar may cost beyond what its pieces are worth.
    most: f64,
    pieces: Vec<(usize, usize)>,
    found: Vec<(f64, Load)>,
}

/// A better plan is better by so much of the least that it can be better by; the rest is for
/// noise.
const ENOUGH: f64 = 0.999;

impl Search<'_> {
    /// Tries all bars for the pieces left. `floor` is what a plan with the bars so far costs at
    /// least. False where something was left out.
    fn complete(&mut self, floor: f64) -> bool {
        let Some(first) = self.rest.iter().position(|&n| n > 0) else {
            self.best.offer(self.task, self.task.on_cheapest(self.loads.clone()));
            return true;
        };
        let Some(loads) = self.full_loads(first, floor) else { return false };
        for (excess, load) in loads {
            if self.is_done() || !self.may_be_better(floor + excess) {
                break;
            }
            let before = self.left[load.kind];
            take_one(&mut self.left[load.kind]);
            load.pieces.iter().for_each(|&(i, n)| self.rest[i] -= n);
            self.loads.push(load);
            let complete = self.complete(floor + excess);
            if let Some(load) = self.loads.pop() {
                load.pieces.iter().for_each(|&(i, n)| self.rest[i] += n);
                self.left[load.kind] = before;
            }
            if !complete {
                return false;
            }
        }
        true
    }

    /// Whether no plan can be better than the best.
    fn is_done(&self) -> bool {
        self.task.is_met(self.best.cost, self.bound)
    }

    fn may_be_better(&self, floor: f64) -> bool {
        !self.task.is_met(self.best.cost, self.task.rounded_up(floor))
    }

    /// All full loads with the piece `first` that may lead to a better plan, the best first;
    /// none if there are too many.
    fn full_loads(&mut self, first: usize, floor: f64) -> Option<Vec<(f64, Load)>> {
        let mut found = Vec::new();
        for kind in 0..self.task.kinds.len() {
            let bar = self.task.kinds[kind];
            if self.left[kind] == Some(0) || !fits(self.task.sizes[first], bar.room) {
                continue;
            }
            let most = self.best.cost - ENOUGH * self.task.improvement() - floor;
            let mut filling = Filling { kind, most, pieces: Vec::new(), found };
            let room = bar.room - self.task.sizes[first];
            let excess = bar.cost + self.prices.bars[kind] - self.prices.pieces[first];
            self.rest[first] -= 1;
            filling.pieces.push((first, 1));
            let complete = self.fill(&mut filling, first, room, excess);
            self.rest[first] += 1;
            found = filling.found;
            if !complete {
                return None;
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
        Some(found)
    }

    /// Adds pieces of size `from` and smaller until no piece left has room.
    fn fill(&mut self, filling: &mut Filling, from: usize, room: f64, excess: f64) -> bool {
        self.steps += 1;
        if self.steps > MOST_STEPS || filling.found.len() > MOST_LOADS {
            return false;
        }
        if excess - room.max(0.0) * self.densest[from] > filling.most {
            return true;
        }
        let next =
            (from..self.rest.len()).find(|&i| self.rest[i] > 0 && fits(self.task.sizes[i], room));
        let Some(i) = next else {
            self.finish_load(filling, excess, room);
            return true;
        };
        let size = self.task.sizes[i];
        let most = (1..=self.rest[i]).take_while(|&n| fits(size * n as f64, room)).count();
        for n in (0..=most).rev() {
            if n > 0 {
                filling.pieces.push((i, n));
            }
            let used = size * n as f64;
            self.rest[i] -= n;
            let worth = self.prices.pieces[i] * n as f64;
            let complete = self.fill(filling, i + 1, room - used, excess - worth);
            self.rest[i] += n;
            if n > 0 {
                filling.pieces.pop();
            }
            if !complete {
                return false;
            }
        }
        true
    }

    /// Keeps a load, if no piece that was passed over would still fit.
    fn finish_load(&self, filling: &mut Filling, excess: f64, room: f64) {
        let last = self.rest.iter().rposition(|&n| n > 0);
        if last.is_some_and(|i| fits(self.task.sizes[i], room)) {
            return;
        }
        let mut pieces: Vec<(usize, usize)> = Vec::with_capacity(filling.pieces.len());
        for &(i, n) in &filling.pieces {
            match pieces.last_mut().filter(|p| p.0 == i) {
                Some(piece) => piece.1 += n,
                None => pieces.push((i, n)),
            }
        }
        filling.found.push((excess, Load { kind: filling.kind, pieces }));
    }
}
