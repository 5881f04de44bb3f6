//! k-uniform tilings: edge to edge, of regular polygons, with k kinds of vertices.
//!
//! A tiling is given by two translations and the vertices of one cell ([`table`]). Its
//! edges are the pairs at distance one; its tiles follow from sorting the edges round
//! each vertex by direction. Vertex configurations as in Grünbaum and Shephard,
//! *Tilings and Patterns*, sections 2.1 and 2.2.
//!
//! Vertices at distance one are always joined, so that the table need not name edges. A
//! segment between two that are not is a diagonal of a tile, which is longer than one; or
//! runs through a third vertex, and is longer still; or else leaves the tile at its one
//! end through a side that does not start there, and comes to its other end in the same
//! way. A corner of a regular polygon is at least √3/2 from such a side, so that this
//! segment is at least √3 long.

mod cell;
#[cfg(test)]
mod symmetry;
mod table;

pub use cell::{Across, Cell, CellTile, Spot};
pub use table::UNIFORM;

use super::lattice::{DIRECTIONS, Lattice};
use super::{Net, Tiling};
use nalgebra::{Point2, Vector2};
use std::collections::{BTreeMap, BTreeSet};

/// A k-uniform tiling: a row of the table.
#[derive(Debug)]
pub struct UniformTiling {
    /// The polygons round each kind of vertex, e.g. `3.6.3.6`, and for k > 1
    /// `3.3.6.6+3.6.3.6`; a number follows where two tilings share them, as in
    /// `3.3.3.4.4+4.4.4.4-2`.
    pub name: &'static str,
    /// Two walks from any vertex to vertices that see the same; they span a cell.
    translations: [&'static str; 2],
    /// The vertices of one cell, each by a walk from the origin, with spaces between.
    seeds: &'static str,
}

/// Where a walk from the origin leads. Each letter is a step of one edge: `a` along 0°,
/// `b` along 15° and so on to `x`; a dot is no step.
fn walk(steps: &str) -> Lattice {
    steps
        .bytes()
        .filter(u8::is_ascii_lowercase)
        .fold(Lattice::ZERO, |at, letter| at + Lattice::root(usize::from(letter - b'a')))
}

/// Vertices are made this far, in edges, beyond the box asked for. Every vertex in the
/// box must have all its edges: with less than one, tiles at its border would be merged
/// or lost; more only costs time.
const RIM: f64 = 1.5;

impl UniformTiling {
    /// The tiling of this vertex configuration.
    pub fn named(name: &str) -> Option<&'static Self> {
        UNIFORM.iter().find(|t| t.name == name)
    }

