//! Builders: the short way to put items on a drawing, a layer or a list.

use super::{Anchor, Drawing, FIRST_LAYER, Figure, Item, Layer, Paint, Placement};
use super::{Point, Shape, Stroke, Text};

/// Width of an arrow head as a share of its length.
const ARROW_WIDTH: f64 = 0.6;
/// Longest piece of a circular arc drawn as one cubic, degrees. A quarter circle
/// is off by 0.03 % of the radius; longer pieces get visibly worse.
const ARC_PIECE: f64 = 90.0;

/// Something that items can be added to: a [`Drawing`] (its topmost layer), a
/// [`Layer`], or a plain list of items that is placed later.
pub trait Draw {
    /// Where new items go.
    fn items_mut(&mut self) -> &mut Vec<Item>;

    /// Adds an item.
    fn push(&mut self, item: impl Into<Item>) {
        self.items_mut().push(item.into());
    }

    /// Adds a shape.
    fn shape(&mut self, shape: Shape, paint: impl Into<Paint>) {
        self.push(Figure { shape, paint: paint.into() });
    }

    /// A straight line.
    fn line(&mut self, from: Point, to: Point, stroke: Stroke) {
        self.shape(Shape::Line(from, to), stroke);
    }

    /// Straight lines from point to point.
    fn polyline(&mut self, points: impl IntoIterator<Item = Point>, stroke: Stroke) {
        self.shape(Shape::Polyline(points.into_iter().collect()), stroke);
    }

    /// A closed polygon.
    fn polygon(&mut self, points: impl IntoIterator<Item = Point>, paint: impl Into<Paint>) {
        self.shape(Shape::Area(vec![points.into_iter().collect()]), paint);
    }

    /// An area with holes: rings inside others are cut out.
    fn area(&mut self, rings: Vec<Vec<Point>>, paint: impl Into<Paint>) {
        self.shape(Shape::Area(rings), paint);
    }

    /// A rectangle from its top left corner, width and height.
    fn rect(&mut self, [x, y]: Point, [w, h]: [f64; 2], paint: impl Into<Paint>) {
        self.polygon([[x, y], [x + w, y], [x + w, y + h], [x, y + h]], paint);
    }

    /// A circle.
    fn circle(&mut self, center: Point, radius: f64, paint: impl Into<Paint>) {
        self.shape(Shape::Circle { center, radius }, paint);
    }

    /// A circular arc. Angles in degrees, clockwise as seen, 0 to the right;
    /// a negative sweep runs counter-clockwise.
    fn arc(&mut self, center: Point, radius: f64, from: f64, sweep: f64, stroke: Stroke) {
        self.shape(arc_shape(center, radius, from, sweep), stroke);
    }

    /// A line with a filled arrow head of length `head` (mm) at its end.
    fn arrow(&mut self, from: Point, to: Point, head: f64, stroke: Stroke) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        if length == 0.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let neck = [to[0] - ux * head, to[1] - uy * head];
        if length > head {
            self.line(from, neck, stroke);
        }
        self.arrow_head(to, [ux, uy], head, stroke);
    }

    /// A filled arrow head with its tip at `tip`, pointing along `direction` (any
    /// length but zero), in the colour of `stroke`.
    fn arrow_head(&mut self, tip: Point, direction: [f64; 2], head: f64, stroke: Stroke) {
        let length = direction[0].hypot(direction[1]);
        let (ux, uy) = (direction[0] / length, direction[1] / length);
        let neck = [tip[0] - ux * head, tip[1] - uy * head];
        let half = head * ARROW_WIDTH / 2.0;
        let left = [neck[0] + uy * half, neck[1] - ux * half];
        let right = [neck[0] - uy * half, neck[1] + ux * half];
        self.polygon([tip, left, right], stroke.color);
    }

    /// A line of text; the returned text can be styled further.
    fn text(&mut self, at: Point, size: f64, string: impl Into<String>) -> &mut Text {
        let items = self.items_mut();
        items.push(Item::Text(Text::new(at, size, string)));
        match items.last_mut() {
            Some(Item::Text(text)) => text,
            _ => unreachable!("the text was pushed just above"),
        }
    }

    /// Lines of text below each other, the first baseline at `at`, baselines
    /// `leading` mm apart.
    fn text_lines<S: AsRef<str>>(
        &mut self,
        [x, y]: Point,
        size: f64,
        leading: f64,
        anchor: Anchor,
        lines: impl IntoIterator<Item = S>,
    ) {
        for (i, line) in lines.into_iter().enumerate() {
            self.text([x, y + leading * i as f64], size, line.as_ref()).anchor(anchor);
        }
    }

    /// Copies of the items, moved, turned and scaled.
    fn place<'a>(&mut self, items: impl IntoIterator<Item = &'a Item>, placement: &Placement) {
        let placed = items.into_iter().map(|item| placement.apply(item));
        self.items_mut().extend(placed);
    }
}

