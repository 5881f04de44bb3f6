//! What is written in a pattern file: `units`, `rules`, and the figures that go with them.

use super::grammar::{ChoiceError, GrammarError};
use super::{Join, Parameter, Rule, SIDES, Slot, Stick, UnitKind};
use nalgebra::{Point2, Rotation2};
use serde::Deserialize;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What is wrong with a pattern file.
#[derive(Error, Debug)]
pub enum PatternError {
    /// The file cannot be read.
    #[error("cannot read {file}: {source}. Check the name of the file")]
    Unreadable { file: PathBuf, source: std::io::Error },
    /// It is not TOML, or has an unknown key.
    #[error("{0}")]
    Toml(#[from] Box<toml::de::Error>),
    /// A unit that cannot be.
    #[error("unit \"{unit}\": {problem}")]
    Unit { unit: String, problem: String },
    /// A rule that cannot be.
    #[error("rule {rule}, {slots}: {problem}")]
    Rule { rule: usize, slots: String, problem: String },
    /// A figure that contradicts itself.
    #[error("{key}: {problem}")]
    Figure { key: &'static str, problem: String },
    /// Rules that make no tiling.
    #[error(transparent)]
    Grammar(#[from] GrammarError),
    /// Rules that do not make the tiling asked for, or several.
    #[error(transparent)]
    Tiling(#[from] ChoiceError),
}

impl PatternError {
    /// Whether the file cannot be read, as opposed to one that is not valid.
    pub fn is_io(&self) -> bool {
        matches!(self, Self::Unreadable { .. })
    }

    /// The message, with the name of the file in front.
    pub fn in_file(&self, file: &Path) -> String {
        if self.is_io() { self.to_string() } else { format!("{}: {self}", file.display()) }
    }
}

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PatternFile {
    pub name: Option<String>,
    pub summary: Option<String>,
    pub source: Option<String>,
    pub tiling: Option<String>,
    turn: Option<ParameterEntry>,
    slide: Option<ParameterEntry>,
    units: Vec<UnitEntry>,
    rules: Vec<RuleEntry>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParameterEntry {
    usual: f64,
    safe: [f64; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct UnitEntry {
    name: String,
    sides: usize,
    #[serde(default)]
    mirrored: bool,
    radius: Option<f64>,
    #[serde(default)]
    outer: Vec<[[f64; 2]; 2]>,
    #[serde(default)]
    inner: Vec<[[f64; 2]; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RuleEntry {
    units: [String; 2],
    join: JoinEntry,
    reach: Option<usize>,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum JoinEntry {
    Shared,
    End,
    Rest,
}

/// Coordinates of rods that should be turned copies of each other agree to this, tile
/// edges: what a person writes in six digits.
const SAME: f64 = 1e-5;

impl PatternFile {
    /// Its units.
    pub fn kinds(&self) -> Result<Vec<UnitKind>, PatternError> {
        let kinds = self.units.iter().map(kind).collect::<Result<Vec<_>, _>>()?;
        distinct(&kinds)?;
        Ok(kinds)
    }

    /// Its rules about these units.
    pub fn rules(&self, kinds: &[UnitKind]) -> Result<Vec<Rule>, PatternError> {
        self.rules.iter().enumerate().map(|(i, entry)| rule(i, entry, kinds)).collect()
    }

    /// Its turn and its slide, where it names them.
    pub fn figures(&self) -> Result<[Option<Parameter>; 2], PatternError> {
        Ok([checked("turn", self.turn)?, checked("slide", self.slide)?])
    }
}

fn checked(
    key: &'static str,
    entry: Option<ParameterEntry>,
) -> Result<Option<Parameter>, PatternError> {
    let Some(ParameterEntry { usual, safe }) = entry else { return Ok(None) };
    let [least, most] = safe;
    if least <= usual && usual <= most && least.is_finite() && most.is_finite() {
        return Ok(Some(Parameter { usual, safe }));
    }
    let problem = format!(
        "the usual value {usual} does not lie between those that are safe, {least} and {most}"
    );
    Err(PatternError::Figure { key, problem })
}

fn kind(entry: &UnitEntry) -> Result<UnitKind, PatternError> {
    let fault = |problem: String| PatternError::Unit { unit: entry.name.clone(), problem };
    if !SIDES.contains(&entry.sides) {
        let problem = format!("{} sides; units have 3 to 12", entry.sides);
        return Err(fault(problem));
    }
    if entry.name.is_empty() || entry.name.contains('.') {
        return Err(fault("its name must have letters, and no dot".into()));
    }
    if let Some(radius) = entry.radius.filter(|r| !(*r > 0.0 && *r < 1.0)) {
        let problem =
            format!("radius {radius}; it is a part of the tile's inradius, between 0 and 1");
        return Err(fault(problem));
    }
    let sticks = |list: &[[[f64; 2]; 2]]| -> Vec<Stick> {
        list.iter().map(|ends| ends.map(Point2::from)).collect()
    };
    let finite = entry.outer.iter().chain(&entry.inner).flatten().flatten().all(|x| x.is_finite());
    if !finite {
        return Err(fault("a coordinate is not a number".into()));
    }
    Ok(UnitKind {
        name: entry.name.clone(),
        sides: entry.sides,
        mirrored: entry.mirrored,
        radius: entry.radius,
        outer: round(sticks(&entry.outer), entry.sides).map_err(fault)?,
        inner: sticks(&entry.inner),
    })
}

/// The outer rods of a unit, one a slot: one that is given is turned round, all that are
/// given must be turned copies of each other.
fn round(given: Vec<Stick>, sides: usize) -> Result<Vec<Stick>, String> {
    let turned = |stick: &Stick, steps: usize| {
        stick.map(|p| Rotation2::new(TAU * steps as f64 / sides as f64) * p)
    };
    match given.len() {
        0 => Ok(given),
        1 => Ok((0..sides).map(|i| turned(&given[0], i)).collect()),
        n if n == sides => {
            let apart = |i: usize| {
                let wanted = turned(&given[0], i);
                (0..2).map(|e| (wanted[e] - given[i][e]).norm()).fold(0.0, f64::max)
            };
            match (1..n).find(|&i| apart(i) > SAME) {
                None => Ok(given),
                Some(i) => Err(format!(
                    "outer rod {} is not the first one turned by {i}/{n} of a full turn: it is \
                     {:.6} tile edges away. Outer rods must be rotationally symmetric; give the \
                     first alone to have the others made",
                    i + 1,
                    apart(i)
                )),
            }
        }
        n => Err(format!("{n} outer rods; give one for each of its {sides} sides, or one alone")),
    }
}

fn distinct(kinds: &[UnitKind]) -> Result<(), PatternError> {
    for (i, kind) in kinds.iter().enumerate() {
        if kinds[..i].iter().any(|other| other.name == kind.name) {
            let problem = "there are two of this name".into();
            return Err(PatternError::Unit { unit: kind.name.clone(), problem });
        }
    }
    Ok(())
}

fn rule(index: usize, entry: &RuleEntry, kinds: &[UnitKind]) -> Result<Rule, PatternError> {
    let fault =
        |problem| PatternError::Rule { rule: index + 1, slots: entry.units.join(" - "), problem };
    let [a, b] = [0, 1].map(|i| slot(&entry.units[i], kinds).map_err(fault));
    let slots = [a?, b?];
    let join = match (entry.join, entry.reach) {
        (JoinEntry::Rest, Some(0)) => {
            return Err(fault("reach is the number of rods met, 1 or more".into()));
        }
        (JoinEntry::Rest, reach) => Join::Rest { reach: reach.unwrap_or(1) },
        (_, Some(_)) => return Err(fault("only rods that rest (join = \"rest\") reach".into())),
        (JoinEntry::Shared, None) => Join::Shared,
        (JoinEntry::End, None) => Join::End,
    };
    Ok(Rule { slots, join })
}

/// A slot as a rule names it: `square`, or `square.1` for its first side.
fn slot(text: &str, kinds: &[UnitKind]) -> Result<Slot, String> {
    let (name, side) = match text.split_once('.') {
        Some((name, side)) => (name, Some(side)),
        None => (text, None),
    };
    let kind = kinds.iter().position(|k| k.name == name).ok_or_else(|| {
        let known: Vec<&str> = kinds.iter().map(|k| k.name.as_str()).collect();
        format!("there is no unit \"{name}\"; there are {}", known.join(", "))
    })?;
    let sides = kinds[kind].sides;
    let numbered = |side: &str| {
        let number = side.parse::<usize>().ok().filter(|n| (1..=sides).contains(n));
        number.ok_or_else(|| format!("\"{text}\": the sides of \"{name}\" are 1 to {sides}"))
    };
    Ok(Slot { kind, side: side.map(numbered).transpose()?.map(|n| n - 1) })
}
