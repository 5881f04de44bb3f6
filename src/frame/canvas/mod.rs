//! What a frame is woven on: tiles, each with a flat picture of its own in which its
//! rods are straight lines, and the way from there to the surface.
//!
//! One weaving serves three kinds of surface: a plane pattern on a chart
//! ([`PlaneCanvas`]), a polyhedron on a sphere ([`SphereCanvas`]), and the polygons of a
//! mesh ([`MeshCanvas`]).

mod facets;
mod field;
#[cfg(test)]
pub mod fixture;
mod plane;
mod sphere;

pub use facets::{MeshCanvas, MeshTiles};
pub use field::Field;
pub use plane::{MOST_UNITS, PlaneCanvas, PlaneError, TooManyUnits, most_units};
pub use sphere::{SphereCanvas, SphereTiles};

use crate::chart::SurfacePoint;
use crate::ids::{Id, IdVec, TileEdgeId, TileId};
use crate::pattern::{Figure, Guest, Join, Line};
use crate::surface::Vector3;
use crate::tiling::Net;
use nalgebra::Point2;

/// A tiled surface with the line of each rod.
pub trait Canvas {
    /// Which tile borders on which.
    fn net(&self) -> &Net;

    /// Whether a tile lies on the surface, with all that its rods need.
    fn holds(&self, tile: TileId) -> bool;

    /// Where a tile comes when rods and units are numbered: by ring from the middle,
    /// then by angle about it.
    fn rank(&self, tile: TileId) -> [f64; 2];

    /// The middle of a tile in its flat picture.
    fn middle(&self, tile: TileId) -> Point2<f64>;

    /// The rods across the edges of a tile, in the order of its edges, in its flat
    /// picture.
    fn lines(&self, tile: TileId) -> Vec<Line>;

    /// All rods of the tile's unit in its flat picture.
    fn figure(&self, tile: TileId) -> Figure {
        Figure { outer: self.lines(tile), ..Figure::default() }
    }

    /// How the rods on both sides of an edge join.
    fn join(&self, _edge: TileEdgeId) -> Join {
        Join::Shared
    }

    /// The rod of the neighbour across a side of a tile, where it comes in to rest.
    fn guest(&self, _tile: TileId, _side: usize) -> Option<Guest> {
        None
    }

    /// The place of the surface that belongs to a point of a tile's flat picture;
    /// `None` outside the surface.
    fn place(&self, tile: TileId, p: Point2<f64>) -> Option<SurfacePoint>;

    /// Mean tile edge on the surface, mm.
    fn edge(&self) -> f64;

    /// How to get other units, for messages.
    fn sizing(&self) -> Sizing;
}

/// What the user can change to get larger or smaller units.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sizing {
    /// How to get larger units.
    pub larger: &'static str,
    /// How to get smaller ones.
    pub smaller: &'static str,
    /// How to get units that suit the rods.
    pub fitting: &'static str,
    /// What else to try where they do not.
    pub other: &'static str,
}

/// Ranks of tiles with these middles, seen from above: rings of neighbours round the
/// tiles nearest to `top`, in each ring by angle about it.
fn ranks(net: &Net, middles: &[Vector3], top: &Vector3) -> IdVec<TileId, [f64; 2]> {
    let far = |m: &Vector3| (m - top).norm();
    let least = middles.iter().map(far).fold(f64::INFINITY, f64::min);
    let size = middles.iter().map(far).fold(0.0, f64::max);
    let nearest = |&i: &usize| far(&middles[i]) <= least + SAME * size;
    let starts = (0..middles.len()).filter(nearest).map(TileId::new);
    let rings = net.rings(starts);
    // In whole steps, so that rounding does not decide.
    let angle = |m: &Vector3| ((m.y - top.y).atan2(m.x - top.x) / SAME).round();
    rings.iter().zip(middles).map(|(&ring, m)| [ring as f64, angle(m)]).collect()
}

/// Distances, as part of the size, and angles, radians, that count as the same when
/// tiles are numbered; smaller, and rounding decides.
const SAME: f64 = 1e-6;
