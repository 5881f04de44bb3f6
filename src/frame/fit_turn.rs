//! The turn at which sticks of a given diameter sit well on a surface that has its own
//! tiles: a polyhedron on a sphere, or a mesh of polygons.
//!
//! The rise of a contact grows steadily with the turn. Where the median rise equals the
//! diameter, rods touch without being moved much. Turns are kept within what is safe
//! for the tiles.

use super::canvas::Canvas;
use super::fit::{Fit, FitBy, LEAST_EDGE};
use super::form::{FormError, median_rise};
use crate::ids::TileId;
use crate::pattern::{FlatUnit, Line};
use crate::surface::Point3;
use crate::tiling::Net;
use nalgebra::Point2;

/// Part of the diameter below which the rise at the greatest turn says that the surface
/// is as good as flat.
const FLAT: f64 = 0.25;

/// The turn taken on flat surfaces, radians: 20°, as in the plane patterns.
const PLAIN_TURN: f64 = 0.349;

/// Halvings of the range of turns: to a hundredth of a degree.
const BISECTIONS: usize = 12;

/// Turns, radians, at which rods of `diameter` mm keep clear of rods that they do not
/// touch; `make` gives the surface with its rods at a turn. Below, the holes close up, the
/// later the larger the tiles. Above, rods meet round the corners of the tiles, the sooner
/// the more tiles there are at a corner; and in skewed tiles contacts come out at the
/// edges.
pub fn safe_turns<C: Canvas>(make: impl Fn(f64) -> C, diameter: f64) -> [f64; 2] {
    let mut least = USUAL_LEAST;
    let mut most = corner_limit(make(least).net());
    let share = |turn: f64, roomy: &dyn Fn(&C, TileId) -> bool| share(&make(turn), roomy);
    let within = |canvas: &C, tile: TileId| has_room(&canvas.lines(tile));
    while most > least + STEP && share(most, &within) < MOST_TILES {
        most -= STEP;
    }
    let open = |canvas: &C, tile: TileId| shortest_side(canvas, tile) >= OPEN * diameter;
    while least > STEP && share(least - STEP, &open) >= MOST_TILES {
        least -= STEP;
    }
    [least, most]
}

/// The same for rods that slide along the edges: turns from none on, up to where the
/// holes of every second unit close or rods meet round the corners. `None` where there is
/// no room even without a turn.
pub fn safe_turns_of_slid<C: Canvas>(make: impl Fn(f64) -> C, diameter: f64) -> Option<[f64; 2]> {
    let roomy = |canvas: &C, tile: TileId| shortest_side(canvas, tile) >= ROOM * diameter;
    let safe = |turn: f64| share(&make(turn), &roomy) >= MOST_TILES;
    if !safe(0.0) {
        return None;
    }
    let limit = corner_limit(make(0.0).net());
    let mut most = 0.0;
    while most + STEP < limit && safe(most + STEP) {
        most += STEP;
    }
    Some([0.0, most])
}

/// Sides of a unit of slid rods, in diameters: room for the rod that passes.
const ROOM: f64 = 1.5;

/// The part of the tiles of a canvas for which something holds.
fn share<C: Canvas>(canvas: &C, holds: &dyn Fn(&C, TileId) -> bool) -> f64 {
    let tiles: Vec<TileId> = canvas.net().tiles.ids().filter(|&t| canvas.holds(t)).collect();
    let count = tiles.iter().filter(|&&t| holds(canvas, t)).count();
    count as f64 / tiles.len().max(1) as f64
}

/// The least turn for tiles of any size, radians: 8°.
const USUAL_LEAST: f64 = 0.1396;

/// Sides of a unit, in diameters, at which turns below [`USUAL_LEAST`] are safe: room for
/// the rod that passes, and for the overhang of the one that ends beside it.
const OPEN: f64 = 4.0;

/// The shortest side of a tile's unit on the surface, mm; 0 where it has none.
fn shortest_side(canvas: &impl Canvas, tile: TileId) -> f64 {
    let Some(unit) = FlatUnit::new(&canvas.lines(tile)) else { return 0.0 };
    let place = |&p: &Point2<f64>| canvas.place(tile, p).map(|s| s.position);
    let contacts: Vec<Point3> = unit.contacts.iter().filter_map(place).collect();
    let n = contacts.len();
    (0..n).map(|i| (contacts[i] - contacts[(i + 1) % n]).norm()).fold(f64::INFINITY, f64::min)
}

