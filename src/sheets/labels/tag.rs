//! What stands on the label of a rod: its number and an arrow to end A, large; its length;
//! class, diameter, marks and the model's name as far as there is room.

use super::say;
use crate::drawing::font::{CAP_HEIGHT, DESCENT, LEADING, elide, fit_size, text_width};
use crate::drawing::{Color, Draw, DrawingError, Item, Weight};
use crate::frame::Frame;
use crate::ids::RodId;
use crate::sheets::page::SMALLEST;
use crate::sheets::{SheetSettings, TextError};
use crate::shop::{Mark, classes, marks};

/// The number's font size as part of the label's height.
const NUMBER_SHARE: f64 = 0.42;
/// Least and greatest font size of the number, mm: large enough to read from a step away.
const NUMBER: [f64; 2] = [3.8, 8.5];
/// Greatest font size of the length beside the number, as part of the number's, and mm.
const LENGTH: (f64, f64) = (0.6, 5.0);
/// Least font size at which the length stands beside the number, mm; else it goes below.
const LEAST_LENGTH: f64 = 2.6;
/// Between the arrow, its letter and the number, mm.
const GAP: f64 = 0.8;
/// Between the number and the lines below it, mm.
const BELOW: f64 = 1.3;
/// Font sizes of the lines below the number, mm, the best one first.
const SIZES: [f64; 8] = [4.0, 3.6, 3.2, 2.9, 2.7, 2.5, 2.3, SMALLEST];
/// Between two facts on a line.
const DOT: &str = " · ";

/// What is said of a rod, in the papers' format.
pub(super) struct Facts {
    number: String,
    length: String,
    /// The letter, and the word with it.
    class: String,
    class_word: String,
    diameter: String,
    marks: Vec<MarkText>,
    model: String,
}

/// A mark as it stands on a label.
struct MarkText {
    /// Letter and distance from end A.
    short: String,
    /// The same with side, partner and the partner's letter.
    full: String,
}

