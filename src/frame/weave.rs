//! Rods, units and contacts: who meets whom, and the places on the surface through
//! which the rods are to run (paper, section 4.2).

use super::Chirality;
use super::canvas::Canvas;
use crate::chart::SurfacePoint;
use crate::ids::{ContactId, Id, IdVec, RodId, TileEdgeId, TileId, UnitId};
use crate::pattern::FlatUnit;
use crate::surface::Point3;

/// A reciprocal pattern on its surface, before any rod is straight.
#[derive(Clone, Debug, Default)]
pub struct Weave {
    /// The rods.
    pub rods: IdVec<RodId, WovenRod>,
    /// The contacts.
    pub contacts: IdVec<ContactId, WovenContact>,
    /// The units.
    pub units: IdVec<UnitId, WovenUnit>,
}

/// A rod across a tile edge.
#[derive(Clone, Debug)]
pub struct WovenRod {
    /// The unit at end A and the unit at end B. A border rod has none at end A.
    pub units: [Option<UnitId>; 2],
    /// Two places of the surface, towards end A and towards end B: the middles of its
    /// sides of the two inner polygons; for a border rod, first its tile edge.
    pub through: [Point3; 2],
}

/// A contact.
#[derive(Clone, Debug)]
pub struct WovenContact {
    /// The rod that ends there, but for its overhang.
    pub ending: RodId,
    /// The rod that passes.
    pub passing: RodId,
    /// The unit.
    pub unit: UnitId,
    /// Where on the surface.
    pub on: SurfacePoint,
}

/// A unit.
#[derive(Clone, Debug)]
pub struct WovenUnit {
    /// The tile that hosts it.
    pub tile: TileId,
    /// Its middle on the surface.
    pub center: SurfacePoint,
    /// Which way its rods run.
    pub chirality: Chirality,
    /// Its rods, counter-clockwise.
    pub rods: Vec<RodId>,
    /// Its contacts: contact i lies between rods i and i + 1.
    pub contacts: Vec<ContactId>,
}

/// Why a tile cannot become a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unweavable {
    /// The tile.
    pub tile: TileId,
    /// What is wrong, as a clause.
    pub reason: &'static str,
}

/// A tile with its rods laid out and placed on the surface.
struct Placed {
    center: SurfacePoint,
    counter_clockwise: bool,
    /// For each edge, where the rod crosses it, and the middle of the rod's side.
    rods: Vec<[Point3; 2]>,
    contacts: Vec<SurfacePoint>,
}

/// Weaves shared rods on the given tiles. Units and rods are numbered in the order of
/// the tiles.
///
/// # Errors
/// All tiles that reach beyond the surface, or whose rods form no circuit.
pub fn weave(canvas: &impl Canvas, tiles: &[TileId]) -> Result<Weave, Vec<Unweavable>> {
    let net = canvas.net();
    let (mut placed, mut failed) = (Vec::with_capacity(tiles.len()), Vec::new());
    for &tile in tiles {
        match place(canvas, tile) {
            Ok(unit) => placed.push(unit),
            Err(fault) => failed.push(fault),
        }
    }
    if !failed.is_empty() {
        return Err(failed);
    }
    let mut unit_of: IdVec<TileId, Option<UnitId>> = vec![None; net.tiles.len()].into();
    for (i, &tile) in tiles.iter().enumerate() {
        unit_of[tile] = Some(UnitId::new(i));
    }
    // Where the rod of an edge runs, seen from one of its two tiles.
    let seen = |edge: TileEdgeId, tile: TileId| {
        let unit = unit_of[tile]?;
        let side = net.tiles[tile].edges.iter().position(|&e| e == edge)?;
        Some((unit, placed[unit.index()].rods[side]))
    };
    let rod = |e: TileEdgeId| {
        let edge = &net.edges[e];
        match (seen(e, edge.left), edge.right.and_then(|t| seen(e, t))) {
            (Some((a, [_, p])), Some((b, [_, q]))) => {
                WovenRod { units: [Some(a), Some(b)], through: [p, q] }
            }
            (Some((unit, through)), None) | (None, Some((unit, through))) => {
                WovenRod { units: [None, Some(unit)], through }
            }
            (None, None) => unreachable!("rods are made for the edges of tiles that have a unit"),
        }
    };
    let mut rod_of: IdVec<TileEdgeId, Option<RodId>> = vec![None; net.edges.len()].into();
    let mut weave = Weave::default();
    for (&tile, placed) in tiles.iter().zip(&placed) {
        let rods = net.tiles[tile]
            .edges
            .iter()
            .map(|&e| *rod_of[e].get_or_insert_with(|| weave.rods.push(rod(e))))
            .collect();
        add_unit(&mut weave, tile, placed, rods);
    }
    Ok(weave)
}

