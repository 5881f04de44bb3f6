//! The cover: what the model looks like, what to buy, how to read the rest.

use super::format::{counted, fixed};
use super::legend::{CALIBRATION, RULER_WIDTH, calibration_box, ruler, ruler_down, sign};
use super::page::{BODY, Flow, HEADING, Leaf, SMALL};
use super::view::View;
use super::{PaperUnits, SheetError, SheetSettings};
use crate::drawing::font::{LEADING, fit_size, wrap};
use crate::drawing::{Draw, Point, Rect, Weight};
use crate::frame::{Chirality, ContactKind, Frame};
use crate::shop::lengths::{are_mixed, diameters};
use crate::shop::{CutPlan, Side, classes};

/// Least height of the two views, mm.
const LEAST_VIEW: f64 = 55.0;
/// Height of the line below a view, mm.
const CAPTION: f64 = 6.0;
/// Space between columns and blocks, mm.
const GAP: f64 = 6.0;
/// Content at least so wide is set in two columns, mm.
const TWO_COLUMNS: f64 = 150.0;
/// Room at the right for the upright ruler, mm.
const RULER_COLUMN: f64 = RULER_WIDTH + 2.0;
/// How many length classes the cover lists before it points to the cut list.
const LISTED_CLASSES: usize = 6;

/// The cover; more than one page on small paper.
pub(super) fn cover(
    frame: &Frame,
    plan: &CutPlan,
    settings: &SheetSettings,
) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "cover", "Cover");
    let area = flow.area();
    let width = area.width() - RULER_COLUMN;
    let two = width >= TWO_COLUMNS;
    let column = if two { (width - GAP) / 2.0 } else { width };
    let blocks =
        Blocks { facts: facts(frame, plan, settings, column)?, guide: guide(frame, column)? };
    let below = blocks.height(two) + GAP + CALIBRATION[1] + 2.0 * GAP + RULER_WIDTH;
    views(&mut flow, frame, width, below);
    let left = area.min[0];
    if two {
        flow.need(blocks.height(true));
        let y = flow.y;
        blocks.facts.draw(flow.page(), [left, y]);
        blocks.guide.draw(flow.page(), [left + column + GAP, y]);
        flow.skip(blocks.height(true) + GAP);
    } else {
        for block in [&blocks.facts, &blocks.guide] {
            flow.need(block.height);
            let y = flow.y;
            block.draw(flow.page(), [left, y]);
            flow.skip(block.height + GAP);
        }
    }
    checks(&mut flow, width, settings)?;
    Ok(flow.finish(None))
}

/// Isometric view and plan side by side, in what room the rest leaves.
fn views(flow: &mut Flow, frame: &Frame, width: f64, below: f64) {
    let area = flow.area();
    let height = (flow.room() - below - CAPTION).max(LEAST_VIEW);
    let each = (width - GAP) / 2.0;
    let y = flow.y;
    let page = flow.page();
    for (i, (name, view)) in
        [("Isometric view", View::isometric()), ("Plan view", View::plan())].into_iter().enumerate()
    {
        let x = area.min[0] + (each + GAP) * i as f64;
        let n = view.draw(frame, Rect::new([x, y], [each, height]), page);
        page.text([x + each / 2.0, y + height + 4.0], BODY, format!("{name}, 1:{n}")).middle();
    }
    flow.skip(height + CAPTION + 2.0);
}

/// Lines of text, some of them headings, with signs beside them.
struct Block {
    lines: Vec<Line>,
    height: f64,
}

struct Line {
    y: f64,
    text: String,
    style: Style,
    indent: f64,
    sign: Option<Side>,
}

#[derive(Clone, Copy)]
enum Style {
    Heading,
    Text,
    /// In bold, of this size.
    Example(f64),
}

impl Block {
    fn new() -> Self {
        Self { lines: Vec::new(), height: 0.0 }
    }

    fn heading(&mut self, text: &str) {
        if self.height > 0.0 {
            self.height += 2.0;
        }
        let y = self.height + HEADING;
        let text = text.to_owned();
        self.lines.push(Line { y, text, style: Style::Heading, indent: 0.0, sign: None });
        self.height += HEADING * 1.5;
    }

    fn text(&mut self, text: &str, width: f64) -> Result<(), SheetError> {
        self.signed(text, width, 0.0, None)
    }

