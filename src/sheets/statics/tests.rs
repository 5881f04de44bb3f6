//! The pages, on frames under loads.

use super::*;
use crate::drawing::pdf::{DocumentInfo, render};
use crate::drawing::{Color, Figure, Item, Rect, Shape, scale_color, svg};
use crate::frame::fixture::on_sample;
use crate::sheets::tests::{faults, settings, texts};
use crate::sheets::view::View;
use crate::sheets::viewer::viewer;
use crate::sheets::{Language, Paper, PaperUnits, Texts};
use crate::shop::{OrderSettings, assembly, classes};
use crate::statics::fixture::{question, studied};
use crate::statics::study::{Question, study};
use crate::write::assembly::assembly_json;
use crate::write::glb::glb;
use crate::write::structure::{Structure, read_structure};
use crate::write::tables;
use std::path::Path;
use std::sync::LazyLock;

static IGLOO: LazyLock<Frame> = LazyLock::new(|| on_sample("igloo", "4.4.4.4"));

fn of(question: Question, frame: &Frame) -> Study {
    study(frame, question).unwrap()
}

fn said(sheets: &[Sheet]) -> String {
    let all = sheets.iter().flat_map(|s| texts(&s.page.drawing)).map(|t| t.string.clone());
    all.collect::<Vec<_>>().join("\n")
}

#[test]
fn texts_stay_on_the_page_and_apart() {
    let small = Paper::Custom { width: 145.0, height: 200.0 };
    let circuit = studied(5, 1.0);
    let igloo = (IGLOO.clone(), of(question(&IGLOO, 10.0), &IGLOO));
    for (frame, study) in [&circuit, &igloo] {
        for (paper, units) in [
            (Paper::A4, PaperUnits::Mm),
            (Paper::Letter, PaperUnits::Inch),
            (small, PaperUnits::Mm),
        ] {
            for language in Language::ALL {
                let texts = Texts::built_in(language).unwrap();
                let settings = SheetSettings { texts, ..settings(paper, units) };
                let sheets = statics_sheets(frame, study, &settings).unwrap();
                let found: Vec<String> = sheets.iter().flat_map(faults).collect();
                assert!(found.is_empty(), "{} {paper}: {found:#?}", language.name());
            }
        }
    }
}

#[test]
fn pages_tell_the_figures_of_the_study() {
    let study = of(question(&IGLOO, 10.0), &IGLOO);
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let said = said(&statics_sheets(&IGLOO, &study, &settings).unwrap());
    let subject = Subject::new(&IGLOO, &study, settings);
    let hottest = subject.by_use()[0];
    let worst = study.worst()[crate::ids::Id::index(hottest)];
    // Places are those of the size studied.
    let place = format!("{hottest} is stressed most");
    assert!(said.contains(&place), "{said}");
    assert!(said.contains(&subject.format().measure(worst.at)), "{said}");
    assert!(said.contains("10 times the size of the model"));
    for name in ["weight", "snow", "all", "pine, E 11000 MPa", "0.100 kN/m²"] {
        assert!(said.contains(name), "{name}: {said}");
    }
    let total = study.cases[2].load.total(study.model()).norm();
    assert!(said.contains(&subject.format().three_digits(total)));
    let (strongest, _) = subject.pulls[0];
    assert!(said.matches(&strongest.to_string()).count() >= 3, "on both pictures and in the table");
}

