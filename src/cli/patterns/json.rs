//! What is told of patterns, for programs.

use crate::pattern::grammar::Allowed;
use crate::pattern::{Join, Parameter, Pattern, Rule, Stick, UnitKind};
use serde::Serialize;

/// A list of patterns. Angles in degrees, lengths in tile edges.
pub fn patterns(patterns: &[Pattern]) -> String {
    text(&patterns.iter().map(PatternEntry::from).collect::<Vec<_>>())
}

/// What rules make, and which tiling is taken.
pub fn allowed(allowed: &Allowed, kinds: &[UnitKind], takes: Option<&str>) -> String {
    let cycle = |c: &crate::pattern::grammar::Cycle| CycleEntry {
        configuration: c.configuration.clone(),
        units: c.kinds.iter().map(|&k| kinds[k].name.clone()).collect(),
        tiling: c.tiling.map(|t| t.name),
    };
    let unlaid =
        allowed.unlaid.iter().map(|(t, e)| Unlaid { tiling: t.name, reason: e.to_string() });
    text(&AllowedEntry {
        cycles: allowed.cycles.iter().map(cycle).collect(),
        tilings: allowed.tilings.iter().map(|t| t.name).collect(),
        unlaid: unlaid.collect(),
        idle_rules: allowed.idle.iter().map(|i| i + 1).collect(),
        takes,
    })
}

fn text(value: &impl Serialize) -> String {
    let json = serde_json::to_string_pretty(value);
    json.expect("names and figures, no maps: these can always be written") + "\n"
}

#[derive(Serialize)]
struct PatternEntry<'a> {
    name: &'a str,
    summary: &'a str,
    source: &'a str,
    tiling: &'a str,
    turn: ParameterEntry,
    slide: ParameterEntry,
    units: Vec<UnitEntry<'a>>,
    rules: Vec<RuleEntry>,
}

#[derive(Serialize)]
struct ParameterEntry {
    usual: f64,
    safe: [f64; 2],
}

#[derive(Serialize)]
struct UnitEntry<'a> {
    name: &'a str,
    sides: usize,
    mirrored: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    outer: Vec<[[f64; 2]; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    inner: Vec<[[f64; 2]; 2]>,
}

/// As in a pattern file.
#[derive(Serialize)]
struct RuleEntry {
    units: [String; 2],
    join: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reach: Option<usize>,
}

#[derive(Serialize)]
struct AllowedEntry<'a> {
    cycles: Vec<CycleEntry>,
    tilings: Vec<&'static str>,
    unlaid: Vec<Unlaid>,
    idle_rules: Vec<usize>,
    takes: Option<&'a str>,
}

#[derive(Serialize)]
struct CycleEntry {
    configuration: String,
    units: Vec<String>,
    tiling: Option<&'static str>,
}

#[derive(Serialize)]
struct Unlaid {
    tiling: &'static str,
    reason: String,
}

impl<'a> From<&'a Pattern> for PatternEntry<'a> {
    fn from(pattern: &'a Pattern) -> Self {
        Self {
            name: &pattern.name,
            summary: &pattern.summary,
            source: &pattern.source,
            tiling: pattern.tiling.name,
            turn: pattern.turn.into(),
            slide: pattern.slide.into(),
            units: pattern.kinds.iter().map(UnitEntry::from).collect(),
            rules: pattern.rules.iter().map(|r| RuleEntry::new(r, &pattern.kinds)).collect(),
        }
    }
}

impl From<Parameter> for ParameterEntry {
    fn from(Parameter { usual, safe }: Parameter) -> Self {
        Self { usual, safe }
    }
}

impl<'a> From<&'a UnitKind> for UnitEntry<'a> {
    fn from(kind: &'a UnitKind) -> Self {
        let rods = |sticks: &[Stick]| sticks.iter().map(|ends| ends.map(|p| [p.x, p.y])).collect();
        Self {
            name: &kind.name,
            sides: kind.sides,
            mirrored: kind.mirrored,
            radius: kind.radius,
            outer: rods(&kind.outer),
            inner: rods(&kind.inner),
        }
    }
}

impl RuleEntry {
    fn new(rule: &Rule, kinds: &[UnitKind]) -> Self {
        let (join, reach) = match rule.join {
            Join::Shared => ("shared", None),
            Join::End => ("end", None),
            Join::Rest { reach } => ("rest", Some(reach)),
        };
        let units = rule.slots.map(|slot| {
            let side = slot.side.map_or_else(String::new, |side| format!(".{}", side + 1));
            format!("{}{side}", kinds[slot.kind].name)
        });
        Self { units, join, reach }
    }
}