    /// The polygons round each kind of vertex, by their numbers of sides.
    pub fn configurations(&self) -> impl Iterator<Item = Vec<usize>> + '_ {
        let plain = self.name.split_once('-').map_or(self.name, |(plain, _)| plain);
        plain.split('+').map(|kind| kind.split('.').filter_map(|n| n.parse().ok()).collect())
    }

    /// The numbers of sides of its polygons, each once, ascending.
    pub fn polygons(&self) -> BTreeSet<usize> {
        self.configurations().flatten().collect()
    }

    /// All tiles that lie wholly in the box `[low, high]`; unit edge length, a
    /// vertex or a hexagon's centre at the origin.
    ///
    /// Tiles and edges are in a fixed order that does not depend on the machine.
    pub fn patch(&self, low: Point2<f64>, high: Point2<f64>) -> Tiling {
        let vertices = self.vertices(low, high);
        let mut maker = PatchMaker { vertices: &vertices, polygons: Vec::new() };
        for (&at, vertex) in &vertices {
            for k in directions(vertex.directions) {
                maker.add_tile_left_of(at, k, low, high);
            }
        }
        let points: Vec<Point2<f64>> = vertices.values().map(|v| v.point).collect();
        let center = |corners: &Vec<usize>| {
            let sum = corners.iter().fold(Vector2::zeros(), |c, &v| c + points[v].coords);
            (sum / corners.len() as f64).into()
        };
        let centers = maker.polygons.iter().map(center).collect();
        Tiling { net: Net::new(maker.polygons), vertices: points, centers }
    }

    /// Vertices in the box and its rim, each with the directions of its edges.
    fn vertices(&self, low: Point2<f64>, high: Point2<f64>) -> BTreeMap<Lattice, PatchVertex> {
        let [t1, t2] = self.translations.map(walk);
        let (e1, e2) = (t1.point().coords, t2.point().coords);
        let det = e1.perp(&e2);
        let rim = Vector2::new(RIM, RIM);
        let (low, high) = (low - rim, high + rim);
        let mut found = BTreeMap::new();
        for seed in self.seeds.split(' ').map(walk) {
            // Lattice coordinates of the box's corners, seen from the seed, bound the cells.
            let corners = [(low.x, low.y), (low.x, high.y), (high.x, low.y), (high.x, high.y)];
            let mut ranges = [(f64::MAX, f64::MIN); 2];
            for (x, y) in corners {
                let p = Point2::new(x, y) - seed.point();
                for (range, c) in ranges.iter_mut().zip([p.perp(&e2) / det, e1.perp(&p) / det]) {
                    *range = (range.0.min(c), range.1.max(c));
                }
            }
            let cells = ranges.map(|(lo, hi)| lo.floor() as i64..=hi.ceil() as i64);
            for i in cells[0].clone() {
                for j in cells[1].clone() {
                    let at = seed + t1 * i + t2 * j;
                    let point = at.point();
                    if low <= point && point <= high {
                        found.insert(at, PatchVertex { index: 0, point, directions: 0 });
                    }
                }
            }
        }
        link(found)
    }
}

/// A vertex of a patch; bit k of `directions` is set where an edge leaves along ζ^k.
struct PatchVertex {
    index: usize,
    point: Point2<f64>,
    directions: u32,
}

fn directions(bits: u32) -> impl Iterator<Item = usize> {
    (0..DIRECTIONS).filter(move |k| bits >> k & 1 == 1)
}

/// Numbers the vertices and finds the edges of each.
fn link(mut found: BTreeMap<Lattice, PatchVertex>) -> BTreeMap<Lattice, PatchVertex> {
    let steps: [Lattice; DIRECTIONS] = std::array::from_fn(Lattice::root);
    let bits: Vec<u32> = found
        .keys()
        .map(|&at| {
            (0..DIRECTIONS).filter(|&k| found.contains_key(&(at + steps[k]))).map(|k| 1 << k).sum()
        })
        .collect();
    for (index, (vertex, bits)) in found.values_mut().zip(bits).enumerate() {
        vertex.index = index;
        vertex.directions = bits;
    }
    found
}

struct PatchMaker<'a> {
    vertices: &'a BTreeMap<Lattice, PatchVertex>,
    /// The tiles found, by their vertices.
    polygons: Vec<Vec<usize>>,
}

