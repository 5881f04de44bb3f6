//! The uniform tilings with polygons up to hexagons, from exact lattice data.
//!
//! A tiling is given by two translations and the vertices of one cell. Its edges
//! are the pairs at distance one; its tiles follow from sorting the edges round
//! each vertex by direction. Vertex configurations as in Grünbaum and Shephard,
//! *Tilings and Patterns*, section 2.1.

use super::lattice::{DIRECTIONS, Lattice};
use super::{Net, Tiling};
use nalgebra::{Point2, Vector2};
use std::collections::BTreeMap;

/// Terms `(count, k)` of a sum of count · ζ^k; ζ = e^{iπ/12}.
type Sum = &'static [(i64, usize)];

/// A uniform tiling: every vertex has the same polygons round it.
#[derive(Debug)]
pub struct UniformTiling {
    /// The vertex configuration, e.g. `3.6.3.6`.
    pub name: &'static str,
    translations: [Sum; 2],
    seeds: &'static [Sum],
}

/// The corners of a hexagon of unit radius about the origin.
const HEXAGON: &[Sum] = &[&[(1, 0)], &[(1, 4)], &[(1, 8)], &[(1, 12)], &[(1, 16)], &[(1, 20)]];

/// All uniform tilings that are known here.
pub const UNIFORM: &[UniformTiling] = &[
    UniformTiling { name: "3.3.3.3.3.3", translations: [&[(1, 0)], &[(1, 4)]], seeds: &[&[]] },
    UniformTiling { name: "4.4.4.4", translations: [&[(1, 0)], &[(1, 6)]], seeds: &[&[]] },
    UniformTiling {
        name: "6.6.6",
        translations: [&[(1, 0), (1, 4)], &[(1, 4), (1, 8)]],
        seeds: &[&[], &[(1, 0)]],
    },
    UniformTiling {
        name: "3.6.3.6",
        translations: [&[(2, 0)], &[(2, 4)]],
        seeds: &[&[], &[(1, 0)], &[(1, 4)]],
    },
    UniformTiling {
        name: "3.4.6.4",
        translations: [&[(1, 0), (1, 2), (1, 4)], &[(1, 4), (1, 6), (1, 8)]],
        seeds: HEXAGON,
    },
    UniformTiling {
        name: "3.3.3.4.4",
        translations: [&[(1, 0)], &[(1, 4), (1, 6)]],
        seeds: &[&[], &[(1, 6)]],
    },
    UniformTiling {
        name: "3.3.4.3.4",
        translations: [&[(1, 0), (1, 2)], &[(1, 6), (1, 8)]],
        seeds: &[&[], &[(1, 0)], &[(1, 4)], &[(1, 8)]],
    },
    UniformTiling {
        name: "3.3.3.3.6",
        translations: [&[(2, 0), (1, 4)], &[(2, 4), (1, 8)]],
        seeds: HEXAGON,
    },
];

/// Vertices are made this far, in edges, beyond the region asked for, so that
/// the tiles at its border are complete. A hexagon is two edges wide; less than
/// that and holes at the rim could pass for tiles.
const RIM: f64 = 3.0;

impl UniformTiling {
    /// The tiling of this vertex configuration.
    pub fn named(name: &str) -> Option<&'static Self> {
        UNIFORM.iter().find(|t| t.name == name)
    }

    /// The numbers of sides of its polygons, as they stand round a vertex.
    pub fn polygons(&self) -> impl Iterator<Item = usize> + '_ {
        self.name.split('.').filter_map(|sides| sides.parse().ok())
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
        let [t1, t2] = self.translations.map(Lattice::sum);
        let (e1, e2) = (t1.point().coords, t2.point().coords);
        let det = e1.perp(&e2);
        // Lattice coordinates of the corners of the grown box bound the cells.
        let corners = [(low.x, low.y), (low.x, high.y), (high.x, low.y), (high.x, high.y)];
        let mut ranges = [(f64::MAX, f64::MIN); 2];
        for (x, y) in corners {
            let p = Vector2::new(x, y);
            for (range, c) in ranges.iter_mut().zip([p.perp(&e2) / det, e1.perp(&p) / det]) {
                *range = (range.0.min(c), range.1.max(c));
            }
        }
        let cells = ranges
            .map(|(lo, hi)| ((lo - 2.0 * RIM).floor() as i64, (hi + 2.0 * RIM).ceil() as i64));
        let mut found = BTreeMap::new();
        for i in cells[0].0..=cells[0].1 {
            for j in cells[1].0..=cells[1].1 {
                for seed in self.seeds {
                    let at = Lattice::sum(seed) + t1 * i + t2 * j;
                    let p = at.point();
                    let inside = |lo: f64, x: f64, hi: f64| lo - RIM <= x && x <= hi + RIM;
                    if inside(low.x, p.x, high.x) && inside(low.y, p.y, high.y) {
                        found.insert(at, PatchVertex { index: 0, point: p, directions: 0 });
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
    fn every_inner_vertex_has_the_configuration_of_its_name() {
        for kind in UNIFORM {
            let tiling = kind.patch(Point2::new(-6.0, -5.0), Point2::new(6.0, 5.0));
            let wanted: Vec<usize> = kind.polygons().collect();
            let mut complete = 0;
            for v in 0..tiling.vertices.len() {
                if let Some(found) = configuration(&tiling, v) {
                    assert!(same_cycle(&found, &wanted), "{}: {found:?}", kind.name);
                    complete += 1;
                }
            }
            assert!(complete > 30, "{}: {complete} complete vertices", kind.name);
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
                let regular = n as f64 / 4.0 / (std::f64::consts::PI / n as f64).tan();
                assert!((signed - regular).abs() < 1e-12, "{} {n}: {signed}", kind.name);
                area += signed;
            }
            // All but a rim of two edges is covered once.
            assert!(area > 20.0 * 20.0 && area <= 24.0 * 24.0, "{}: {area}", kind.name);
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
