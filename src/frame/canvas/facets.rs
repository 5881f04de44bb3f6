//! The polygons of a mesh as tiles of their own, whatever the shape of the whole:
//! closed, with many borders, with handles.
//!
//! A tile's flat picture is the plane through the middle of its corners that faces along
//! its area vector, in mm. Rods run through the middles of the edges, turned from the way
//! to the tile's middle, all by the same angle. In stretched and skewed tiles such rods
//! may form no circuit, or one with a side of next to nothing. Then they are turned as in
//! a regular polygon and stretched with the tile, half-way or all the way, by the affine
//! map that brings the polygon nearest to it; that keeps every unit a circuit, at the
//! price of flatter crossings.

use super::{Canvas, Sizing};
use crate::chart::SurfacePoint;
use crate::ids::{Id, IdVec, TileEdgeId, TileId, VertexId};
use crate::pattern::{FlatUnit, Line, Shape};
use crate::surface::{Point3, Vector3};
use crate::tiling::{Net, TileEdge};
use nalgebra::{Matrix2, Point2, Rotation2, Vector2};
use std::f64::consts::TAU;

/// The polygons of a mesh, ready to be woven on in any shape.
#[derive(Clone, Debug)]
pub struct MeshTiles {
    net: Net,
    /// The middles of the edges.
    middles: IdVec<TileEdgeId, Point3>,
    /// The edges, as their left tiles run through them.
    alongs: IdVec<TileEdgeId, Vector3>,
    /// Colours by which rods slide; none where neighbours cannot all differ.
    even: Option<IdVec<TileId, bool>>,
    frames: IdVec<TileId, Frame>,
    ranks: IdVec<TileId, [f64; 2]>,
    edge: f64,
}

/// A polygon mesh with turn and slide of its rods.
#[derive(Clone, Copy, Debug)]
pub struct MeshCanvas<'a> {
    tiles: &'a MeshTiles,
    shape: Shape,
}

/// The plane of a tile, and how the tile is stretched in it.
#[derive(Clone, Copy, Debug)]
struct Frame {
    middle: Point3,
    normal: Vector3,
    x: Vector3,
    y: Vector3,
    /// From a regular polygon to the tile, and back.
    stretch: [Matrix2<f64>; 2],
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
        let mut frame =
            Self { middle, normal, x, y: normal.cross(&x), stretch: [Matrix2::identity(); 2] };
        let flat: Vec<Point2<f64>> = corners.iter().map(|&p| frame.flat(p)).collect();
        frame.stretch = evening(&flat);
        frame
    }

    fn flat(&self, p: Point3) -> Point2<f64> {
        let d = p - self.middle;
        Point2::new(d.dot(&self.x), d.dot(&self.y))
    }
}

/// The rods of a tile in its flat picture, which is stretched as `stretch` says (there
/// and back); `middles` are those of its edges.
fn rods(middles: &[Point2<f64>], stretch: &[Matrix2<f64>; 2], turn: f64) -> Vec<Line> {
    let [there, back] = stretch;
    let line = |&at: &Point2<f64>| Line {
        at,
        inward: there * (Rotation2::new(turn) * (back * -at.coords)),
    };
    middles.iter().map(line).collect()
}

/// Parts of a tile's stretch that are tried in turn, as exponents.
const PARTS: [f64; 3] = [0.0, 0.5, 1.0];

/// The turn, radians, at which units are compared. Which is the most even hardly depends
/// on it.
const TRIAL_TURN: f64 = 0.35;

/// A unit whose shortest side is this part of its mean side will do. More, and tiles are
/// stretched that need not be; less, and there is no room beside some contacts.
const EVEN: f64 = 0.3;

/// The least part of a tile's stretch, there and back, that makes an even unit; or the
/// one that makes the most even.
fn evening(corners: &[Point2<f64>]) -> [Matrix2<f64>; 2] {
    let n = corners.len();
    let middles: Vec<Point2<f64>> =
        (0..n).map(|i| nalgebra::center(&corners[i], &corners[(i + 1) % n])).collect();
    let evenness = |stretch: &[Matrix2<f64>; 2]| {
        let Some(unit) = FlatUnit::new(&rods(&middles, stretch, TRIAL_TURN)) else { return 0.0 };
        let side = |i: usize| (unit.contacts[i] - unit.contacts[(i + 1) % n]).norm();
        let least = (0..n).map(side).fold(f64::INFINITY, f64::min);
        least * n as f64 / (0..n).map(side).sum::<f64>()
    };
    let mut best = (-1.0, [Matrix2::identity(); 2]);
    let svd = stretch(corners).svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return best.1 };
    for part in PARTS {
        let scales = svd.singular_values.map(|s| s.powf(part));
        let there =
            if part == 0.0 { Matrix2::identity() } else { u * Matrix2::from_diagonal(&scales) * v };
        let Some(back) = there.try_inverse().filter(|_| there.determinant() > 0.0) else {
            continue;
        };
        let found = evenness(&[there, back]);
        if found > best.0 {
            best = (found, [there, back]);
        }
        if found >= EVEN {
            break;
        }
    }
    best.1
}

