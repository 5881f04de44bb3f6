//! The PDF is read back and measured.

use lopdf::content::{Content, Operation};
use lopdf::{Document, Object};

use super::super::{Anchor, Color, Dash, Draw, Drawing, Stroke};
use super::*;

fn info() -> DocumentInfo {
    let language = "de".to_owned();
    DocumentInfo { title: "Hall, 41°".to_owned(), language, ..DocumentInfo::default() }
}

fn read(pages: &[Page]) -> Document {
    let bytes = render(pages, &info()).expect("can be rendered");
    Document::load_mem(&bytes).expect("can be read back")
}

fn operations(file: &Document, page: u32) -> Vec<Operation> {
    let content = file.get_page_content(file.get_pages()[&page]);
    Content::decode(&content).expect("operations").operations
}

fn numbers(operands: &[Object]) -> Vec<f32> {
    operands.iter().map(|o| o.as_float().expect("a number")).collect()
}

/// A name in a dictionary.
fn name<'a>(dict: &'a Dictionary, key: &str) -> &'a str {
    let name = dict.get(key.as_bytes()).and_then(Object::as_name).expect("a name");
    str::from_utf8(name).expect("ASCII")
}

/// Operands of all operations of that name.
fn all(operations: &[Operation], name: &str) -> Vec<Vec<f32>> {
    operations.iter().filter(|o| o.operator == name).map(|o| numbers(&o.operands)).collect()
}

#[test]
fn page_has_the_size_of_its_drawing() {
    let pages = [Drawing::new(210.0, 297.0).into(), Drawing::new(420.0, 297.0).into()];
    let file = read(&pages);
    let sizes: Vec<_> = file
        .page_iter()
        .map(|id| {
            let page = file.get_dictionary(id).expect("a page");
            numbers(page.get(b"MediaBox").and_then(Object::as_array).expect("four numbers"))
        })
        .collect();
    assert_eq!(sizes, [[0.0, 0.0, 595.276, 841.89], [0.0, 0.0, 1190.551, 841.89]]);
}

#[test]
fn rectangle_measures_its_millimetres_in_points() {
    let mut d = Drawing::new(210.0, 297.0);
    d.rect([10.0, 20.0], [100.0, 50.0], Stroke::new(0.25));
    let ops = operations(&read(&[d.into()]), 1);
    let corners = [all(&ops, "m"), all(&ops, "l")].concat();
    assert_eq!(corners.len(), 4);
    let (x, y): (Vec<_>, Vec<_>) = corners.iter().map(|p| (p[0], p[1])).unzip();
    let extent = |v: &[f32]| {
        v.iter().copied().fold(f32::MIN, f32::max) - v.iter().copied().fold(f32::MAX, f32::min)
    };
    assert!((extent(&x) - 283.465).abs() < 2e-3, "{}", extent(&x));
    assert!((extent(&y) - 141.732).abs() < 2e-3, "{}", extent(&y));
    // The upper edge lies 20 mm below the top of the page.
    assert_eq!(corners[0], [28.346, 785.197]);
    assert_eq!(all(&ops, "w"), [[0.709]]);
}

#[test]
fn circle_is_four_cubics_and_dashes_are_in_points() {
    let mut d = Drawing::new(100.0, 100.0);
    d.circle([50.0, 50.0], 10.0, Stroke::new(0.2).dash(Dash::new([2.0, 1.0])).fill(Color::BLUE));
    let ops = operations(&read(&[d.into()]), 1);
    // Once filled, once stroked.
    assert_eq!(all(&ops, "c").len(), 8);
    let dash = ops.iter().find(|o| o.operator == "d").expect("a dash pattern");
    assert_eq!(numbers(dash.operands[0].as_array().expect("lengths")), [5.669, 2.835]);
    assert!(ops.iter().any(|o| o.operator == "f*"), "filled even-odd");
}

#[test]
fn rings_are_filled_together_and_each_outlined_closed() {
    let mut d = Drawing::new(100.0, 100.0);
    let square = |a: f64, b: f64| vec![[a, a], [b, a], [b, b], [a, b]];
    d.area(vec![square(10.0, 90.0), square(20.0, 80.0)], Stroke::new(0.2).fill(Color::GREY));
    let ops = operations(&read(&[d.into()]), 1);
    let names: String = ops.iter().map(|o| &*o.operator).collect::<Vec<_>>().join(" ");
    assert!(names.contains("m l l l m l l l h f*"), "{names}");
    assert!(names.ends_with("m l l l h S m l l l h S"), "{names}");
}