impl Facts {
    /// Those of all rods, in the order of their numbers.
    ///
    /// # Errors
    /// A text that cannot be put together.
    pub fn of_all(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Self>, TextError> {
        let (format, classes) = (settings.format(), classes(frame));
        let facts = |rod: RodId| {
            let mark = |mark: Mark| {
                let short = format!("{} {}", mark.letter, format.length(mark.at));
                let (side, partner) = (mark.side.letter(), mark.partner);
                let full = format!("{short} {side} {partner} {}", mark.partner_letter);
                MarkText { short, full }
            };
            let class = &classes.of(rod).name;
            Ok(Self {
                number: rod.to_string(),
                length: format.measure(frame.rods[rod].axis.length()),
                class: class.clone(),
                class_word: settings.say(say::Class { class: class.clone() })?,
                diameter: format.diameter(frame.rods[rod].diameters),
                marks: marks(frame, rod).into_iter().map(mark).collect(),
                model: settings.model.clone(),
            })
        };
        frame.rods.ids().map(facts).collect()
    }
}

/// The label in a room of that size, the room's top left corner at the origin.
pub(super) fn tag(facts: &Facts, [width, height]: [f64; 2]) -> Result<Vec<Item>, DrawingError> {
    let mut items = Vec::new();
    let size = (height * NUMBER_SHARE).clamp(NUMBER[0], NUMBER[1]);
    let beside = head(&mut items, facts, size, width)?;
    let top = size * CAP_HEIGHT + BELOW;
    let room = [width, height - top];
    let (size, lines) = below(facts, beside, room)?;
    let first = [0.0, top + size * CAP_HEIGHT];
    items.text_lines(first, size, size * LEADING, Default::default(), lines);
    Ok(items)
}

/// The arrow to end A, the number, and the length at the right if it finds room there.
fn head(items: &mut Vec<Item>, facts: &Facts, size: f64, width: f64) -> Result<bool, DrawingError> {
    let base = size * CAP_HEIGHT;
    let (middle, half) = (base / 2.0, base / 2.0);
    items.polygon([[0.0, middle], [base, middle - half], [base, middle + half]], Color::BLACK);
    let letter = (size * 0.6).max(SMALLEST);
    items.text([base + GAP, middle], letter, "A").bold().vcenter();
    let x = base + 2.0 * GAP + text_width("A", letter, Weight::Bold)? + GAP;
    let size = fit_size(&facts.number, size, Weight::Bold, width - x)?;
    items.text([x, base], size, facts.number.as_str()).bold();
    let room = width - x - text_width(&facts.number, size, Weight::Bold)? - 3.0 * GAP;
    let large = (size * LENGTH.0).clamp(LEAST_LENGTH, LENGTH.1);
    let size = fit_size(&facts.length, large, Weight::Bold, room.max(0.0))?;
    let beside = size >= LEAST_LENGTH;
    if beside {
        items.text([width, base], size, facts.length.as_str()).bold().end();
    }
    Ok(beside)
}

/// How much stands below the number.
struct Level {
    class: Class,
    marks: Marks,
    model: bool,
}

/// What is said of class and diameter.
#[derive(Clone, Copy)]
enum Class {
    /// The word, letter and the diameter.
    Word,
    /// The letter and the diameter.
    Letter,
    /// The letter alone.
    Alone,
    None,
}

/// What is said of the marks.
#[derive(Clone, Copy)]
enum Marks {
    /// Where they are, and with which partners.
    Full,
    /// Where they are.
    Short,
    /// Where the outermost ones are.
    Outermost,
    None,
}

/// From all to least; the first that fits is taken.
const LEVELS: [Level; 10] = [
    Level { class: Class::Word, marks: Marks::Full, model: true },
    Level { class: Class::Word, marks: Marks::Full, model: false },
    Level { class: Class::Word, marks: Marks::Short, model: false },
    Level { class: Class::Letter, marks: Marks::Short, model: false },
    Level { class: Class::Word, marks: Marks::Outermost, model: false },
    Level { class: Class::Letter, marks: Marks::Outermost, model: false },
    Level { class: Class::Word, marks: Marks::None, model: false },
    Level { class: Class::Letter, marks: Marks::None, model: false },
    Level { class: Class::Alone, marks: Marks::None, model: false },
    Level { class: Class::None, marks: Marks::None, model: false },
];

/// The lines below the number and their font size: as much as fits, then as large as fits.
fn below(
    facts: &Facts,
    beside: bool,
    [width, height]: [f64; 2],
) -> Result<(f64, Vec<String>), DrawingError> {
    for level in &LEVELS {
        for size in SIZES {
            let first = first_line(facts, beside, level.class);
            let entries = mark_entries(&facts.marks, level.marks);
            let (Some(mut lines), Some(marks)) =
                (packed(&[first], size, width)?, packed(&entries, size, width)?)
            else {
                continue;
            };
            let others = lines.len() + usize::from(level.model);
            let free = rows(height, size).saturating_sub(others);
            // A line for each mark is found more quickly.
            lines.extend(if entries.len() <= free { entries } else { marks });
            if level.model {
                lines.push(elide(&facts.model, size, Weight::Regular, width)?);
            }
            if lines.len() <= rows(height, size) {
                return Ok((size, lines));
            }
        }
    }
    Ok((SMALLEST, Vec::new()))
}

/// How many lines of a font size fit into a height.
fn rows(height: f64, size: f64) -> usize {
    let one = size * (CAP_HEIGHT + DESCENT);
    // Adding a millionth keeps a height that fits exactly.
    let more = (height - one) / (size * LEADING) + 1e-6;
    if more < 0.0 { 0 } else { more as usize + 1 }
}

/// Length (unless it stands beside the number), class and diameter.
fn first_line(facts: &Facts, beside: bool, class: Class) -> String {
    let Facts { length, class: letter, class_word, diameter, .. } = facts;
    let thick = format!("Ø {diameter}");
    let rest = match class {
        Class::Word => vec![class_word.clone(), thick],
        Class::Letter => vec![letter.clone(), thick],
        Class::Alone => vec![letter.clone()],
        Class::None => Vec::new(),
    };
    let length = if beside { None } else { Some(length.clone()) };
    length.into_iter().chain(rest).collect::<Vec<_>>().join(DOT)
}

fn mark_entries(marks: &[MarkText], which: Marks) -> Vec<String> {
    match (which, marks) {
        (Marks::None, _) | (_, []) => Vec::new(),
        (Marks::Outermost, [first, .., last]) => {
            vec![format!("{} … {}", first.short, last.short)]
        }
        (Marks::Full, all) => all.iter().map(|mark| mark.full.clone()).collect(),
        (Marks::Short | Marks::Outermost, all) => {
            all.iter().map(|mark| mark.short.clone()).collect()
        }
    }
}

/// Entries side by side on as few lines as they need; none if one is too long for a line.
fn packed(entries: &[String], size: f64, width: f64) -> Result<Option<Vec<String>>, DrawingError> {
    let mut lines: Vec<String> = Vec::new();
    for entry in entries {
        if text_width(entry, size, Weight::Regular)? > width {
            return Ok(None);
        }
        let joined = lines.last().map(|line| format!("{line}{DOT}{entry}"));
        match joined {
            Some(joined) if text_width(&joined, size, Weight::Regular)? <= width => {
                lines.pop();
                lines.push(joined);
            }
            _ => lines.push(entry.clone()),
        }
    }
    Ok(Some(lines))
}
