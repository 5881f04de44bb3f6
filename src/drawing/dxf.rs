//! Drawings as DXF files for CAD programs and laser cutters.
//!
//! DXF turns y up: a point of the drawing is named as its origin, and one drawing unit is
//! one millimetre. Layers keep their names, in capitals; their colours are the nearest of
//! the format's numbered ones. Fillings become their outlines, line widths and dashes are
//! left to the layers of the program that reads the file. The file format itself is in
//! `file`, `tables` and `document`.

mod document;
mod file;
mod tables;

pub use document::{Document, Entity, Kind, Label, Layer, layer_name};

use super::check::check_items;
use super::clip::flatten;
use super::font::CAP_HEIGHT;
use super::{Anchor, Color, Drawing, DrawingError, Figure, Item, Point, Shape, Text};

/// How far curves may stray when they become straight pieces, mm. More shows on a laser
/// cut; less only adds points.
const FLATNESS: f64 = 0.01;

/// Colours and the numbers (AutoCAD colour index) that stand for them: the inks of the
/// papers, and the pure colours that laser cutters go by.
const INKS: [(Color, u8); 15] = [
    (Color::BLACK, Layer::BLACK),
    (Color::rgb(0xFF, 0x00, 0x00), 1),
    (Color::rgb(0xFF, 0xFF, 0x00), 2),
    (Color::rgb(0x00, 0xFF, 0x00), 3),
    (Color::GREEN, 3),
    (Color::rgb(0x00, 0xFF, 0xFF), 4),
    (Color::rgb(0x00, 0x00, 0xFF), 5),
    (Color::BLUE, 5),
    (Color::rgb(0xFF, 0x00, 0xFF), 6),
    (Color::PURPLE, 6),
    (Color::GREY, 8),
    (Color::DARK_GREY, 8),
    (Color::LIGHT_GREY, 9),
    (Color::PALE_GREY, 9),
    (Color::VERMILLION, 30),
];

/// The whole drawing as the text of a DXF file of release 2000, with `origin`, a point of
/// the drawing, at 0, 0.
///
/// The size of the sheet does not matter: a drawing may be larger than any paper.
///
/// # Errors
/// [`DrawingError::NotFinite`]; [`DrawingError::MissingGlyph`] as from the other renderers.
pub fn render(drawing: &Drawing, origin: Point) -> Result<String, DrawingError> {
    check_items(drawing)?;
    let mut document = Document::default();
    for layer in &drawing.layers {
        for item in &layer.items {
            let Some(color) = ink(item).map(color_number) else { continue };
            let to = document.layer(&layer.name, color);
            match item {
                Item::Figure(f) => outline(f, origin).into_iter().for_each(|k| to.add(color, k)),
                Item::Text(t) => to.add(color, Kind::Text(label(t, origin)?)),
            }
        }
    }
    Ok(document.to_string())
}

/// The colour an item is seen by; `None` for one without any, and for white fillings,
/// which only cover what lies below.
fn ink(item: &Item) -> Option<Color> {
    match item {
        Item::Text(t) => (!t.string.is_empty()).then_some(t.color),
        Item::Figure(f) => match f.paint.stroke {
            Some(stroke) => Some(stroke.color),
            None => f.paint.fill.filter(|&c| f.shape.is_closed() && c != Color::WHITE),
        },
    }
}

/// The number of the nearest colour.
fn color_number(color: Color) -> u8 {
    let apart = |a: u8, b: u8| (i32::from(a) - i32::from(b)).pow(2);
    let far = |ink: Color| apart(ink.r, color.r) + apart(ink.g, color.g) + apart(ink.b, color.b);
    INKS.iter().min_by_key(|(ink, _)| far(*ink)).map_or(Layer::BLACK, |&(_, number)| number)
}

fn outline(figure: &Figure, origin: Point) -> Vec<Kind> {
    let up = |p: &Point| turned_up(*p, origin);
    let polyline = |points: &[Point], closed: bool| Kind::Polyline {
        points: points.iter().map(up).collect(),
        closed,
    };
    match &figure.shape {
        Shape::Line(a, b) => {
            let end = |p: &Point| [up(p)[0], up(p)[1], 0.0];
            vec![Kind::Line([end(a), end(b)])]
        }
        Shape::Polyline(points) => vec![polyline(points, false)],
        Shape::Area(rings) => rings.iter().map(|ring| polyline(ring, true)).collect(),
        Shape::Circle { center, radius } => {
            vec![Kind::Circle { center: up(center), radius: *radius }]
        }
        Shape::Curve { start, cubics, closed } => {
            vec![polyline(&flatten(*start, cubics, FLATNESS), *closed)]
        }
    }
}

/// DXF names the height of capitals, and turns counter-clockwise.
fn label(text: &Text, origin: Point) -> Result<Label, DrawingError> {
    let width = text.width()?;
    let before = match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => width / 2.0,
        Anchor::End => width,
    };
    // Adding zero turns the minus zero of upright text into zero.
    let rotation = (-text.rotation).rem_euclid(360.0) + 0.0;
    let (sin, cos) = rotation.to_radians().sin_cos();
    let at = turned_up(text.at, origin);
    Ok(Label {
        at,
        start: [at[0] - before * cos, at[1] - before * sin],
        anchor: text.anchor,
        height: text.size * CAP_HEIGHT,
        width,
        rotation,
        string: text.string.clone(),
    })
}

fn turned_up([x, y]: Point, origin: Point) -> Point {
    [x - origin[0], origin[1] - y]
}

#[cfg(test)]
#[path = "dxf/tests.rs"]
mod tests;
