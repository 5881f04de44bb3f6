//! What a DXF file holds, as plain data: layers of entities, y up, in space where needed.

use super::file::Writer;
use super::tables;
use crate::drawing::{Anchor, Point};
use std::fmt;

/// Layers in the order in which they are listed and written.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Document {
    /// The layers, no two of the same name.
    pub layers: Vec<Layer>,
}

/// A layer and what lies on it.
#[derive(Clone, PartialEq, Debug)]
pub struct Layer {
    /// A name as [`layer_name`] makes them.
    pub name: String,
    /// Colour index: 1 to 255.
    pub color: u8,
    /// The entities in their order.
    pub entities: Vec<Entity>,
}

impl Layer {
    /// The colour index of black, which is drawn white on dark screens.
    pub const BLACK: u8 = 7;

    /// Puts an entity of this colour index on the layer, if there is anything of it: a line
    /// without length or a circle without radius is left out.
    pub fn add(&mut self, color: u8, kind: Kind) {
        if let Some(kind) = kind.tidied() {
            self.entities.push(Entity { color, kind });
        }
    }
}

/// One thing in the file.
#[derive(Clone, PartialEq, Debug)]
pub struct Entity {
    /// Colour index: 1 to 255.
    pub color: u8,
    /// What it is.
    pub kind: Kind,
}

/// The kinds of entities, mm, y up.
#[derive(Clone, PartialEq, Debug)]
pub enum Kind {
    /// A straight line in space.
    Line([[f64; 3]; 2]),
    /// A triangle in space.
    Face([[f64; 3]; 3]),
    /// Straight lines from point to point on the ground.
    Polyline {
        /// The corners; the first is not repeated where the line is closed.
        points: Vec<Point>,
        /// Whether the last corner is joined to the first.
        closed: bool,
    },
    /// A circle on the ground.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
    /// A line of text.
    Text(Label),
}

/// A line of text.
#[derive(Clone, PartialEq, Debug)]
pub struct Label {
    /// The point of its baseline that `anchor` names.
    pub at: Point,
    /// The left end of its baseline.
    pub start: Point,
    /// Which point of the text `at` is.
    pub anchor: Anchor,
    /// Height of capitals.
    pub height: f64,
    /// Length of the line.
    pub width: f64,
    /// Turn, degrees, counter-clockwise, 0 to 360.
    pub rotation: f64,
    /// The characters.
    pub string: String,
}

/// Points nearer than this are one, mm: the step of the numbers that are written. Less, and
/// lines of no length could be written; more, and details would be lost.
const SAME: f64 = 1e-6;

impl Kind {
    /// Without repeated points; `None` if nothing is left to draw.
    fn tidied(self) -> Option<Self> {
        match self {
            Self::Line([a, b]) => (0..3).any(|i| (a[i] - b[i]).abs() > SAME).then_some(self),
            Self::Circle { radius, .. } => (radius > SAME).then_some(self),
            Self::Polyline { mut points, closed } => {
                let same = |a: &Point, b: &Point| (0..2).all(|i| (a[i] - b[i]).abs() <= SAME);
                points.dedup_by(|a, b| same(a, b));
                while closed && points.len() > 1 && same(&points[0], &points[points.len() - 1]) {
                    points.pop();
                }
                (points.len() > 1).then_some(Self::Polyline { points, closed })
            }
            Self::Face(_) | Self::Text(_) => Some(self),
        }
    }

    /// Points whose box is that of the whole.
    fn hull(&self) -> Vec<[f64; 3]> {
        let flat = |[x, y]: Point| [x, y, 0.0];
        match self {
            Self::Line(ends) => ends.to_vec(),
            Self::Face(corners) => corners.to_vec(),
            Self::Polyline { points, .. } => points.iter().map(|&p| flat(p)).collect(),
            Self::Circle { center: [x, y], radius } => {
                vec![[x - radius, y - radius, 0.0], [x + radius, y + radius, 0.0]]
            }
            Self::Text(t) => {
                let (sin, cos) = t.rotation.to_radians().sin_cos();
                let corner = |u: f64, v: f64| {
                    flat([t.start[0] + u * cos - v * sin, t.start[1] + u * sin + v * cos])
                };
                let (w, h) = (t.width, t.height);
                vec![corner(0.0, 0.0), corner(w, 0.0), corner(0.0, h), corner(w, h)]
            }
        }
    }
}

impl Document {
    /// The layer of that name, made with this colour index if there is none yet. Names that
    /// only differ in case or in signs that are not allowed are one.
    pub fn layer(&mut self, name: &str, color: u8) -> &mut Layer {
        let name = layer_name(name);
        let at = self.layers.iter().position(|l| l.name == name).unwrap_or_else(|| {
            self.layers.push(Layer { name, color, entities: Vec::new() });
            self.layers.len() - 1
        });
        &mut self.layers[at]
    }

