//! What is marked on the rods: feet, loads, contacts that pull, the most stressed rod.

use super::Subject;
use super::labels::Labels;
use crate::drawing::{Color, Draw, DrawingError, Point, Rect, Stroke, Weight};
use crate::sheets::page::SMALL;
use crate::sheets::view::{Layout, View};
use crate::statics::study::PointLoad;
use crate::surface::Point3;

/// As many contacts that pull are ringed, and as many loads are named.
pub(super) const NAMED: usize = 10;
/// Radius of a ring about a contact, mm.
pub(super) const RING: f64 = 1.7;
/// Length of the arrow of a load, and of its head, mm.
pub(super) const ARROW: f64 = 11.0;
pub(super) const ARROW_HEAD: f64 = 2.4;
/// An arrow that the view shortens to less than this part is drawn as seen from an end.
const END_ON: f64 = 0.15;
/// Half the width of the sign of a foot, mm; smaller where there are many.
pub(super) const FOOT: f64 = 1.1;
const SMALL_FOOT: f64 = 0.6;
const MANY_FEET: usize = 60;
/// Pens of rings and arrows: no colours of the scale.
pub(super) const RING_PEN: Stroke = Stroke::new(0.45).color(Color::BLUE);
pub(super) const LOAD_PEN: Stroke = Stroke::new(0.45);

/// Draws the signs of the feet, to lie below the rods: those behind the frame would cover it.
pub(super) fn feet(subject: &Subject, view: &View, layout: &Layout, out: &mut impl Draw) {
    let (model, own) = (subject.study.model(), subject.study.own_feet);
    let half = if model.feet.len() > MANY_FEET { SMALL_FOOT } else { FOOT };
    for (i, foot) in model.feet.iter().enumerate() {
        foot_sign(out, layout.place(view.project(&model.nodes[foot.node])), half, i >= own);
    }
}

/// Marks the rest on a picture that was drawn with this layout in this room.
pub(super) fn draw(
    subject: &Subject,
    view: &View,
    layout: &Layout,
    room: Rect,
    out: &mut impl Draw,
) -> Result<(), DrawingError> {
    let place = |p: &Point3| layout.place(view.project(p));
    let mut labels = Labels::new(room);
    let study = subject.study;
    let rings: Vec<(Point, String)> = subject
        .pulls
        .iter()
        .take(NAMED)
        .map(|(c, _)| (place(&subject.frame.contact_middle(*c)), c.to_string()))
        .collect();
    for (at, _) in &rings {
        out.circle(*at, RING, RING_PEN);
        labels.keep(Rect { min: *at, max: *at }.inset(-RING));
    }
    if let Some((at, name)) = hottest(subject, view, layout) {
        hottest_sign(out, at);
        labels.keep(Rect { min: at, max: at }.inset(-HOT));
        labels.name(out, at, (&name, 3.2, Weight::Bold, Color::BLACK))?;
    }
    for (i, load) in study.question.points.iter().enumerate() {
        let (at, named) = (place(&load_point(subject, load)), i < NAMED);
        arrow(subject, view, (at, load), named, &mut labels, out)?;
    }
    for (at, name) in &rings {
        labels.name(out, *at, (name, SMALL, Weight::Regular, Color::BLUE))?;
    }
    Ok(())
}

fn load_point(subject: &Subject, load: &PointLoad) -> Point3 {
    subject.frame.rods[load.rod].axis.at(load.at * subject.scale())
}

/// The sign of a foot: filled, or open where it was added.
pub(super) fn foot_sign(out: &mut impl Draw, [x, y]: Point, half: f64, added: bool) {
    let ends = [[x, y - half], [x + half, y + half], [x - half, y + half]];
    let fill = if added { Color::WHITE } else { Color::BLACK };
    out.polygon(ends, Stroke::new(0.2).fill(fill));
}

/// Half the width of the sign of the most stressed place, mm.
pub(super) const HOT: f64 = 1.5;

/// A square about the most stressed place.
pub(super) fn hottest_sign(out: &mut impl Draw, [x, y]: Point) {
    for (width, color) in [(0.9, Color::WHITE), (0.45, Color::BLACK)] {
        let corner = [x - HOT, y - HOT];
        out.rect(corner, [2.0 * HOT, 2.0 * HOT], Stroke::new(width).color(color));
    }
}

/// Where the most stressed rod is so, and its number; `None` where none is stressed.
fn hottest(subject: &Subject, view: &View, layout: &Layout) -> Option<(Point, String)> {
    let rod = *subject.by_use().first()?;
    let figures = &subject.figures[rod];
    let at = subject.frame.rods[rod].axis.at(figures.at * subject.scale());
    (figures.utilisation > 0.0).then(|| (layout.place(view.project(&at)), rod.to_string()))
}

/// A load: an arrow with its tip on the rod; seen from an end, a cross in a circle where it goes
/// away from the eye, or a dot where it comes.
fn arrow(
    subject: &Subject,
    view: &View,
    (tip, load): (Point, &PointLoad),
    named: bool,
    labels: &mut Labels,
    out: &mut impl Draw,
) -> Result<(), DrawingError> {
    let size = load.force.norm();
    let Some(along) = load.force.try_normalize(f64::MIN_POSITIVE) else { return Ok(()) };
    let [x, y] = view.project(&Point3::from(along));
    let mut tail = tip;
    if x.hypot(y) < END_ON {
        let r = ARROW_HEAD / 2.0;
        out.circle(tip, r, LOAD_PEN.fill(Color::WHITE));
        if along.dot(&view.toward()) > 0.0 {
            out.circle(tip, 0.4, Color::BLACK);
        } else {
            let d = r * std::f64::consts::FRAC_1_SQRT_2;
            for s in [-1.0, 1.0] {
                out.line([tip[0] - d, tip[1] - s * d], [tip[0] + d, tip[1] + s * d], LOAD_PEN);
            }
        }
        labels.keep(Rect { min: tip, max: tip }.inset(-r));
    } else {
        tail = [tip[0] - x * ARROW, tip[1] - y * ARROW];
        // White below: rods do not run into it.
        out.line(tail, tip, Stroke::new(1.2).color(Color::WHITE));
        out.arrow(tail, tip, ARROW_HEAD, LOAD_PEN);
        labels.keep(Rect { min: tip, max: tip }.inset(-1.0));
    }
    if named {
        let name = format!("{} N", subject.format().three_digits(size));
        labels.name(out, tail, (&name, SMALL, Weight::Bold, Color::BLACK))?;
    }
    Ok(())
}
