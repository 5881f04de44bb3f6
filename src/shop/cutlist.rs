//! The sawing plan: which pieces are sawn from which bar.
//!
//! A bar of length L holds pieces ℓ when Σℓ + k·(n − 1) ≤ L, with k the width of the
//! saw cut: what one cut takes lies between two pieces. That is bin packing of ℓ + k
//! into L + k. Pieces go longest first into the open bar that they fill best (best-fit
//! decreasing); then each bar becomes the shortest stock that holds it.
//!
//! The number of bars is compared with the bound L2 of Martello and Toth (*Knapsack
//! Problems*, 1990, section 8.3), which is never below ⌈Σ(ℓ + k)/(L + k)⌉. The plan is
//! proven where the two agree; where they do not, a better one may or may not exist.
//!
//! Rods of different diameters are planned apart: no bar holds two of them. Rods that taper
//! alike count as of one diameter.

use super::lengths::{Stick, thinner};
use crate::frame::measure::SAME_LENGTH;
use crate::ids::{IdVec, RodId};

/// What the builder can buy, and how wide the saw cuts.
#[derive(Clone, PartialEq, Debug)]
pub struct Stock {
    /// Bar lengths on offer, mm. As many bars of each as needed.
    pub lengths: Vec<f64>,
    /// Width of a saw cut, mm.
    pub kerf: f64,
}

/// A sawing plan.
#[derive(Clone, PartialEq, Debug)]
pub struct CutPlan {
    /// Width of a saw cut, mm.
    pub kerf: f64,
    /// The bars, in the order in which they were begun.
    pub bars: Vec<Bar>,
    /// No plan from the longest stock needs fewer bars.
    pub bound: usize,
}

/// Bars of one kind to buy.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Purchase {
    /// Diameters of the rods sawn from them, at end A and at end B, mm.
    pub diameters: [f64; 2],
    /// Length, mm.
    pub length: f64,
    /// How many.
    pub count: usize,
}

/// A bar of stock and what is sawn from it.
#[derive(Clone, PartialEq, Debug)]
pub struct Bar {
    /// Length as bought, mm.
    pub stock_length: f64,
    /// Diameters of its rods at end A and at end B, mm.
    pub diameters: [f64; 2],
    /// The pieces, from the bar's end on.
    pub pieces: Vec<Piece>,
    /// What is left over after the last cut, mm.
    pub left: f64,
}

/// A rod to be sawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Piece {
    /// The rod.
    pub rod: RodId,
    /// Its cut length, mm.
    pub length: f64,
    /// Where it ends on the bar, measured from the bar's end: the saw cuts just beyond.
    pub stop: f64,
}

/// Bars that are sawn alike.
#[derive(Clone, PartialEq, Debug)]
pub struct BarGroup<'a> {
    /// The bars; the first one shows the lengths and stops of all.
    pub bars: Vec<&'a Bar>,
}

/// Why there is no sawing plan.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum CutError {
    /// No stock is offered.
    #[error("there is no stock to saw rods from")]
    NoStock,
    /// A stock length is no length.
    #[error("a stock length of {0} mm is not a length above 0")]
    StockLength(f64),
    /// The saw cut is no width.
    #[error("a saw cut of {0} mm is not a width of 0 or more")]
    Kerf(f64),
    /// Some rods are longer than any bar.
    #[error("{} longer than the longest stock ({stock} mm); the longest needs {needed} mm", named(.rods))]
    TooLong {
        /// The rods that do not fit, in the order of their numbers.
        rods: Vec<RodId>,
        /// The longest stock on offer, mm.
        stock: f64,
        /// The least stock length that would hold all rods, mm.
        needed: f64,
    },
}

impl CutError {
    /// What the user can do about it.
    pub fn hint(&self) -> String {
        match self {
            Self::NoStock => "give at least one stock length".to_owned(),
            Self::StockLength(_) => "give stock lengths above 0".to_owned(),
            Self::Kerf(_) => "give the width of the saw cut, 0 or more".to_owned(),
            Self::TooLong { needed, .. } => {
                format!("use stock of at least {needed} mm, or shorter rods from smaller units")
            }
        }
    }
}

/// How many rods a message names before it only counts the rest.
const NAMED: usize = 8;

fn named(rods: &[RodId]) -> String {
    let names: Vec<_> = rods.iter().take(NAMED).map(RodId::to_string).collect();
    let verb = if rods.len() == 1 { "is" } else { "are" };
    match rods.len().saturating_sub(NAMED) {
        0 => format!("{} {verb}", names.join(", ")),
        more => format!("{} and {more} more are", names.join(", ")),
    }
}

