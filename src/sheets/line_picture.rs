//! A frame as plain lines: each rod a line that breaks off where a nearer rod passes in
//! front of it. The rim of its surface is drawn faintly below.
//!
//! Two rods are compared at the very point where they cross in the picture, so the
//! order is right however they lie. Every visible stretch is one line and there are no
//! white edges below it: a small file, for small pictures. Not treated: rods that
//! overlap in the picture without crossing, such as two in line with the eye; of these
//! the nearer is drawn last.

use super::band::rounded;
use super::view::View;
use crate::drawing::{Color, Draw, Item, Point, Rect, Stroke};
use crate::frame::Frame;
use crate::frame::sizes::diameter_at;
use crate::surface::Point3;

/// Thinnest line of a rod, mm.
const THINNEST: f64 = 0.2;
/// White left at both sides of a rod that passes in front: at least so much, mm, and
/// at least so many line widths.
const CLEAR: f64 = 0.15;
const CLEAR_WIDTHS: f64 = 0.4;
/// Sine of the angle in the picture below which a crossing is treated as one at this
/// angle. Smaller, and grazing rods would take away long stretches of each other.
const GRAZING: f64 = 0.3;
/// Visible stretches shorter than this many line widths are left out: specks.
const SPECK: f64 = 0.5;
/// The rim of the surface, mm.
const RIM: Stroke = Stroke::new(0.25).color(Color::LIGHT_GREY).round();
/// Points of a rim nearer together than this, mm, are thinned out.
const RIM_STEP: f64 = 0.5;
/// How light the farthest lines are, 0 black to 255 white.
const FARTHEST: f64 = 150.0;
/// Lines that cross this near to the ends of both, as part of them, meet there.
const SAME_END: f64 = 1e-6;

/// A rod in the picture, mm, y down.
#[derive(Clone)]
pub(super) struct Line {
    pub ends: [Point; 2],
    /// Nearness to the eye at both ends.
    pub depth: [f64; 2],
    /// Width at both ends.
    pub widths: [f64; 2],
    /// Stretches that are hidden, as shares of the line.
    pub hidden: Vec<[f64; 2]>,
}

impl Line {
    fn direction(&self) -> [f64; 2] {
        [self.ends[1][0] - self.ends[0][0], self.ends[1][1] - self.ends[0][1]]
    }

    fn length(&self) -> f64 {
        let [x, y] = self.direction();
        x.hypot(y)
    }

    pub fn at(&self, share: f64) -> Point {
        let [x, y] = self.direction();
        [self.ends[0][0] + x * share, self.ends[0][1] + y * share]
    }

    pub fn depth_at(&self, share: f64) -> f64 {
        self.depth[0] + (self.depth[1] - self.depth[0]) * share
    }

    pub fn width_at(&self, share: f64) -> f64 {
        diameter_at(self.widths, share).max(THINNEST)
    }

    /// The stretches that are seen, as shares of the line.
    pub fn visible(&mut self) -> Vec<[f64; 2]> {
        self.hidden.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut seen = Vec::new();
        let mut done = 0.0f64;
        for &[from, to] in &self.hidden {
            if from > done {
                seen.push([done, from]);
            }
            done = done.max(to);
        }
        if done < 1.0 {
            seen.push([done, 1.0]);
        }
        seen
    }
}

/// Draws the frame as large as it gets in `room`, and the closed lines `rims` below it.
pub(super) fn draw(frame: &Frame, rims: &[Vec<Point3>], view: &View, room: Rect) -> Vec<Item> {
    let ends = frame.rods.iter().flat_map(|r| [r.axis.a, r.axis.b]);
    let points = ends.chain(rims.iter().flatten().copied());
    let Some(extent) = Rect::around(points.map(|p| view.project(&p))) else { return Vec::new() };
    let extent = extent.inset(-frame.thickest() / 2.0);
    let scale = (0..2).map(|i| room.size()[i] / extent.size()[i]).fold(f64::INFINITY, f64::min);
    let (from, to) = (extent.center(), room.center());
    let place = |p: &Point3| {
        let p = view.project(p);
        [0, 1].map(|i| to[i] + (p[i] - from[i]) * scale)
    };
    let mut items = Vec::new();
    for rim in rims {
        items.polygon(thinned(rim.iter().map(place)), RIM);
    }
    let mut lines: Vec<Line> = frame
        .rods
        .iter()
        .map(|rod| Line {
            ends: [rod.axis.a, rod.axis.b].map(|p| place(&p)),
            depth: [rod.axis.a, rod.axis.b].map(|p| view.depth(&p)),
            widths: rod.diameters.map(|d| d * scale),
            hidden: Vec::new(),
        })
        .collect();
    hide(&mut lines);
    stretches(&mut lines, &mut items);
    items
}

