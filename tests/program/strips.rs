//! The rod cards of sheets.pdf, read back from the page's own operations and measured: what
//! is printed is what was computed.

use crate::run::{rodwright, sample};
use lopdf::content::{Content, Operation};
use lopdf::{Document, Encoding, Object, ObjectId};
use std::collections::BTreeMap;
use std::path::Path;
use tempfile::tempdir;

/// mm to the point.
const MM: f64 = 25.4 / 72.0;
/// What a strip may be off, mm: a tenth of a pencil line.
const OFF: f64 = 0.05;
/// Font size of a rod's number, and widths of ticks and of a rod's outline, mm.
const NUMBER: f64 = 7.2;
const TICK: f64 = 0.35;
const OUTLINE: f64 = 0.25;

/// A line of text or a stroked path, in mm from the page's lower left corner.
#[derive(Debug)]
enum Mark {
    Text { size: f64, text: String },
    Stroke { width: f64, points: Vec<[f64; 2]> },
}

/// A transform `[a b c d e f]` as PDF writes it.
type Matrix = [f64; 6];
const UNIT: Matrix = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// `first` and then `then`.
fn product(first: Matrix, then: Matrix) -> Matrix {
    let [a, b, c, d, e, f] = first;
    let [g, h, i, j, k, l] = then;
    [
        a * g + b * i,
        a * h + b * j,
        c * g + d * i,
        c * h + d * j,
        e * g + f * i + k,
        e * h + f * j + l,
    ]
}

fn place([a, b, c, d, e, f]: Matrix, [x, y]: [f64; 2]) -> [f64; 2] {
    [(a * x + c * y + e) * MM, (b * x + d * y + f) * MM]
}

/// How much a transform enlarges.
fn scale([a, b, c, d, ..]: Matrix) -> f64 {
    (a * d - b * c).abs().sqrt()
}

fn numbers(operation: &Operation) -> Vec<f64> {
    operation.operands.iter().filter_map(|o| o.as_float().ok()).map(f64::from).collect()
}

fn matrix(operation: &Operation) -> Matrix {
    numbers(operation).try_into().expect("six numbers")
}

/// What stands on a page, in the order in which it is drawn.
struct Reader<'a> {
    encodings: BTreeMap<Vec<u8>, Encoding<'a>>,
    saved: Vec<(Matrix, f64)>,
    transform: Matrix,
    width: f64,
    path: Vec<[f64; 2]>,
    font: Vec<u8>,
    size: f64,
    text_matrix: Matrix,
    marks: Vec<Mark>,
}

impl Reader<'_> {
    fn read(file: &Document, page: ObjectId) -> Vec<Mark> {
        let mut encodings = BTreeMap::new();
        for (name, font) in file.get_page_fonts(page).expect("fonts") {
            encodings.insert(name, font.get_font_encoding(file).expect("an encoding"));
        }
        let mut reader = Reader {
            encodings,
            saved: Vec::new(),
            transform: UNIT,
            width: 1.0,
            path: Vec::new(),
            font: Vec::new(),
            size: 0.0,
            text_matrix: UNIT,
            marks: Vec::new(),
        };
        let content = Content::decode(&file.get_page_content(page)).expect("operations");
        content.operations.iter().for_each(|operation| reader.follow(operation));
        reader.marks
    }

    fn follow(&mut self, operation: &Operation) {
        match operation.operator.as_str() {
            "q" => self.saved.push((self.transform, self.width)),
            "Q" => (self.transform, self.width) = self.saved.pop().expect("as many q as Q"),
            "cm" => self.transform = product(matrix(operation), self.transform),
            "w" => self.width = numbers(operation)[0],
            "m" | "l" => {
                let [x, y] = numbers(operation)[..] else { panic!("{operation:?}") };
                self.path.push(place(self.transform, [x, y]));
            }
            "S" | "s" => {
                let width = self.width * scale(self.transform) * MM;
                let points = std::mem::take(&mut self.path);
                self.marks.push(Mark::Stroke { width, points });
            }
            "f" | "f*" | "n" => self.path.clear(),
            "BT" => self.text_matrix = UNIT,
            "Tf" => {
                self.font = operation.operands[0].as_name().expect("a font").to_vec();
                self.size = f64::from(operation.operands[1].as_float().expect("a size"));
            }
            "Tm" => self.text_matrix = matrix(operation),
            "Tj" | "TJ" => self.text(&operation.operands),
            _ => {}
        }
    }

    fn text(&mut self, operands: &[Object]) {
        let mut text = String::new();
        let encoding = &self.encodings[&self.font];
        let parts = operands.iter().flat_map(|o| match o {
            Object::Array(parts) => parts.iter().collect(),
            one => vec![one],
        });
        for part in parts {
            if let Ok(bytes) = part.as_str() {
                text += &Document::decode_text(encoding, bytes).expect("letters");
            }
        }
        let size = self.size * scale(product(self.text_matrix, self.transform)) * MM;
        self.marks.push(Mark::Text { size, text });
    }
}

/// A rod card as it is printed: texts in the order in which they are drawn, and places on
/// the strip in mm from end A.
#[derive(Debug, Default)]
struct Card {
    number: String,
    texts: Vec<String>,
    length: Option<f64>,
    ticks: Vec<f64>,
}

