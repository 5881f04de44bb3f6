//! Every page, on a made frame and on real ones.

use super::rod_cards::Book;
use super::*;
use crate::drawing::pdf::{DocumentInfo, render};
use crate::drawing::{Dash, Drawing, Figure, Item, Rect, Shape, Text, bounds, crosses};
use crate::ids::{Id, RodId};
use crate::shop::lengths::sticks;
use crate::shop::{OrderSettings, Stock, assembly, feet, fixture, marks, saw};
use std::sync::LazyLock;

mod maps;

static LAID: LazyLock<(Frame, Footprint, Measures)> =
    LazyLock::new(|| fixture::laid_on_sample("igloo", "4.4.4.4", [0.0; 2], 0.3));
static IGLOO: LazyLock<Frame> = LazyLock::new(|| LAID.0.clone());

pub(super) fn settings(paper: Paper, units: PaperUnits) -> SheetSettings {
    let notes = vec!["rodwright build igloo.obj --rod 3mm".to_owned()];
    let texts = Texts::built_in(Language::En).unwrap();
    SheetSettings {
        model: "igloo".to_owned(),
        paper,
        units,
        density: 600.0,
        sawn: BTreeSet::new(),
        notes,
        texts,
    }
}

pub(super) fn cut_plan(frame: &Frame) -> CutPlan {
    let longest = sticks(frame).iter().map(|stick| stick.length).fold(1000.0, f64::max);
    let stock = Stock::plain(&[longest], 1.0);
    saw::plan(&sticks(frame), &stock).unwrap()
}

fn pages_of(frame: &Frame, paper: Paper, units: PaperUnits) -> Vec<Sheet> {
    pages_with(frame, &settings(paper, units))
}

fn pages_with(frame: &Frame, settings: &SheetSettings) -> Vec<Sheet> {
    let assembly = assembly(frame, &[], OrderSettings::default()).unwrap();
    let plan = cut_plan(frame);
    let mut all = sheets(frame, &LAID.2, Some(&LAID.1), &plan, Some(&assembly), settings).unwrap();
    all.extend(support_map::pages(frame, settings).unwrap());
    all
}

pub(super) fn texts(drawing: &Drawing) -> impl Iterator<Item = &Text> {
    drawing.items().filter_map(|item| match item {
        Item::Text(text) => Some(text),
        Item::Figure(_) => None,
    })
}

/// Texts nearer to the paper's edge than the margin, or over one another.
pub(super) fn faults(sheet: &Sheet) -> Vec<String> {
    let drawing = &sheet.page.drawing;
    let inside = drawing.frame().inset(page::MARGIN - 0.01);
    let boxes: Vec<(&Text, Rect)> = texts(drawing)
        .map(|t| {
            let extent = t.extent().unwrap();
            // Letters that reach below the line are few; lines may be that close.
            (t, Rect { max: [extent.max[0], extent.max[1] - 0.1 * t.size], ..extent })
        })
        .collect();
    let mut faults = Vec::new();
    for (i, (text, extent)) in boxes.iter().enumerate() {
        if !inside.contains_rect(extent) {
            faults.push(format!("{}: {:?} leaves the page", sheet.stem, text.string));
        }
        if text.size < page::SMALLEST - 1e-9 {
            faults.push(format!("{}: {:?} is too small", sheet.stem, text.string));
        }
        for (other, rect) in &boxes[..i] {
            if rect.overlaps(extent) {
                let [a, b] = [&text.string, &other.string];
                faults.push(format!("{}: {a:?} lies on {b:?} at {:?}", sheet.stem, text.at));
            }
        }
    }
    faults
}

