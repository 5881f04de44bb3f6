//! Cutting items to a rectangle, geometrically.
//!
//! The lines themselves are cut (no clip paths), so that the result can be tiled
//! over pages, written to CAD files and measured. Lines by Liang and Barsky's
//! parametric rule; filled rings by Sutherland and Hodgman's, one side at a time.

use super::draw::circle_cubics;
use super::geometry::item_bounds;
use super::{Figure, Item, Paint, Point, Rect, Shape};

/// How far a cut circle or curve may stray from the true one when it becomes
/// straight pieces, mm. A tenth of a fine line's width; smaller only adds points.
const FLATNESS: f64 = 0.005;

/// The parts of the items inside `rect`.
///
/// What lies wholly inside stays as it is. A cut polyline becomes as many
/// polylines as it enters the rectangle; a cut area becomes its filling (cut, no
/// outline) and its outline as polylines, without lines along the cut; cut circles
/// and curves become straight pieces. A dash pattern starts anew where a line
/// enters. Text is not cut: it stays whole if its reference point is inside.
pub fn clip(items: &[Item], rect: Rect) -> Vec<Item> {
    let mut out = Vec::new();
    for item in items {
        match item_bounds(item) {
            Some(b) if rect.contains_rect(&b) => out.push(item.clone()),
            Some(b) if rect.overlaps(&b) => {
                if let Item::Figure(figure) = item {
                    clip_figure(figure, rect, &mut out);
                }
            }
            _ => {}
        }
    }
    out
}

fn clip_figure(figure: &Figure, rect: Rect, out: &mut Vec<Item>) {
    let rings = rings(&figure.shape);
    let closed = figure.shape.is_closed();
    if let (true, Some(fill)) = (closed, figure.paint.fill) {
        let cut: Vec<_> =
            rings.iter().map(|r| clip_ring(r, rect)).filter(|r| r.len() >= 3).collect();
        if !cut.is_empty() {
            out.push(Figure { shape: Shape::Area(cut), paint: fill.into() }.into());
        }
    }
    let Some(stroke) = figure.paint.stroke else { return };
    for ring in &rings {
        for piece in clip_polyline(ring, closed, rect) {
            let shape = match piece[..] {
                [a, b] => Shape::Line(a, b),
                _ => Shape::Polyline(piece),
            };
            out.push(Figure { shape, paint: Paint::from(stroke) }.into());
        }
    }
}

/// The shape as straight pieces: one list of points a ring, not repeating the first.
fn rings(shape: &Shape) -> Vec<Vec<Point>> {
    match shape {
        Shape::Line(a, b) => vec![vec![*a, *b]],
        Shape::Polyline(points) => vec![points.clone()],
        Shape::Area(rings) => rings.clone(),
        Shape::Circle { center, radius } => {
            let (start, cubics) = circle_cubics(*center, *radius);
            vec![flatten(start, &cubics, FLATNESS)]
        }
        Shape::Curve { start, cubics, .. } => vec![flatten(*start, cubics, FLATNESS)],
    }
}

/// Points along Bézier curves, no further from them than `flatness` (mm).
///
/// With n equal steps the chords of a cubic stray at most M/(8n²), where M bounds
/// its second derivative: 6 times the largest second difference of its points.
pub(super) fn flatten(start: Point, cubics: &[[Point; 3]], flatness: f64) -> Vec<Point> {
    let mut points = vec![start];
    let mut from = start;
    for &[a, b, to] in cubics {
        let bend = |p: Point, q: Point, r: Point| {
            (p[0] - 2.0 * q[0] + r[0]).hypot(p[1] - 2.0 * q[1] + r[1])
        };
        let second = 6.0 * bend(from, a, b).max(bend(a, b, to));
        let steps = (second / (8.0 * flatness)).sqrt().ceil().max(1.0);
        for i in 1..=steps as usize {
            let t = i as f64 / steps;
            let u = 1.0 - t;
            points.push([0, 1].map(|k| {
                u * u * u * from[k]
                    + 3.0 * t * u * u * a[k]
                    + 3.0 * t * t * u * b[k]
                    + t * t * t * to[k]
            }));
        }
        from = to;
    }
    points
}

