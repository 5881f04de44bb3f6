//! The cover: what the model looks like, what to buy, how to read the rest.

use super::legend::{CALIBRATION, RULER_WIDTH, calibration_box, ruler, ruler_down, sign};
use super::page::{BODY, Flow, HEADING, Leaf, SMALL};
use super::text::TextError;
use super::text::message::messages;
use super::view::View;
use super::{SheetError, SheetSettings};
use crate::drawing::font::{LEADING, fit_size, wrap};
use crate::drawing::{Draw, Point, Rect, Weight};
use crate::frame::{Chirality, ContactKind, Frame};
use crate::shop::lengths::{are_mixed, diameters};
use crate::shop::{CutPlan, Side, classes};

messages! {
    mod say in "cover.toml" {
        "title" => Title {}
        "isometric-view" => Isometric { scale: String }
        "plan-view" => Plan { scale: String }
        "model" => Model {}
        "size" => Size { width: String, depth: String, height: String, unit: String }
        "parts" => Parts { rods: usize, contacts: usize, feet: usize }
        "diameters" => Diameters { list: String }
        "diameter" => Diameter { count: usize, diameter: String }
        "units" => Units { units: usize, clockwise: usize, counter_clockwise: usize }
        "to-buy" => ToBuy {}
        "bars" => Bars { count: usize, length: String, diameter: String, price: String }
        "offcuts" => Offcuts { count: usize, length: String, diameter: String }
        "cost" => Cost { cost: String }
        "all-sawn" => AllSawn {}
        "rod-in-all" => RodInAll { total: String }
        "lengths" => Lengths {}
        "class" => Class { name: String, count: usize, length: String, diameter: String }
        "more-classes" => MoreClasses { count: usize }
        "notes" => Notes {}
        "guide" => Guide {}
        "guide-lay" => GuideLay {}
        "guide-over" => GuideOver {}
        "guide-under" => GuideUnder {}
        "guide-end" => GuideEnd {}
        "guide-lines" => GuideLines {}
        "guide-example" => GuideExample { at: String, mate: String, angle: String, clock: String }
        "guide-explained" => GuideExplained { at: String, mate: String, angle: String }
        "guide-clock" => GuideClock {}
        "guide-ends" => GuideEnds {}
        "check" => Check {}
    }
}

/// The line of a rod card that is explained: where the mark is on the rod and on its partner,
/// mm, and at which angles they cross and the partner sits, degrees.
const EXAMPLE_MARKS: [f64; 2] = [112.4, 118.3];
const EXAMPLE_ANGLES: [f64; 2] = [41.2, 187.0];

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
    let mut flow = Flow::new(settings, "cover", &settings.say(say::Title {})?);
    let area = flow.area();
    let width = area.width() - RULER_COLUMN;
    let two = width >= TWO_COLUMNS;
    let column = if two { (width - GAP) / 2.0 } else { width };
    let blocks = Blocks {
        facts: facts(frame, plan, settings, column)?,
        guide: guide(frame, settings, column)?,
    };
    let below = blocks.height(two) + GAP + CALIBRATION[1] + 2.0 * GAP + RULER_WIDTH;
    views(&mut flow, frame, width, below, settings)?;
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
fn views(
    flow: &mut Flow,
    frame: &Frame,
    width: f64,
    below: f64,
    settings: &SheetSettings,
) -> Result<(), SheetError> {
    let format = settings.format();
    let area = flow.area();
    let height = (flow.room() - below - CAPTION).max(LEAST_VIEW);
    let each = (width - GAP) / 2.0;
    let y = flow.y;
    let page = flow.page();
    for (i, view) in [View::isometric(), View::plan()].into_iter().enumerate() {
        let x = area.min[0] + (each + GAP) * i as f64;
        let n = view.draw(frame, Rect::new([x, y], [each, height]), page);
        let scale = format.plain(n);
        let caption = match i {
            0 => settings.say(say::Isometric { scale })?,
            _ => settings.say(say::Plan { scale })?,
        };
        page.text([x + each / 2.0, y + height + 4.0], BODY, caption).middle();
    }
    flow.skip(height + CAPTION + 2.0);
    Ok(())
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
    let mut block = Block::new();
    model(frame, settings, width, &mut block)?;
    shopping(plan, settings, width, &mut block)?;
    lengths(frame, settings, width, &mut block)?;
    if !settings.notes.is_empty() {
        block.heading(&settings.say(say::Notes {})?);
        for note in &settings.notes {
            block.text(note, width)?;
        }
    }
    Ok(block)
}

/// Size and numbers.
fn model(
    frame: &Frame,
    settings: &SheetSettings,
    room: f64,
    block: &mut Block,
) -> Result<(), SheetError> {
    let format = settings.format();
    block.heading(&settings.say(say::Model {})?);
    let [width, depth, height] = size(frame).map(|side| format.length(side));
    let unit = settings.units.name().to_owned();
    block.text(&settings.say(say::Size { width, depth, height, unit })?, room)?;
    let [rods, contacts] = [frame.rods.len(), frame.contacts.len()];
    let feet = frame.supports.len();
    block.text(&settings.say(say::Parts { rods, contacts, feet })?, room)?;
    if are_mixed(frame) {
        let count = |(ends, count): ([f64; 2], usize)| {
            settings.say(say::Diameter { count, diameter: format.diameter(ends) })
        };
        let list: Vec<String> =
            diameters(frame).into_iter().map(count).collect::<Result<_, _>>()?;
        block.text(&settings.say(say::Diameters { list: list.join(", ") })?, room)?;
    }
    let turning = |c: Chirality| frame.units.iter().filter(|u| u.chirality == c).count();
    let (clockwise, counter_clockwise) =
        (turning(Chirality::Clockwise), turning(Chirality::CounterClockwise));
    let units = frame.units.len();
    block.text(&settings.say(say::Units { units, clockwise, counter_clockwise })?, room)
}

