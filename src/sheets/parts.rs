//! The parts: all rods by length class, drawn to one scale.

use super::page::{FAINT, Flow, Leaf, SMALLEST, TABLE, THIN};
use super::text::TextError;
use super::text::message::messages;
use super::view::round_scale;
use super::{Format, SheetError, SheetSettings};
use crate::drawing::font::text_width;
use crate::drawing::{Anchor, Color, Draw, DrawingError, Stroke, Weight};
use crate::frame::Frame;
use crate::shop::lengths::are_mixed;
use crate::shop::{LengthClass, classes};

/// Least height of a line, mm; thick rods need more.
const LINE: f64 = 5.2;
/// It is less than that, down to this, where all rods then stand on one page, mm.
const LEAST_LINE: f64 = 4.4;
/// What sums of heights may be off, mm.
const ROUNDING: f64 = 1e-6;
/// White above and below the picture of a rod, mm.
const ABOVE: f64 = 0.8;
/// Between columns, mm.
const GUTTER: f64 = 3.5;
/// Least part of the width that is left for the pictures.
const PICTURE_SHARE: f64 = 0.3;
/// Rods are drawn at least as thick, mm: thinner ones would look like lines of a table.
const THINNEST: f64 = 0.5;
/// Font size of the figures, mm.
const SIZE: f64 = TABLE;

messages! {
    mod say in "parts.toml" {
        "title" => Title {}
        "summary" => Summary { rods: usize, lengths: usize, mixed: bool, total: String }
        "class" => Class {}
        "count" => Count {}
        "length" => Length {}
        "diameter" => Diameter {}
        "marks" => Marks {}
        "total" => Total {}
        "picture" => Picture {}
    }
}

/// How the columns before the picture stand: words, then figures.
const ANCHORS: [Anchor; 6] =
    [Anchor::Start, Anchor::End, Anchor::End, Anchor::End, Anchor::End, Anchor::End];

/// Heads of the columns.
struct Heads {
    columns: [String; 6],
    picture: String,
}

impl Heads {
    fn new(settings: &SheetSettings) -> Result<Self, TextError> {
        let columns = [
            settings.say(say::Class {})?,
            settings.say(say::Count {})?,
            settings.say(say::Length {})?,
            settings.say(say::Diameter {})?,
            settings.say(say::Marks {})?,
            settings.say(say::Total {})?,
        ];
        Ok(Self { columns, picture: settings.say(say::Picture {})? })
    }
}

/// The pages of the parts.
pub(super) fn parts(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "parts", &settings.say(say::Title {})?);
    let classes = classes(frame);
    if classes.is_empty() {
        return Ok(Vec::new());
    }
    let (heads, format) = (Heads::new(settings)?, settings.format());
    let longest = classes.iter().map(|class| class.length).fold(0.0, f64::max);
    let grid = Grid::new(frame, &heads, classes.iter(), format, flow.area().width())?;
    let n = round_scale(longest / grid.picture).max(1.0);
    let total = frame.rods.iter().map(|rod| rod.axis.length()).sum();
    flow.paragraph(&settings.say(say::Summary {
        rods: frame.rods.len(),
        lengths: classes.len(),
        mixed: are_mixed(frame),
        total: format.total(total),
    })?)?;
    head(&mut flow, &grid, &heads);
    let line = flow.room() / classes.len() as f64;
    let line = if line < LEAST_LINE { LINE } else { line.min(LINE) };
    for class in &classes {
        let thickness = class.diameters.map(|d| (d / n).max(THINNEST));
        let height = (thickness[0].max(thickness[1]) + 2.0 * ABOVE).max(line);
        // Lines that fill the page to its end still fit, but for rounding.
        if height > flow.room() + ROUNDING {
            flow.turn_page();
            head(&mut flow, &grid, &heads);
        }
        let cells = cells(frame, class, format);
        row(&mut flow, &grid, &cells, height);
        rod(&mut flow, &grid, class, n, height);
        flow.skip(height);
        rule(&mut flow, FAINT);
    }
    Ok(flow.finish(Some(&format!("1:{}", format.plain(n)))))
}

