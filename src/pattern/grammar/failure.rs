//! Why rules make nothing: the walks that were tried, and where each fails.

use super::walk::{End, FULL, TooManyWalks, follow, interior};
use super::{ways, written};
use crate::pattern::UnitKind;
use crate::pattern::joints::{Joints, RulesError};
use std::collections::BTreeSet;
use std::fmt;
use thiserror::Error;

/// Why rules make no tiling at all.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum GrammarError {
    /// They do not fit the units.
    #[error(transparent)]
    Rules(#[from] RulesError),
    /// There are none.
    #[error("there are no rules; a rule says which two units lie side by side")]
    NoRules,
    /// They leave so much open that not all walks can be tried.
    #[error(
        "the rules allow millions of ways round a vertex, more than can be tried. Name the \
         sides that come together, or leave out units"
    )]
    TooManyWalks,
    /// No walk round a vertex closes.
    #[error("{0}")]
    NoCycle(FailedWalks),
}

impl From<TooManyWalks> for GrammarError {
    fn from(_: TooManyWalks) -> Self {
        Self::TooManyWalks
    }
}

/// The walks that were tried, turns and mirror images of one walk once.
#[derive(Clone, PartialEq, Debug)]
pub struct FailedWalks {
    /// The first of them.
    pub shown: Vec<FailedWalk>,
    /// How many more there are.
    pub more: usize,
}

/// A walk round a vertex that does not close.
#[derive(Clone, PartialEq, Debug)]
pub struct FailedWalk {
    /// The units, clockwise.
    pub units: Vec<WalkedUnit>,
    /// Why it goes no further.
    pub end: WalkEnd,
}

/// A unit on a walk.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WalkedUnit {
    /// What it is called.
    pub name: String,
    /// The sides through which it is entered and left, counted from one, where rules tell
    /// its sides apart.
    pub sides: Option<[usize; 2]>,
}

/// Why a walk fails.
#[derive(Clone, PartialEq, Debug)]
pub enum WalkEnd {
    /// The angles pass 360°: degrees without the last unit and with it.
    Past {
        /// Without the last unit.
        without: f64,
        /// With it.
        with: f64,
    },
    /// No rule goes on from the last unit.
    Stuck,
    /// The angles make 360°, but no rule leads back to the first unit.
    Open,
    /// It closes, but the polygons lie round a vertex of no known tiling.
    NoTiling {
        /// The polygons.
        configuration: String,
    },
}

/// As many walks as can be taken in at once.
const SHOWN: usize = 12;

/// The walks of rules none of whose walks closes.
pub(super) fn failed_walks(
    kinds: &[UnitKind],
    joints: &Joints,
) -> Result<FailedWalks, TooManyWalks> {
    let mut all: BTreeSet<Vec<usize>> = BTreeSet::new();
    let mut shown: Vec<FailedWalk> = Vec::new();
    follow(kinds, joints, &mut |path, end| {
        if all.insert(sameness(path, end, joints)) && shown.len() < SHOWN {
            shown.push(FailedWalk::new(path, end, kinds, joints));
        }
    })?;
    Ok(FailedWalks { more: all.len() - shown.len(), shown })
}

/// What two walks have in common that fail alike: for those that find no rule where they
/// end; for others their units, wherever they start, and either way round if no side is
/// named. Walks have at least two units, ends just one slot, so that they differ.
fn sameness(path: &[usize], end: End, joints: &Joints) -> Vec<usize> {
    if end == End::Stuck {
        return path.last().copied().into_iter().collect();
    }
    let plain = path.iter().all(|&slot| !joints.is_named(joints.owner(slot).kind));
    ways(path, plain).min().unwrap_or_default()
}

impl FailedWalk {
    fn new(path: &[usize], end: End, kinds: &[UnitKind], joints: &Joints) -> Self {
        let unit = |&slot: &usize| {
            let owner = joints.owner(slot);
            let kind = &kinds[owner.kind];
            let sides = owner.side.map(|entered| [entered + 1, (entered + 1) % kind.sides + 1]);
            WalkedUnit { name: kind.name.clone(), sides }
        };
        let sizes: Vec<usize> = path.iter().map(|&s| kinds[joints.owner(s).kind].sides).collect();
        let degrees = |sizes: &[usize]| {
            let sum: u32 = sizes.iter().map(|&n| interior(n)).sum();
            f64::from(sum) * 360.0 / f64::from(FULL)
        };
        let end = match end {
            End::Past => {
                WalkEnd::Past { without: degrees(&sizes[..sizes.len() - 1]), with: degrees(&sizes) }
            }
            End::Stuck => WalkEnd::Stuck,
            End::Open => WalkEnd::Open,
            End::Closed => WalkEnd::NoTiling {
                configuration: written(&ways(&sizes, true).min().unwrap_or_default()),
            },
        };
        Self { units: path.iter().map(unit).collect(), end }
    }
}

impl fmt::Display for FailedWalks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "no walk round a vertex closes, so that the rules make no tiling:")?;
        for walk in &self.shown {
            writeln!(f, "  {walk}")?;
        }
        if self.more > 0 {
            writeln!(f, "  and {} more", self.more)?;
        }
        f.write_str("Walks go clockwise from unit to unit. ")?;
        if self.shown.iter().flat_map(|w| &w.units).any(|u| u.sides.is_some()) {
            f.write_str("After a unit stand the sides through which it is entered and left. ")?;
        }
        f.write_str("Add the rule that is missing, or units whose angles make 360° together")
    }
}

/// Units and reason, on one line.
impl fmt::Display for FailedWalk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let units: Vec<String> = self.units.iter().map(WalkedUnit::to_string).collect();
        write!(f, "{}: ", units.join(", "))?;
        let [first, .., last] = &self.units[..] else { return Ok(()) };
        match &self.end {
            WalkEnd::Past { without, with } => {
                let [without, with, past] = [*without, *with, with - 360.0].map(tenths);
                write!(f, "{without}° without the last, {with}° with it, {past}° past 360°")
            }
            WalkEnd::Stuck => write!(f, "no rule goes on from {}", last.side(1)),
            WalkEnd::Open => {
                write!(f, "360°, but no rule joins {} to {}", last.side(1), first.side(0))
            }
            WalkEnd::NoTiling { configuration } => {
                write!(f, "360°, but no tiling has the vertex {configuration}")
            }
        }
    }
}

/// Name and sides, as in `square 1-2`.
impl fmt::Display for WalkedUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)?;
        self.sides.map_or(Ok(()), |[entered, left]| write!(f, " {entered}-{left}"))
    }
}

impl WalkedUnit {
    /// The side through which it is entered (0) or left (1), in words.
    fn side(&self, which: usize) -> String {
        match self.sides {
            Some(sides) => format!("side {} of {}", sides[which], self.name),
            None => self.name.clone(),
        }
    }
}

/// A figure with one decimal, or none if it is whole.
fn tenths(degrees: f64) -> String {
    let text = format!("{degrees:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}
