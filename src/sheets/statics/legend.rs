//! The bar that tells what colours mean, and a bar of a round length.

use super::Subject;
use crate::drawing::{Color, Draw, Item, Stroke, scale_color};
use crate::sheets::page::{BODY, SMALL};
use crate::sheets::text::TextError;
use crate::sheets::text::message::messages;
use crate::units::MM_PER_INCH;

messages! {
    mod say in "statics.toml" {
        "bar-used" => BarUsed {}
        "bar-stress" => BarStress {}
    }
}

/// Height of the bar, mm.
const BAR: f64 = 4.0;
/// Room at its left for the first figure, mm.
const LEFT: f64 = 2.0;
/// Room at its right for words, mm.
const WORDS: f64 = 30.0;
/// Longest bar, mm.
const LONGEST: f64 = 140.0;
/// Strips of one colour that it is made of.
const STRIPS: usize = 80;
/// Height of it all, mm.
pub(super) const HEIGHT: f64 = BAR + 2.0 * (SMALL + 1.6);
/// Longest bar of a round length, mm on paper.
const LONGEST_LENGTH: f64 = 50.0;
/// Height of that bar with its figure, mm.
pub(super) const LENGTH_HEIGHT: f64 = 6.0;

/// The bar, its top left corner at the origin, with what goes above and below it: stress in
/// MPa and in per cent of the strength.
pub(super) fn bar(subject: &Subject, room: f64) -> Result<Vec<Item>, TextError> {
    let mut items = Vec::new();
    let width = (room - LEFT - WORDS).min(LONGEST);
    let top = SMALL + 1.6;
    let strip = width / STRIPS as f64;
    for i in 0..STRIPS {
        let color = scale_color((i as f64 + 0.5) / STRIPS as f64);
        // A little wider than it is: no seams.
        let seam = if i + 1 < STRIPS { 0.05 } else { 0.0 };
        items.rect([LEFT + i as f64 * strip, top], [strip + seam, BAR], color);
    }
    items.rect([LEFT, top], [width, BAR], Stroke::new(0.2));
    let largest = subject.largest();
    let strength = subject.study.question.taken.material.strength;
    let format = subject.format();
    for (end, y, dy, baseline) in [
        (largest * strength, top, -1.0, top - 1.4),
        (100.0 * largest, top + BAR, 1.0, top + BAR + 1.2 + SMALL * 0.8),
    ] {
        for tick in ticks(end) {
            let x = LEFT + if end > 0.0 { tick / end * width } else { 0.0 };
            items.line([x, y], [x, y + dy], Stroke::new(0.2));
            items.text([x, baseline], SMALL, tick_figure(tick, end, format)).middle();
        }
    }
    let x = LEFT + width + 4.0;
    items.text([x, top - 1.4], SMALL, subject.settings.say(say::BarStress {})?);
    let below = top + BAR + 1.2 + SMALL * 0.8;
    items.text([x, below], SMALL, subject.settings.say(say::BarUsed {})?);
    // All of the strength, where the bar reaches so far.
    if largest > 1.0 {
        let x = LEFT + width / largest;
        items.line([x, top - 1.0], [x, top + BAR + 1.0], Stroke::new(0.5).color(Color::BLACK));
    }
    Ok(items)
}

/// Round figures from 0 to `end`, five or so.
pub(in crate::sheets) fn ticks(end: f64) -> Vec<f64> {
    if !(end > 0.0 && end.is_finite()) {
        return vec![0.0];
    }
    let step = round_below(end / 4.0);
    let count = (end / step * (1.0 + 1e-12)).floor() as usize;
    (0..=count).map(|i| i as f64 * step).collect()
}

/// With the decimals of the step between ticks.
pub(in crate::sheets) fn tick_figure(tick: f64, end: f64, format: crate::sheets::Format) -> String {
    if end <= 0.0 {
        return format.three_digits(0.0);
    }
    let decimals = (-round_below(end / 4.0).log10().floor()).clamp(0.0, 9.0);
    format.fixed(tick, decimals as usize)
}

/// The largest of 1, 2, 5, 10 … and their tenths that is not above `x`.
fn round_below(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    let fits = |k: &f64| k * power <= x * (1.0 + 1e-12);
    [5.0, 2.0, 1.0].into_iter().find(fits).unwrap_or(1.0) * power
}

/// A bar of a round length in the unit of the papers at 1:n, its left end at the origin.
pub(super) fn length_bar(subject: &Subject, n: f64) -> Vec<Item> {
    let format = subject.format();
    let unit = if format.units.is_inches() { MM_PER_INCH } else { 1.0 };
    let length = round_below(LONGEST_LENGTH * n / unit) * unit;
    let (bar, y) = (length / n, LENGTH_HEIGHT / 2.0);
    let mut items = Vec::new();
    let pen = Stroke::new(0.3);
    items.line([0.0, y], [bar, y], pen);
    for end in [0.0, bar] {
        items.line([end, y - 1.5], [end, y + 1.5], pen);
    }
    items.text([bar + 2.0, y], BODY, format.measure(length)).vcenter();
    items
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        for (end, step, count) in
            [(1.0, 0.2, 6), (0.013, 0.002, 7), (7.9, 1.0, 8), (240.0, 50.0, 5), (100.0, 20.0, 6)]
        {
            let found = ticks(end);
            assert_eq!(found.len(), count, "{end}: {found:?}");
            assert!((found[1] - step).abs() < 1e-12 && *found.last().unwrap() <= end * 1.000_1);
        }
        assert_eq!(ticks(0.0), [0.0]);
    }
}
