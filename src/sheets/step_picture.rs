//! The picture of a step: what is new in black with its numbers, what lies already in grey.

use super::line_picture::{Line, covered};
use super::page::{SMALL, THIN};
use super::step_labels::{Label, placed};
use super::step_views::ViewSide;
use super::view::View;
use crate::drawing::{
    Color, Dash, Draw, DrawingError, Item, Point, Rect, Stroke, Text, clip, within,
};
use crate::frame::Frame;
use crate::ids::{Id, IdVec, RodId};
use crate::shop::order::{Prop, Step};
use crate::shop::{marks, order::MarkName};
use crate::surface::bvh::{Aabb, Bvh};
use crate::surface::hull::convex_hull;
use crate::surface::{Point3, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// Where rods are at least so long on paper in the mean, mm, the whole frame is shown: their
/// numbers fit beside them.
const LEGIBLE: f64 = 12.0;
/// Length of rods in the mean where only a part is shown, mm.
const PART: f64 = 18.0;
/// Thinnest line of a new rod, mm.
const NEW: f64 = 0.6;
/// Rods that lie already: at half strength.
const EARLIER: Color = Color::grey(150);
/// Sides of the small picture that shows where a part of the frame is, mm.
const KEY: [f64; 2] = [26.0, 20.0];
/// Radius of the dot at end A of a new rod, mm.
const END_DOT: f64 = 0.85;
/// A prop.
const PROP: Stroke = Stroke::new(0.5).color(Color::DARK_GREY).dash(Dash::new([1.6, 0.7]));
/// Half the width of the foot of a prop, mm.
const PROP_FOOT: f64 = 1.4;
/// Between the two marks of a distance to be measured.
const MEASURE: Stroke = Stroke::new(0.2).color(Color::DARK_GREY).dash(Dash::DOTTED);
/// Behind the number of the rod that closes a circuit.
pub(super) const CLOSES: &str = "*";
/// Before the number of a rod to be lifted.
pub(super) const LIFTED: &str = "↑";

/// All that steps show, on paper but for where it lies.
pub(super) struct Scene<'a> {
    frame: &'a Frame,
    room: [f64; 2],
    /// n of the scale 1:n.
    scale: f64,
    /// Whether the whole frame fits.
    whole: bool,
    aspects: BTreeMap<ViewSide, Aspect>,
}

/// The frame from one side.
struct Aspect {
    view: View,
    extent: Rect,
    lines: IdVec<RodId, Line>,
    /// What each rod loses to nearer ones, as shares of it.
    behind: IdVec<RodId, Vec<(RodId, [f64; 2])>>,
    /// Outline of all rods, for the small picture.
    outline: Vec<Point>,
}

/// What stands besides the rods at a step.
pub(super) struct Around<'a> {
    /// The step in which each rod is placed.
    pub placed: &'a IdVec<RodId, usize>,
    /// The number of this step.
    pub number: usize,
    /// The props that stand while it is done.
    pub props: &'a [Prop],
}

impl<'a> Scene<'a> {
    /// A scene for pictures of a size, seen from some sides.
    pub fn new(frame: &'a Frame, sides: &[ViewSide], room: [f64; 2]) -> Self {
        let sides: BTreeSet<ViewSide> = sides.iter().copied().collect();
        let ends = || frame.rods.iter().flat_map(|r| [r.axis.a, r.axis.b]);
        let extents = sides.iter().filter_map(|side| {
            let view = side.view();
            Rect::around(ends().map(|p| view.project(&p)))
        });
        let inside = room.map(|side| side - 2.0 * AROUND);
        let ratio = |extent: Rect| (0..2).map(|i| extent.size()[i] / inside[i]).fold(0.0, f64::max);
        let fit = extents.map(ratio).fold(f64::MIN_POSITIVE, f64::max);
        let mean = frame.rods.iter().map(|r| r.axis.length()).sum::<f64>()
            / frame.rods.len().max(1) as f64;
        let whole = mean / fit >= LEGIBLE || mean == 0.0;
        let scale = if whole { fit } else { mean / PART };
        let aspects =
            sides.iter().map(|&side| (side, Aspect::new(frame, side.view(), scale))).collect();
        Self { frame, room, scale, whole, aspects }
    }

    /// Whether pictures of this size show the whole frame.
    pub fn is_whole(&self) -> bool {
        self.whole
    }

