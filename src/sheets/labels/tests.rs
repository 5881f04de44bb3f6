//! Labels of made frames and real ones, on every kind of sheet.

use super::*;
use crate::drawing::{Item, Text, Weight, bounds};
use crate::frame::Rod;
use crate::ids::{Id, RodId};
use crate::sheets::page::SMALLEST;
use crate::sheets::{Language, Paper, PaperUnits, Texts};
use crate::shop::{fixture, marks};
use clap::ValueEnum;

fn settings(paper: Paper, units: PaperUnits) -> SheetSettings {
    let model = "a model of a rather long name that no label holds in full".to_owned();
    let texts = Texts::built_in(Language::En).unwrap();
    SheetSettings {
        model,
        paper,
        units,
        density: 600.0,
        sawn: Default::default(),
        notes: Vec::new(),
        texts,
    }
}

/// Frames with short and long numbers, lengths and diameters.
fn frames() -> Vec<Frame> {
    let mut odd = fixture::circuit(7, 3.0);
    for (i, rod) in odd.rods.ids().enumerate() {
        odd.rods[rod].diameters = [12.5, 10.0 + i as f64];
        odd.rods[rod].axis = odd.rods[rod].axis.between(0.0, 12_345.6 + i as f64);
    }
    let mut many = fixture::circuit(5, 3.0);
    let lone = Rod { contacts: Vec::new(), ..many.rods[RodId::new(0)].clone() };
    while many.rods.len() < 1100 {
        many.rods.push(lone.clone());
    }
    vec![fixture::on_sample("igloo", "4.4.4.4"), many, odd]
}

fn printed(frame: &Frame, medium: LabelMedium, used: usize, units: PaperUnits) -> Vec<Sheet> {
    labels(frame, LabelSettings { medium, used }, &settings(Paper::A4, units)).unwrap()
}

fn grid_of(medium: LabelMedium, settings: &SheetSettings) -> LabelGrid {
    medium.grid().unwrap_or_else(|| strips(area(settings), settings.paper))
}

fn texts(sheet: &Sheet) -> impl Iterator<Item = &Text> {
    sheet.page.drawing.items().filter_map(|item| match item {
        Item::Text(text) => Some(text),
        Item::Figure(_) => None,
    })
}

/// Everything on a sheet lies in the safe part of some label, but for the frame and the cut
/// lines of strips, which is told by the caller.
fn assert_within_labels(sheet: &Sheet, grid: &LabelGrid, skip: impl Fn(&Item) -> bool) {
    // Deep letters and rounding.
    let safe: Vec<Rect> = (0..grid.labels()).map(|i| grid.rect(i).inset(SAFE - 1e-6)).collect();
    for item in sheet.page.drawing.items().filter(|item| !skip(item)) {
        let extent = match item {
            Item::Text(text) => {
                assert!(text.size >= SMALLEST - 1e-9, "{:?} is too small", text.string);
                text.extent().unwrap()
            }
            figure => bounds([figure]).unwrap(),
        };
        let inside = safe.iter().any(|label| label.contains_rect(&extent));
        assert!(inside, "{}: {item:?} leaves its label", sheet.stem);
    }
}

fn assert_apart(sheet: &Sheet) {
    let boxes: Vec<(&str, Rect)> = texts(sheet)
        .map(|t| {
            // Figures and capitals, as bold texts have them, stay above the line.
            let extent = t.extent().unwrap();
            let deep =
                if t.weight == Weight::Bold { t.at[1] } else { extent.max[1] - 0.1 * t.size };
            (t.string.as_str(), Rect { max: [extent.max[0], deep], ..extent })
        })
        .collect();
    for (i, (a, rect)) in boxes.iter().enumerate() {
        for (b, other) in &boxes[..i] {
            assert!(!rect.overlaps(other), "{}: {a:?} lies on {b:?}", sheet.stem);
        }
    }
}