#[test]
fn texts_stay_on_the_page_and_apart() {
    let circuit = fixture::circuit(5, 8.0);
    let station = fixture::on_sample("train-station", "6.6.6");
    let small = Paper::Custom { width: 145.0, height: 200.0 };
    for frame in [&*IGLOO, &station, &circuit, &maps::huge()] {
        for (paper, units) in [
            (Paper::A4, PaperUnits::Mm),
            (Paper::Letter, PaperUnits::ThirtySeconds),
            (small, PaperUnits::Mm),
        ] {
            for language in Language::ALL {
                let texts = Texts::built_in(language).unwrap();
                let pages = pages_with(frame, &SheetSettings { texts, ..settings(paper, units) });
                let found: Vec<String> = pages.iter().flat_map(faults).collect();
                let (count, name) = (found.len(), language.name());
                assert!(found.is_empty(), "{name} {paper}: {count} faults: {found:#?}");
            }
        }
    }
}

/// Words that every English page has; on German pages there are none of them, and no
/// figure with a point.
#[test]
fn german_papers_are_german() {
    let texts_de = Texts::built_in(Language::De).unwrap();
    let mut notes = settings(Paper::A4, PaperUnits::Mm);
    notes.notes = Vec::new();
    let german = SheetSettings { texts: texts_de.clone(), ..notes };
    let mut pages = pages_with(&IGLOO, &german);
    let medium = labels::LabelSettings { medium: labels::LabelMedium::L7160, used: 0 };
    pages.extend(labels::labels(&IGLOO, medium, &german).unwrap());
    let pairs = histogram_pairs(&LAID.2, &texts_de).unwrap();
    let figures = histograms(&pairs, &texts_de).unwrap();
    let drawings = pages.iter().map(|sheet| &sheet.page.drawing).chain([&figures]);
    let english = [
        "the", "of", "and", "rod", "rods", "page", "cover", "cut", "class", "foot", "feet", "mark",
        "bar", "bars", "unit", "units", "length", "lengths", "is", "are", "from", "to", "ends",
        "passes", "clock", "tile", "with", "all", "view", "contact", "contacts",
    ];
    let mut words = 0;
    for text in drawings.flat_map(texts) {
        // Names of options are English everywhere.
        let said = text.string.replace("--unit", "");
        for word in said.split(|c: char| !c.is_alphanumeric()) {
            let known = english.contains(&word.to_lowercase().as_str());
            assert!(!known, "`{word}` in {:?}", text.string);
            words += 1;
        }
        let point = text
            .string
            .as_bytes()
            .windows(3)
            .any(|w| w[0].is_ascii_digit() && w[1] == b'.' && w[2].is_ascii_digit());
        assert!(!point, "{:?}", text.string);
    }
    assert!(words > 1000);
    let titles: Vec<&str> = pages.iter().filter_map(|s| s.page.title.as_deref()).collect();
    assert!(titles.contains(&"Deckblatt"), "{titles:?}");
}

/// The head of every page says what its lengths are in, and so does the table of figures.
#[test]
fn lengths_in_inches_are_said_to_be_so() {
    let units = [PaperUnits::Inch, PaperUnits::Sixteenths, PaperUnits::ThirtySeconds];
    for (units, word, other) in
        [(PaperUnits::Mm, "mm", "inches")].into_iter().chain(units.map(|u| (u, "inches", "mm")))
    {
        for sheet in pages_of(&IGLOO, Paper::A4, units) {
            let said: Vec<&str> =
                texts(&sheet.page.drawing).map(|text| text.string.as_str()).collect();
            let ends = |what: &str| said.iter().any(|t| t.ends_with(&format!("lengths in {what}")));
            assert!(ends(word) && !ends(other), "{}: {said:?}", sheet.stem);
            assert!(!said.contains(&other), "{}", sheet.stem);
        }
    }
}

