//! The turn at which sticks of a given diameter sit well on a surface that has its own
//! tiles: a polyhedron on a sphere, or a mesh of polygons.
//!
//! The rise of a contact grows steadily with the turn. Where the median rise equals the
//! diameter, rods touch without being moved much. Turns are kept within what is safe
//! for the tiles.

use super::canvas::Canvas;
use super::fit::{Fit, FitBy, LEAST_EDGE};
use super::form::{FormError, median_rise};
use crate::tiling::Net;

/// Part of the diameter below which the rise at the greatest turn says that the surface
/// is as good as flat.
const FLAT: f64 = 0.25;

/// The turn taken on flat surfaces, radians: 20°, as in the plane patterns.
const PLAIN_TURN: f64 = 0.349;

/// Halvings of the range of turns: to a hundredth of a degree.
const BISECTIONS: usize = 12;

/// Turns, radians, at which rods keep clear of rods that they do not touch: below, the
/// holes close up; above, rods meet round the corners of the tiles, the sooner the more
/// tiles there are at a corner.
pub fn safe_turns(net: &Net) -> [f64; 2] {
    let triangles = net.tiles.iter().any(|t| t.corners.len() == 3);
    let most = match net.greatest_valence() {
        0..=3 => 45.0f64,
        4 if !triangles => 36.0,
        _ => 24.0,
    };
    [8f64.to_radians(), most.to_radians()]
}

/// Finds the turn for rods of `diameter` mm within `turns`, radians, by trying out
/// canvases; `make` gives the surface with its rods at a turn.
///
/// # Errors
/// [`FormError::TooFewUnits`] where hardly a unit can be made, [`FormError::TooSmall`]
/// where the tiles have no room for the rods.
pub fn fit_turn<C: Canvas>(
    make: impl Fn(f64) -> C,
    turns: [f64; 2],
    diameter: f64,
) -> Result<Fit, FormError> {
    let try_turn = |turn: f64, by: FitBy| {
        let canvas = make(turn);
        let (units, rise) = median_rise(&canvas)?;
        Ok(Fit { edge: canvas.edge(), turn, rise, units, by })
    };
    let [mut low, mut high] = turns;
    require_size(&make(low), diameter)?;
    let least = try_turn(low, FitBy::TurnLimit)?;
    let most = try_turn(high, FitBy::TurnLimit)?;
    if most.rise < FLAT * diameter {
        return try_turn(PLAIN_TURN.min(high), FitBy::Plain);
    }
    if least.rise >= diameter {
        return Ok(least);
    }
    if most.rise <= diameter {
        return Ok(most);
    }
    for _ in 0..BISECTIONS {
        let middle = (low + high) / 2.0;
        if try_turn(middle, FitBy::Turn)?.rise < diameter { low = middle } else { high = middle }
    }
    try_turn(high, FitBy::Turn)
}

fn require_size(canvas: &impl Canvas, diameter: f64) -> Result<(), FormError> {
    let (edge, least) = (canvas.edge(), LEAST_EDGE * diameter);
    if edge >= least {
        return Ok(());
    }
    let (suits, larger) = (edge / LEAST_EDGE, canvas.sizing().larger);
    Err(FormError::TooSmall { edge, diameter, least, suits, larger })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::canvas::SphereCanvas;
    use crate::tiling::conway::Notation;
    use crate::tiling::midsphere::midsphere;

    fn on_sphere(diameter: f64) -> Fit {
        let notation: Notation = "aI/2".parse().expect("a notation");
        let form = midsphere(&notation.polyhedron()).expect("round");
        let canvas = SphereCanvas::new(&form, 300.0, Some(0.0), 0.0, 0.1);
        let turns = safe_turns(canvas.net());
        fit_turn(|turn| canvas.turned(turn), turns, diameter).expect("units")
    }

    #[test]
    fn the_rise_meets_the_diameter_where_it_can() {
        let thin = on_sphere(0.5);
        let thick = on_sphere(14.0);
        let [low, high] = [8f64.to_radians(), 24f64.to_radians()];
        assert_eq!((thin.by, thin.turn), (FitBy::TurnLimit, low));
        assert_eq!((thick.by, thick.turn), (FitBy::TurnLimit, high));
        let diameter = (thin.rise + on_sphere(14.0).rise) / 2.0;
        let fit = on_sphere(diameter);
        assert_eq!(fit.by, FitBy::Turn);
        assert!((fit.rise / diameter - 1.0).abs() < 1e-3, "{fit:?}");
        assert!(low < fit.turn && fit.turn < high);
    }
}