impl PatchMaker<'_> {
    /// Walks round the tile on the left of the edge that leaves `start` along
    /// ζ^k and adds it, once: only from its least vertex, and only when it is
    /// regular and inside the box.
    fn add_tile_left_of(&mut self, start: Lattice, k: usize, low: Point2<f64>, high: Point2<f64>) {
        let mut corners = Vec::new();
        let (mut at, mut k, mut turn) = (start, k, None);
        loop {
            let vertex = &self.vertices[&at];
            let inside = low.x <= vertex.point.x
                && vertex.point.x <= high.x
                && low.y <= vertex.point.y
                && vertex.point.y <= high.y;
            if !inside || at < start || corners.len() == DIRECTIONS {
                return;
            }
            corners.push(vertex.index);
            at = at + Lattice::root(k);
            // The next edge of a tile on the left is the first one clockwise
            // from the edge just walked, seen backwards.
            let bits = self.vertices[&at].directions;
            let step = (1..=DIRECTIONS)
                .find(|s| bits >> ((k + 36 - s) % DIRECTIONS) & 1 == 1)
                .expect("the edge just walked leads back at the latest");
            if *turn.get_or_insert(step) != step {
                return;
            }
            k = (k + 36 - step) % DIRECTIONS;
            if at == start {
                break;
            }
        }
        self.polygons.push(corners);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The polygons round a vertex whose tiles are all there, as a cycle.
    fn configuration(tiling: &Tiling, vertex: usize) -> Option<Vec<usize>> {
        let center = tiling.vertices[vertex];
        let mut around: Vec<(f64, usize)> = tiling
            .net
            .tiles
            .enumerate()
            .filter(|(_, tile)| tile.corners.contains(&vertex))
            .map(|(t, tile)| {
                let d = tiling.centers[t] - center;
                (d.y.atan2(d.x), tile.corners.len())
            })
            .collect();
        let angle: f64 = around.iter().map(|&(_, n)| 180.0 - 360.0 / n as f64).sum();
        around.sort_by(|a, b| a.0.total_cmp(&b.0));
        ((angle - 360.0).abs() < 1e-9).then(|| around.into_iter().map(|(_, n)| n).collect())
    }

    fn same_cycle(a: &[usize], b: &[usize]) -> bool {
        let n = a.len();
        let matches =
            |at: &dyn Fn(usize) -> usize| (0..n).any(|s| (0..n).all(|i| a[i] == b[at(i + s) % n]));
        n == b.len() && (matches(&|i| i) || matches(&|i| 2 * n - 1 - i % n))
    }

    #[test]
    fn every_inner_vertex_has_a_configuration_of_the_name_and_each_occurs() {
        for kind in UNIFORM {
            let tiling = kind.patch(Point2::new(-8.0, -7.0), Point2::new(8.0, 7.0));
            let wanted: Vec<Vec<usize>> = kind.configurations().collect();
            let mut complete = vec![0; wanted.len()];
            for v in 0..tiling.vertices.len() {
                if let Some(found) = configuration(&tiling, v) {
                    let which = wanted.iter().position(|w| same_cycle(&found, w));
                    complete[which.unwrap_or_else(|| panic!("{}: {found:?}", kind.name))] += 1;
                }
            }
            assert!(complete.iter().all(|&n| n > 3), "{}: {complete:?}", kind.name);
            assert!(complete.iter().sum::<usize>() > 30, "{}: {complete:?}", kind.name);
        }
    }

    #[test]
    fn tiles_are_regular_and_counter_clockwise_and_cover_the_box() {
        for kind in UNIFORM {
            let tiling = kind.patch(Point2::new(-12.0, -12.0), Point2::new(12.0, 12.0));
            let mut area = 0.0;
            for (t, tile) in tiling.net.tiles.enumerate() {
                let (n, center) = (tile.corners.len(), tiling.centers[t]);
                let signed: f64 = (0..n)
                    .map(|i| {
                        let p = tiling.vertices[tile.corners[i]] - center;
                        p.perp(&(tiling.vertices[tile.corners[(i + 1) % n]] - center)) / 2.0
                    })
                    .sum();
                let regular = n as f64 / 4.0 / (PI / n as f64).tan();
                assert!((signed - regular).abs() < 1e-12, "{} {n}: {signed}", kind.name);
                area += signed;
            }
            // All but a rim as wide as the widest tile is covered once.
            let widest = kind.polygons().last().map_or(0.0, |&n| 1.0 / (PI / n as f64).sin());
            let inner = 24.0 - 2.0 * widest;
            assert!(area > inner * inner && area <= 24.0 * 24.0, "{}: {area}", kind.name);
        }
    }

    #[test]
    fn edges_know_both_their_tiles() {
        for kind in UNIFORM {
            let tiling = kind.patch(Point2::new(-5.0, -5.0), Point2::new(5.0, 5.0));
            for (e, edge) in tiling.net.edges.enumerate() {
                let sides = [Some(edge.left), edge.right];
                for tile in sides.into_iter().flatten() {
                    assert!(tiling.net.tiles[tile].edges.contains(&e));
                }
            }
        }
    }
}
