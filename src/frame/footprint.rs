//! What a frame looks like in the plane, before the plane is wrapped round the surface
//! (paper, Fig. 9): the tiling, the flattened surface on it, and which tiles became units.

use super::canvas::{Canvas, PlaneCanvas};
use super::plane_rods::plane_rods;
use super::weave::weave;
use crate::chart::{Chart, PlanarChart, Unwrapped};
use crate::ids::TileId;
use crate::pattern::Pattern;
use crate::surface::bvh::{Aabb, Bvh};
use crate::tiling::{Placement, Tiling};
use nalgebra::{Point2, Vector2};
use std::f64::consts::PI;

/// The plane of a frame. Lengths in mm of the flattened surface, angles in radians.
#[derive(Clone, PartialEq, Debug)]
pub struct Footprint {
    /// The lower and the upper corner of what is shown: the flattened surface and a little
    /// of the tiling round it.
    pub window: [Point2<f64>; 2],
    /// The border lines of the flattened surface, closed: round it, and round its holes.
    pub outline: Vec<Vec<Point2<f64>>>,
    /// The corners of every tile that lies in the window, at least in part.
    pub tiles: Vec<Vec<Point2<f64>>>,
    /// Of each tile, whether it became a unit.
    pub units: Vec<bool>,
    /// The rods, each from its first contact to its last; a border rod begins at the edge
    /// of its tile.
    pub rods: Vec<[Point2<f64>; 2]>,
    /// Where the pattern starts.
    pub origin: Point2<f64>,
    /// Turn of the pattern about it.
    pub rotation: f64,
    /// Tile edge.
    pub edge: f64,
}

/// The tiling is shown so far beyond the flattened surface, in tile edges.
const AROUND: f64 = 0.6;
/// Points of two patches are one where they lie nearer than this, in edges: far nearer than
/// the middles, or the corners, of two tiles.
const SAME_PLACE: f64 = 0.05;

/// The plane of a frame on this canvas, whose units stand on the tiles `kept`. The tiles are
/// drawn as they are moved there.
pub fn footprint(
    canvas: &PlaneCanvas<PlanarChart>,
    pattern: &Pattern,
    kept: &[TileId],
) -> Footprint {
    let (chart, placement) = (canvas.chart(), *canvas.placement());
    let plane = Unwrapped(chart);
    let woven = weave(&canvas.on(&plane), kept)
        .expect("these tiles were woven on the chart, and its plane reaches exactly as far");
    let margin = Vector2::repeat(AROUND * placement.edge);
    let [low, high] = chart.bounds();
    let window = [low - margin, high + margin];
    let tiling = patch(pattern, &placement, window);
    let middles: Vec<Point2<f64>> = kept.iter().map(|&t| canvas.middle(t)).collect();
    let unit_at = same_places(&tiling.centers, &middles);
    let vertex_at = same_places(&tiling.vertices, &canvas.tiling().vertices);
    let moved = |vertex: usize| {
        let by = vertex_at[vertex].map_or_else(Vector2::zeros, |v| canvas.corner_moved(v));
        placement.apply(tiling.vertices[vertex] + by)
    };
    let shown = Aabb::around(&window);
    let mut footprint = Footprint {
        window,
        outline: chart.outline(),
        tiles: Vec::new(),
        units: Vec::new(),
        rods: plane_rods(&woven).iter().map(|rod| rod.ends).collect(),
        origin: placement.origin,
        rotation: placement.rotation,
        edge: placement.edge,
    };
    for (tile, unit) in tiling.net.tiles.iter().zip(unit_at) {
        let corners: Vec<_> = tile.corners.iter().map(|&v| moved(v)).collect();
        if Aabb::around(&corners).overlaps(&shown) {
            footprint.tiles.push(corners);
            footprint.units.push(unit.is_some());
        }
    }
    footprint
}

/// The tiles that cover a window of the chart's plane, and some more.
fn patch(pattern: &Pattern, placement: &Placement, [low, high]: [Point2<f64>; 2]) -> Tiling {
    let corners = [low, Point2::new(low.x, high.y), high, Point2::new(high.x, low.y)];
    let reach = Aabb::around(&corners.map(|p| placement.invert(p)));
    let largest = pattern.tiling.polygons().last().copied().unwrap_or(3);
    let widest = Vector2::repeat(1.0 / (PI / largest as f64).sin());
    pattern.tiling.patch(reach.lo - widest, reach.hi + widest)
}

