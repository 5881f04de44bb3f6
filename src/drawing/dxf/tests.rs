//! What the files hold, pair by pair.

use super::*;
use crate::drawing::{Draw, Stroke};
use std::collections::BTreeSet;

const PEN: Stroke = Stroke::new(0.2);

/// Group codes and values of a file.
fn pairs(text: &str) -> Vec<(u16, &str)> {
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2), "codes and values come in pairs");
    let pair = |p: &[&'_ str]| p[0].trim().parse::<u16>().expect("a group code");
    lines.chunks(2).map(|p| (pair(p), p[1])).collect()
}

/// The entities in order, each the pairs from its name on.
fn entities(text: &str) -> Vec<Vec<(u16, &str)>> {
    let all = pairs(text);
    let begin = all.iter().position(|p| *p == (2, "ENTITIES")).expect("a section") + 1;
    let end = begin + all[begin..].iter().position(|p| *p == (0, "ENDSEC")).expect("an end");
    let mut found: Vec<Vec<(u16, &str)>> = Vec::new();
    for &pair in &all[begin..end] {
        if pair.0 == 0 {
            found.push(Vec::new());
        }
        found.last_mut().expect("entities begin with their name").push(pair);
    }
    found
}

/// The values of a code.
fn all<'a>(entity: &[(u16, &'a str)], code: u16) -> Vec<&'a str> {
    entity.iter().filter(|p| p.0 == code).map(|p| p.1).collect()
}

fn sample() -> Drawing {
    let mut d = Drawing::new(100.0, 50.0);
    let cut = d.layer("cut");
    cut.line([0.0, 0.0], [10.0, 20.0], PEN);
    cut.rect([1.0, 2.0], [3.0, 4.0], PEN.fill(Color::BLUE));
    cut.polyline([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], PEN.color(Color::VERMILLION));
    d.layer("Marks").circle([20.0, 30.0], 2.5, Color::PURPLE);
    d.text([40.0, 10.0], 4.0, "R012").middle().rotate(-90.0);
    d
}

fn rendered(drawing: &Drawing) -> String {
    render(drawing, [0.0, drawing.height]).expect("can be rendered")
}

