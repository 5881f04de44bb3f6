//! The handout on pages: its text set in lines, its pictures drawn where they stand.

use super::markdown::{Block, Picture, Subject, Word};
use super::pictures::Pictures;
use crate::drawing::font::{LEADING, text_width, wrap};
use crate::drawing::{Draw, DrawingError, Placement, Rect, Stroke, Weight};
use crate::sheets::SheetError;
use crate::sheets::page::{BODY, Flow};

/// Font size of running text, mm: 10.5 pt, for readers who are ten.
const TEXT: f64 = 3.7;
/// Font sizes of headings of level 1, 2 and below, mm.
const HEADINGS: [f64; 3] = [6.4, 4.8, 4.0];
/// How far a list stands in, mm.
const INDENT: f64 = 6.0;
/// White below a paragraph, mm.
const PARAGRAPH: f64 = 1.6;
/// White below an entry of a list, mm.
const ENTRY: f64 = 0.7;
/// White above a heading, as part of its size.
const ABOVE: f64 = 0.7;
/// White between runs of different weight, mm: more than rounding, less than is seen.
const SEAM: f64 = 0.02;
/// A heading stays with at least so much of what follows, mm.
const KEPT: f64 = 14.0;
/// White between pictures beside each other, and below them, mm.
const GAP: f64 = 5.0;
/// Room for the words below a picture, mm.
const CAPTION: f64 = BODY * LEADING;

/// Sets all blocks.
pub(super) fn set(
    blocks: &[Block],
    pictures: &Pictures,
    flow: &mut Flow,
) -> Result<(), SheetError> {
    for (i, block) in blocks.iter().enumerate() {
        match block {
            Block::Heading(level, words) => {
                let below = blocks.get(i + 1).map_or(Ok(0.0), |b| kept(b, pictures, flow))?;
                heading(*level, words, below, flow)?;
            }
            Block::Paragraph { depth, label, words } => {
                paragraph(*depth, label.as_deref(), words, flow)?;
            }
            Block::Pictures(row) => picture_row(row, pictures, flow)?,
            Block::Rule => {
                let ([left, right], y) = ([flow.area().min[0], flow.area().max[0]], flow.y);
                flow.page().line([left, y + 1.0], [right, y + 1.0], Stroke::new(0.3));
                flow.skip(3.5);
            }
        }
    }
    Ok(())
}

/// How much of a block stays with the heading above it, mm.
fn kept(block: &Block, pictures: &Pictures, flow: &Flow) -> Result<f64, SheetError> {
    match block {
        Block::Pictures(row) => row_height(row, pictures, flow),
        _ => Ok(KEPT),
    }
}

fn heading(level: usize, words: &[Word], below: f64, flow: &mut Flow) -> Result<(), SheetError> {
    let size = HEADINGS[level.clamp(1, HEADINGS.len()) - 1];
    let lines = lines(words, size, Some(Weight::Bold), flow.area().width())?;
    let above = if flow.y > flow.area().min[1] { size * ABOVE } else { 0.0 };
    flow.need(above + lines.len() as f64 * size * LEADING + below);
    if flow.y > flow.area().min[1] {
        flow.skip(size * ABOVE);
    }
    for line in lines {
        let at = [flow.area().min[0], flow.y + size];
        draw_line(&line, at, size, flow);
        flow.skip(size * LEADING);
    }
    flow.skip(size * 0.2);
    Ok(())
}

fn paragraph(
    depth: usize,
    label: Option<&str>,
    words: &[Word],
    flow: &mut Flow,
) -> Result<(), SheetError> {
    let (area, indent) = (flow.area(), INDENT * depth as f64);
    let lines = lines(words, TEXT, None, area.width() - indent)?;
    // Not a single line is left behind on a page.
    flow.need(lines.len().min(2) as f64 * TEXT * LEADING);
    for (i, line) in lines.iter().enumerate() {
        flow.need(TEXT * LEADING);
        let (x, y) = (area.min[0] + indent, flow.y + TEXT);
        if let (0, Some(label)) = (i, label) {
            flow.page().text([x - 1.6, y], TEXT, label).end();
        }
        draw_line(line, [x, y], TEXT, flow);
        flow.skip(TEXT * LEADING);
    }
    flow.skip(if depth > 0 { ENTRY } else { PARAGRAPH });
    Ok(())
}

