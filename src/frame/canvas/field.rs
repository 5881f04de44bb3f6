//! How a pattern is moved in its plane, tile by tile.

use crate::ids::{IdVec, TileEdgeId, TileId};
use crate::tiling::{Net, Tiling};
use nalgebra::{Point2, Vector2};

/// Moves of the points of a tiling, in tile edges. On every tile that hosts a unit they are
/// piecewise linear on its fan: the triangles from its centre to half an edge each. The
/// middle of an edge moves as the centres beside it do in the mean, a corner as those
/// round it.
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    centers: IdVec<TileId, Option<Vector2<f64>>>,
    middles: IdVec<TileEdgeId, Vector2<f64>>,
    corners: Vec<Vector2<f64>>,
}

/// Least area of a triangle of a fan once it is moved, as part of its area before. Less,
/// and rods of a unit lie so close that there is no room for them; below zero it is
/// turned over.
const LEAST_AREA: f64 = 0.2;

/// Most that a side of such a triangle may grow. More, and the centres did not move
/// together: one of them was taken for a place on another part of the surface.
const MOST_STRETCH: f64 = 3.0;

impl Field {
    /// The moves that follow from those of the centres of some tiles. The others take no
    /// part.
    pub fn new(net: &Net, centers: IdVec<TileId, Option<Vector2<f64>>>) -> Self {
        let mean = |sum: Vector2<f64>, count: usize| sum / count.max(1) as f64;
        let middle = |edge: &crate::tiling::TileEdge| {
            let sides = [Some(edge.left), edge.right];
            let moves = sides.into_iter().flatten().filter_map(|tile| centers[tile]);
            moves.clone().sum::<Vector2<f64>>() / moves.count().max(1) as f64
        };
        let middles = net.edges.iter().map(middle).collect();
        let vertices = net.tiles.iter().flat_map(|t| &t.corners).max().map_or(0, |v| v + 1);
        let mut corners = vec![(Vector2::zeros(), 0); vertices];
        for (tile, center) in centers.enumerate() {
            for &v in center.iter().flat_map(|_| &net.tiles[tile].corners) {
                corners[v].0 += center.unwrap_or_default();
                corners[v].1 += 1;
            }
        }
        let corners = corners.into_iter().map(|(sum, count)| mean(sum, count)).collect();
        Self { centers, middles, corners }
    }

    /// Whether a tile takes part.
    pub fn moves(&self, tile: TileId) -> bool {
        self.centers[tile].is_some()
    }

    /// The move of a vertex of the tiling.
    pub fn corner(&self, vertex: usize) -> Vector2<f64> {
        self.corners.get(vertex).copied().unwrap_or_default()
    }

    /// The move of a point in a tile's picture. Beyond the tile, as in the triangle of its
    /// fan that lies nearest.
    pub fn at(&self, tiling: &Tiling, tile: TileId, p: Point2<f64>) -> Vector2<f64> {
        let Some(center) = self.centers[tile] else { return Vector2::zeros() };
        let from = p - tiling.centers[tile];
        let mut best = (f64::NEG_INFINITY, center);
        for [(a, move_a), (b, move_b)] in self.fan(tiling, tile) {
            let area = a.perp(&b);
            let (s, t) = (from.perp(&b) / area, a.perp(&from) / area);
            if s.min(t) > best.0 {
                best = (s.min(t), center + (move_a - center) * s + (move_b - center) * t);
            }
        }
        best.1
    }

    /// Whether no triangle of a tile's fan is turned over, pressed flat or torn apart.
    pub fn is_sound(&self, tiling: &Tiling, tile: TileId) -> bool {
        let center = self.centers[tile].unwrap_or_default();
        self.fan(tiling, tile).all(|[(a, move_a), (b, move_b)]| {
            let (u, v) = (a + move_a - center, b + move_b - center);
            let stretched = |after: Vector2<f64>, before: Vector2<f64>| {
                after.norm() / before.norm() > MOST_STRETCH
            };
            u.perp(&v) / a.perp(&b) >= LEAST_AREA
                && !stretched(u, a)
                && !stretched(v, b)
                && !stretched(v - u, b - a)
        })
    }

