//! The frame of every page, and text and tables that flow over pages.

use super::text::message::messages;
use super::text::{TextError, Texts};
use super::{Format, SheetError, SheetSettings};
use crate::drawing::font::{LEADING, elide, text_width, wrap};
use crate::drawing::pdf::Page;
use crate::drawing::{Anchor, Color, Draw, Drawing, DrawingError, Rect, Stroke, Weight};

messages! {
    mod say in "page.toml" {
        "language" => Language {}
        "decimal" => Decimal {}
        "page-number" => PageNumber { number: usize, count: usize }
        "facts" => Facts { diameters: String, scale: String, inches: bool }
        "sheets" => Sheets { model: String }
        "support-map" => SupportMap { model: String }
        "steps" => Steps { model: String }
        "labels" => Labels { model: String }
        "handout" => Handout { model: String }
        "statics" => Statics { model: String }
        "handout-title" => HandoutTitle {}
    }
}

/// White border of every page, mm: what common printers cannot print on, and some.
pub(super) const MARGIN: f64 = 10.0;
/// Height of the title block, mm.
const TITLE_BLOCK: f64 = 14.0;
/// Least width and height of paper, mm: about A5. Smaller, and the calibration box
/// and the lines of a rod card do not fit.
pub(super) const LEAST_PAPER: [f64; 2] = [145.0, 200.0];

/// Font sizes, mm. None is below 6 pt, 2.12 mm.
pub(super) const TITLE: f64 = 5.0;
/// Headings within a page.
pub(super) const HEADING: f64 = 4.4;
/// Running text.
pub(super) const BODY: f64 = 3.2;
/// Figures in tables.
pub(super) const TABLE: f64 = 2.9;
/// Notes and labels.
pub(super) const SMALL: f64 = 2.4;
/// The smallest size that tables may shrink to: 6 pt.
pub(super) const SMALLEST: f64 = 6.0 * 25.4 / 72.0;

/// Gap between the columns of a table, mm.
const GUTTER: f64 = 3.5;
/// Height of a table line in font sizes.
pub(super) const TABLE_LEADING: f64 = 1.55;
/// Thin lines.
pub(super) const THIN: Stroke = Stroke::new(0.15);
/// Faint lines between the rows of a table.
pub(super) const FAINT: Stroke = Stroke::new(0.1).color(Color::LIGHT_GREY);

/// A document of several pages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Document {
    /// The building sheets.
    Sheets,
    /// The map of the feet.
    SupportMap,
    /// The steps of assembly alone.
    Steps,
    /// The labels of the rods.
    Labels,
    /// The handout for a class.
    Handout,
    /// Where the frame is stressed.
    Statics,
}

/// The title of a document of a model.
///
/// # Errors
/// [`TextError`] when a text cannot be put together.
pub fn document_title(document: Document, model: &str, texts: &Texts) -> Result<String, TextError> {
    let model = model.to_owned();
    match document {
        Document::Sheets => texts.say(say::Sheets { model }),
        Document::SupportMap => texts.say(say::SupportMap { model }),
        Document::Steps => texts.say(say::Steps { model }),
        Document::Labels => texts.say(say::Labels { model }),
        Document::Handout => texts.say(say::Handout { model }),
        Document::Statics => texts.say(say::Statics { model }),
    }
}

/// A finished page.
#[derive(Clone, PartialEq, Debug)]
pub struct Sheet {
    /// Name of its file, without an ending: `01-cover`.
    pub stem: String,
    /// The page, with its entry in the outline.
    pub page: Page,
}

/// A page before its number is known.
pub(super) struct Leaf {
    pub stem: String,
    pub title: String,
    /// Printed in the title block where the page has one scale.
    pub scale: Option<String>,
    pub drawing: Drawing,
    pub listing: Listing,
}

/// Where viewers list a page.
#[derive(Default)]
pub(super) struct Listing {
    /// The entry that it hangs below with its neighbours.
    pub chapter: Option<String>,
    /// Its own entry; the title if there is no other.
    pub name: Option<String>,
    /// What it is called in place of its number.
    pub label: Option<String>,
}

/// The part of a page below the title block.
pub(super) fn area(settings: &SheetSettings) -> Rect {
    let [width, height] = settings.paper.size();
    let sheet = Rect::new([0.0, 0.0], [width, height]).inset(MARGIN);
    Rect { min: [sheet.min[0], sheet.min[1] + TITLE_BLOCK], ..sheet }
}

/// The text without characters that the font cannot print.
pub(super) fn printable(text: &str) -> String {
    let known = |c: char| {
        let mut buffer = [0; 4];
        let string = &*c.encode_utf8(&mut buffer);
        [Weight::Regular, Weight::Bold].iter().all(|&w| text_width(string, 1.0, w).is_ok())
    };
    let shown = |c: char| match c {
        c if c.is_whitespace() || c.is_control() => ' ',
        c if known(c) => c,
        _ => '?',
    };
    text.chars().map(shown).collect()
}

