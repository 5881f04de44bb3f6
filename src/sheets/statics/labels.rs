//! Names beside places in a picture, clear of one another.

use crate::drawing::{Color, Draw, DrawingError, Point, Rect, Stroke, Text, Weight};

/// Distances of a name from its place that are tried, mm.
const AWAY: [f64; 4] = [3.5, 7.0, 11.0, 16.0];
/// Directions that are tried, a whole turn.
const DIRECTIONS: usize = 12;
/// White round a name, mm.
const CLEAR: f64 = 0.5;

/// Names in a room.
pub(super) struct Labels {
    room: Rect,
    taken: Vec<Rect>,
}

impl Labels {
    pub fn new(room: Rect) -> Self {
        Self { room, taken: Vec::new() }
    }

    /// Keeps a place free of names.
    pub fn keep(&mut self, place: Rect) {
        self.taken.push(place);
    }

    /// Writes a name near a place, on white and with a line to it, where it finds room;
    /// whether it does.
    pub fn name(
        &mut self,
        out: &mut impl Draw,
        at: Point,
        (name, size, weight, color): (&str, f64, Weight, Color),
    ) -> Result<bool, DrawingError> {
        let mut text = Text::new(at, size, name);
        text.middle().weight(weight).color(color);
        for away in AWAY {
            for k in 0..DIRECTIONS {
                // From the upper right on, as one writes beside a thing.
                let angle = std::f64::consts::TAU * (k as f64 / DIRECTIONS as f64 - 1.0 / 12.0);
                let half = text.width()? / 2.0;
                let (sin, cos) = angle.sin_cos();
                text.at = [at[0] + cos * (away + half), at[1] + sin * away];
                text.vcenter();
                let place = text.extent()?.inset(-CLEAR);
                let free = !self.taken.iter().any(|taken| taken.overlaps(&place));
                if free && self.room.contains_rect(&place) {
                    let near = [
                        at[0].clamp(place.min[0], place.max[0]),
                        at[1].clamp(place.min[1], place.max[1]),
                    ];
                    out.line(at, near, Stroke::new(0.2).color(color));
                    out.rect(place.min, place.size(), Color::WHITE);
                    out.push(text);
                    self.taken.push(place);
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }
}
