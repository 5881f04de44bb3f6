//! The handout: pages for a class that builds the model, round figures and pictures of it.
//!
//! Its text is one CommonMark file for each language, a template as the other texts are. All
//! it says in figures is computed from the model.

pub(in crate::sheets) mod markdown;
mod pictures;
mod setting;

#[cfg(test)]
mod tests;

use super::cover::{self, size};
use super::page::{self, Flow, Sheet};
use super::text::TextError;
use super::text::message::messages;
use super::{Format, SheetError, SheetSettings};
use crate::frame::{Chirality, ContactKind, Frame};
use crate::ids::{RodId, UnitId};
use crate::shop::lengths::{Stick, sticks};
use crate::shop::{CutPlan, Mark, Side, classes, feet, marks};
use pictures::{Pictures, example, is_circuit};

messages! {
    mod say in "handout.md" {
        "handout" => Handout {
            model: String, pattern: String, rods: usize, contacts: usize, units: usize,
            feet: usize, joints: bool,
            width: String, depth: String, height: String, diameter: String, weight: String,
            lengths: usize, shortest: String, longest: String, total: String,
            contacts_a_rod: String, short: bool,
            bars: Vec<String>, cuts: usize, ties: usize, thin: bool, people: usize,
            kilos_each: String, rim_each: String,
            unit: String, sides: usize, unit_rods: String, clockwise: bool, circuit: bool,
            rod: String, rod_length: String, rod_marks: usize, mark: String, mark_at: String,
            over: bool, meets: bool, partner: String, partner_mark: String, partner_at: String,
            foot: String, next_foot: String, chord: String,
            times: usize, large_longest: String, large_diameter: String, large_weight: String,
        }
    }
}

/// Spare ties: one for so many contacts.
const SPARE: usize = 10;
/// Rods up to this diameter, mm, are cut with a fine saw or shears and tied with rubber
/// bands.
const THIN: f64 = 8.0;
/// How much of the weight one pupil lifts, kg: what ten-year-olds lift without harm.
const KILOS_EACH: f64 = 5.0;
/// How much of the rim one pupil holds, mm: as far as arms reach with both hands on rods.
const RIM_EACH: f64 = 1500.0;
/// Cubic metres to the cubic mm.
const CUBIC_M: f64 = 1e-9;
/// How many times larger the model is made in thought.
const TIMES: f64 = 3.0;

/// The pages of the handout. `pattern` is the name of the model's pattern.
///
/// # Errors
/// As [`sheets`](super::sheets).
pub fn pages(
    frame: &Frame,
    plan: &CutPlan,
    pattern: &str,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let settings = settings.checked()?;
    let unit = example(frame);
    let rod = shown_rod(frame, unit);
    let said = values(frame, plan, unit, rod, pattern, &settings)?;
    let text = settings.texts.text(said)?;
    let blocks = markdown::blocks(&text).map_err(|fault| TextError::Render {
        file: "handout.md",
        key: "handout",
        problem: fault.problem,
    })?;
    let pictures = Pictures { frame, settings: &settings, unit, rod };
    let title = settings.say(page::say::HandoutTitle {})?;
    let mut flow = Flow::new(&settings, "handout", &title);
    setting::set(&blocks, &pictures, &mut flow)?;
    page::stamp(flow.finish(None), &settings.format().diameters(frame), &settings)
}

/// The rod of the unit with the most marks, the first of equal ones: its card shows most.
fn shown_rod(frame: &Frame, unit: Option<UnitId>) -> Option<RodId> {
    let rods: Vec<RodId> = match unit {
        Some(unit) => frame.units[unit].rods.clone(),
        None => frame.rods.ids().collect(),
    };
    rods.into_iter().min_by_key(|&rod| (std::cmp::Reverse(frame.rods[rod].contacts.len()), rod))
}

/// All that the text may say, group by group.
fn values(
    frame: &Frame,
    plan: &CutPlan,
    unit: Option<UnitId>,
    rod: Option<RodId>,
    pattern: &str,
    settings: &SheetSettings,
) -> Result<say::Handout, SheetError> {
    let said = say::Handout {
        model: escaped(&settings.model),
        pattern: escaped(pattern),
        bars: cover::bought(plan, settings)?,
        cuts: plan.cuts(),
        ..of_model(frame, settings)
    };
    let said = of_unit(frame, unit, said);
    let said = of_rod(frame, unit, rod, settings.format(), said);
    Ok(measured(frame, settings.format(), said))
}

