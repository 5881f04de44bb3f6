//! Drawings as SVG files.
//!
//! One user unit is one millimetre. Layers become groups that Inkscape shows as its
//! layers. There are no style sheets, clips or transforms except the turn of turned
//! text; text is `<text>`, with its length given so that it keeps its room when the
//! viewer has to take another font.

use svg::node::element::{Circle, Element, Group, Line, Path, Polygon, Polyline};
use svg::{Document, Node};

use super::check::check;
use super::font::{SVG_FAMILIES, text_width};
use super::{Anchor, Cap, Drawing, DrawingError, Figure, Item, Layer, Paint, Point};
use super::{Shape, Text, Weight};

/// Numbers are rounded to this many to the millimetre: finer than any printer or
/// laser, coarse enough to hide the noise of arithmetic.
const STEPS_PER_MM: f64 = 1e4;

/// The whole drawing as the text of an SVG file.
pub fn render(drawing: &Drawing) -> Result<String, DrawingError> {
    check(drawing)?;
    let (width, height) = (number(drawing.width), number(drawing.height));
    let mut document = Document::new()
        .set("xmlns:inkscape", "http://www.inkscape.org/namespaces/inkscape")
        .set("width", format!("{width}mm"))
        .set("height", format!("{height}mm"))
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("font-family", SVG_FAMILIES);
    for layer in &drawing.layers {
        document.append(group(layer)?);
    }
    Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n"))
}

fn group(layer: &Layer) -> Result<Group, DrawingError> {
    let mut group =
        Group::new().set("inkscape:groupmode", "layer").set("inkscape:label", &*layer.name);
    for item in &layer.items {
        match item {
            Item::Figure(f) => group.append(figure(f)),
            Item::Text(t) if t.string.is_empty() => {}
            Item::Text(t) => group.append(text(t)?),
        }
    }
    Ok(group)
}

/// A number as short as it gets after rounding; never `-0`.
fn number(x: f64) -> String {
    // Adding zero turns the minus zero that rounding may leave into zero.
    ((x * STEPS_PER_MM).round() / STEPS_PER_MM + 0.0).to_string()
}

fn points(points: &[Point]) -> String {
    let pairs: Vec<_> =
        points.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y))).collect();
    pairs.join(" ")
}

fn figure(figure: &Figure) -> Element {
    let mut element: Element = match &figure.shape {
        Shape::Line([x1, y1], [x2, y2]) => Line::new()
            .set("x1", number(*x1))
            .set("y1", number(*y1))
            .set("x2", number(*x2))
            .set("y2", number(*y2))
            .into(),
        Shape::Polyline(line) => Polyline::new().set("points", points(line)).into(),
        Shape::Area(rings) => match &rings[..] {
            [ring] => Polygon::new().set("points", points(ring)).into(),
            _ => {
                let rings = rings.iter().filter(|r| !r.is_empty());
                let d: Vec<_> = rings.map(|r| format!("M{}Z", points(r))).collect();
                Path::new().set("d", d.join(" ")).set("fill-rule", "evenodd").into()
            }
        },
        Shape::Circle { center: [x, y], radius } => Circle::new()
            .set("cx", number(*x))
            .set("cy", number(*y))
            .set("r", number(*radius))
            .into(),
        Shape::Curve { start, cubics, closed } => {
            let curves: Vec<_> = cubics.iter().map(|c| format!("C{}", points(c))).collect();
            let end = if *closed { " Z" } else { "" };
            Path::new().set("d", format!("M{} {}{end}", points(&[*start]), curves.join(" "))).into()
        }
    };
    paint(&mut element, &figure.paint, figure.shape.is_closed());
    element
}

fn paint(element: &mut Element, paint: &Paint, closed: bool) {
    match paint.fill {
        Some(color) if closed => element.assign("fill", color.to_string()),
        _ => element.assign("fill", "none"),
    }
    let Some(stroke) = paint.stroke else { return };
    element.assign("stroke", stroke.color.to_string());
    element.assign("stroke-width", number(stroke.width));
    match stroke.cap {
        Cap::Butt => {}
        Cap::Round => {
            element.assign("stroke-linecap", "round");
            element.assign("stroke-linejoin", "round");
        }
        Cap::Square => element.assign("stroke-linecap", "square"),
    }
    if !stroke.dash.lengths().is_empty() {
        let lengths: Vec<_> = stroke.dash.lengths().iter().map(|&l| number(l)).collect();
        element.assign("stroke-dasharray", lengths.join(" "));
    }
}