/// Plans how to saw rods from the stock, every diameter for itself, thin ones first.
///
/// # Errors
/// [`CutError`], if the stock is not usable or rods are longer than it.
pub fn plan(sticks: &IdVec<RodId, Stick>, stock: &Stock) -> Result<CutPlan, CutError> {
    let longest = checked(sticks, stock)?;
    let mut rods: Vec<RodId> = sticks.ids().collect();
    let diameters = |r: RodId| sticks[r].diameters;
    rods.sort_by(|&a, &b| thinner(&diameters(a), &diameters(b)));
    let mut plan = CutPlan { kerf: stock.kerf, bars: Vec::new(), bound: 0 };
    for alike in rods.chunk_by(|&a, &b| diameters(a) == diameters(b)) {
        let pieces = alike.iter().map(|&r| (r, sticks[r].length)).collect();
        let (bars, bound) = plan_alike(pieces, diameters(alike[0]), stock, longest);
        plan.bars.extend(bars);
        plan.bound += bound;
    }
    Ok(plan)
}

/// The bars for pieces of one diameter, and the least number of them.
fn plan_alike(
    mut pieces: Vec<(RodId, f64)>,
    diameters: [f64; 2],
    stock: &Stock,
    longest: f64,
) -> (Vec<Bar>, usize) {
    let kerf = stock.kerf;
    // Lengths that differ by noise only count as equal, so that they are sawn in the
    // order of their numbers.
    let steps = |l: f64| (l / SAME_LENGTH).round();
    pieces.sort_by(|a, b| steps(b.1).total_cmp(&steps(a.1)).then(a.0.cmp(&b.0)));

    let needed = pieces.first().map_or(0.0, |p| p.1);
    let bought = |bars: &[Bar]| bars.iter().map(|b| b.stock_length).sum::<f64>();
    let mut best: Option<Vec<Bar>> = None;
    let mut offers = stock.lengths.clone();
    offers.sort_by(|a, b| b.total_cmp(a));
    for &begin in offers.iter().filter(|&&l| fits(needed, l)) {
        let bars: Vec<Bar> = best_fit(&pieces, begin, kerf)
            .into_iter()
            .map(|open| open.on_shortest(&offers, kerf, diameters))
            .collect();
        if best.as_ref().is_none_or(|b| bought(&bars) < bought(b) - SAME_LENGTH) {
            best = Some(bars);
        }
    }
    let sizes: Vec<f64> = pieces.iter().map(|p| p.1 + kerf).collect();
    (best.unwrap_or_default(), bound(&sizes, longest + kerf))
}

/// The longest stock, if the stock is usable and long enough.
fn checked(sticks: &IdVec<RodId, Stick>, stock: &Stock) -> Result<f64, CutError> {
    if let Some(&bad) = stock.lengths.iter().find(|&&l| !(l > 0.0 && l.is_finite())) {
        return Err(CutError::StockLength(bad));
    }
    if !(stock.kerf >= 0.0 && stock.kerf.is_finite()) {
        return Err(CutError::Kerf(stock.kerf));
    }
    let longest = stock.lengths.iter().copied().reduce(f64::max).ok_or(CutError::NoStock)?;
    let too_long: Vec<RodId> = sticks.ids().filter(|&r| !fits(sticks[r].length, longest)).collect();
    if too_long.is_empty() {
        return Ok(longest);
    }
    let needed = sticks.iter().map(|stick| stick.length).fold(0.0, f64::max);
    // Cut lengths carry the noise of arithmetic, which would show in the message.
    let needed = (needed / SAME_LENGTH).round() * SAME_LENGTH;
    let needed = (needed * 1e3).ceil() / 1e3;
    Err(CutError::TooLong { rods: too_long, stock: longest, needed })
}

/// Whether what is needed fits, up to the noise of arithmetic.
fn fits(needed: f64, room: f64) -> bool {
    needed <= room + SAME_LENGTH
}

/// A bar that pieces can still go into.
struct OpenBar {
    pieces: Vec<(RodId, f64)>,
    /// Σℓ + k·(n − 1).
    used: f64,
}

