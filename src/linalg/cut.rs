//! Straight cuts through unknowns that have places.
//!
//! Cuts run across the wider directions of the places, so that those of a surface may lie
//! anyhow in space. Unknowns mostly lie in rows, along which a cut parts far fewer than askew,
//! so that directions are sought with care. The seam is the least set of unknowns that meets
//! all pairs that the cut parts: a vertex cover (Kőnig's theorem; Pothen, Simon and Liou,
//! *Partitioning sparse matrices with eigenvectors of graphs*, 1990, section 4).

use super::cover::{Pairs, least_cover};
use super::pattern::started;
use super::{LinalgError, LowerPattern};
use nalgebra::{Matrix3, Point3, Vector3};
use std::f64::consts::PI;

/// Directions that are compared at first, half a turn of them.
const DIRECTIONS: usize = 12;

/// The same where a cut lay well nearby: as many as rows of common patterns have symmetries.
const DIRECTIONS_ALONG: usize = 6;

/// Turns to either side of the best one that are tried of the first cut, one after the other.
const TURNS: [f64; 2] = [PI / 24.0, PI / 48.0];

/// A cut is none that leaves less than this part of the unknowns on one side.
const LOPSIDED: f64 = 0.25;

/// Of more unknowns than this, the middle is found from about as many of them.
const SAMPLE: usize = 250;

/// Who shares an entry with whom, and where.
pub struct Graph {
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    spots: Vec<Spot>,
}

/// Where an unknown is.
struct Spot {
    at: Vector3<f64>,
    /// How far away the farthest neighbour is.
    reach: f64,
}

impl Graph {
    /// That of a pattern whose unknowns lie at these places.
    pub fn new(pattern: &LowerPattern, places: &[Point3<f64>]) -> Self {
        let size = pattern.size();
        let below = |i: usize| pattern.column(i)[1..].iter().map(|&j| j as usize);
        let mut ends = vec![0_u32; size];
        for i in 0..size {
            for j in below(i) {
                ends[i] += 1;
                ends[j] += 1;
            }
        }
        let starts = started(&mut ends);
        let mut neighbours = vec![0; starts[size] as usize];
        let spot = |place: &Point3<f64>| Spot { at: place.coords, reach: 0.0 };
        let mut spots: Vec<Spot> = places.iter().map(spot).collect();
        for i in 0..size {
            for j in below(i) {
                let apart = (places[i] - places[j]).norm();
                for (one, other) in [(i, j), (j, i)] {
                    neighbours[ends[one] as usize] = other as u32;
                    ends[one] += 1;
                    spots[one].reach = spots[one].reach.max(apart);
                }
            }
        }
        Self { starts, neighbours, spots }
    }

    fn neighbours(&self, i: u32) -> &[u32] {
        let i = i as usize;
        &self.neighbours[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    fn place(&self, i: u32) -> Vector3<f64> {
        self.spots[i as usize].at
    }
}

/// What a cut parts.
pub struct Cut {
    /// Those on either side, which share no entry.
    pub halves: [Vec<u32>; 2],
    /// Those between.
    pub seam: Vec<u32>,
    /// Across the cut.
    pub way: Vector3<f64>,
}

/// Where to cut.
struct Plane {
    way: Vector3<f64>,
    at: f64,
}

impl Plane {
    /// How high an unknown lies above the plane.
    fn height(&self, graph: &Graph, i: u32) -> f64 {
        self.way.dot(&graph.place(i)) - self.at
    }

    /// Whether neighbours of an unknown may lie on the other side.
    fn is_in_reach(&self, graph: &Graph, i: u32) -> bool {
        self.height(graph, i).abs() <= graph.spots[i as usize].reach
    }
}

/// On which side of a cut an unknown is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    /// Not among those that are cut.
    Out,
    Left,
    Right,
    Seam,
}

/// Cuts unknowns, with room to work in.
pub struct Cutter<'a> {
    graph: &'a Graph,
    /// All out but for those that are cut just now.
    sides: Vec<Side>,
    /// Numbers within those that are looked at.
    numbers: Vec<u32>,
}

impl<'a> Cutter<'a> {
    /// For the unknowns of a graph.
    pub fn new(graph: &'a Graph) -> Self {
        let size = graph.spots.len();
        Self { graph, sides: vec![Side::Out; size], numbers: vec![0; size] }
    }

