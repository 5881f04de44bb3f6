//! Relaxing (paper, section 5.1): a pattern is moved in its plane so that the links between
//! the centres of its units have the lengths and angles on the surface that they have in
//! the plane.
//!
//! A chart of a curved surface keeps angles, but not lengths: units come out large here and
//! small there. The centres are moved over the surface, by damped Gauss-Newton, to where
//! both are kept as well as they can be. Their places are brought back to the plane, and
//! rods are laid out anew through the moves.
//!
//! What the paper leaves open: units at the border of the pattern, left free, would move off
//! the border of the surface, inside or out. Here they move along it only. Where moves still
//! take a unit out of the chart, or would fold the plane, it is held back, and the rest is
//! relaxed again round it. So no unit is lost that has room unrelaxed.

mod descend;
mod energy;
mod graph;

use super::canvas::{Canvas, Field, PlaneCanvas};
use super::crop::{crop, held};
use super::histogram::BeforeAfter;
use super::measure::{Spread, spread};
use super::weave::weave;
use crate::chart::{Chart, PlanarChart};
use crate::ids::{IdVec, TileId};
use crate::surface::locate::Locator;
use crate::surface::{Point3, Vector3};
use crate::tiling::Tiling;
use descend::{Hold, descend};
use energy::Energy;
use graph::Graph;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

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
    /// Units that were held back so as not to leave the surface.
    pub held_back: usize,
    /// The sum that was made small.
    pub energy: Change<f64>,
    /// By how much angles between links differ from those in the plane, degrees.
    pub angles: BeforeAfter,
    /// By how much lengths of links differ from those in the plane, brought to the surface
    /// by one scale for all; as part of them.
    pub lengths: BeforeAfter,
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

/// The least push, in tile edges: units beyond the border are pushed back by the way that they
/// are beyond it, or by this. Smaller, and the last ones go on for nothing; larger, and
/// they come to lie farther inside than they need.
const LEAST_PUSH: f64 = 0.01;

/// Times that units are pushed. What does not fit then has its move halved.
const PUSHES: usize = 30;

/// Moves that are halved are made none below this, in tile edges; smaller, and halving
/// goes on for nothing.
const NO_MOVE: f64 = 0.02;

/// Times that the rest is relaxed again round units that were held back. After that,
/// what does not fit is held back without: borders are then settled but for single units.
const ROUNDS: usize = 10;

/// Times that units are held back. All fit long before, once their moves are halved.
const MOST_ROUNDS: usize = 80;

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
        angles: BeforeAfter::new(&angles.before, &angles.after, ANGLE_BIN),
        lengths: BeforeAfter::new(&lengths.before, &lengths.after, LENGTH_BIN),
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
    let mut holds = border_holds(canvas, tiles, &centers);
    let mut held_back = BTreeSet::new();
    let mut steps = 0;
    for round in 0..MOST_ROUNDS {
        if round < ROUNDS {
            steps += descend(energy, &mut centers, &holds).ok()?;
            for i in (0..tiles.len()).filter(|&i| holds[i] != Hold::Still) {
                moves[i] = move_to(canvas, energy.locator, tiles[i], centers[i]);
            }
        }
        canvas.set_field(Some(field(canvas.tiling(), tiles, &moves)));
        let faulty = faulty(canvas, tiles);
        if faulty.is_empty() {
            return Some((steps, held_back.len()));
        }
        for (i, pushed) in hold_back(canvas, tiles, &faulty, &mut moves, round < PUSHES) {
            held_back.insert(i);
            let p = canvas.placement().apply(canvas.middle(tiles[i]) + moves[i]);
            let before = centers[i];
            centers[i] = canvas.chart().lift(canvas.chart().inside(p))?.position;
            let way = (centers[i] - before).try_normalize(0.0).filter(|_| pushed);
            holds[i] = way.map_or(Hold::Still, Hold::Across);
        }
    }
    None
}

/// Units at the border of the pattern may move along it, not off it. Left free, they come to
/// lie farther inside where units are large, and the frame does not reach the ground.
fn border_holds(canvas: &impl Canvas, tiles: &[TileId], centers: &[Point3]) -> Vec<Hold> {
    let node: BTreeMap<TileId, usize> = tiles.iter().enumerate().map(|(i, &t)| (t, i)).collect();
    let hold = |(i, &tile): (usize, &TileId)| {
        let sides = canvas.net().tiles[tile].edges.len();
        let beside: Vec<usize> =
            canvas.net().neighbours(tile).filter_map(|t| node.get(&t).copied()).collect();
        let inward: Vector3 = beside.iter().map(|&j| (centers[j] - centers[i]).normalize()).sum();
        let way = inward.try_normalize(0.0).filter(|_| beside.len() < sides);
        way.map_or(Hold::Free, Hold::Across)
    };
    tiles.iter().enumerate().map(hold).collect()
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
/// round them get half their moves. Gives all that were changed, and whether by a push.
fn hold_back(
    canvas: &PlaneCanvas<PlanarChart>,
    tiles: &[TileId],
    faulty: &[usize],
    moves: &mut [Vector2<f64>],
    push: bool,
) -> BTreeMap<usize, bool> {
    let corners = |i: usize| &canvas.net().tiles[tiles[i]].corners;
    let mut stuck: BTreeSet<usize> = BTreeSet::new();
    for &i in faulty {
        let way = canvas.overhang(tiles[i]);
        if push && way.norm() > 0.0 {
            moves[i] += way * (LEAST_PUSH / way.norm()).max(1.0);
        } else {
            stuck.extend(corners(i));
        }
    }
    let mut changed: BTreeMap<usize, bool> = faulty.iter().map(|&i| (i, true)).collect();
    for i in (0..tiles.len()).filter(|&i| corners(i).iter().any(|v| stuck.contains(v))) {
        moves[i] *= if moves[i].norm() < NO_MOVE { 0.0 } else { 0.5 };
        changed.insert(i, false);
    }
    changed
}

#[cfg(test)]
mod tests;