/// The points, rounded, without those that are too near to the one before.
fn thinned(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for p in points.map(|p| p.map(rounded)) {
        if kept.last().is_none_or(|q| (p[0] - q[0]).hypot(p[1] - q[1]) >= RIM_STEP) {
            kept.push(p);
        }
    }
    kept
}

/// Marks what each line loses to the others.
pub(super) fn hide(lines: &mut [Line]) {
    for i in 0..lines.len() {
        for j in i + 1..lines.len() {
            if let Some((second, stretch)) = covered(&lines[i], &lines[j]) {
                lines[if second { j } else { i }].hidden.push(stretch);
            }
        }
    }
}

/// What the farther of two lines loses where they cross: whether that is the second one, and
/// the stretch as shares of it.
pub(super) fn covered(first: &Line, second: &Line) -> Option<(bool, [f64; 2])> {
    let ([s, t], sine) = crossing(first, second)?;
    let behind = first.depth_at(s) < second.depth_at(t);
    let ((far, at), (near, by)) =
        if behind { ((first, s), (second, t)) } else { ((second, t), (first, s)) };
    let (width, front) = (far.width_at(at), near.width_at(by));
    let clear = front / 2.0 + CLEAR.max(CLEAR_WIDTHS * front);
    let sine = sine.max(GRAZING);
    // To the clear edge of the near rod, and on until the far rod's corner is past it.
    let half = (clear + width / 2.0 * (1.0 - sine * sine).sqrt()) / sine;
    let half = half / far.length();
    Some((!behind, [at - half, at + half]))
}

/// Where two lines cross, as shares of both, and the sine of the angle between them.
fn crossing(a: &Line, b: &Line) -> Option<([f64; 2], f64)> {
    let (u, v) = (a.direction(), b.direction());
    let turn = u[0] * v[1] - u[1] * v[0];
    let apart = [b.ends[0][0] - a.ends[0][0], b.ends[0][1] - a.ends[0][1]];
    let s = (apart[0] * v[1] - apart[1] * v[0]) / turn;
    let t = (apart[0] * u[1] - apart[1] * u[0]) / turn;
    // Parallel lines give no number or an infinite one.
    let within = |share: f64| (0.0..=1.0).contains(&share);
    // Rods that meet end to end do not cross.
    let at_end = |share: f64| share.min(1.0 - share) < SAME_END;
    (within(s) && within(t) && !(at_end(s) && at_end(t)))
        .then(|| ([s, t], turn.abs() / (a.length() * b.length())))
}