#[test]
fn unchanged_state_is_written_once() {
    let mut d = Drawing::new(100.0, 100.0);
    for i in 0..10 {
        d.line([0.0, f64::from(i)], [9.0, f64::from(i)], Stroke::new(0.2));
    }
    let ops = operations(&read(&[d.into()]), 1);
    assert_eq!((all(&ops, "w").len(), all(&ops, "S").len()), (1, 10));
}

#[test]
fn text_stands_at_its_anchor_and_turns_clockwise() {
    let mut d = Drawing::new(100.0, 100.0);
    d.text([50.0, 40.0], 5.0, "R012").anchor(Anchor::End);
    d.text([50.0, 40.0], 5.0, "R012").rotate(90.0);
    let width = d.text([50.0, 40.0], 5.0, "R012").width().expect("in the font");
    let ops = operations(&read(&[d.into()]), 1);
    let matrices = all(&ops, "Tm");
    assert_eq!(matrices[0], [1.0, 0.0, 0.0, 1.0, pt(50.0 - width).0, pt(60.0).0]);
    assert_eq!(matrices[1], [0.0, -1.0, 1.0, 0.0, pt(50.0).0, pt(60.0).0]);
}

#[test]
fn text_can_be_read_back_and_its_widths_are_exact() {
    let mut d = Drawing::new(100.0, 100.0);
    d.text([10.0, 40.0], 5.0, "Ø 3 ± 0.1 ∠ 41°");
    d.text([10.0, 60.0], 5.0, "R012 → A").bold();
    let file = read(&[d.into()]);
    let text = file.extract_text(&[1]).expect("text");
    assert!(text.contains("Ø 3 ± 0.1 ∠ 41°") && text.contains("R012 → A"), "{text:?}");

    let fonts = file.get_page_fonts(file.get_pages()[&1]).expect("fonts");
    let names: Vec<_> = fonts.values().map(|f| name(f, "BaseFont")).collect();
    assert_eq!(names, ["RODBLD+DejaVuSansCondensed-Bold", "RODREG+DejaVuSansCondensed"]);
    for font in fonts.values() {
        let inner = font.get(b"DescendantFonts").and_then(Object::as_array).expect("one font");
        let inner = inner[0].as_dict().expect("a font");
        let widths = inner.get(b"W").and_then(Object::as_array).expect("widths");
        let widths = numbers(widths[1].as_array().expect("a run"));
        assert!(widths.iter().any(|w| w.fract() != 0.0), "{widths:?}");
    }
}

#[test]
fn only_fonts_in_use_are_embedded() {
    let mut d = Drawing::new(100.0, 100.0);
    d.line([0.0, 0.0], [9.0, 9.0], Stroke::new(0.2));
    let plain = render(&[d.clone().into()], &info()).expect("can be rendered");
    assert!(plain.len() < 3_000, "{} bytes", plain.len());
    d.text([10.0, 40.0], 5.0, "R012");
    let text = render(&[d.into()], &info()).expect("can be rendered");
    assert!(text.len() < 20_000, "{} bytes", text.len());
}

#[test]
fn same_pages_give_the_same_bytes_and_others_another_id() {
    let mut d = Drawing::new(100.0, 100.0);
    d.text([10.0, 40.0], 5.0, "R012").bold();
    d.layer("CUT").circle([50.0, 50.0], 10.0, Stroke::new(0.2));
    let pages = [Page::titled(d.clone(), "One"), d.clone().into(), Page::titled(d, "Two")];
    let bytes = render(&pages, &info()).expect("can be rendered");
    assert_eq!(bytes, render(&pages, &info()).expect("can be rendered"));
    let id = |pages: &[Page]| format!("{:?}", read(pages).trailer.get(b"ID"));
    assert_ne!(id(&pages), id(&pages[..1]));
}

#[test]
fn file_prints_unscaled_and_lists_titles_and_layers() {
    let mut d = Drawing::new(100.0, 100.0);
    d.line([0.0, 0.0], [9.0, 9.0], Stroke::new(0.2));
    d.layer("Größe").line([0.0, 0.0], [9.0, 9.0], Stroke::new(0.2));
    let file = read(&[Page::titled(d.clone(), "Cover"), Page::titled(d, "Parts")]);
    let catalog = file.catalog().expect("a catalog");
    let preferences = catalog.get(b"ViewerPreferences").and_then(Object::as_dict).expect("some");
    assert_eq!(name(preferences, "PrintScaling"), "None");
    assert_eq!(name(catalog, "PageMode"), "UseOutlines");
    let outline = catalog.get(b"Outlines").and_then(Object::as_reference).expect("an outline");
    let count = file.get_dictionary(outline).and_then(|o| o.get(b"Count")?.as_i64());
    assert_eq!(count.expect("a number"), 2);
    let layers = file.objects.values().filter_map(|o| o.as_dict().ok());
    let names: Vec<_> = layers
        .filter(|d| d.has_type(b"OCG"))
        .map(|d| lopdf::decode_text_string(d.get(b"Name").expect("a name")).expect("text"))
        .collect();
    assert_eq!(names, ["Größe", "drawing"]);
    let entry = file.trailer.get(b"Info").and_then(Object::as_reference).expect("an entry");
    let title = file.get_dictionary(entry).and_then(|d| d.get(b"Title")).expect("a title");
    assert_eq!(lopdf::decode_text_string(title).expect("text"), "Hall, 41°");
}

