//! Smaller units where those that fit the rods in the median are too large for a part of the
//! surface.
//!
//! Where a surface is gently curved here and sharply there, units whose median rise equals the
//! diameter rise several diameters at the sharp parts, and rods there are moved far from the
//! surface. Units a tenth or two smaller then serve the whole better.

use super::{BuildError, Model};
use crate::frame::fit::{Fit, FitBy};
use crate::frame::form::FormError;

/// Mean move of rod ends, in diameters, with which a frame lies well on its surface.
const GOOD_MOVE: f64 = 1.5;

/// Each edge that is tried is this part of the one before.
const STEP: f64 = 0.9;

/// Most edges tried beside the one that fits; the last is a third shorter.
const MOST: usize = 4;

/// The model of units that fit, or of smaller ones if rods then have to be moved less. `make`
/// makes the model of a fit; `diameter` is that of the rods, mm.
///
/// # Errors
/// What is wrong with the units that fit, where smaller ones do not work either.
pub fn smaller_while_better(
    fit: Fit,
    diameter: f64,
    mut make: impl FnMut(Fit) -> Result<Model, BuildError>,
) -> Result<Model, BuildError> {
    let mut best = make(fit);
    for tried in 1..=MOST {
        if !is_worth_more(&best, diameter) {
            break;
        }
        let edge = fit.edge * STEP.powi(tried as i32);
        let smaller = make(Fit { edge, by: FitBy::Smaller, ..fit });
        if let Ok(smaller) = smaller
            && best.as_ref().map_or(true, |best| is_better(&smaller, best))
        {
            best = Ok(smaller);
        }
    }
    best
}

/// Whether smaller units may come out better.
fn is_worth_more(found: &Result<Model, BuildError>, diameter: f64) -> bool {
    match found {
        Ok(model) => mean_move(model) > GOOD_MOVE * diameter,
        Err(BuildError::Form(e) | BuildError::Unsuited { e, .. }) => {
            matches!(e, FormError::TooManyDropped { .. })
        }
        Err(_) => false,
    }
}

fn is_better(one: &Model, other: &Model) -> bool {
    let left_out = |model: &Model| model.formed.frame.dropped.len();
    left_out(one) <= left_out(other) && mean_move(one) < mean_move(other)
}

fn mean_move(model: &Model) -> f64 {
    let moves = &model.formed.moves;
    moves.iter().sum::<f64>() / moves.len() as f64
}
