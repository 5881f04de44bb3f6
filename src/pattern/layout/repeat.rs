//! Units on the tiles of a tiling, so that they repeat.
//!
//! The units of a few cells are chosen, and the cells are laid side by side. So the whole
//! plane is known to fit, and each tile has its unit wherever it lies, without those
//! between it and the origin being looked at. The least number of cells is taken with
//! which it can be done.

use super::LayoutError;
use super::solve::{Choice, DeadEnd, Outcome, Puzzle, choices, solve};
use crate::pattern::UnitKind;
use crate::pattern::joints::Joints;
use crate::tiling::{Cell, Spot, UniformTiling};
use std::collections::BTreeMap;

/// Cells that repeat together, at most. Rules of a few units that can be laid at all
/// repeat in one to four; more take long to be found.
const MOST_CELLS: i64 = 12;

/// Units that are tried on a tile, in all: about a second.
const MOST_TRIES: usize = 20_000;

/// How far out it is tried whether rules can be laid at all, in rings round the middle.
const RINGS: usize = 4;

/// Units on the tiles of some cells, which repeat.
#[derive(Clone, Debug)]
pub struct Repeat {
    cell: Cell,
    grid: Grid,
    /// The units of all tiles of the first cell, then of the next, and so on.
    units: Vec<Choice>,
    colours: Option<Colours>,
}

impl Repeat {
    /// Finds units for all tiles of a tiling.
    ///
    /// # Errors
    /// [`LayoutError`] where there are none, or none that repeat are found.
    pub fn find(
        kinds: &[UnitKind],
        joints: &Joints,
        tiling: &UniformTiling,
    ) -> Result<Self, LayoutError> {
        let cell = tiling.cell();
        let choices = choices(kinds, joints);
        let mut tries = MOST_TRIES;
        for (i, grid) in Grid::all().enumerate() {
            // Most rules need one cell alone. Before more are tried, see that it can be.
            if i == 1 {
                possible(&cell, kinds, joints, &choices, &mut tries).map_err(|e| e.on(tiling))?;
            }
            let across = grid.across(&cell);
            match solve(&Puzzle { across: &across, joints, choices: &choices }, &mut tries) {
                Outcome::Filled(units) => {
                    let colours = Colours::of(&cell);
                    return Ok(Self { cell, grid, units, colours });
                }
                Outcome::Impossible(_) => {}
                Outcome::GivenUp => break,
            }
        }
        Err(LayoutError::NoRepeat { tiling: tiling.name })
    }

    /// The tiles.
    pub fn cell(&self) -> &Cell {
        &self.cell
    }

    /// The unit on a tile, and whether the tile is of the first colour; all are, where two
    /// colours are not enough.
    pub fn place(&self, spot: Spot) -> (Choice, bool) {
        let unit = self.units[self.grid.index(&self.cell, spot)];
        (unit, self.colours.as_ref().is_none_or(|c| c.is_first(spot)))
    }
}

/// Tries the rules on the tiles round the middle, ring by ring, without asking that they
/// repeat.
fn possible(
    cell: &Cell,
    kinds: &[UnitKind],
    joints: &Joints,
    choices: &BTreeMap<usize, Vec<Choice>>,
    tries: &mut usize,
) -> Result<(), Problem> {
    for radius in 1..=RINGS {
        let (spots, rings) = disc(cell, radius);
        let index: BTreeMap<Spot, usize> = spots.iter().enumerate().map(|(i, &s)| (s, i)).collect();
        let beyond = |(spot, edge)| index.get(&spot).map(|&i| (i, edge));
        let across: Vec<Vec<_>> =
            spots.iter().map(|&spot| neighbours(cell, spot).map(beyond).collect()).collect();
        let outcome = solve(&Puzzle { across: &across, joints, choices }, tries);
        if let Outcome::Impossible(DeadEnd { tile, beside }) = outcome {
            return Err(Problem {
                sides: across[tile].len(),
                ring: rings[tile],
                beside: beside.into_iter().map(|k| kinds[k].name.clone()).collect(),
            });
        }
    }
    Ok(())
}

/// Why rules cannot be laid at all.
struct Problem {
    sides: usize,
    ring: usize,
    beside: Vec<String>,
}

