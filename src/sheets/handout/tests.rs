//! The handout of real frames.

use super::pictures::{Pictures, example, is_circuit};
use super::*;
use crate::drawing::{Item, Rect, Text};
use crate::sheets::tests::{cut_plan, faults, settings, texts};
use crate::sheets::{Language, Paper, PaperUnits, Texts};
use crate::shop::fixture;
use markdown::Subject;
use std::sync::LazyLock;

static IGLOO: LazyLock<Frame> = LazyLock::new(|| fixture::on_sample("igloo", "4.4.4.4"));

fn in_language(language: Language, paper: Paper, units: PaperUnits) -> SheetSettings {
    let texts = Texts::built_in(language).unwrap();
    SheetSettings { texts, ..settings(paper, units) }
}

fn handout(frame: &Frame, settings: &SheetSettings) -> Vec<Sheet> {
    pages(frame, &cut_plan(frame), "4.4.4.4", settings).unwrap()
}

/// All texts of the pages with a space between them.
fn words(pages: &[Sheet]) -> String {
    let all: Vec<String> =
        pages.iter().flat_map(|s| texts(&s.page.drawing)).map(|t| t.string.clone()).collect();
    all.join(" ")
}

#[test]
fn texts_stay_on_the_page_and_apart_in_every_language() {
    let mut hanging = fixture::circuit(5, 20.0);
    hanging.supports.clear();
    let small = Paper::Custom { width: 145.0, height: 200.0 };
    for language in Language::ALL {
        for frame in [&*IGLOO, &fixture::circuit(5, 8.0), &hanging] {
            for (paper, units) in [
                (Paper::A4, PaperUnits::Mm),
                (Paper::Letter, PaperUnits::Inch),
                (small, PaperUnits::Mm),
            ] {
                let pages = handout(frame, &in_language(language, paper, units));
                let found: Vec<String> = pages.iter().flat_map(faults).collect();
                assert!(found.is_empty(), "{language:?} {paper}: {found:#?}");
            }
        }
    }
}

#[test]
fn it_is_about_this_model() {
    let settings = in_language(Language::En, Paper::A4, PaperUnits::Mm);
    let pages = handout(&IGLOO, &settings);
    assert!((2..=4).contains(&pages.len()), "{} pages", pages.len());
    let said = words(&pages);
    let unit = example(&IGLOO).unwrap();
    let [rods, contacts] = [IGLOO.rods.len(), IGLOO.contacts.len()];
    let format = settings.format();
    for part in [
        format!("The model: {rods} rods"),
        format!("Unit {unit} of this model"),
        format!("for each of the {contacts} contacts"),
        format!("= {:.1}.", 2.0 * contacts as f64 / rods as f64),
        format!("{} high", format.measure(size(&IGLOO)[2])),
    ] {
        assert!(said.contains(&part), "{part} is not in {said}");
    }
    let rod = shown_rod(&IGLOO, Some(unit)).unwrap();
    let in_unit = |mark: &&Mark| IGLOO.units[unit].rods.contains(&mark.partner);
    let marks = marks(&IGLOO, rod);
    let mark = marks.iter().find(in_unit).unwrap();
    let at = format!("mark {} is {} from end A", mark.letter, format.measure(mark.at));
    assert!(said.contains(&at), "{at}");
}

#[test]
fn names_with_signs_of_commonmark_are_printed_as_they_are() {
    let mut settings = in_language(Language::En, Paper::A4, PaperUnits::Mm);
    settings.model = "1. *our*_dome_ <b> `x` ![y](z)".to_owned();
    let said = words(&handout(&IGLOO, &settings));
    assert!(said.contains("1. *our*_dome_ <b> `x` ![y](z): a roof"), "{said}");
}

/// The unit is a circuit inside the frame; each of its rods has its number in the picture.
#[test]
fn the_unit_that_is_shown_is_a_circuit_with_all_its_rods_named() {
    let id = example(&IGLOO).unwrap();
    let unit = &IGLOO.units[id];
    assert!(is_circuit(&IGLOO, unit));
    assert!(unit.rods.iter().all(|&rod| !IGLOO.rods[rod].border));
    let settings = in_language(Language::En, Paper::A4, PaperUnits::Mm);
    let pictures = Pictures { frame: &IGLOO, settings: &settings, unit: Some(id), rod: None };
    let room = Rect::new([10.0, 20.0], [100.0, pictures.height(Subject::Unit, 100.0).unwrap()]);
    let items = pictures.draw(Subject::Unit, room).unwrap();
    let named: Vec<&Text> = items
        .iter()
        .filter_map(|item| match item {
            Item::Text(text) => Some(text),
            Item::Figure(_) => None,
        })
        .collect();
    let mut names: Vec<&str> = named.iter().map(|text| text.string.as_str()).collect();
    let mut rods: Vec<String> = unit.rods.iter().map(RodId::to_string).collect();
    names.sort_unstable();
    rods.sort();
    assert_eq!(names, rods);
    assert!(named.iter().all(|text| room.contains_rect(&text.extent().unwrap())));
}

#[test]
fn people_are_enough_for_the_weight_and_for_the_rim() {
    assert_eq!(people(0.1, 600.0), 2);
    assert_eq!(people(0.1, 12_000.0), 8);
    assert_eq!(people(51.0, 12_000.0), 11);
}

#[test]
fn the_weight_is_that_of_all_rods() {
    let frame = fixture::circuit(4, 10.0);
    let settings = in_language(Language::De, Paper::A4, PaperUnits::Mm);
    let cubic_mm: f64 = frame.rods.iter().map(|r| 78.539_816 * r.axis.length()).sum();
    let expected = settings.format().weight(cubic_mm * 1e-9 * settings.density);
    assert!(expected.starts_with("0,"));
    assert!(words(&handout(&frame, &settings)).contains(&format!("wiegen {expected} kg")));
}
