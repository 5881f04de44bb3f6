//! A polyhedron on its sphere: rods follow great circles (paper, section 6, the Da Vinci
//! dome).
//!
//! Seen from the middle of the sphere, great circles are straight lines in any plane. So
//! a tile's flat picture is the plane that touches the sphere at the middle of the
//! tile's inscribed circle, in sphere radii, and a unit is found there as in any plane.

use super::{Canvas, Sizing};
use crate::chart::SurfacePoint;
use crate::ids::{IdVec, TileEdgeId, TileId};
use crate::pattern::{Line, Shape};
use crate::surface::Vector3;
use crate::tiling::Net;
use crate::tiling::midsphere::{Midscribed, nearest_to_origin};
use nalgebra::{Point2, Unit, UnitQuaternion, Vector2};

/// A sphere about the origin, tiled by a polyhedron whose edges touch it, ready to be
/// woven on in any shape. Lengths in mm.
#[derive(Clone, Debug)]
pub struct SphereTiles {
    net: Net,
    /// Unit vectors to the vertices.
    corners: Vec<Vector3>,
    /// Where the edges touch the sphere of radius one.
    touching: IdVec<TileEdgeId, Touch>,
    /// Colours by which rods slide; none where neighbours cannot all differ.
    even: Option<IdVec<TileId, bool>>,
    frames: IdVec<TileId, Frame>,
    ranks: IdVec<TileId, [f64; 2]>,
    radius: f64,
    /// Tiles wholly above this height are kept; none for a whole sphere.
    cut: Option<f64>,
    edge: f64,
}

/// A tiled sphere with turn and slide of its rods.
#[derive(Clone, Copy, Debug)]
pub struct SphereCanvas<'a> {
    tiles: &'a SphereTiles,
    shape: Shape,
}

/// Where an edge touches the sphere, and its direction as its left tile runs through it.
#[derive(Clone, Copy, Debug)]
struct Touch {
    at: Vector3,
    along: Vector3,
    /// Length of the edge, as an angle.
    arc: f64,
}

impl Touch {
    /// The place that lies this part of the edge farther along it.
    fn slid(&self, part: f64) -> Self {
        let (sin, cos) = (part * self.arc).sin_cos();
        let (at, along) = (self.at * cos + self.along * sin, self.along * cos - self.at * sin);
        Self { at, along, arc: self.arc }
    }
}

/// The flat picture of a tile: its axis and two directions across it.
#[derive(Clone, Copy, Debug)]
struct Frame {
    axis: Vector3,
    x: Vector3,
    y: Vector3,
}

impl Frame {
    fn new(axis: Vector3) -> Self {
        let to_axis = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_else(|| {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
        Self { axis, x: to_axis * Vector3::x(), y: to_axis * Vector3::y() }
    }

    /// A point of the sphere seen from its middle.
    fn flat(&self, p: &Vector3) -> Point2<f64> {
        Point2::new(p.dot(&self.x), p.dot(&self.y)) / p.dot(&self.axis)
    }

    /// A direction of travel at a point of the sphere, as it looks there.
    fn flat_direction(&self, p: &Vector3, along: &Vector3) -> Vector2<f64> {
        let slope = |across: &Vector3| {
            along.dot(across) * p.dot(&self.axis) - p.dot(across) * along.dot(&self.axis)
        };
        Vector2::new(slope(&self.x), slope(&self.y))
    }

    fn back(&self, p: Point2<f64>) -> Vector3 {
        (self.axis + self.x * p.x + self.y * p.y).normalize()
    }
}

impl SphereTiles {
    /// Lays a polyhedron on a sphere of this radius, turned by `rotate` radians about the
    /// vertical. Tiles that reach below `cut` are left out.
    pub fn new(form: &Midscribed, radius: f64, cut: Option<f64>, rotate: f64) -> Self {
        let about = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), rotate);
        let vertices: Vec<Vector3> = form.vertices.iter().map(|v| about * v).collect();
        let corners: Vec<Vector3> = vertices.iter().map(|v| v.normalize()).collect();
        let touch = |ends: [usize; 2]| {
            let [a, b] = ends.map(|v| vertices[v]);
            let at = nearest_to_origin(&a, &b).normalize();
            Touch { at, along: (b - a).normalize(), arc: a.angle(&b) }
        };
        let touching: IdVec<TileEdgeId, Touch> =
            form.net.edges.iter().map(|e| touch(e.ends)).collect();
        let axes: Vec<Vector3> = form.axes().map(|axis| about * axis).collect();
        let arc = |ends: [usize; 2]| corners[ends[0]].angle(&corners[ends[1]]);
        let edges = form.net.edges.iter().map(|e| arc(e.ends));
        let edge = radius * edges.sum::<f64>() / form.net.edges.len() as f64;
        Self {
            ranks: super::ranks(&form.net, &axes, &Vector3::z()),
            frames: axes.into_iter().map(Frame::new).collect(),
            even: form.net.colours(),
            net: form.net.clone(),
            corners,
            touching,
            radius,
            cut,
            edge,
        }
    }