    /// The outer sides of a tile's fan, counter-clockwise: both ends of each, as seen from
    /// the centre, with their moves.
    fn fan<'a>(
        &'a self,
        tiling: &'a Tiling,
        tile: TileId,
    ) -> impl Iterator<Item = [(Vector2<f64>, Vector2<f64>); 2]> + 'a {
        let center = tiling.centers[tile];
        let polygon = &tiling.net.tiles[tile];
        let n = polygon.corners.len();
        let corner = move |i: usize| {
            let v = polygon.corners[i % n];
            (tiling.vertices[v] - center, self.corners[v])
        };
        (0..n).flat_map(move |i| {
            let edge = polygon.edges[i];
            let middle = (tiling.midpoint(edge) - center, self.middles[edge]);
            [[corner(i), middle], [middle, corner(i + 1)]]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::library;
    use proptest::prelude::*;

    const LOW: Point2<f64> = Point2::new(-4.0, -4.0);
    const HIGH: Point2<f64> = Point2::new(4.0, 4.0);

    /// The field of all tiles of a patch whose centres move as told.
    fn field(tiling: &Tiling, moved: impl Fn(Point2<f64>) -> Vector2<f64>) -> Field {
        Field::new(&tiling.net, tiling.centers.iter().map(|&c| Some(moved(c))).collect())
    }

    /// Centres that all move alike take everything with them, far beyond their tiles, too.
    #[test]
    fn a_shift_moves_all_points_alike() {
        for pattern in library().iter().step_by(7) {
            let tiling = pattern.tiling.patch(LOW, HIGH);
            let by = Vector2::new(0.3, -0.2);
            let field = field(&tiling, |_| by);
            for tile in tiling.net.tiles.ids() {
                assert!(field.is_sound(&tiling, tile));
                for offset in [[0.0, 0.0], [0.3, 0.1], [-0.5, 0.4], [2.0, -3.0]] {
                    let p = tiling.centers[tile] + Vector2::from(offset);
                    assert!((field.at(&tiling, tile, p) - by).norm() < 1e-12);
                }
            }
        }
    }

    /// Both tiles of an edge move its points alike.
    #[test]
    fn tiles_stay_together_along_their_edges() {
        let tiling = library()[0].tiling.patch(LOW, HIGH);
        let field = field(&tiling, |c| Vector2::new((c.x * 1.3 + c.y).sin(), c.y * c.x) * 0.1);
        for edge in &tiling.net.edges {
            let Some(right) = edge.right else { continue };
            let [a, b] = edge.ends.map(|v| tiling.vertices[v]);
            for share in [0.0, 0.2, 0.5, 0.9, 1.0] {
                let p = a + (b - a) * share;
                let [l, r] = [edge.left, right].map(|tile| field.at(&tiling, tile, p));
                assert!((l - r).norm() < 1e-12, "{l} {r}");
            }
        }
    }

    #[test]
    fn tiles_that_take_no_part_neither_move_nor_hold_others() {
        let tiling = library()[0].tiling.patch(LOW, HIGH);
        let by = Vector2::new(0.2, 0.1);
        let centers = tiling.centers.iter().map(|c| (c.x > 0.0).then_some(by));
        let field = Field::new(&tiling.net, centers.collect());
        for (tile, &center) in tiling.centers.enumerate() {
            assert_eq!(field.moves(tile), center.x > 0.0);
            let wanted = if center.x > 0.0 { by } else { Vector2::zeros() };
            let corner = center + Vector2::new(-0.5, 0.5);
            assert!((field.at(&tiling, tile, corner) - wanted).norm() < 1e-12);
        }
    }

    proptest! {
        /// A field that is sound at every tile maps the plane one to one: all small pieces
        /// keep their sense, wherever they lie.
        #[test]
        fn sound_fields_do_not_fold(a in -1.2..1.2f64, b in -1.2..1.2f64, kind in 0..11usize) {
            let tiling = library()[kind].tiling.patch(LOW, HIGH);
            let field = field(&tiling, |c| Vector2::new(a * c.y.sin(), b * (c.x + c.y).cos()));
            for tile in tiling.net.tiles.ids().filter(|&t| field.is_sound(&tiling, t)) {
                let moved = |p: Point2<f64>| p + field.at(&tiling, tile, p);
                let center = tiling.centers[tile];
                let corners = &tiling.net.tiles[tile].corners;
                for (i, v) in corners.iter().enumerate() {
                    let next = tiling.vertices[corners[(i + 1) % corners.len()]];
                    let (p, q) = (tiling.vertices[*v], nalgebra::center(&tiling.vertices[*v], &next));
                    for [p, q] in [[p, q], [q, next]] {
                        let (u, v) = (moved(p) - moved(center), moved(q) - moved(center));
                        prop_assert!(u.perp(&v) > 0.1 * (p - center).perp(&(q - center)));
                    }
                }
            }
        }

        /// A corner that is turned inside out is noticed.
        #[test]
        fn folds_are_noticed(far in 1.0..3.0f64) {
            let tiling = library()[0].tiling.patch(LOW, HIGH);
            let middle = Point2::new(0.5, 0.5);
            let thrown = |c: Point2<f64>| if (c - middle).norm() < 0.1 { far } else { 0.0 };
            let field = field(&tiling, |c| Vector2::new(thrown(c), 0.0));
            let near = tiling.centers.enumerate().find(|(_, c)| (*c - middle).norm() < 0.1);
            prop_assert!(!field.is_sound(&tiling, near.unwrap().0));
        }
    }
}
