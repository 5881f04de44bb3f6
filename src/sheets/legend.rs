//! What a reader checks a print with, and the signs that the papers use.

use super::page::{SMALL, THIN};
use super::text::TextError;
use super::text::message::messages;
use super::{PaperUnits, SheetSettings};
use crate::drawing::{Color, Dash, Draw, Item, Point, Stroke};
use crate::shop::Side;
use crate::units::MM_PER_INCH;

messages! {
    mod say in "legend.toml" {
        "box-mm" => BoxMm {}
        "box-inch" => BoxInch {}
    }
}

/// Sides of the outer calibration box, mm: 10 × 5 cm.
const BOX_CM: [f64; 2] = [100.0, 50.0];
/// Sides of the inch box, mm: 4 × 2 in. It is a little larger, so the two share a
/// corner and stay apart elsewhere.
const BOX_INCH: [f64; 2] = [101.6, 50.8];
/// Longest ruler, mm.
const RULER: f64 = 200.0;
/// Room that a ruler takes across, mm.
pub(super) const RULER_WIDTH: f64 = 8.0;

/// Half the width of the sign of a mark, mm.
pub(super) const SIGN_HALF: f64 = 3.4;
/// Height of the sign of a mark, mm.
pub(super) const SIGN_HEIGHT: f64 = 3.8;

/// The line of a mark where the rod is over its partner: whole.
pub(super) const OVER_TICK: Stroke = Stroke::new(0.35);
/// The line of a mark where the rod is under its partner: broken.
pub(super) const UNDER_TICK: Stroke = Stroke::new(0.35).dash(Dash::new([0.7, 0.45]));

/// The sign of a mark: its letter, and `O` on black, `U` or `E` on white.
pub(super) fn sign(out: &mut impl Draw, [x, y]: Point, letter: &str, side: Side) {
    let corner = [x - SIGN_HALF, y - SIGN_HEIGHT / 2.0];
    let size = [2.0 * SIGN_HALF, SIGN_HEIGHT];
    let text = format!("{letter} {}", side.letter());
    let pen = Stroke::new(0.25);
    if side == Side::Over {
        out.rect(corner, size, pen.fill(Color::BLACK));
        out.text([x, y], 2.9, text).bold().middle().vcenter().color(Color::WHITE);
    } else {
        out.rect(corner, size, pen.fill(Color::WHITE));
        out.text([x, y], 2.9, text).middle().vcenter();
    }
}

/// The calibration box, its common corner at `[x, y]`: 100 × 50 mm whole, 4 × 2 in broken.
pub(super) fn calibration_box(
    out: &mut impl Draw,
    [x, y]: Point,
    settings: &SheetSettings,
) -> Result<(), TextError> {
    out.rect([x, y], BOX_CM, Stroke::new(0.25));
    let [w, h] = BOX_INCH;
    let inch = Stroke::new(0.2).dash(Dash::DASHED);
    out.polyline(
        [[x + BOX_CM[0], y], [x + w, y], [x + w, y + h], [x, y + h], [x, y + BOX_CM[1]]],
        inch,
    );
    let middle = x + BOX_CM[0] / 2.0;
    out.text([middle, y + BOX_CM[1] - 2.0], SMALL, settings.say(say::BoxMm {})?).middle();
    out.text([middle, y + h + SMALL + 0.8], SMALL, settings.say(say::BoxInch {})?).middle();
    Ok(())
}

/// Room that [`calibration_box`] takes, mm.
pub(super) const CALIBRATION: [f64; 2] = [BOX_INCH[0], BOX_INCH[1] + SMALL + 1.6];

/// A ruler to the right from `[x, y]`, its figures below, as long as fits `room` mm.
pub(super) fn ruler(out: &mut impl Draw, at: Point, room: f64, units: PaperUnits) {
    out.place(&ruler_items(room, units), &crate::drawing::Placement::at(at));
}

/// The same ruler downwards from `[x, y]`, its figures to the left.
pub(super) fn ruler_down(out: &mut impl Draw, at: Point, room: f64, units: PaperUnits) {
    let turned = crate::drawing::Placement::at(at).rotate(90.0);
    out.place(&ruler_items(room, units), &turned);
}

fn ruler_items(room: f64, units: PaperUnits) -> Vec<Item> {
    // The steps of a figure, and how many small steps it has.
    let (figure, parts) = match units {
        PaperUnits::Mm => (10.0, 10),
        _ => (MM_PER_INCH, 8),
    };
    let figures = (room.min(RULER) / figure).floor() as usize;
    let mut items = Vec::new();
    let end = figures as f64 * figure;
    items.line([0.0, 0.0], [end, 0.0], THIN);
    for k in 0..=figures * parts {
        let x = k as f64 * figure / parts as f64;
        let length = match k % parts {
            0 => 3.5,
            k if 2 * k == parts => 2.6,
            _ => 1.7,
        };
        items.line([x, 0.0], [x, length], THIN);
        if k % parts == 0 {
            // The first figure names the unit; it and the last one stay within the ends.
            let name = if k == 0 { format!(" {}", units.name()) } else { String::new() };
            let step = if units == PaperUnits::Mm { 10 } else { 1 };
            let label = items.text([x, 3.5 + SMALL], SMALL, format!("{}{name}", k / parts * step));
            match k {
                0 => {}
                _ if k == figures * parts => drop(label.end()),
                _ => drop(label.middle()),
            }
        }
    }
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Shape, bounds};
    use crate::sheets::Paper;

    #[test]
    fn rulers_are_true_and_as_long_as_fits() {
        for (room, units, end) in [
            (300.0, PaperUnits::Mm, 200.0),
            (188.0, PaperUnits::Mm, 180.0),
            (300.0, PaperUnits::Inch, 7.0 * 25.4),
            (190.0, PaperUnits::Inch, 7.0 * 25.4),
        ] {
            let items = ruler_items(room, units);
            let ticks: Vec<f64> = items
                .iter()
                .filter_map(|i| match i {
                    Item::Figure(f) => match f.shape {
                        Shape::Line(a, b) if a[0] == b[0] => Some(a[0]),
                        _ => None,
                    },
                    Item::Text(_) => None,
                })
                .collect();
            let last = ticks.iter().copied().fold(0.0, f64::max);
            assert!((last - end).abs() < 1e-9, "{room}: {last}");
            assert!(bounds(&items).unwrap().max[0] <= room);
        }
    }

    #[test]
    fn the_calibration_box_has_both_sizes() {
        let mut items: Vec<Item> = Vec::new();
        calibration_box(
            &mut items,
            [10.0, 20.0],
            &super::super::tests::settings(Paper::A4, PaperUnits::Mm),
        )
        .unwrap();
        let size = |i: usize| bounds(&items[i..=i]).unwrap().size();
        assert!((0..2).all(|k| (size(0)[k] - [100.0, 50.0][k]).abs() < 1e-9));
        assert!((0..2).all(|k| (size(1)[k] - [4.0 * 25.4, 2.0 * 25.4][k]).abs() < 1e-9));
    }
}
