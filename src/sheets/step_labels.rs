//! Where the numbers of rods go in a picture: beside what they name, apart from each other.

use super::page::THIN;
use crate::drawing::{Color, Draw, DrawingError, Item, Point, Rect, Text, crosses};

/// Distances of a number from its rod that are tried, mm.
const DISTANCES: [f64; 7] = [0.8, 1.8, 3.2, 5.5, 8.5, 12.0, 17.0];
/// Places along the rod that are tried, as shares of it.
const SHARES: [f64; 5] = [0.5, 0.3, 0.7, 0.1, 0.9];
/// From this distance on, a thin line leads to the rod, mm.
const LEADER: f64 = 3.0;
/// White round a number, mm.
const ROUND: f64 = 0.35;
/// What a number on another rod costs, in mm of distance.
const ON_ROD: f64 = 4.0;
/// What a number off the middle of its rod costs, in mm of distance.
const OFF_MIDDLE: f64 = 1.5;

/// A text that names a line.
pub(super) struct Label {
    /// The text; where it stands is found.
    pub text: Text,
    /// What it names.
    pub line: [Point; 2],
}

/// The texts, each in the best place that is left in `room`; `lines` are better not covered.
///
/// A text for which there is no place at all is left out: what it says stands beside the
/// picture, too.
///
/// # Errors
/// [`DrawingError`] for letters that the font does not have.
pub(super) fn placed(
    labels: Vec<Label>,
    lines: &[[Point; 2]],
    room: Rect,
) -> Result<Vec<Item>, DrawingError> {
    let mut taken: Vec<Rect> = Vec::new();
    let mut items: Vec<Item> = Vec::new();
    for Label { mut text, line } in labels {
        text.at = [0.0, 0.0];
        text.middle().vcenter();
        let extent = text.extent()?.inset(-ROUND);
        let mut best: Option<(f64, Rect, Point, Point)> = None;
        for (on, at, cost) in candidates(line, extent) {
            let area = moved(extent, at);
            if !room.contains_rect(&area) || taken.iter().any(|t| t.overlaps(&area)) {
                continue;
            }
            let covered = lines.iter().filter(|l| crosses(**l, area)).count();
            let cost = cost + ON_ROD * covered as f64;
            if best.is_none_or(|best| cost < best.0) {
                best = Some((cost, area, at, on));
            }
        }
        let Some((_, area, at, on)) = best else { continue };
        taken.push(area);
        let edge = [0, 1].map(|i| on[i].clamp(area.min[i], area.max[i]));
        if (edge[0] - on[0]).hypot(edge[1] - on[1]) > LEADER {
            items.line(edge, on, THIN);
        }
        items.rect(area.min, area.size(), Color::WHITE);
        text.at = [text.at[0] + at[0], text.at[1] + at[1]];
        items.push(Item::Text(text));
    }
    Ok(items)
}

/// Places for the middle of a text beside a line: the point of the line that it is for, the
/// place, and its cost.
fn candidates(line: [Point; 2], extent: Rect) -> impl Iterator<Item = (Point, Point, f64)> {
    let [a, b] = line;
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    let (x, y) = (-dy / length, dx / length);
    let half = [extent.width() / 2.0, extent.height() / 2.0];
    // How far the text reaches towards the line.
    let reach = half[0] * x.abs() + half[1] * y.abs();
    SHARES.into_iter().flat_map(move |share| {
        let on = [a[0] + dx * share, a[1] + dy * share];
        DISTANCES.into_iter().flat_map(move |d| {
            [1.0, -1.0].into_iter().map(move |side| {
                let away = side * (d + reach);
                let cost = d + OFF_MIDDLE * (share - 0.5).abs();
                (on, [on[0] + x * away, on[1] + y * away], cost)
            })
        })
    })
}

fn moved(rect: Rect, by: Point) -> Rect {
    let shift = |p: Point| [p[0] + by[0], p[1] + by[1]];
    Rect { min: shift(rect.min), max: shift(rect.max) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(name: &str, line: [Point; 2]) -> Label {
        Label { text: Text::new([0.0; 2], 2.4, name), line }
    }

    fn texts(items: &[Item]) -> Vec<&Text> {
        items.iter().filter_map(|i| if let Item::Text(t) = i { Some(t) } else { None }).collect()
    }

    #[test]
    fn a_lone_number_stands_beside_the_middle_of_its_rod() {
        let room = Rect::new([0.0; 2], [60.0, 60.0]);
        let line = [[20.0, 30.0], [40.0, 30.0]];
        let items = placed(vec![label("R012", line)], &[line], room).unwrap();
        let extent = texts(&items)[0].extent().unwrap();
        assert!((extent.center()[0] - 30.0).abs() < 1e-9);
        assert!(!crosses(line, extent) && extent.inset(-2.0).contains([30.0, 30.0]));
    }

    #[test]
    fn many_numbers_keep_apart_and_in_the_room() {
        let room = Rect::new([5.0; 2], [50.0, 40.0]);
        let line = |i: usize| [[20.0 + i as f64, 15.0], [28.0, 20.0 + i as f64]];
        let lines: Vec<_> = (0..12).map(line).collect();
        let labels = lines.iter().enumerate().map(|(i, &l)| label(&format!("R{i:03}"), l));
        let items = placed(labels.collect(), &lines, room).unwrap();
        let extents: Vec<Rect> = texts(&items).iter().map(|t| t.extent().unwrap()).collect();
        assert_eq!(extents.len(), 12);
        for (i, extent) in extents.iter().enumerate() {
            assert!(room.contains_rect(extent));
            assert!(extents[..i].iter().all(|other| !other.overlaps(extent)));
        }
    }
}
