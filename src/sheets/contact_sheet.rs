//! Many frames on one page: a small picture of each, with a caption.

use super::line_picture;
use super::page::{BODY, SMALL, printable};
use super::view::View;
use crate::drawing::font::fit_size;
use crate::drawing::{Color, Draw, Drawing, DrawingError, Paint, Rect, Weight};
use crate::frame::Frame;
use crate::surface::Point3;

/// Width and height of a picture, mm.
const PICTURE: [f64; 2] = [56.0, 40.0];
/// White between pictures, and round the page, mm.
const GAP: f64 = 6.0;
/// Room for the two lines below a picture, mm.
const CAPTION: f64 = 11.0;

/// A frame and what is printed below it.
pub struct Exhibit {
    /// The frame.
    pub frame: Frame,
    /// Closed lines to draw faintly below it, mm: the rim of its surface.
    pub rims: Vec<Vec<Point3>>,
    /// Its name, in bold.
    pub title: String,
    /// A line more.
    pub caption: String,
}

/// The page: pictures in rows of `columns` (of fewer, if there are fewer), in the order
/// given.
///
/// # Errors
/// [`DrawingError`] when the font cannot be read.
pub fn contact_sheet(exhibits: &[Exhibit], columns: usize) -> Result<Drawing, DrawingError> {
    let columns = columns.clamp(1, exhibits.len().max(1));
    let rows = exhibits.len().div_ceil(columns);
    let cell = [PICTURE[0] + GAP, PICTURE[1] + CAPTION + GAP];
    let size = [GAP + cell[0] * columns as f64, GAP + cell[1] * rows as f64];
    let mut page = Drawing::new(size[0], size[1]);
    // On dark screens black lines need a ground.
    page.rect([0.0, 0.0], size, Paint::from(Color::WHITE));
    for (i, exhibit) in exhibits.iter().enumerate() {
        let corner = [i % columns, i / columns];
        let corner: [f64; 2] = std::array::from_fn(|k| GAP + cell[k] * corner[k] as f64);
        let room = Rect::new(corner, PICTURE);
        page.layer("rods").items.extend(line_picture::draw(
            &exhibit.frame,
            &exhibit.rims,
            &View::isometric(),
            room,
        ));
        caption(&mut page, exhibit, room)?;
    }
    Ok(page)
}

fn caption(page: &mut Drawing, exhibit: &Exhibit, room: Rect) -> Result<(), DrawingError> {
    let middle = room.center()[0];
    let (title, line) = (printable(&exhibit.title), printable(&exhibit.caption));
    let texts = page.layer("captions");
    let size = fit_size(&title, BODY, Weight::Bold, room.width())?;
    texts.text([middle, room.max[1] + 5.0], size, title).bold().middle();
    let size = fit_size(&line, SMALL, Weight::Regular, room.width())?;
    texts.text([middle, room.max[1] + 9.0], size, line).middle().color(Color::DARK_GREY);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Item, svg};
    use crate::shop::fixture;

    fn exhibits(n: usize) -> Vec<Exhibit> {
        (0..n)
            .map(|i| Exhibit {
                frame: fixture::circuit(3 + i, 3.0),
                rims: Vec::new(),
                title: format!("model {i}"),
                caption: format!("{} rods", 3 + i),
            })
            .collect()
    }

    /// Texts in reading order of the page, so far as rows and columns go.
    #[test]
    fn pictures_stand_in_rows_in_the_order_given() {
        let page = contact_sheet(&exhibits(5), 2).unwrap();
        let titles: Vec<([f64; 2], &str)> = page
            .items()
            .filter_map(|item| match item {
                Item::Text(t) if t.string.starts_with("model") => Some((t.at, &*t.string)),
                _ => None,
            })
            .collect();
        assert_eq!(titles.len(), 5);
        assert!(titles[0].0[1] == titles[1].0[1] && titles[0].0[0] < titles[1].0[0]);
        assert!(titles[2].0[1] > titles[1].0[1] && titles[2].0[0] == titles[0].0[0]);
        assert_eq!(titles[4].1, "model 4");
    }

    #[test]
    fn the_page_is_as_large_as_its_pictures_need_and_holds_all() {
        for (n, columns, expected) in [(1, 4, [1.0, 1.0]), (5, 4, [4.0, 2.0]), (4, 1, [1.0, 4.0])] {
            let page = contact_sheet(&exhibits(n), columns).unwrap();
            let [across, down] = expected;
            assert_eq!(page.width, GAP + across * (PICTURE[0] + GAP));
            assert_eq!(page.height, GAP + down * (PICTURE[1] + CAPTION + GAP));
            let extent = crate::drawing::bounds(page.items()).unwrap();
            assert!(page.frame().contains_rect(&extent));
        }
    }

    #[test]
    fn long_and_foreign_names_are_drawn_within_their_room() {
        let mut all = exhibits(1);
        all[0].title = format!("猫 {}", "long ".repeat(40));
        let page = contact_sheet(&all, 4).unwrap();
        let text = svg::render(&page).unwrap();
        assert!(text.contains("? long long"), "{text}");
        let length = text.split("textLength=\"").nth(1).unwrap().split('"').next().unwrap();
        assert!(length.parse::<f64>().unwrap() <= PICTURE[0] + 1e-3, "{length}");
    }
}
