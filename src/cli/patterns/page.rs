//! What is told of patterns, for people.

use crate::cli::page::Page;
use crate::cli::terminal::Terminal;
use crate::pattern::{Join, Parameter, Pattern, Rule, Slot, UnitKind, library};

/// A table of the library.
pub fn list(terminal: &Terminal) -> String {
    let heads = ["Name", "rods", "turn"].map(str::to_owned);
    let rows: Vec<[String; 3]> = library().iter().map(cells).collect();
    let all = || rows.iter().chain([&heads]);
    let wide = [0, 1, 2].map(|i| all().map(|row| row[i].chars().count()).max().unwrap_or(0));
    let start = |row: &[String; 3]| -> String {
        row.iter().zip(wide).map(|(cell, wide)| format!("{cell:<wide$}  ")).collect()
    };
    let mut page = Page::new(terminal);
    page.head(&format!("{}what it looks like", start(&heads)));
    for (pattern, row) in library().iter().zip(&rows) {
        page.broken(&start(row), &pattern.summary);
    }
    page.text
}

/// The name of a pattern, how many rods its units have, and which turns are safe.
fn cells(pattern: &Pattern) -> [String; 3] {
    let rods: Vec<String> = pattern.tiling.polygons().iter().map(usize::to_string).collect();
    let [least, most] = pattern.turn.safe;
    let turns =
        if pattern.turn.is_fixed() { "fixed".into() } else { format!("{least} to {most}°") };
    [pattern.name.clone(), rods.join(" "), turns]
}

/// Everything about a pattern.
pub fn about(pattern: &Pattern, terminal: &Terminal) -> String {
    let mut page = Page::new(terminal);
    page.head(&pattern.name);
    let figures = [
        ("looks like", pattern.summary.clone()),
        ("source", pattern.source.clone()),
        ("tiling", pattern.tiling.name.to_owned()),
        ("turn", turn(pattern.turn)),
        ("slide", figure(pattern.slide, " tile edges")),
    ];
    for (label, text) in figures.iter().filter(|(_, text)| !text.is_empty()) {
        page.broken(&format!("  {label:<12}  "), text);
    }
    let wide = pattern.kinds.iter().map(|k| k.name.chars().count()).max().unwrap_or(0).max(12);
    page.head("Units");
    for kind in &pattern.kinds {
        page.broken(&format!("  {:<wide$}  ", kind.name), &unit(kind));
    }
    page.head("Rules");
    for (i, rule) in pattern.rules.iter().enumerate() {
        page.broken(&format!("  {:<2}  ", i + 1), &rule_in_words(rule, &pattern.kinds));
    }
    page.text
}

fn turn(turn: Parameter) -> String {
    if turn.is_fixed() {
        "fixed by the radius of the units, either way round".into()
    } else {
        format!("{}, either way round", figure(turn, "°"))
    }
}

/// A figure and where it is safe.
fn figure(figure: Parameter, unit: &str) -> String {
    let Parameter { usual, safe: [least, most] } = figure;
    if figure.is_fixed() {
        return format!("{usual}{unit}");
    }
    format!("{usual}{unit}, safe from {least} to {most}{unit}")
}

fn unit(kind: &UnitKind) -> String {
    let mut text = format!("{} rods", kind.sides);
    if kind.mirrored {
        text += ", mirrored";
    }
    if let Some(radius) = kind.radius {
        text += &format!(", hole {radius} of its tile");
    }
    if !kind.outer.is_empty() {
        text += ", drawn by hand";
    }
    match kind.inner.len() {
        0 => {}
        n => text += &format!(", {n} more within"),
    }
    text
}

/// A rule in a sentence.
pub fn rule_in_words(rule: &Rule, kinds: &[UnitKind]) -> String {
    let [a, b] = rule.slots.map(|Slot { kind, side }| match side {
        Some(side) => format!("side {} of {}", side + 1, kinds[kind].name),
        None => kinds[kind].name.clone(),
    });
    let join = match rule.join {
        Join::Shared => "one rod serves both".into(),
        Join::End => "each has a rod of its own, and the two end where they meet".into(),
        Join::Rest { reach: 1 } => {
            "each has a rod of its own, which rests on the first rod of the other".into()
        }
        Join::Rest { reach } => format!(
            "each has a rod of its own, which goes on to rod {reach} of the other and rests there"
        ),
    };
    format!("{a} meets {b}: {join}")
}
