//! The cut list: length classes, and which pieces are sawn from which bar.

use super::PaperUnits;
use super::format::{counted, fixed, percent};
use super::page::{BODY, Column, Flow, Leaf, SMALL, TABLE, THIN, Table};
use super::{SheetError, SheetSettings};
use crate::drawing::font::text_width;
use crate::drawing::{Color, Draw, DrawingError, Stroke, Weight};
use crate::frame::Frame;
use crate::ids::RodId;
use crate::shop::{Aim, Bar, BarGroup, CutPlan, LengthClasses, Purchase, classes};

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
    let mut flow = Flow::new(settings, "cut-list", "Cut list and sawing plan");
    let classes = classes(frame);
    flow.heading("Rods by length", 20.0);
    flow.table(&class_table(&classes, plan.is_mixed(), settings))?;
    flow.heading("Sawing plan", 40.0);
    let saw = Saw { plan, classes: &classes, units: flow.units() };
    saw.summary(&mut flow, settings.density)?;
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
    units: PaperUnits,
}

/// Bars that are sawn alike, and the number of the first of them.
struct Alike<'a> {
    first: usize,
    bars: BarGroup<'a>,
}

/// The length classes, with their diameters where rods have several.
fn class_table(classes: &LengthClasses, mixed: bool, settings: &SheetSettings) -> Table {
    let units = settings.units;
    let names = |rods: &[RodId]| rods.iter().map(RodId::to_string).collect::<Vec<_>>().join(" ");
    let rows = classes
        .iter()
        .map(|c| {
            let count = c.rods.len();
            let total = units.total(c.length * count as f64);
            let mut row = vec![c.name.clone(), units.length(c.length), count.to_string(), total];
            row.extend(mixed.then(|| units.diameter(c.diameters)));
            row.push(names(&c.rods));
            row
        })
        .collect();
    let mut columns = vec![
        Column::text("class"),
        Column::figure("length"),
        Column::figure("count"),
        Column::figure("total"),
    ];
    columns.extend(mixed.then(|| Column::figure("Ø")));
    columns.push(Column::wrapped("rods"));
    Table { columns, rows }
}

