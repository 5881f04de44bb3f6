//! A pattern in the plane of a chart.

use super::{Canvas, Field, Sizing};
use crate::chart::{Chart, PlanarChart, SurfacePoint};
use crate::ids::{TileEdgeId, TileId};
use crate::pattern::{
    Figure, Guest, Join, Layout, LayoutError, Line, Meeting, Meetings, Member, Pattern, Shape,
    Stick, UnitKind,
};
use crate::tiling::{Net, Placement, Tile, Tiling};
use nalgebra::{Point2, Rotation2, Vector2};
use std::f64::consts::TAU;

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
    layout: Layout,
    kinds: Vec<UnitKind>,
    /// For each kind, how its rods join where the layout ends, and no neighbour says it.
    alone: Vec<Join>,
    placement: Placement,
    shape: Shape,
    /// How the pattern is moved; only the tiles that take part are held.
    field: Option<Field>,
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

/// Why a pattern cannot be laid on a chart.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PlaneError {
    /// The tiles are too many.
    #[error(transparent)]
    TooMany(#[from] TooManyUnits),
    /// The rules do not say which unit lies where.
    #[error(transparent)]
    Layout(#[from] LayoutError),
}

impl<'a, C: Chart> PlaneCanvas<'a, C> {
    /// Covers the whole chart with a pattern.
    ///
    /// # Errors
    /// [`PlaneError`].
    pub fn new(
        chart: &'a C,
        pattern: &Pattern,
        placement: Placement,
        shape: Shape,
    ) -> Result<Self, PlaneError> {
        let about = most_units(chart, placement.edge);
        if about > MOST_UNITS as f64 {
            return Err(TooManyUnits { edge: placement.edge, about }.into());
        }
        let [lo, hi] = chart.bounds();
        let corners = [(lo.x, lo.y), (lo.x, hi.y), (hi.x, lo.y), (hi.x, hi.y)];
        let corners = corners.map(|(x, y)| placement.invert(Point2::new(x, y)));
        let low = corners[1..].iter().fold(corners[0], |m, p| m.inf(p));
        let high = corners[1..].iter().fold(corners[0], |m, p| m.sup(p));
        let tiling = pattern.tiling.patch(low, high);
        let layout = Layout::new(pattern, &tiling)?;
        let joins = |kind| pattern.rules.iter().find(|r| r.slots.iter().any(|s| s.kind == kind));
        let alone = (0..pattern.kinds.len())
            .map(|kind| joins(kind).map_or(Join::Shared, |rule| rule.join))
            .collect();
        let kinds = pattern.kinds.clone();
        Ok(Self { chart, tiling, layout, kinds, alone, placement, shape, field: None })
    }

    /// The unit on a tile.
    fn kind(&self, tile: TileId) -> &UnitKind {
        &self.kinds[self.layout.tiles[tile].kind]
    }

    /// The rod of a tile across one of its edges, outwards.
    fn line_out(&self, tile: TileId, edge: TileEdgeId) -> Line {
        let Net { edges, .. } = &self.tiling.net;
        let [from, to] = edges[edge].ends.map(|v| self.tiling.vertices[v]);
        // Clockwise round the tile.
        let along = if edges[edge].left == tile { from - to } else { to - from };
        let out = Vector2::new(-along.y, along.x);
        let place = self.layout.tiles[tile];
        let join = match edges[edge].right {
            Some(_) => self.layout.joins[edge],
            None => self.alone[place.kind],
        };
        let crossing = self.kinds[place.kind].crossing(join, self.shape, place.even);
        let in_plane = |v: Vector2<f64>| along * v.x + out * v.y;
        Line {
            at: self.tiling.midpoint(edge) + in_plane(crossing.at().coords),
            inward: in_plane(crossing.outward()),
        }
    }

    /// The inner rods of the unit on a tile.
    fn inner(&self, tile: TileId) -> Vec<Stick> {
        let place = self.layout.tiles[tile];
        let middle = self.tiling.centers[tile];
        let Tile { edges, .. } = &self.tiling.net.tiles[tile];
        let first = self.tiling.midpoint(edges[0]) - middle;
        let turn = first.y.atan2(first.x) - TAU * place.first as f64 / edges.len() as f64;
        let laid = |p: Point2<f64>| middle + Rotation2::new(turn) * p.coords;
        self.kinds[place.kind].inner_rods().map(|stick| stick.map(laid)).collect()
    }

    /// The rods of a tile's unit, and all points that the weaving will ask for; none where
    /// they form no unit.
    fn needs(&self, tile: TileId) -> Option<(Figure, Meetings, Vec<Point2<f64>>)> {
        let center = self.tiling.centers[tile];
        let figure = self.figure(tile);
        let meetings = figure.meetings(&[]).ok()?;
        let grown = |p: Point2<f64>| p + (p - center) * MARGIN;
        let corners = self.tiling.net.tiles[tile].corners.iter().map(|&v| self.tiling.vertices[v]);
        let points = std::iter::once(center)
            .chain(corners.map(grown))
            .chain(figure.outer.iter().map(|l| grown(l.at)))
            .chain(meetings.all.iter().map(|m| m.at))
            .collect();
        Some((figure, meetings, points))
    }

    /// Whether a tile lies on the surface as the pattern is moved: all that the weaving will
    /// ask for is in the chart, and no rod meets a hole.
    pub fn reaches(&self, tile: TileId) -> bool {
        self.needs(tile).is_some_and(|(figure, meetings, points)| {
            points.iter().all(|&p| self.place(tile, p).is_some())
                && !self.crosses_hole(tile, &figure, &meetings)
        })
    }

    /// Whether a rod of a tile, from its edge to its last contact, meets a hole.
    fn crosses_hole(&self, tile: TileId, figure: &Figure, meetings: &Meetings) -> bool {
        let half_width = HOLE_MARGIN * self.placement.edge;
        let crosses = |from: Point2<f64>, to: Point2<f64>| {
            let [a, b] = [from, to].map(|p| self.in_chart(tile, p));
            self.chart.crosses_hole(a, b, half_width)
        };
        let contact = |m: &Meeting| match m.ending {
            Member::Outer(i) => crosses(figure.outer[i].at, m.at),
            _ => false,
        };
        meetings.all.iter().any(contact) || figure.inner.iter().any(|&[a, b]| crosses(a, b))
    }

    /// The point of the chart that belongs to a point of a tile's picture, as the pattern is
    /// moved, mm.
    fn in_chart(&self, tile: TileId, p: Point2<f64>) -> Point2<f64> {
        let moved = self.field.as_ref().map(|field| field.at(&self.tiling, tile, p));
        self.placement.apply(p + moved.unwrap_or_default())
    }

    /// Whether the pattern is moved without folds or tears at a tile.
    pub fn is_sound(&self, tile: TileId) -> bool {
        self.field.as_ref().is_none_or(|f| f.is_sound(&self.tiling, tile))
    }

    /// Moves the pattern, or with `None` lays it as it is.
    pub fn set_field(&mut self, field: Option<Field>) {
        self.field = field;
    }

    /// The same pattern on another chart of the same plane.
    pub fn on<'b, D>(&self, chart: &'b D) -> PlaneCanvas<'b, D> {
        PlaneCanvas {
            chart,
            tiling: self.tiling.clone(),
            layout: self.layout.clone(),
            kinds: self.kinds.clone(),
            alone: self.alone.clone(),
            placement: self.placement,
            shape: self.shape,
            field: self.field.clone(),
        }
    }

    /// The chart.
    pub fn chart(&self) -> &'a C {
        self.chart
    }

    /// The tiles, as they are before they are moved.
    pub fn tiling(&self) -> &Tiling {
        &self.tiling
    }

    /// Where the tiling lies.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// How far a vertex of the tiling is moved, in tile edges.
    pub fn corner_moved(&self, vertex: usize) -> Vector2<f64> {
        self.field.as_ref().map_or_else(Vector2::zeros, |f| f.corner(vertex))
    }
}