/// The runs of a polyline inside `rect`. A run that would have no length is left
/// out.
fn clip_polyline(points: &[Point], closed: bool, rect: Rect) -> Vec<Vec<Point>> {
    let mut runs: Vec<Vec<Point>> = Vec::new();
    let close = match points {
        [first, .., last] if closed => Some((*last, *first)),
        _ => None,
    };
    let segments = points.windows(2).map(|w| (w[0], w[1])).chain(close);
    // Whether the last run ends at a corner that the next segment goes on from.
    let mut open = false;
    for (a, b) in segments {
        let Some((t0, t1)) = clip_segment(a, b, rect) else {
            open = false;
            continue;
        };
        let (from, to) = (between(a, b, t0), between(a, b, t1));
        match runs.last_mut() {
            Some(run) if open && t0 == 0.0 => run.push(to),
            _ => runs.push(vec![from, to]),
        }
        open = t1 == 1.0;
    }
    join_ends(&mut runs, closed);
    runs
}

/// A closed line that starts inside is cut in two there: sew it together.
fn join_ends(runs: &mut Vec<Vec<Point>>, closed: bool) {
    if closed && runs.len() > 1 && runs[0].first() == runs[runs.len() - 1].last() {
        let head = runs.remove(0);
        if let Some(tail) = runs.last_mut() {
            tail.extend_from_slice(&head[1..]);
        }
    }
}

/// Whether a straight line has a part in `rect`.
pub fn crosses([a, b]: [Point; 2], rect: Rect) -> bool {
    clip_segment(a, b, rect).is_some()
}

/// The part of a straight line in `rect`; `None` if it has no length.
pub fn within([a, b]: [Point; 2], rect: Rect) -> Option<[Point; 2]> {
    clip_segment(a, b, rect).map(|(from, to)| [between(a, b, from), between(a, b, to)])
}

/// The part of the line from `a` to `b` inside `rect` as parameters 0 to 1.
/// `None` if it has no length.
fn clip_segment(a: Point, b: Point, rect: Rect) -> Option<(f64, f64)> {
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        let d = b[i] - a[i];
        if d == 0.0 {
            if a[i] < rect.min[i] || a[i] > rect.max[i] {
                return None;
            }
        } else {
            let (near, far) =
                if d > 0.0 { (rect.min[i], rect.max[i]) } else { (rect.max[i], rect.min[i]) };
            t0 = t0.max((near - a[i]) / d);
            t1 = t1.min((far - a[i]) / d);
        }
    }
    (t0 < t1).then_some((t0, t1))
}

