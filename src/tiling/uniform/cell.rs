//! The repeating cell of a tiling, as a net that closes on itself.

use super::{Tiling, UniformTiling, walk};
use crate::ids::TileId;
use nalgebra::{Point2, Vector2};

/// One tile of each class of tiles that are shifted copies of each other.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The two shifts that carry the tiling onto itself and span the cell.
    pub translations: [Vector2<f64>; 2],
    /// The tiles; the first is the one nearest the origin, and each the nearest of its
    /// class. Of those at one distance the first one counter-clockwise from the x axis.
    pub tiles: Vec<CellTile>,
}

/// A tile of a cell.
#[derive(Clone, Debug)]
pub struct CellTile {
    /// Its middle.
    pub center: Point2<f64>,
    /// From its middle to its first corner, where its first edge starts.
    pub corner: Vector2<f64>,
    /// What lies across its edges; edge i joins corners i and i + 1.
    pub across: Vec<Across>,
}

/// A tile at the other side of an edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Across {
    /// Where it is.
    pub spot: Spot,
    /// The edge as that tile counts it.
    pub edge: usize,
}

/// A tile anywhere in the tiling: one of a cell, shifted.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Spot {
    /// The tile of [`Cell::tiles`].
    pub tile: usize,
    /// How often each translation is applied to it.
    pub shift: [i64; 2],
}

/// Places closer than this are the same, in tile edges. Sums of steps are exact to 1e-12;
/// different middles are more than half an edge apart.
const SAME: f64 = 1e-6;

/// The tiles of a cell and their neighbours reach this much beyond half its shifts, in
/// tile edges: a neighbour of twelve sides, and what its own middle is off.
const REACH: f64 = 8.0;

impl UniformTiling {
    /// The repeating cell, with the tiles nearest the origin.
    pub fn cell(&self) -> Cell {
        let translations = self.translations.map(|steps| walk(steps).point().coords);
        let half = translations.iter().map(|t| t.norm() / 2.0).sum::<f64>() + REACH;
        let patch = self.patch(Point2::new(-half, -half), Point2::new(half, half));
        let mut near: Vec<TileId> = patch.net.tiles.ids().collect();
        near.sort_by_cached_key(|&t| nearness(patch.centers[t]));
        let mut cell = Cell { translations, tiles: Vec::new() };
        let mut chosen: Vec<TileId> = Vec::new();
        let mut missing = cell.area();
        for tile in near {
            if missing > SAME && cell.find(&patch, tile).is_none() {
                let center = patch.centers[tile];
                let corner = patch.vertices[patch.net.tiles[tile].corners[0]] - center;
                let across = vec![Across::NOWHERE; patch.net.tiles[tile].edges.len()];
                missing -= area(across.len());
                cell.tiles.push(CellTile { center, corner, across });
                chosen.push(tile);
            }
        }
        for (i, tile) in chosen.into_iter().enumerate() {
            for (e, across) in cell.beyond(&patch, tile).into_iter().enumerate() {
                cell.tiles[i].across[e] = across;
            }
        }
        cell
    }
}

/// Orders places by distance from the origin, then counter-clockwise; rounded, so that it
/// does not depend on the last digits.
fn nearness(p: Point2<f64>) -> (i64, i64) {
    let steps = |x: f64| (x / SAME).round() as i64;
    let angle = steps(p.y.atan2(p.x)).rem_euclid(steps(std::f64::consts::TAU));
    (steps(p.coords.norm()), angle)
}

/// Area of a regular polygon of edge one.
fn area(sides: usize) -> f64 {
    let n = sides as f64;
    n / 4.0 / (std::f64::consts::PI / n).tan()
}

impl Cell {
    fn area(&self) -> f64 {
        self.translations[0].perp(&self.translations[1]).abs()
    }

