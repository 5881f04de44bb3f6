//! Patterns on one page: each in the plane, and beside it on a surface.

use super::format::counted;
use super::line_picture;
use super::page::{BODY, SMALL, printable};
use super::pattern_picture::{PictureError, swatch};
use super::view::View;
use crate::drawing::font::fit_size;
use crate::drawing::{Color, Draw, Drawing, DrawingError, Paint, Point, Rect, Weight};
use crate::frame::Frame;
use crate::pattern::{Pattern, Shape};
use crate::shop::classes;
use crate::surface::Point3;

/// Pairs of pictures in a row.
const COLUMNS: usize = 2;
/// Width and height of the picture in the plane, mm.
const FLAT: [f64; 2] = [46.0, 46.0];
/// Width and height of the picture of the frame, mm.
const FRAME: [f64; 2] = [60.0, 46.0];
/// White between the two, mm.
const BETWEEN: f64 = 3.0;
/// White between pairs, and round the page, mm.
const GAP: f64 = 7.0;
/// Room for the three lines below a pair, mm.
const CAPTION: f64 = 13.0;

/// A pattern, and a frame that is made with it.
pub struct PatternEntry<'a> {
    /// The pattern.
    pub pattern: &'a Pattern,
    /// Turn and slide in the plane.
    pub shape: Shape,
    /// The frame.
    pub frame: Frame,
    /// Closed lines to draw faintly below the frame, mm: the rim of its surface.
    pub rims: Vec<Vec<Point3>>,
}

/// The page: two patterns to a row, in the order given, as many rows as are needed.
///
/// # Errors
/// [`PictureError`] for a pattern whose rods form no units.
pub fn pattern_sheet(entries: &[PatternEntry]) -> Result<Drawing, PictureError> {
    let columns = COLUMNS.min(entries.len().max(1));
    let rows = entries.len().div_ceil(columns);
    let pair = FLAT[0] + BETWEEN + FRAME[0];
    let cell = [pair + GAP, FLAT[1] + CAPTION + GAP];
    let size = [GAP + cell[0] * columns as f64, GAP + cell[1] * rows as f64];
    let mut page = Drawing::new(size[0], size[1]);
    // On dark screens black lines need a ground.
    page.rect([0.0, 0.0], size, Paint::from(Color::WHITE));
    for (i, entry) in entries.iter().enumerate() {
        let place = [i % columns, i / columns];
        let corner: Point = std::array::from_fn(|k| GAP + cell[k] * place[k] as f64);
        swatch(entry.pattern, entry.shape, Rect::new(corner, FLAT), &mut page)?;
        let room = Rect::new([corner[0] + FLAT[0] + BETWEEN, corner[1]], FRAME);
        let frame = line_picture::draw(&entry.frame, &entry.rims, &View::isometric(), room);
        page.layer("rods").items.extend(frame);
        caption(&mut page, entry, Rect::new(corner, [pair, FLAT[1]]))?;
    }
    Ok(page)
}

fn caption(page: &mut Drawing, entry: &PatternEntry, room: Rect) -> Result<(), DrawingError> {
    let lengths = classes(&entry.frame).len();
    let figures = [
        counted(entry.frame.rods.len(), "rod"),
        counted(entry.frame.units.len(), "unit"),
        counted(lengths, "length"),
    ];
    let lines = [
        (4.5, BODY, Weight::Bold, Color::BLACK, printable(&entry.pattern.name)),
        (8.5, SMALL, Weight::Regular, Color::BLACK, printable(&entry.pattern.summary)),
        (12.0, SMALL, Weight::Regular, Color::DARK_GREY, figures.join(", ")),
    ];
    let texts = page.layer("captions");
    for (down, size, weight, color, text) in lines {
        let size = fit_size(&text, size, weight, room.width())?;
        let at = [room.center()[0], room.max[1] + down];
        texts.text(at, size, text).weight(weight).middle().color(color);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Item, bounds};
    use crate::pattern::library;
    use crate::shop::fixture;

    fn entries(n: usize) -> Vec<PatternEntry<'static>> {
        let entry = |(i, pattern): (usize, &'static Pattern)| PatternEntry {
            pattern,
            shape: pattern.usual(),
            frame: fixture::circuit(3 + i, 3.0),
            rims: Vec::new(),
        };
        library().iter().take(n).enumerate().map(entry).collect()
    }

    fn texts(page: &Drawing) -> Vec<(Point, &str)> {
        page.items()
            .filter_map(|item| match item {
                Item::Text(t) => Some((t.at, t.string.as_str())),
                Item::Figure(_) => None,
            })
            .collect()
    }

    #[test]
    fn every_pattern_has_its_name_its_words_and_its_figures_in_order() {
        let entries = entries(3);
        let page = pattern_sheet(&entries).unwrap();
        let texts = texts(&page);
        assert_eq!(texts.len(), 9);
        for (i, entry) in entries.iter().enumerate() {
            let said: Vec<&str> = texts[3 * i..3 * i + 3].iter().map(|t| t.1).collect();
            let rods = 3 + i;
            let figures = format!("{rods} rods, 1 unit, 1 length");
            assert_eq!(said, [&entry.pattern.name, &entry.pattern.summary, &figures]);
        }
        // Two in a row, the third below the first.
        let [first, second, third] = [0, 3, 6].map(|i| texts[i].0);
        assert!(first[1] == second[1] && first[0] < second[0]);
        assert!(third[0] == first[0] && third[1] > first[1]);
    }

    #[test]
    fn the_page_is_as_large_as_its_pictures_need_and_holds_all() {
        for (n, across, down) in [(0, 1.0, 0.0), (1, 1.0, 1.0), (2, 2.0, 1.0), (5, 2.0, 3.0)] {
            let page = pattern_sheet(&entries(n)).unwrap();
            assert_eq!(page.width, GAP + across * (FLAT[0] + BETWEEN + FRAME[0] + GAP));
            assert_eq!(page.height, GAP + down * (FLAT[1] + CAPTION + GAP));
            assert!(page.frame().contains_rect(&bounds(page.items()).unwrap()));
            for item in page.items() {
                if let Item::Text(text) = item {
                    assert!(page.frame().contains_rect(&text.extent().unwrap()));
                }
            }
        }
    }
}
