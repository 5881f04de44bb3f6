//! Relaxing (paper, section 5.1): a pattern is moved in its plane so that the links between
//! the centres of its units have the lengths and angles on the surface that they have in
//! the plane.
//!
//! A chart of a curved surface keeps angles, but not lengths: units come out large here and
//! small there. The centres are moved over the surface, by damped Gauss-Newton, to where
//! both are kept as well as they can be. Their places are brought back to the plane, and
//! rods are laid out anew through the moves.
//!
//! What the paper leaves open: moves may take units over the border of the chart, or fold
//! the plane. Units where they do are held back, and the rest is relaxed again round them.
//! So no unit is lost that has room unrelaxed.

mod descend;
mod energy;
mod graph;

use super::canvas::{Canvas, Field, PlaneCanvas};
use super::crop::{crop, held};
use super::measure::{Histogram, Spread, histogram, spread};
use super::weave::weave;
use crate::chart::{Chart, PlanarChart};
use crate::ids::{IdVec, TileId};
use crate::surface::Point3;
use crate::surface::locate::Locator;
use crate::tiling::Tiling;
use descend::descend;
use energy::Energy;
use graph::Graph;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Whether a pattern is relaxed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Relax {
    /// Units are made more even in size
    On,
    /// Units keep the size that the flattened surface gives them
    #[default]
    Off,
}

/// What relaxing did (paper, Fig. 12).
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Relaxing {
    /// Whether the frame is made with it: not where it would have more units left out.
    pub used: bool,
    /// Gauss-Newton steps.
    pub steps: usize,
    /// Units that were held back, so that none leaves the surface.
    pub held_back: usize,
    /// The sum that was made small.
    pub energy: Change<f64>,
    /// By how much angles between links differ from those in the plane, degrees.
    pub angles: Change<Histogram>,
    /// By how much lengths of links differ from those in the plane, brought to the surface
    /// by one scale for all; as part of them.
    pub lengths: Change<Histogram>,
    /// The same angles.
    pub angle_spread: Change<Spread>,
    /// The same lengths.
    pub length_spread: Change<Spread>,
}

/// A figure before and after.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Change<T> {
    pub before: T,
    pub after: T,
}

impl<T> Change<T> {
    fn map<U>(&self, f: impl Fn(&T) -> U) -> Change<U> {
        Change { before: f(&self.before), after: f(&self.after) }
    }
}

/// Width of the bins of angles, degrees.
const ANGLE_BIN: f64 = 1.0;

/// Width of the bins of lengths, as part of a length.
const LENGTH_BIN: f64 = 0.05;

/// Units beyond the border are pushed back by this many times the way: their corners follow
/// but in part, as those of neighbours pull at them. Larger, and they come to lie farther
/// inside than they need; smaller, and it takes more rounds.
const PUSH: f64 = 1.5;

/// The least push, in tile edges: smaller ones go on for nothing.
const LEAST_PUSH: f64 = 0.01;

/// Times that units are pushed. What does not fit then has its move halved.
const PUSHES: usize = 20;

/// Moves that are halved are made none below this, in tile edges; smaller, and halving
/// goes on for nothing.
const NO_MOVE: f64 = 0.02;

/// Times that the rest is relaxed again round units that were held back. After that,
/// what does not fit is held back without: borders are then settled but for single units.
const ROUNDS: usize = 6;

/// Times that units are held back. All fit long before, once their moves are halved.
const MOST_ROUNDS: usize = 60;

/// Moves the pattern of a canvas so that its units are even, and says what that did. Where
/// nothing is gained the pattern stays where it is. None for fewer than two units.
pub fn relax(canvas: &mut PlaneCanvas<PlanarChart>) -> Option<Relaxing> {
    canvas.set_field(None);
    let tiles = woven(canvas);
    let graph = Graph::new(canvas, &tiles);
    if graph.links.is_empty() {
        return None;
    }
    let start = places(canvas, &tiles)?;
    let [mean, plane] = graph.mean_lengths(&start);
    let unit = mean / plane;
    let mesh = canvas.chart().mesh();
    let locator = Locator::new(mesh);
    let energy = Energy { graph: &graph, mesh, locator: &locator, start: &start, unit, mean };
    let laid = lay(canvas, &tiles, &energy);
    let end = laid.and_then(|_| places(canvas, &tiles));
    let better = end.filter(|end| energy.value(end) < energy.value(&start));
    if better.is_none() {
        canvas.set_field(None);
    }
    let (steps, held_back) = laid.unwrap_or_default();
    let centers = Change { before: start.clone(), after: better.unwrap_or(start.clone()) };
    let angles = centers.map(|c| graph.angle_errors(c));
    let lengths = centers.map(|c| graph.length_errors(c, unit));
    Some(Relaxing {
        used: true,
        steps,
        held_back,
        energy: centers.map(|c| energy.value(c)),
        angles: angles.map(|a| histogram(a, ANGLE_BIN)),
        lengths: lengths.map(|l| histogram(l, LENGTH_BIN)),
        angle_spread: angles.map(|a| spread(a.iter().copied())),
        length_spread: lengths.map(|l| spread(l.iter().copied())),
    })
}

