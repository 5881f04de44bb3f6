//! Proof that each row of the table is the tiling it is named after: the symmetries of
//! its cell, found by trying all, and the orbits of its vertices, edges and tiles.
//!
//! All in exact arithmetic, but for the rounding of two lattice coordinates that are
//! then checked exactly.

use super::{DIRECTIONS, Lattice, UNIFORM, UniformTiling, directions};

/// What is known of a tiling, to be found again: its wallpaper group, its orbits of
/// vertices, tiles and edges, and how many vertices of each kind are in a cell, in the
/// order of the name.
type Class = (&'static str, &'static str, [usize; 3], &'static [usize]);

const CLASSES: &[Class] = &[
    ("3.3.3.3.3.3", "p6m", [1, 1, 1], &[1]),
    ("4.4.4.4", "p4m", [1, 1, 1], &[1]),
    ("6.6.6", "p6m", [1, 1, 1], &[2]),
    ("3.6.3.6", "p6m", [1, 2, 1], &[3]),
    ("3.4.6.4", "p6m", [1, 3, 2], &[6]),
    ("3.3.3.4.4", "cmm", [1, 2, 3], &[2]),
    ("3.3.4.3.4", "p4g", [1, 2, 2], &[4]),
    ("3.3.3.3.6", "p6", [1, 3, 3], &[6]),
    ("4.8.8", "p4m", [1, 2, 2], &[4]),
    ("3.12.12", "p6m", [1, 2, 2], &[6]),
    ("4.6.12", "p6m", [1, 3, 3], &[12]),
    ("3.3.3.3.3.3+3.3.3.3.6-1", "p6m", [2, 3, 3], &[2, 6]),
    ("3.3.3.3.3.3+3.3.3.3.6-2", "p6", [2, 5, 6], &[6, 6]),
    ("3.3.3.3.3.3+3.3.3.4.4-1", "pmm", [2, 3, 4], &[1, 2]),
    ("3.3.3.3.3.3+3.3.3.4.4-2", "cmm", [2, 4, 5], &[2, 2]),
    ("3.3.3.3.3.3+3.3.4.3.4", "p6m", [2, 3, 3], &[1, 6]),
    ("3.3.3.3.3.3+3.3.4.12", "p6m", [2, 4, 4], &[2, 12]),
    ("3.3.3.3.3.3+3.3.6.6", "p6m", [2, 2, 3], &[1, 6]),
    ("3.3.3.3.6+3.3.6.6", "cmm", [2, 2, 4], &[2, 2]),
    ("3.3.3.4.4+3.3.4.3.4-1", "p4g", [2, 4, 5], &[4, 8]),
    ("3.3.3.4.4+3.3.4.3.4-2", "pgg", [2, 3, 6], &[4, 4]),
    ("3.3.3.4.4+3.4.6.4", "p6m", [2, 4, 4], &[6, 6]),
    ("3.3.3.4.4+4.4.4.4-1", "cmm", [2, 2, 4], &[2, 1]),
    ("3.3.3.4.4+4.4.4.4-2", "cmm", [2, 3, 5], &[2, 2]),
    ("3.3.4.3.4+3.4.6.4", "p6m", [2, 4, 4], &[6, 6]),
    ("3.3.6.6+3.6.3.6", "pmm", [2, 2, 3], &[2, 1]),
    ("3.4.3.12+3.12.12", "p4m", [2, 3, 3], &[4, 4]),
    ("3.4.4.6+3.4.6.4", "p6m", [2, 5, 5], &[12, 6]),
    ("3.4.4.6+3.6.3.6-1", "pmm", [2, 4, 4], &[4, 1]),
    ("3.4.4.6+3.6.3.6-2", "cmm", [2, 3, 4], &[4, 1]),
    ("3.4.6.4+4.6.12", "p6m", [2, 4, 4], &[6, 12]),
];

/// A point as the directions of the unit steps that lead to it, so that it can be turned
/// and reflected.
type Steps = Vec<usize>;

fn sum(steps: &[usize]) -> Lattice {
    steps.iter().fold(Lattice::ZERO, |at, &k| at + Lattice::root(k))
}

fn steps(walk: &str) -> Steps {
    walk.bytes().filter(|&c| c != b'.').map(|c| usize::from(c - b'a')).collect()
}

/// An isometry: p ↦ ζ^turn · p, or ζ^turn times the conjugate of p if `flip`; then shifted.
struct Isometry {
    turn: usize,
    flip: bool,
    shift: Steps,
}

impl Isometry {
    fn linear(&self, p: &[usize]) -> Steps {
        let turned = |k: usize| if self.flip { DIRECTIONS - k } else { k } + self.turn;
        p.iter().map(|&k| turned(k) % DIRECTIONS).collect()
    }

    /// The image of a sum of `count` points.
    fn image(&self, points: &[usize], count: usize) -> Lattice {
        sum(&self.linear(points)) + sum(&self.shift) * count as i64
    }
}

/// Points up to translations: vertices, the ends of an edge or the corners of a tile,
/// the last two by their sum. All of one list have the same number of points in the sum.
struct Places {
    count: usize,
    sums: Vec<(Steps, Lattice)>,
}

/// One cell of a tiling.
struct Cell {
    translations: [Steps; 2],
    seeds: Vec<Steps>,
}

impl Cell {
    fn new(tiling: &UniformTiling) -> Self {
        Self {
            translations: tiling.translations.map(steps),
            seeds: tiling.seeds.split(' ').map(steps).collect(),
        }
    }

    /// Whether `offset` is `count` times a combination of the translations.
    fn has(&self, offset: Lattice, count: usize) -> bool {
        let [t1, t2] = [0, 1].map(|i| sum(&self.translations[i]) * count as i64);
        let (e1, e2, p) = (t1.point().coords, t2.point().coords, offset.point().coords);
        let det = e1.perp(&e2);
        let [i, j] = [p.perp(&e2) / det, e1.perp(&p) / det].map(|c| c.round() as i64);
        offset == t1 * i + t2 * j
    }

    fn find(&self, at: Lattice, among: &Places) -> Option<usize> {
        among.sums.iter().position(|&(_, other)| self.has(at - other, among.count))
    }

    fn places(&self, count: usize, all: impl IntoIterator<Item = Steps>) -> Places {
        let mut places = Places { count, sums: Vec::new() };
        for steps in all {
            let at = sum(&steps);
            if self.find(at, &places).is_none() {
                places.sums.push((steps, at));
            }
        }
        places
    }

    fn vertices(&self) -> Places {
        self.places(1, self.seeds.iter().cloned())
    }

    /// The directions of the edges at a vertex, as bits.
    fn edges_at(&self, vertex: Lattice, vertices: &Places) -> u32 {
        let joined = |k: &usize| self.find(vertex + Lattice::root(*k), vertices).is_some();
        (0..DIRECTIONS).filter(joined).map(|k| 1 << k).sum()
    }

    fn edges(&self) -> Places {
        let vertices = self.vertices();
        let of = |(steps, at): &(Steps, Lattice)| {
            let ends = |k| [&steps[..], &steps[..], &[k]].concat();
            directions(self.edges_at(*at, &vertices)).map(ends).collect::<Vec<_>>()
        };
        self.places(2, vertices.sums.iter().flat_map(of))
    }

    /// The tiles, by their numbers of corners.
    fn tiles(&self) -> Vec<Places> {
        let vertices = self.vertices();
        let mut found: Vec<(usize, Steps)> = Vec::new();
        for (start, at) in &vertices.sums {
            for first in directions(self.edges_at(*at, &vertices)) {
                let (mut here, mut corners, mut n, mut k) = (start.clone(), Steps::new(), 0, first);
                while n == 0 || sum(&here) != *at {
                    corners.extend(&here);
                    here.push(k);
                    n += 1;
                    let bits = self.edges_at(sum(&here), &vertices);
                    let right = (1..=DIRECTIONS).map(|s| (k + 36 - s) % DIRECTIONS);
                    k = right.clone().find(|d| bits >> d & 1 == 1).expect("back at the latest");
                }
                found.push((n, corners));
            }
        }
        let of = |n: usize| found.iter().filter(move |f| f.0 == n).map(|f| f.1.clone());
        (3..=12).map(|n| self.places(n, of(n))).collect()
    }

    /// All symmetries of the tiling, up to its translations.
    fn symmetries(&self) -> Vec<Isometry> {
        let vertices = self.vertices();
        let mut found = Vec::new();
        for (turn, flip) in (0..DIRECTIONS).flat_map(|t| [(t, false), (t, true)]) {
            for target in &self.seeds {
                let mut g = Isometry { turn, flip, shift: target.clone() };
                let back = g.linear(&self.seeds[0]);
                g.shift.extend(back.iter().map(|k| (k + DIRECTIONS / 2) % DIRECTIONS));
                if self.translations.iter().all(|t| self.has(sum(&g.linear(t)), 1))
                    && self.seeds.iter().all(|s| self.find(g.image(s, 1), &vertices).is_some())
                {
                    found.push(g);
                }
            }
        }
        found
    }

    fn orbits(&self, places: &Places, symmetries: &[Isometry]) -> usize {
        let leads = |(i, (steps, _)): &(usize, &(Steps, Lattice))| {
            symmetries.iter().all(|g| {
                let image = self.find(g.image(steps, places.count), places);
                image.expect("a symmetry takes like to like") >= *i
            })
        };
        places.sums.iter().enumerate().filter(leads).count()
    }

    /// Whether a flip, followed by some translation, leaves points where they are.
    fn is_mirror(&self, flip: &Isometry) -> bool {
        let twice = sum(&flip.shift) + sum(&flip.linear(&flip.shift));
        let [t1, t2] = &self.translations;
        let doubled = |t: &[usize]| sum(t) + sum(&flip.linear(t));
        let (d1, d2) = (doubled(t1), doubled(t2));
        let few = || -4..=4;
        few().any(|i| few().any(|j| twice + d1 * i + d2 * j == Lattice::ZERO))
    }

    /// The wallpaper group, of those that occur here.
    fn group(&self, symmetries: &[Isometry]) -> &'static str {
        let flips: Vec<&Isometry> = symmetries.iter().filter(|g| g.flip).collect();
        let mirrors = flips.iter().filter(|g| self.is_mirror(g)).count();
        // A flip keeps a rectangular lattice and its double apart; of a rhombic one it
        // swaps two translations.
        let rectangular = flips.iter().all(|g| {
            let moved = |t: &Steps| sum(&g.linear(t)) - sum(t);
            self.translations.iter().all(|t| self.has(moved(t), 2))
        });
        match (symmetries.len() - flips.len(), flips.len(), mirrors, rectangular) {
            (6, 6, ..) => "p6m",
            (6, 0, ..) => "p6",
            (4, 4, 4, _) => "p4m",
            (4, 4, 2, _) => "p4g",
            (2, 2, 2, false) => "cmm",
            (2, 2, 2, true) => "pmm",
            (2, 2, 0, true) => "pgg",
            _ => "another",
        }
    }
}

