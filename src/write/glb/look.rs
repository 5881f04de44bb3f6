//! What a rod looks like: the material tells how it ends, so that one sees where rods of a
//! frame are to be tied.

use super::super::structure::RodEntry;

/// How a rod ends.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Look {
    /// On the partner at either end: it lies where it is put.
    EndsOver,
    /// Below the partner at either end: both are to be tied.
    EndsUnder,
    /// One end over, one under.
    EndsMixed,
    /// An end of it meets the end of its partner.
    EndsMeet,
    /// It belongs to one unit only; one end may be free.
    Border,
}

impl Look {
    /// That of a rod whose marks, from end A on, are of these sides.
    pub fn of(rod: &RodEntry, sides: impl Iterator<Item = &'static str>) -> Self {
        let sides: Vec<&str> = sides.collect();
        let ends = [sides.first(), sides.last()];
        let is = |end: Option<&&str>, side: &str| end.is_some_and(|&s| s == side);
        match ends {
            _ if rod.border => Self::Border,
            [first, last] if is(first, "end") || is(last, "end") => Self::EndsMeet,
            [first, last] if is(first, "over") && is(last, "over") => Self::EndsOver,
            [first, last] if is(first, "under") && is(last, "under") => Self::EndsUnder,
            _ => Self::EndsMixed,
        }
    }

    /// The material's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::EndsOver => "rods that end over",
            Self::EndsUnder => "rods that end under",
            Self::EndsMixed => "rods that end over and under",
            Self::EndsMeet => "rods that meet end to end",
            Self::Border => "border rods",
        }
    }

    /// Linear RGBA: wood, and colours of the Okabe-Ito palette, lightened, for what is tied.
    pub fn color(self) -> [f32; 4] {
        match self {
            Self::EndsOver => [0.63, 0.41, 0.19, 1.0],
            Self::EndsUnder => [0.05, 0.27, 0.55, 1.0],
            Self::EndsMixed => [0.05, 0.42, 0.25, 1.0],
            Self::EndsMeet => [0.60, 0.25, 0.42, 1.0],
            Self::Border => [0.25, 0.12, 0.05, 1.0],
        }
    }
}