/// Text of one weight from a place on in a line.
struct Run {
    x: f64,
    text: String,
    weight: Weight,
}

/// The words in lines of at most `room` mm; `all` of one weight, or each of its own.
fn lines(
    words: &[Word],
    size: f64,
    all: Option<Weight>,
    room: f64,
) -> Result<Vec<Vec<Run>>, DrawingError> {
    let space = text_width(" ", size, Weight::Regular)?;
    let mut lines: Vec<Vec<Run>> = vec![Vec::new()];
    let mut x = 0.0;
    let mut turned = false;
    for word in words {
        let weight = |own: Weight| all.unwrap_or(own);
        let mut width = 0.0;
        for (text, own) in &word.parts {
            width += text_width(text, size, weight(*own))?;
        }
        if turned || (x > 0.0 && x + space + width > room) {
            lines.push(Vec::new());
            x = 0.0;
        }
        turned = word.ends_line;
        let line = match lines.last_mut() {
            Some(line) => line,
            None => unreachable!("there is a first line"),
        };
        let mut from = if x > 0.0 { x + space } else { 0.0 };
        for (text, own) in &word.parts {
            let weight = weight(*own);
            // Words of one weight are one text, which can be searched and copied whole.
            match line.last_mut() {
                Some(run) if run.weight == weight => {
                    if from > x && x > 0.0 {
                        run.text.push(' ');
                    }
                    run.text.push_str(text);
                }
                _ => {
                    // Runs that touch would overlap by rounding.
                    from += if from > 0.0 { SEAM } else { 0.0 };
                    line.push(Run { x: from, text: text.clone(), weight });
                }
            }
            from += text_width(text, size, weight)?;
            x = from;
        }
    }
    Ok(lines)
}

fn draw_line(line: &[Run], [x, y]: [f64; 2], size: f64, flow: &mut Flow) {
    for run in line {
        flow.page().text([x + run.x, y], size, run.text.as_str()).weight(run.weight);
    }
}

/// Width that each picture of a row has, mm.
fn width(row: &[Picture], flow: &Flow) -> f64 {
    let count = row.len().max(1) as f64;
    (flow.area().width() - GAP * (count - 1.0)) / count
}

/// Height of a row of pictures with their captions, mm.
fn row_height(row: &[Picture], pictures: &Pictures, flow: &Flow) -> Result<f64, SheetError> {
    let width = width(row, flow);
    let mut height: f64 = 0.0;
    for picture in row {
        let lines = wrap(&picture.caption, BODY, Weight::Regular, width)?.len() as f64;
        height = height.max(pictures.height(picture.of, width)? + lines * CAPTION);
    }
    Ok(height + GAP)
}

fn picture_row(row: &[Picture], pictures: &Pictures, flow: &mut Flow) -> Result<(), SheetError> {
    let (width, height) = (width(row, flow), row_height(row, pictures, flow)?);
    flow.need(height);
    let drawn = row.iter().map(|p| pictures.height(p.of, width)).collect::<Result<Vec<_>, _>>()?;
    let tallest = drawn.into_iter().fold(0.0, f64::max);
    for (i, picture) in row.iter().enumerate() {
        let left = flow.area().min[0] + (width + GAP) * i as f64;
        let room = Rect::new([left, flow.y], [width, tallest]);
        let items = pictures.draw(picture.of, room)?;
        flow.page().place(&items, &Placement::at([0.0; 2]));
        let caption = wrap(&picture.caption, BODY, Weight::Regular, width)?;
        // A card begins at the left, as its words do; the others stand in the middle.
        let (x, anchor) = match picture.of {
            Subject::RodCard => (left, crate::drawing::Anchor::Start),
            _ => (left + width / 2.0, crate::drawing::Anchor::Middle),
        };
        let y = room.max[1] + BODY;
        flow.page().text_lines([x, y], BODY, CAPTION, anchor, caption);
    }
    flow.skip(height);
    Ok(())
}