    /// The picture of a step, its corner at the origin.
    pub fn picture(
        &self,
        step: &Step,
        side: ViewSide,
        around: &Around,
    ) -> Result<Vec<Item>, DrawingError> {
        let aspect = &self.aspects[&side];
        let room = Rect::new([0.0; 2], self.room);
        let center = if self.whole {
            aspect.extent.center()
        } else {
            let new = step.rods.iter().flat_map(|&rod| aspect.lines[rod].ends);
            Rect::around(new).map_or(aspect.extent.center(), |new| new.center())
        };
        let [dx, dy] = [0, 1].map(|i| room.center()[i] - center[i]);
        let shift = |p: Point| [p[0] + dx, p[1] + dy];
        let place = |p: &Point3| shift(aspect.view.project(p).map(|x| x / self.scale));
        let mut items: Vec<Item> = Vec::new();
        self.rods(aspect, around, shift, &mut items);
        for check in &step.checks {
            let [p, q] = check.marks.each_ref().map(|mark| place(&self.mark(mark)));
            items.line(p, q, MEASURE);
        }
        for prop in around.props {
            let down = Vector3::z() * prop.height;
            let [top, foot] = [prop.point, prop.point - down].map(|p| place(&p));
            items.line(top, foot, PROP);
            let [left, right] = [-PROP_FOOT, PROP_FOOT].map(|x| [foot[0] + x, foot[1]]);
            items.line(left, right, Stroke::new(0.5).color(Color::DARK_GREY));
        }
        let mut items = if self.whole { items } else { clip(&items, room) };
        let lines = aspect.new_lines(step, shift);
        let mut labels = self.labels(aspect, step, room, shift);
        for prop in around.props {
            let down = Vector3::z() * prop.height;
            let line = [prop.point - down, prop.point].map(|p| place(&p));
            if let Some(line) = within(line, room) {
                let mut text = Text::new([0.0; 2], SMALL, prop.id.to_string());
                text.color(Color::DARK_GREY);
                labels.push(Label { text, line });
            }
        }
        let mut free = room;
        if !self.whole {
            free.max[1] -= KEY[1];
        }
        items.extend(placed(labels, &lines, free)?);
        if !self.whole {
            aspect.key(room, center, &mut items);
        }
        Ok(items)
    }

    /// The rods that are placed, those of this step in black.
    fn rods(
        &self,
        aspect: &Aspect,
        around: &Around,
        shift: impl Fn(Point) -> Point,
        out: &mut Vec<Item>,
    ) {
        let lies = |rod: RodId| around.placed[rod] <= around.number;
        let is_new = |rod: RodId| around.placed[rod] == around.number;
        let window = Rect::new([0.0; 2], self.room);
        let mut stretches: Vec<(bool, [Point; 2], f64)> = Vec::new();
        for rod in self.frame.rods.ids().filter(|&rod| lies(rod)) {
            let line = &aspect.lines[rod];
            let seen = Rect::around(line.ends.map(&shift)).is_some_and(|r| r.overlaps(&window));
            if !seen {
                continue;
            }
            let hidden = aspect.behind[rod].iter().filter(|(near, _)| lies(*near));
            let hidden = hidden.map(|&(_, stretch)| stretch).collect();
            for [from, to] in (Line { hidden, ..line.clone() }).visible() {
                let width = line.width_at((from + to) / 2.0);
                let width = if is_new(rod) { width.max(NEW) } else { width };
                stretches.push((is_new(rod), [from, to].map(|s| shift(line.at(s))), width));
            }
        }
        // Black over grey.
        stretches.sort_by_key(|stretch| stretch.0);
        for (new, [a, b], width) in stretches {
            out.line(a, b, Stroke::new(width).color(if new { Color::BLACK } else { EARLIER }));
        }
        for rod in self.frame.rods.ids().filter(|&rod| is_new(rod)) {
            out.circle(shift(aspect.lines[rod].ends[0]), END_DOT, Color::BLACK);
        }
    }