/// Numbers the pages and gives each its title block, with the rods' diameters.
pub(super) fn stamp(
    leaves: Vec<Leaf>,
    diameters: &str,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let count = leaves.len();
    let digits = count.to_string().len().max(2);
    let mut sheets = Vec::with_capacity(count);
    for (i, mut leaf) in leaves.into_iter().enumerate() {
        title_block(&mut leaf, i + 1, count, diameters, settings)?;
        let stem = format!("{:0digits$}-{}", i + 1, leaf.stem);
        let Listing { chapter, name, label } = leaf.listing;
        let title = Some(name.unwrap_or(leaf.title));
        sheets.push(Sheet { stem, page: Page { drawing: leaf.drawing, title, chapter, label } });
    }
    Ok(sheets)
}

fn title_block(
    leaf: &mut Leaf,
    number: usize,
    count: usize,
    diameters: &str,
    settings: &SheetSettings,
) -> Result<(), SheetError> {
    let area = area(settings);
    let ([left, right], top) = ([area.min[0], area.max[0]], MARGIN);
    let paper = &mut leaf.drawing;
    let page = settings.say(say::PageNumber { number, count })?;
    let room = area.width() - text_width(&page, BODY, Weight::Regular)? - 5.0;
    paper.text([left, top + 4.0], TITLE, elide(&settings.model, TITLE, Weight::Bold, room)?).bold();
    paper.text([right, top + 4.0], BODY, page).end();

    let facts = settings.say(say::Facts {
        diameters: diameters.to_owned(),
        scale: leaf.scale.clone().unwrap_or_default(),
        inches: settings.units.is_inches(),
    })?;
    let room = area.width() - text_width(&facts, BODY, Weight::Regular)? - 5.0;
    paper.text([left, top + 9.0], BODY, elide(&leaf.title, BODY, Weight::Regular, room)?);
    paper.text([right, top + 9.0], BODY, facts).end();
    paper.line([left, top + 11.0], [right, top + 11.0], Stroke::new(0.3));
    Ok(())
}

/// One column of a table.
pub(super) struct Column {
    head: String,
    anchor: Anchor,
    wrap: bool,
}

impl Column {
    /// Words, from the left.
    pub fn text(head: impl Into<String>) -> Self {
        Self { head: head.into(), anchor: Anchor::Start, wrap: false }
    }

    /// Figures, aligned at their right ends.
    pub fn figure(head: impl Into<String>) -> Self {
        Self { head: head.into(), anchor: Anchor::End, wrap: false }
    }

    /// Words that take what room is left, over as many lines as needed. One a table.
    pub fn wrapped(head: impl Into<String>) -> Self {
        Self { head: head.into(), anchor: Anchor::Start, wrap: true }
    }
}

/// A table; each row has a cell for every column.
pub(super) struct Table {
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<String>>,
}

/// Pages that are filled from top to bottom.
pub(super) struct Flow<'a> {
    settings: &'a SheetSettings,
    stem: &'static str,
    title: String,
    pages: Vec<Drawing>,
    /// Where the next thing goes, mm from the top of the page.
    pub y: f64,
}

impl<'a> Flow<'a> {
    /// An empty first page.
    pub fn new(settings: &'a SheetSettings, stem: &'static str, title: &str) -> Self {
        let mut flow = Self { settings, stem, title: title.to_owned(), pages: Vec::new(), y: 0.0 };
        flow.turn_page();
        flow
    }

    /// The part of the page that is filled.
    pub fn area(&self) -> Rect {
        area(self.settings)
    }

    /// How figures are printed.
    pub fn format(&self) -> Format {
        self.settings.format()
    }

    /// What is left of the page, mm.
    pub fn room(&self) -> f64 {
        self.area().max[1] - self.y
    }

    /// The page that is being filled.
    pub fn page(&mut self) -> &mut Drawing {
        if self.pages.is_empty() {
            self.turn_page();
        }
        let last = self.pages.len() - 1;
        &mut self.pages[last]
    }

    /// Goes on at the top of a new page.
    pub fn turn_page(&mut self) {
        let [width, height] = self.settings.paper.size();
        self.pages.push(Drawing::new(width, height));
        self.y = self.area().min[1];
    }

    /// How many pages there are so far.
    pub fn count(&self) -> usize {
        self.pages.len()
    }

    /// Turns the page if `height` mm do not fit on it any more.
    pub fn need(&mut self, height: f64) {
        if height > self.room() && self.y > self.area().min[1] {
            self.turn_page();
        }
    }

    /// Leaves `height` mm empty.
    pub fn skip(&mut self, height: f64) {
        self.y += height;
    }

    /// A heading, kept together with at least `below` mm of what follows.
    pub fn heading(&mut self, text: &str, below: f64) {
        let height = HEADING * 1.7;
        self.need(height + below);
        let at = [self.area().min[0], self.y + HEADING];
        self.page().text(at, HEADING, text).bold();
        self.y += height;
    }

    /// Running text over the whole width.
    pub fn paragraph(&mut self, text: &str) -> Result<(), DrawingError> {
        let area = self.area();
        for line in wrap(text, BODY, Weight::Regular, area.width())? {
            self.need(BODY * LEADING);
            let at = [area.min[0], self.y + BODY];
            self.page().text(at, BODY, line);
            self.y += BODY * LEADING;
        }
        self.y += BODY * 0.4;
        Ok(())
    }

