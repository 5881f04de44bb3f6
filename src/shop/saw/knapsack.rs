//! The most valuable pieces that one bar holds, by dynamic programming over its length
//! in whole cells (Martello and Toth, *Knapsack Problems*, 1990, section 2.6).
//!
//! Lengths that are multiples of one cell are met exactly. Others are rounded: sizes up and
//! bars down for patterns that can be sawn ([`Rounding::Safe`]), sizes and bars down for bounds that
//! hold ([`Rounding::Generous`]).

use super::task::{Kind, Task};
use crate::frame::measure::SAME_LENGTH;

/// Lengths are taken to be multiples of this where they are, mm: what is written with three
/// decimals.
const FINEST: f64 = 1e-3;
/// Most cells of a bar: fewer, and rounded lengths lose bounds; more, and tables take long.
const MOST_CELLS: usize = 8192;
/// Cells times sizes where lengths are rounded, down to so many cells: tables of many sizes.
const ROUNDED_ENTRIES: usize = 2_000_000;
const LEAST_CELLS: usize = 1024;

/// How lengths that are no multiples of a cell are rounded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rounding {
    /// What fits in cells fits the bar.
    Safe,
    /// What fits the bar fits in cells.
    Generous,
}

/// Sizes and rooms in whole cells.
#[derive(Clone, Debug)]
pub struct Knapsack {
    sizes: Vec<usize>,
    rooms: Vec<usize>,
}

impl Knapsack {
    /// The task in cells that meet its lengths exactly, if there are such.
    pub fn exact(task: &Task) -> Option<Self> {
        let whole = |x: f64| {
            let cells = (x / FINEST).round();
            ((cells * FINEST - x).abs() <= SAME_LENGTH && cells < 1e15).then_some(cells as u64)
        };
        let sizes: Option<Vec<u64>> = task.sizes.iter().map(|&s| whole(s)).collect();
        let rooms: Option<Vec<u64>> = task.kinds.iter().map(|k| whole(k.room)).collect();
        let (sizes, rooms) = (sizes?, rooms?);
        let cell = sizes.iter().chain(&rooms).copied().reduce(divisor)?.max(1);
        let cells = |x: &u64| usize::try_from(x / cell).ok();
        let sizes: Option<Vec<usize>> = sizes.iter().map(cells).collect();
        let rooms: Option<Vec<usize>> = rooms.iter().map(cells).collect();
        let (sizes, rooms) = (sizes?, rooms?);
        (rooms.iter().all(|&r| r <= MOST_CELLS)).then_some(Self { sizes, rooms })
    }

    /// The task in cells, rounded.
    pub fn rounded(task: &Task, rounding: Rounding) -> Self {
        let longest = task.kinds.iter().map(|k| k.room).fold(0.0, f64::max);
        let cells = ROUNDED_ENTRIES / task.sizes.len().max(1);
        let cell = longest / cells.clamp(LEAST_CELLS, MOST_CELLS) as f64;
        let down = |x: f64| (x / cell + SAME_LENGTH).floor() as usize;
        let size = |&x: &f64| match rounding {
            Rounding::Safe => (x / cell - SAME_LENGTH / cell).ceil() as usize,
            Rounding::Generous => down(x - SAME_LENGTH),
        };
        let room = |k: &Kind| match rounding {
            Rounding::Safe => (k.room / cell).floor() as usize,
            Rounding::Generous => down(k.room + SAME_LENGTH),
        };
        let sizes = task.sizes.iter().map(size).collect();
        Self { sizes, rooms: task.kinds.iter().map(room).collect() }
    }

    /// Cells of a kind of bar.
    pub fn room(&self, kind: usize) -> usize {
        self.rooms[kind]
    }

    /// Cells of a kind of bar that a piece leaves.
    pub fn cells_beside(&self, kind: usize, size: usize) -> usize {
        self.rooms[kind].saturating_sub(self.sizes[size])
    }

    /// How many entries a table for so many pieces has.
    pub fn entries(&self, limits: &[usize]) -> usize {
        let most = self.most();
        let parts = |(i, &n): (usize, &usize)| parts(n.min(most / self.sizes[i].max(1))).count();
        limits.iter().enumerate().map(parts).sum::<usize>() * (most + 1)
    }

    fn most(&self) -> usize {
        self.rooms.iter().copied().max().unwrap_or(0)
    }

    /// The best choice of at most so many pieces of each size, for a bar of any length.
    /// Pieces without value are left out.
    pub fn table(&self, values: &[f64], limits: &[usize]) -> Table {
        let most = self.most();
        let mut best = vec![0.0; most + 1];
        let mut before = best.clone();
        let mut layers = Vec::new();
        for (i, &size) in self.sizes.iter().enumerate() {
            let limit = limits[i].min(most / size.max(1));
            if values[i] <= 0.0 || limit == 0 {
                continue;
            }
            for count in parts(limit) {
                let (cells, value) = (size * count, values[i] * count as f64);
                before.copy_from_slice(&best);
                let mut taken = vec![false; most + 1];
                let place = best[cells..].iter_mut().zip(&mut taken[cells..]);
                for ((to, taken), from) in place.zip(&before) {
                    let with = from + value;
                    *taken = with > *to;
                    *to = if *taken { with } else { *to };
                }
                layers.push(Layer { size: i, count, cells, taken });
            }
        }
        Table { best, layers }
    }
}

/// Numbers whose sums are all numbers up to `n`, and none above.
fn parts(n: usize) -> impl Iterator<Item = usize> {
    let mut left = n;
    let mut next = 1;
    std::iter::from_fn(move || {
        let part = next.min(left);
        left -= part;
        next *= 2;
        (part > 0).then_some(part)
    })
}

/// The greatest common divisor.
pub fn divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// The most value for each number of cells, and how it comes about.
pub struct Table {
    best: Vec<f64>,
    layers: Vec<Layer>,
}

/// So many pieces of a size, taken together or not.
struct Layer {
    size: usize,
    count: usize,
    cells: usize,
    taken: Vec<bool>,
}

impl Table {
    /// The most value that so many cells hold.
    pub fn value(&self, cells: usize) -> f64 {
        self.best[cells]
    }

    /// The pieces that have it, longest first.
    pub fn load(&self, cells: usize) -> Vec<(usize, usize)> {
        let mut left = cells;
        let mut pieces: Vec<(usize, usize)> = Vec::new();
        for layer in self.layers.iter().rev() {
            if !layer.taken[left] {
                continue;
            }
            left -= layer.cells;
            match pieces.last_mut().filter(|p| p.0 == layer.size) {
                Some(piece) => piece.1 += layer.count,
                None => pieces.push((layer.size, layer.count)),
            }
        }
        pieces.reverse();
        pieces
    }
}
