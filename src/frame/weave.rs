//! Rods, units and contacts in the plane: who meets whom, before any height is known.

use super::Chirality;
use crate::ids::{ContactId, Id, IdVec, RodId, TileEdgeId, TileId, UnitId};
use crate::pattern::UnitShape;
use crate::tiling::{Tile, TileEdge, Tiling};
use nalgebra::{Point2, Rotation2, Vector2};

/// A flat reciprocal pattern, in tile edges.
#[derive(Clone, Debug, Default)]
pub struct Weave {
    /// The rods.
    pub rods: IdVec<RodId, WovenRod>,
    /// The contacts.
    pub contacts: IdVec<ContactId, WovenContact>,
    /// The units.
    pub units: IdVec<UnitId, WovenUnit>,
}

/// A rod in the plane, in tile edges.
#[derive(Clone, Debug)]
pub struct WovenRod {
    /// The unit at end A and the unit at end B. A border rod has none at end A.
    pub units: [Option<UnitId>; 2],
    /// Two points of the axis, towards end A and towards end B: the middles of its
    /// sides of the two inner polygons; for a border rod, first its tile edge.
    pub through: [Point2<f64>; 2],
}

/// A contact in the plane.
#[derive(Clone, Debug)]
pub struct WovenContact {
    /// The rod that ends there, but for its overhang.
    pub ending: RodId,
    /// The rod that passes.
    pub passing: RodId,
    /// The unit.
    pub unit: UnitId,
    /// Where, in tile edges.
    pub at: Point2<f64>,
}

/// A unit in the plane.
#[derive(Clone, Debug)]
pub struct WovenUnit {
    /// The tile that hosts it.
    pub tile: TileId,
    /// Its middle, in tile edges.
    pub center: Point2<f64>,
    /// Which way its rods run.
    pub chirality: Chirality,
    /// Its rods, counter-clockwise.
    pub rods: Vec<RodId>,
    /// Its contacts: contact i lies between rods i and i + 1.
    pub contacts: Vec<ContactId>,
}

/// Weaves shared rods, turned by `turn` radians, on the given tiles. Units and rods
/// are numbered in the order of the tiles.
pub fn weave(tiling: &Tiling, tiles: &[TileId], turn: f64) -> Weave {
    let mut unit_of: IdVec<TileId, Option<UnitId>> = vec![None; tiling.tiles.len()].into();
    for (i, &tile) in tiles.iter().enumerate() {
        unit_of[tile] = Some(UnitId::new(i));
    }
    let mut rod_of: IdVec<TileEdgeId, Option<RodId>> = vec![None; tiling.edges.len()].into();
    let mut weave = Weave::default();
    for &tile in tiles {
        let edges = &tiling.tiles[tile].edges;
        let rods: Vec<RodId> = edges
            .iter()
            .map(|&e| {
                *rod_of[e].get_or_insert_with(|| weave.rods.push(rod(tiling, e, &unit_of, turn)))
            })
            .collect();
        add_unit(&mut weave, tiling, tile, rods, turn);
    }
    weave
}

/// The rod across a tile edge.
fn rod(
    tiling: &Tiling,
    edge: TileEdgeId,
    unit_of: &IdVec<TileId, Option<UnitId>>,
    turn: f64,
) -> WovenRod {
    let &TileEdge { left, right, .. } = &tiling.edges[edge];
    let middle = tiling.midpoint(edge);
    let outward = direction(tiling, edge, turn);
    let reach = |tile: TileId| UnitShape::new(tiling.tiles[tile].corners.len(), turn).middle;
    let left = unit_of[left].map(|u| (u, middle - outward * reach(left)));
    let right = right.and_then(|t| unit_of[t].map(|u| (u, middle + outward * reach(t))));
    match (left, right) {
        (Some((a, p)), Some((b, q))) => WovenRod { units: [Some(a), Some(b)], through: [p, q] },
        (Some((u, p)), None) | (None, Some((u, p))) => {
            WovenRod { units: [None, Some(u)], through: [middle, p] }
        }
        (None, None) => unreachable!("rods are made for the edges of tiles that have a unit"),
    }
}