impl Draw for Vec<Item> {
    fn items_mut(&mut self) -> &mut Vec<Item> {
        self
    }
}

impl Draw for Layer {
    fn items_mut(&mut self) -> &mut Vec<Item> {
        &mut self.items
    }
}

/// Draws on the topmost layer; the first one is made when there is none.
impl Draw for Drawing {
    fn items_mut(&mut self) -> &mut Vec<Item> {
        if self.layers.is_empty() {
            self.layer(FIRST_LAYER);
        }
        let top = self.layers.len() - 1;
        &mut self.layers[top].items
    }
}

/// A circular arc as cubics. For a piece of angle φ the control points lie
/// 4/3 tan(φ/4) radii along the tangents.
fn arc_shape(center: Point, radius: f64, from: f64, sweep: f64) -> Shape {
    let pieces = (sweep.abs() / ARC_PIECE).ceil().max(1.0);
    let step = (sweep / pieces).to_radians();
    let reach = 4.0 / 3.0 * (step / 4.0).tan();
    let at = |i: f64| (from.to_radians() + step * i).sin_cos();
    let point = |(s, c): (f64, f64)| [center[0] + radius * c, center[1] + radius * s];
    let cubics = (0..pieces as usize)
        .map(|i| {
            let ((s0, c0), (s1, c1)) = (at(i as f64), at(i as f64 + 1.0));
            [
                point((s0 + reach * c0, c0 - reach * s0)),
                point((s1 - reach * c1, c1 + reach * s1)),
                point((s1, c1)),
            ]
        })
        .collect();
    Shape::Curve { start: point(at(0.0)), cubics, closed: false }
}

/// A full circle as four cubics, for renderers without circles.
pub(super) fn circle_cubics(center: Point, radius: f64) -> (Point, Vec<[Point; 3]>) {
    match arc_shape(center, radius, 0.0, 360.0) {
        Shape::Curve { start, cubics, .. } => (start, cubics),
        _ => unreachable!("an arc is a curve"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawing_without_layers_makes_its_first() {
        let mut d = Drawing::new(10.0, 10.0);
        d.line([0.0, 0.0], [1.0, 1.0], Stroke::new(0.1));
        d.layer("CUT").circle([5.0, 5.0], 1.0, Stroke::new(0.1));
        d.text([1.0, 1.0], 3.0, "on CUT, the topmost").bold().middle();
        assert_eq!(
            d.layers.iter().map(|l| (&*l.name, l.items.len())).collect::<Vec<_>>(),
            [(FIRST_LAYER, 1), ("CUT", 2)]
        );
    }

    #[test]
    fn arc_stays_on_its_circle() {
        for sweep in [-300.0, -90.0, 10.0, 90.0, 91.0, 360.0] {
            let Shape::Curve { start, cubics, .. } = arc_shape([3.0, 4.0], 10.0, 20.0, sweep)
            else {
                panic!("an arc is a curve")
            };
            let mut from = start;
            for [a, b, to] in cubics {
                for t in [0.0, 0.2, 0.5, 0.7, 1.0] {
                    let w = [(1.0 - t) * (1.0 - t) * (1.0 - t), 3.0 * t * (1.0 - t) * (1.0 - t)];
                    let v = [3.0 * t * t * (1.0 - t), t * t * t];
                    let p =
                        [0, 1].map(|i| w[0] * from[i] + w[1] * a[i] + v[0] * b[i] + v[1] * to[i]);
                    let r = (p[0] - 3.0_f64).hypot(p[1] - 4.0);
                    assert!((r - 10.0).abs() < 3e-3, "sweep {sweep}, t {t}: radius {r}");
                }
                from = to;
            }
            let (s, c) = (20.0_f64 + sweep).to_radians().sin_cos();
            assert!((from[0] - 3.0 - 10.0 * c).hypot(from[1] - 4.0 - 10.0 * s) < 1e-12);
        }
    }

    #[test]
    fn arrow_ends_at_its_tip() {
        let mut items: Vec<Item> = Vec::new();
        items.arrow([0.0, 0.0], [10.0, 0.0], 2.0, Stroke::new(0.2));
        let bounds = super::super::bounds(&items).expect("two items");
        assert_eq!((bounds.min, bounds.max), ([0.0, -0.6], [10.0, 0.6]));
    }
}
