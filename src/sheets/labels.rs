//! Labels for the rods: one for each, with its number and what else finds room.
//!
//! They are printed on sheets of labels as they are sold, from the first free label on, or
//! as strips of plain paper with lines to cut along. Sheets of labels have nothing on them
//! but the labels: their margins are too narrow to print on.

mod medium;
mod tag;

pub use medium::{LabelGrid, LabelMedium};

use super::page::{Leaf, Listing, area, stamp};
use super::text::message::messages;
use super::{Sheet, SheetError, SheetSettings};
use crate::drawing::pdf::Page;
use crate::drawing::{Color, Draw, Drawing, DrawingError, Placement, Rect, Stroke};
use crate::frame::Frame;
use tag::{Facts, tag};

messages! {
    mod say in "labels.toml" {
        "title" => Title {}
        "sheet" => LabelSheet { number: usize }
        "class" => Class { class: String }
    }
}

/// What labels are printed on, and where they begin.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LabelSettings {
    /// The sheet.
    pub medium: LabelMedium,
    /// How many labels of the first sheet are used up already.
    pub used: usize,
}

/// White border within a label, mm: printers feed paper in askew and shifted by up to a
/// millimetre, and layouts differ by as much.
const SAFE: f64 = 1.5;
/// Least width of a strip, mm: holds number and length side by side.
const STRIP_WIDTH: f64 = 45.0;
/// Height of a strip, mm: two lines below the number, and easy to cut.
const STRIP_HEIGHT: f64 = 14.0;
/// The lines to cut strips along.
const CUT: Stroke = Stroke::new(0.1).color(Color::GREY);

/// The labels of all rods, by their numbers.
///
/// # Errors
/// As [`sheets`](super::sheets).
pub fn labels(
    frame: &Frame,
    labels: LabelSettings,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let settings = settings.checked()?;
    let facts = Facts::of_all(frame, &settings)?;
    match labels.medium.grid() {
        Some(grid) => on_sheets(&facts, &grid, labels.used, &settings),
        None => {
            let grid = strips(area(&settings), settings.paper);
            stamp(
                on_strips(&facts, &grid, &settings)?,
                &settings.format().diameters(frame),
                &settings,
            )
        }
    }
}

/// Labels on sheets of labels, the first `used` places of which are left free.
fn on_sheets(
    facts: &[Facts],
    grid: &LabelGrid,
    used: usize,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let pages = pages(facts, grid, used % grid.labels())?;
    let digits = pages.len().to_string().len().max(2);
    let sheet = |(i, drawing)| {
        let title = settings.say(say::LabelSheet { number: i + 1 })?;
        let stem = format!("{:0digits$}-labels", i + 1);
        Ok(Sheet { stem, page: Page::titled(drawing, title) })
    };
    pages.into_iter().enumerate().map(sheet).collect()
}

/// As many equal strips as fit.
fn strips(area: Rect, paper: super::Paper) -> LabelGrid {
    let columns = (area.width() / STRIP_WIDTH).floor().max(1.0);
    let size = [area.width() / columns, STRIP_HEIGHT];
    let rows = (area.height() / STRIP_HEIGHT).floor().max(1.0);
    LabelGrid {
        paper,
        count: [columns as usize, rows as usize],
        size,
        origin: area.min,
        pitch: size,
    }
}

/// Strips on plain paper, with lines to cut along.
fn on_strips(
    facts: &[Facts],
    grid: &LabelGrid,
    settings: &SheetSettings,
) -> Result<Vec<Leaf>, SheetError> {
    let title = settings.say(say::Title {})?;
    let mut pages = pages(facts, grid, 0)?;
    let several = pages.len() > 1;
    for (page, on_it) in pages.iter_mut().zip(facts.chunks(grid.labels())) {
        cut_lines(page, grid, on_it.len());
    }
    let leaf = |(i, drawing)| Leaf {
        stem: if several { format!("labels-{}", i + 1) } else { "labels".to_owned() },
        title: title.clone(),
        scale: None,
        drawing,
        listing: Listing::default(),
    };
    Ok(pages.into_iter().enumerate().map(leaf).collect())
}

/// The lines round the first `labels` strips of a page.
fn cut_lines(page: &mut Drawing, grid: &LabelGrid, labels: usize) {
    let columns = grid.count[0];
    for index in 0..labels {
        let Rect { min: [left, top], max: [right, bottom] } = grid.rect(index);
        // Above and to the left another strip has drawn the line already.
        if index < columns {
            page.line([left, top], [right, top], CUT);
        }
        if index % columns == 0 {
            page.line([left, top], [left, bottom], CUT);
        }
        page.line([right, top], [right, bottom], CUT);
        page.line([left, bottom], [right, bottom], CUT);
    }
}

/// The labels on as many pages as they need; the first `used` places stay free.
fn pages(facts: &[Facts], grid: &LabelGrid, used: usize) -> Result<Vec<Drawing>, DrawingError> {
    let [width, height] = grid.paper.size();
    let count = (used + facts.len()).div_ceil(grid.labels());
    let mut pages = vec![Drawing::new(width, height); count];
    for (index, facts) in (used..).zip(facts) {
        let room = grid.rect(index % grid.labels()).inset(SAFE);
        let items = tag(facts, room.size())?;
        pages[index / grid.labels()].place(&items, &Placement::at(room.min));
    }
    Ok(pages)
}

#[cfg(test)]
mod tests;
