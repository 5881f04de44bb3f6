//! Few lengths for all rods: some get a little more overhang, so that they are as long as
//! others. No contact moves.
//!
//! Sorted by length, the rods that share one are neighbours, and it is that of the longest of
//! them. So the lengths are chosen by dynamic programming over the sorted lengths: the least
//! extra material for so many lengths, or the fewest lengths with so much extra for a rod at most.
//!
//! Some rods keep their length: those that taper, whose diameters at the contacts would
//! change, and those that meet others with both ends. A rod that stands grows at its upper
//! end alone. Where a longer rod would run into another or into the ground, it keeps
//! its own length.

use super::axis::Axis;
use super::clash::clashes;
use super::cut::shares;
use super::measure::SAME_LENGTH;
use super::trim::Trimmed;
use super::weave::{RodEnd, Weave};
use crate::ids::{IdVec, RodId};
use std::collections::BTreeSet;

/// How rods share lengths.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Share {
    /// Each has the length that it needs.
    #[default]
    Off,
    /// There are so many lengths.
    Classes(usize),
    /// As few lengths as possible when each rod gets longer by at most so much, mm.
    Tolerance(f64),
}

/// What sharing lengths came to.
#[derive(Clone, PartialEq, Debug)]
pub struct Shared {
    /// Different lengths before.
    pub before: usize,
    /// Different lengths after.
    pub after: usize,
    /// What all rods got longer together, mm.
    pub extra: f64,
    /// Rods that keep their length in any case: they taper, or meet others at both ends.
    pub kept: usize,
    /// Rods that keep their own length, since a longer one would run into another rod or into the
    /// ground.
    pub own: Vec<RodId>,
}

/// Lengthens trimmed rods so that they share lengths. `contacts` are the pairs of rods that
/// touch, `sizes` the diameters at end A and end B.
pub fn share(
    how: Share,
    weave: &Weave,
    trimmed: &mut Trimmed,
    sizes: &IdVec<RodId, [f64; 2]>,
    contacts: &BTreeSet<[RodId; 2]>,
) -> Option<Shared> {
    let stands: BTreeSet<RodId> = trimmed.supports.iter().map(|s| s.rod).collect();
    let ends = |r: RodId| match weave.rods[r].ends {
        // The foot stays where it is.
        [_, b] if stands.contains(&r) => [RodEnd::Meets, b],
        ends => ends,
    };
    let grows = |r: RodId| sizes[r][0] == sizes[r][1] && ends(r) != [RodEnd::Meets; 2];
    let axes = &mut trimmed.axes;
    let rods: Vec<(f64, bool)> = axes.enumerate().map(|(r, a)| (a.length(), grows(r))).collect();
    let kept = rods.iter().filter(|(_, grows)| !grows).count();
    let mut wanted: IdVec<RodId, f64> = shared_lengths(&rods, how)?.into();
    let mut own: BTreeSet<RodId> = BTreeSet::new();
    let alone = axes.clone();
    let (long, own) = loop {
        let mut long = alone.clone();
        for (r, axis) in alone.enumerate() {
            let extra = wanted[r] - axis.length();
            if extra > SAME_LENGTH {
                let [a, b] = shares(ends(r), extra);
                long[r] = axis.between(-a, axis.length() + b);
            }
        }
        let trouble = in_trouble(&long, &alone, sizes, contacts, trimmed.ground);
        if trouble.is_empty() {
            break (long, own);
        }
        trouble.iter().for_each(|&r| wanted[r] = alone[r].length());
        own.extend(trouble);
    };
    *axes = long;
    let count = |axes: &IdVec<RodId, Axis>| distinct(axes.iter().map(Axis::length).collect()).len();
    let total = |axes: &IdVec<RodId, Axis>| axes.iter().map(Axis::length).sum::<f64>();
    Some(Shared {
        before: count(&alone),
        after: count(axes),
        extra: total(axes) - total(&alone),
        kept,
        own: own.into_iter().collect(),
    })
}

/// The rods that got longer and run into others, or into the ground.
fn in_trouble(
    long: &IdVec<RodId, Axis>,
    alone: &IdVec<RodId, Axis>,
    sizes: &IdVec<RodId, [f64; 2]>,
    contacts: &BTreeSet<[RodId; 2]>,
    ground: f64,
) -> Vec<RodId> {
    let grown = |r: &RodId| long[*r].length() > alone[*r].length() + SAME_LENGTH;
    let low = |r: &RodId| long[*r].a.z.min(long[*r].b.z) < ground - SAME_LENGTH;
    let clashing = clashes(long, sizes, contacts).into_iter().flat_map(|clash| clash.rods);
    let sunk = long.ids().filter(low);
    let all: BTreeSet<RodId> = clashing.chain(sunk).filter(grown).collect();
    all.into_iter().collect()
}

/// Lengths that differ by more than noise, shortest first.
fn distinct(mut lengths: Vec<f64>) -> Vec<f64> {
    lengths.sort_by(f64::total_cmp);
    lengths.dedup_by(|b, a| *b - *a <= SAME_LENGTH);
    lengths
}

