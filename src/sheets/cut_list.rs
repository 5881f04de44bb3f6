//! The cut list: length classes, and which pieces are sawn from which bar.

use super::page::{BODY, Column, Flow, Leaf, SMALL, TABLE, THIN, Table};
use super::text::TextError;
use super::text::message::messages;
use super::{Format, SheetError, SheetSettings};
use crate::drawing::font::text_width;
use crate::drawing::{Color, Draw, Stroke, Weight};
use crate::frame::Frame;
use crate::ids::RodId;
use crate::shop::{Aim, Bar, BarGroup, CutPlan, LengthClasses, Purchase, classes};

messages! {
    mod say in "cut-list.toml" {
        "title" => Title {}
        "by-length" => ByLength {}
        "plan" => Plan {}
        "class" => Class {}
        "length" => Length {}
        "count" => Count {}
        "total" => Total {}
        "diameter" => Diameter {}
        "rods" => Rods {}
        "nothing" => Nothing {}
        "summary" => Summary {
            pieces: usize, bars: usize, list: String, cuts: usize, kerf: String, trim: String,
            sawn_offcuts: bool, total: String, weight: String, density: String, waste: String,
        }
        "kept" => Kept { list: String }
        "stops" => Stops {}
        "bought" => Bought { bars: String, offcuts: String }
        "bars" => Bars { count: usize, length: String, diameter: String }
        "worth-bars" => WorthBars { spent: usize, least: usize, proven: bool }
        "worth-length" => WorthLength { spent: String, least: String, proven: bool }
        "worth-cost" => WorthCost { spent: String, least: String, proven: bool }
        "piece" => Piece {}
        "stop-at" => StopAt {}
        "bar" => BarNumber { number: usize }
        "bar-numbers" => BarNumbers { first: usize, last: usize }
        "bar-head" => BarHead { count: usize, length: String, diameter: String, offcut: bool }
        "left-over" => LeftOver { length: String, keep: bool }
    }
}

/// Height of the picture of a bar, mm.
const BAR: f64 = 4.0;
/// Height of a line of figures below it, mm.
const LINE: f64 = TABLE * 1.4;
/// Width of the column with the names of these lines, mm.
const NAMES: f64 = 15.0;

/// The pages of the cut list.
pub(super) fn cut_list(
    frame: &Frame,
    plan: &CutPlan,
    settings: &SheetSettings,
) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "cut-list", &settings.say(say::Title {})?);
    let classes = classes(frame);
    flow.heading(&settings.say(say::ByLength {})?, 20.0);
    flow.table(&class_table(&classes, plan.is_mixed(), settings)?)?;
    flow.heading(&settings.say(say::Plan {})?, 40.0);
    let saw = Saw { plan, classes: &classes, format: flow.format(), settings };
    saw.summary(&mut flow)?;
    let mut first = 1;
    for bars in plan.groups() {
        let alike = Alike { first, bars };
        first += alike.bars.bars.len();
        saw.alike(&mut flow, &alike)?;
    }
    Ok(flow.finish(None))
}

/// What the pages of the sawing plan are made from.
struct Saw<'a> {
    plan: &'a CutPlan,
    classes: &'a LengthClasses,
    format: Format,
    settings: &'a SheetSettings,
}

/// Bars that are sawn alike, and the number of the first of them.
struct Alike<'a> {
    first: usize,
    bars: BarGroup<'a>,
}

/// The length classes, with their diameters where rods have several.
fn class_table(
    classes: &LengthClasses,
    mixed: bool,
    settings: &SheetSettings,
) -> Result<Table, TextError> {
    let format = settings.format();
    let names = |rods: &[RodId]| rods.iter().map(RodId::to_string).collect::<Vec<_>>().join(" ");
    let rows = classes
        .iter()
        .map(|c| {
            let count = c.rods.len();
            let total = format.total(c.length * count as f64);
            let mut row = vec![c.name.clone(), format.length(c.length), count.to_string(), total];
            row.extend(mixed.then(|| format.diameter(c.diameters)));
            row.push(names(&c.rods));
            row
        })
        .collect();
    let mut columns = vec![
        Column::text(settings.say(say::Class {})?),
        Column::figure(settings.say(say::Length {})?),
        Column::figure(settings.say(say::Count {})?),
        Column::figure(settings.say(say::Total {})?),
    ];
    if mixed {
        columns.push(Column::figure(settings.say(say::Diameter {})?));
    }
    columns.push(Column::wrapped(settings.say(say::Rods {})?));
    Ok(Table { columns, rows })
}

