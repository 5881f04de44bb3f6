//! Points, rectangles, and the extent of a group of items.

use super::{Item, Shape};

/// A point on the sheet, `[x, y]` in mm, y down.
pub type Point = [f64; 2];

/// An upright rectangle, mm.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rect {
    /// Top left corner.
    pub min: Point,
    /// Bottom right corner.
    pub max: Point,
}

impl Rect {
    /// From the top left corner and width and height.
    pub const fn new([x, y]: Point, [width, height]: [f64; 2]) -> Self {
        Self { min: [x, y], max: [x + width, y + height] }
    }

    /// Width, mm.
    pub fn width(&self) -> f64 {
        self.max[0] - self.min[0]
    }

    /// Height, mm.
    pub fn height(&self) -> f64 {
        self.max[1] - self.min[1]
    }

    /// Width and height, mm.
    pub fn size(&self) -> [f64; 2] {
        [self.width(), self.height()]
    }

    /// The middle.
    pub fn center(&self) -> Point {
        [(self.min[0] + self.max[0]) / 2.0, (self.min[1] + self.max[1]) / 2.0]
    }

    /// Smaller by `margin` on every side (larger if it is negative).
    pub fn inset(&self, margin: f64) -> Self {
        Self {
            min: [self.min[0] + margin, self.min[1] + margin],
            max: [self.max[0] - margin, self.max[1] - margin],
        }
    }

    /// Whether a point lies inside or on the edge.
    pub fn contains(&self, [x, y]: Point) -> bool {
        self.min[0] <= x && x <= self.max[0] && self.min[1] <= y && y <= self.max[1]
    }

    /// Whether the other rectangle lies wholly inside or on the edge.
    pub fn contains_rect(&self, other: &Rect) -> bool {
        self.contains(other.min) && self.contains(other.max)
    }

    /// Whether the two share at least a point.
    pub fn overlaps(&self, other: &Rect) -> bool {
        (0..2).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    /// The smallest rectangle that holds all the points; `None` without points.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Option<Self> {
        points.into_iter().fold(None, |all, p| {
            let point = Self { min: p, max: p };
            Some(all.map_or(point, |r: Self| r.union(&point)))
        })
    }

    /// The smallest rectangle that holds both.
    pub fn union(&self, other: &Rect) -> Self {
        Self {
            min: [self.min[0].min(other.min[0]), self.min[1].min(other.min[1])],
            max: [self.max[0].max(other.max[0]), self.max[1].max(other.max[1])],
        }
    }
}

/// The extent of the geometry: line widths do not count, and of a text only its
/// reference point. `None` if there is nothing.
pub fn bounds<'a>(items: impl IntoIterator<Item = &'a Item>) -> Option<Rect> {
    items.into_iter().filter_map(item_bounds).reduce(|a, b| a.union(&b))
}

/// See [`bounds`]. Of a curve the control points are taken: it lies within them.
pub(super) fn item_bounds(item: &Item) -> Option<Rect> {
    match item {
        Item::Text(text) => Some(Rect { min: text.at, max: text.at }),
        Item::Figure(figure) => match &figure.shape {
            Shape::Line(a, b) => Rect::around([*a, *b]),
            Shape::Polyline(points) => Rect::around(points.iter().copied()),
            Shape::Area(rings) => Rect::around(rings.iter().flatten().copied()),
            Shape::Circle { center: [x, y], radius: r } => {
                Rect::around([[x - r, y - r], [x + r, y + r]])
            }
            Shape::Curve { start, cubics, .. } => {
                Rect::around([*start].into_iter().chain(cubics.iter().flatten().copied()))
            }
        },
    }
}
