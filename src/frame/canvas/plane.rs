//! A pattern in the plane of a chart.

use super::{Canvas, Sizing};
use crate::chart::{Chart, SurfacePoint};
use crate::ids::{TileEdgeId, TileId};
use crate::pattern::{FlatUnit, Line, Pattern, Shape};
use crate::tiling::{Net, Placement, Tiling};
use nalgebra::{Point2, Rotation2, Vector2};
use std::f64::consts::FRAC_PI_2;

/// A tile is tested this much larger than it is, so that the rods at the border
/// keep a little inside the surface; part of the tile's radius.
const MARGIN: f64 = 0.04;

/// Rods keep this far from holes, as part of the tile edge: about their own thickness
/// and overhang at a good fit.
const HOLE_MARGIN: f64 = 0.08;

/// Most tiles that are laid out: some gigabytes. More can only be a slip of a unit.
pub const MOST_UNITS: usize = 1_000_000;

/// A tiling laid on a chart, with the shape of its units. Every tile's flat picture is the
/// plane of the tiling, in tile edges.
#[derive(Clone, Debug)]
pub struct PlaneCanvas<'a, C> {
    chart: &'a C,
    tiling: Tiling,
    placement: Placement,
    shape: Shape,
}

/// More tiles than can be laid out: about so many.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error(
    "units of edge {edge} mm would be some {about:.0} on this surface, more than the \
     {MOST_UNITS} that fit in memory. Use larger units (--unit) or thicker rods (--rod)"
)]
pub struct TooManyUnits {
    /// The tile edge, mm.
    pub edge: f64,
    /// About how many tiles it gives.
    pub about: f64,
}

impl<'a, C: Chart> PlaneCanvas<'a, C> {
    /// Covers the whole chart with a pattern.
    ///
    /// # Errors
    /// More tiles than [`MOST_UNITS`].
    pub fn new(
        chart: &'a C,
        pattern: &Pattern,
        placement: Placement,
        shape: Shape,
    ) -> Result<Self, TooManyUnits> {
        let about = most_units(chart, placement.edge);
        if about > MOST_UNITS as f64 {
            return Err(TooManyUnits { edge: placement.edge, about });
        }
        let [lo, hi] = chart.bounds();
        let corners = [(lo.x, lo.y), (lo.x, hi.y), (hi.x, lo.y), (hi.x, hi.y)];
        let corners = corners.map(|(x, y)| placement.invert(Point2::new(x, y)));
        let low = corners[1..].iter().fold(corners[0], |m, p| m.inf(p));
        let high = corners[1..].iter().fold(corners[0], |m, p| m.sup(p));
        let tiling = pattern.tiling.patch(low, high);
        Ok(Self { chart, tiling, placement, shape })
    }

    /// Unit direction of the rod across an edge, from its left tile to its right one.
    fn direction(&self, edge: TileEdgeId) -> Vector2<f64> {
        let [from, to] = self.tiling.net.edges[edge].ends.map(|v| self.tiling.vertices[v]);
        Rotation2::new(self.shape.turn - FRAC_PI_2) * (to - from).normalize()
    }

    /// Whether a rod of a tile, from its edge to its farther contact, meets a hole.
    fn crosses_hole(&self, rods: &[Line], contacts: &[Point2<f64>]) -> bool {
        let n = rods.len();
        let half_width = HOLE_MARGIN * self.placement.edge;
        (0..n).any(|i| {
            let from = rods[i].at;
            let ends = [contacts[i], contacts[(i + n - 1) % n]].map(|c| (c, (c - from).norm()));
            let (far, _) = if ends[0].1 > ends[1].1 { ends[0] } else { ends[1] };
            let [a, b] = [from, far].map(|p| self.placement.apply(p));
            self.chart.crosses_hole(a, b, half_width)
        })
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        self.chart.lift(self.placement.apply(p))
    }
}

/// An upper bound to the number of tiles of this edge on a chart: as if all were
/// triangles, in the box round it.
pub fn most_units(chart: &impl Chart, edge: f64) -> f64 {
    let [lo, hi] = chart.bounds();
    let triangle = 3f64.sqrt() / 4.0 * edge * edge;
    (hi.x - lo.x) * (hi.y - lo.y) / triangle
}

impl<C: Chart> Canvas for PlaneCanvas<'_, C> {
    fn net(&self) -> &Net {
        &self.tiling.net
    }

    /// Whether every point of the tile that the weaving will ask for is in the chart.
    fn holds(&self, tile: TileId) -> bool {
        let center = self.tiling.centers[tile];
        let lines = self.lines(tile);
        let grown = |p: Point2<f64>| p + (p - center) * MARGIN;
        let corners = self.tiling.net.tiles[tile].corners.iter().map(|&v| self.tiling.vertices[v]);
        let Some(unit) = FlatUnit::new(&lines) else { return false };
        let contacts = unit.contacts.clone();
        let mut points = std::iter::once(center)
            .chain(corners.map(grown))
            .chain(lines.iter().map(|l| grown(l.at)))
            .chain(unit.middles)
            .chain(unit.contacts);
        points.all(|p| self.lift(p).is_some()) && !self.crosses_hole(&lines, &contacts)
    }

    fn rank(&self, tile: TileId) -> [f64; 2] {
        let center = self.tiling.centers[tile].coords;
        // Rings of equal distance are told apart by angle; distances are compared in
        // steps that are coarse against rounding and fine against the tiling.
        [(center.norm() * 1e6).round(), center.y.atan2(center.x)]
    }

    fn middle(&self, tile: TileId) -> Point2<f64> {
        self.tiling.centers[tile]
    }

    fn lines(&self, tile: TileId) -> Vec<Line> {
        let line = |&e: &TileEdgeId| {
            let outward = self.direction(e);
            let inward = if self.tiling.net.edges[e].left == tile { -outward } else { outward };
            Line { at: self.tiling.midpoint(e), inward }
        };
        self.tiling.net.tiles[tile].edges.iter().map(line).collect()
    }

    fn place(&self, _tile: TileId, p: Point2<f64>) -> Option<SurfacePoint> {
        self.lift(p)
    }

    fn edge(&self) -> f64 {
        self.placement.edge
    }

    fn sizing(&self) -> Sizing {
        Sizing {
            larger: "larger units (--unit)",
            smaller: "smaller units (--unit)",
            fitting: "Try units fitted to the rods (without --unit), another pattern (--pattern)",
        }
    }
}
