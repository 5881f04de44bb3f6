//! The rods of a frame in the colours of their stresses, those behind others broken off.

use super::Subject;
use crate::drawing::{Color, Draw, Point, Stroke, scale_color};
use crate::ids::{Id, RodId};
use crate::sheets::band::rounded;
use crate::sheets::line_picture::{Line, hide};
use crate::sheets::view::{Layout, View};
use crate::statics::along::share;
use crate::surface::Vector3;

/// Thinnest line of a rod, mm: a colour is hard to tell on a thinner one. Frames of more than
/// [`MANY_RODS`] rods have [`FINE`] lines, or there would be no gaps between them.
const THINNEST: f64 = 0.6;
const FINE: f64 = 0.3;
const MANY_RODS: usize = 1500;
/// A dark edge at both sides of a rod, as part of its width, and its bounds, mm: light colours
/// stand out from white paper by it.
const EDGE: f64 = 0.15;
const EDGES: [f64; 2] = [0.05, 0.2];
const EDGE_COLOR: Color = Color::grey(0x60);
/// Colours are drawn in so many steps: neighbouring stretches of one step are one line.
const STEPS: f64 = 40.0;
/// Visible stretches shorter than this many line widths are left out: specks.
const SPECK: f64 = 0.5;
/// A rod whose outer side is turned away from the eye by more than this, cosine, is seen from
/// inside, and drawn pale: it would be taken for one in front.
const INSIDE: f64 = -0.15;
/// What is left of the colour of such a rod.
const PALE: f64 = 0.3;

/// Draws the rods as they lie on paper.
pub(super) fn draw(subject: &Subject, view: &View, layout: &Layout, out: &mut impl Draw) {
    let frame = &subject.frame;
    let least = if frame.rods.len() > MANY_RODS { FINE } else { THINNEST };
    let line = |rod: &crate::frame::Rod| {
        let ends = [rod.axis.a, rod.axis.b];
        Line {
            ends: ends.map(|p| layout.place(view.project(&p))),
            depth: ends.map(|p| view.depth(&p)),
            widths: rod.diameters.map(|d| (d / layout.n).max(least)),
            hidden: Vec::new(),
        }
    };
    let mut lines: Vec<Line> = frame.rods.iter().map(line).collect();
    hide(&mut lines);
    let mut seen: Vec<Seen> = Vec::new();
    for (rod, line) in frame.rods.ids().zip(&mut lines) {
        let [x, y] = [0, 1].map(|i| line.ends[1][i] - line.ends[0][i]);
        for [from, to] in line.visible() {
            let middle = (from + to) / 2.0;
            let width = line.width_at(middle);
            if (to - from) * x.hypot(y) > SPECK * width {
                seen.push(Seen { rod, from, to, width, depth: line.depth_at(middle) });
            }
        }
    }
    seen.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    let largest = subject.largest();
    for stretch in seen {
        let pale = is_inside(subject, view, stretch.rod);
        colored(subject, &lines[stretch.rod.index()], &stretch, pale, largest, out);
    }
}

/// A visible stretch of a rod, as shares of it.
struct Seen {
    rod: RodId,
    from: f64,
    to: f64,
    width: f64,
    depth: f64,
}

/// Whether a rod shows the eye the inner side of the frame.
fn is_inside(subject: &Subject, view: &View, rod: RodId) -> bool {
    let contacts = &subject.frame.rods[rod].contacts;
    let outward: Vector3 = contacts.iter().map(|&c| subject.frame.contacts[c].normal).sum();
    outward.try_normalize(f64::MIN_POSITIVE).is_some_and(|n| n.dot(&view.toward()) < INSIDE)
}

/// A visible stretch with its edge, in as many pieces as it has colours.
fn colored(
    subject: &Subject,
    line: &Line,
    seen: &Seen,
    pale: bool,
    largest: f64,
    out: &mut impl Draw,
) {
    let shade = |color: Color| if pale { color.tint(PALE) } else { color };
    let edge = (EDGE * seen.width).clamp(EDGES[0], EDGES[1]);
    let mut piece = |from: f64, to: f64, width: f64, color: Color| {
        let ends: [Point; 2] = [from, to].map(|s| line.at(s).map(rounded));
        out.line(ends[0], ends[1], Stroke::new(rounded(width)).color(shade(color)));
    };
    piece(seen.from, seen.to, seen.width + edge, EDGE_COLOR);
    let length = subject.frame.rods[seen.rod].axis.length();
    // Where the piece begins that is not drawn yet, and its step.
    let mut open: Option<(f64, f64)> = None;
    for stretch in &subject.along[seen.rod] {
        let [from, to] = [stretch.from, stretch.to].map(|s| (s / length).clamp(seen.from, seen.to));
        if to <= from {
            continue;
        }
        let step = (share(stretch.utilisation, largest) * STEPS).round() / STEPS;
        match open {
            Some((_, now)) if now == step => {}
            Some((start, now)) => {
                piece(start, from, seen.width - edge, scale_color(now));
                open = Some((from, step));
            }
            None => open = Some((seen.from, step)),
        }
    }
    if let Some((start, now)) = open {
        piece(start, seen.to, seen.width - edge, scale_color(now));
    }
}

/// A sample of a rod that is seen from inside, for the key.
pub(super) fn pale_sample(out: &mut impl Draw, [x, y]: Point) {
    for (width, color) in [(1.0, EDGE_COLOR), (0.7, scale_color(0.6))] {
        out.line([x - 2.0, y], [x + 2.0, y], Stroke::new(width).color(color.tint(PALE)));
    }
}
