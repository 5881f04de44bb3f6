//! The tile edge at which sticks of a given diameter sit well on a surface.
//!
//! The rise of a contact grows with the square of the tile edge. Where the median
//! rise equals the diameter, rods touch without being moved much: thicker ones
//! would push the frame off the surface, thinner ones let it sink.

use super::canvas::{MOST_UNITS, PlaneCanvas, most_units};
use super::form::median_rise;
use crate::chart::Chart;
use crate::pattern::{Pattern, Shape};
use crate::tiling::Placement;
use thiserror::Error;

/// The size of the units and the turn of their rods, and what they rest on.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Fit {
    /// Mean tile edge, mm.
    pub edge: f64,
    /// Turn of the rods, radians.
    pub turn: f64,
    /// Median rise of the contacts then, mm: the diameter that would suit.
    pub rise: f64,
    /// Number of units.
    pub units: usize,
    /// What was found, and what was given.
    pub by: FitBy,
}

/// Part of the diameter below which a rise is none to speak of: there the choice of who goes
/// over decides, and no diameter suits better than others.
const FLAT: f64 = 1.0 / 20.0;

impl Fit {
    /// Whether the surface is too flat under these units for the rise to say which rods suit
    /// them; `diameter` is that of the rods, mm.
    pub fn is_flat(&self, diameter: f64) -> bool {
        self.rise < FLAT * diameter
    }
}

/// What a fit rests on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FitBy {
    /// The tile edge at which the rise equals the diameter.
    Edge,
    /// A smaller edge than that, with which rods have to be moved less.
    Smaller,
    /// The turn at which it does; the surface has its own tiles.
    Turn,
    /// The least or greatest turn that is safe: the rods would suit another one better.
    TurnLimit,
    /// The surface is too flat for the rise to decide.
    Plain,
    /// The user.
    Given,
}

/// No tile edge suits.
#[derive(Error, Clone, Copy, PartialEq, Debug)]
pub enum FitError {
    /// Even the largest units have too little rise for this stick, or it is too
    /// thick for any.
    #[error(
        "{diameter} mm rods are too thick for this surface: units large enough to lift them \
         over each other do not fit on it. Use rods of at most {suits:.1} mm (--rod), a larger \
         model (--span), or set the unit yourself (--unit)"
    )]
    TooThick { diameter: f64, suits: f64 },
    /// The rods are so thin that more units would be needed than can be laid out.
    #[error(
        "{diameter} mm rods are too thin for this surface: more than {MOST_UNITS} units would be \
         needed. Use rods of at least {suits:.2} mm (--rod) or a smaller model (--span)"
    )]
    TooThin { diameter: f64, suits: f64 },
    /// The surface is too small for the rods.
    #[error(
        "there is no room for {LIKENESS} units on this surface, which is some {size:.1} mm across \
         when laid flat: units of {diameter} mm rods need an edge of {least:.1} mm or more. If the \
         file is not in mm, say how large the model is to be (--span); else use rods of at most \
         {suits:.2} mm (--rod)"
    )]
    NoRoom { size: f64, diameter: f64, least: f64, suits: f64 },
}

/// Tile edge, in diameters, where the rise cannot decide: flat and saddle-shaped
/// surfaces.
const PLAIN_EDGE: f64 = 20.0;

/// Smallest tile edge tried, in diameters: below, there is no room for the rods
/// between the contacts of a unit.
pub(super) const LEAST_EDGE: f64 = 6.0;

/// Fewest units of a fitted frame. Fewer make a poor likeness of a surface.
const LIKENESS: usize = 12;

/// Ratio of neighbouring tile edges while the fitting edge is being enclosed.
const STRIDE: f64 = 1.15;

/// Bisections after it: they place the edge to one part in a thousand, finer than
/// the rise is smooth in the edge.
const BISECTIONS: usize = 7;