/// What stands before the picture of a class.
fn cells(frame: &Frame, class: &LengthClass, format: Format) -> [String; 6] {
    let marks = || class.rods.iter().map(|&rod| frame.rods[rod].contacts.len());
    let (fewest, most) = (marks().min().unwrap_or(0), marks().max().unwrap_or(0));
    [
        class.name.clone(),
        format!("{} ×", class.rods.len()),
        format.measure(class.length),
        format.diameter(class.diameters),
        if fewest == most { most.to_string() } else { format!("{fewest}–{most}") },
        format.total(class.length * class.rods.len() as f64),
    ]
}

/// Where the columns lie.
struct Grid {
    /// Font size, mm.
    size: f64,
    /// Left ends of the columns, from the left of the page's area, mm.
    left: [f64; 6],
    width: [f64; 6],
    /// Where pictures begin, and how wide they can be, mm.
    start: f64,
    picture: f64,
}

impl Grid {
    fn new<'a>(
        frame: &Frame,
        heads: &Heads,
        classes: impl Iterator<Item = &'a LengthClass>,
        format: Format,
        room: f64,
    ) -> Result<Self, DrawingError> {
        let mut width = [0.0f64; 6];
        for (w, head) in width.iter_mut().zip(&heads.columns) {
            *w = text_width(head, SIZE, Weight::Bold)?;
        }
        for class in classes {
            for (w, cell) in width.iter_mut().zip(cells(frame, class, format)) {
                *w = w.max(text_width(&cell, SIZE, Weight::Bold)?);
            }
        }
        let gutters = GUTTER * width.len() as f64;
        let words: f64 = width.iter().sum();
        let shrink = (room * (1.0 - PICTURE_SHARE) - gutters) / words;
        let shrink = shrink.clamp(SMALLEST / SIZE, 1.0);
        let width = width.map(|w| w * shrink);
        let mut left = [0.0; 6];
        for k in 1..left.len() {
            left[k] = left[k - 1] + width[k - 1] + GUTTER;
        }
        let start = left[5] + width[5] + GUTTER;
        Ok(Self { size: SIZE * shrink, left, width, start, picture: room - start })
    }
}

fn head(flow: &mut Flow, grid: &Grid, heads: &Heads) {
    row(flow, grid, &heads.columns, LINE);
    let at = [flow.area().min[0] + grid.start, flow.y + LINE / 2.0];
    flow.page().text(at, grid.size, heads.picture.as_str()).vcenter();
    flow.skip(LINE);
    rule(flow, THIN);
}

fn rule(flow: &mut Flow, stroke: Stroke) {
    let (area, y) = (flow.area(), flow.y);
    flow.page().line([area.min[0], y], [area.max[0], y], stroke);
}

/// The cells of a row `height` mm high: the class in bold, all in the middle of the height.
fn row(flow: &mut Flow, grid: &Grid, cells: &[String; 6], height: f64) {
    let (x, y) = (flow.area().min[0], flow.y + height / 2.0);
    for (k, text) in cells.iter().enumerate() {
        let anchor = ANCHORS[k];
        let at = if anchor == Anchor::End { grid.left[k] + grid.width[k] } else { grid.left[k] };
        let text = flow.page().text([x + at, y], grid.size, text.as_str());
        text.anchor(anchor).vcenter();
        if k == 0 {
            text.bold();
        }
    }
}

/// A rod of the class at 1:n, its end A to the left.
fn rod(flow: &mut Flow, grid: &Grid, class: &LengthClass, n: f64, height: f64) {
    let (left, middle) = (flow.area().min[0] + grid.start, flow.y + height / 2.0);
    let right = left + class.length / n;
    let [a, b] = class.diameters.map(|d| (d / n).max(THINNEST) / 2.0);
    let outline = Stroke::new(0.15).fill(Color::PALE_GREY);
    flow.page().polygon(
        [[left, middle - a], [right, middle - b], [right, middle + b], [left, middle + a]],
        outline,
    );
}