/// All rod cards of a file, in order.
fn cards(file: &Path) -> Vec<Card> {
    let file = Document::load(file).expect("a PDF file");
    let mut cards: Vec<Card> = Vec::new();
    for page in file.get_pages().into_values() {
        let marks = Reader::read(&file, page);
        let is_card =
            |m: &Mark| matches!(m, Mark::Text { text, .. } if text.starts_with("Rod cards"));
        if !marks.iter().any(is_card) {
            continue;
        }
        let mut end_a = 0.0;
        let mut here: Vec<Card> = Vec::new();
        for mark in marks {
            match (mark, here.last_mut()) {
                (Mark::Text { size, text }, _) if (size - NUMBER).abs() < 0.01 => {
                    here.push(Card { number: text, ..Card::default() });
                }
                (Mark::Text { text, .. }, Some(card)) => card.texts.push(text),
                (Mark::Stroke { width, points }, Some(card)) => {
                    let across = points.iter().map(|p| p[0]);
                    let (left, right) =
                        across.fold((f64::MAX, f64::MIN), |(l, r), x| (l.min(x), r.max(x)));
                    // The rod's outline comes first; others as wide are those of signs.
                    if (width - OUTLINE).abs() < 0.005 && card.length.is_none() {
                        (end_a, card.length) = (left, Some(right - left));
                    } else if (width - TICK).abs() < 0.005 {
                        assert!(right - left < 1e-6, "a tick that leans: {points:?}");
                        card.ticks.push(left - end_a);
                    }
                }
                (_, None) => {}
            }
        }
        cards.append(&mut here);
    }
    for card in &mut cards {
        card.ticks.sort_by(f64::total_cmp);
    }
    cards
}

fn table(file: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(file).expect("a table");
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

/// A contact as contacts.csv tells it of one of its rods.
struct Told {
    at: f64,
    side: &'static str,
    partner: String,
    at_partner: f64,
    angle: f64,
    clock: f64,
}

/// The contacts of every rod, from its end A.
fn told(file: &Path) -> BTreeMap<String, Vec<Told>> {
    let mut all: BTreeMap<String, Vec<Told>> = BTreeMap::new();
    for row in table(file) {
        let figure = |key: &str| row[key].parse::<f64>().expect("a number");
        for (me, side, other) in [("over", "O", "under"), ("under", "U", "over")] {
            let told = Told {
                at: figure(&format!("at_{me}_mm")),
                side,
                partner: row[other].clone(),
                at_partner: figure(&format!("at_{other}_mm")),
                angle: figure("angle_deg"),
                clock: figure(&format!("clock_{me}_deg")),
            };
            all.entry(row[me].clone()).or_default().push(told);
        }
    }
    for marks in all.values_mut() {
        marks.sort_by(|a, b| a.at.total_cmp(&b.at));
    }
    all
}

/// Compares every strip and every line of the cards with the tables; returns how many
/// strips are at full size.
fn compare(out: &Path) -> usize {
    let (cards, told) = (cards(&out.join("sheets.pdf")), told(&out.join("contacts.csv")));
    let rods = table(&out.join("rods.csv"));
    let numbers: Vec<&str> = cards.iter().map(|card| card.number.as_str()).collect();
    let expected: Vec<&str> = rods.iter().map(|row| row["id"].as_str()).collect();
    assert_eq!(numbers, expected, "every rod is on one card");
    let mut full_size = 0;
    for (card, row) in cards.iter().zip(&rods) {
        let (number, marks) = (&card.number, &told[&card.number]);
        assert_eq!(card.ticks.len(), marks.len(), "{number}");
        if card.texts.iter().any(|text| text == "strip 1:1") {
            full_size += 1;
            let length: f64 = row["cut_length_mm"].parse().expect("a length");
            let drawn = card.length.expect("an outline");
            assert!((drawn - length).abs() <= OFF, "{number}: {drawn} for {length}");
            for (tick, mark) in card.ticks.iter().zip(marks) {
                assert!((tick - mark.at).abs() <= OFF, "{number}: {tick} for {}", mark.at);
            }
        }
        compare_lines(card, marks);
    }
    full_size
}

/// A line of a card: letter, place, side, partner, angle, clock.
fn compare_lines(card: &Card, marks: &[Told]) {
    let number = &card.number;
    let lines: Vec<&[String]> = card.texts.windows(6).filter(|w| w[3].contains(" @ ")).collect();
    assert_eq!(lines.len(), marks.len(), "{number}: {:?}", card.texts);
    // Printed to one decimal.
    let near = |text: &str, value: f64| {
        let text = text.trim_end_matches('°').trim_start_matches("clock ");
        let off = (text.parse::<f64>().expect("a number") - value).abs();
        assert!(off.min(360.0 - off) <= 0.05 + 1e-9, "{number}: {text} for {value}");
    };
    for (i, (line, mark)) in lines.iter().zip(marks).enumerate() {
        assert_eq!(line[0], char::from(b'a' + i as u8).to_string());
        near(&line[1], mark.at);
        assert_eq!(line[2], mark.side, "{number}");
        let (partner, at_partner) = line[3].split_once(" @ ").expect("a partner");
        assert_eq!(partner.split(' ').next(), Some(mark.partner.as_str()), "{number}");
        near(at_partner, mark.at_partner);
        near(&line[4], mark.angle);
        near(&line[5], mark.clock);
    }
}

#[test]
fn strips_and_lines_of_printed_rod_cards_are_those_of_the_contacts() {
    let dir = tempdir().unwrap();
    let build = |args: &[&str]| {
        let out = dir.path().join("out");
        rodwright(dir.path())
            .arg("build")
            .args(args)
            .args(["--only", "csv,sheets", "-q", "--force", "-o"])
            .arg(&out)
            .assert()
            .success();
        compare(&out)
    };
    let igloo = build(&[&sample("igloo.obj")]);
    assert!(igloo >= 100, "{igloo} strips at full size");
    let station =
        build(&[&sample("train-station.obj"), "--pattern", "3.6.3.6", "--paper", "letter"]);
    assert!(station >= 50, "{station} strips at full size");
}
