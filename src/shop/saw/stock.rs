//! What bars there are to saw rods from, and why there may be no plan.

use crate::frame::measure::SAME_LENGTH;
use crate::ids::RodId;
use crate::shop::lengths::Stick;

/// Bars of one length: on sale, or an offcut that lies in the shop.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Offer {
    /// Length, mm.
    pub length: f64,
    /// Price of one, in the user's currency. Without prices the least length is bought.
    pub price: Option<f64>,
    /// How many there are of each diameter; none for as many as needed.
    pub count: Option<usize>,
    /// Diameter, mm; none for bars of every diameter.
    pub diameter: Option<f64>,
    /// Whether it is at hand already: it costs nothing.
    pub at_hand: bool,
}

impl Offer {
    /// As many bars of a length as needed, without a price.
    pub fn plain(length: f64) -> Self {
        Self { length, price: None, count: None, diameter: None, at_hand: false }
    }

    /// So many offcuts of a length.
    pub fn offcuts(length: f64, count: usize) -> Self {
        Self { count: Some(count), at_hand: true, ..Self::plain(length) }
    }

    /// Whether rods of these diameters, at end A and at end B, are sawn from it. Rods that
    /// taper go by the thicker end.
    pub fn is_for(&self, [a, b]: [f64; 2]) -> bool {
        self.diameter.is_none_or(|d| (d - a.max(b)).abs() <= SAME_LENGTH)
    }
}

/// What the builder has and can buy, and how it is sawn. Lengths in mm.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Stock {
    /// The bars. All on sale have prices, or none has.
    pub bars: Vec<Offer>,
    /// Width of a saw cut.
    pub kerf: f64,
    /// What is sawn off a bar at either end before it is used, cut and all. An offcut has a
    /// sawn end already: it is measured from there, and loses this at its other end only.
    pub trim: f64,
    /// Shortest left-over that is kept; none if all is waste.
    pub keep: Option<f64>,
}

impl Stock {
    /// As many bars of these lengths as needed.
    pub fn plain(lengths: &[f64], kerf: f64) -> Self {
        Self { bars: lengths.iter().map(|&l| Offer::plain(l)).collect(), kerf, ..Self::default() }
    }

    /// What one bar holds as rods and the cuts between them, mm; nothing if the trim takes all.
    pub fn room(&self, offer: &Offer) -> f64 {
        offer.length - self.first_trim(offer.at_hand) - self.trim
    }

    /// What is sawn off the end of a bar that stops are measured from, mm.
    pub fn first_trim(&self, at_hand: bool) -> f64 {
        if at_hand { 0.0 } else { self.trim }
    }