    /// Which of some unknowns share an entry, numbered in their order.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn pattern(&mut self, some: &[u32]) -> Result<LowerPattern, LinalgError> {
        self.mark(some, Side::Left);
        for (number, &i) in some.iter().enumerate() {
            self.numbers[i as usize] = number as u32;
        }
        let (sides, number) = (&self.sides, |i: u32| self.numbers[i as usize] as usize);
        let pairs = some.iter().flat_map(|&i| {
            let within = move |&&j: &&u32| j > i && sides[j as usize] != Side::Out;
            self.graph.neighbours(i).iter().filter(within).map(move |&j| (number(i), number(j)))
        });
        let pattern = LowerPattern::new(some.len(), pairs);
        self.mark(some, Side::Out);
        pattern
    }

    /// Cuts some unknowns in two where that parts few; nothing where they cannot be cut. Where
    /// cuts lay well nearby, one of them was across `along`.
    pub fn cut(&mut self, some: &[u32], along: Option<&Vector3<f64>>) -> Option<Cut> {
        self.mark(some, Side::Right);
        let best = self.best(some, along);
        let cut = best.map(|(plane, seam)| self.cut_by(some, &plane, seam));
        self.mark(some, Side::Out);
        cut
    }

    fn mark(&mut self, some: &[u32], side: Side) {
        some.iter().for_each(|&i| self.sides[i as usize] = side);
    }

    /// Where to cut, and the seam there.
    fn best(&mut self, some: &[u32], along: Option<&Vector3<f64>>) -> Option<(Plane, Vec<u32>)> {
        let [wide, next] = widest(self.graph, some);
        let mut across = |turn: f64| {
            let plane = self.middle(some, wide * turn.cos() + next * turn.sin())?;
            let seam = self.seam(some, &plane);
            Some((turn, plane, seam))
        };
        let (from, directions) = match along {
            Some(way) => (way.dot(&next).atan2(way.dot(&wide)), DIRECTIONS_ALONG),
            None => (0.0, DIRECTIONS),
        };
        let turns = (0..directions).map(|k| from + PI * k as f64 / directions as f64);
        // The first of the best.
        let mut best = turns.filter_map(&mut across).min_by_key(|(.., seam)| seam.len())?;
        for turn in if along.is_some() { &[][..] } else { &TURNS } {
            let beside = [best.0 - turn, best.0 + turn].into_iter().filter_map(&mut across);
            let found = beside.min_by_key(|(.., seam)| seam.len());
            best = found.filter(|found| found.2.len() < best.2.len()).unwrap_or(best);
        }
        Some((best.1, best.2))
    }

    /// A plane that leaves about as many unknowns on one side as on the other, if there is one.
    fn middle(&self, some: &[u32], way: Vector3<f64>) -> Option<Plane> {
        let sample = some.iter().step_by(some.len().div_ceil(SAMPLE));
        let mut heights: Vec<f64> = sample.map(|&i| way.dot(&self.graph.place(i))).collect();
        let middle = heights.len() / 2;
        let (left, &mut at, _) = heights.select_nth_unstable_by(middle, f64::total_cmp);
        let left = left.iter().filter(|&&height| height < at).count();
        (left as f64 >= LOPSIDED * heights.len() as f64).then_some(Plane { way, at })
    }

    /// The seam along a plane; all are on the right.
    fn seam(&mut self, some: &[u32], plane: &Plane) -> Vec<u32> {
        let graph = self.graph;
        let near = some.iter().copied().filter(|&i| plane.is_in_reach(graph, i));
        let (left, right): (Vec<u32>, Vec<u32>) = near.partition(|&i| plane.height(graph, i) < 0.0);
        self.mark(&left, Side::Left);
        for (number, &i) in right.iter().enumerate() {
            self.numbers[i as usize] = number as u32;
        }
        let is_right = |j: u32| {
            let is_near = self.sides[j as usize] == Side::Right && plane.is_in_reach(graph, j);
            is_near && plane.height(graph, j) >= 0.0
        };
        let mut pairs = Pairs::new(right.len());
        for &i in &left {
            let across = graph.neighbours(i).iter().filter(|&&j| is_right(j));
            pairs.push(across.map(|&j| self.numbers[j as usize]));
        }
        self.mark(&left, Side::Right);
        let [of_left, of_right] = least_cover(&pairs);
        let of_left = of_left.into_iter().map(|i| left[i as usize]);
        of_left.chain(of_right.into_iter().map(|i| right[i as usize])).collect()
    }

    fn cut_by(&mut self, some: &[u32], plane: &Plane, seam: Vec<u32>) -> Cut {
        self.mark(&seam, Side::Seam);
        let on = |left: bool| {
            let here = |i: u32| (plane.height(self.graph, i) < 0.0) == left;
            let rest = some.iter().copied().filter(|&i| self.sides[i as usize] != Side::Seam);
            rest.filter(|&i| here(i)).collect()
        };
        Cut { halves: [on(true), on(false)], seam, way: plane.way }
    }
}

/// The two widest directions of some places.
fn widest(graph: &Graph, some: &[u32]) -> [Vector3<f64>; 2] {
    let centre = some.iter().map(|&i| graph.place(i)).sum::<Vector3<f64>>() / some.len() as f64;
    let spread: Matrix3<f64> =
        some.iter().map(|&i| graph.place(i) - centre).map(|off| off * off.transpose()).sum();
    let axes = spread.symmetric_eigen();
    let mut by_width = [0, 1, 2];
    by_width.sort_by(|&i, &j| axes.eigenvalues[j].total_cmp(&axes.eigenvalues[i]));
    [0, 1].map(|i| axes.eigenvectors.column(by_width[i]).into_owned())
}