/// The linear map that brings the corners of a regular polygon nearest to these, which
/// are given from their middle. For unit vectors p at equal angles Σ p pᵀ = n/2.
fn stretch(corners: &[Point2<f64>]) -> Matrix2<f64> {
    let n = corners.len() as f64;
    let regular = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / n).sin_cos();
        Vector2::new(cos, sin)
    };
    let sum: Matrix2<f64> =
        corners.iter().enumerate().map(|(k, c)| c.coords * regular(k).transpose()).sum();
    sum * (2.0 / n)
}

impl MeshTiles {
    /// Takes the polygons of a mesh as tiles, corners counter-clockwise seen from outside.
    pub fn new(points: &IdVec<VertexId, Point3>, faces: &[Vec<VertexId>]) -> Self {
        let corners = |face: &Vec<VertexId>| face.iter().map(|v| v.index()).collect();
        let net = Net::new(faces.iter().map(corners));
        let frame =
            |face: &Vec<VertexId>| Frame::new(&face.iter().map(|&v| points[v]).collect::<Vec<_>>());
        let frames: IdVec<TileId, Frame> = faces.iter().map(frame).collect();
        let ends = |edge: &TileEdge| edge.ends.map(|v| points[VertexId::new(v)]);
        let length = |[a, b]: [Point3; 2]| (b - a).norm();
        let total: f64 = net.edges.iter().map(|e| length(ends(e))).sum();
        let middle = |[a, b]: [Point3; 2]| nalgebra::center(&a, &b);
        let centers: Vec<Vector3> = frames.iter().map(|f| f.middle.coords).collect();
        Self {
            ranks: super::ranks(&net, &centers, &top(&centers)),
            edge: total / net.edges.len().max(1) as f64,
            middles: net.edges.iter().map(|e| middle(ends(e))).collect(),
            alongs: net.edges.iter().map(ends).map(|[a, b]| b - a).collect(),
            even: net.colours(),
            net,
            frames,
        }
    }

    /// The tiles with rods of this shape. Where tiles do not alternate, rods do not slide.
    pub fn shaped(&self, shape: Shape) -> MeshCanvas<'_> {
        MeshCanvas { tiles: self, shape }
    }

    /// Whether the tiles can be told apart by two colours, as slid rods need.
    pub fn alternates(&self) -> bool {
        self.even.is_some()
    }
}

/// The middle of a mesh as seen from above, at its greatest height.
fn top(middles: &[Vector3]) -> Vector3 {
    let far = Vector3::repeat(f64::INFINITY);
    let (lo, hi) = middles.iter().fold((far, -far), |(lo, hi), m| (lo.inf(m), hi.sup(m)));
    let middle = (lo + hi) / 2.0;
    Vector3::new(middle.x, middle.y, hi.z)
}