    /// A line that is not broken, in bold.
    fn verbatim(&mut self, text: &str, width: f64) -> Result<(), SheetError> {
        let y = self.height + BODY;
        let text = text.to_owned();
        let style = Style::Example(fit_size(&text, BODY, Weight::Bold, width)?);
        self.lines.push(Line { y, text, style, indent: 0.0, sign: None });
        self.height += BODY * LEADING + 0.8;
        Ok(())
    }

    /// Text with the sign of an over or under mark to its left.
    fn signed(
        &mut self,
        text: &str,
        width: f64,
        indent: f64,
        sign: Option<Side>,
    ) -> Result<(), SheetError> {
        for (i, text) in wrap(text, BODY, Weight::Regular, width - indent)?.into_iter().enumerate()
        {
            let y = self.height + BODY;
            let sign = if i == 0 { sign } else { None };
            self.lines.push(Line { y, text, style: Style::Text, indent, sign });
            self.height += BODY * LEADING;
        }
        self.height += 0.8;
        Ok(())
    }

    fn draw(&self, out: &mut impl Draw, [x, y]: Point) {
        for line in &self.lines {
            let at = [x + line.indent, y + line.y];
            if let Some(side) = line.sign {
                sign(out, [x + 4.0, at[1] - BODY * 0.36], "a", side);
            }
            match line.style {
                Style::Heading => drop(out.text(at, HEADING, line.text.as_str()).bold()),
                Style::Example(size) => drop(out.text(at, size, line.text.as_str()).bold()),
                Style::Text => drop(out.text(at, BODY, line.text.as_str())),
            }
        }
    }
}

struct Blocks {
    facts: Block,
    guide: Block,
}

impl Blocks {
    fn height(&self, two: bool) -> f64 {
        if two {
            self.facts.height.max(self.guide.height)
        } else {
            self.facts.height + GAP + self.guide.height
        }
    }
}

fn facts(
    frame: &Frame,
    plan: &CutPlan,
    settings: &SheetSettings,
    width: f64,
) -> Result<Block, SheetError> {
    let units = settings.units;
    let mut block = Block::new();
    block.heading("The model");
    let [w, d, h] = size(frame).map(|side| units.length(side));
    block.text(&format!("{w} × {d} × {h} {} (wide × deep × high)", units.name()), width)?;
    let rods = counted(frame.rods.len(), "rod");
    let contacts = counted(frame.contacts.len(), "contact");
    let feet = match frame.supports.len() {
        1 => "1 foot".to_owned(),
        n => format!("{n} feet"),
    };
    block.text(&format!("{rods}, {contacts}, {feet}"), width)?;
    if are_mixed(frame) {
        block.text(&counts(frame, units), width)?;
    }
    let turning = |c: Chirality| frame.units.iter().filter(|u| u.chirality == c).count();
    let (cw, ccw) = (turning(Chirality::Clockwise), turning(Chirality::CounterClockwise));
    let runs = match (cw, ccw) {
        (0, _) => "all run counter-clockwise, seen from outside".to_owned(),
        (_, 0) => "all run clockwise, seen from outside".to_owned(),
        _ => format!("{cw} run clockwise and {ccw} counter-clockwise, seen from outside"),
    };
    block.text(&format!("{}; {runs}", counted(frame.units.len(), "unit")), width)?;

    block.heading("To buy");
    for bars in plan.shopping() {
        let (length, diameter) = (units.measure(bars.length), units.diameter(bars.diameters));
        let each = bars.price.map_or_else(String::new, |p| format!(", {} each", fixed(p, 2)));
        let line = format!("{} × {length}, Ø {diameter}, round{each}", bars.count);
        block.text(&line, width)?;
    }
    for bars in plan.taken() {
        let (length, diameter) = (units.measure(bars.length), units.diameter(bars.diameters));
        let noun = if bars.count == 1 { "offcut" } else { "offcuts" };
        block.text(&format!("and {} {noun} of {length}, Ø {diameter}", bars.count), width)?;
    }
    if let Some(cost) = plan.cost() {
        block.text(&format!("cost {}", fixed(cost, 2)), width)?;
    }
    block.text(
        &match plan.bars.is_empty() {
            true => "nothing: all rods are sawn".into(),
            false => format!("{} of rod in all", units.total(plan.used())),
        },
        width,
    )?;

    let classes = classes(frame);
    block.heading("Lengths");
    for class in classes.iter().take(LISTED_CLASSES) {
        let length = units.measure(class.length);
        let mut line = format!("class {}: {} × {length}", class.name, class.rods.len());
        if are_mixed(frame) {
            line = format!("{line}, Ø {}", units.diameter(class.diameters));
        }
        block.text(&line, width)?;
    }
    if let more @ 1.. = classes.len().saturating_sub(LISTED_CLASSES) {
        block.text(&format!("and {more} more: see the cut list"), width)?;
    }
    if !settings.notes.is_empty() {
        block.heading("Notes");
        for note in &settings.notes {
            block.text(note, width)?;
        }
    }
    Ok(block)
}