impl Saw<'_> {
    /// What is bought and sawn, how good the plan is, and how to read it.
    fn summary(&self, flow: &mut Flow) -> Result<(), SheetError> {
        let Self { plan, format, settings, .. } = *self;
        if plan.bars.is_empty() {
            return Ok(flow.paragraph(&settings.say(say::Nothing {})?)?);
        }
        let trim = plan.trim > 0.0;
        flow.paragraph(&settings.say(say::Summary {
            pieces: plan.pieces(),
            bars: plan.bars.len(),
            list: self.bars()?,
            cuts: plan.cuts(),
            kerf: format.width(plan.kerf),
            trim: if trim { format.width(plan.trim) } else { String::new() },
            sawn_offcuts: trim && !plan.taken().is_empty(),
            total: format.total(plan.used()),
            weight: format.weight(plan.weight(settings.density)),
            density: format.plain(settings.density),
            waste: format.percent(plan.waste()),
        })?)?;
        flow.paragraph(&self.worth()?)?;
        let kept = plan.kept();
        if !kept.is_empty() {
            let list = self.list(&kept)?;
            flow.paragraph(&settings.say(say::Kept { list })?)?;
        }
        Ok(flow.paragraph(&settings.say(say::Stops {})?)?)
    }

    /// The bars that are bought, and the offcuts that are used.
    fn bars(&self) -> Result<String, TextError> {
        let bars = self.list(&self.plan.shopping())?;
        let offcuts = self.list(&self.plan.taken())?;
        self.settings.say(say::Bought { bars, offcuts })
    }

    fn list(&self, bars: &[Purchase]) -> Result<String, TextError> {
        let one = |p: &Purchase| {
            let diameter = match self.plan.is_mixed() {
                true => self.format.diameter(p.diameters),
                false => String::new(),
            };
            let length = self.format.measure(p.length);
            self.settings.say(say::Bars { count: p.count, length, diameter })
        };
        Ok(bars.iter().map(one).collect::<Result<Vec<_>, _>>()?.join(", "))
    }

    /// How good the plan is.
    fn worth(&self) -> Result<String, TextError> {
        let Self { plan, format, settings, .. } = *self;
        let proven = plan.is_proven();
        let both = [plan.spent, plan.least];
        match plan.aim {
            Aim::Bars => {
                let [spent, least] = both.map(|n| n as usize);
                settings.say(say::WorthBars { spent, least, proven })
            }
            Aim::Length => {
                let [spent, least] = both.map(|mm| format.total(mm));
                settings.say(say::WorthLength { spent, least, proven })
            }
            Aim::Cost => {
                let [spent, least] = both.map(|cost| format.fixed(cost, 2));
                settings.say(say::WorthCost { spent, least, proven })
            }
        }
    }

    /// Bars that are sawn alike: a picture, the stops, and the rods of each bar.
    fn alike(&self, flow: &mut Flow, alike: &Alike) -> Result<(), SheetError> {
        let (bar, format, settings) = (alike.bars.first(), self.format, self.settings);
        let mut rows = Vec::new();
        let mut row =
            |name: String, weight: Weight, text: &dyn Fn(&Bar, usize) -> String, of: &Bar| {
                let cells = (0..of.pieces.len()).map(|i| text(of, i)).collect();
                rows.push(Row { name, weight, cells });
            };
        let piece = |b: &Bar, i: usize| {
            let name = &self.classes.of(b.pieces[i].rod).name;
            format!("{name} {}", format.length(b.pieces[i].length))
        };
        row(settings.say(say::Piece {})?, Weight::Regular, &piece, bar);
        let stop = |b: &Bar, i: usize| format.length(b.pieces[i].stop);
        row(settings.say(say::StopAt {})?, Weight::Bold, &stop, bar);
        for (n, bar) in alike.bars.bars.iter().enumerate() {
            let name = settings.say(say::BarNumber { number: alike.first + n })?;
            row(name, Weight::Regular, &|b, i| b.pieces[i].rod.to_string(), bar);
        }
        // The picture stays with the first stops and rods.
        flow.need(7.0 + BAR + 4.0 * LINE);
        self.picture(flow, alike)?;
        table(flow, &rows, bar.pieces.len())
    }

    /// How many bars, and a bar to scale with the classes of its pieces.
    fn picture(&self, flow: &mut Flow, alike: &Alike) -> Result<(), SheetError> {
        self.caption(flow, alike)?;
        let bar = alike.bars.first();
        let area = flow.area();
        let (top, scale) = (flow.y + 5.4, area.width() / bar.stock_length);
        let page = flow.page();
        page.rect([area.min[0], top], [area.width(), BAR], THIN.fill(Color::LIGHT_GREY));
        for piece in &bar.pieces {
            let start = area.min[0] + (piece.stop - piece.length) * scale;
            let width = piece.length * scale;
            page.rect([start, top], [width, BAR], THIN.fill(Color::WHITE));
            let name = &self.classes.of(piece.rod).name;
            if text_width(name, TABLE, Weight::Regular)? + 1.0 < width {
                page.text([start + width / 2.0, top + BAR / 2.0], TABLE, name.as_str())
                    .middle()
                    .vcenter();
            }
            // What the saw takes, at least as wide as a line.
            let cut = start + width;
            if piece.stop < bar.stock_length - self.plan.kerf / 2.0 {
                let blade = Stroke::new((self.plan.kerf * scale).max(0.25));
                page.line([cut, top - 0.8], [cut, top + BAR + 0.8], blade);
            }
        }
        flow.skip(5.4 + BAR + 1.6);
        Ok(())
    }

    /// The line above the picture.
    fn caption(&self, flow: &mut Flow, alike: &Alike) -> Result<(), SheetError> {
        let (bar, first) = (alike.bars.first(), alike.first);
        let (format, settings) = (self.format, self.settings);
        let (area, y) = (flow.area(), flow.y);
        let count = alike.bars.bars.len();
        let numbers = match count {
            1 => settings.say(say::BarNumber { number: first })?,
            _ => settings.say(say::BarNumbers { first, last: first + count - 1 })?,
        };
        let left = settings.say(say::LeftOver {
            length: if bar.left > 0.0 { format.measure(bar.left) } else { String::new() },
            keep: self.plan.keeps(bar),
        })?;
        let diameter = match self.plan.is_mixed() {
            true => format.diameter(bar.diameters),
            false => String::new(),
        };
        let length = format.measure(bar.stock_length);
        let head = settings.say(say::BarHead { count, length, diameter, offcut: bar.at_hand })?;
        let page = flow.page();
        let beside = (text_width(&head, BODY + 0.4, Weight::Bold)? + 4.0).max(42.0);
        page.text([area.min[0], y + BODY + 0.5], BODY + 0.4, head).bold();
        page.text([area.min[0] + beside, y + BODY + 0.5], BODY, numbers);
        page.text([area.max[0], y + BODY + 0.5], BODY, left).end();
        Ok(())
    }
}

