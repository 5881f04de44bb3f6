//! Patterns: which units there are, how they connect, and on which tiling (paper,
//! section 3).
//!
//! A pattern is a small file of units and rules ([`Draft`]); those under
//! templates/patterns/ come with the program ([`library`]). Which tilings the rules make
//! is found by [`grammar`], which unit lies on which tile by [`layout`].

mod changes;
mod check;
mod crossing;
mod draft;
mod file;
pub mod grammar;
mod joints;
pub mod layout;
mod library;
mod meeting;
#[cfg(test)]
mod testing;
mod unit;

pub use check::ShapeError;
pub use crossing::{Crossing, inradius};
pub use draft::Draft;
pub use file::PatternError;
pub use joints::{MOST_KINDS, RulesError};
pub use layout::{Layout, LayoutError, Place};
pub use library::library;
pub use meeting::{Figure, Guest, Meeting, Meetings, Member, Unmet};
pub use unit::{FlatUnit, Line};

use crate::tiling::UniformTiling;
use nalgebra::Point2;
use std::path::Path;

/// Units, the rules by which they connect, and the tiling that they make.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// What it is called.
    pub name: String,
    /// What it looks like, in a few words.
    pub summary: String,
    /// Where it comes from.
    pub source: String,
    /// The tiling whose tiles host its units.
    pub tiling: &'static UniformTiling,
    /// Its units.
    pub kinds: Vec<UnitKind>,
    /// How they connect.
    pub rules: Vec<Rule>,
    /// Turn φ of the rods, degrees. Below its safe range the holes close up; above, rods
    /// meet round the tiling's vertices. The mirror image of a safe pattern is safe, too.
    pub turn: Parameter,
    /// Slide q of the rods along the tile edges, in tile edges.
    pub slide: Parameter,
}

/// A figure that the user may set.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Parameter {
    /// The value used when none is given.
    pub usual: f64,
    /// The least and the greatest value with which rods keep clear of rods that they do
    /// not touch.
    pub safe: [f64; 2],
}

impl Parameter {
    /// Whether there is but one value.
    pub fn is_fixed(&self) -> bool {
        let [least, most] = self.safe;
        least == most
    }
}

/// A kind of unit.
#[derive(Clone, PartialEq, Debug)]
pub struct UnitKind {
    /// What rules call it.
    pub name: String,
    /// The number of sides of its tile; it has a rod, a slot, at each.
    pub sides: usize,
    /// Whether it is the mirror image of the unit that turn and slide describe. Of no
    /// account to rods that it shares with its neighbours.
    pub mirrored: bool,
    /// Inradius of its inner polygon as part of that of its tile, where turn and slide
    /// do not say it.
    pub radius: Option<f64>,
    /// Rods drawn by hand, instead of the circuit of turn and slide: one for each slot,
    /// from its outer to its inner end. Empty where there are none.
    pub outer: Vec<Stick>,
    /// More rods within the unit.
    pub inner: Vec<Stick>,
}

/// Units have 3 to 12 rods.
pub const SIDES: std::ops::RangeInclusive<usize> = 3..=12;

/// A rod in the frame of its unit: tile edges long, the origin in the middle, the x axis
/// through the middle of the first edge.
pub type Stick = [Point2<f64>; 2];

/// Which units lie side by side, and how their rods join.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rule {
    /// The two slots that come together.
    pub slots: [Slot; 2],
    /// How.
    pub join: Join,
}

/// A side of a unit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Slot {
    /// The unit, as an index of [`Pattern::kinds`].
    pub kind: usize,
    /// Which of its sides, counter-clockwise; any, where it is not said.
    pub side: Option<usize>,
}

/// How the rods of two neighbours join across a tile edge (paper, Fig. 6).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Join {
    /// They have one rod in common.
    Shared,
    /// Each has a rod of its own; both end at the edge, and meet there.
    End,
    /// Each has a rod of its own, which goes on into the other unit until it has met
    /// `reach` of its rods, and rests on the last of them.
    Rest {
        /// How many rods it meets, 1 or more.
        reach: usize,
    },
}

/// Turn and slide of a pattern's rods.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shape {
    /// Turn φ, radians.
    pub turn: f64,
    /// Slide q, in tile edges.
    pub slide: f64,
}

impl Pattern {
    /// Turn and slide when none are given.
    pub fn usual(&self) -> Shape {
        Shape { turn: self.turn.usual.to_radians(), slide: self.slide.usual }
    }

    /// Whether its tiles can be coloured with two colours, so that those side by side
    /// differ: as many tiles as two colours need lie round every vertex.
    pub fn alternates(&self) -> bool {
        self.tiling.configurations().all(|c| c.len() % 2 == 0)
    }

    /// The pattern of the library with this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        library().iter().find(|p| p.name == name)
    }

    /// Whether a text names a pattern file, by its ending, and not one of the library.
    pub fn is_file(name: &str) -> bool {
        Path::new(name).extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
    }

    /// The names most like one that is not there, the likeliest first: those that begin
    /// with it, as where `-1` was forgotten, then those that take fewest changes.
    pub fn near(name: &str) -> Vec<&'static str> {
        let names = library().iter().map(|p| p.name.as_str()).collect();
        changes::nearest(name, names, SUGGESTIONS)
    }
}

/// How many names are suggested for one that is not there: what fits on a line.
const SUGGESTIONS: usize = 3;
