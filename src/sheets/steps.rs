//! The steps of assembly: a picture each, and beside it the new rods and what to do.

use super::page::{BODY, Flow, HEADING, Leaf, SMALL, THIN, area};
use super::step_picture::{Around, Scene};
use super::step_text::{StepText, Writer, guide, say};
use super::step_views::sides;
use super::{SheetError, SheetSettings};
use crate::drawing::font::{LEADING, text_width, wrap};
use crate::drawing::{Draw, DrawingError, Item, Placement, Point, Stroke, Weight};
use crate::frame::Frame;
use crate::ids::{IdVec, RodId};
use crate::shop::classes;
use crate::shop::order::Assembly;

/// Share of the page's width that a picture takes.
const PICTURE: f64 = 0.63;
/// Space between the picture and the text, mm.
const GAP: f64 = 4.0;
/// Space below a step, mm.
const BELOW: f64 = 3.0;
/// Height of the title of a step, mm.
const TITLE: f64 = HEADING * 1.6;
/// Least height of a picture, mm: lower, and numbers have no room.
const LEAST: f64 = 62.0;
/// The most steps one below the other on a page.
const ROWS: usize = 3;
/// Space round the list of new rods, mm.
const PAD: f64 = 1.2;
/// Radius of the arrow that says that the view has turned, mm.
const TURN: f64 = 4.0;

/// The pages of the steps.
pub(super) fn steps(
    frame: &Frame,
    assembly: &Assembly,
    settings: &SheetSettings,
) -> Result<Vec<Leaf>, SheetError> {
    if assembly.steps.is_empty() {
        return Ok(Vec::new());
    }
    let mut flow = Flow::new(settings, "steps", &settings.say(say::Title {})?);
    for paragraph in guide(assembly, settings)? {
        flow.paragraph(&paragraph)?;
    }
    let width = flow.area().width();
    let sides = sides(frame, assembly);
    let scene = |rows: usize| {
        let height = (area(settings).height() - HEADROOM) / rows as f64 - TITLE - BELOW;
        let size = [width * PICTURE, height.max(LEAST)];
        (Scene::new(frame, &sides, size), size)
    };
    // As many as show the whole frame legibly, but two where none does.
    let (scene, size) =
        (2..=ROWS).rev().map(scene).find(|(s, _)| s.is_whole()).unwrap_or_else(|| scene(2));
    let classes = classes(frame);
    let writer = Writer { frame, classes: &classes, settings, count: assembly.steps.len() };
    let placed = placed(frame, assembly);
    for (number, (step, props)) in assembly.steps.iter().zip(assembly.standing()).enumerate() {
        let walk = if number == 0 { 0.0 } else { sides[number].walk_from(sides[number - 1]) };
        let around = Around { placed: &placed, number, props: &props };
        let picture = scene.picture(step, sides[number], &around)?;
        let text = Column::new(&writer.step(number, step, walk)?, width - size[0] - GAP)?;
        let height = size[1].max(text.height) + TITLE + BELOW;
        flow.need(height);
        let corner = [flow.area().min[0], flow.y];
        block(&mut flow, &picture, &text, walk, size);
        text.draw(flow.page(), [corner[0] + size[0] + GAP, corner[1] + TITLE]);
        flow.skip(height);
    }
    Ok(flow.finish(None))
}

/// What the guide above the first step takes, mm: so much smaller are all pictures, and as
/// many fit on the first page as on the others.
const HEADROOM: f64 = 26.0;

/// The step in which each rod is placed.
fn placed(frame: &Frame, assembly: &Assembly) -> IdVec<RodId, usize> {
    let mut placed: IdVec<RodId, usize> = vec![usize::MAX; frame.rods.len()].into();
    for (number, step) in assembly.steps.iter().enumerate() {
        step.rods.iter().for_each(|&rod| placed[rod] = number);
    }
    placed
}

/// The title, the picture, and the arrow where the view has turned.
fn block(flow: &mut Flow, picture: &[Item], text: &Column, walk: f64, size: [f64; 2]) {
    let [left, right] = [flow.area().min[0], flow.area().max[0]];
    let top = flow.y;
    let page = flow.page();
    page.line([left, top], [right, top], THIN);
    page.text([left, top + HEADING * 1.2], HEADING, text.title.as_str()).bold();
    page.place(picture, &Placement::at([left, top + TITLE]));
    if walk != 0.0 {
        turn_arrow(page, [left + size[0] - 2.0 * TURN, top + TITLE + 2.0 * TURN], walk);
    }
}

/// An arrow round an upright axis, as one walks.
fn turn_arrow(out: &mut impl Draw, center: Point, walk: f64) {
    let pen = Stroke::new(0.6);
    // Seen from above, who walks to the right goes counter-clockwise round what he looks at,
    // along the near side from left to right.
    let (from, sweep) = if walk > 0.0 { (200.0, -220.0) } else { (-20.0, 220.0) };
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [center[0] + TURN * cos, center[1] + TURN * sin]
    };
    out.arc(center, TURN, from, sweep, pen);
    let tip = at(from + sweep);
    let before = at(from + sweep * 0.93);
    out.arrow_head(tip, [tip[0] - before[0], tip[1] - before[1]], 2.4, pen);
    out.circle(center, 0.8, pen.color);
}

/// The text beside a picture, laid out.
struct Column {
    title: String,
    lines: Vec<(Point, f64, Weight, String)>,
    /// Of the part with the new rods.
    box_height: f64,
    width: f64,
    height: f64,
}

impl Column {
    fn new(text: &StepText, width: f64) -> Result<Self, DrawingError> {
        let title = text.title.clone();
        let mut column = Self { title, lines: Vec::new(), box_height: 0.0, width, height: PAD };
        for part in &text.parts {
            let y = column.height + BODY;
            let number = format!("{}  ", part.number);
            let room = text_width(&number, BODY, Weight::Bold)?;
            column.lines.push(([PAD, y], BODY, Weight::Bold, number));
            let beside = text_width(&part.facts, BODY, Weight::Regular)?;
            if room + beside <= width - 2.0 * PAD {
                column.lines.push(([PAD + room, y], BODY, Weight::Regular, part.facts.clone()));
                column.height += BODY * LEADING;
            } else {
                column.height += BODY * LEADING;
                column.wrapped(&part.facts, SMALL, PAD, width - PAD)?;
            }
            column.wrapped(&part.contacts, SMALL, 3.0 + PAD, width - PAD)?;
            column.height += 0.6;
        }
        column.box_height = column.height + 0.4;
        column.height += 2.2;
        for note in &text.notes {
            column.wrapped(note, SMALL, 0.0, width)?;
            column.height += 0.6;
        }
        Ok(column)
    }

    fn wrapped(
        &mut self,
        text: &str,
        size: f64,
        indent: f64,
        width: f64,
    ) -> Result<(), DrawingError> {
        for line in wrap(text, size, Weight::Regular, width - indent)? {
            self.lines.push(([indent, self.height + size], size, Weight::Regular, line));
            self.height += size * LEADING;
        }
        Ok(())
    }

    fn draw(&self, out: &mut impl Draw, [x, y]: Point) {
        out.rect([x, y], [self.width, self.box_height], THIN);
        for (at, size, weight, line) in &self.lines {
            if !line.trim().is_empty() {
                out.text([x + at[0], y + at[1]], *size, line.trim_end()).weight(*weight);
            }
        }
    }
}
