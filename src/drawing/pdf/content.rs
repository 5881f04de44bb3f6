//! What stands on a page as PDF operations.
//!
//! PDF measures in points with y up. Colours, widths and dashes are states that
//! hold until they are changed; they are written only where they change.

use printpdf::WindingOrder;
use printpdf::{Codepoint, Line, LineCapStyle, LineDashPattern, LineJoinStyle, LinePoint, Op};
use printpdf::{PaintMode, PdfFontHandle, Polygon, PolygonRing, Pt, Rgb, TextItem, TextMatrix};

use super::{Fonts, Layers, PT_PER_MM, pt};
use crate::drawing::draw::circle_cubics;
use crate::drawing::font::{glyphs, text_width};
use crate::drawing::{Anchor, Cap, Color, Drawing, DrawingError, Figure, Item};
use crate::drawing::{Point, Shape, Stroke, Text};

/// How far a mitred corner may reach out, in line widths. The value that SVG
/// starts with, so that both formats draw sharp corners alike.
const MITER_LIMIT: f32 = 4.0;

/// The operations that draw a page.
pub(super) fn page_ops(
    drawing: &Drawing,
    fonts: &Fonts,
    layers: &Layers,
) -> Result<Vec<Op>, DrawingError> {
    let mut page = Content::new(drawing.height, fonts);
    for layer in &drawing.layers {
        let id = layers.id(&layer.name);
        if let Some(id) = id {
            page.ops.push(Op::BeginLayer { layer_id: id.clone() });
        }
        for item in &layer.items {
            match item {
                Item::Figure(f) => page.figure(f),
                Item::Text(t) => page.text(t)?,
            }
        }
        if id.is_some() {
            page.ops.push(Op::EndLayer);
        }
    }
    Ok(page.ops)
}

/// The operations so far and the state they leave.
struct Content<'a> {
    height: f64,
    fonts: &'a Fonts,
    ops: Vec<Op>,
    stroke: Option<Stroke>,
    fill: Option<Color>,
}

impl<'a> Content<'a> {
    fn new(height: f64, fonts: &'a Fonts) -> Self {
        let ops = vec![Op::SetMiterLimit { limit: Pt(MITER_LIMIT) }];
        Self { height, fonts, ops, stroke: None, fill: None }
    }

    fn point(&self, [x, y]: Point) -> printpdf::Point {
        printpdf::Point { x: pt(x), y: pt(self.height - y) }
    }

    fn corner(&self, p: Point) -> LinePoint {
        LinePoint { p: self.point(p), bezier: false }
    }

    fn corners(&self, points: &[Point]) -> Vec<LinePoint> {
        points.iter().map(|&p| self.corner(p)).collect()
    }

    fn curve(&self, start: Point, cubics: &[[Point; 3]]) -> Vec<LinePoint> {
        let handle = |p| LinePoint { p: self.point(p), bezier: true };
        let pieces = cubics.iter().flat_map(|&[a, b, to]| [handle(a), handle(b), self.corner(to)]);
        std::iter::once(self.corner(start)).chain(pieces).collect()
    }

    fn figure(&mut self, figure: &Figure) {
        let rings: Vec<Vec<LinePoint>> = match &figure.shape {
            Shape::Line(a, b) => vec![self.corners(&[*a, *b])],
            Shape::Polyline(points) => vec![self.corners(points)],
            Shape::Area(rings) => rings.iter().map(|r| self.corners(r)).collect(),
            Shape::Circle { center, radius } => {
                let (start, cubics) = circle_cubics(*center, *radius);
                vec![self.curve(start, &cubics)]
            }
            Shape::Curve { start, cubics, .. } => vec![self.curve(*start, cubics)],
        };
        let closed = figure.shape.is_closed();
        if let (true, Some(fill)) = (closed, figure.paint.fill) {
            self.set_fill(fill);
            let polygon = Polygon {
                rings: rings.iter().map(|r| PolygonRing { points: r.clone() }).collect(),
                mode: PaintMode::Fill,
                winding_order: WindingOrder::EvenOdd,
            };
            self.ops.push(Op::DrawPolygon { polygon });
        }
        if let Some(stroke) = figure.paint.stroke {
            self.set_stroke(stroke);
            // Each ring by itself: stroked together, only the last would be closed.
            for points in rings {
                self.ops.push(Op::DrawLine { line: Line { points, is_closed: closed } });
            }
        }
    }

    fn set_fill(&mut self, color: Color) {
        if self.fill != Some(color) {
            self.ops.push(Op::SetFillColor { col: rgb(color) });
            self.fill = Some(color);
        }
    }

    fn set_stroke(&mut self, new: Stroke) {
        let old = self.stroke;
        if old.map(|s| s.color) != Some(new.color) {
            self.ops.push(Op::SetOutlineColor { col: rgb(new.color) });
        }
        if old.map(|s| s.width) != Some(new.width) {
            self.ops.push(Op::SetOutlineThickness { pt: pt(new.width) });
        }
        if old.map(|s| s.dash) != Some(new.dash) {
            let lengths: Vec<f32> = new.dash.lengths().iter().map(|&l| pt(l).0).collect();
            self.ops.push(Op::SetLineDashPattern { dash: LineDashPattern::new(0.0, &lengths) });
        }
        if old.map(|s| s.cap) != Some(new.cap) {
            let (cap, join) = match new.cap {
                Cap::Butt => (LineCapStyle::Butt, LineJoinStyle::Miter),
                Cap::Round => (LineCapStyle::Round, LineJoinStyle::Round),
                Cap::Square => (LineCapStyle::ProjectingSquare, LineJoinStyle::Miter),
            };
            self.ops.push(Op::SetLineCapStyle { cap });
            self.ops.push(Op::SetLineJoinStyle { join });
        }
        self.stroke = Some(new);
    }

    fn text(&mut self, text: &Text) -> Result<(), DrawingError> {
        // No text of this weight: then this one is empty.
        let Some(font) = self.fonts.of(text.weight) else { return Ok(()) };
        if text.string.is_empty() {
            return Ok(());
        }
        let shown: Vec<Codepoint> = glyphs(&text.string, text.weight)?
            .iter()
            .filter_map(|glyph| font.glyphs.get(glyph))
            .map(|&(new, c)| Codepoint::with_cid(new, 0.0, c.to_string()))
            .collect();

        // Degrees run clockwise, y down; the matrix is for y up.
        let (sin, cos) = text.rotation.to_radians().sin_cos();
        let back = text_width(&text.string, text.size, text.weight)?
            * match text.anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
        let start = self.point([text.at[0] - back * cos, text.at[1] - back * sin]);
        let [c, s] = [cos, sin].map(|x| ((x * 1e6).round() / 1e6 + 0.0) as f32);
        self.set_fill(text.color);
        let size = Pt((text.size * PT_PER_MM) as f32);
        self.ops.extend([
            Op::StartTextSection,
            Op::SetFont { font: PdfFontHandle::External(font.id()), size },
            Op::SetTextMatrix { matrix: TextMatrix::Raw([c, 0.0 - s, s, c, start.x.0, start.y.0]) },
            Op::ShowText { items: vec![TextItem::GlyphIds(shown)] },
            Op::EndTextSection,
        ]);
        Ok(())
    }
}

fn rgb(color: Color) -> printpdf::Color {
    // Three decimals still tell 256 steps apart.
    let part = |c: u8| (f32::from(c) / 255.0 * 1e3).round() / 1e3;
    printpdf::Color::Rgb(Rgb::new(part(color.r), part(color.g), part(color.b), None))
}
