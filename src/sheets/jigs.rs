//! Sheets of jigs as laser cutters read them: cut, score and engrave told apart by colour.
//!
//! Everything is lines, numbers too. On each layer and between them, what comes first is
//! burnt first: engraving, scoring, inner cuts, and outer cuts last, when a part may drop.

use super::profile::LaserProfile;
use crate::drawing::{Color, Draw, Drawing, Figure, Paint, Placement, Point, Shape, Stroke};
use crate::shop::Jigs;
use crate::shop::laser::{Board, Curve, MARGIN, REFERENCE, rectangle};

/// The layers, as Inkscape shows them and CAD programs list them.
const ENGRAVE: &str = "ENGRAVE";
const SCORE: &str = "SCORE";
const CUT: &str = "CUT";
const CUT_INNER: &str = "CUT inner";
const CUT_OUTER: &str = "CUT outer";
const GUIDE: &str = "GUIDE";

/// Width of lines in CAD files, mm, where it does not matter.
const HAIRLINE: f64 = 0.01;

/// The sheets for a laser's own program: one drawing each.
pub fn laser_sheets(jigs: &Jigs, profile: LaserProfile) -> Vec<Drawing> {
    let [cut, score, engrave] = profile.colors();
    let pen = |color| Stroke::new(profile.stroke()).color(color);
    let inks = Inks { engrave: engrave.into(), score: pen(score), cut: pen(cut) };
    let sheet = |boards: &Vec<Board>| drawn(jigs.sheet, boards, &inks, [CUT_INNER, CUT_OUTER]);
    jigs.sheets.iter().map(sheet).collect()
}

/// The sheets for CAD programs: one drawing each, with the edge of the sheet on a layer of its
/// own.
pub fn cad_sheets(jigs: &Jigs) -> Vec<Drawing> {
    let pen = |color| Stroke::new(HAIRLINE).color(color);
    let inks = Inks {
        engrave: pen(Color::BLACK).into(),
        score: pen(Color::rgb(0x00, 0x00, 0xFF)),
        cut: pen(Color::rgb(0xFF, 0x00, 0x00)),
    };
    let sheet = |boards: &Vec<Board>| {
        let mut drawing = drawn(jigs.sheet, boards, &inks, [CUT, CUT]);
        let [width, height] = jigs.sheet;
        drawing.layer(GUIDE).rect([0.0; 2], [width, height], pen(Color::GREY));
        drawing
    };
    jigs.sheets.iter().map(sheet).collect()
}

/// Between sheets that stand on one drawing, mm.
const APART: f64 = 20.0;

/// Longest side of a drawing of several sheets, mm: no larger one can be rendered.
const LONGEST: f64 = 5000.0;

/// All sheets on one drawing, in rows as even as can be. None where they do not fit on 5 m.
pub fn together(sheets: &[Drawing]) -> Option<Drawing> {
    let largest = |side: fn(&Drawing) -> f64| sheets.iter().map(side).fold(0.0, f64::max);
    let pitch = [largest(|sheet| sheet.width) + APART, largest(|sheet| sheet.height) + APART];
    let size = |columns: usize| {
        let count = [columns, sheets.len().div_ceil(columns)];
        [0, 1].map(|i| count[i] as f64 * pitch[i] - APART)
    };
    let longest = |columns: usize| size(columns).into_iter().fold(0.0, f64::max);
    let columns = (1..=sheets.len()).min_by(|&p, &q| longest(p).total_cmp(&longest(q)))?;
    if longest(columns) > LONGEST {
        return None;
    }
    let [width, height] = size(columns);
    let mut all = Drawing::new(width, height);
    // In the order in which they are burnt, also where the first sheet lacks one.
    for layer in [ENGRAVE, SCORE, CUT, CUT_INNER, CUT_OUTER, GUIDE] {
        all.layer(layer);
    }
    for (i, sheet) in sheets.iter().enumerate() {
        let corner = [(i % columns) as f64 * pitch[0], (i / columns) as f64 * pitch[1]];
        all.place_drawing(sheet, &Placement::at(corner));
    }
    all.layers.retain(|layer| !layer.items.is_empty());
    Some(all)
}

/// How each kind of line is painted.
struct Inks {
    engrave: Paint,
    score: Stroke,
    cut: Stroke,
}

/// Boards on a sheet; `[inner, outer]` are the layers of cuts.
fn drawn(
    [width, height]: [f64; 2],
    boards: &[Board],
    inks: &Inks,
    [inner, outer]: [&str; 2],
) -> Drawing {
    let mut sheet = Drawing::new(width, height);
    // Boards have y up.
    let down = |&[x, y]: &Point| [x, height - y];
    let path = |points: &[Point]| points.iter().map(down).collect::<Vec<_>>();
    let layer = sheet.layer(ENGRAVE);
    for ring in boards.iter().flat_map(|b| &b.engraved) {
        layer.polygon(path(ring), inks.engrave);
    }
    let layer = sheet.layer(SCORE);
    layer.polygon(path(&rectangle([MARGIN; 2], REFERENCE)), inks.score);
    for curve in boards.iter().flat_map(|b| &b.scores) {
        layer.push(score(curve, &down, inks.score));
    }
    let layer = sheet.layer(inner);
    for hole in boards.iter().flat_map(|b| &b.holes) {
        match hole {
            Curve::Path(ring) => layer.polygon(path(ring), inks.cut),
            Curve::Circle { center, radius } => layer.circle(down(center), *radius, inks.cut),
        }
    }
    let layer = sheet.layer(outer);
    for board in boards {
        layer.polygon(path(&board.outline), inks.cut);
    }
    sheet.layers.retain(|layer| !layer.items.is_empty());
    sheet
}

/// A scored line; one that ends where it begins is closed.
fn score(curve: &Curve, down: &dyn Fn(&Point) -> Point, stroke: Stroke) -> Figure {
    let shape = match curve {
        Curve::Circle { center, radius } => Shape::Circle { center: down(center), radius: *radius },
        Curve::Path(points) => match &points[..] {
            [first, ring @ .., last] if ring.len() > 1 && first == last => {
                Shape::Area(vec![points[1..].iter().map(down).collect()])
            }
            _ => Shape::Polyline(points.iter().map(down).collect()),
        },
    };
    Figure { shape, paint: stroke.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_sheets_stand_in_even_rows_unless_they_are_too_large() {
        let sheets = |n: usize, width: f64, height: f64| {
            let mut sheet = Drawing::new(width, height);
            sheet.layer(CUT).rect([1.0; 2], [2.0; 2], Stroke::new(0.1));
            vec![sheet; n]
        };
        let size = |all: Drawing| [all.width, all.height];
        assert_eq!(together(&sheets(1, 600.0, 400.0)).map(size), Some([600.0, 400.0]));
        assert_eq!(together(&sheets(5, 600.0, 400.0)).map(size), Some([1220.0, 1240.0]));
        let many = together(&sheets(30, 600.0, 400.0)).unwrap();
        assert_eq!(many.items().count(), 30);
        assert!(crate::drawing::svg::render(&many).is_ok(), "{} × {}", many.width, many.height);
        assert_eq!(together(&sheets(30, 1200.0, 900.0)), None);
        assert_eq!(together(&[]), None);
    }
}