/// Bookmarks of the cards name their rods and hang below one entry.
#[test]
fn every_rod_is_in_the_range_of_one_page() {
    let pages = pages_of(&IGLOO, Paper::A4, PaperUnits::Mm);
    let cards: Vec<&Sheet> = pages.iter().filter(|s| s.stem.contains("rod-cards")).collect();
    assert!(cards.len() > 2);
    let mut next = 0;
    for sheet in cards {
        assert_eq!(sheet.page.chapter.as_deref(), Some("Rod cards"));
        let range = sheet.page.title.as_ref().unwrap();
        let (first, last) = range.split_once(" to ").unwrap();
        let ends = [first, last].map(|name| RodId::read(name).unwrap());
        assert_eq!(ends[0], RodId::new(next));
        let shown: Vec<&str> = texts(&sheet.page.drawing)
            .filter(|t| t.size > 7.0)
            .map(|t| t.string.as_str())
            .collect();
        assert_eq!((shown[0], shown[shown.len() - 1]), (first, last));
        next += shown.len();
    }
    assert_eq!(next, IGLOO.rods.len());
}

/// Every class is there once with its number of rods, and its picture is to scale.
#[test]
fn parts_are_drawn_to_one_scale() {
    let mut tapered = IGLOO.clone();
    for rod in tapered.rods.ids() {
        tapered.rods[rod].diameters = [40.0, 30.0];
    }
    for frame in [&*IGLOO, &tapered, &fixture::circuit(5, 8.0)] {
        let settings = settings(Paper::A4, PaperUnits::Mm);
        let leaves = parts::parts(frame, &settings).unwrap();
        let scale: f64 = leaves[0].scale.as_ref().unwrap()[2..].parse().unwrap();
        let rods: Vec<Rect> = leaves
            .iter()
            .flat_map(|leaf| leaf.drawing.items())
            .filter_map(|item| match item {
                Item::Figure(Figure { shape: Shape::Area(_), .. }) => bounds([item]),
                _ => None,
            })
            .collect();
        let classes = crate::shop::classes(frame);
        assert_eq!(rods.len(), classes.len());
        for (rod, class) in rods.iter().zip(&classes) {
            assert!((rod.width() * scale - class.length).abs() < 1e-6);
            let thick = class.diameters[0].max(class.diameters[1]);
            assert!(rod.height() * scale >= thick - 1e-6);
            assert!(thick / scale < 0.5 || (rod.height() * scale - thick).abs() < 1e-6);
        }
        let said: Vec<&str> =
            leaves.iter().flat_map(|l| texts(&l.drawing)).map(|t| t.string.as_str()).collect();
        let counts: usize =
            said.iter().filter_map(|t| t.strip_suffix(" ×")?.parse::<usize>().ok()).sum();
        assert_eq!(counts, frame.rods.len());
    }
}

/// What the rods are and where to stop stands above the bars of every page.
#[test]
fn stops_are_said_again_where_bars_that_are_alike_go_on_the_next_page() {
    let mut frame = fixture::circuit(3, 3.0);
    let rod = crate::frame::Rod { contacts: Vec::new(), ..frame.rods[RodId::new(0)].clone() };
    while frame.rods.len() < 600 {
        frame.rods.push(rod.clone());
    }
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let plan = cut_plan(&frame);
    let leaves = cut_list::cut_list(&frame, &plan, &settings).unwrap();
    let mut pages = 0;
    for leaf in &leaves {
        let bars = texts(&leaf.drawing).find(|t| t.string.starts_with("bar "));
        let Some(bar) = bars else { continue };
        let stops = texts(&leaf.drawing).find(|t| t.string == "stop at");
        assert!(stops.is_some_and(|stop| stop.at[1] < bar.at[1] + 1e-9), "{}", leaf.stem);
        pages += 1;
    }
    assert!(pages >= 2, "{pages} pages");
}

#[test]
fn every_rod_is_on_exactly_one_card() {
    let pages = pages_of(&IGLOO, Paper::A4, PaperUnits::Mm);
    let mut numbers: Vec<&str> = pages
        .iter()
        .filter(|s| s.stem.contains("rod-cards"))
        .flat_map(|s| texts(&s.page.drawing))
        .filter(|t| t.size > 7.0)
        .map(|t| t.string.as_str())
        .collect();
    numbers.sort_by_key(|n| (n.len(), *n));
    let rods: Vec<String> = IGLOO.rods.ids().map(|r| r.to_string()).collect();
    assert_eq!(numbers, rods);
}

