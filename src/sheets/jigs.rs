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

/// All sheets on one drawing, one below the other.
pub fn together(sheets: &[Drawing]) -> Drawing {
    let width = sheets.iter().map(|sheet| sheet.width).fold(0.0, f64::max);
    let height: f64 = sheets.iter().map(|sheet| sheet.height + APART).sum();
    let mut all = Drawing::new(width, (height - APART).max(0.0));
    // In the order in which they are burnt, also where the first sheet lacks one.
    for layer in [ENGRAVE, SCORE, CUT, CUT_INNER, CUT_OUTER, GUIDE] {
        all.layer(layer);
    }
    let mut top = 0.0;
    for sheet in sheets {
        all.place_drawing(sheet, &Placement::at([0.0, top]));
        top += sheet.height + APART;
    }
    all.layers.retain(|layer| !layer.items.is_empty());
    all
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
