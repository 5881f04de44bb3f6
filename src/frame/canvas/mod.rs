//! What a frame is woven on: tiles, each with a flat picture of its own in which its
//! rods are straight lines, and the way from there to the surface.
//!
//! One weaving serves three kinds of surface: a plane pattern on a chart
//! ([`PlaneCanvas`]), a polyhedron on a sphere ([`SphereCanvas`]), and the polygons of a
//! mesh ([`MeshCanvas`]).

#[cfg(test)]
pub mod fixture;
mod plane;

pub use plane::{MOST_UNITS, PlaneCanvas, TooManyUnits, most_units};

use crate::chart::SurfacePoint;
use crate::ids::TileId;
use crate::pattern::Line;
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
    /// What to try where rods and units do not suit each other, as a clause.
    pub fitting: &'static str,
}