/// Steps in which the greatest turn is lowered, radians: half a degree.
const STEP: f64 = 0.0087;

/// Part of the tiles that must have room for their contacts. The others may lose their
/// unit; asking for all, a single bad tile would decide for the whole.
const MOST_TILES: f64 = 0.95;

/// A contact in which a rod is passed lies at least this part of the way from the tile's
/// edge to the middle of the rod's side. Regular tiles come down to it where rods meet
/// round the corners, too.
const FROM_EDGE: f64 = 0.2;

fn corner_limit(net: &Net) -> f64 {
    let triangles = net.tiles.iter().any(|t| t.corners.len() == 3);
    let degrees = match net.greatest_valence() {
        0..=3 => 45.0f64,
        4 if !triangles => 36.0,
        _ => 24.0,
    };
    degrees.to_radians()
}

/// Whether the contacts of a tile all lie well within it.
fn has_room(rods: &[Line]) -> bool {
    let n = rods.len();
    let Some(unit) = FlatUnit::new(rods) else { return false };
    rods.iter().enumerate().all(|(i, rod)| {
        let passing = if unit.counter_clockwise { i } else { (i + n - 1) % n };
        let along = |p: Point2<f64>| (p - rod.at).dot(&rod.inward);
        along(unit.contacts[passing]) >= FROM_EDGE * along(unit.middles[i])
    })
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
    use crate::frame::canvas::{MeshTiles, SphereTiles};
    use crate::ids::{Id, IdVec, VertexId};
    use crate::pattern::Shape;
    use crate::tiling::conway::Notation;
    use crate::tiling::midsphere::midsphere;

    fn on_sphere(diameter: f64) -> Fit {
        let notation: Notation = "aI/2".parse().expect("a notation");
        let form = midsphere(&notation.polyhedron()).expect("round");
        let tiles = SphereTiles::new(&form, 300.0, Some(0.0), 0.0);
        let turns = safe_turns(|turn| tiles.shaped(Shape { turn, slide: 0.0 }), diameter);
        fit_turn(|turn| tiles.shaped(Shape { turn, slide: 0.0 }), turns, diameter).expect("units")
    }

    /// In regular tiles the limit is that of the corners; skewed ones lower it.
    #[test]
    fn skewed_tiles_are_turned_less() {
        let limit = |slope: f64| {
            let corner = |i: usize, j: usize| {
                let [x, y] = [i as f64, j as f64];
                Point3::new(x + slope * y, y, 0.0)
            };
            let points: IdVec<VertexId, Point3> = (0..25).map(|k| corner(k % 5, k / 5)).collect();
            let faces: Vec<Vec<VertexId>> = (0..16)
                .map(|k| {
                    let v = k % 4 + 5 * (k / 4);
                    [v, v + 1, v + 6, v + 5].map(VertexId::new).to_vec()
                })
                .collect();
            let tiles = MeshTiles::new(&points, &faces);
            let make = |turn| tiles.shaped(Shape { turn, slide: 0.0 });
            let [_, most] = safe_turns(make, 0.01);
            most.to_degrees()
        };
        assert!((limit(0.0) - 36.0).abs() < 1e-9);
        let (skewed, more) = (limit(0.5), limit(1.0));
        assert!(more < skewed - 2.0 && skewed < 36.0 && more > 10.0, "{skewed} {more}");
    }

    #[test]
    fn the_rise_meets_the_diameter_where_it_can() {
        let (thin, thick) = (on_sphere(0.05), on_sphere(14.0));
        let high = 24f64.to_radians();
        assert!(thin.turn < 0.1 * USUAL_LEAST && thin.rise < 0.2, "{thin:?}");
        assert_eq!(thick.by, FitBy::TurnLimit);
        assert!(thick.turn > high - 2.0 * STEP && thick.turn <= high);
        let diameter = thick.rise / 2.0;
        let fit = on_sphere(diameter);
        assert_eq!(fit.by, FitBy::Turn);
        assert!((fit.rise / diameter - 1.0).abs() < 1e-3, "{fit:?}");
        assert!(thin.turn < fit.turn && fit.turn < high);
    }
}