/// The visible stretches as lines, far ones first and lighter.
fn stretches(lines: &mut [Line], out: &mut Vec<Item>) {
    let depths = || lines.iter().flat_map(|l| l.depth);
    let (far, near) =
        (depths().fold(f64::INFINITY, f64::min), depths().fold(f64::NEG_INFINITY, f64::max));
    let mut seen: Vec<(f64, [Point; 2], f64)> = Vec::new();
    for line in lines {
        let length = line.length();
        for [from, to] in line.visible() {
            let width = line.width_at((from + to) / 2.0);
            if (to - from) * length > SPECK * width {
                let ends = [from, to].map(|s| line.at(s).map(rounded));
                seen.push((line.depth_at((from + to) / 2.0), ends, width));
            }
        }
    }
    seen.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (depth, [a, b], width) in seen {
        let nearness = if near > far { (depth - far) / (near - far) } else { 1.0 };
        let level = (FARTHEST * (1.0 - nearness)).round() as u8;
        out.line(a, b, Stroke::new(rounded(width)).color(Color::grey(level)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Shape, bounds};
    use crate::shop::fixture;

    fn line(ends: [Point; 2], depth: [f64; 2]) -> Line {
        Line { ends, depth, widths: [0.5; 2], hidden: Vec::new() }
    }

    #[test]
    fn the_far_line_gives_way_at_the_crossing() {
        // The second line is farther in its middle, though nearer at one end.
        let mut lines = [
            line([[0.0, 0.0], [10.0, 0.0]], [1.0, 1.0]),
            line([[5.0, -5.0], [5.0, 5.0]], [-9.0, 5.0]),
        ];
        hide(&mut lines);
        assert_eq!(lines[0].visible(), [[0.0, 1.0]]);
        let seen = lines[1].visible();
        // Square to each other: half the rod and 0.2 mm on both sides of the middle.
        let gap = (0.25 + 0.2) / 10.0;
        assert!((seen[0][1] - (0.5 - gap)).abs() < 1e-12, "{seen:?}");
        assert!((seen[1][0] - (0.5 + gap)).abs() < 1e-12, "{seen:?}");
    }

    #[test]
    fn lines_that_do_not_cross_leave_each_other_whole() {
        let mut lines = [
            line([[0.0, 0.0], [10.0, 0.0]], [0.0, 0.0]),
            line([[0.0, 1.0], [10.0, 1.0]], [1.0, 1.0]),
            line([[11.0, -5.0], [11.0, 5.0]], [2.0, 2.0]),
            line([[0.0, 0.0], [0.0, 0.0]], [3.0, 3.0]),
        ];
        hide(&mut lines);
        assert!(lines.iter().all(|l| l.hidden.is_empty()));
    }

    #[test]
    fn hidden_stretches_may_overlap_and_reach_beyond_the_ends() {
        let mut l = line([[0.0, 0.0], [1.0, 0.0]], [0.0, 0.0]);
        l.hidden = vec![[0.5, 0.6], [-0.1, 0.2], [0.55, 0.7], [0.9, 1.3]];
        assert_eq!(l.visible(), [[0.2, 0.5], [0.7, 0.9]]);
    }

    #[test]
    fn a_frame_fills_its_room_and_stays_in_it() {
        let frame = fixture::circuit(7, 3.0);
        let room = Rect::new([20.0, 30.0], [90.0, 60.0]);
        let corners = [[-80.0, -80.0, 0.0], [80.0, -80.0, 0.0], [0.0, 80.0, 0.0]];
        let rim: Vec<Point3> = corners.map(Point3::from).to_vec();
        for view in [View::plan(), View::isometric()] {
            let items = draw(&frame, std::slice::from_ref(&rim), &view, room);
            let extent = bounds(&items).unwrap();
            assert!(room.contains_rect(&extent), "{extent:?}");
            let share = |i: usize| extent.size()[i] / room.size()[i];
            assert!(share(0).max(share(1)) > 0.9, "{extent:?}");
        }
    }

    #[test]
    fn a_rim_is_thinned_but_keeps_its_way() {
        let points = (0..1000).map(|i| [f64::from(i) * 0.01, 0.0]);
        let kept = thinned(points);
        assert_eq!(kept.len(), 20);
        assert!(kept.windows(2).all(|w| (w[1][0] - w[0][0] - RIM_STEP).abs() < 1e-9));
    }

    /// In plan, at each contact the over rod is drawn through and the under rod is not.
    #[test]
    fn the_rod_that_is_over_is_seen_at_every_contact() {
        let frame = fixture::circuit(5, 3.0);
        let view = View::plan();
        let all = frame.rods.iter().flat_map(|r| [r.axis.a, r.axis.b]);
        let extent = Rect::around(all.map(|p| view.project(&p))).unwrap().inset(-1.5);
        // At full size, where it lies.
        let items = draw(&frame, &[], &view, extent);
        for contact in &frame.contacts {
            let over = &frame.rods[contact.over].axis;
            let [x, y] = view.project(&over.at(contact.at_over));
            let covers = items.iter().filter(|item| match item {
                Item::Figure(f) => match f.shape {
                    Shape::Line(a, b) => distance([x, y], a, b) < 0.1,
                    _ => false,
                },
                Item::Text(_) => false,
            });
            assert_eq!(covers.count(), 1);
        }
    }

    fn distance(p: Point, a: Point, b: Point) -> f64 {
        let d = [b[0] - a[0], b[1] - a[1]];
        let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
        let t = t.clamp(0.0, 1.0);
        (a[0] + t * d[0] - p[0]).hypot(a[1] + t * d[1] - p[1])
    }
}