/// Puts pieces, longest first, where the least room remains.
fn best_fit(pieces: &[(RodId, f64)], stock: f64, kerf: f64) -> Vec<OpenBar> {
    let mut bars: Vec<OpenBar> = Vec::new();
    for &(rod, length) in pieces {
        let best = bars
            .iter_mut()
            .filter(|bar| fits(bar.used + kerf + length, stock))
            .reduce(|a, b| if b.used > a.used + SAME_LENGTH { b } else { a });
        match best {
            Some(bar) => {
                bar.pieces.push((rod, length));
                bar.used += kerf + length;
            }
            None => bars.push(OpenBar { pieces: vec![(rod, length)], used: length }),
        }
    }
    bars
}

impl OpenBar {
    /// The bar on the shortest stock that holds it; `offers` longest first.
    fn on_shortest(self, offers: &[f64], kerf: f64, diameters: [f64; 2]) -> Bar {
        let holds = |l: &&f64| fits(self.used, **l);
        let stock_length = offers.iter().rev().find(holds).copied().unwrap_or(self.used);
        let mut at = -kerf;
        let pieces = self
            .pieces
            .iter()
            .map(|&(rod, length)| {
                at += kerf + length;
                Piece { rod, length, stop: at }
            })
            .collect();
        let beyond = stock_length - self.used;
        let left = if beyond <= kerf + SAME_LENGTH { 0.0 } else { beyond - kerf };
        Bar { stock_length, diameters, pieces, left }
    }
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

impl CutPlan {
    /// Whether no plan from the longest stock has fewer bars.
    pub fn is_proven(&self) -> bool {
        self.bars.len() == self.bound
    }

    /// Number of pieces.
    pub fn pieces(&self) -> usize {
        self.bars.iter().map(|b| b.pieces.len()).sum()
    }

    /// Number of saw cuts.
    pub fn cuts(&self) -> usize {
        self.bars.iter().map(Bar::cuts).sum()
    }

    /// Length of all pieces, mm.
    pub fn used(&self) -> f64 {
        self.bars.iter().flat_map(|b| &b.pieces).map(|p| p.length).sum()
    }

    /// Length of all bars, mm.
    pub fn bought(&self) -> f64 {
        self.bars.iter().map(|b| b.stock_length).sum()
    }

    /// Share of the bought length that does not become rods, 0 to 1.
    pub fn waste(&self) -> f64 {
        if self.bars.is_empty() { 0.0 } else { 1.0 - self.used() / self.bought() }
    }

    /// How many bars of each diameter and stock length to buy: thin ones first, of these
    /// the longest first.
    pub fn shopping(&self) -> Vec<Purchase> {
        let mut list: Vec<Purchase> = Vec::new();
        for &Bar { diameters, stock_length: length, .. } in &self.bars {
            match list.iter_mut().find(|p| p.length == length && p.diameters == diameters) {
                Some(purchase) => purchase.count += 1,
                None => list.push(Purchase { diameters, length, count: 1 }),
            }
        }
        list.sort_by(|a, b| {
            thinner(&a.diameters, &b.diameters).then(b.length.total_cmp(&a.length))
        });
        list
    }

    /// Whether its rods have more than one diameter.
    pub fn is_mixed(&self) -> bool {
        self.bars.windows(2).any(|pair| pair[0].diameters != pair[1].diameters)
    }

    /// Bars that are sawn alike, in the order of their first ones.
    pub fn groups(&self) -> Vec<BarGroup<'_>> {
        let mut groups: Vec<BarGroup<'_>> = Vec::new();
        for bar in &self.bars {
            match groups.iter_mut().find(|g| g.first().is_like(bar)) {
                Some(group) => group.bars.push(bar),
                None => groups.push(BarGroup { bars: vec![bar] }),
            }
        }
        groups
    }
}

impl BarGroup<'_> {
    /// The bar that shows how all are sawn.
    pub fn first(&self) -> &Bar {
        self.bars[0]
    }
}

impl Bar {
    /// Number of saw cuts: one after each piece, but none where a piece ends the bar.
    pub fn cuts(&self) -> usize {
        let used = self.pieces.last().map_or(0.0, |p| p.stop);
        self.pieces.len() - usize::from(self.stock_length - used <= SAME_LENGTH)
    }

    fn is_like(&self, other: &Bar) -> bool {
        self.stock_length == other.stock_length
            && self.diameters == other.diameters
            && self.pieces.len() == other.pieces.len()
            && self
                .pieces
                .iter()
                .zip(&other.pieces)
                .all(|(a, b)| (a.length - b.length).abs() <= SAME_LENGTH)
    }
}

#[cfg(test)]
#[path = "cutlist_tests.rs"]
mod tests;
