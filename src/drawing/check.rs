//! What the renderers ask of a drawing before it starts.

use super::{Drawing, DrawingError, Item, Shape};

/// Longest side of a sheet, mm: 14 400 points, the limit of PDF readers.
const LONGEST_SIDE: f64 = 5080.0;

/// Refuses sheets without area and numbers that are not finite.
pub(super) fn check(drawing: &Drawing) -> Result<(), DrawingError> {
    let Drawing { width, height, .. } = *drawing;
    let fits = |side: f64| side > 0.0 && side <= LONGEST_SIDE;
    if !fits(width) || !fits(height) {
        return Err(DrawingError::SheetSize { width, height });
    }
    check_items(drawing)
}

/// Refuses numbers that are not finite.
pub(super) fn check_items(drawing: &Drawing) -> Result<(), DrawingError> {
    for layer in &drawing.layers {
        if let Some(i) = layer.items.iter().position(|item| !is_finite(item)) {
            let place = format!("layer {}, item {}", layer.name, i + 1);
            return Err(DrawingError::NotFinite { place });
        }
    }
    Ok(())
}

fn is_finite(item: &Item) -> bool {
    let all = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
    match item {
        Item::Text(t) => all(&[t.at[0], t.at[1], t.size, t.rotation]),
        Item::Figure(f) => {
            let stroke =
                f.paint.stroke.is_none_or(|s| s.width.is_finite() && all(s.dash.lengths()));
            stroke
                && match &f.shape {
                    Shape::Line(a, b) => all(a) && all(b),
                    Shape::Polyline(points) => points.iter().all(|p| all(p)),
                    Shape::Area(rings) => rings.iter().flatten().all(|p| all(p)),
                    Shape::Circle { center, radius } => all(center) && radius.is_finite(),
                    Shape::Curve { start, cubics, .. } => {
                        all(start) && cubics.iter().flatten().all(|p| all(p))
                    }
                }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Dash, Draw, Stroke};
    use super::*;

    #[test]
    fn not_a_number_is_named_by_its_place() {
        let mut d = Drawing::new(10.0, 10.0);
        d.line([0.0, 0.0], [1.0, 1.0], Stroke::new(0.1));
        d.layer("CUT").circle([0.0, 0.0], 1.0, Stroke::new(0.1));
        assert_eq!(check(&d), Ok(()));
        d.layer("CUT").circle([0.0, 0.0], 1.0, Stroke::new(0.1).dash(Dash::new([f64::NAN, 1.0])));
        let error = check(&d).expect_err("a dash is not a number");
        assert!(error.to_string().starts_with("layer CUT, item 2:"), "{error}");
    }

    #[test]
    fn sheets_without_area_or_too_large_are_refused() {
        for (w, h) in [(0.0, 10.0), (10.0, -1.0), (f64::NAN, 10.0), (10.0, 6000.0)] {
            let error = check(&Drawing::new(w, h)).expect_err("no such sheet");
            assert!(error.hint().is_some());
        }
    }
}