    /// A table over the whole width, its head repeated on every page.
    pub fn table(&mut self, table: &Table) -> Result<(), DrawingError> {
        let grid = Grid::new(table, self.area())?;
        let line = grid.size * TABLE_LEADING;
        self.need(3.0 * line);
        self.head(table, &grid);
        for row in &table.rows {
            let lines = grid.lines(table, row)?;
            // A row that fits on a page is not torn apart.
            let height = lines.len() as f64 * line;
            if height > self.room() && height < self.area().height() - 2.0 * line {
                self.turn_page();
                self.head(table, &grid);
            }
            for cells in &lines {
                if line > self.room() {
                    self.turn_page();
                    self.head(table, &grid);
                }
                self.cells(table, &grid, cells, Weight::Regular);
            }
            let y = self.y;
            let [left, right] = [self.area().min[0], self.area().max[0]];
            self.page().line([left, y], [right, y], FAINT);
        }
        self.y += 2.0;
        Ok(())
    }

    fn head(&mut self, table: &Table, grid: &Grid) {
        let heads: Vec<String> = table.columns.iter().map(|c| c.head.clone()).collect();
        self.cells(table, grid, &heads, Weight::Bold);
        let y = self.y;
        let [left, right] = [self.area().min[0], self.area().max[0]];
        self.page().line([left, y], [right, y], THIN);
    }

    fn cells(&mut self, table: &Table, grid: &Grid, cells: &[String], weight: Weight) {
        let y = self.y + grid.size * 1.15;
        for (k, text) in cells.iter().enumerate().filter(|(_, t)| !t.is_empty()) {
            let anchor = table.columns[k].anchor;
            let x = match anchor {
                Anchor::End => grid.x[k] + grid.width[k],
                Anchor::Middle => grid.x[k] + grid.width[k] / 2.0,
                Anchor::Start => grid.x[k],
            };
            self.page().text([x, y], grid.size, text.as_str()).anchor(anchor).weight(weight);
        }
        self.y += grid.size * TABLE_LEADING;
    }

    /// The pages, for [`stamp`].
    pub fn finish(self, scale: Option<&str>) -> Vec<Leaf> {
        let Self { stem, title, pages, .. } = self;
        let (several, chapter) = (pages.len() > 1, title.clone());
        let leaf = |(i, drawing)| {
            let (stem, title) = if several {
                (format!("{stem}-{}", i + 1), format!("{title}, {}", i + 1))
            } else {
                (stem.to_owned(), title.clone())
            };
            let listing =
                Listing { chapter: several.then(|| chapter.clone()), ..Listing::default() };
            Leaf { stem, title, scale: scale.map(str::to_owned), drawing, listing }
        };
        pages.into_iter().enumerate().map(leaf).collect()
    }
}

/// Where the columns of a table lie.
struct Grid {
    size: f64,
    x: Vec<f64>,
    width: Vec<f64>,
}

impl Grid {
    /// Columns as wide as their widest cell; letters shrink where that is too much.
    fn new(table: &Table, area: Rect) -> Result<Self, DrawingError> {
        let mut width = Vec::with_capacity(table.columns.len());
        for (k, column) in table.columns.iter().enumerate() {
            let mut widest = text_width(&column.head, TABLE, Weight::Bold)?;
            for row in table.rows.iter().filter(|_| !column.wrap) {
                widest = widest.max(text_width(&row[k], TABLE, Weight::Regular)?);
            }
            width.push(widest);
        }
        let gutters = GUTTER * table.columns.len().saturating_sub(1) as f64;
        let natural: f64 = width.iter().sum();
        let shrink = ((area.width() - gutters) / natural).min(1.0);
        let size = (TABLE * shrink).max(SMALLEST);
        for w in &mut width {
            *w *= size / TABLE;
        }
        let left_over = area.width() - gutters - width.iter().sum::<f64>();
        let wrapping = table.columns.iter().position(|c| c.wrap);
        if let (Some(k), true) = (wrapping, left_over > 0.0) {
            width[k] += left_over;
        }
        let start = |k: usize| area.min[0] + width[..k].iter().map(|w| w + GUTTER).sum::<f64>();
        Ok(Self { size, x: (0..width.len()).map(start).collect(), width })
    }

    /// A row as lines of cells: more than one where a cell wraps.
    fn lines(&self, table: &Table, row: &[String]) -> Result<Vec<Vec<String>>, DrawingError> {
        let mut lines = vec![vec![String::new(); row.len()]];
        for (k, cell) in row.iter().enumerate() {
            let parts = if table.columns[k].wrap {
                wrap(cell, self.size, Weight::Regular, self.width[k])?
            } else {
                vec![cell.clone()]
            };
            for (i, part) in parts.into_iter().enumerate() {
                if i == lines.len() {
                    lines.push(vec![String::new(); row.len()]);
                }
                lines[i][k] = part;
            }
        }
        Ok(lines)
    }
}