/// Of each point, which of others lies at the same place.
fn same_places(points: &[Point2<f64>], others: &[Point2<f64>]) -> Vec<Option<usize>> {
    let boxes: Vec<Aabb<2>> = points.iter().map(|&p| Aabb::around(&[p])).collect();
    let tree = Bvh::new(&boxes);
    let mut found = vec![None; points.len()];
    for (other, &place) in others.iter().enumerate() {
        let here = Aabb::around(&[place]).grown(SAME_PLACE);
        tree.visit(
            |b| b.overlaps(&here),
            |point| {
                if here.contains(&points[point]) {
                    found[point] = Some(other);
                }
            },
        );
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Method;
    use crate::frame::crop::{crop, held};
    use crate::frame::fit::fit;
    use crate::frame::form::{FormSettings, Formed, form};
    use crate::pattern::library;
    use crate::surface::samples::sample;
    use crate::surface::topology::require_chartable;

    fn chart(name: &str) -> PlanarChart {
        let mesh = sample(name).unwrap();
        let topology = require_chartable(&mesh).unwrap();
        PlanarChart::new(mesh, &topology, Method::Abf).unwrap()
    }

    fn formed(canvas: &PlaneCanvas<PlanarChart>) -> Formed {
        let settings = FormSettings {
            diameter: 3.0,
            overhang: 6.0,
            round: 0.5,
            share: crate::frame::share::Share::Off,
            layering: Default::default(),
            way: crate::frame::close::Way::default(),
            surface_low: 0.0,
            sizes: Default::default(),
        };
        form(canvas, &settings).unwrap()
    }

    fn middle(points: &[Point2<f64>]) -> Point2<f64> {
        let sum = points.iter().fold(Vector2::zeros(), |s, p| s + p.coords);
        (sum / points.len() as f64).into()
    }

    /// The tiles that are marked lie under the units, whichever way the pattern is laid, and
    /// the rods of the plane, wrapped round the surface, end where those of the frame cross.
    #[test]
    fn units_and_rods_are_those_of_the_frame() {
        for (surface, name) in
            [("igloo", "3.4.6.4"), ("train-station", "4.4.4.4"), ("vault", "6.6.6")]
        {
            let pattern = Pattern::named(name).unwrap();
            let chart = chart(surface);
            let start = Placement { origin: [17.0, -8.0].into(), rotation: 0.4, edge: 1.0 };
            let edge = fit(&chart, pattern, &start, pattern.usual(), 3.0).unwrap().edge;
            let placement = Placement { edge, ..start };
            let canvas = PlaneCanvas::new(&chart, pattern, placement, pattern.usual()).unwrap();
            let Formed { frame, tiles, .. } = formed(&canvas);
            let print = footprint(&canvas, pattern, &tiles);
            let marked = print.tiles.iter().zip(&print.units).filter(|(_, unit)| **unit);
            let marked: Vec<_> =
                marked.map(|(t, _)| chart.lift(middle(t)).unwrap().position).collect();
            assert_eq!((marked.len(), print.rods.len()), (frame.units.len(), frame.rods.len()));
            for unit in frame.units.iter() {
                let near = |p: &&crate::surface::Point3| (**p - unit.center.position).norm() < 1e-6;
                assert_eq!(marked.iter().filter(near).count(), 1, "{surface}");
            }
            for (rod, [a, b]) in frame.rods.iter().zip(&print.rods) {
                assert!((b - a).norm() > 0.4 * print.edge);
                // Straight in the plane, nearly so in space: the ends lie near the rod.
                for end in [a, b] {
                    let place = chart.lift(*end).unwrap().position;
                    let along = (place - rod.axis.a).dot(&rod.axis.direction());
                    let off = (place - rod.axis.at(along)).norm();
                    assert!(off < 0.5 * print.edge, "{surface}: {off}");
                }
            }
        }
    }

    #[test]
    fn tiles_cover_the_window_and_the_outline_lies_in_it() {
        let chart = chart("train-station");
        for pattern in library().iter().step_by(3) {
            let placement = Placement { origin: [3.0, 40.0].into(), rotation: -0.7, edge: 41.0 };
            let shape = pattern.usual();
            let canvas = PlaneCanvas::new(&chart, pattern, placement, shape).unwrap();
            let kept = crop(&canvas, &held(&canvas));
            let print = footprint(&canvas, pattern, &kept);
            assert_eq!(print.units.iter().filter(|unit| **unit).count(), kept.len());
            let [low, high] = print.window;
            assert!(print.outline.iter().flatten().all(|p| {
                let inside = |i: usize| low[i] < p[i] && p[i] < high[i];
                inside(0) && inside(1)
            }));
            let area = |tile: &Vec<Point2<f64>>| {
                let n = tile.len() as f64;
                n / 4.0 * print.edge.powi(2) / (PI / n).tan()
            };
            let covered: f64 = print.tiles.iter().map(area).sum();
            assert!(covered > (high.x - low.x) * (high.y - low.y), "{}", pattern.name);
            // No middle of the window is without its tile.
            for (i, j) in (1..20).flat_map(|i| (1..20).map(move |j| (i, j))) {
                let share = Vector2::new(f64::from(i), f64::from(j)) / 20.0;
                let p = low + (high - low).component_mul(&share);
                assert!(print.tiles.iter().any(|tile| holds(tile, p)), "{}: {p}", pattern.name);
            }
        }
    }

    fn holds(tile: &[Point2<f64>], p: Point2<f64>) -> bool {
        let n = tile.len();
        (0..n).all(|i| (tile[(i + 1) % n] - tile[i]).perp(&(p - tile[i])) >= -1e-9)
    }
}
