//! `assembly.json`: the steps in which a frame is put together.
//!
//! Besides what holds up a check of every step (`rods`, `over`, `under`, `props`,
//! `remove_props`), a step says which `unit` it belongs to, which rods to `lift` for those that go
//! under, which rod `closes` a circuit, the `ties` to be made at once, and `checks`: distances to
//! measure when the rods are in place. Lengths in mm.

use super::figure::rounded;
use super::json::Document;
use super::tables::TableError;
use crate::shop::order::{Assembly, Check, Closing, Lift, MarkName, Prop, Step};
use serde::Serialize;

/// Digits after the point of lengths, mm: only the noise of arithmetic goes.
const DIGITS: i32 = 6;
/// Digits of distances to be measured: a tape shows a tenth.
const MEASURED: i32 = 2;

#[derive(Serialize)]
struct StepEntry {
    /// Counted from one.
    n: usize,
    unit: Option<String>,
    /// In the order in which they are laid.
    rods: Vec<String>,
    over: Vec<String>,
    under: Vec<String>,
    lift: Vec<LiftEntry>,
    closes: Vec<ClosingEntry>,
    ties: Vec<String>,
    props: Vec<PropEntry>,
    remove_props: Vec<String>,
    checks: Vec<CheckEntry>,
}

#[derive(Serialize)]
struct LiftEntry {
    rod: String,
    below: String,
    contact: String,
}

#[derive(Serialize)]
struct ClosingEntry {
    unit: String,
    rod: String,
}

#[derive(Serialize)]
struct PropEntry {
    id: String,
    rod: String,
    /// From end A to where it stands.
    at: f64,
    /// Where it touches the rod from below.
    point: [f64; 3],
    /// From the ground, or in crown order from the table.
    height: f64,
    /// The steps, counted from one, in which it is set and taken away.
    from: usize,
    until: usize,
}

#[derive(Serialize)]
struct CheckEntry {
    from: MarkEntry,
    to: MarkEntry,
    distance: f64,
}

#[derive(Serialize)]
struct MarkEntry {
    rod: String,
    mark: String,
}

/// The text of `assembly.json`.
///
/// # Errors
/// [`TableError`], which no assembly causes.
pub fn assembly_json(assembly: &Assembly) -> Result<String, TableError> {
    let fail = |e: serde_json::Error| TableError { table: "assembly.json", reason: e.to_string() };
    document(assembly).map_err(fail)
}

fn document(assembly: &Assembly) -> Result<String, serde_json::Error> {
    let steps = assembly.steps.iter().enumerate();
    let steps: Vec<StepEntry> = steps.map(|(n, step)| entry(assembly, n, step)).collect();
    let mut document = Document::new();
    document.value("order", assembly.order.code())?;
    document.value("props", &assembly.props())?;
    document.value("most_props", &assembly.most_props())?;
    document.value("lifts", &assembly.lifts())?;
    document.value("missed_props", &names(&assembly.missed))?;
    document.list("steps", &steps)?;
    Ok(document.finish())
}

fn names<T: ToString>(ids: &[T]) -> Vec<String> {
    ids.iter().map(T::to_string).collect()
}

fn entry(assembly: &Assembly, n: usize, step: &Step) -> StepEntry {
    let lift = |l: &Lift| LiftEntry {
        rod: l.rod.to_string(),
        below: l.below.to_string(),
        contact: l.contact.to_string(),
    };
    let closing = |c: &Closing| ClosingEntry { unit: c.unit.to_string(), rod: c.rod.to_string() };
    let prop = |p: &Prop| PropEntry {
        id: p.id.to_string(),
        rod: p.rod.to_string(),
        at: rounded(p.at, DIGITS),
        point: [p.point.x, p.point.y, p.point.z].map(|x| rounded(x, DIGITS)),
        height: rounded(p.height, DIGITS),
        from: n + 1,
        until: assembly.removal(p.id).unwrap_or(assembly.steps.len() - 1) + 1,
    };
    let mark = |m: &MarkName| MarkEntry { rod: m.rod.to_string(), mark: m.mark.clone() };
    let check = |c: &Check| CheckEntry {
        from: mark(&c.marks[0]),
        to: mark(&c.marks[1]),
        distance: rounded(c.distance, MEASURED),
    };
    StepEntry {
        n: n + 1,
        unit: step.unit.map(|unit| unit.to_string()),
        rods: names(&step.rods),
        over: names(&step.over),
        under: names(&step.under),
        lift: step.lifts.iter().map(lift).collect(),
        closes: step.closes.iter().map(closing).collect(),
        ties: names(&step.ties),
        props: step.props.iter().map(prop).collect(),
        remove_props: names(&step.remove_props),
        checks: step.checks.iter().map(check).collect(),
    }
}