/// On the place where a rod is stressed most lies the darkest colour, and its end is light.
#[test]
fn the_most_stressed_place_is_darkest() {
    let (frame, study) = studied(6, 1.0);
    let subject = Subject::new(&frame, &study, settings(Paper::A4, PaperUnits::Mm));
    let mut items: Vec<Item> = Vec::new();
    let room = Rect::new([0.0, 0.0], [200.0, 200.0]);
    let layout = View::plan().layout(&subject.frame, room);
    picture::draw(&subject, &View::plan(), &layout, &mut items);
    let color = |c: Color| {
        items.iter().filter_map(move |item| match item {
            Item::Figure(Figure { shape: Shape::Line(a, b), paint }) => {
                (paint.stroke?.color == c).then_some((*a, *b))
            }
            _ => None,
        })
    };
    let hottest = subject.by_use()[0];
    let at = frame.rods[hottest].axis.at(subject.figures[hottest].at);
    let [x, y] = layout.place(View::plan().project(&at));
    let near = |(a, b): ([f64; 2], [f64; 2])| {
        let d = [b[0] - a[0], b[1] - a[1]];
        let t = ((x - a[0]) * d[0] + (y - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
        let t = t.clamp(0.0, 1.0);
        (a[0] + t * d[0] - x).hypot(a[1] + t * d[1] - y)
    };
    let nearest = color(scale_color(1.0)).map(near).fold(f64::INFINITY, f64::min);
    // It may be hidden below the rod that crosses there.
    assert!(nearest < 5.0 * 3.0 / layout.n, "{nearest}");
    let light = color(scale_color(0.0)).count();
    assert!(light >= frame.rods.len(), "free ends: {light}");
}

#[test]
fn a_frame_that_nothing_loads_is_drawn_too() {
    let frame = &*IGLOO;
    let mut asked = question(frame, 1.0);
    asked.points.clear();
    for case in &mut asked.combinations {
        (case.weight, case.area) = (0.0, 0.0);
    }
    let study = of(asked, frame);
    let sheets = statics_sheets(frame, &study, &settings(Paper::A4, PaperUnits::Mm)).unwrap();
    assert!(said(&sheets).contains("nothing loads the frame"));
    assert!(sheets.iter().flat_map(faults).next().is_none());
}

#[test]
fn what_breaks_is_said() {
    let mut asked = question(&IGLOO, 1.0);
    asked.points[0].force *= 1e4;
    let study = of(asked, &IGLOO);
    let sheets = statics_sheets(&IGLOO, &study, &settings(Paper::A4, PaperUnits::Mm)).unwrap();
    let broken = study.worst().iter().filter(|w| w.value > 1.0).count();
    assert!(broken > 1);
    assert!(said(&sheets).contains(&format!("{broken} rods are stressed beyond their strength")));
}

/// Writes pages, viewer and model of a frame for all papers, as output folders to be looked at:
/// `STRUCTURE=OUT/structure.json LOOK=FOLDER cargo nextest run --run-ignored only to_be_looked_at`.
#[test]
#[ignore = "writes files to be looked at"]
fn pages_to_be_looked_at() {
    let folder = std::env::var("LOOK").unwrap();
    let frame = match std::env::var("STRUCTURE") {
        Ok(path) => read_structure(Path::new(&path)).unwrap().to_frame().unwrap(),
        Err(_) => IGLOO.clone(),
    };
    let order =
        (frame.rods.len() < 1000).then(|| assembly(&frame, &[], OrderSettings::default()).unwrap());
    let structure = Structure::from_frame(&frame, &classes(&frame), &[]);
    for (name, paper, units, language, scale) in [
        ("a4", Paper::A4, PaperUnits::Mm, Language::En, 1.0),
        ("letter", Paper::Letter, PaperUnits::Inch, Language::En, 1.0),
        ("de", Paper::A4, PaperUnits::Mm, Language::De, 10.0),
    ] {
        let study = of(question(&frame, scale), &frame);
        let texts = Texts::built_in(language).unwrap();
        let settings = SheetSettings { texts, ..settings(paper, units) };
        let sheets = statics_sheets(&frame, &study, &settings).unwrap();
        let into = Path::new(&folder).join(name);
        std::fs::create_dir_all(into.join("statics")).unwrap();
        let write = |name: &str, bytes: &[u8]| std::fs::write(into.join(name), bytes).unwrap();
        for sheet in &sheets {
            let picture = svg::render(&sheet.page.drawing).unwrap();
            write(&format!("statics/{}.svg", sheet.stem), picture.as_bytes());
        }
        let pages: Vec<_> = sheets.into_iter().map(|sheet| sheet.page).collect();
        write("statics.pdf", &render(&pages, &DocumentInfo::default()).unwrap());
        let page = viewer(&frame, order.as_ref(), Some(&study), &settings).unwrap();
        write("viewer.html", page.as_bytes());
        write("model.glb", &glb(&structure, Some(&study)).unwrap());
        write("rods.csv", &tables::rods(&frame, &classes(&frame), Some(&study)).unwrap());
        write("plain.glb", &glb(&structure, None).unwrap());
        write("plain.csv", &tables::rods(&frame, &classes(&frame), None).unwrap());
        write("structure.json", structure.to_json().unwrap().as_bytes());
        if let Some(order) = &order {
            write("assembly.json", assembly_json(order).unwrap().as_bytes());
        }
    }
}