#[test]
fn entities_are_written_in_full() {
    let text = rendered(&sample());
    let shown: Vec<String> = entities(&text)
        .iter()
        .map(|e| {
            let own = e.iter().filter(|p| ![5, 330, 100].contains(&p.0));
            own.map(|(code, value)| format!("{code}:{value}")).collect::<Vec<_>>().join(" ")
        })
        .collect();
    insta::assert_snapshot!(shown.join("\n"), @r"
    0:LINE 8:CUT 10:0.0 20:50.0 30:0.0 11:10.0 21:30.0 31:0.0
    0:LWPOLYLINE 8:CUT 90:4 70:1 43:0.0 10:1.0 20:48.0 10:4.0 20:48.0 10:4.0 20:44.0 10:1.0 20:44.0
    0:LWPOLYLINE 8:CUT 62:30 90:3 70:0 43:0.0 10:0.0 20:50.0 10:1.0 20:50.0 10:1.0 20:49.0
    0:CIRCLE 8:MARKS 10:20.0 20:20.0 30:0.0 40:2.5
    0:TEXT 8:MARKS 62:7 10:40.0 20:35.316406 30:0.0 40:2.916 1:R012 50:90.0 72:1 11:40.0 21:40.0 31:0.0
    ");
}

#[test]
fn every_handle_is_given_once_and_every_owner_is_there() {
    let text = rendered(&sample());
    let all = pairs(&text);
    let from = all.iter().position(|p| *p == (2, "CLASSES")).expect("a section");
    let number = |hex: &str| u32::from_str_radix(hex, 16).expect("hexadecimal");
    // Entries of DIMSTYLE alone have theirs at 105; 5 is the handle of all else.
    let handles: Vec<u32> =
        all[from..].iter().filter(|p| p.0 == 5 || p.0 == 105).map(|p| number(p.1)).collect();
    let distinct: BTreeSet<u32> = handles.iter().copied().collect();
    assert_eq!(distinct.len(), handles.len());
    assert!(!distinct.contains(&0));
    for (code, value) in &all[from..] {
        if [330, 340, 350].contains(code) {
            assert!(*value == "0" || distinct.contains(&number(value)), "{code} {value}");
        }
    }
    let seed = all.iter().position(|p| *p == (9, "$HANDSEED")).expect("in the header") + 1;
    assert_eq!(number(all[seed].1), distinct.last().expect("many") + 1);
}

#[test]
fn header_names_units_and_extent() {
    let text = rendered(&sample());
    let all = pairs(&text);
    let after = |name: &str| {
        let at = all.iter().position(|p| *p == (9, name)).expect(name);
        let values = all[at + 1..].iter().take_while(|p| p.0 != 9 && p.0 != 0);
        values.map(|p| p.1).collect::<Vec<_>>()
    };
    assert_eq!(after("$ACADVER"), ["AC1015"]);
    assert_eq!((after("$INSUNITS"), after("$MEASUREMENT")), (vec!["4"], vec!["1"]));
    assert_eq!(after("$EXTMIN"), ["0.0", "17.5", "0.0"]);
    assert_eq!(after("$EXTMAX"), ["40.0", "50.0", "0.0"]);
    let empty = Document::default();
    assert_eq!(empty.extent(), [[0.0; 3]; 2]);
    assert_eq!(pairs(&empty.to_string()).last(), Some(&(0, "EOF")));
}

#[test]
fn same_drawing_gives_the_same_file() {
    assert_eq!(rendered(&sample()), rendered(&sample()));
}

#[test]
fn curves_stray_no_more_than_they_may() {
    let mut d = Drawing::new(100.0, 100.0);
    d.arc([0.0, 0.0], 40.0, 0.0, 90.0, PEN);
    let text = rendered(&d);
    let found = entities(&text);
    let number = |x: &&str| x.parse::<f64>().expect("a number");
    let (x, y): (Vec<f64>, Vec<f64>) =
        all(&found[0], 10).iter().map(number).zip(all(&found[0], 20).iter().map(number)).unzip();
    assert!(x.len() > 10 && all(&found[0], 70) == ["0"]);
    for i in 1..x.len() {
        let middle = ((x[i] + x[i - 1]) / 2.0).hypot(100.0 - (y[i] + y[i - 1]) / 2.0);
        // The cubic itself is off by 0.03 % of the radius.
        assert!((middle - 40.0).abs() < FLATNESS + 0.012, "{middle}");
    }
}

#[test]
fn only_what_can_be_seen_is_written() {
    let mut d = Drawing::new(100.0, 100.0);
    d.line([5.0, 5.0], [5.0, 5.0], PEN);
    d.circle([5.0, 5.0], 0.0, PEN);
    d.rect([0.0, 0.0], [9.0, 9.0], Color::WHITE);
    d.polyline([[1.0, 1.0]], PEN);
    d.text([5.0, 5.0], 4.0, "");
    assert!(entities(&rendered(&d)).is_empty());
    d.polygon([[0.0, 0.0], [0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 0.0]], PEN);
    let text = rendered(&d);
    assert_eq!(all(&entities(&text)[0], 90), ["3"]);
    d.line([f64::NAN, 0.0], [1.0, 1.0], PEN);
    assert!(matches!(render(&d, [0.0, 0.0]), Err(DrawingError::NotFinite { .. })));
}

#[test]
fn holes_are_polylines_of_their_own() {
    let mut d = Drawing::new(100.0, 100.0);
    let square = |a: f64, b: f64| vec![[a, a], [b, a], [b, b], [a, b]];
    d.area(vec![square(0.0, 9.0), square(3.0, 6.0)], PEN);
    let text = rendered(&d);
    let found = entities(&text);
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|e| all(e, 70) == ["1"]));
}

#[test]
fn text_is_ascii_and_holds_no_codes_of_the_format() {
    let mut d = Drawing::new(100.0, 100.0);
    for string in ["Ø 3 · 41°", "90 %", "%%d", "a^b", r"\U+0041"] {
        d.text([5.0, 5.0], 4.0, string);
    }
    let file = rendered(&d);
    assert!(file.is_ascii());
    let strings: Vec<String> =
        entities(&file).iter().flat_map(|e| all(e, 1)).map(str::to_owned).collect();
    let expected =
        [r"\U+00D8 3 \U+00B7 41\U+00B0", "90 %", r"\U+0025\U+0025d", "a^ b", r"\U+005CU+0041"];
    assert_eq!(strings, expected);
}

#[test]
fn layers_have_legal_names_and_one_case() {
    let mut d = Drawing::new(100.0, 100.0);
    for name in ["cut", "CUT", "a/b: <ü>", "", "0"] {
        d.layer(name).circle([5.0, 5.0], 1.0, PEN);
    }
    let text = rendered(&d);
    let on: Vec<&str> = entities(&text).iter().flat_map(|e| all(e, 8)).collect();
    assert_eq!(on, ["CUT", "CUT", "A_B_ ___", "_", "0"]);
    let table = pairs(&text);
    let named = |name: &str| {
        let records = table.windows(2).filter(|w| w[0] == (100, "AcDbLayerTableRecord"));
        records.filter(|w| w[1] == (2, name)).count()
    };
    assert!(["0", "CUT", "A_B_ ___", "_"].into_iter().all(|name| named(name) == 1));
}

#[test]
fn inks_have_the_numbers_of_their_nearest_colours() {
    for (color, number) in [
        (Color::BLACK, 7),
        (Color::BLUE, 5),
        (Color::VERMILLION, 30),
        (Color::GREEN, 3),
        (Color::PURPLE, 6),
        (Color::GREY, 8),
        (Color::rgb(0xFE, 0x01, 0x02), 1),
        (Color::rgb(0x10, 0x10, 0x10), 7),
    ] {
        assert_eq!(color_number(color), number, "{color}");
    }
}