    /// The tiles with rods of this shape. Where tiles do not alternate, rods do not slide.
    pub fn shaped(&self, shape: Shape) -> SphereCanvas<'_> {
        SphereCanvas { tiles: self, shape }
    }

    /// Whether the tiles can be told apart by two colours, as slid rods need.
    pub fn alternates(&self) -> bool {
        self.even.is_some()
    }

    /// Whether a tile lies above the cut.
    fn holds(&self, tile: TileId) -> bool {
        let Some(cut) = self.cut else { return true };
        let above = |p: &Vector3| p.z * self.radius >= cut - SNUG * self.radius;
        let tile = &self.net.tiles[tile];
        tile.corners.iter().all(|&v| above(&self.corners[v]))
            && tile.edges.iter().all(|&e| above(&self.touching[e].at))
    }

    /// The number of faces of the polyhedron.
    pub fn faces(&self) -> usize {
        self.net.tiles.len()
    }

    /// Height of the lowest corner of the tiles that are kept, or of the whole sphere.
    pub fn low(&self) -> f64 {
        let kept = self.net.tiles.ids().filter(|&t| self.holds(t));
        let corners = kept.flat_map(|t| &self.net.tiles[t].corners);
        let low = corners.map(|&v| self.corners[v].z * self.radius).fold(self.radius, f64::min);
        if self.cut.is_some() { low } else { -self.radius }
    }
}

impl Canvas for SphereCanvas<'_> {
    fn net(&self) -> &Net {
        &self.tiles.net
    }

    fn holds(&self, tile: TileId) -> bool {
        self.tiles.holds(tile)
    }

    fn rank(&self, tile: TileId) -> [f64; 2] {
        self.tiles.ranks[tile]
    }

    fn middle(&self, _tile: TileId) -> Point2<f64> {
        Point2::origin()
    }

    fn lines(&self, tile: TileId) -> Vec<Line> {
        let frame = &self.tiles.frames[tile];
        let line = |&e: &TileEdgeId| {
            let left = self.tiles.net.edges[e].left;
            // Along the edge clockwise round even tiles, and the left tile runs through it
            // counter-clockwise.
            let slide = match &self.tiles.even {
                Some(even) if even[left] => -self.shape.slide,
                Some(_) => self.shape.slide,
                None => 0.0,
            };
            let Touch { at, along, .. } = self.tiles.touching[e].slid(slide);
            let along = if left == tile { along } else { -along };
            let up = Unit::new_unchecked(at);
            let inward = UnitQuaternion::from_axis_angle(&up, self.shape.turn) * at.cross(&along);
            Line { at: frame.flat(&at), inward: frame.flat_direction(&at, &inward) }
        };
        self.tiles.net.tiles[tile].edges.iter().map(line).collect()
    }

    fn place(&self, tile: TileId, p: Point2<f64>) -> Option<SurfacePoint> {
        let normal = self.tiles.frames[tile].back(p);
        Some(SurfacePoint { position: (normal * self.tiles.radius).into(), normal })
    }

    fn edge(&self) -> f64 {
        self.tiles.edge
    }

    fn sizing(&self) -> Sizing {
        Sizing {
            larger: "a lower frequency or a larger span (--span)",
            smaller: "a higher frequency, or cut less away (--cut)",
            fitting: "a turn fitted to the rods (without --turn)",
            other: "another notation",
        }
    }
}

