//! What a plan needs at least: the bound L2 of Martello and Toth (*Knapsack Problems*, 1990,
//! section 8.3) on the number of bars, which is never below ⌈Σ(ℓ + k)/(L − 2t + k)⌉, and the
//! cheapest whole bars that have the length of all pieces.

use super::task::Task;
use crate::frame::measure::SAME_LENGTH;

/// The least number of bars for the pieces of a task, if all were as long as the longest.
pub fn least_bars(task: &Task) -> usize {
    let each = task.sizes.iter().zip(&task.demand);
    let sizes: Vec<f64> = each.flat_map(|(&s, &n)| std::iter::repeat_n(s, n)).collect();
    bound(&sizes, task.kinds.iter().map(|k| k.room).fold(0.0, f64::max))
}

/// The least number of bars for pieces of `sizes` (longest first) with `room` each.
///
/// L2 is the largest value over α of |N1| + |N2| + ⌈(Σ N3 − free(N2)) / room⌉: N1 is
/// longer than room − α, N2 than room/2, N3 is at least α; pieces of N3 can only lie
/// beside N2 or in bars of their own. α = 0 gives the plain bound.
fn bound(sizes: &[f64], room: f64) -> usize {
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(sizes.iter().scan(0.0, |sum, s| {
            *sum += s;
            Some(*sum)
        }))
        .collect();
    let longer = |than: f64| sizes.partition_point(|&s| s > than + SAME_LENGTH);
    let half = longer(room / 2.0);
    let at = |alpha: f64| {
        let first = longer(room - alpha).min(half);
        let end = sizes.partition_point(|&s| s >= alpha - SAME_LENGTH).max(half);
        let free = (half - first) as f64 * room - (sums[half] - sums[first]);
        let extra = (sums[end] - sums[half] - free) / room;
        // Noise must not round a full bar up to two.
        half + (extra - SAME_LENGTH).ceil().max(0.0) as usize
    };
    sizes[half..].iter().map(|&alpha| at(alpha)).chain([at(0.0)]).max().unwrap_or(0)
}

/// Most steps of [`cheapest_cover`]; a few kinds of bars take some hundred.
const MOST_STEPS: usize = 200_000;

/// The least cost of whole bars that are as long together as all pieces, or less than that if it
/// cannot be found in a few steps. A bar counts with the most that pieces fill of it, `filled`, mm.
pub fn cheapest_cover(task: &Task, filled: &[f64]) -> f64 {
    let all: f64 = task.sizes.iter().zip(&task.demand).map(|(s, &n)| s * n as f64).sum();
    let mut order: Vec<usize> = (0..task.kinds.len()).filter(|&k| filled[k] > 0.0).collect();
    let each = |k: usize| task.kinds[k].cost / filled[k];
    order.sort_by(|&a, &b| each(a).total_cmp(&each(b)).then(a.cmp(&b)));
    let bars = order.iter().map(|&k| (filled[k], task.kinds[k].cost, task.kinds[k].count));
    let mut cover = Cover { bars: bars.collect(), best: f64::INFINITY, steps: 0 };
    // Pieces and bars carry noise, which must not ask for one more bar.
    cover.choose(0, all - SAME_LENGTH * (1.0 + task.demand.iter().sum::<usize>() as f64), 0.0);
    if cover.steps > MOST_STEPS || !cover.best.is_finite() { 0.0 } else { cover.best }
}

/// The search for the cheapest bars.
struct Cover {
    /// What each kind holds, costs, and how many there are, cheap ones by length first.
    bars: Vec<(f64, f64, Option<usize>)>,
    best: f64,
    steps: usize,
}

impl Cover {
    /// Chooses how many bars there are of kind `from` and later ones.
    fn choose(&mut self, from: usize, needed: f64, cost: f64) {
        if needed <= 0.0 {
            self.best = self.best.min(cost);
            return;
        }
        self.steps += 1;
        let Some(&(hold, each, count)) = self.bars.get(from) else { return };
        if self.steps > MOST_STEPS || cost + needed * each / hold >= self.best {
            return;
        }
        let most = (needed / hold).ceil() as usize;
        for n in (0..=count.map_or(most, |count| most.min(count))).rev() {
            self.choose(from + 1, needed - n as f64 * hold, cost + n as f64 * each);
        }
    }
}