    /// Where a tile of a patch is; `None` if the patch is not one of this tiling as
    /// [`UniformTiling::patch`] makes it.
    pub fn find(&self, patch: &Tiling, tile: TileId) -> Option<Spot> {
        let (center, corners) = (patch.centers[tile], &patch.net.tiles[tile].corners);
        let corner = patch.vertices[*corners.first()?] - center;
        let [e1, e2] = self.translations;
        let det = e1.perp(&e2);
        self.tiles.iter().enumerate().find_map(|(i, known)| {
            let same = known.across.len() == corners.len() && (known.corner - corner).norm() < SAME;
            let apart = center - known.center;
            let shift = [apart.perp(&e2) / det, e1.perp(&apart) / det].map(f64::round);
            let rest = apart - e1 * shift[0] - e2 * shift[1];
            (same && rest.norm() < SAME)
                .then(|| Spot { tile: i, shift: shift.map(|steps| steps as i64) })
        })
    }

    /// What lies across the edges of a tile that has all its neighbours.
    fn beyond(&self, patch: &Tiling, tile: TileId) -> Vec<Across> {
        let net = &patch.net;
        let edges = net.tiles[tile].edges.iter();
        let across = edges.filter_map(|&e| {
            let other = net.across(e, tile)?;
            let edge = net.tiles[other].edges.iter().position(|&o| o == e)?;
            Some(Across { spot: self.find(patch, other)?, edge })
        });
        across.collect()
    }
}

impl Across {
    /// Before it is known.
    const NOWHERE: Self = Self { spot: Spot { tile: 0, shift: [0; 2] }, edge: 0 };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::tiling::UNIFORM;

    #[test]
    fn cells_cover_their_area_and_neighbours_know_each_other() {
        for tiling in UNIFORM {
            let cell = tiling.cell();
            let covered: f64 = cell.tiles.iter().map(|t| area(t.across.len())).sum();
            assert!((covered - cell.area()).abs() < 1e-9, "{}: {covered}", tiling.name);
            for (i, tile) in cell.tiles.iter().enumerate() {
                for (e, across) in tile.across.iter().enumerate() {
                    let Spot { tile: j, shift: [p, q] } = across.spot;
                    let back = cell.tiles[j].across[across.edge];
                    let home = Spot { tile: i, shift: [-p, -q] };
                    assert_eq!(back, Across { spot: home, edge: e }, "{} {i} {e}", tiling.name);
                }
            }
        }
    }

    #[test]
    fn tiles_are_found_far_away_and_lie_side_by_side_as_in_the_patch() {
        for tiling in UNIFORM {
            let cell = tiling.cell();
            let patch = tiling.patch(Point2::new(995.0, -2012.0), Point2::new(1010.0, -2000.0));
            for (e, edge) in patch.net.edges.enumerate() {
                let Some(right) = edge.right else { continue };
                let [l, r] = [edge.left, right].map(|t| cell.find(&patch, t).unwrap());
                let at = |t| patch.net.tiles[t].edges.iter().position(|&o| o == e).unwrap();
                let across = cell.tiles[l.tile].across[at(edge.left)];
                let shift = [0, 1].map(|i| l.shift[i] + across.spot.shift[i]);
                assert_eq!(Spot { shift, ..across.spot }, r, "{}", tiling.name);
                assert_eq!(across.edge, at(right));
            }
        }
    }

    #[test]
    fn the_first_tile_is_nearest_the_origin() {
        for tiling in UNIFORM {
            let cell = tiling.cell();
            let least = cell.tiles.iter().map(|t| nearness(t.center)).min();
            assert_eq!(Some(nearness(cell.tiles[0].center)), least, "{}", tiling.name);
        }
    }

    #[test]
    fn tiles_of_other_tilings_are_not_found() {
        let [squares, hexagons] = ["4.4.4.4", "6.6.6"].map(|n| UniformTiling::named(n).unwrap());
        let patch = squares.patch(Point2::new(-2.0, -2.0), Point2::new(2.0, 2.0));
        let mut moved = patch.clone();
        moved.centers.iter_mut().for_each(|c| c.x += 0.5);
        assert_eq!(hexagons.cell().find(&patch, TileId::new(0)), None);
        assert_eq!(squares.cell().find(&moved, TileId::new(0)), None);
    }
}