fn text(text: &Text) -> Result<Element, DrawingError> {
    let [x, y] = text.at;
    let length = text_width(&text.string, text.size, text.weight)?;
    // Not the library's text element: it puts line breaks around the string, which
    // viewers show as spaces.
    let mut node = Element::new("text");
    node.append(svg::node::Text::new(&*text.string));
    node.assign("x", number(x));
    node.assign("y", number(y));
    node.assign("font-size", number(text.size));
    node.assign("fill", text.color.to_string());
    node.assign("textLength", number(length));
    node.assign("lengthAdjust", "spacingAndGlyphs");
    match text.anchor {
        Anchor::Start => {}
        Anchor::Middle => node.assign("text-anchor", "middle"),
        Anchor::End => node.assign("text-anchor", "end"),
    }
    if text.weight == Weight::Bold {
        node.assign("font-weight", "bold");
    }
    if text.rotation != 0.0 {
        let turn = [number(text.rotation), number(x), number(y)].join(" ");
        node.assign("transform", format!("rotate({turn})"));
    }
    let blanks = text.string.starts_with(' ') || text.string.ends_with(' ');
    if blanks || text.string.contains("  ") {
        // Otherwise viewers fold spaces.
        node.assign("xml:space", "preserve");
    }
    Ok(node)
}

#[cfg(test)]
mod tests {
    use super::super::{Color, Dash, Draw, Stroke};
    use super::*;

    #[test]
    fn small_drawing_is_written_in_full() {
        let mut d = Drawing::new(100.0, 50.0);
        d.line([0.1 + 0.2, -1e-9], [10.0, 20.0], Stroke::new(0.25).dash(Dash::new([2.0, 1.0])));
        d.rect([1.0, 2.0], [3.0, 4.0], Stroke::new(0.1).round().fill(Color::BLUE));
        let cut = d.layer("CUT \"1\" & <2>");
        cut.circle([5.0, 5.0], 2.5, Stroke::new(0.01).color(Color::VERMILLION));
        cut.area(
            vec![
                vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]],
                vec![[5.0, 1.0], [8.0, 1.0], [8.0, 4.0]],
            ],
            Color::BLACK,
        );
        insta::assert_snapshot!(render(&d).expect("can be rendered"), @r##"
        <?xml version="1.0" encoding="UTF-8"?>
        <svg font-family="DejaVu Sans Condensed, DejaVu Sans, Arial, sans-serif" height="50mm" viewBox="0 0 100 50" width="100mm" xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">
        <g inkscape:groupmode="layer" inkscape:label="drawing">
        <line fill="none" stroke="#000000" stroke-dasharray="2 1" stroke-width="0.25" x1="0.3" x2="10" y1="0" y2="20"/>
        <polygon fill="#0072B2" points="1,2 4,2 4,6 1,6" stroke="#000000" stroke-linecap="round" stroke-linejoin="round" stroke-width="0.1"/>
        </g>
        <g inkscape:groupmode="layer" inkscape:label="CUT &quot;1&quot; &amp; &lt;2&gt;">
        <circle cx="5" cy="5" fill="none" r="2.5" stroke="#D55E00" stroke-width="0.01"/>
        <path d="M0,0 9,0 9,9Z M5,1 8,1 8,4Z" fill="#000000" fill-rule="evenodd"/>
        </g>
        </svg>
        "##);
    }

    #[test]
    fn text_keeps_its_length_turn_and_signs() {
        let mut d = Drawing::new(100.0, 50.0);
        d.text([10.0, 20.0], 4.0, "Ø 3 <&> \"41°\"").bold().middle().rotate(-90.0);
        d.text([10.0, 20.0], 4.0, "two  spaces").color(Color::GREEN).end();
        d.text([10.0, 20.0], 4.0, "");
        let text = render(&d).expect("can be rendered");
        let texts: Vec<_> = text.lines().filter(|l| l.starts_with("<text")).collect();
        insta::assert_snapshot!(texts.join("\n"), @r##"
        <text fill="#000000" font-size="4" font-weight="bold" lengthAdjust="spacingAndGlyphs" text-anchor="middle" textLength="29.0449" transform="rotate(-90 10 20)" x="10" y="20">Ø 3 &lt;&amp;&gt; "41°"</text>
        <text fill="#009E73" font-size="4" lengthAdjust="spacingAndGlyphs" text-anchor="end" textLength="21.2734" x="10" xml:space="preserve" y="20">two  spaces</text>
        "##);
    }

    #[test]
    fn arc_is_a_path_and_same_drawing_gives_same_text() {
        let mut d = Drawing::new(100.0, 50.0);
        d.arc([10.0, 10.0], 5.0, 0.0, 90.0, Stroke::new(0.1));
        let text = render(&d).expect("can be rendered");
        assert!(text.contains("d=\"M15,10 C15,12.7614 12.7614,15 10,15\""), "{text}");
        assert_eq!(text, render(&d).expect("can be rendered"));
    }

    #[test]
    fn missing_glyph_is_an_error() {
        let mut d = Drawing::new(100.0, 50.0);
        d.text([10.0, 20.0], 4.0, "猫");
        assert!(matches!(render(&d), Err(DrawingError::MissingGlyph { character: '猫', .. })));
    }
}