impl PlaneCanvas<'_, PlanarChart> {
    /// The longest way, in tile edges, from a point of a tile outside the chart to the
    /// chart; nothing where all are inside.
    pub fn overhang(&self, tile: TileId) -> Vector2<f64> {
        let Some((_, _, points)) = self.needs(tile) else { return Vector2::zeros() };
        let way = |&p: &Point2<f64>| {
            let out = self.in_chart(tile, p);
            self.placement.invert(self.chart.inside(out)) - self.placement.invert(out)
        };
        let longer = |a: Vector2<f64>, b: Vector2<f64>| if b.norm() > a.norm() { b } else { a };
        points.iter().map(way).fold(Vector2::zeros(), longer)
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

    fn holds(&self, tile: TileId) -> bool {
        match &self.field {
            Some(field) => field.moves(tile),
            None => self.reaches(tile),
        }
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
            let Line { at, inward } = self.line_out(tile, e);
            Line { at, inward: -inward }
        };
        self.tiling.net.tiles[tile].edges.iter().map(line).collect()
    }

    fn figure(&self, tile: TileId) -> Figure {
        let outer = self.lines(tile);
        let stops = self.kind(tile).stop().map_or_else(Vec::new, |stop| vec![stop; outer.len()]);
        Figure { outer, stops, inner: self.inner(tile) }
    }

    fn join(&self, edge: TileEdgeId) -> Join {
        self.layout.joins[edge]
    }

    fn guest(&self, tile: TileId, side: usize) -> Option<Guest> {
        let edge = self.tiling.net.tiles[tile].edges[side];
        let Join::Rest { reach } = self.layout.joins[edge] else { return None };
        let home = self.tiling.net.across(edge, tile)?;
        Some(Guest { side, line: self.line_out(home, edge), reach })
    }

    fn place(&self, tile: TileId, p: Point2<f64>) -> Option<SurfacePoint> {
        self.chart.lift(self.in_chart(tile, p))
    }

    fn edge(&self) -> f64 {
        self.placement.edge
    }

    fn sizing(&self) -> Sizing {
        Sizing {
            larger: "larger units (--unit)",
            smaller: "smaller units (--unit)",
            fitting: "units fitted to the rods (without --unit)",
            other: "another pattern (--pattern)",
        }
    }
}