/// How many lines come before those of the bars: pieces and stops.
const HEAD_ROWS: usize = 2;

/// One line below the picture of a bar: a cell for each piece.
struct Row {
    name: String,
    weight: Weight,
    cells: Vec<String>,
}

/// A line of cells from one piece on, each `width` mm wide.
fn line(flow: &mut Flow, row: &Row, from: usize, count: usize, width: f64) {
    let (x, y) = (flow.area().min[0], flow.y + TABLE);
    flow.page().text([x, y], SMALL, row.name.as_str());
    for (k, text) in row.cells.iter().skip(from).take(count).enumerate() {
        let right = x + NAMES + width * (k + 1) as f64 - 2.0;
        flow.page().text([right, y], TABLE, text.as_str()).end().weight(row.weight);
    }
    flow.skip(LINE);
}

/// The lines below the picture, broken where there are more pieces than fit.
fn table(flow: &mut Flow, rows: &[Row], pieces: usize) -> Result<(), SheetError> {
    let mut cell: f64 = 0.0;
    for row in rows {
        for text in &row.cells {
            cell = cell.max(text_width(text, TABLE, Weight::Bold)? + 3.0);
        }
    }
    let per_line = (((flow.area().width() - NAMES) / cell) as usize).max(1);
    for from in (0..pieces).step_by(per_line) {
        flow.need(3.0 * LINE);
        for row in rows {
            if LINE > flow.room() {
                flow.turn_page();
                // What the rods of a bar are, and where to stop, stands on every page.
                rows.iter().take(HEAD_ROWS).for_each(|head| line(flow, head, from, per_line, cell));
            }
            line(flow, row, from, per_line, cell);
        }
        flow.skip(1.0);
    }
    flow.skip(2.5);
    Ok(())
}