/// Unit direction of the rod across an edge, from its left tile to its right one.
fn direction(tiling: &Tiling, edge: TileEdgeId, turn: f64) -> Vector2<f64> {
    let [from, to] = tiling.edges[edge].ends.map(|v| tiling.vertices[v]);
    let outward = Rotation2::new(-std::f64::consts::FRAC_PI_2) * (to - from).normalize();
    Rotation2::new(turn) * outward
}

fn add_unit(weave: &mut Weave, tiling: &Tiling, tile: TileId, rods: Vec<RodId>, turn: f64) {
    let unit = UnitId::new(weave.units.len());
    let Tile { edges, center, .. } = &tiling.tiles[tile];
    // Each rod as seen from this tile: where it enters, and the way inwards.
    let lines: Vec<(Point2<f64>, Vector2<f64>)> = edges
        .iter()
        .map(|&e| {
            let outward = direction(tiling, e, turn);
            let inward = if tiling.edges[e].left == tile { -outward } else { outward };
            (tiling.midpoint(e), inward)
        })
        .collect();
    let n = rods.len();
    let mut contacts = Vec::with_capacity(n);
    for i in 0..n {
        let j = (i + 1) % n;
        let ((p, u), (q, v)) = (lines[i], lines[j]);
        let s = (q - p).perp(&v) / u.perp(&v);
        let t = (q - p).perp(&u) / u.perp(&v);
        // The rod that comes to the crossing later ends there.
        let (ending, passing) = if s > t { (rods[i], rods[j]) } else { (rods[j], rods[i]) };
        contacts.push(weave.contacts.push(WovenContact { ending, passing, unit, at: p + u * s }));
    }
    let chirality = if turn > 0.0 { Chirality::CounterClockwise } else { Chirality::Clockwise };
    weave.units.push(WovenUnit { tile, center: *center, chirality, rods, contacts });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::LIBRARY;

    #[test]
    fn inner_rods_have_four_contacts_and_border_rods_two() {
        for pattern in LIBRARY {
            let tiling = pattern.tiling().patch(Point2::new(-5.0, -5.0), Point2::new(5.0, 5.0));
            let tiles: Vec<TileId> = tiling.tiles.ids().collect();
            let weave = weave(&tiling, &tiles, pattern.turn.to_radians());
            let mut ending = vec![0; weave.rods.len()];
            let mut passing = vec![0; weave.rods.len()];
            for c in &weave.contacts {
                ending[c.ending.index()] += 1;
                passing[c.passing.index()] += 1;
            }
            for (r, rod) in weave.rods.enumerate() {
                let units = rod.units.iter().flatten().count();
                assert_eq!((ending[r.index()], passing[r.index()]), (units, units), "{r}");
                assert!(rod.units[1].is_some(), "{r}: end B always belongs to a unit");
            }
            for unit in &weave.units {
                assert_eq!(unit.contacts.len(), unit.rods.len());
            }
        }
    }

    /// The contacts of a unit form a regular polygon round its centre.
    #[test]
    fn units_are_regular() {
        for pattern in LIBRARY {
            let tiling = pattern.tiling().patch(Point2::new(-4.0, -4.0), Point2::new(4.0, 4.0));
            let tiles: Vec<TileId> = tiling.tiles.ids().collect();
            for turn in [pattern.turn.to_radians(), -pattern.turn.to_radians()] {
                let weave = weave(&tiling, &tiles, turn);
                for unit in &weave.units {
                    let n = unit.rods.len();
                    let shape = UnitShape::new(n, turn);
                    let radius = shape.hole.abs() / (std::f64::consts::PI / n as f64).cos();
                    for &c in &unit.contacts {
                        let found = (weave.contacts[c].at - unit.center).norm();
                        assert!((found - radius).abs() < 1e-12, "{}: {found}", pattern.name);
                    }
                }
            }
        }
    }
}
