//! What was found about the statics of a frame, for reading.

use super::page::Page;
use super::terminal::Terminal;
use crate::ids::RodId;
use crate::statics::material::Material;
use crate::statics::study::{Case, Largest, Study};
use crate::surface::Vector3;
use std::path::Path;

/// The page of `rodwright statics`.
pub fn page(study: &Study, folder: &Path, terminal: &Terminal) -> String {
    let mut page = Page::new(terminal);
    page.head(&format!("Statics of {}", folder.display()));
    let taken = &study.question.taken;
    let Material { young, strength, density, .. } = taken.material;
    let material = &study.question.material;
    page.row(
        "rods",
        format!("{material}: E {young} MPa, strength {strength} MPa, {density} kg/m³"),
    );
    if taken.scale != 1.0 {
        page.row("size", format!("{} times as large as built", digits(taken.scale)));
    }
    page.row("contacts", taken.hold.code());
    page.row("feet", feet(study));
    for (i, case) in study.cases.iter().enumerate() {
        page.head(&format!("Case {}", case.combination.name));
        page.row("load", force(&case.load.total(study.model())));
        if let Some(most) = Largest::of(study.stresses(i)) {
            page.row("stress", stress(study, most));
        }
        if let Some(most) = Largest::of(study.moves(i)) {
            page.row("moves", moves(study, most));
        }
        page.row("on the ground", ground(study, case));
    }
    page.row("to be tied", tied(study));
    page.row("written to", folder.display());
    page.text
}

/// What was found, in a line.
pub fn line(study: &Study) -> String {
    let worst = Largest::of(study.worst());
    let moved = Largest::of(study.displacements());
    let parts = [
        worst.map(|worst| stress(study, worst)),
        moved.map(|moved| format!("moves {}", moves(study, moved))),
        Some(format!("{} contacts pull", study.pulls().len())),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

fn stress(study: &Study, most: Largest) -> String {
    let strength = study.question.taken.material.strength;
    let [stress, percent] = [most.value * strength, 100.0 * most.value].map(digits);
    format!("{stress} MPa at most, {percent} % of the strength: {}", place(study, most))
}

fn moves(study: &Study, most: Largest) -> String {
    format!("{} mm at most: {}", digits(most.value), place(study, most))
}

/// A rod and a place on it, mm of the frame as it is built.
fn place(study: &Study, of: Largest) -> String {
    format!("{} {:.1} mm from end A", of.rod, of.at / study.question.taken.scale)
}

fn feet(study: &Study) -> String {
    let taken = &study.question.taken;
    let model = study.model();
    let own = format!("{} {}", study.own_feet, taken.feet.code());
    let added: Vec<String> = model.feet[study.own_feet..]
        .iter()
        .map(|foot| {
            let at = model.from_end_a(foot.rod, foot.node) / taken.scale;
            format!("{} {at:.1} mm from end A", foot.rod)
        })
        .collect();
    match added.len() {
        0 => own,
        n => format!("{own}, and {n} added: {}", added.join("; ")),
    }
}

/// What the ground carries, and the foot that carries most.
fn ground(study: &Study, case: &Case) -> String {
    let on = |i: usize| case.response.reactions[i].fixed_rows::<3>(0).into_owned();
    let all: Vector3 = (0..study.model().feet.len()).map(on).sum();
    let most = |a: (RodId, f64), b: (RodId, f64)| if b.1 > a.1 { b } else { a };
    let feet = study.model().feet.iter().enumerate().map(|(i, f)| (f.rod, on(i).norm()));
    let most = feet
        .reduce(most)
        .map_or(String::new(), |(rod, n)| format!(", most under {rod}: {} N", digits(n)));
    format!("{}{most}", force(&all))
}

/// A force, N; with its parts where it is not upright.
fn force(of: &Vector3) -> String {
    let size = of.norm();
    if of.xy().norm() <= SLANT * size {
        let way = if of.z > 0.0 { "up" } else { "down" };
        return format!("{} N {way}", digits(size));
    }
    let [x, y, z] = [of.x, of.y, of.z].map(digits);
    format!("{} N along ({x}, {y}, {z})", digits(size))
}

/// A force leaves the upright by more than rounding from this part of it on.
const SLANT: f64 = 1e-6;

/// The contacts that pull, the strongest first.
fn tied(study: &Study) -> String {
    let pulls = study.strongest_pulls();
    let names: Vec<String> =
        pulls.iter().take(NAMED).map(|(c, n)| format!("{c} ({} N)", digits(*n))).collect();
    match (pulls.len(), pulls.len().saturating_sub(NAMED)) {
        (0, _) => "nothing: every contact is pressed together".into(),
        (n, 0) => format!("{n} contacts pull: {}", names.join(", ")),
        (n, more) => {
            format!("{n} contacts pull: {} and {more} more (statics.json)", names.join(", "))
        }
    }
}

/// How many contacts a line names before it only counts the rest.
const NAMED: usize = 8;

/// Three significant digits, and no more zeros than need be.
pub fn digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let before = x.abs().log10().floor() as i32 + 1;
    if !(-3..=6).contains(&before) {
        return format!("{x:.2e}");
    }
    let places = (3 - before).max(0) as usize;
    let text = format!("{x:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn figures_have_three_digits() {
        let texts = [0.0, 0.0123456, 1.0, 1.5, -12.34, 123.4, 12345.6, 1e-7].map(digits);
        assert_eq!(texts, ["0", "0.0123", "1", "1.5", "-12.3", "123", "12346", "1.00e-7"]);
    }
}
