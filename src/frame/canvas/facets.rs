//! The polygons of a mesh as tiles of their own, whatever the shape of the whole:
//! closed, with many borders, with handles.
//!
//! A tile's flat picture is the plane through the middle of its corners that faces along
//! its area vector, in mm. A rod crosses the middle of an edge, turned from the way to
//! the tile's middle; so the inner polygon of a unit is one and the same figure for all
//! turns, only larger or smaller, and small turns do not break uneven tiles.

use super::{Canvas, Sizing};
use crate::chart::SurfacePoint;
use crate::ids::{Id, IdVec, TileEdgeId, TileId, VertexId};
use crate::pattern::Line;
use crate::surface::{Point3, Vector3};
use crate::tiling::Net;
use nalgebra::{Point2, Rotation2};

/// A polygon mesh with the turn of its rods.
#[derive(Clone, Debug)]
pub struct MeshCanvas {
    net: Net,
    points: IdVec<VertexId, Point3>,
    frames: IdVec<TileId, Frame>,
    ranks: IdVec<TileId, [f64; 2]>,
    turn: f64,
    edge: f64,
}

/// The plane of a tile.
#[derive(Clone, Copy, Debug)]
struct Frame {
    middle: Point3,
    normal: Vector3,
    x: Vector3,
    y: Vector3,
}

impl Frame {
    fn new(corners: &[Point3]) -> Self {
        let n = corners.len();
        let sum: Vector3 = corners.iter().map(|p| p.coords).sum();
        let middle = Point3::from(sum / n as f64);
        let at = |i: usize| corners[i % n] - middle;
        let area: Vector3 = (0..n).map(|i| at(i).cross(&at(i + 1))).sum();
        // Polygons without area are left out when read.
        let normal = area.try_normalize(0.0).unwrap_or_else(Vector3::z);
        let along = at(1) - at(0);
        let x = (along - normal * along.dot(&normal)).try_normalize(0.0);
        let x = x.unwrap_or_else(|| normal.cross(&Vector3::z()));
        Self { middle, normal, x, y: normal.cross(&x) }
    }

    fn flat(&self, p: Point3) -> Point2<f64> {
        let d = p - self.middle;
        Point2::new(d.dot(&self.x), d.dot(&self.y))
    }
}

impl MeshCanvas {
    /// Takes the polygons of a mesh as tiles, corners counter-clockwise seen from
    /// outside; rods are turned by `turn` radians.
    pub fn new(points: &IdVec<VertexId, Point3>, faces: &[Vec<VertexId>], turn: f64) -> Self {
        let corners = |face: &Vec<VertexId>| face.iter().map(|v| v.index()).collect();
        let net = Net::new(faces.iter().map(corners));
        let frame =
            |face: &Vec<VertexId>| Frame::new(&face.iter().map(|&v| points[v]).collect::<Vec<_>>());
        let frames: IdVec<TileId, Frame> = faces.iter().map(frame).collect();
        let length = |ends: [usize; 2]| {
            let [a, b] = ends.map(|v| points[VertexId::new(v)]);
            (b - a).norm()
        };
        let total: f64 = net.edges.iter().map(|e| length(e.ends)).sum();
        let middles: Vec<Vector3> = frames.iter().map(|f| f.middle.coords).collect();
        Self {
            ranks: super::ranks(&net, &middles, &top(&middles)),
            edge: total / net.edges.len().max(1) as f64,
            net,
            points: points.clone(),
            frames,
            turn,
        }
    }

    /// The same with another turn of the rods.
    pub fn turned(&self, turn: f64) -> Self {
        Self { turn, ..self.clone() }
    }
}

/// The middle of a mesh as seen from above, at its greatest height.
fn top(middles: &[Vector3]) -> Vector3 {
    let far = Vector3::repeat(f64::INFINITY);
    let (lo, hi) = middles.iter().fold((far, -far), |(lo, hi), m| (lo.inf(m), hi.sup(m)));
    let middle = (lo + hi) / 2.0;
    Vector3::new(middle.x, middle.y, hi.z)
}

impl Canvas for MeshCanvas {
    fn net(&self) -> &Net {
        &self.net
    }

    fn holds(&self, _tile: TileId) -> bool {
        true
    }

    fn rank(&self, tile: TileId) -> [f64; 2] {
        self.ranks[tile]
    }

    fn middle(&self, _tile: TileId) -> Point2<f64> {
        Point2::origin()
    }

    fn lines(&self, tile: TileId) -> Vec<Line> {
        let frame = &self.frames[tile];
        let line = |&e: &TileEdgeId| {
            let [a, b] = self.net.edges[e].ends.map(|v| self.points[VertexId::new(v)]);
            let at = frame.flat(nalgebra::center(&a, &b));
            Line { at, inward: Rotation2::new(self.turn) * -at.coords }
        };
        self.net.tiles[tile].edges.iter().map(line).collect()
    }

    fn place(&self, tile: TileId, p: Point2<f64>) -> Option<SurfacePoint> {
        let Frame { middle, normal, x, y } = self.frames[tile];
        Some(SurfacePoint { position: middle + x * p.x + y * p.y, normal })
    }

    fn edge(&self) -> f64 {
        self.edge
    }

    fn sizing(&self) -> Sizing {
        Sizing {
            larger: "a coarser mesh or a larger span (--span)",
            smaller: "a finer mesh",
            fitting: "Leave out --turn to let it be fitted to the rods, or make the polygons \
                      more even",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::FlatUnit;

    /// A box of unit squares, 3 × 2 × 1, closed.
    fn brick() -> (IdVec<VertexId, Point3>, Vec<Vec<VertexId>>) {
        let corner = |i: usize| Point3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        let points: IdVec<VertexId, Point3> = (0..8).map(corner).collect();
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        (points, faces.map(|f| f.map(VertexId::new).to_vec()).to_vec())
    }

    #[test]
    fn units_of_a_cube_lie_in_its_faces() {
        let (points, faces) = brick();
        let canvas = MeshCanvas::new(&points, &faces, 0.3);
        assert_eq!(canvas.edge(), 1.0);
        for tile in canvas.net().tiles.ids() {
            let unit = FlatUnit::new(&canvas.lines(tile)).expect("a square");
            assert!(unit.counter_clockwise);
            let center = canvas.place(tile, canvas.middle(tile)).expect("always");
            assert!((center.position - Point3::new(0.5, 0.5, 0.5)).dot(&center.normal) > 0.49);
            for p in &unit.contacts {
                let wanted = 0.5 * 0.3f64.sin() * 2f64.sqrt();
                assert!((p.coords.norm() - wanted).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_top_face_is_numbered_first_and_the_bottom_last() {
        let (points, faces) = brick();
        let canvas = MeshCanvas::new(&points, &faces, 0.3);
        let ring = |face: usize| canvas.rank(TileId::new(face))[0];
        assert_eq!([0, 1, 2, 3, 4, 5].map(ring), [2.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }
}
