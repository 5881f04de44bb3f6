//! The task in short: sizes of pieces, how many of each, and kinds of bars.

use super::stock::fits;

/// Pieces to saw and bars to saw them from. A piece of length ℓ takes ℓ + k of a bar with
/// room L − 2t + k: k is what a cut takes, t the trim, of which an offcut loses one.
#[derive(Clone, Debug)]
pub struct Task {
    /// ℓ + k of the pieces, longest first, each size once, mm.
    pub sizes: Vec<f64>,
    /// How many pieces there are of each size.
    pub demand: Vec<usize>,
    /// The bars.
    pub kinds: Vec<Kind>,
    /// All costs are multiples of this; none if no such number is known.
    pub step: Option<f64>,
}

/// A kind of bar.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// L − 2t + k, mm.
    pub room: f64,
    /// What one costs.
    pub cost: f64,
    /// How many there are; none for as many as needed.
    pub count: Option<usize>,
}

/// How one bar is sawn: how many pieces of which sizes, longest first.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Load {
    /// The kind of bar.
    pub kind: usize,
    /// Sizes, with how many pieces of each.
    pub pieces: Vec<(usize, usize)>,
}

/// A cost less than this above a multiple of the step, in steps, counts as that multiple:
/// noise must not round a bound up. Larger, and bounds are lost; smaller, and they are wrong.
const SAME_STEPS: f64 = 1e-6;

impl Task {
    /// What bars cost together.
    pub fn cost(&self, loads: &[Load]) -> f64 {
        loads.iter().map(|load| self.kinds[load.kind].cost).sum()
    }

    /// The least cost that a plan can have which costs no less than `bound`.
    pub fn rounded_up(&self, bound: f64) -> f64 {
        match self.step {
            Some(step) => ((bound / step - SAME_STEPS).ceil() * step).max(0.0),
            None => bound,
        }
    }

    /// How much less a better plan costs at least.
    pub fn improvement(&self) -> f64 {
        let dearest = self.kinds.iter().map(|k| k.cost).fold(0.0, f64::max);
        self.step.unwrap_or(SAME_STEPS * dearest)
    }

    /// Whether a plan of this cost can be no better than by noise than the bound.
    pub fn is_met(&self, cost: f64, bound: f64) -> bool {
        cost < bound + 0.5 * self.improvement()
    }

    /// What pieces take of a bar, mm.
    pub fn taken(&self, pieces: &[(usize, usize)]) -> f64 {
        pieces.iter().map(|&(i, n)| self.sizes[i] * n as f64).sum()
    }

    /// Whether a kind of bar holds these pieces.
    pub fn holds(&self, kind: usize, pieces: &[(usize, usize)]) -> bool {
        fits(self.taken(pieces), self.kinds[kind].room)
    }

    /// The kinds of bar that are left when these are used; none for as many as needed.
    pub fn counts_after(&self, loads: &[Load]) -> Vec<Option<usize>> {
        let mut left: Vec<Option<usize>> = self.kinds.iter().map(|k| k.count).collect();
        for load in loads {
            take_one(&mut left[load.kind]);
        }
        left
    }

    /// Each bar as the cheapest one that holds its pieces.
    pub fn on_cheapest(&self, mut loads: Vec<Load>) -> Vec<Load> {
        let mut left = self.counts_after(&loads);
        let mut order: Vec<usize> = (0..self.kinds.len()).collect();
        let by = |a: &usize, b: &usize| {
            let [a, b] = [self.kinds[*a], self.kinds[*b]];
            a.cost.total_cmp(&b.cost).then(a.room.total_cmp(&b.room))
        };
        order.sort_by(by);
        for load in &mut loads {
            let better = order
                .iter()
                .take_while(|&&k| k != load.kind)
                .find(|&&k| left[k] != Some(0) && self.holds(k, &load.pieces));
            if let Some(&kind) = better {
                if let Some(n) = &mut left[load.kind] {
                    *n += 1;
                }
                take_one(&mut left[kind]);
                load.kind = kind;
            }
        }
        loads
    }
}

/// One bar fewer of a kind; of those without a count there are always more.
pub fn take_one(left: &mut Option<usize>) {
    if let Some(n) = left {
        *n = n.saturating_sub(1);
    }
}