#[test]
fn missing_glyph_is_an_error() {
    let mut d = Drawing::new(100.0, 100.0);
    d.text([10.0, 40.0], 5.0, "猫").bold();
    let error = render(&[d.into()], &info()).expect_err("no such glyph");
    assert!(matches!(error, DrawingError::MissingGlyph { character: '猫', .. }), "{error}");
}

#[test]
fn empty_text_and_empty_shapes_are_left_out() {
    let mut d = Drawing::new(100.0, 100.0);
    d.text([10.0, 40.0], 5.0, "");
    d.polyline([], Stroke::new(0.2));
    d.area(vec![], Color::BLACK);
    d.area(vec![vec![]], Color::BLACK);
    let ops = operations(&read(&[d.into()]), 1);
    assert!(all(&ops, "m").is_empty() && all(&ops, "Tm").is_empty());
}

/// Titles of the entries below an entry, those below them in brackets, and their pages.
fn listed(file: &Document, parent: &Dictionary) -> String {
    let mut shown = Vec::new();
    let mut next = parent.get(b"First").and_then(Object::as_reference).ok();
    while let Some(id) = next {
        let entry = file.get_dictionary(id).expect("an entry");
        let title = lopdf::decode_text_string(entry.get(b"Title").expect("a title")).expect("text");
        let to = entry.get(b"Dest").and_then(Object::as_array).expect("a place");
        let to = to[0].as_reference().expect("a page");
        let page = file.page_iter().position(|p| p == to).expect("a page of the file") + 1;
        let below = listed(file, entry);
        let below = if below.is_empty() { below } else { format!(" ({below})") };
        shown.push(format!("{title} {page}{below}"));
        next = entry.get(b"Next").and_then(Object::as_reference).ok();
    }
    shown.join(", ")
}

#[test]
fn chapters_hold_their_pages_and_pages_have_labels_and_a_language() {
    let page = |title: &str, chapter: Option<&str>, label: Option<&str>| Page {
        chapter: chapter.map(str::to_owned),
        label: label.map(str::to_owned),
        ..Page::titled(Drawing::new(100.0, 100.0), title)
    };
    let cards = Some("Rod cards");
    let pages = [
        page("Cover", None, None),
        page("R001", cards, None),
        page("R011", cards, None),
        page("Größe", None, None),
        page("A1", Some("Tiles"), Some("A1")),
        Drawing::new(100.0, 100.0).into(),
    ];
    let file = read(&pages);
    let catalog = file.catalog().expect("a catalog");
    let outline = catalog.get(b"Outlines").and_then(Object::as_reference).expect("an outline");
    let outline = file.get_dictionary(outline).expect("a dictionary");
    let expected = "Cover 1, Rod cards 2 (R001 2, R011 3), Größe 4, Tiles 5 (A1 5)";
    assert_eq!(listed(&file, outline), expected);
    // Chapters are closed, so that only the entries of the first level count.
    assert_eq!(outline.get(b"Count").and_then(Object::as_i64).expect("a number"), 4);
    let language = lopdf::decode_text_string(catalog.get(b"Lang").expect("one")).expect("text");
    assert_eq!(language, "de");
    let labels = catalog.get(b"PageLabels").and_then(Object::as_dict).expect("labels");
    let labels = labels.get(b"Nums").and_then(Object::as_array).expect("a list");
    let from: Vec<i64> = labels.iter().step_by(2).map(|n| n.as_i64().expect("a page")).collect();
    assert_eq!(from, [0, 4, 5]);
    let label = |i: usize| labels[2 * i + 1].as_dict().expect("a label");
    assert_eq!(name(label(0), "S"), "D");
    assert_eq!(lopdf::decode_text_string(label(1).get(b"P").expect("one")).expect("text"), "A1");
    assert_eq!(label(2).get(b"St").and_then(Object::as_i64).expect("a number"), 6);
}
