//! The search for a unit on every tile, so that rules allow what meets at every edge.
//!
//! Tiles are filled in order. After each choice, units that no longer fit are struck out
//! on all tiles that are still free (arc consistency, Mackworth 1977); where a tile is left
//! with none, the choice is taken back. So a choice is only wrong where the rules fit
//! round every tile and yet not further out, and the search is short.

use crate::pattern::UnitKind;
use crate::pattern::joints::Joints;
use std::collections::BTreeMap;

/// A unit as it may lie on a tile: its kind, and which of its sides is at edge 0.
pub type Choice = (usize, usize);

/// Tiles to fill.
pub struct Puzzle<'a> {
    /// For each edge of each tile the tile beyond and its edge there; `None` at the rim.
    pub across: &'a [Vec<Option<(usize, usize)>>],
    /// What may meet.
    pub joints: &'a Joints,
    /// For each number of sides the units that may lie there, the first choice first.
    pub choices: &'a BTreeMap<usize, Vec<Choice>>,
}

/// What the search found.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// A unit for each tile.
    Filled(Vec<Choice>),
    /// There is no way to fill all tiles.
    Impossible(DeadEnd),
    /// The search was given up.
    GivenUp,
}

/// A tile for which no unit is left.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DeadEnd {
    /// The tile; of all such the one farthest on.
    pub tile: usize,
    /// The kinds of the units on the tiles round it, as far as they are settled.
    pub beside: Vec<usize>,
}

/// The units for each number of sides, each in all ways in which it may lie: turned only
/// where rules tell its sides apart.
pub fn choices(kinds: &[UnitKind], joints: &Joints) -> BTreeMap<usize, Vec<Choice>> {
    let mut all: BTreeMap<usize, Vec<Choice>> = BTreeMap::new();
    for (kind, unit) in kinds.iter().enumerate() {
        let ways = if joints.is_named(kind) { unit.sides } else { 1 };
        all.entry(unit.sides).or_default().extend((0..ways).map(|first| (kind, first)));
    }
    all
}

/// Fills the tiles, trying at most `tries` choices, of which it takes off those it makes.
pub fn solve(puzzle: &Puzzle, tries: &mut usize) -> Outcome {
    let nothing = Vec::new();
    let options = |tile: &Vec<_>| puzzle.choices.get(&tile.len()).unwrap_or(&nothing).as_slice();
    let options: Vec<&[Choice]> = puzzle.across.iter().map(options).collect();
    let mut search = Search { puzzle, options, tries, dead_end: None };
    let mut open: Vec<Vec<bool>> = search.options.iter().map(|o| vec![true; o.len()]).collect();
    search.strike_those_beside_themselves(&mut open);
    let all: Vec<usize> = (0..open.len()).rev().collect();
    if search.strike_from(&mut open, all) {
        match search.fill(open, 0) {
            Ok(Some(filled)) => return Outcome::Filled(filled),
            Ok(None) => {}
            Err(GivenUp) => return Outcome::GivenUp,
        }
    }
    let nowhere = DeadEnd { tile: 0, beside: Vec::new() };
    Outcome::Impossible(search.dead_end.unwrap_or(nowhere))
}

struct GivenUp;

/// Which choices of each tile are still open.
type Open = Vec<Vec<bool>>;

struct Search<'a> {
    puzzle: &'a Puzzle<'a>,
    options: Vec<&'a [Choice]>,
    tries: &'a mut usize,
    dead_end: Option<DeadEnd>,
}

impl Search<'_> {
    /// Settles the tiles from this one on.
    fn fill(&mut self, open: Open, from: usize) -> Result<Option<Vec<Choice>>, GivenUp> {
        let unsettled = |t: &usize| open[*t].iter().filter(|&&o| o).count() > 1;
        let Some(tile) = (from..open.len()).find(unsettled) else {
            let settled = |(open, options): (&Vec<bool>, &&[Choice])| {
                options.iter().zip(open).find(|o| *o.1).map(|o| *o.0)
            };
            return Ok(open.iter().zip(&self.options).map(settled).collect());
        };
        for choice in (0..open[tile].len()).filter(|&c| open[tile][c]) {
            *self.tries = self.tries.checked_sub(1).ok_or(GivenUp)?;
            let mut tried = open.clone();
            tried[tile].fill(false);
            tried[tile][choice] = true;
            if self.strike_from(&mut tried, vec![tile]) {
                let filled = self.fill(tried, tile + 1)?;
                if filled.is_some() {
                    return Ok(filled);
                }
            }
        }
        Ok(None)
    }

    /// The slot at an edge of a tile when this unit lies there.
    fn slot(&self, (kind, first): Choice, edge: usize) -> usize {
        self.puzzle.joints.slot(kind, first + edge)
    }

    /// Where few tiles repeat, a tile can lie beside itself.
    fn strike_those_beside_themselves(&self, open: &mut Open) {
        for (tile, edges) in self.puzzle.across.iter().enumerate() {
            for (edge, &across) in edges.iter().enumerate() {
                let Some((_, back)) = across.filter(|a| a.0 == tile) else { continue };
                for (is_open, &choice) in open[tile].iter_mut().zip(self.options[tile]) {
                    let [a, b] = [edge, back].map(|e| self.slot(choice, e));
                    *is_open &= self.puzzle.joints.join(a, b).is_some();
                }
            }
        }
    }

    /// Strikes what no longer fits beside these tiles, then beside those where something
    /// was struck, and so on. False when some tile is left with nothing.
    fn strike_from(&mut self, open: &mut Open, mut changed: Vec<usize>) -> bool {
        let puzzle = self.puzzle;
        while let Some(tile) = changed.pop() {
            if !open[tile].contains(&true) {
                self.note(open, tile);
                return false;
            }
            for (edge, &across) in puzzle.across[tile].iter().enumerate() {
                let Some((other, back)) = across.filter(|a| a.0 != tile) else { continue };
                let mut fits = vec![false; puzzle.joints.count()];
                for (_, &choice) in open[tile].iter().zip(self.options[tile]).filter(|o| *o.0) {
                    let slot = self.slot(choice, edge);
                    puzzle.joints.partners(slot).iter().for_each(|&p| fits[p] = true);
                }
                let mut struck = false;
                for (i, &choice) in self.options[other].iter().enumerate() {
                    if open[other][i] && !fits[self.slot(choice, back)] {
                        open[other][i] = false;
                        struck = true;
                    }
                }
                if struck {
                    changed.push(other);
                }
            }
        }
        true
    }

    /// Keeps the dead end that is farthest on.
    fn note(&mut self, open: &Open, tile: usize) {
        if self.dead_end.as_ref().is_some_and(|d| d.tile >= tile) {
            return;
        }
        let settled = |&(other, _): &(usize, usize)| {
            let mut kinds = open[other].iter().zip(self.options[other]).filter(|o| *o.0);
            let kind = kinds.next()?.1.0;
            kinds.all(|o| o.1.0 == kind).then_some(kind)
        };
        let mut beside: Vec<usize> =
            self.puzzle.across[tile].iter().flatten().filter_map(settled).collect();
        beside.sort_unstable();
        beside.dedup();
        self.dead_end = Some(DeadEnd { tile, beside });
    }
}