/// What to buy and what to take.
fn shopping(
    plan: &CutPlan,
    settings: &SheetSettings,
    width: f64,
    block: &mut Block,
) -> Result<(), SheetError> {
    let format = settings.format();
    block.heading(&settings.say(say::ToBuy {})?);
    for line in bought(plan, settings)? {
        block.text(&line, width)?;
    }
    if let Some(cost) = plan.cost() {
        block.text(&settings.say(say::Cost { cost: format.fixed(cost, 2) })?, width)?;
    }
    let total = match plan.bars.is_empty() {
        true => settings.say(say::AllSawn {})?,
        false => settings.say(say::RodInAll { total: format.total(plan.used()) })?,
    };
    block.text(&total, width)
}

/// The bars to buy, and the offcuts to take, a line each.
pub(super) fn bought(plan: &CutPlan, settings: &SheetSettings) -> Result<Vec<String>, TextError> {
    let format = settings.format();
    let mut lines = Vec::new();
    for bars in plan.shopping() {
        lines.push(settings.say(say::Bars {
            count: bars.count,
            length: format.measure(bars.length),
            diameter: format.diameter(bars.diameters),
            price: bars.price.map_or_else(String::new, |p| format.fixed(p, 2)),
        })?);
    }
    for bars in plan.taken() {
        let (length, diameter) = (format.measure(bars.length), format.diameter(bars.diameters));
        lines.push(settings.say(say::Offcuts { count: bars.count, length, diameter })?);
    }
    Ok(lines)
}

/// The length classes, if they are few.
fn lengths(
    frame: &Frame,
    settings: &SheetSettings,
    width: f64,
    block: &mut Block,
) -> Result<(), SheetError> {
    let (format, classes, mixed) = (settings.format(), classes(frame), are_mixed(frame));
    block.heading(&settings.say(say::Lengths {})?);
    for class in classes.iter().take(LISTED_CLASSES) {
        let line = say::Class {
            name: class.name.clone(),
            count: class.rods.len(),
            length: format.measure(class.length),
            diameter: if mixed { format.diameter(class.diameters) } else { String::new() },
        };
        block.text(&settings.say(line)?, width)?;
    }
    if let count @ 1.. = classes.len().saturating_sub(LISTED_CLASSES) {
        block.text(&settings.say(say::MoreClasses { count })?, width)?;
    }
    Ok(())
}

/// Width, depth and height over the rods' surfaces, from the ground up, mm.
pub(super) fn size(frame: &Frame) -> [f64; 3] {
    let [lo, hi] = frame.bounds();
    if frame.rods.is_empty() {
        return [0.0; 3];
    }
    let w = frame.thickest();
    [hi.x - lo.x + w, hi.y - lo.y + w, hi.z + w / 2.0 - frame.ground.min(lo.z)]
}

fn guide(frame: &Frame, settings: &SheetSettings, width: f64) -> Result<Block, SheetError> {
    let mut block = Block::new();
    block.heading(&settings.say(say::Guide {})?);
    block.text(&settings.say(say::GuideLay {})?, width)?;
    let indent = 9.5;
    block.signed(&settings.say(say::GuideOver {})?, width, indent, Some(Side::Over))?;
    block.signed(&settings.say(say::GuideUnder {})?, width, indent, Some(Side::Under))?;
    let end = frame.contacts.iter().find_map(|c| match c.kind {
        ContactKind::End([end, _]) => Some(end),
        ContactKind::Cross => None,
    });
    if let Some(end) = end {
        block.signed(&settings.say(say::GuideEnd {})?, width, indent, Some(Side::Meets(end)))?;
    }
    block.text(&settings.say(say::GuideLines {})?, width)?;
    let format = settings.format();
    let [at, mate] = EXAMPLE_MARKS.map(|at| format.length(at));
    let [angle, clock] = EXAMPLE_ANGLES.map(|degrees: f64| format.angle(degrees.to_radians()));
    let example =
        say::GuideExample { at: at.clone(), mate: mate.clone(), angle: angle.clone(), clock };
    block.verbatim(&settings.say(example)?, width)?;
    block.text(&settings.say(say::GuideExplained { at, mate, angle })?, width)?;
    block.text(&settings.say(say::GuideClock {})?, width)?;
    block.text(&settings.say(say::GuideEnds {})?, width)?;
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
    calibration_box(page, [left, y], settings)?;
    let text = settings.say(say::Check {})?;
    let room = width - CALIBRATION[0] - GAP;
    let inside = room < 40.0;
    let (x, room, size) = if inside {
        (left + 4.0, CALIBRATION[0] - 10.0, SMALL)
    } else {
        (left + CALIBRATION[0] + GAP, room, BODY)
    };
    let lines = wrap(&text, size, Weight::Regular, room)?;
    let top = y + if inside { 8.0 } else { size };
    page.text_lines([x, top], size, size * LEADING, Default::default(), lines);
    ruler(page, [left, area.max[1] - RULER_WIDTH], area.width() - RULER_COLUMN, units);
    let down = [area.max[0], area.min[1]];
    ruler_down(page, down, area.height(), units);
    Ok(())
}