/// Places of upright lines of a stroke's width, from left to right.
fn upright_lines(items: &[Item], width: f64) -> Vec<f64> {
    let mut found: Vec<f64> = items
        .iter()
        .filter_map(|item| match item {
            Item::Figure(Figure { shape: Shape::Line(a, b), paint }) => {
                let is_tick = a[0] == b[0] && paint.stroke.is_some_and(|s| s.width == width);
                is_tick.then_some(a[0])
            }
            _ => None,
        })
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn ticks_of_a_strip_are_as_far_apart_as_the_marks() {
    let settings = settings(Paper::A4, PaperUnits::Mm);
    for frame in [&*IGLOO, &fixture::circuit(7, 3.0)] {
        let book = Book::new(frame, &settings, 190.0);
        for rod in frame.rods.ids() {
            let items = book.card(rod).unwrap().items;
            let ticks = upright_lines(&items, legend::OVER_TICK.width);
            let at: Vec<f64> = marks(frame, rod).iter().map(|m| m.at).collect();
            assert_eq!(ticks.len(), at.len());
            let start = items.iter().find_map(|i| match i {
                Item::Figure(Figure { shape: Shape::Area(rings), .. }) => Some(rings[0][0][0]),
                _ => None,
            });
            for (tick, at) in ticks.iter().zip(&at) {
                assert!((tick - start.unwrap() - at).abs() < 1e-9, "{rod}: {tick} {at}");
            }
        }
    }
}

#[test]
fn long_rods_are_broken_but_keep_short_stretches() {
    let mut frame = fixture::circuit(8, 3.0);
    let rod = RodId::new(0);
    frame.rods[rod].axis = frame.rods[rod].axis.between(0.0, 400.0);
    let marks = marks(&frame, rod);
    let strip = strip::Strip::new(400.0, [3.0; 2], &marks, 190.0);
    assert!(strip.is_broken());
    assert!((strip.drawn_length() - (190.0 - 24.0)).abs() < 1e-9);
    let card = Book::new(&frame, &settings(Paper::A4, PaperUnits::Mm), 190.0).card(rod).unwrap();
    let ticks = upright_lines(&card.items, legend::OVER_TICK.width);
    assert!((ticks[1] - ticks[0] - (marks[1].at - marks[0].at)).abs() < 1e-9);
    let says = |part: &str| {
        let has = |i: &Item| matches!(i, Item::Text(t) if t.string.contains(part));
        card.items.iter().any(has)
    };
    assert!(says("strip broken") && says("‹"));
}

/// The igloo with one thicker and one tapered rod: all that is said of them.
#[test]
fn rods_of_other_diameters_are_told_apart_on_every_paper() {
    let mut frame = IGLOO.clone();
    let [thick, tapered] = [frame.supports[0].rod, frame.supports[1].rod];
    frame.rods[thick].diameters = [5.0; 2];
    frame.rods[tapered].diameters = [6.0, 4.0];
    let pages = pages_of(&frame, Paper::A4, PaperUnits::Mm);
    let said: Vec<&str> =
        pages.iter().flat_map(|s| texts(&s.page.drawing)).map(|t| t.string.as_str()).collect();
    let rest = frame.rods.len() - 2;
    for line in [
        "rod Ø 3.0 mm, 5.0 mm, 6.0→4.0 mm".to_owned(),
        format!("{rest} of 3.0 mm, 1 of 5.0 mm, 1 of 6.0→4.0 mm diameter"),
        "mm, Ø 6.0→4.0 mm, round".to_owned(),
    ] {
        assert!(said.iter().any(|text| text.contains(&line)), "{line} is not said");
    }
    for (rod, diameter) in [(thick, "Ø 5.0 mm"), (tapered, "Ø 6.0→4.0 mm")] {
        let card =
            Book::new(&frame, &settings(Paper::A4, PaperUnits::Mm), 190.0).card(rod).unwrap();
        let has = |i: &Item| matches!(i, Item::Text(t) if t.string.contains(diameter));
        assert!(card.items.iter().any(has), "{diameter}");
    }
    let map = support_map::drawing(&frame, &settings(Paper::A4, PaperUnits::Mm)).unwrap();
    let radii: Vec<f64> = map
        .items()
        .filter_map(|i| match i {
            Item::Figure(Figure { shape: Shape::Circle { radius, .. }, .. }) => Some(*radius),
            _ => None,
        })
        .collect();
    let feet: Vec<f64> = feet(&frame).iter().map(|foot| foot.diameter / 2.0).collect();
    assert_eq!((feet[0], feet[1], feet[2]), (2.5, 3.0, 1.5));
    assert_eq!(radii[..feet.len()], feet);
}

#[test]
fn pages_are_named_in_order_and_render() {
    let frame = fixture::circuit(4, 3.0);
    let settings =
        SheetSettings { model: "家 igloo\n".to_owned(), ..settings(Paper::A4, PaperUnits::Mm) };
    let pages = sheets(&frame, &LAID.2, None, &cut_plan(&frame), None, &settings).unwrap();
    let stems: Vec<&str> = pages.iter().map(|s| s.stem.as_str()).collect();
    let expected =
        ["01-cover", "02-figures", "03-parts", "04-cut-list", "05-rod-cards", "06-support-map"];
    assert_eq!(stems, expected);
    let laid = sheets(&frame, &LAID.2, Some(&LAID.1), &cut_plan(&frame), None, &settings).unwrap();
    let stems: Vec<&str> = laid.iter().map(|s| s.stem.as_str()).collect();
    let mut expected = expected.map(|stem| stem[3..].to_owned()).to_vec();
    expected.insert(3, "footprint".to_owned());
    let stems: Vec<&str> = stems.iter().map(|stem| &stem[3..]).collect();
    assert_eq!(stems, expected);
    let pages: Vec<_> = pages.into_iter().map(|s| s.page).collect();
    assert!(render(&pages, &DocumentInfo::default()).is_ok());
    assert!(texts(&pages[1].drawing).any(|t| t.string == "? igloo "));
    assert!(texts(&pages[1].drawing).any(|t| t.string == "page 2/6"));
}

#[test]
fn paper_without_room_is_refused() {
    let frame = fixture::circuit(4, 3.0);
    for size in [[100.0, 300.0], [200.0, f64::NAN]] {
        let [width, height] = size;
        let settings = settings(Paper::Custom { width, height }, PaperUnits::Mm);
        let error = sheets(&frame, &LAID.2, None, &cut_plan(&frame), None, &settings).unwrap_err();
        assert!(error.to_string().contains("too small"), "{error}");
    }
}

/// Writes the pages of the samples to `target/sheets` to be looked at.
#[test]
#[ignore = "writes files to be looked at"]
fn write_samples() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/sheets");
    std::fs::create_dir_all(&folder).unwrap();
    let station = fixture::on_sample("train-station", "3.6.3.6");
    for (name, frame, paper, units) in [
        ("igloo-a4", &*IGLOO, Paper::A4, PaperUnits::Mm),
        ("igloo-letter", &*IGLOO, Paper::Letter, PaperUnits::Inch),
        ("station-a4", &station, Paper::A4, PaperUnits::Mm),
        (
            "circuit-a5",
            &fixture::circuit(5, 12.0),
            Paper::Custom { width: 148.0, height: 210.0 },
            PaperUnits::Mm,
        ),
    ] {
        let pages: Vec<_> = pages_of(frame, paper, units).into_iter().map(|s| s.page).collect();
        let bytes = render(&pages, &DocumentInfo::default()).unwrap();
        std::fs::write(folder.join(format!("{name}.pdf")), bytes).unwrap();
        let map = support_map::drawing(frame, &settings(paper, units)).unwrap();
        let svg = crate::drawing::svg::render(&map).unwrap();
        std::fs::write(folder.join(format!("{name}-map.svg")), svg).unwrap();
    }
}
