//! The patterns that come with the program.

use crate::tiling::UniformTiling;

/// A tiling with the turns of its rods that make a frame.
#[derive(Debug)]
pub struct Pattern {
    /// The name of its tiling.
    pub name: &'static str,
    /// What it looks like, in a few words.
    pub summary: &'static str,
    /// The turn used when none is given, degrees.
    pub turn: f64,
    /// Turns, degrees, between which rods keep clear of rods that they do not
    /// touch. Below, the holes close up; above, rods meet round the tiling's vertices.
    /// Tried on a dome in steps of two degrees: no unit is left out, but in patterns with
    /// polygons of eight or twelve sides unless their units are smaller than fitted.
    pub turns: [f64; 2],
}

/// All patterns, in the order in which they are listed.
pub const LIBRARY: &[Pattern] = &[
    Pattern {
        name: "4.4.4.4",
        summary: "squares: four rods a unit, the plainest grid",
        turn: 20.0,
        turns: [8.0, 36.0],
    },
    Pattern {
        name: "3.3.3.3.3.3",
        summary: "triangles: three rods a unit, dense and stiff",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "6.6.6",
        summary: "hexagons: six rods a unit, open and light",
        turn: 25.0,
        turns: [8.0, 45.0],
    },
    Pattern {
        name: "3.6.3.6",
        summary: "triangles between hexagons, like basket work",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.4.6.4",
        summary: "hexagons in rings of squares and triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4",
        summary: "rows of squares between rows of triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.4.3.4",
        summary: "squares turned against each other, triangles between",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.6",
        summary: "hexagons wrapped in triangles, with a twist",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "4.8.8",
        summary: "octagons, a small square at every corner",
        turn: 24.0,
        turns: [12.0, 44.0],
    },
    Pattern {
        name: "3.12.12",
        summary: "large twelve-sided rings, small triangles between",
        turn: 24.0,
        turns: [12.0, 44.0],
    },
    Pattern {
        name: "4.6.12",
        summary: "twelve-sided rings with hexagons and squares between",
        turn: 24.0,
        turns: [12.0, 44.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.3.3.6-1",
        summary: "a field of triangles, hexagons in it in straight ranks",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.3.3.6-2",
        summary: "a field of triangles, few hexagons in it, with a twist",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.3.4.4-1",
        summary: "one row of squares, then two rows of triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.3.4.4-2",
        summary: "one row of squares, then three rows of triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.4.3.4",
        summary: "stars of six triangles, ringed by squares",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.4.12",
        summary: "twelve-sided rings, stars of six triangles and squares between; for thin rods",
        turn: 12.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.3.3+3.3.6.6",
        summary: "stars of six triangles between hexagons",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.3.6+3.3.6.6",
        summary: "rows of hexagons side by side, bands of triangles between",
        turn: 20.0,
        turns: [16.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4+3.3.4.3.4-1",
        summary: "squares single and in pairs, turned against each other, triangles between",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4+3.3.4.3.4-2",
        summary: "squares all in pairs, turned against each other, triangles between",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4+3.4.6.4",
        summary: "hexagons linked by pairs of squares, triangles in fours in the gaps",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4+4.4.4.4-1",
        summary: "two rows of squares, then one row of triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.3.4.4+4.4.4.4-2",
        summary: "three rows of squares, then one row of triangles",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.4.3.4+3.4.6.4",
        summary: "wheels of a hexagon in squares and triangles, triangles between the wheels",
        turn: 20.0,
        turns: [8.0, 24.0],
    },
    Pattern {
        name: "3.3.6.6+3.6.3.6",
        summary: "rows of hexagons that meet at their points, pairs of triangles between",
        turn: 20.0,
        turns: [10.0, 24.0],
    },
    Pattern {
        name: "3.4.3.12+3.12.12",
        summary: "twelve-sided rings in a square grid, a square in triangles at each crossing",
        turn: 22.0,
        turns: [8.0, 28.0],
    },
    Pattern {
        name: "3.4.4.6+3.4.6.4",
        summary: "hexagons linked by threes of squares, more hexagons in the gaps",
        turn: 20.0,
        turns: [8.0, 32.0],
    },
    Pattern {
        name: "3.4.4.6+3.6.3.6-1",
        summary: "rows of basket work, squares between, all rows in line",
        turn: 20.0,
        turns: [8.0, 30.0],
    },
    Pattern {
        name: "3.4.4.6+3.6.3.6-2",
        summary: "rows of basket work, squares between, each row shifted by half",
        turn: 20.0,
        turns: [8.0, 32.0],
    },
    Pattern {
        name: "3.4.6.4+4.6.12",
        summary: "twelve-sided rings in wide lace of hexagons, squares and triangles; for thin rods",
        turn: 16.0,
        turns: [8.0, 28.0],
    },
];

impl Pattern {
    /// The pattern of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        LIBRARY.iter().find(|p| p.name == name)
    }

    /// The names most like one that is not there, the likeliest first: those that begin
    /// with it, as where `-1` was forgotten, then those that take fewest changes.
    pub fn near(name: &str) -> Vec<&'static str> {
        let mut names: Vec<&'static str> = LIBRARY.iter().map(|p| p.name).collect();
        names.sort_by_cached_key(|known| (!known.starts_with(name), changes(name, known)));
        names.truncate(SUGGESTIONS);
        names
    }

    /// The tiling that it stands on.
    pub fn tiling(&self) -> &'static UniformTiling {
        UniformTiling::named(self.name)
            .expect("every pattern is named after a tiling: tested below")
    }
}

/// How many names are suggested for one that is not there: what fits on a line.
const SUGGESTIONS: usize = 3;

/// Letters to insert, remove or replace to make one text of the other (Levenshtein).
fn changes(from: &str, to: &str) -> usize {
    let mut row: Vec<usize> = (0..=to.chars().count()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in to.chars().enumerate() {
            let least = (row[j].min(row[j + 1]) + 1).min(diagonal + usize::from(a != b));
            diagonal = std::mem::replace(&mut row[j + 1], least);
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tiling::UNIFORM;
    use std::collections::BTreeSet;

    #[test]
    fn every_tiling_has_its_pattern_told_apart_by_its_summary() {
        let tilings: BTreeSet<&str> = UNIFORM.iter().map(|t| t.name).collect();
        let patterns: BTreeSet<&str> = LIBRARY.iter().map(|p| p.name).collect();
        let summaries: BTreeSet<&str> = LIBRARY.iter().map(|p| p.summary).collect();
        assert_eq!(patterns, tilings);
        assert_eq!(summaries.len(), LIBRARY.len());
    }

    #[test]
    fn a_slip_of_the_pen_is_seen() {
        assert_eq!(changes("kitten", "sitting"), 3);
        assert_eq!(changes("", "3.6"), 3);
        assert_eq!(Pattern::near("3.6.6.3")[0], "3.6.3.6");
        assert_eq!(Pattern::near("3.3.3.4.4+4.4.4.4")[..2], LIKE_SQUARES);
        assert_eq!(Pattern::near("").len(), SUGGESTIONS);
    }

    const LIKE_SQUARES: [&str; 2] = ["3.3.3.4.4+4.4.4.4-1", "3.3.3.4.4+4.4.4.4-2"];

    #[test]
    fn every_pattern_has_its_tiling_and_a_turn_within_its_range() {
        for pattern in LIBRARY {
            assert_eq!(pattern.tiling().name, pattern.name);
            assert!(pattern.turns[0] < pattern.turn && pattern.turn < pattern.turns[1]);
        }
    }
}