/// The polygons round a vertex with these edges.
fn around(bits: u32) -> Vec<usize> {
    let out: Vec<usize> = directions(bits).collect();
    let next = out.iter().cycle().skip(1);
    // A corner of 15° times m belongs to a polygon of 24 / (12 - m) sides.
    out.iter().zip(next).map(|(a, b)| 24 / (12 - (b + DIRECTIONS - a) % DIRECTIONS)).collect()
}

/// A cycle of polygons, from where and in the sense in which it reads least.
fn least(cycle: &[usize]) -> Vec<usize> {
    let turned = |i: usize| [&cycle[i..], &cycle[..i]].concat();
    let both = (0..cycle.len()).map(turned).flat_map(|c| {
        let back = c.iter().rev().copied().collect();
        [c, back]
    });
    both.min().unwrap_or_default()
}

#[test]
fn every_row_has_the_group_and_the_orbits_of_its_tiling() {
    assert_eq!(UNIFORM.len(), CLASSES.len());
    for (tiling, (name, group, orbits, kinds)) in UNIFORM.iter().zip(CLASSES) {
        assert_eq!(tiling.name, *name);
        let cell = Cell::new(tiling);
        let symmetries = cell.symmetries();
        let plain = symmetries.iter().filter(|g| g.turn == 0 && !g.flip).count();
        assert_eq!(plain, 1, "{name}: the cell could be smaller");
        assert_eq!(cell.vertices().sums.len(), cell.seeds.len(), "{name}: a vertex twice");
        assert_eq!(cell.group(&symmetries), *group, "{name}");
        let count = |places: &Places| cell.orbits(places, &symmetries);
        let tiles = cell.tiles().iter().map(count).sum();
        assert_eq!([count(&cell.vertices()), tiles, count(&cell.edges())], *orbits, "{name}");
        assert_eq!(orbits[0], kinds.len(), "{name}");
        let vertices = cell.vertices();
        for (wanted, &number) in tiling.configurations().zip(*kinds) {
            let fits = |(_, at): &&(Steps, Lattice)| {
                least(&around(cell.edges_at(*at, &vertices))) == least(&wanted)
            };
            assert_eq!(vertices.sums.iter().filter(fits).count(), number, "{name} {wanted:?}");
        }
    }
}

/// Tilings of one class could be one tiling twice.
#[test]
fn no_two_rows_are_alike() {
    for (i, a) in CLASSES.iter().enumerate() {
        let kinds = |c: &Class| c.0.rsplit_once('-').map_or(c.0, |(kinds, _)| kinds);
        for b in &CLASSES[..i] {
            assert!(kinds(a) != kinds(b) || (a.1, a.2) != (b.1, b.2), "{} and {}", a.0, b.0);
        }
    }
}
