//! Which unit lies on which tile, and how it is turned.

mod repeat;
mod solve;

#[cfg(test)]
mod tests;

pub(super) use repeat::Repeat;

use super::joints::{Joints, RulesError};
use super::{Join, Pattern};
use crate::ids::{IdVec, TileEdgeId, TileId};
use crate::tiling::Tiling;
use thiserror::Error;

/// The units on the tiles of a patch. The same tile has the same unit in every patch of
/// the tiling.
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// The unit on each tile.
    pub tiles: IdVec<TileId, Place>,
    /// How the units on the two sides of an edge join; `Shared` where there is but one.
    pub joins: IdVec<TileEdgeId, Join>,
}

/// A unit as it lies on a tile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Place {
    /// The unit, as an index of [`Pattern::kinds`].
    pub kind: usize,
    /// The side of the unit that lies at edge 0 of the tile; the next ones follow
    /// counter-clockwise.
    pub first: usize,
    /// Whether the tile has the colour of the one nearest the origin, when tiles side by
    /// side differ in colour. True everywhere where two colours are not enough, as
    /// [`Pattern::alternates`] tells.
    pub even: bool,
}

/// Why units cannot be laid on tiles.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum LayoutError {
    /// Units and rules do not fit together.
    #[error(transparent)]
    Rules(#[from] RulesError),
    /// Rules that fit round each vertex do not fit further out, whatever is chosen.
    #[error(
        "laid out as {tiling} the rules lead to a dead end in {}: no unit of {sides} sides \
         fits there{}. Add rules, or name other sides",
        ring_words(*ring),
        beside_words(beside)
    )]
    DeadEnd { tiling: &'static str, sides: usize, ring: usize, beside: Vec<String> },
    /// No arrangement that repeats was found.
    #[error(
        "laid out as {tiling} the rules leave choices that lead to dead ends; no arrangement \
         was found that repeats. Name the sides that come together, or add rules"
    )]
    NoRepeat { tiling: &'static str },
    /// A tile that is not one of the pattern's tiling.
    #[error("tile {tile} is not one of the tiling {tiling}")]
    Foreign { tile: TileId, tiling: &'static str },
}

fn ring_words(ring: usize) -> String {
    if ring == 0 { "the middle".into() } else { format!("ring {ring} round the middle") }
}

fn beside_words(beside: &[String]) -> String {
    match beside {
        [] => String::new(),
        [.., _] => format!(" beside {}", beside.join(" and ")),
    }
}

impl Layout {
    /// The units on a patch of the pattern's tiling.
    ///
    /// # Errors
    /// [`LayoutError`] where the rules do not allow it, or the patch is of another tiling.
    pub fn new(pattern: &Pattern, patch: &Tiling) -> Result<Self, LayoutError> {
        let joints = Joints::new(&pattern.kinds, &pattern.rules)?;
        let repeat = Repeat::find(&pattern.kinds, &joints, pattern.tiling)?;
        let foreign = |tile| LayoutError::Foreign { tile, tiling: pattern.tiling.name };
        let place = |tile| {
            let spot = repeat.cell().find(patch, tile).ok_or_else(|| foreign(tile))?;
            let ((kind, first), even) = repeat.place(spot);
            Ok(Place { kind, first, even })
        };
        let net = &patch.net;
        let tiles: IdVec<TileId, Place> =
            net.tiles.ids().map(place).collect::<Result<Vec<_>, LayoutError>>()?.into();
        let slot = |tile: TileId, edge: TileEdgeId| {
            let at = net.tiles[tile].edges.iter().position(|&e| e == edge)?;
            Some(joints.slot(tiles[tile].kind, tiles[tile].first + at))
        };
        let join = |(id, edge): (TileEdgeId, &crate::tiling::TileEdge)| {
            let Some(right) = edge.right else { return Ok(Join::Shared) };
            let joined =
                slot(edge.left, id).zip(slot(right, id)).and_then(|(a, b)| joints.join(a, b));
            joined.ok_or_else(|| foreign(edge.left))
        };
        let joins = net.edges.enumerate().map(join).collect::<Result<Vec<_>, _>>()?.into();
        Ok(Self { tiles, joins })
    }
}