impl Problem {
    fn on(self, tiling: &UniformTiling) -> LayoutError {
        let Self { sides, ring, beside } = self;
        LayoutError::DeadEnd { tiling: tiling.name, sides, ring, beside }
    }
}

/// The tiles beyond the edges of a tile, with their edges there.
fn neighbours(cell: &Cell, spot: Spot) -> impl Iterator<Item = (Spot, usize)> {
    cell.tiles[spot.tile].across.iter().map(move |across| {
        let shift = [0, 1].map(|i| spot.shift[i] + across.spot.shift[i]);
        (Spot { shift, ..across.spot }, across.edge)
    })
}

/// The tiles within some rings of the middle one, outwards, and the ring of each.
fn disc(cell: &Cell, radius: usize) -> (Vec<Spot>, Vec<usize>) {
    let mut spots = vec![Spot { tile: 0, shift: [0; 2] }];
    let mut rings = vec![0];
    let mut next = 0;
    while next < spots.len() && rings[next] < radius {
        for (other, _) in neighbours(cell, spots[next]) {
            if !spots.contains(&other) {
                spots.push(other);
                rings.push(rings[next] + 1);
            }
        }
        next += 1;
    }
    (spots, rings)
}

/// Which cells are alike: those that differ by `wide` steps along the first translation,
/// or by `high` along the second and `slant` along the first.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Grid {
    wide: i64,
    high: i64,
    slant: i64,
}

impl Grid {
    /// All of them, those with few different cells first.
    fn all() -> impl Iterator<Item = Self> {
        (1..=MOST_CELLS).flat_map(|cells| {
            let divides = move |wide: &i64| cells % wide == 0;
            (1..=cells).filter(divides).flat_map(move |wide| {
                (0..wide).map(move |slant| Self { wide, high: cells / wide, slant })
            })
        })
    }

    /// The number of the tile that stands for this one.
    fn index(self, cell: &Cell, Spot { tile, shift: [p, q] }: Spot) -> usize {
        let rows = q.div_euclid(self.high);
        let (p, q) = ((p - rows * self.slant).rem_euclid(self.wide), q.rem_euclid(self.high));
        (q * self.wide + p) as usize * cell.tiles.len() + tile
    }

    /// What lies across the edges of the different tiles.
    fn across(self, cell: &Cell) -> Vec<Vec<Option<(usize, usize)>>> {
        let cells = (0..self.high).flat_map(|q| (0..self.wide).map(move |p| [p, q]));
        let tiles =
            cells.flat_map(|shift| (0..cell.tiles.len()).map(move |tile| Spot { tile, shift }));
        let beyond = |(other, edge)| Some((self.index(cell, other), edge));
        tiles.map(|spot| neighbours(cell, spot).map(beyond).collect()).collect()
    }
}

/// Two colours, so that tiles side by side differ.
#[derive(Clone, Debug)]
struct Colours {
    /// Whether a tile of the cell is of the first colour.
    first: Vec<bool>,
    /// Whether the translations change the colour.
    change: [bool; 2],
}

impl Colours {
    /// The colours of a tiling, its middle tile in the first; `None` if two are not enough.
    fn of(cell: &Cell) -> Option<Self> {
        let ways = [[false, false], [true, false], [false, true], [true, true]];
        ways.into_iter().find_map(|change| {
            let mut colours = Self { first: vec![false; cell.tiles.len()], change };
            colours.first[0] = true;
            let mut known = vec![0];
            let mut next = 0;
            while let Some(&tile) = known.get(next) {
                next += 1;
                let here = Spot { tile, shift: [0; 2] };
                for (other, _) in neighbours(cell, here) {
                    if !known.contains(&other.tile) {
                        known.push(other.tile);
                        colours.first[other.tile] = true;
                        colours.first[other.tile] =
                            colours.is_first(other) != colours.is_first(here);
                    }
                    if colours.is_first(other) == colours.is_first(here) {
                        return None;
                    }
                }
            }
            Some(colours)
        })
    }

    fn is_first(&self, Spot { tile, shift }: Spot) -> bool {
        let changes = |i: usize| self.change[i] && shift[i] % 2 != 0;
        self.first[tile] ^ changes(0) ^ changes(1)
    }
}
