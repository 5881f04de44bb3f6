//! The sawing plan: bars, and the pieces that are sawn from them.

use crate::frame::measure::SAME_LENGTH;
use crate::ids::RodId;
use crate::shop::lengths::thinner;

/// A sawing plan. Lengths in mm.
#[derive(Clone, PartialEq, Debug)]
pub struct CutPlan {
    /// Width of a saw cut.
    pub kerf: f64,
    /// What is sawn off at either end of a bar before it is used.
    pub trim: f64,
    /// Shortest left-over that is kept.
    pub keep: Option<f64>,
    /// The bars: of each diameter offcuts first, those with the longest pieces first.
    pub bars: Vec<Bar>,
    /// No plan needs fewer bars.
    pub bound: usize,
    /// What was made as small as possible.
    pub aim: Aim,
    /// Its value in this plan: bars, mm, or money.
    pub spent: f64,
    /// No plan has less.
    pub least: f64,
}

/// What a plan makes as small as possible.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Aim {
    /// The number of bars: all that are bought are alike.
    Bars,
    /// The length of bars bought: there are several lengths, without prices.
    Length,
    /// The price of bars bought.
    Cost,
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
    /// Price of one, if prices were given.
    pub price: Option<f64>,
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
    /// Whether it is an offcut that was at hand.
    pub at_hand: bool,
    /// Its price, if prices were given; none of an offcut.
    pub price: Option<f64>,
    /// Whether a cut trims its first end.
    pub trimmed: bool,
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

/// So much less than the least value counts as the least, in parts of it: sums of prices carry
/// noise. Larger, and plans that could be better are called best.
const SAME_VALUE: f64 = 1e-9;

impl CutPlan {
    /// Whether no plan is better.
    pub fn is_proven(&self) -> bool {
        self.spent <= self.least + SAME_VALUE * self.spent.abs()
    }

    /// How much a better plan could save at most: bars, mm, or money.
    pub fn gap(&self) -> f64 {
        if self.is_proven() { 0.0 } else { self.spent - self.least }
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

    /// Weight of all pieces, kg, of a density in kg/m³.
    pub fn weight(&self, density: f64) -> f64 {
        let volume = |bar: &Bar| {
            // Of a rod that tapers: a cone without its tip.
            let [a, b] = bar.diameters;
            let section = std::f64::consts::PI / 12.0 * (a * a + a * b + b * b);
            section * bar.pieces.iter().map(|p| p.length).sum::<f64>()
        };
        let cubic_mm: f64 = self.bars.iter().map(volume).sum();
        cubic_mm * 1e-9 * density
    }

    /// Length of all bars, offcuts at hand among them, mm.
    pub fn sawn(&self) -> f64 {
        self.bars.iter().map(|b| b.stock_length).sum()
    }

    /// Length of the bars to buy, mm.
    pub fn bought(&self) -> f64 {
        self.bars.iter().filter(|b| !b.at_hand).map(|b| b.stock_length).sum()
    }

    /// Price of the bars to buy, if prices were given.
    pub fn cost(&self) -> Option<f64> {
        (self.aim == Aim::Cost).then(|| self.bars.iter().filter_map(|b| b.price).sum())
    }

    /// Whether a left-over is long enough to be kept.
    pub fn keeps(&self, bar: &Bar) -> bool {
        self.keep.is_some_and(|keep| bar.left > 0.0 && bar.left >= keep - SAME_LENGTH)
    }

    /// The left-overs to keep, with their diameters and how many there are: thin ones first,
    /// of these the longest first. Lengths in mm.
    pub fn kept(&self) -> Vec<Purchase> {
        self.tally(self.bars.iter().filter(|b| self.keeps(b)).map(|b| (b, b.left, None)))
    }

    /// Share of the sawn length that becomes neither rods nor left-overs to keep, 0 to 1.
    pub fn waste(&self) -> f64 {
        let kept: f64 = self.bars.iter().filter(|b| self.keeps(b)).map(|b| b.left).sum();
        if self.bars.is_empty() { 0.0 } else { 1.0 - (self.used() + kept) / self.sawn() }
    }

    /// How many bars of each diameter and stock length to buy: thin ones first, of these
    /// the longest first.
    pub fn shopping(&self) -> Vec<Purchase> {
        self.tally(self.bars.iter().filter(|b| !b.at_hand).map(|b| (b, b.stock_length, b.price)))
    }

    /// How many offcuts at hand are used, in the same order.
    pub fn taken(&self) -> Vec<Purchase> {
        self.tally(self.bars.iter().filter(|b| b.at_hand).map(|b| (b, b.stock_length, None)))
    }

    fn tally<'a>(&self, bars: impl Iterator<Item = (&'a Bar, f64, Option<f64>)>) -> Vec<Purchase> {
        let mut list: Vec<Purchase> = Vec::new();
        for (&Bar { diameters, .. }, length, price) in bars {
            let alike = |p: &&mut Purchase| {
                (p.length - length).abs() <= SAME_LENGTH
                    && p.diameters == diameters
                    && p.price == price
            };
            match list.iter_mut().find(alike) {
                Some(purchase) => purchase.count += 1,
                None => list.push(Purchase { diameters, length, count: 1, price }),
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
    /// Number of saw cuts: one after each piece, but none where a piece ends the bar; and one
    /// more where the first end is trimmed.
    pub fn cuts(&self) -> usize {
        let used = self.pieces.last().map_or(0.0, |p| p.stop);
        let last = usize::from(self.stock_length - used <= SAME_LENGTH);
        self.pieces.len() + usize::from(self.trimmed) - last
    }

    fn is_like(&self, other: &Bar) -> bool {
        self.stock_length == other.stock_length
            && self.diameters == other.diameters
            && self.at_hand == other.at_hand
            && self.price == other.price
            && self.pieces.len() == other.pieces.len()
            && self
                .pieces
                .iter()
                .zip(&other.pieces)
                .all(|(a, b)| (a.length - b.length).abs() <= SAME_LENGTH)
    }
}
