//! The views of a frame as pictures on their own, for screens and papers of others.

use super::view::View;
use crate::drawing::{Color, Draw, Drawing, Paint, Rect};
use crate::frame::Frame;

/// Size of a picture, mm: it reads well on half a page and fills a screen.
const SIZE: [f64; 2] = [180.0, 120.0];
/// White round the frame, mm.
const MARGIN: f64 = 6.0;

/// The pictures of a frame, each with its name.
pub fn pictures(frame: &Frame) -> [(&'static str, Drawing); 2] {
    [("isometric", View::isometric()), ("plan", View::plan())].map(|(name, view)| {
        let mut picture = Drawing::new(SIZE[0], SIZE[1]);
        // On dark screens black lines need a ground.
        picture.rect([0.0, 0.0], SIZE, Paint::from(Color::WHITE));
        let room = Rect::new([0.0, 0.0], SIZE).inset(MARGIN);
        view.draw(frame, room, picture.layer("rods"));
        (name, picture)
    })
}