    /// Refuses what is no stock.
    pub(super) fn check(&self) -> Result<(), CutError> {
        if self.bars.is_empty() {
            return Err(CutError::NoStock);
        }
        let width = |x: f64| x >= 0.0 && x.is_finite();
        if !width(self.kerf) {
            return Err(CutError::Kerf(self.kerf));
        }
        if !width(self.trim) {
            return Err(CutError::Trim(self.trim));
        }
        for bar in &self.bars {
            let Offer { length, price, count, .. } = *bar;
            if !(length > 0.0 && length.is_finite()) {
                return Err(CutError::StockLength(length));
            }
            if let Some(price) = price.filter(|p| !(*p > 0.0 && p.is_finite())) {
                return Err(CutError::Price { length, price });
            }
            if count == Some(0) {
                return Err(CutError::Count { length });
            }
            if self.room(bar) <= SAME_LENGTH {
                return Err(CutError::AllTrimmed { length, trim: self.trim });
            }
        }
        let mut sold = self.bars.iter().filter(|b| !b.at_hand);
        match sold.clone().find(|b| b.price.is_none()) {
            Some(bar) if sold.any(|b| b.price.is_some()) => {
                Err(CutError::NoPrice { length: bar.length })
            }
            _ => Ok(()),
        }
    }
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
    /// The trim is no length.
    #[error("a trim of {0} mm is not a length of 0 or more")]
    Trim(f64),
    /// A price is none.
    #[error("a price of {price} for bars of {length} mm is not above 0")]
    Price { length: f64, price: f64 },
    /// Some bars have prices, and others have not.
    #[error("bars of {length} mm have no price, and others have one")]
    NoPrice { length: f64 },
    /// There are none of some bars.
    #[error("a count of 0 bars of {length} mm is no stock")]
    Count { length: f64 },
    /// Nothing of a bar remains.
    #[error("a trim of {trim} mm leaves nothing of bars of {length} mm")]
    AllTrimmed { length: f64, trim: f64 },
    /// Some rods are longer than any bar.
    #[error("{} longer than the longest stock ({stock} mm{}); the longest needs {needed} mm",
        named(.rods), of(.diameters))]
    TooLong {
        /// The rods that do not fit, in the order of their numbers.
        rods: Vec<RodId>,
        /// The longest that a bar of the stock holds, mm.
        stock: f64,
        /// The least stock length that would hold all rods, mm.
        needed: f64,
        /// Their diameters, mm, where the stock is not the same for all.
        diameters: Option<[f64; 2]>,
    },
    /// The counts do not suffice.
    #[error(
        "the stock does not suffice{}: {} left without a bar, {length:.2} m in all{}",
        of(.diameters), named(.rods), if *.certain { "" } else { " (as far as was searched)" }
    )]
    NotEnough {
        /// The rods that no bar is left for, in the order of their numbers.
        rods: Vec<RodId>,
        /// Their length together, m.
        length: f64,
        /// Their diameters, mm, where the stock is not the same for all.
        diameters: Option<[f64; 2]>,
        /// Whether it is certain that no plan holds all rods.
        certain: bool,
    },
}

impl CutError {
    /// What the user can do about it.
    pub fn hint(&self) -> String {
        match self {
            Self::NoStock => "give at least one stock length".to_owned(),
            Self::StockLength(_) => "give stock lengths above 0".to_owned(),
            Self::Kerf(_) => "give the width of the saw cut, 0 or more".to_owned(),
            Self::Trim(_) => "give what is sawn off each end of a bar, 0 or more".to_owned(),
            Self::Price { .. } => "give prices above 0; what you have already is an offcut".into(),
            Self::NoPrice { .. } => "give all stock lengths a price, or none".to_owned(),
            Self::Count { .. } => "leave the length out, or give how many there are".to_owned(),
            Self::AllTrimmed { .. } => "use less trim, or leave these bars out".to_owned(),
            Self::TooLong { needed, .. } => {
                format!("use stock of at least {needed} mm, or shorter rods from smaller units")
            }
            Self::NotEnough { .. } => {
                "add bars: more of a length, another length, or one without a count".to_owned()
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

fn of(diameters: &Option<[f64; 2]>) -> String {
    match diameters {
        None => String::new(),
        Some([a, b]) if a == b => format!(" of diameter {a} mm"),
        Some([a, b]) => format!(" of diameter {a}→{b} mm"),
    }
}

/// The error for rods that no bar holds, if there are any. `stick` says how long a rod is,
/// `stock` is what the rods may be sawn from.
pub(super) fn too_long(
    rods: &[(RodId, Stick)],
    stock: &Stock,
    diameters: Option<[f64; 2]>,
) -> Option<CutError> {
    let room = stock.bars.iter().map(|b| stock.room(b)).fold(0.0, f64::max);
    let mut long: Vec<RodId> =
        rods.iter().filter(|(_, s)| !fits(s.length, room)).map(|(r, _)| *r).collect();
    if long.is_empty() {
        return None;
    }
    long.sort();
    let longest = rods.iter().map(|(_, s)| s.length).fold(0.0, f64::max) + 2.0 * stock.trim;
    // Cut lengths carry the noise of arithmetic, which would show in the message.
    let needed = (longest / SAME_LENGTH).round() * SAME_LENGTH;
    let needed = (needed * 1e3).ceil() / 1e3;
    let stock = stock.bars.iter().map(|b| b.length).fold(0.0, f64::max);
    Some(CutError::TooLong { rods: long, stock, needed, diameters })
}

/// Whether what is needed fits, up to the noise of arithmetic.
pub(super) fn fits(needed: f64, room: f64) -> bool {
    needed <= room + SAME_LENGTH
}