/// The tiles that the weaving takes.
fn woven(canvas: &impl Canvas) -> Vec<TileId> {
    let mut held = held(canvas);
    loop {
        let tiles = crop(canvas, &held);
        let Err(failed) = weave(canvas, &tiles) else { return tiles };
        failed.iter().for_each(|fault| held[fault.tile] = false);
    }
}

/// The centres of tiles, if all lie on the surface.
fn places(canvas: &impl Canvas, tiles: &[TileId]) -> Option<Vec<Point3>> {
    tiles.iter().map(|&t| canvas.place(t, canvas.middle(t)).map(|p| p.position)).collect()
}

/// Relaxes, holds back what does not fit and relaxes again, until all tiles do. Gives the
/// number of steps, and of units held back.
fn lay(
    canvas: &mut PlaneCanvas<PlanarChart>,
    tiles: &[TileId],
    energy: &Energy,
) -> Option<(usize, usize)> {
    let mut centers = energy.start.to_vec();
    let mut moves = vec![Vector2::zeros(); tiles.len()];
    let mut fixed = vec![false; tiles.len()];
    let mut steps = 0;
    for round in 0..MOST_ROUNDS {
        if round < ROUNDS {
            steps += descend(energy, &mut centers, &fixed).ok()?;
            for i in (0..tiles.len()).filter(|&i| !fixed[i]) {
                moves[i] = move_to(canvas, energy.locator, tiles[i], centers[i]);
            }
        }
        canvas.set_field(Some(field(canvas.tiling(), tiles, &moves)));
        let faulty = faulty(canvas, tiles);
        if faulty.is_empty() {
            return Some((steps, fixed.iter().filter(|f| **f).count()));
        }
        for i in hold_back(canvas, tiles, &faulty, &mut moves, round < PUSHES) {
            fixed[i] = true;
            let p = canvas.placement().apply(canvas.middle(tiles[i]) + moves[i]);
            centers[i] = canvas.chart().lift(canvas.chart().inside(p))?.position;
        }
    }
    None
}

/// The move of a tile, in tile edges, that brings its centre to the place of the surface
/// nearest to a point.
fn move_to(
    canvas: &PlaneCanvas<PlanarChart>,
    locator: &Locator,
    tile: TileId,
    center: Point3,
) -> Vector2<f64> {
    let at = locator.closest(center);
    let p = canvas.chart().plane_point(at.face, at.barycentric);
    canvas.placement().invert(p) - canvas.middle(tile)
}

fn field(tiling: &Tiling, tiles: &[TileId], moves: &[Vector2<f64>]) -> Field {
    let mut centers: IdVec<TileId, Option<Vector2<f64>>> = vec![None; tiling.centers.len()].into();
    for (&tile, &by) in tiles.iter().zip(moves) {
        centers[tile] = Some(by);
    }
    Field::new(&tiling.net, centers)
}

/// The tiles, by their places in the list, that do not fit as the pattern is moved now.
fn faulty(canvas: &PlaneCanvas<PlanarChart>, tiles: &[TileId]) -> Vec<usize> {
    let unfit = |&i: &usize| !canvas.is_sound(tiles[i]) || !canvas.reaches(tiles[i]);
    let faulty: Vec<usize> = (0..tiles.len()).filter(unfit).collect();
    match weave(canvas, tiles) {
        Err(failed) if faulty.is_empty() => {
            (0..tiles.len()).filter(|&i| failed.iter().any(|f| f.tile == tiles[i])).collect()
        }
        _ => faulty,
    }
}

/// Pushes tiles that do not fit back into the chart. Where that is no help, they and those
/// round them get half their moves. Gives all that were changed.
fn hold_back(
    canvas: &PlaneCanvas<PlanarChart>,
    tiles: &[TileId],
    faulty: &[usize],
    moves: &mut [Vector2<f64>],
    push: bool,
) -> BTreeSet<usize> {
    let corners = |i: usize| &canvas.net().tiles[tiles[i]].corners;
    let mut stuck: BTreeSet<usize> = BTreeSet::new();
    for &i in faulty {
        let way = canvas.overhang(tiles[i]);
        if push && way.norm() > 0.0 {
            moves[i] += way * PUSH.max(LEAST_PUSH / way.norm());
        } else {
            stuck.extend(corners(i));
        }
    }
    let mut changed: BTreeSet<usize> = faulty.iter().copied().collect();
    for i in (0..tiles.len()).filter(|&i| corners(i).iter().any(|v| stuck.contains(v))) {
        moves[i] *= if moves[i].norm() < NO_MOVE { 0.0 } else { 0.5 };
        changed.insert(i);
    }
    changed
}

#[cfg(test)]
mod tests;