/// The length that each rod gets, of rods that are so long and may or may not get longer; none
/// if they keep theirs.
pub fn shared_lengths(rods: &[(f64, bool)], how: Share) -> Option<Vec<f64>> {
    let mut order: Vec<usize> = (0..rods.len()).collect();
    order.sort_by(|&a, &b| rods[a].0.total_cmp(&rods[b].0).then(a.cmp(&b)));
    let same: Vec<&[usize]> =
        order.chunk_by(|&a, &b| rods[b].0 - rods[a].0 <= SAME_LENGTH).collect();
    let steps: Vec<Step> = same
        .iter()
        .map(|chunk| Step {
            length: rods[chunk[chunk.len() - 1]].0,
            count: chunk.len() as f64,
            fixed: chunk.iter().any(|&r| !rods[r].1),
        })
        .collect();
    let ends = match how {
        Share::Off => return None,
        Share::Classes(n) => least_extra(&steps, n),
        Share::Tolerance(tolerance) => fewest(&steps, tolerance),
    };
    let mut lengths: Vec<f64> = rods.iter().map(|r| r.0).collect();
    let mut from = 0;
    for end in ends {
        for &r in same[from..=end].iter().copied().flatten() {
            lengths[r] = steps[end].length;
        }
        from = end + 1;
    }
    Some(lengths)
}

/// Rods of one length.
struct Step {
    length: f64,
    count: f64,
    /// Whether some of them keep it.
    fixed: bool,
}

/// The lengths that `classes` classes of least extra material end at; more classes where more
/// lengths are fixed.
///
/// With N and S the numbers and sums of lengths before a step, the class from step i to j has
/// the extra ℓ_j (N_{j+1} − N_i) − (S_{j+1} − S_i). For each j the best i is the lowest of
/// lines over ℓ_j of slope −N_i: their lower envelope is walked as ℓ_j grows.
fn least_extra(steps: &[Step], classes: usize) -> Vec<usize> {
    let m = steps.len();
    let most = classes.min(m).max(steps[..m.max(1) - 1].iter().filter(|s| s.fixed).count() + 1);
    if most >= m {
        return (0..m).collect();
    }
    let (counts, sums) = sums_before(steps);
    let mut extra = vec![f64::INFINITY; m + 1];
    extra[0] = 0.0;
    let mut from: Vec<Vec<u32>> = Vec::new();
    for _ in 0..most {
        let mut next = vec![f64::INFINITY; m + 1];
        let mut start = vec![0_u32; m + 1];
        let mut lines = Envelope::default();
        for (j, step) in steps.iter().enumerate() {
            if j > 0 && steps[j - 1].fixed {
                lines = Envelope::default();
            }
            if extra[j].is_finite() {
                lines.add(Line { slope: -counts[j], height: extra[j] + sums[j], from: j });
            }
            if let Some((least, i)) = lines.least(step.length) {
                next[j + 1] = least + step.length * counts[j + 1] - sums[j + 1];
                start[j + 1] = i as u32;
            }
        }
        extra = next;
        from.push(start);
    }
    let mut ends = Vec::new();
    let mut at = m;
    for start in from.iter().rev() {
        ends.push(at - 1);
        at = start[at] as usize;
    }
    ends.reverse();
    ends
}

/// How many rods there are before each step, and the sum of their lengths.
fn sums_before(steps: &[Step]) -> (Vec<f64>, Vec<f64>) {
    let (mut counts, mut sums) = (vec![0.0], vec![0.0]);
    for (i, step) in steps.iter().enumerate() {
        counts.push(counts[i] + step.count);
        sums.push(sums[i] + step.count * step.length);
    }
    (counts, sums)
}

#[derive(Clone, Copy)]
struct Line {
    slope: f64,
    height: f64,
    from: usize,
}

impl Line {
    fn at(&self, x: f64) -> f64 {
        self.slope * x + self.height
    }
}

/// The lowest of lines whose slopes fall, asked for at places that rise.
#[derive(Default)]
struct Envelope {
    lines: Vec<Line>,
    first: usize,
}

impl Envelope {
    fn add(&mut self, line: Line) {
        // Where one line meets another that is less steep.
        let meets = |a: &Line, b: &Line| (b.height - a.height) / (a.slope - b.slope);
        while let [.., a, b] = &self.lines[self.first..] {
            if meets(b, &line) > meets(a, b) {
                break;
            }
            self.lines.pop();
        }
        self.lines.push(line);
    }

    fn least(&mut self, x: f64) -> Option<(f64, usize)> {
        while let [a, b, ..] = &self.lines[self.first..] {
            if b.at(x) > a.at(x) {
                break;
            }
            self.first += 1;
        }
        self.lines.get(self.first).map(|line| (line.at(x), line.from))
    }
}

/// The lengths that the fewest classes end at in which no rod gets longer by more than the
/// tolerance; of several ways the one with the least extra material.
fn fewest(steps: &[Step], tolerance: f64) -> Vec<usize> {
    let (counts, sums) = sums_before(steps);
    // The classes and the extra of the first steps, and where their last class begins.
    let mut best: Vec<(usize, f64, usize)> = vec![(0, 0.0, 0)];
    for (j, end) in steps.iter().enumerate() {
        let mut least = (usize::MAX, f64::INFINITY, j);
        for i in (0..=j).rev() {
            let far = end.length - steps[i].length > tolerance + SAME_LENGTH;
            if i < j && (far || steps[i].fixed) {
                break;
            }
            let extra = end.length * (counts[j + 1] - counts[i]) - (sums[j + 1] - sums[i]);
            let (classes, before, _) = best[i];
            let way = (classes + 1, before + extra, i);
            if way.0 < least.0 || (way.0 == least.0 && way.1 < least.1 - SAME_LENGTH) {
                least = way;
            }
        }
        best.push(least);
    }
    let mut ends = Vec::new();
    let mut at = steps.len();
    while at > 0 {
        ends.push(at - 1);
        at = best[at].2;
    }
    ends.reverse();
    ends
}

#[cfg(test)]
#[path = "share_tests.rs"]
mod tests;