/// Sizes and numbers of the model, what lifting and tying it takes, and the same model larger.
fn of_model(frame: &Frame, settings: &SheetSettings) -> say::Handout {
    let format = settings.format();
    let sticks = sticks(frame);
    let lengths = || sticks.iter().map(|stick| stick.length);
    let longest = lengths().fold(0.0, f64::max);
    // Of several that are as long, the first.
    let large = sticks.iter().find(|stick| stick.length == longest);
    let large = large.map_or([frame.diameter; 2], |stick| stick.diameters);
    let shortest = lengths().fold(longest, f64::min);
    let kilos = sticks.iter().map(Stick::volume).sum::<f64>() * CUBIC_M * settings.density;
    let [width, depth, height] = size(frame);
    let (rods, contacts) = (frame.rods.len(), frame.contacts.len());
    say::Handout {
        rods,
        contacts,
        units: frame.units.len(),
        feet: frame.supports.len(),
        joints: frame.contacts.iter().any(|c| c.kind != ContactKind::Cross),
        width: format.measure(width),
        depth: format.measure(depth),
        height: format.measure(height),
        diameter: format.diameters(frame),
        weight: format.weight(kilos),
        lengths: classes(frame).len(),
        shortest: format.measure(shortest),
        longest: format.measure(longest),
        total: format.total(lengths().sum()),
        short: longest < width,
        contacts_a_rod: format.fixed(2.0 * contacts as f64 / rods.max(1) as f64, 1),
        ties: contacts + contacts.div_ceil(SPARE),
        thin: frame.thickest() <= THIN,
        people: people(kilos, 2.0 * (width + depth)),
        kilos_each: format.plain(KILOS_EACH),
        rim_each: format.total(RIM_EACH),
        times: TIMES as usize,
        large_longest: format.total(TIMES * longest),
        large_diameter: format.diameter(large.map(|d| TIMES * d)),
        large_weight: format.weight(TIMES.powi(3) * kilos),
        ..say::Handout::default()
    }
}

/// The unit that is shown.
fn of_unit(frame: &Frame, unit: Option<UnitId>, said: say::Handout) -> say::Handout {
    let Some(id) = unit else { return said };
    let unit = &frame.units[id];
    let names: Vec<String> = unit.rods.iter().map(RodId::to_string).collect();
    say::Handout {
        unit: id.to_string(),
        sides: unit.sides,
        unit_rods: names.join(", "),
        clockwise: unit.chirality == Chirality::Clockwise,
        circuit: is_circuit(frame, unit),
        ..said
    }
}

/// The rod whose card is shown, and its first mark for a rod that the picture of the unit
/// shows, too.
fn of_rod(
    frame: &Frame,
    unit: Option<UnitId>,
    rod: Option<RodId>,
    format: Format,
    said: say::Handout,
) -> say::Handout {
    let Some(rod) = rod else { return said };
    let marks = marks(frame, rod);
    let said = say::Handout {
        rod: rod.to_string(),
        rod_length: format.measure(frame.rods[rod].axis.length()),
        rod_marks: marks.len(),
        ..said
    };
    let in_unit =
        |mark: &&Mark| unit.is_some_and(|id| frame.units[id].rods.contains(&mark.partner));
    let Some(mark) = marks.iter().find(in_unit).or(marks.first()) else { return said };
    say::Handout {
        mark: mark.letter.clone(),
        mark_at: format.measure(mark.at),
        over: mark.side == Side::Over,
        meets: matches!(mark.side, Side::Meets(_)),
        partner: mark.partner.to_string(),
        partner_mark: mark.partner_letter.clone(),
        partner_at: format.measure(mark.at_partner),
        ..said
    }
}

/// What to measure when it stands: from the first foot to its neighbour.
fn measured(frame: &Frame, format: Format, said: say::Handout) -> say::Handout {
    let feet = feet(frame);
    let Some((foot, next)) = feet.first().and_then(|foot| Some((foot, foot.next?))) else {
        return said;
    };
    say::Handout {
        foot: foot.rod.to_string(),
        next_foot: next.rod.to_string(),
        chord: format.measure(next.chord),
        ..said
    }
}

/// How many lift a model of so many kg with a rim of so many mm: two at least.
fn people(kilos: f64, rim: f64) -> usize {
    (kilos / KILOS_EACH).max(rim / RIM_EACH).ceil().max(2.0) as usize
}

/// The text so that CommonMark prints it as it is.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_ascii_punctuation() {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
