//! The patterns that come with the program.

use crate::tiling::UniformTiling;

/// A tiling with the turns of its rods that make a frame.
#[derive(Debug)]
pub struct Pattern {
    /// The vertex configuration.
    pub name: &'static str,
    /// What it looks like, in a few words.
    pub summary: &'static str,
    /// The turn used when none is given, degrees.
    pub turn: f64,
    /// Turns, degrees, between which rods keep clear of rods that they do not
    /// touch. Below, the holes close up; above, rods meet round the tiling's vertices.
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
];

impl Pattern {
    /// The pattern of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        LIBRARY.iter().find(|p| p.name == name)
    }

    /// The tiling that it stands on.
    pub fn tiling(&self) -> &'static UniformTiling {
        UniformTiling::named(self.name)
            .expect("every pattern is named after a tiling: tested below")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pattern_has_its_tiling_and_a_turn_within_its_range() {
        for pattern in LIBRARY {
            assert_eq!(pattern.tiling().name, pattern.name);
            assert!(pattern.turns[0] < pattern.turn && pattern.turn < pattern.turns[1]);
        }
    }
}
