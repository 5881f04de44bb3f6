//! Pictures of a frame: rods as thick lines, far ones first, each with a white edge
//! so that one sees which rod is over.
//!
//! Rods are cut into pieces, one about every contact and the rest between. A piece
//! about a contact is as far away as the contact itself, so two rods that touch are
//! drawn in their true order, however steep they are. The other pieces go by their
//! middles, which is right unless long pieces pass each other closely.

use crate::drawing::{Cap, Color, Draw, Point, Rect, Stroke};
use crate::frame::{Frame, Mating};
use crate::ids::RodId;
use crate::surface::{Point3, Vector3};

/// Half the length of a piece about a contact, in diameters: enough for the crossing
/// rod and its white edges down to crossings of some 25°.
const CONTACT_PIECE: f64 = 3.0;
/// Longest piece between contacts, in diameters.
const FREE_PIECE: f64 = 15.0;
/// Frames of more rods are not cut further between contacts: the picture is too fine
/// for it to show, and the file would grow.
const MANY_RODS: usize = 1500;
/// Thinnest line of a rod, mm.
const THINNEST: f64 = 0.3;
/// Where all rods are thicker than this on paper they are drawn with an outline, mm.
const OUTLINED: f64 = 1.2;
/// Width of that outline, mm.
const OUTLINE: f64 = 0.25;
/// How far pieces of such a rod lap over each other, mm: no seam shows.
const LAP: f64 = 0.1;
/// How light the farthest rods are, 0 black to 255 white.
const FARTHEST: f64 = 150.0;
/// Sine of the slope below which a place of the surface counts as level: which way is uphill
/// would be rounding.
const LEVEL: f64 = 1e-6;
/// Scales that read well, and ten times, a hundred times … as small.
const ROUND_SCALES: [f64; 10] = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];

/// Where a frame is looked at from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct View {
    right: Vector3,
    up: Vector3,
    /// From the frame to the eye.
    toward: Vector3,
    /// Whether far rods are drawn lighter.
    fading: bool,
}

/// How a view lies on paper.
pub(super) struct Layout {
    /// Of the scale 1:n.
    pub n: f64,
    from: Point,
    to: Point,
}

impl Layout {
    /// Where a point of the view lies on paper.
    pub fn place(&self, p: Point) -> Point {
        [0, 1].map(|i| self.to[i] + (p[i] - self.from[i]) / self.n)
    }
}

impl View {
    /// From above; x to the right, y up.
    pub fn plan() -> Self {
        Self { right: Vector3::x(), up: Vector3::y(), toward: Vector3::z(), fading: false }
    }

    /// With all three axes equally short; x to the right and forward.
    pub fn isometric() -> Self {
        let toward = Vector3::new(1.0, -1.0, 1.0).normalize();
        let right = Vector3::new(1.0, 1.0, 0.0).normalize();
        Self { right, up: toward.cross(&right), toward, fading: true }
    }

    /// From outside, straight onto a place of the surface with this outward normal; what is
    /// uphill is up, and on top y is.
    pub fn onto(normal: &Vector3) -> Self {
        let right = Vector3::z().cross(normal).try_normalize(LEVEL).unwrap_or(Vector3::x());
        let toward = (normal - right * normal.dot(&right)).normalize();
        Self { right, up: toward.cross(&right), toward, fading: false }
    }

    /// From a side, by the heading of the eye from the middle and its height, radians; up is
    /// up, and far rods are as dark as near ones.
    pub fn from_side(azimuth: f64, elevation: f64) -> Self {
        let (sin, cos) = azimuth.sin_cos();
        let (up, level) = elevation.sin_cos();
        let toward = Vector3::new(cos * level, sin * level, up);
        let right = Vector3::new(-sin, cos, 0.0);
        Self { right, up: toward.cross(&right), toward, fading: false }
    }

    /// The unit vector from the frame to the eye.
    pub fn toward(&self) -> Vector3 {
        self.toward
    }

    /// Where a point appears, mm, y down.
    pub fn project(&self, p: &Point3) -> Point {
        [p.coords.dot(&self.right), -p.coords.dot(&self.up)]
    }

    /// How near a point is to the eye, mm; a larger figure is nearer.
    pub fn depth(&self, p: &Point3) -> f64 {
        p.coords.dot(&self.toward)
    }

    /// The extent of the frame in this view, mm.
    fn extent(&self, frame: &Frame) -> Rect {
        let ends = frame.rods.iter().flat_map(|r| [r.axis.a, r.axis.b]);
        let bounds = Rect::around(ends.map(|p| self.project(&p)));
        bounds.unwrap_or(Rect::new([0.0, 0.0], [1.0, 1.0])).inset(-frame.thickest() / 2.0)
    }