impl Canvas for MeshCanvas<'_> {
    fn net(&self) -> &Net {
        &self.tiles.net
    }

    fn holds(&self, _tile: TileId) -> bool {
        true
    }

    fn rank(&self, tile: TileId) -> [f64; 2] {
        self.tiles.ranks[tile]
    }

    fn middle(&self, _tile: TileId) -> Point2<f64> {
        Point2::origin()
    }

    fn lines(&self, tile: TileId) -> Vec<Line> {
        let frame = &self.tiles.frames[tile];
        let middle = |&e: &TileEdgeId| frame.flat(self.tiles.middles[e]);
        let edges = &self.tiles.net.tiles[tile].edges;
        let middles: Vec<_> = edges.iter().map(middle).collect();
        let mut lines = rods(&middles, &frame.stretch, self.shape.turn);
        if let Some(even) = &self.tiles.even {
            for (line, &e) in lines.iter_mut().zip(edges) {
                // Clockwise round even tiles; left tiles run counter-clockwise.
                let sign = if even[self.tiles.net.edges[e].left] { -1.0 } else { 1.0 };
                let slid = self.tiles.middles[e] + self.tiles.alongs[e] * sign * self.shape.slide;
                line.at = frame.flat(slid);
            }
        }
        lines
    }

    fn place(&self, tile: TileId, p: Point2<f64>) -> Option<SurfacePoint> {
        let Frame { middle, normal, x, y, .. } = self.tiles.frames[tile];
        Some(SurfacePoint { position: middle + x * p.x + y * p.y, normal })
    }

    fn edge(&self) -> f64 {
        self.tiles.edge
    }

    fn sizing(&self) -> Sizing {
        Sizing {
            larger: "a coarser mesh or a larger span (--span)",
            smaller: "a finer mesh",
            fitting: "a turn fitted to the rods (without --turn)",
            other: "more even polygons",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let tiles = MeshTiles::new(&points, &faces);
        let canvas = tiles.shaped(Shape { turn: 0.3, slide: 0.0 });
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

    /// With its full stretch an affine image of a regular tile has a unit at every turn,
    /// and its contacts are the images of those of the regular tile.
    #[test]
    fn stretched_and_skewed_tiles_have_units_at_every_turn() {
        let skew = Matrix2::new(5.0, 1.5, 0.2, 0.6);
        for sides in 3..=8 {
            let corner = |k: usize| {
                let (sin, cos) = (TAU * k as f64 / sides as f64).sin_cos();
                Point2::new(cos, sin)
            };
            let regular: Vec<Point2<f64>> = (0..sides).map(corner).collect();
            let skewed: Vec<Point2<f64>> = regular.iter().map(|p| skew * p).collect();
            assert!((stretch(&skewed) - skew).norm() < 1e-12);
            for turn in [-0.7, 0.05, 0.3, 0.75] {
                let unit = |corners: &[Point2<f64>], a: Matrix2<f64>| {
                    let middle = |i| nalgebra::center(&corners[i], &corners[(i + 1) % sides]);
                    let middles: Vec<_> = (0..sides).map(middle).collect();
                    let back = a.try_inverse().expect("not singular");
                    FlatUnit::new(&rods(&middles, &[a, back], turn)).expect("a unit").contacts
                };
                let (plain, image) = (unit(&regular, Matrix2::identity()), unit(&skewed, skew));
                for (p, q) in plain.iter().zip(&image) {
                    assert!((skew * p - q).norm() < 1e-9, "{sides} {turn}");
                }
            }
            let [there, back] = evening(&skewed);
            assert!((there * back - Matrix2::identity()).norm() < 1e-9);
            assert_eq!(evening(&regular), [Matrix2::identity(); 2]);
        }
    }

    #[test]
    fn the_top_face_is_numbered_first_and_the_bottom_last() {
        let (points, faces) = brick();
        let tiles = MeshTiles::new(&points, &faces);
        let canvas = tiles.shaped(Shape { turn: 0.3, slide: 0.0 });
        let ring = |face: usize| canvas.rank(TileId::new(face))[0];
        assert_eq!([0, 1, 2, 3, 4, 5].map(ring), [2.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }

    /// Squares in a row alternate; slid rods of neighbours cross their edge at one place.
    #[test]
    fn slid_rods_cross_an_edge_at_one_place() {
        let points: IdVec<VertexId, Point3> =
            (0..8).map(|i| Point3::new(f64::from(i / 2), f64::from(i % 2), 0.0)).collect();
        let faces = [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5]];
        let faces = faces.map(|f| f.map(VertexId::new).to_vec());
        let tiles = MeshTiles::new(&points, &faces);
        assert!(tiles.alternates());
        let canvas = tiles.shaped(Shape { turn: 0.0, slide: 0.2 });
        let mut ways = Vec::new();
        for tile in canvas.net().tiles.ids() {
            ways.push(FlatUnit::new(&canvas.lines(tile)).expect("a square").counter_clockwise);
        }
        assert_eq!(ways, [ways[0], !ways[0], ways[0]]);
        for (e, edge) in canvas.net().edges.enumerate() {
            let Some(right) = edge.right else { continue };
            let place = |tile: TileId| {
                let side = canvas.net().tiles[tile].edges.iter().position(|&x| x == e)?;
                canvas.place(tile, canvas.lines(tile)[side].at).map(|p| p.position)
            };
            let (p, q) = (place(edge.left).expect("left"), place(right).expect("right"));
            assert!((p - q).norm() < 1e-12 && ((p.y - 0.5).abs() - 0.2).abs() < 1e-12);
        }
        // Three tiles round a corner cannot alternate.
        let (points, faces) = brick();
        assert!(!MeshTiles::new(&points, &faces).alternates());
    }
}