fn place(canvas: &impl Canvas, tile: TileId) -> Result<Placed, Unweavable> {
    let outside = Unweavable { tile, reason: "reaches beyond the surface" };
    let uneven = Unweavable { tile, reason: "its tile is too uneven: the rods form no circuit" };
    let on = |p| canvas.place(tile, p).ok_or_else(|| outside.clone());
    let lines = canvas.lines(tile);
    let unit = FlatUnit::new(&lines).ok_or(uneven)?;
    let rods = lines
        .iter()
        .zip(&unit.middles)
        .map(|(line, &middle)| Ok([on(line.at)?.position, on(middle)?.position]))
        .collect::<Result<_, _>>()?;
    Ok(Placed {
        center: on(canvas.middle(tile))?,
        counter_clockwise: unit.counter_clockwise,
        rods,
        contacts: unit.contacts.iter().map(|&p| on(p)).collect::<Result<_, _>>()?,
    })
}

fn add_unit(weave: &mut Weave, tile: TileId, placed: &Placed, rods: Vec<RodId>) {
    let unit = UnitId::new(weave.units.len());
    let n = rods.len();
    let contacts = (0..n)
        .map(|i| {
            let (first, second) = (rods[i], rods[(i + 1) % n]);
            let (ending, passing) =
                if placed.counter_clockwise { (second, first) } else { (first, second) };
            weave.contacts.push(WovenContact { ending, passing, unit, on: placed.contacts[i] })
        })
        .collect();
    let chirality =
        if placed.counter_clockwise { Chirality::CounterClockwise } else { Chirality::Clockwise };
    weave.units.push(WovenUnit { tile, center: placed.center, chirality, rods, contacts });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::canvas::PlaneCanvas;
    use crate::frame::canvas::fixture::Sheet;
    use crate::pattern::{Pattern, Shape, library};
    use crate::tiling::Placement;

    fn woven(pattern: &Pattern, turn: f64) -> Weave {
        let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 1.0 };
        let canvas = PlaneCanvas::new(&Sheet, pattern, placement, Shape { turn, slide: 0.0 })
            .expect("few tiles");
        let tiles: Vec<TileId> = canvas.net().tiles.ids().collect();
        weave(&canvas, &tiles).expect("a flat sheet")
    }

    #[test]
    fn inner_rods_have_four_contacts_and_border_rods_two() {
        for pattern in library() {
            let weave = woven(pattern, pattern.usual().turn);
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

    /// The contacts of a unit form a regular polygon round its centre, of inradius
    /// r sin φ with r that of the tile.
    #[test]
    fn units_are_regular_and_run_as_the_turn_says() {
        for pattern in library() {
            for turn in [pattern.usual().turn, -pattern.usual().turn] {
                let weave = woven(pattern, turn);
                for unit in &weave.units {
                    let half_step = std::f64::consts::PI / unit.rods.len() as f64;
                    let hole = 0.5 / half_step.tan() * turn.sin().abs();
                    for &c in &unit.contacts {
                        let middle = weave.contacts[c].on.position - unit.center.position;
                        assert!((middle.norm() - hole / half_step.cos()).abs() < 1e-12);
                    }
                    assert_eq!(unit.chirality == Chirality::CounterClockwise, turn > 0.0);
                }
            }
        }
    }
}