    /// How the frame lies in `room`: at the largest round scale that fits, in the middle.
    pub fn layout(&self, frame: &Frame, room: Rect) -> Layout {
        let extent = self.extent(frame);
        let ratio = (0..2).map(|i| extent.size()[i] / room.size()[i]).fold(0.0, f64::max);
        Layout { n: round_scale(ratio), from: extent.center(), to: room.center() }
    }

    /// Draws the frame into `room` at the largest round scale that fits, and returns
    /// n of that scale 1:n.
    pub fn draw(&self, frame: &Frame, room: Rect, out: &mut impl Draw) -> f64 {
        let layout = self.layout(frame, room);
        let (n, place) = (layout.n, |p: Point| layout.place(p));

        let ends = frame.rods.iter().flat_map(|rod| rod.diameters);
        let outlined = ends.fold(f64::INFINITY, f64::min) / n > OUTLINED;
        let mut pieces: Vec<Piece> =
            frame.rods.ids().flat_map(|rod| self.pieces(frame, rod)).collect();
        // Far ones first; ties by rod and place, as they come.
        pieces.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        let depths = (pieces.first().map(|p| p.depth), pieces.last().map(|p| p.depth));
        for piece in &pieces {
            let near = match depths {
                (Some(far), Some(near)) if self.fading && near > far => {
                    (piece.depth - far) / (near - far)
                }
                _ => 1.0,
            };
            let level = (FARTHEST * (1.0 - near)).round() as u8;
            let line = piece.ends.map(|p| place(self.project(&p)));
            let width = (piece.diameter / n).max(THINNEST);
            let open = outlined.then_some(piece.open);
            rod_piece(out, line, open, width, Color::grey(level));
        }
        n
    }

    fn pieces(&self, frame: &Frame, rod: RodId) -> Vec<Piece> {
        let r = &frame.rods[rod];
        let length = r.axis.length();
        let mut at: Vec<Mating> = r.contacts.iter().map(|&c| frame.seen_from(c, rod)).collect();
        at.sort_by(|p, q| p.at.total_cmp(&q.at));
        let longest = match frame.rods.len() {
            0..=MANY_RODS => FREE_PIECE * r.thickest(),
            _ => f64::INFINITY,
        };
        let mut pieces = Vec::new();
        let mut done = 0.0;
        for (i, &Mating { at: s, partner, .. }) in at.iter().enumerate() {
            let next = at.get(i + 1).map_or(length, |n| (s + n.at) / 2.0);
            let reach = CONTACT_PIECE * r.thickest().max(frame.rods[partner].thickest());
            let (from, to) = ((s - reach).max(done), (s + reach).min(next));
            self.free(frame, rod, [done, from], longest, &mut pieces);
            let ends = [r.axis.at(from), r.axis.at(to)];
            let open = [from <= 0.0, to >= length];
            let diameter = r.diameter_at((from + to) / 2.0);
            pieces.push(Piece { ends, open, depth: self.depth(&r.axis.at(s)), diameter });
            done = to;
        }
        self.free(frame, rod, [done, length], longest, &mut pieces);
        pieces
    }

    /// Pieces of a stretch of rod without contacts, none longer than `longest`.
    fn free(
        &self,
        frame: &Frame,
        rod: RodId,
        [from, to]: [f64; 2],
        longest: f64,
        out: &mut Vec<Piece>,
    ) {
        let axis = &frame.rods[rod].axis;
        let count = ((to - from) / longest).ceil().max(0.0) as usize;
        let count = if to > from { count.max(1) } else { 0 };
        let at = |k: usize| from + (to - from) * k as f64 / count as f64;
        for k in 0..count {
            let ends = [axis.at(at(k)), axis.at(at(k + 1))];
            let open = [at(k) <= 0.0, at(k + 1) >= axis.length()];
            let depth = self.depth(&nalgebra::center(&ends[0], &ends[1]));
            let diameter = frame.rods[rod].diameter_at((at(k) + at(k + 1)) / 2.0);
            out.push(Piece { ends, open, depth, diameter });
        }
    }
}

/// A part of a rod and how near it is.
struct Piece {
    ends: [Point3; 2],
    /// Which of the two are ends of the rod; at the others another piece follows.
    open: [bool; 2],
    depth: f64,
    /// In its middle, mm: pieces are short, and tapers are slight.
    diameter: f64,
}