/// A tile that reaches below the cut by less than this part of the radius counts as
/// above: the equator of a polyhedron is known to rounding.
const SNUG: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::pattern::FlatUnit;
    use crate::tiling::conway::Notation;
    use crate::tiling::midsphere::midsphere;

    fn tiles(notation: &str, cut: Option<f64>) -> SphereTiles {
        let notation: Notation = notation.parse().expect("a notation");
        SphereTiles::new(&midsphere(&notation.polyhedron()).expect("round"), 100.0, cut, 0.3)
    }

    /// Rods keep one distance from the middle of their unit, whatever the tile: the
    /// sine of it is sin r sin φ, with r the angle from the tile's axis to its edges.
    #[test]
    fn units_are_tangent_to_a_circle_about_their_axis() {
        for notation in ["I", "aI/2", "dkI", "sC"] {
            let tiles = tiles(notation, None);
            for turn in [-0.2f64, 0.35] {
                let canvas = tiles.shaped(Shape { turn, slide: 0.0 });
                for tile in canvas.net().tiles.ids() {
                    let lines = canvas.lines(tile);
                    let unit = FlatUnit::new(&lines).expect("a unit");
                    assert_eq!(unit.counter_clockwise, turn > 0.0);
                    for line in &lines {
                        let away = line.at.coords.perp(&line.inward) / line.inward.norm();
                        let reach = line.at.coords.norm().atan();
                        // In the plane the distance is a tangent.
                        let wanted = (reach.sin() * turn.sin()).abs().asin().tan();
                        assert!((away.abs() - wanted).abs() < 1e-9, "{notation}");
                    }
                }
            }
        }
    }

    /// The rod of an edge is one great circle, seen from either side.
    #[test]
    fn both_tiles_of_an_edge_see_one_rod() {
        let tiles = tiles("aI", None);
        let canvas = tiles.shaped(Shape { turn: 0.3, slide: 0.0 });
        for (e, edge) in canvas.net().edges.enumerate() {
            let plane = |tile: TileId| {
                let side = canvas.net().tiles[tile].edges.iter().position(|&x| x == e)?;
                let line = canvas.lines(tile)[side];
                let [p, q] = [line.at, line.at + line.inward]
                    .map(|p| canvas.place(tile, p).map(|p| p.normal));
                Some(p?.cross(&q?).normalize())
            };
            let (left, right) = (plane(edge.left), edge.right.and_then(plane));
            assert!((left.expect("left") + right.expect("right")).norm() < 1e-9);
        }
    }

    /// On tiles that alternate rods slide to one side seen from one colour, to the other seen
    /// from the other; without a turn neighbours run opposite ways round.
    #[test]
    fn slid_rods_are_still_one_seen_from_either_side() {
        let tiles = tiles("aI", None);
        assert!(tiles.alternates());
        let canvas = tiles.shaped(Shape { turn: 0.0, slide: 0.2 });
        let mut sense = Vec::new();
        for tile in canvas.net().tiles.ids() {
            let unit = FlatUnit::new(&canvas.lines(tile)).expect("a unit");
            sense.push((canvas.net().tiles[tile].corners.len(), unit.counter_clockwise));
        }
        let pentagons = sense.iter().find(|(n, _)| *n == 5).map(|(_, s)| *s);
        assert!(sense.iter().all(|&(n, s)| (Some(s) == pentagons) == (n == 5)));
        for (e, edge) in canvas.net().edges.enumerate() {
            let place = |tile: TileId| {
                let side = canvas.net().tiles[tile].edges.iter().position(|&x| x == e)?;
                canvas.place(tile, canvas.lines(tile)[side].at)
            };
            let (p, q) = (place(edge.left), edge.right.and_then(place));
            assert!((p.expect("left").position - q.expect("right").position).norm() < 1e-9);
        }
    }

    #[test]
    fn a_cut_at_the_equator_keeps_the_upper_half() {
        // Octahedron's ambo, the cuboctahedron, has no edge ring at the equator; the
        // octahedron itself has.
        assert_eq!(count("O", Some(0.0)), 4);
        assert_eq!(count("O", None), 8);
        assert!(count("O", Some(1.0)) == 0);
        fn count(notation: &str, cut: Option<f64>) -> usize {
            let tiles = tiles(notation, cut);
            tiles.net.tiles.ids().filter(|&t| tiles.holds(t)).count()
        }
    }

    #[test]
    fn numbering_starts_at_the_top() {
        let tiles = tiles("dI/2", None);
        let canvas = tiles.shaped(Shape { turn: 0.3, slide: 0.0 });
        let first = canvas.net().tiles.ids().min_by(|&a, &b| {
            let (p, q) = (canvas.rank(a), canvas.rank(b));
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
        });
        let top = canvas.place(first.unwrap_or(TileId::new(0)), Point2::origin());
        assert!((top.expect("on the sphere").normal - Vector3::z()).norm() < 1e-9);
    }
}
