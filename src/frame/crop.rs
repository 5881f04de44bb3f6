//! Which tiles become units (paper, section 4.1): those that lie in the chart, hold
//! together, and hang on to each other.

use crate::chart::Chart;
use crate::ids::{Id, TileId};
use crate::pattern::UnitShape;
use crate::tiling::{Placement, Tiling};
use nalgebra::Point2;
use std::collections::BTreeSet;

/// A tile is tested this much larger than it is, so that the rods at the border
/// keep a little inside the surface; part of the tile's radius.
const MARGIN: f64 = 0.04;

/// The tiles to build units on, nearest to the tiling's origin first.
///
/// Tiles in `without` are left out. Units with fewer than two neighbours are
/// dropped, repeatedly, then all but the largest connected piece.
pub fn crop(
    tiling: &Tiling,
    placement: &Placement,
    turn: f64,
    chart: &impl Chart,
    without: &BTreeSet<TileId>,
) -> Vec<TileId> {
    let mut kept: Vec<bool> = tiling
        .tiles
        .ids()
        .map(|t| !without.contains(&t) && lies_in(tiling, t, placement, turn, chart))
        .collect();
    drop_loose(tiling, &mut kept);
    let mut tiles = largest_piece(tiling, &kept);
    let center = |t: TileId| tiling.tiles[t].center.coords;
    // Rings of equal distance are told apart by angle; distances are compared in
    // steps that are coarse against rounding and fine against the tiling.
    let ring = |t: TileId| (center(t).norm() * 1e6).round() as i64;
    let angle = |t: TileId| center(t).y.atan2(center(t).x);
    tiles.sort_by(|&a, &b| ring(a).cmp(&ring(b)).then(angle(a).total_cmp(&angle(b))));
    tiles
}

/// Whether every point of the tile that the lift will ask for is in the chart.
fn lies_in(
    tiling: &Tiling,
    tile: TileId,
    placement: &Placement,
    turn: f64,
    chart: &impl Chart,
) -> bool {
    let shape = UnitShape::new(tiling.tiles[tile].corners.len(), turn);
    let tile = &tiling.tiles[tile];
    let grown = |p: Point2<f64>| p + (p - tile.center) * MARGIN;
    let corners = tile.corners.iter().map(|&v| grown(tiling.vertices[v]));
    let edges = tile.edges.iter().flat_map(|&e| {
        let middle = tiling.midpoint(e);
        let inward = (tile.center - middle).normalize();
        let axis = nalgebra::Rotation2::new(turn) * inward;
        [grown(middle), middle + axis * shape.middle, middle + axis * shape.ending]
    });
    let mut points = std::iter::once(tile.center).chain(corners).chain(edges);
    points.all(|p| chart.lift(placement.apply(p)).is_some())
}

/// Tiles on the other side of a tile's edges, where they are kept.
fn neighbours<'a>(
    tiling: &'a Tiling,
    kept: &'a [bool],
    tile: TileId,
) -> impl Iterator<Item = TileId> + 'a {
    tiling.tiles[tile].edges.iter().filter_map(move |&e| {
        let edge = &tiling.edges[e];
        let other = if edge.left == tile { edge.right? } else { edge.left };
        kept[other.index()].then_some(other)
    })
}

fn drop_loose(tiling: &Tiling, kept: &mut [bool]) {
    let mut todo: Vec<TileId> = tiling.tiles.ids().filter(|t| kept[t.index()]).collect();
    while let Some(tile) = todo.pop() {
        if kept[tile.index()] && neighbours(tiling, kept, tile).count() < 2 {
            kept[tile.index()] = false;
            todo.extend(neighbours(tiling, kept, tile));
        }
    }
}

fn largest_piece(tiling: &Tiling, kept: &[bool]) -> Vec<TileId> {
    let mut seen = vec![false; kept.len()];
    let mut largest = Vec::new();
    for start in tiling.tiles.ids() {
        if !kept[start.index()] || seen[start.index()] {
            continue;
        }
        seen[start.index()] = true;
        let (mut piece, mut next) = (vec![start], 0);
        while let Some(&tile) = piece.get(next) {
            next += 1;
            for other in neighbours(tiling, kept, tile) {
                if !std::mem::replace(&mut seen[other.index()], true) {
                    piece.push(other);
                }
            }
        }
        if piece.len() > largest.len() {
            largest = piece;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::SurfacePoint;
    use crate::surface::Vector3;
    use crate::tiling::UniformTiling;

    /// Two flat rooms side by side, joined by a passage one tile wide.
    struct Rooms;

    impl Chart for Rooms {
        fn bounds(&self) -> [Point2<f64>; 2] {
            [Point2::new(-5.0, -5.0), Point2::new(20.0, 5.0)]
        }

        fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
            let room = |x0: f64, x1: f64, y: f64| x0 < p.x && p.x < x1 && p.y.abs() < y;
            (room(-4.6, 4.6, 4.6) || room(4.0, 10.0, 0.6) || room(9.0, 13.6, 2.6))
                .then(|| SurfacePoint { position: [p.x, p.y, 0.0].into(), normal: Vector3::z() })
        }
    }

    fn crop_rooms(without: &BTreeSet<TileId>) -> (Tiling, Vec<TileId>) {
        let [lo, hi] = Rooms.bounds();
        let tiling = UniformTiling::named("4.4.4.4").unwrap().patch(lo, hi);
        let placement = Placement { origin: Point2::new(0.5, 0.5), rotation: 0.0, edge: 1.0 };
        let kept = crop(&tiling, &placement, 0.3, &Rooms, without);
        (tiling, kept)
    }

    #[test]
    fn a_chain_of_single_tiles_joins_rooms_and_its_loss_parts_them() {
        let (tiling, kept) = crop_rooms(&BTreeSet::new());
        let in_passage = |t: &TileId| (5.0..9.0).contains(&tiling.tiles[*t].center.x);
        assert!(kept.iter().any(in_passage));
        let cut: BTreeSet<TileId> = kept.iter().copied().filter(in_passage).take(1).collect();
        let (tiling, kept) = crop_rooms(&cut);
        assert!(kept.iter().all(|&t| tiling.tiles[t].center.x < 5.0), "the larger room stays");
        assert!(kept.len() >= 64);
    }

    #[test]
    fn tiles_come_from_the_middle_outwards() {
        let (tiling, kept) = crop_rooms(&BTreeSet::new());
        let far: Vec<f64> = kept.iter().map(|&t| tiling.tiles[t].center.coords.norm()).collect();
        assert!(far.windows(2).all(|w| w[0] <= w[1] + 1e-6));
    }
}