/// A piece of a rod; with an outline where it is told which of its ends are the rod's.
fn rod_piece(
    out: &mut impl Draw,
    [a, b]: [Point; 2],
    outlined: Option<[bool; 2]>,
    width: f64,
    color: Color,
) {
    let edge = (width * 0.4).clamp(0.25, 0.8);
    out.line(a, b, Stroke::new(width + 2.0 * edge).color(Color::WHITE));
    let line = Stroke::new(width).color(color);
    let Some(open) = outlined else {
        // Round ends stick out a little and close the joints between pieces.
        out.line(a, b, line.cap(Cap::Round));
        return;
    };
    // A dark line and a light one within it: the rest is the outline. The light one
    // is shorter at the rod's ends, and laps over the joints elsewhere.
    let [c, d] = stretched([a, b], open.map(|o| if o { 0.0 } else { LAP }));
    out.line(c, d, line);
    let [c, d] = stretched([a, b], open.map(|o| if o { -OUTLINE } else { LAP }));
    out.line(c, d, Stroke::new(width - 2.0 * OUTLINE).color(Color::PALE_GREY));
}

/// The line made longer by so much at each end (shorter where negative).
fn stretched([a, b]: [Point; 2], by: [f64; 2]) -> [Point; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    if length <= 2.0 * OUTLINE {
        return [a, b];
    }
    let (x, y) = (dx / length, dy / length);
    [[a[0] - x * by[0], a[1] - y * by[0]], [b[0] + x * by[1], b[1] + y * by[1]]]
}

/// The smallest n of a round scale 1:n that is at least `ratio`.
pub(super) fn round_scale(ratio: f64) -> f64 {
    if !(ratio > 0.0 && ratio.is_finite()) {
        return 1.0;
    }
    let power = 10f64.powf(ratio.log10().floor());
    ROUND_SCALES
        .iter()
        .map(|s| s * power)
        .find(|n| *n >= ratio * (1.0 - 1e-12))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Item, Shape, bounds};
    use crate::shop::fixture;

    #[test]
    fn scales_are_round_and_large_enough() {
        for (ratio, n) in [(0.9, 1.0), (1.0, 1.0), (3.3, 4.0), (8.5, 10.0), (126.0, 150.0)] {
            assert!((round_scale(ratio) - n).abs() < 1e-9, "{ratio}: {}", round_scale(ratio));
        }
    }

    #[test]
    fn views_are_orthonormal_and_right_handed() {
        for v in [View::plan(), View::isometric(), View::from_side(2.0, 0.9)] {
            assert!((v.right.cross(&v.up) - v.toward).norm() < 1e-12);
            assert!((v.up.norm() - 1.0).abs() < 1e-12);
        }
        assert!(View::isometric().up.z > 0.0);
    }

    #[test]
    fn the_picture_stays_in_its_room() {
        let frame = fixture::circuit(7, 3.0);
        let room = Rect::new([20.0, 30.0], [90.0, 60.0]);
        for view in [View::plan(), View::isometric()] {
            let mut items: Vec<Item> = Vec::new();
            assert!(view.draw(&frame, room, &mut items) >= 1.0);
            assert!(room.contains_rect(&bounds(&items).unwrap()));
        }
    }

    /// In plan, at each contact the last line drawn over the crossing is the over rod's.
    #[test]
    fn the_rod_that_is_over_is_drawn_last() {
        let frame = fixture::circuit(5, 3.0);
        let view = View::plan();
        let mut items: Vec<Item> = Vec::new();
        let room = view.extent(&frame);
        assert_eq!(view.draw(&frame, room, &mut items), 1.0);
        for contact in &frame.contacts {
            let over = &frame.rods[contact.over].axis;
            let at = view.project(&over.at(contact.at_over));
            let last = items.iter().rev().find_map(|item| match item {
                Item::Figure(f) => match f.shape {
                    Shape::Line(a, b) if near(at, a, b) < 1e-6 => Some((a, b)),
                    _ => None,
                },
                Item::Text(_) => None,
            });
            let (a, b) = last.unwrap();
            let d = over.direction();
            let along = [b[0] - a[0], b[1] - a[1]];
            assert!((along[0] * -d.y - along[1] * d.x).abs() < 1e-6);
        }
    }

    fn near(p: Point, a: Point, b: Point) -> f64 {
        let d = [b[0] - a[0], b[1] - a[1]];
        let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
        let t = t.clamp(0.0, 1.0);
        (a[0] + t * d[0] - p[0]).hypot(a[1] + t * d[1] - p[1])
    }
}
