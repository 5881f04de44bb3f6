//! Tilings: an N-gon hosts a unit of N rods, an edge hosts a connection (paper, section
//! 3.1). Edge-to-edge tilings of the plane by regular polygons, and polyhedra, which are
//! tilings of the sphere.

pub mod conway;
mod geodesic;
mod lattice;
pub mod midsphere;
mod net;
mod polyhedron;
mod uniform;

pub use lattice::{DIRECTIONS, Lattice};
pub use net::{Net, Tile, TileEdge};
pub use polyhedron::{Polyhedron, Seed};
pub use uniform::{Across, Cell, CellTile, Spot, UNIFORM, UniformTiling};

use crate::ids::{IdVec, TileEdgeId, TileId};
use nalgebra::{Point2, Rotation2, Vector2};

/// A finite piece of a tiling of the plane, in edge lengths.
#[derive(Clone, Debug, Default)]
pub struct Tiling {
    /// Which tile borders on which.
    pub net: Net,
    /// Vertex positions.
    pub vertices: Vec<Point2<f64>>,
    /// The middles of the tiles.
    pub centers: IdVec<TileId, Point2<f64>>,
}

impl Tiling {
    /// The middle of an edge.
    pub fn midpoint(&self, edge: TileEdgeId) -> Point2<f64> {
        let [a, b] = self.net.edges[edge].ends.map(|v| self.vertices[v]);
        nalgebra::center(&a, &b)
    }
}

/// Where a tiling lies in the plane of a chart.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement {
    /// Where the tiling's own origin comes to lie, mm.
    pub origin: Point2<f64>,
    /// Turn about that point, radians, counter-clockwise.
    pub rotation: f64,
    /// Edge length, mm.
    pub edge: f64,
}

impl Placement {
    /// From the tiling's coordinates (in edges) to the chart's (mm).
    pub fn apply(&self, p: Point2<f64>) -> Point2<f64> {
        self.origin + self.vector(p.coords)
    }

    /// The same for directions and offsets.
    pub fn vector(&self, v: Vector2<f64>) -> Vector2<f64> {
        Rotation2::new(self.rotation) * v * self.edge
    }

    /// From the chart's coordinates back to the tiling's.
    pub fn invert(&self, p: Point2<f64>) -> Point2<f64> {
        (Rotation2::new(-self.rotation) * (p - self.origin) / self.edge).into()
    }
}