    /// The numbers of the new rods, and of those to be lifted.
    fn labels(
        &self,
        aspect: &Aspect,
        step: &Step,
        room: Rect,
        shift: impl Fn(Point) -> Point,
    ) -> Vec<Label> {
        let new = step.rods.iter().map(|&rod| {
            let closes = step.closes.iter().any(|c| c.rod == rod);
            let name = format!("{rod}{}", if closes { CLOSES } else { "" });
            let mut text = Text::new([0.0; 2], SMALL, name);
            text.bold();
            (rod, text)
        });
        let lifted: BTreeSet<RodId> = step.lifts.iter().map(|lift| lift.rod).collect();
        let lifted = lifted.into_iter().filter(|rod| !step.rods.contains(rod)).map(|rod| {
            let mut text = Text::new([0.0; 2], SMALL, format!("{LIFTED}{rod}"));
            text.color(Color::DARK_GREY);
            (rod, text)
        });
        let label = |(rod, text): (RodId, Text)| {
            let line = within(aspect.lines[rod].ends.map(&shift), room)?;
            Some(Label { text, line })
        };
        new.chain(lifted).filter_map(label).collect()
    }

    /// Where a mark is.
    fn mark(&self, name: &MarkName) -> Point3 {
        let rod = &self.frame.rods[name.rod];
        let marks = marks(self.frame, name.rod);
        let at = marks.iter().find(|mark| mark.letter == name.mark).map_or(0.0, |mark| mark.at);
        rod.axis.at(at)
    }
}

/// White left round the frame, mm: numbers of rods at its rim stand there.
const AROUND: f64 = 7.0;

impl Aspect {
    fn new(frame: &Frame, view: View, scale: f64) -> Self {
        let place = |p: Point3| view.project(&p).map(|x| x / scale);
        let line = |rod: &crate::frame::Rod| Line {
            ends: [rod.axis.a, rod.axis.b].map(place),
            depth: [rod.axis.a, rod.axis.b].map(|p| view.depth(&p)),
            widths: rod.diameters.map(|d| d / scale),
            hidden: Vec::new(),
        };
        let lines: IdVec<RodId, Line> = frame.rods.iter().map(line).collect();
        let ends: Vec<Point> = lines.iter().flat_map(|line| line.ends).collect();
        let extent = Rect::around(ends.iter().copied());
        let extent = extent.unwrap_or(Rect::new([0.0; 2], [1.0; 2]));
        let behind = behind(&lines);
        Self { view, extent, lines, behind, outline: convex_hull(ends) }
    }

    /// The axes of the new rods.
    fn new_lines(&self, step: &Step, shift: impl Fn(Point) -> Point) -> Vec<[Point; 2]> {
        step.rods.iter().map(|&rod| self.lines[rod].ends.map(&shift)).collect()
    }

    /// A small outline of the frame at the foot of the room, with the place of the picture.
    fn key(&self, room: Rect, center: Point, out: &mut Vec<Item>) {
        let corner = [room.min[0], room.max[1] - KEY[1]];
        out.rect(corner, KEY, THIN.fill(Color::WHITE));
        let inside = Rect::new(corner, KEY).inset(1.5);
        let size = self.extent.size();
        let shrink = (0..2).map(|i| inside.size()[i] / size[i]).fold(f64::INFINITY, f64::min);
        let (from, to) = (self.extent.center(), inside.center());
        let place = |p: Point| [0, 1].map(|i| to[i] + (p[i] - from[i]) * shrink);
        out.polygon(self.outline.iter().map(|&p| place(p)), Stroke::new(0.25).color(EARLIER));
        out.circle(place(center), 1.0, Color::BLACK);
    }
}

/// What each rod loses to nearer ones.
fn behind(lines: &IdVec<RodId, Line>) -> IdVec<RodId, Vec<(RodId, [f64; 2])>> {
    let boxes: Vec<Aabb<2>> =
        lines.iter().map(|line| Aabb::around(&line.ends.map(nalgebra::Point2::from))).collect();
    let tree = Bvh::new(&boxes);
    let mut behind: IdVec<RodId, Vec<(RodId, [f64; 2])>> = vec![Vec::new(); lines.len()].into();
    for (rod, line) in lines.enumerate() {
        let around = &boxes[rod.index()];
        let mut near = Vec::new();
        tree.visit(|b| b.overlaps(around), |i| near.push(RodId::new(i)));
        near.retain(|&other| other > rod);
        near.sort_unstable();
        for other in near {
            if let Some((second, stretch)) = covered(line, &lines[other]) {
                let (far, front) = if second { (other, rod) } else { (rod, other) };
                behind[far].push((front, stretch));
            }
        }
    }
    behind
}