impl Saw<'_> {
    /// What is bought and sawn, how good the plan is, and how to read it.
    fn summary(&self, flow: &mut Flow, density: f64) -> Result<(), DrawingError> {
        let Self { plan, units, .. } = *self;
        if plan.bars.is_empty() {
            return flow.paragraph("Nothing: all rods are sawn.");
        }
        let trim = if plan.trim > 0.0 {
            format!("; {} trimmed off both ends of every bar", units.measure(plan.trim))
        } else {
            String::new()
        };
        flow.paragraph(&format!(
            "{} from {} ({}). {}, each {} wide{trim}. {} of rod, {} kg at {density} kg/m³; waste {}.",
            counted(plan.pieces(), "piece"),
            counted(plan.bars.len(), "bar"),
            self.bars(),
            counted(plan.cuts(), "saw cut"),
            units.measure(plan.kerf),
            units.total(plan.used()),
            weight(plan.weight(density)),
            percent(plan.waste()),
        ))?;
        flow.paragraph(&self.worth())?;
        let kept = plan.kept();
        if !kept.is_empty() {
            flow.paragraph(&format!("Left-overs to keep: {}.", self.list(&kept)))?;
        }
        flow.paragraph(
            "Stops are measured from the bar's end to the end of the piece; the saw cuts just \
             beyond. Write its number on end A of each rod as it comes off.",
        )
    }

    /// The bars that are bought, and the offcuts that are used.
    fn bars(&self) -> String {
        let taken = self.plan.taken();
        let bought = self.list(&self.plan.shopping());
        match (bought.is_empty(), taken.is_empty()) {
            (_, true) => bought,
            (true, false) => format!("offcuts {}", self.list(&taken)),
            (false, false) => format!("{bought}, and offcuts {}", self.list(&taken)),
        }
    }

    fn list(&self, bars: &[Purchase]) -> String {
        let one = |p: &Purchase| {
            let of = if self.plan.is_mixed() {
                format!(" of Ø {}", self.units.diameter(p.diameters))
            } else {
                String::new()
            };
            format!("{} × {}{of}", p.count, self.units.measure(p.length))
        };
        bars.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// How good the plan is.
    fn worth(&self) -> String {
        let Self { plan, units, .. } = *self;
        let bars = |n: f64| counted(n as usize, "bar");
        let (spent, least) = match plan.aim {
            Aim::Bars => {
                let spent = bars(plan.spent);
                (format!("{spent} to buy"), format!("needs fewer than {}", bars(plan.least)))
            }
            Aim::Length => {
                let [spent, least] = [plan.spent, plan.least].map(|mm| units.total(mm));
                (format!("{spent} of bars to buy"), format!("needs less than {least}"))
            }
            Aim::Cost => {
                let [spent, least] = [plan.spent, plan.least].map(|cost| fixed(cost, 2));
                (format!("Cost {spent}"), format!("costs less than {least}"))
            }
        };
        if plan.is_proven() {
            format!("{spent}; no plan {least}: this is the best possible.")
        } else {
            format!("{spent}; no plan {least}, and whether one between is possible is not known.")
        }
    }

    /// Bars that are sawn alike: a picture, the stops, and the rods of each bar.
    fn alike(&self, flow: &mut Flow, alike: &Alike) -> Result<(), DrawingError> {
        let (bar, units) = (alike.bars.first(), self.units);
        let mut rows = Vec::new();
        let mut row =
            |name: String, weight: Weight, text: &dyn Fn(&Bar, usize) -> String, of: &Bar| {
                let cells = (0..of.pieces.len()).map(|i| text(of, i)).collect();
                rows.push(Row { name, weight, cells });
            };
        let piece = |b: &Bar, i: usize| {
            let name = &self.classes.of(b.pieces[i].rod).name;
            format!("{name} {}", units.length(b.pieces[i].length))
        };
        row("piece".to_owned(), Weight::Regular, &piece, bar);
        row("stop at".to_owned(), Weight::Bold, &|b, i| units.length(b.pieces[i].stop), bar);
        for (n, bar) in alike.bars.bars.iter().enumerate() {
            let name = format!("bar {}", alike.first + n);
            row(name, Weight::Regular, &|b, i| b.pieces[i].rod.to_string(), bar);
        }
        // The picture stays with the first stops and rods.
        flow.need(7.0 + BAR + 4.0 * LINE);
        self.picture(flow, alike)?;
        table(flow, &rows, bar.pieces.len())
    }

    /// How many bars, and a bar to scale with the classes of its pieces.
    fn picture(&self, flow: &mut Flow, alike: &Alike) -> Result<(), DrawingError> {
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
    fn caption(&self, flow: &mut Flow, alike: &Alike) -> Result<(), DrawingError> {
        let (bar, units, first) = (alike.bars.first(), self.units, alike.first);
        let (area, y) = (flow.area(), flow.y);
        let count = alike.bars.bars.len();
        let numbers = match count {
            1 => format!("bar {first}"),
            _ => format!("bars {first} to {}", first + count - 1),
        };
        let left = match (bar.left > 0.0, self.plan.keeps(bar)) {
            (true, true) => format!("keep the {} left over", units.measure(bar.left)),
            (true, false) => format!("left over {}", units.measure(bar.left)),
            (false, _) => "nothing left over".to_owned(),
        };
        let page = flow.page();
        let mut head = format!("{count} × {}", units.measure(bar.stock_length));
        if self.plan.is_mixed() {
            head = format!("{head}, Ø {}", units.diameter(bar.diameters));
        }
        if bar.at_hand {
            head = format!("{head}, offcut{}", if count == 1 { "" } else { "s" });
        }
        let beside = (text_width(&head, BODY + 0.4, Weight::Bold)? + 4.0).max(42.0);
        page.text([area.min[0], y + BODY + 0.5], BODY + 0.4, head).bold();
        page.text([area.min[0] + beside, y + BODY + 0.5], BODY, numbers);
        page.text([area.max[0], y + BODY + 0.5], BODY, left).end();
        Ok(())
    }
}

/// A weight in kg to three figures or so.
fn weight(kg: f64) -> String {
    let decimals = match kg {
        ..1.0 => 3,
        ..10.0 => 2,
        _ => 1,
    };
    fixed(kg, decimals)
}

/// One line below the picture of a bar: a cell for each piece.
struct Row {
    name: String,
    weight: Weight,
    cells: Vec<String>,
}

/// The lines below the picture, broken where there are more pieces than fit.
fn table(flow: &mut Flow, rows: &[Row], pieces: usize) -> Result<(), DrawingError> {
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
            flow.need(LINE);
            let (x, y) = (flow.area().min[0], flow.y + TABLE);
            flow.page().text([x, y], SMALL, row.name.as_str());
            for (k, text) in row.cells.iter().skip(from).take(per_line).enumerate() {
                let right = x + NAMES + cell * (k + 1) as f64 - 2.0;
                flow.page().text([right, y], TABLE, text.as_str()).end().weight(row.weight);
            }
            flow.skip(LINE);
        }
        flow.skip(1.0);
    }
    flow.skip(2.5);
    Ok(())
}