fn between(a: Point, b: Point, t: f64) -> Point {
    if t == 0.0 {
        a
    } else if t == 1.0 {
        b
    } else {
        [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
    }
}

/// A closed ring cut to `rect`, running along the cut where it was outside.
fn clip_ring(ring: &[Point], rect: Rect) -> Vec<Point> {
    let sides = [(0, rect.min[0], 1.0), (0, rect.max[0], -1.0)]
        .into_iter()
        .chain([(1, rect.min[1], 1.0), (1, rect.max[1], -1.0)]);
    let mut points = ring.to_vec();
    for (axis, limit, sign) in sides {
        let depth = |p: Point| (p[axis] - limit) * sign;
        let mut kept = Vec::with_capacity(points.len() + 4);
        for (i, &b) in points.iter().enumerate() {
            let a = points[(i + points.len() - 1) % points.len()];
            let (da, db) = (depth(a), depth(b));
            if (da < 0.0) != (db < 0.0) {
                let mut cut = between(a, b, da / (da - db));
                cut[axis] = limit;
                kept.push(cut);
            }
            if db >= 0.0 {
                kept.push(b);
            }
        }
        points = kept;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::super::{Color, Draw, Stroke, bounds};
    use super::*;

    const RECT: Rect = Rect { min: [0.0, 0.0], max: [10.0, 10.0] };
    const PEN: Stroke = Stroke::new(0.1);

    fn points(items: &[Item]) -> Vec<Vec<Point>> {
        items
            .iter()
            .map(|i| match i {
                Item::Figure(f) => rings(&f.shape).concat(),
                Item::Text(t) => vec![t.at],
            })
            .collect()
    }

    #[test]
    fn line_is_cut_on_both_sides() {
        let mut items = Vec::new();
        items.line([-5.0, 5.0], [15.0, 5.0], PEN);
        items.line([-5.0, 12.0], [15.0, 12.0], PEN);
        items.line([2.0, 2.0], [3.0, 3.0], PEN);
        assert_eq!(
            points(&clip(&items, RECT)),
            [vec![[0.0, 5.0], [10.0, 5.0]], vec![[2.0, 2.0], [3.0, 3.0]]]
        );
    }

    #[test]
    fn polyline_that_leaves_and_returns_becomes_two() {
        let mut items = Vec::new();
        items.polyline([[2.0, 2.0], [8.0, 2.0], [14.0, 2.0], [14.0, 6.0], [4.0, 6.0]], PEN);
        assert_eq!(
            points(&clip(&items, RECT)),
            [vec![[2.0, 2.0], [8.0, 2.0], [10.0, 2.0]], vec![[10.0, 6.0], [4.0, 6.0]]]
        );
    }

    #[test]
    fn closed_outline_has_no_line_along_the_cut() {
        let mut items = Vec::new();
        items.rect([5.0, 2.0], [10.0, 6.0], PEN.fill(Color::GREY));
        let cut = clip(&items, RECT);
        assert_eq!(
            points(&cut),
            [
                vec![[5.0, 2.0], [10.0, 2.0], [10.0, 8.0], [5.0, 8.0]],
                vec![[10.0, 8.0], [5.0, 8.0], [5.0, 2.0], [10.0, 2.0]]
            ]
        );
    }

    #[test]
    fn ring_that_starts_inside_is_one_piece() {
        let mut items = Vec::new();
        items.polygon([[5.0, 5.0], [15.0, 5.0], [5.0, 8.0]], PEN);
        let cut = points(&clip(&items, RECT));
        assert_eq!(cut, [vec![[10.0, 6.5], [5.0, 8.0], [5.0, 5.0], [10.0, 5.0]]]);
    }

    #[test]
    fn cut_circle_keeps_its_radius_and_whole_circle_its_shape() {
        let mut items = Vec::new();
        items.circle([10.0, 5.0], 4.0, PEN);
        items.circle([5.0, 5.0], 4.0, PEN);
        let cut = clip(&items, RECT);
        assert_eq!(cut.len(), 2);
        let half = &points(&cut)[0];
        assert!(half.iter().all(|p| ((p[0] - 10.0).hypot(p[1] - 5.0) - 4.0).abs() < 0.01));
        let length = length(half);
        assert!((length - 4.0 * std::f64::consts::PI).abs() < 0.02, "half circle {length}");
        assert_eq!(cut[1], items[1]);
    }

    #[test]
    fn area_with_hole_keeps_its_hole() {
        let mut items = Vec::new();
        let square = |a: f64, b: f64| vec![[a, a], [b, a], [b, b], [a, b]];
        items.area(vec![square(-5.0, 5.0), square(-2.0, 2.0)], Color::BLACK);
        let [Item::Figure(f)] = &clip(&items, RECT)[..] else { panic!("one figure") };
        assert_eq!(rings(&f.shape).len(), 2);
        assert_eq!(bounds(&clip(&items, RECT)), Some(Rect::new([0.0, 0.0], [5.0, 5.0])));
    }

    fn length(points: &[Point]) -> f64 {
        points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum()
    }

    fn enclosed(ring: &[Point]) -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
    }

    proptest::proptest! {
        #[test]
        fn tiles_share_out_all_length_and_area(
            corners in proptest::collection::vec([0.0..20.0, 0.0..20.0], 3..12),
        ) {
            let tiles = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0], [10.0, 10.0]];
            let mut outline = corners.clone();
            outline.push(corners[0]);
            let (mut total, mut area) = (0.0, 0.0);
            for tile in tiles.map(|corner| Rect::new(corner, [10.0, 10.0])) {
                total += clip_polyline(&corners, true, tile).iter().map(|p| length(p)).sum::<f64>();
                area += enclosed(&clip_ring(&corners, tile));
            }
            proptest::prop_assert!((total - length(&outline)).abs() < 1e-9);
            proptest::prop_assert!((area - enclosed(&corners)).abs() < 1e-9);
        }
    }

    #[test]
    fn empty_and_degenerate_shapes_vanish_or_stay_without_panic() {
        let mut items = Vec::new();
        items.polyline([], PEN);
        items.area(vec![vec![]], PEN);
        items.polygon([[-1.0, -1.0], [11.0, 11.0]], PEN.fill(Color::BLACK));
        items.area(vec![vec![], vec![[-1.0, 5.0], [11.0, 5.0], [11.0, 6.0]]], PEN);
        assert!(clip(&items, RECT).len() >= 2);
    }

    #[test]
    fn text_stays_by_its_reference_point() {
        let mut items = Vec::new();
        items.text([9.0, 5.0], 3.0, "kept");
        items.text([11.0, 5.0], 3.0, "gone").end();
        assert_eq!(clip(&items, RECT), items[..1]);
    }

    #[test]
    fn lines_that_pass_by_do_not_cross() {
        let rect = Rect::new([0.0; 2], [10.0, 10.0]);
        assert!(crosses([[-5.0, 5.0], [15.0, 6.0]], rect));
        assert!(crosses([[5.0, 5.0], [6.0, 6.0]], rect));
        assert!(!crosses([[-5.0, 5.0], [5.0, 15.1]], rect));
        assert!(!crosses([[11.0, 0.0], [11.0, 10.0]], rect));
    }
}