/// How many rods there are of each diameter.
fn counts(frame: &Frame, units: PaperUnits) -> String {
    let count = |(ends, n): ([f64; 2], usize)| format!("{n} of {}", units.diameter(ends));
    let counts: Vec<String> = diameters(frame).into_iter().map(count).collect();
    format!("{} diameter", counts.join(", "))
}

/// Width, depth and height over the rods' surfaces, from the ground up, mm.
fn size(frame: &Frame) -> [f64; 3] {
    let [lo, hi] = frame.bounds();
    if frame.rods.is_empty() {
        return [0.0; 3];
    }
    let w = frame.thickest();
    [hi.x - lo.x + w, hi.y - lo.y + w, hi.z + w / 2.0 - frame.ground.min(lo.z)]
}

fn guide(frame: &Frame, width: f64) -> Result<Block, SheetError> {
    let mut block = Block::new();
    block.heading("How to read a rod card");
    block.text("Lay the rod with its numbered end, end A, at the black triangle.", width)?;
    let indent = 9.5;
    block.signed(
        "O, whole line: this rod lies over its partner, on the outer side.",
        width,
        indent,
        Some(Side::Over),
    )?;
    block.signed(
        "U, broken line: this rod lies under its partner.",
        width,
        indent,
        Some(Side::Under),
    )?;
    let end = frame.contacts.iter().find_map(|c| match c.kind {
        ContactKind::End([end, _]) => Some(end),
        ContactKind::Cross => None,
    });
    if let Some(end) = end {
        let text =
            "E: this rod's end meets an end of its partner; join them with a sleeve or tape.";
        block.signed(text, width, indent, Some(Side::Meets(end)))?;
    }
    block.text("Below the rod, a line for every mark:", width)?;
    block.verbatim("b   112.4   U   R009 c @ 118.3   41.2°   clock 187.0°   ends", width)?;
    block.text(
        "Mark b, 112.4 from end A; this rod lies under rod R009, at mark c of that rod, 118.3 \
         from its own end A; they cross at 41.2°.",
        width,
    )?;
    block.text(
        "clock: look along the rod from end A; this far clockwise from the first mark sits \
         the partner.",
        width,
    )?;
    block.text("ends: the rod ends there; passes: it goes on.", width)?;
    Ok(block)
}

/// Calibration box and rulers: is the print true to scale?
fn checks(flow: &mut Flow, width: f64, settings: &SheetSettings) -> Result<(), SheetError> {
    let units = settings.units;
    flow.need(CALIBRATION[1] + GAP + RULER_WIDTH);
    let area = flow.area();
    let left = area.min[0];
    // At the foot of the page: there the box is easy to find.
    let y = area.max[1] - CALIBRATION[1] - GAP - RULER_WIDTH;
    let page = flow.page();
    calibration_box(page, [left, y]);
    let text = "Is the print true to size? Print at 100 %, not fitted to the page, then measure \
                the box and the rulers. If they are off, all strips and maps are off.";
    let room = width - CALIBRATION[0] - GAP;
    let inside = room < 40.0;
    let (x, room, size) = if inside {
        (left + 4.0, CALIBRATION[0] - 10.0, SMALL)
    } else {
        (left + CALIBRATION[0] + GAP, room, BODY)
    };
    let lines = wrap(text, size, Weight::Regular, room)?;
    let top = y + if inside { 8.0 } else { size };
    page.text_lines([x, top], size, size * LEADING, Default::default(), lines);
    ruler(page, [left, area.max[1] - RULER_WIDTH], area.width() - RULER_COLUMN, units);
    let down = [area.max[0], area.min[1]];
    ruler_down(page, down, area.height(), units);
    Ok(())
}