    /// The box round everything; without anything, the origin.
    pub fn extent(&self) -> [[f64; 3]; 2] {
        let entities = self.layers.iter().flat_map(|l| &l.entities);
        let corners = entities.flat_map(|e| e.kind.hull()).fold(None, |all, p| {
            let [lo, hi] = all.unwrap_or([p; 2]);
            Some([
                std::array::from_fn(|i| p[i].min(lo[i])),
                std::array::from_fn(|i| p[i].max(hi[i])),
            ])
        });
        corners.unwrap_or([[0.0; 3]; 2])
    }
}

/// The file: an ASCII DXF of release 2000 (AC1015), always the same for the same document.
impl fmt::Display for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut body = Writer::default();
        tables::before_entities(&mut body, self);
        body.section("ENTITIES");
        for layer in &self.layers {
            for entity in &layer.entities {
                write_entity(&mut body, layer, entity);
            }
        }
        body.end_section();
        tables::objects(&mut body);
        // The header names the first free handle, so it is written last.
        let mut head = Writer::default();
        tables::header(&mut head, self.extent(), body.next_handle());
        f.write_str(head.text())?;
        f.write_str(body.text())?;
        f.write_str("  0\nEOF\n")
    }
}

fn write_entity(out: &mut Writer, layer: &Layer, entity: &Entity) {
    let begin = |out: &mut Writer, name: &str, class: &str| {
        out.pair(0, name);
        out.new_handle();
        out.owner(tables::MODEL_SPACE);
        out.pair(100, "AcDbEntity");
        out.pair(8, &layer.name);
        if entity.color != layer.color {
            out.pair(62, entity.color);
        }
        out.pair(100, class);
    };
    match &entity.kind {
        Kind::Line([a, b]) => {
            begin(out, "LINE", "AcDbLine");
            out.point(10, *a);
            out.point(11, *b);
        }
        Kind::Face([a, b, c]) => {
            begin(out, "3DFACE", "AcDbFace");
            // Faces have four corners; of a triangle the last two are one.
            for (code, corner) in [(10, a), (11, b), (12, c), (13, c)] {
                out.point(code, *corner);
            }
        }
        Kind::Polyline { points, closed } => {
            begin(out, "LWPOLYLINE", "AcDbPolyline");
            out.pair(90, points.len());
            out.pair(70, u8::from(*closed));
            out.real(43, 0.0);
            for p in points {
                out.real(10, p[0]);
                out.real(20, p[1]);
            }
        }
        Kind::Circle { center: [x, y], radius } => {
            begin(out, "CIRCLE", "AcDbCircle");
            out.point(10, [*x, *y, 0.0]);
            out.real(40, *radius);
        }
        Kind::Text(label) => {
            begin(out, "TEXT", "AcDbText");
            write_label(out, label);
        }
    }
}

fn write_label(out: &mut Writer, label: &Label) {
    let anchor = match label.anchor {
        Anchor::Start => 0,
        Anchor::Middle => 1,
        Anchor::End => 2,
    };
    let flat = |[x, y]: Point| [x, y, 0.0];
    out.point(10, flat(label.start));
    out.real(40, label.height);
    out.pair(1, escaped(&label.string));
    if label.rotation != 0.0 {
        out.real(50, label.rotation);
    }
    if anchor != 0 {
        out.pair(72, anchor);
        out.point(11, flat(label.at));
    }
    // The class is named a second time before the fields of upright alignment.
    out.pair(100, "AcDbText");
}

/// A string of ASCII: other letters as `\U+00D8`, those beyond four digits as the two
/// halves of UTF-16. `%%` and `^` begin codes, so they are written as codes themselves;
/// signs that would break the line become spaces.
fn escaped(string: &str) -> String {
    let mut out = String::new();
    for c in string.chars() {
        match c {
            '^' => out.push_str("^ "),
            '%' if string.contains("%%") => out.push_str(r"\U+0025"),
            '\\' => out.push_str(r"\U+005C"),
            c if c.is_control() => out.push(' '),
            c if c.is_ascii() => out.push(c),
            c => {
                let mut units = [0; 2];
                for unit in c.encode_utf16(&mut units) {
                    out.push_str(&format!(r"\U+{unit:04X}"));
                }
            }
        }
    }
    out
}

/// Longest name of a layer.
const LONGEST_NAME: usize = 255;

/// A name that a layer may have: capitals, figures and ASCII signs but those that are kept
/// for other uses, which become `_`.
pub fn layer_name(name: &str) -> String {
    let legal = |c: char| match c {
        c if !c.is_ascii() || c.is_ascii_control() || r#"<>/\":;?*|,=`'"#.contains(c) => '_',
        c => c.to_ascii_uppercase(),
    };
    let name: String = name.trim().chars().take(LONGEST_NAME).map(legal).collect();
    if name.is_empty() { "_".to_owned() } else { name }
}
