//! The check of the rules: which tilings they make (paper, section 3.2).
//!
//! Rules make a tiling when walks round a vertex close by them. The polygons of such a
//! walk are the configuration of the vertex; a tiling can be made when all its
//! configurations are among those, and its tiles can be laid out with the units.

mod choice;
mod failure;
mod walk;

#[cfg(test)]
mod tests;

pub use choice::ChoiceError;
pub use failure::{FailedWalk, FailedWalks, GrammarError, WalkEnd, WalkedUnit};

use super::joints::Joints;
use super::layout::{LayoutError, Repeat};
use super::{Rule, UnitKind};
use crate::tiling::{UNIFORM, UniformTiling};
use std::collections::BTreeSet;
use walk::{End, follow};

/// What a set of rules allows.
#[derive(Clone, Debug)]
pub struct Allowed {
    /// The ways to go round a vertex, by their polygons.
    pub cycles: Vec<Cycle>,
    /// The tilings that can be laid, in the order of the table.
    pub tilings: Vec<&'static UniformTiling>,
    /// Tilings whose every vertex can be, but that cannot be laid as a whole.
    pub unlaid: Vec<(&'static UniformTiling, LayoutError)>,
    /// Rules that take no part in any cycle, as indices.
    pub idle: Vec<usize>,
    /// Which numbers of sides may meet at an edge, the smaller one first.
    meetings: BTreeSet<[usize; 2]>,
}

/// Units round a vertex.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Their numbers of sides, as the table writes them, e.g. `3.6.3.6`.
    pub configuration: String,
    /// The units in this order, as indices.
    pub kinds: Vec<usize>,
    /// The tiling all of whose vertices are of this configuration, if there is one.
    pub tiling: Option<&'static UniformTiling>,
}

/// Finds what rules allow.
///
/// # Errors
/// [`GrammarError`] with the walks that were tried, where none closes.
pub fn check(kinds: &[UnitKind], rules: &[Rule]) -> Result<Allowed, GrammarError> {
    let joints = Joints::new(kinds, rules)?;
    if rules.is_empty() {
        return Err(GrammarError::NoRules);
    }
    let known: BTreeSet<Vec<usize>> = UNIFORM.iter().flat_map(|t| t.configurations()).collect();
    let mut found: BTreeSet<Round> = BTreeSet::new();
    let mut used: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut keep = |path: &[usize], end: End| {
        // Each closed walk is seen from all its units: once is enough.
        if end != End::Closed || path.iter().any(|slot| *slot < path[0]) {
            return;
        }
        let round = Round::new(path, kinds, &joints);
        if known.contains(&round.configuration) {
            found.insert(round);
            let entered = path.iter().cycle().skip(1);
            used.extend(path.iter().zip(entered).map(|(&a, &b)| (joints.turned(a, 1), b)));
        }
    };
    follow(kinds, &joints, &mut keep)?;
    if found.is_empty() {
        return Err(GrammarError::NoCycle(failure::failed_walks(kinds, &joints)?));
    }
    let takes_part =
        |r: &Rule| joints.pairs(r).any(|(a, b)| used.contains(&(a, b)) || used.contains(&(b, a)));
    let idle = (0..rules.len()).filter(|&i| !takes_part(&rules[i])).collect();
    let sizes = rules.iter().map(|r| {
        let [a, b] = r.slots.map(|s| kinds[s.kind].sides);
        [a.min(b), a.max(b)]
    });
    let (tilings, unlaid) = tilings(kinds, &joints, &found);
    Ok(Allowed {
        tilings,
        unlaid,
        idle,
        meetings: sizes.collect(),
        cycles: found.into_iter().map(Cycle::from).collect(),
    })
}

/// A cycle in the way of writing that is the least of all its turns and reflections.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Round {
    configuration: Vec<usize>,
    kinds: Vec<usize>,
}

impl Round {
    fn new(path: &[usize], kinds: &[UnitKind], joints: &Joints) -> Self {
        let path = path.iter().map(|&slot| {
            let kind = joints.owner(slot).kind;
            (kinds[kind].sides, kind)
        });
        let path: Vec<(usize, usize)> = path.collect();
        let ways = ways(&path, true).map(|way| {
            let (configuration, kinds) = way.into_iter().unzip();
            Self { configuration, kinds }
        });
        ways.min().expect("a closed walk has units")
    }
}

/// All turns of a cycle, and of its mirror image if asked for.
fn ways<T: Clone>(cycle: &[T], mirror: bool) -> impl Iterator<Item = Vec<T>> + use<'_, T> {
    let n = cycle.len();
    let turned = move |i: usize| (0..n).map(move |k| cycle[(i + k) % n].clone()).collect();
    let mirrored = move |i: usize| (0..n).map(move |k| cycle[(i + n - k) % n].clone()).collect();
    (0..n).map(turned).chain((0..if mirror { n } else { 0 }).map(mirrored))
}

impl From<Round> for Cycle {
    fn from(Round { configuration, kinds }: Round) -> Self {
        let alone = |t: &&UniformTiling| t.configurations().eq([configuration.clone()]);
        let tiling = UNIFORM.iter().find(alone);
        Self { configuration: written(&configuration), kinds, tiling }
    }
}

/// A configuration as the table writes it.
fn written(configuration: &[usize]) -> String {
    configuration.iter().map(usize::to_string).collect::<Vec<_>>().join(".")
}

type Laid = (Vec<&'static UniformTiling>, Vec<(&'static UniformTiling, LayoutError)>);

/// The tilings that have only such vertices: those that can be laid, and the others with
/// the reason.
fn tilings(kinds: &[UnitKind], joints: &Joints, found: &BTreeSet<Round>) -> Laid {
    let has = |c: Vec<usize>| found.iter().any(|round| round.configuration == c);
    let mut sizes = BTreeSet::new();
    // With one unit for each number of sides, and all of its sides alike, polygons that
    // may lie round a vertex may lie side by side everywhere: no need to try.
    let one_way =
        kinds.iter().enumerate().all(|(i, k)| sizes.insert(k.sides) && !joints.is_named(i));
    let (mut laid, mut unlaid) = (Vec::new(), Vec::new());
    for tiling in UNIFORM.iter().filter(|t| t.configurations().all(has)) {
        let tried = if one_way { Ok(()) } else { Repeat::find(kinds, joints, tiling).map(drop) };
        match tried {
            Ok(()) => laid.push(tiling),
            Err(e) => unlaid.push((tiling, e)),
        }
    }
    (laid, unlaid)
}