/// Finds the tile edge for rods of `diameter` mm in units of the given shape.
/// `placement` gives origin and rotation; its edge is not used.
///
/// # Errors
/// [`FitError`] when no edge suits.
pub fn fit(
    chart: &impl Chart,
    pattern: &Pattern,
    placement: &Placement,
    shape: Shape,
    diameter: f64,
) -> Result<Fit, FitError> {
    let try_edge = |edge: f64| {
        let placement = Placement { edge, ..*placement };
        let (units, rise) =
            median_rise(&PlaneCanvas::new(chart, pattern, placement, shape).ok()?).ok()?;
        let fit = Fit { edge, turn: shape.turn, rise, units, by: FitBy::Edge };
        (fit.units >= LIKENESS).then_some(fit)
    };
    let room = LEAST_EDGE * diameter;
    // No smaller than can be laid out.
    let least = room.max((most_units(chart, 1.0) / MOST_UNITS as f64).sqrt());
    let [lo, hi] = chart.bounds();
    let most = (hi - lo).norm();
    let mut edge = guess(least, most, diameter, try_edge);
    if edge < least && least > room {
        // The square law says which diameter would fit the least edge.
        let suits = diameter * (least / edge).powi(2);
        return Err(FitError::TooThin { diameter, suits });
    }
    edge = edge.max(least);
    let (mut below, mut above): (Option<Fit>, Option<Fit>) = (None, None);
    loop {
        match try_edge(edge) {
            Some(now) if now.rise >= diameter => above = Some(now),
            Some(now) => below = Some(now),
            None if below.is_some() => break,
            None => {}
        }
        if let (Some(below), Some(above)) = (below, above) {
            return Ok(bisect(below, above, diameter, try_edge));
        }
        edge = if below.is_some() { edge * STRIDE } else { edge / STRIDE };
        if edge < least {
            break;
        }
    }
    match (below, above) {
        (_, Some(smallest)) => Ok(smallest),
        (Some(largest), None) => plain(&largest, diameter, try_edge),
        (None, None) => {
            // Some 8 plain edges across leave a few dozen tiles after cropping.
            let suits = most / (8.0 * PLAIN_EDGE);
            Err(FitError::NoRoom { size: most, diameter, least: room, suits })
        }
    }
}

/// Edges of the first trials are at least this part of the surface's size, so that a
/// trial is cheap however thin the rods.
const COARSE: f64 = 1.0 / 64.0;

/// A tile edge near the fitting one: the rise grows with its square.
fn guess(least: f64, most: f64, diameter: f64, try_edge: impl Fn(f64) -> Option<Fit>) -> f64 {
    let mut edge = (PLAIN_EDGE * diameter).max(COARSE * most).min(most / 4.0).max(least);
    for _ in 0..2 {
        let Some(now) = try_edge(edge) else { break };
        edge = (now.edge * (diameter / now.rise).sqrt()).min(most);
        if edge < least {
            break;
        }
    }
    edge
}

/// Narrows the edge down between one whose rise is too small and one whose rise suffices.
fn bisect(
    mut below: Fit,
    mut above: Fit,
    diameter: f64,
    try_edge: impl Fn(f64) -> Option<Fit>,
) -> Fit {
    for _ in 0..BISECTIONS {
        match try_edge((below.edge * above.edge).sqrt()) {
            Some(mid) if mid.rise >= diameter => above = mid,
            Some(mid) => below = mid,
            None => break,
        }
    }
    above
}

/// Where no edge has enough rise: a plain edge if there is room for it, an error if
/// the rods are too thick. `largest` is the largest edge with room.
fn plain(
    largest: &Fit,
    diameter: f64,
    try_edge: impl Fn(f64) -> Option<Fit>,
) -> Result<Fit, FitError> {
    match try_edge(PLAIN_EDGE * diameter) {
        Some(fit) => Ok(Fit { by: FitBy::Plain, ..fit }),
        None => {
            let suits = largest.rise.max(largest.edge / PLAIN_EDGE);
            Err(FitError::TooThick { diameter, suits })
        }
    }
}
