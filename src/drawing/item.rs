//! What can stand on a sheet: figures and texts.

use super::font::{CAP_HEIGHT, DESCENT, text_width};
use super::{Color, DrawingError, Paint, Point, Rect, Weight};

/// One thing on a sheet.
#[derive(Clone, PartialEq, Debug)]
pub enum Item {
    /// A line, area, circle or curve.
    Figure(Figure),
    /// A line of text.
    Text(Text),
}

impl From<Figure> for Item {
    fn from(figure: Figure) -> Self {
        Self::Figure(figure)
    }
}

impl From<Text> for Item {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

/// A shape and how it is painted.
#[derive(Clone, PartialEq, Debug)]
pub struct Figure {
    /// The shape.
    pub shape: Shape,
    /// Outline and filling. Open shapes (lines, polylines, open curves) have no
    /// filling: it is ignored.
    pub paint: Paint,
}

/// A shape, coordinates in mm.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// A straight line between two points.
    Line(Point, Point),
    /// Straight lines from point to point, open.
    Polyline(Vec<Point>),
    /// Closed rings; the last point of each is joined to its first. A ring inside
    /// another is a hole (even-odd rule).
    Area(Vec<Vec<Point>>),
    /// A circle.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
    /// Cubic Bézier curves, each starting where the one before ends.
    Curve {
        /// Where the first begins.
        start: Point,
        /// Two control points and the end point of each.
        cubics: Vec<[Point; 3]>,
        /// Whether a straight line leads back to the start, around an area.
        closed: bool,
    },
}

impl Shape {
    /// Whether the shape has an inside that can be filled.
    pub fn is_closed(&self) -> bool {
        matches!(self, Self::Area(_) | Self::Circle { .. } | Self::Curve { closed: true, .. })
    }
}

/// Which point of a text its position names.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Anchor {
    /// The left end of the baseline.
    #[default]
    Start,
    /// The middle of the baseline.
    Middle,
    /// The right end of the baseline.
    End,
}

/// One line of text.
#[derive(Clone, PartialEq, Debug)]
pub struct Text {
    /// The anchor point, on the baseline.
    pub at: Point,
    /// Font size, mm: the height of a line set solid. Capitals are
    /// [`CAP_HEIGHT`] times as high.
    pub size: f64,
    /// Which point of the text `at` is.
    pub anchor: Anchor,
    /// Turn about `at`, degrees, clockwise as seen. -90 reads upwards.
    pub rotation: f64,
    /// Regular or bold.
    pub weight: Weight,
    /// Colour of the letters.
    pub color: Color,
    /// The characters.
    pub string: String,
}

impl Text {
    /// Upright black regular text that starts at `at`.
    pub fn new(at: Point, size: f64, string: impl Into<String>) -> Self {
        Self {
            at,
            size,
            anchor: Anchor::Start,
            rotation: 0.0,
            weight: Weight::Regular,
            color: Color::BLACK,
            string: string.into(),
        }
    }

    /// Sets which point of the text its position names.
    pub fn anchor(&mut self, anchor: Anchor) -> &mut Self {
        self.anchor = anchor;
        self
    }

    /// Centres the text on its position along the line.
    pub fn middle(&mut self) -> &mut Self {
        self.anchor(Anchor::Middle)
    }

    /// Lets the text end at its position.
    pub fn end(&mut self) -> &mut Self {
        self.anchor(Anchor::End)
    }

    /// Turns the text about its position, degrees, clockwise as seen.
    pub fn rotate(&mut self, degrees: f64) -> &mut Self {
        self.rotation = degrees;
        self
    }

    /// Makes the text bold.
    pub fn bold(&mut self) -> &mut Self {
        self.weight(Weight::Bold)
    }

    /// Sets the weight.
    pub fn weight(&mut self, weight: Weight) -> &mut Self {
        self.weight = weight;
        self
    }

    /// Sets the colour.
    pub fn color(&mut self, color: Color) -> &mut Self {
        self.color = color;
        self
    }

    /// Moves the text across its line by half the height of a capital, so that its
    /// position becomes the middle of the capitals. To be called after
    /// [`rotate`](Self::rotate).
    pub fn vcenter(&mut self) -> &mut Self {
        let (sin, cos) = self.rotation.to_radians().sin_cos();
        let drop = self.size * CAP_HEIGHT / 2.0;
        self.at = [self.at[0] - drop * sin, self.at[1] + drop * cos];
        self
    }

    /// Length of the line of text, mm.
    pub fn width(&self) -> Result<f64, DrawingError> {
        text_width(&self.string, self.size, self.weight)
    }

    /// The upright rectangle that the letters fill, from the deepest ones up to the
    /// height of capitals.
    pub fn extent(&self) -> Result<Rect, DrawingError> {
        let width = self.width()?;
        let left = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -width / 2.0,
            Anchor::End => -width,
        };
        let (up, down) = (-self.size * CAP_HEIGHT, self.size * DESCENT);
        let (sin, cos) = self.rotation.to_radians().sin_cos();
        let place =
            |[x, y]: Point| [self.at[0] + x * cos - y * sin, self.at[1] + x * sin + y * cos];
        let corners = [[left, up], [left + width, up], [left, down], [left + width, down]];
        let at = Rect { min: self.at, max: self.at };
        Ok(Rect::around(corners.map(place)).unwrap_or(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extent_follows_anchor_and_turn() {
        let mut text = Text::new([10.0, 20.0], 4.0, "R012");
        let width = text.width().unwrap();
        let start = text.extent().unwrap();
        assert_eq!(start.min[0], 10.0);
        assert!((start.max[0] - 10.0 - width).abs() < 1e-12);
        assert!((start.min[1] - (20.0 - 4.0 * CAP_HEIGHT)).abs() < 1e-12);
        let end = text.end().extent().unwrap();
        assert!((end.max[0] - 10.0).abs() < 1e-12);
        // Turned by a quarter, it runs upwards from below its position.
        let up = text.rotate(-90.0).extent().unwrap();
        assert!((up.height() - width).abs() < 1e-12 && (up.min[1] - 20.0).abs() < 1e-12);
    }
}
