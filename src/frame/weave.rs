//! Rods, units and contacts: who meets whom, and the places on the surface through
//! which the rods are to run (paper, section 4.2).

mod thread;

use super::canvas::Canvas;
use super::{Chirality, ContactKind};
use crate::chart::SurfacePoint;
use crate::ids::{ContactId, Id, IdVec, RodId, TileId, UnitId};
use crate::pattern::{Guest, Line, Meetings, Unmet};
use crate::surface::Point3;
use nalgebra::Point2;

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

/// A rod.
#[derive(Clone, Debug)]
pub struct WovenRod {
    /// The units that it belongs to: two where they share it, that at end A first.
    pub units: Vec<UnitId>,
    /// What is at end A and at end B. Rods that leave their unit do so at end A.
    pub ends: [RodEnd; 2],
    /// Two places of the surface, towards end A and towards end B: half-way between the
    /// last two contacts where it rests, so that the end comes to lie on what it rests on;
    /// where it does not, its very end.
    pub through: [Point3; 2],
    /// Its contacts, from end A to end B.
    pub contacts: Vec<ContactId>,
}

/// What is at the end of a rod.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RodEnd {
    /// Nothing: it is at the border of the frame.
    Free,
    /// It rests on the rod of its last contact.
    Rests,
    /// It meets the end of another rod.
    Meets,
}

/// A contact.
#[derive(Clone, Debug)]
pub struct WovenContact {
    /// How the two touch; of ends, that of the ending rod first.
    pub kind: ContactKind,
    /// The rod that ends there, but for its overhang.
    pub ending: RodId,
    /// The rod that passes.
    pub passing: RodId,
    /// The unit in whose tile it lies.
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
    /// The number of its outer rods.
    pub sides: usize,
    /// Its outer rods, counter-clockwise, then its inner ones.
    pub rods: Vec<RodId>,
    /// The contacts in its tile. In a circuit, contact i between outer rods i and i + 1
    /// comes first.
    pub contacts: Vec<ContactId>,
    /// Where the contacts of its circuit lie in the flat picture of its tile; none without
    /// a circuit.
    pub corners: Vec<Point2<f64>>,
}

/// Why a tile cannot become a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unweavable {
    /// The tile.
    pub tile: TileId,
    /// What is wrong, as a clause.
    pub reason: &'static str,
}

/// A tile whose rods are laid out, and placed on the surface.
struct Placed {
    tile: TileId,
    center: SurfacePoint,
    /// The lines of its outer rods, in the order of its edges.
    lines: Vec<Line>,
    /// The number of its inner rods.
    inner: usize,
    guests: Vec<Guest>,
    meetings: Meetings,
    /// Where the contacts lie on the surface.
    on: Vec<SurfacePoint>,
}

/// Weaves the given tiles. Units and rods are numbered in the order of the tiles.
///
/// # Errors
/// All tiles that reach beyond the surface, or whose rods form no unit.
pub fn weave(canvas: &impl Canvas, tiles: &[TileId]) -> Result<Weave, Vec<Unweavable>> {
    let mut unit_of: IdVec<TileId, Option<UnitId>> = vec![None; canvas.net().tiles.len()].into();
    for (i, &tile) in tiles.iter().enumerate() {
        unit_of[tile] = Some(UnitId::new(i));
    }
    let (mut placed, mut failed) = (Vec::with_capacity(tiles.len()), Vec::new());
    for &tile in tiles {
        match place(canvas, tile, &unit_of) {
            Ok(unit) => placed.push(unit),
            Err(fault) => failed.push(fault),
        }
    }
    if failed.is_empty() { thread::thread(canvas, &placed.into(), &unit_of) } else { Err(failed) }
}

fn place(
    canvas: &impl Canvas,
    tile: TileId,
    unit_of: &IdVec<TileId, Option<UnitId>>,
) -> Result<Placed, Unweavable> {
    let fault = |reason| Unweavable { tile, reason };
    let on = |p| canvas.place(tile, p).ok_or(fault("reaches beyond the surface"));
    let net = canvas.net();
    let figure = canvas.figure(tile);
    let comes = |side: usize| {
        let other = net.across(net.tiles[tile].edges[side], tile)?;
        unit_of[other].and(canvas.guest(tile, side))
    };
    let guests: Vec<Guest> = (0..figure.outer.len()).filter_map(comes).collect();
    let meetings = figure.meetings(&guests).map_err(|unmet| {
        fault(match unmet {
            Unmet::NoCircuit => "its tile is too uneven: the rods form no circuit",
            Unmet::Guest(_) => "a rod of a neighbour that should rest on one of its rods misses",
        })
    })?;
    Ok(Placed {
        tile,
        center: on(canvas.middle(tile))?,
        on: meetings.all.iter().map(|m| on(m.at)).collect::<Result<_, _>>()?,
        meetings,
        lines: figure.outer,
        inner: figure.inner.len(),
        guests,
    })
}

#[cfg(test)]
mod tests;