#[test]
fn nothing_leaves_the_safe_part_of_its_label() {
    for frame in frames() {
        for &medium in LabelMedium::value_variants() {
            for units in [PaperUnits::Mm, PaperUnits::Inch] {
                let settings = settings(Paper::A4, units);
                let grid = grid_of(medium, &settings);
                let sheets = printed(&frame, medium, 0, units);
                // The first ones, and those with the longest numbers.
                for sheet in sheets.iter().take(3).chain(sheets.last()) {
                    let top = grid.origin[1];
                    let is_frame = |item: &Item| {
                        let at = bounds([item]).unwrap();
                        let line = at.width() == 0.0 || at.height() == 0.0;
                        medium == LabelMedium::Strips
                            && (at.max[1] < top || matches!(item, Item::Figure(_)) && line)
                    };
                    assert_within_labels(sheet, &grid, is_frame);
                    assert_apart(sheet);
                }
            }
        }
    }
}

#[test]
fn every_rod_has_one_label_with_number_and_length() {
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    for &medium in LabelMedium::value_variants() {
        let sheets = printed(&frame, medium, 0, PaperUnits::Mm);
        let said: Vec<&str> =
            sheets.iter().flat_map(texts).map(|text| text.string.as_str()).collect();
        let numbers: Vec<String> = frame.rods.ids().map(|rod| rod.to_string()).collect();
        let found: Vec<&str> =
            said.iter().copied().filter(|t| numbers.iter().any(|number| number == t)).collect();
        assert_eq!(found, numbers, "{medium:?}");
        let lengths = said.iter().filter(|t| t.contains(" mm") && !t.starts_with("rod "));
        assert!(lengths.count() >= frame.rods.len(), "{medium:?}");
    }
}

#[test]
fn large_labels_tell_all_marks() {
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    let sheets = printed(&frame, LabelMedium::L7160, 0, PaperUnits::Mm);
    let said: Vec<&str> = sheets.iter().flat_map(texts).map(|t| t.string.as_str()).collect();
    for rod in frame.rods.ids() {
        for mark in marks(&frame, rod) {
            let (letter, at, side) = (mark.letter, mark.at, mark.side.letter());
            let text = format!("{letter} {at:.1} {side} {} {}", mark.partner, mark.partner_letter);
            assert!(said.iter().any(|line| line.contains(&text)), "{rod}: {text}");
        }
    }
}

#[test]
fn words_are_those_of_the_language() {
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    let texts_of = |language| Texts::built_in(language).unwrap();
    for (language, word) in [(Language::En, "class L"), (Language::De, "Klasse L")] {
        let settings =
            SheetSettings { texts: texts_of(language), ..settings(Paper::A4, PaperUnits::Mm) };
        let medium = LabelSettings { medium: LabelMedium::L7160, used: 0 };
        let sheets = labels(&frame, medium, &settings).unwrap();
        assert!(texts(&sheets[0]).any(|text| text.string.starts_with(word)), "{word}");
    }
}

#[test]
fn labels_begin_at_the_first_free_one() {
    let frame = fixture::on_sample("igloo", "4.4.4.4");
    let grid = LabelMedium::L7160.grid().unwrap();
    let sheets = printed(&frame, LabelMedium::L7160, 4, PaperUnits::Mm);
    assert_eq!(sheets.len(), (4 + frame.rods.len()).div_ceil(21));
    let place = |number: &str| {
        let mut all = sheets
            .iter()
            .enumerate()
            .flat_map(|(page, sheet)| texts(sheet).map(move |text| (page, text)));
        let (page, text) = all.find(|(_, text)| text.string == number).unwrap();
        let label = (0..grid.labels()).find(|&i| grid.rect(i).contains(text.at)).unwrap();
        (page, label)
    };
    assert_eq!(place(&RodId::new(1 - 1).to_string()), (0, 4));
    assert_eq!(place(&RodId::new(17 - 1).to_string()), (0, 20));
    assert_eq!(place(&RodId::new(18 - 1).to_string()), (1, 0));
}

#[test]
fn sheets_of_labels_are_of_the_size_they_are_sold_in() {
    let frame = fixture::circuit(5, 3.0);
    for (medium, size) in [
        (LabelMedium::Avery5160, [215.9, 279.4]),
        (LabelMedium::L8658, [210.0, 297.0]),
        (LabelMedium::Strips, [210.0, 297.0]),
    ] {
        let page = &printed(&frame, medium, 0, PaperUnits::Mm)[0].page.drawing;
        assert_eq!([page.width, page.height], size);
    }
}
