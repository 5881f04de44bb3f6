//! Moving, turning and scaling copies of items.

use super::{Figure, Item, Paint, Point, Rect, Shape, Stroke, Text};

/// Where a group of items goes: scaled, then turned, then moved.
///
/// Line widths, dashes and text sizes stay as they are unless asked for, so that a
/// view drawn at 1:10 has the same lines and letters as one at 1:1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement {
    /// Where the origin of the group goes, mm.
    pub offset: Point,
    /// Factor on all coordinates, above 0.
    pub scale: f64,
    /// Turn about the group's origin, degrees, clockwise as seen.
    pub rotation: f64,
    /// Whether line widths and dashes are scaled too.
    pub scale_strokes: bool,
    /// Whether text sizes are scaled too.
    pub scale_text: bool,
}

impl Placement {
    /// At full size with the group's origin at `offset`.
    pub const fn at(offset: Point) -> Self {
        Self { offset, scale: 1.0, rotation: 0.0, scale_strokes: false, scale_text: false }
    }

    /// With all coordinates multiplied by `scale`.
    pub const fn scale(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// Turned about the group's origin, degrees, clockwise as seen.
    pub const fn rotate(self, degrees: f64) -> Self {
        Self { rotation: degrees, ..self }
    }

    /// With line widths, dashes and text sizes scaled as well, like a photograph.
    pub const fn scale_all(self) -> Self {
        Self { scale_strokes: true, scale_text: true, ..self }
    }

    /// As large as it gets with `content` inside `room`, centred there.
    pub fn fit(content: Rect, room: Rect) -> Self {
        let ratio = |i: usize| {
            let size = content.size()[i];
            if size > 0.0 { room.size()[i] / size } else { f64::INFINITY }
        };
        let scale = ratio(0).min(ratio(1));
        // A single point has no size; any scale shows it.
        let scale = if scale.is_finite() { scale } else { 1.0 };
        Self::centered(content, room.center(), scale)
    }

    /// With the middle of `content` at `center`.
    pub fn centered(content: Rect, center: Point, scale: f64) -> Self {
        let middle = content.center();
        Self::at([center[0] - scale * middle[0], center[1] - scale * middle[1]]).scale(scale)
    }

    /// Where a point goes.
    pub fn point(&self, [x, y]: Point) -> Point {
        let (sin, cos) = turn(self.rotation);
        [
            self.offset[0] + self.scale * (cos * x - sin * y),
            self.offset[1] + self.scale * (sin * x + cos * y),
        ]
    }

    /// The item at its new place.
    pub fn apply(&self, item: &Item) -> Item {
        match item {
            Item::Figure(f) => {
                Figure { shape: self.shape(&f.shape), paint: self.paint(f.paint) }.into()
            }
            Item::Text(t) => Text {
                at: self.point(t.at),
                size: if self.scale_text { t.size * self.scale } else { t.size },
                rotation: t.rotation + self.rotation,
                ..t.clone()
            }
            .into(),
        }
    }

    fn shape(&self, shape: &Shape) -> Shape {
        let all = |points: &[Point]| points.iter().map(|&p| self.point(p)).collect::<Vec<_>>();
        match shape {
            Shape::Line(a, b) => Shape::Line(self.point(*a), self.point(*b)),
            Shape::Polyline(points) => Shape::Polyline(all(points)),
            Shape::Area(rings) => Shape::Area(rings.iter().map(|r| all(r)).collect()),
            Shape::Circle { center, radius } => {
                Shape::Circle { center: self.point(*center), radius: radius * self.scale }
            }
            Shape::Curve { start, cubics, closed } => Shape::Curve {
                start: self.point(*start),
                cubics: cubics.iter().map(|c| c.map(|p| self.point(p))).collect(),
                closed: *closed,
            },
        }
    }

    fn paint(&self, paint: Paint) -> Paint {
        let factor = if self.scale_strokes { self.scale } else { 1.0 };
        let stroke = paint.stroke.map(|s| Stroke {
            width: s.width * factor,
            dash: s.dash.scaled(factor),
            ..s
        });
        Paint { stroke, ..paint }
    }
}

/// Sine and cosine of an angle in degrees, exact at quarter turns, so that upright
/// rectangles stay upright.
fn turn(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Dash, Draw, bounds};
    use super::*;

    fn sample() -> Vec<Item> {
        let mut items = Vec::new();
        items.rect([1.0, 2.0], [10.0, 4.0], Stroke::new(0.5).dash(Dash::DASHED));
        items.circle([6.0, 4.0], 1.5, Stroke::new(0.5));
        items.text([6.0, 4.0], 3.0, "R1").rotate(30.0);
        items
    }

    #[test]
    fn placing_scales_geometry_and_leaves_pens() {
        let mut out: Vec<Item> = Vec::new();
        out.place(&sample(), &Placement::at([100.0, 50.0]).scale(0.5));
        assert_eq!(bounds(&out), Some(Rect::new([100.5, 51.0], [5.0, 2.0])));
        let [Item::Figure(rect), Item::Figure(circle), Item::Text(text)] = &out[..] else {
            panic!("three items")
        };
        assert_eq!(rect.paint.stroke, Some(Stroke::new(0.5).dash(Dash::DASHED)));
        assert_eq!(circle.shape, Shape::Circle { center: [103.0, 52.0], radius: 0.75 });
        assert_eq!((text.size, text.rotation), (3.0, 30.0));
    }

    #[test]
    fn scale_all_scales_pens_dashes_and_text() {
        let mut out: Vec<Item> = Vec::new();
        out.place(&sample(), &Placement::at([0.0, 0.0]).scale(2.0).scale_all());
        let [Item::Figure(rect), _, Item::Text(text)] = &out[..] else { panic!("three items") };
        assert_eq!(rect.paint.stroke, Some(Stroke::new(1.0).dash(Dash::new([4.0, 2.0]))));
        assert_eq!(text.size, 6.0);
    }

    #[test]
    fn quarter_turn_is_exact_and_turns_text() {
        let mut out: Vec<Item> = Vec::new();
        out.place(&sample(), &Placement::at([0.0, 0.0]).rotate(90.0));
        assert_eq!(bounds(&out), Some(Rect::new([-6.0, 1.0], [4.0, 10.0])));
        let Item::Text(text) = &out[2] else { panic!("a text") };
        assert_eq!(text.rotation, 120.0);
    }

    #[test]
    fn fit_fills_the_tighter_side_and_centres() {
        let room = Rect::new([10.0, 10.0], [100.0, 50.0]);
        let p = Placement::fit(Rect::new([0.0, 0.0], [10.0, 10.0]), room);
        assert_eq!(p.scale, 5.0);
        assert_eq!(p.point([5.0, 5.0]), room.center());
    }
}
