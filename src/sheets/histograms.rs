//! Histograms as pictures: how regular the units are and how far rods are from where they
//! were laid, before and after closing (paper, Fig. 12 and 14).
//!
//! What the rods were before is an outline, what they are a filled bar, so that both are
//! told apart in black and white too.

use super::format::fixed;
use super::page::{BODY, FAINT, SMALL, THIN};
use super::text::message::messages;
use super::text::{TextError, Texts};
use super::{Format, PaperUnits, SheetError};
use crate::drawing::font::{LEADING, text_width, wrap};
use crate::drawing::{Color, Draw, Drawing, Paint, Point, Rect, Stroke, Weight};
use crate::frame::histogram::{BeforeAfter, Histogram};
use crate::frame::measure::Measures;
use crate::frame::relax::Relaxing;

messages! {
    mod say in "figures.toml" {
        "before" => Before {}
        "after" => After {}
        "more" => More {}
        "angles" => Angles {}
        "angles-unit" => AnglesUnit {}
        "angles-of" => AnglesOf {}
        "angles-good" => AnglesGood {}
        "sides" => Sides {}
        "sides-unit" => SidesUnit {}
        "sides-of" => SidesOf {}
        "sides-good" => SidesGood {}
        "distance" => Distance {}
        "distance-unit" => DistanceUnit {}
        "distance-of" => DistanceOf {}
        "distance-good" => DistanceGood {}
        "moves" => Moves {}
        "moves-unit" => MovesUnit {}
        "moves-of" => MovesOf {}
        "moves-good" => MovesGood {}
        "relaxed-angles" => RelaxedAngles {}
        "relaxed-angles-unit" => RelaxedAnglesUnit {}
        "relaxed-angles-of" => RelaxedAnglesOf {}
        "relaxed-angles-good" => RelaxedAnglesGood {}
        "relaxed-distances" => RelaxedDistances {}
        "relaxed-distances-unit" => RelaxedDistancesUnit {}
        "relaxed-distances-of" => RelaxedDistancesOf {}
        "relaxed-distances-good" => RelaxedDistancesGood {}
    }
}

/// Histograms of one kind of figure, to be compared.
#[derive(Clone, PartialEq, Debug)]
pub struct HistogramPair {
    /// What is measured.
    pub title: String,
    /// What the bars run over, with its unit.
    pub unit: String,
    /// What is counted, as `% of corners`.
    pub of: String,
    /// What a good one looks like, in plain words.
    pub good: String,
    /// Before the rods were moved, if that differs; in the same bins.
    pub before: Option<Histogram>,
    /// As built.
    pub after: Histogram,
}

/// Width of the picture, mm, as of the others.
const WIDTH: f64 = 180.0;
/// Height of one histogram in it, mm.
const HEIGHT: f64 = 56.0;
/// White round the picture, mm.
const MARGIN: f64 = 6.0;
/// White between histograms, mm.
pub(super) const GAP: f64 = 7.0;
/// Least height of a histogram, mm: its texts, and bars that can be compared.
pub(super) const LEAST_HEIGHT: f64 = 40.0;
/// Height of the line that tells outlines from filled bars, mm.
pub(super) const KEY_HEIGHT: f64 = 5.5;

/// Bars that are shown at least, so that one bar does not fill the picture.
const LEAST_BARS: usize = 10;
/// White to either side of a filled bar, as part of the width of a bin.
const BESIDE: f64 = 0.16;
/// Room for the figures left of the bars, mm.
const LEFT: f64 = 8.5;
/// Room right of the bars for half of the last figure below them, mm.
const RIGHT: f64 = 3.0;
/// Least white between two figures below the bars, mm.
const APART: f64 = 1.5;
/// Steps that read well on an axis of per cent.
const PERCENT_STEPS: [f64; 5] = [1.0, 5.0, 10.0, 20.0, 25.0];

const OUTLINE: Stroke = Stroke::new(0.3).color(Color::DARK_GREY);

/// Height of a line of small text, mm.
const LINE: f64 = SMALL * LEADING;

/// Words for title, unit, what is counted and what is good, and the figures.
fn both([title, unit, of, good]: [String; 4], pair: &BeforeAfter) -> HistogramPair {
    let BeforeAfter { before, after } = pair.clone();
    HistogramPair { title, unit, of, good, before: Some(before), after }
}

/// The histograms of a pattern that was relaxed (paper, Fig. 12).
///
/// # Errors
/// [`TextError`] when a text cannot be put together.
pub fn relaxing_pairs(relaxing: &Relaxing, texts: &Texts) -> Result<Vec<HistogramPair>, TextError> {
    let lengths = BeforeAfter {
        before: per_cent(&relaxing.lengths.before),
        after: per_cent(&relaxing.lengths.after),
    };
    let angles = [
        texts.say(say::RelaxedAngles {})?,
        texts.say(say::RelaxedAnglesUnit {})?,
        texts.say(say::RelaxedAnglesOf {})?,
        texts.say(say::RelaxedAnglesGood {})?,
    ];
    let distances = [
        texts.say(say::RelaxedDistances {})?,
        texts.say(say::RelaxedDistancesUnit {})?,
        texts.say(say::RelaxedDistancesOf {})?,
        texts.say(say::RelaxedDistancesGood {})?,
    ];
    Ok(vec![both(angles, &relaxing.angles), both(distances, &lengths)])
}

/// The histograms of a frame; those without figures are left out.
///
/// # Errors
/// [`TextError`] when a text cannot be put together.
pub fn histogram_pairs(
    measures: &Measures,
    texts: &Texts,
) -> Result<Vec<HistogramPair>, TextError> {
    let found = &measures.histograms;
    let unit_sides = BeforeAfter {
        before: per_cent(&found.unit_sides.before),
        after: per_cent(&found.unit_sides.after),
    };
    let moves = HistogramPair {
        title: texts.say(say::Moves {})?,
        unit: texts.say(say::MovesUnit {})?,
        of: texts.say(say::MovesOf {})?,
        good: texts.say(say::MovesGood {})?,
        before: None,
        after: found.moves.clone(),
    };
    let angles = [
        texts.say(say::Angles {})?,
        texts.say(say::AnglesUnit {})?,
        texts.say(say::AnglesOf {})?,
        texts.say(say::AnglesGood {})?,
    ];
    let sides = [
        texts.say(say::Sides {})?,
        texts.say(say::SidesUnit {})?,
        texts.say(say::SidesOf {})?,
        texts.say(say::SidesGood {})?,
    ];
    let distance = [
        texts.say(say::Distance {})?,
        texts.say(say::DistanceUnit {})?,
        texts.say(say::DistanceOf {})?,
        texts.say(say::DistanceGood {})?,
    ];
    let mut pairs = vec![
        both(angles, &found.unit_angles),
        both(sides, &unit_sides),
        both(distance, &found.off_surface),
        moves,
    ];
    pairs.retain(|pair| pair.after.total() > 0);
    Ok(pairs)
}

fn per_cent(part: &Histogram) -> Histogram {
    Histogram { bin: part.bin * 100.0, counts: part.counts.clone() }
}

/// The histograms as a picture on its own, two beside each other.
///
/// # Errors
/// [`SheetError::Drawing`] when a text has characters that the font has not.
pub fn histograms(pairs: &[HistogramPair], texts: &Texts) -> Result<Drawing, SheetError> {
    let rows = pairs.len().div_ceil(2) as f64;
    let height = 2.0 * MARGIN + KEY_HEIGHT + rows * (HEIGHT + GAP) - GAP;
    let mut picture = Drawing::new(WIDTH, height.max(2.0 * MARGIN + KEY_HEIGHT));
    // On dark screens black lines need a ground.
    let size = [picture.width, picture.height];
    picture.rect([0.0, 0.0], size, Paint::from(Color::WHITE));
    key([MARGIN, MARGIN], texts, &mut picture)?;
    let mut y = MARGIN + KEY_HEIGHT;
    for row in pairs.chunks(2) {
        let room = Rect::new([MARGIN, y], [WIDTH - 2.0 * MARGIN, HEIGHT]);
        pair_row(row, room, texts, &mut picture)?;
        y += HEIGHT + GAP;
    }
    Ok(picture)
}

/// What outlines and filled bars mean, from the top left corner.
pub(super) fn key([x, y]: Point, texts: &Texts, out: &mut impl Draw) -> Result<(), SheetError> {
    let (size, middle) = ([5.0, 2.6], y + SMALL * 0.5);
    let words = [texts.say(say::Before {})?, texts.say(say::After {})?];
    let mut x = x;
    for (i, words) in words.into_iter().enumerate() {
        let paint = if i == 0 { Paint::from(OUTLINE) } else { Paint::from(filled()) };
        out.rect([x, middle - size[1] / 2.0], size, paint);
        out.text([x + size[0] + 1.5, middle], SMALL, words.as_str()).vcenter();
        x += size[0] + 1.5 + text_width(&words, SMALL, Weight::Regular)? + GAP;
    }
    Ok(())
}

/// Filled bars: a light blue that prints as a middle grey.
fn filled() -> Color {
    Color::BLUE.tint(0.5)
}

/// One or two histograms beside each other, each half as wide as the room.
pub(super) fn pair_row(
    row: &[HistogramPair],
    room: Rect,
    texts: &Texts,
    out: &mut impl Draw,
) -> Result<(), SheetError> {
    let width = (room.width() - GAP) / 2.0;
    for (i, pair) in row.iter().enumerate() {
        let left = room.min[0] + (width + GAP) * i as f64;
        let room = Rect::new([left, room.min[1]], [width, room.height()]);
        panel(pair, room, texts, out)?;
    }
    Ok(())
}

/// One histogram with its texts, filling `room`.
fn panel(
    pair: &HistogramPair,
    room: Rect,
    texts: &Texts,
    out: &mut impl Draw,
) -> Result<(), SheetError> {
    let [left, top] = room.min;
    out.text([left, top + BODY], BODY, pair.title.as_str()).bold();
    let good = wrap(&pair.good, SMALL, Weight::Regular, room.width())?;
    let y = top + BODY * LEADING + SMALL;
    out.text_lines([left, y], SMALL, LINE, Default::default(), &good);
    let y = y + LINE * good.len() as f64 + 0.8;
    out.text([left, y], SMALL, pair.of.as_str()).color(Color::DARK_GREY);

    let bars = Rect {
        min: [left + LEFT, y + 2.2],
        max: [room.max[0] - RIGHT, room.max[1] - 2.0 * LINE - 1.0],
    };
    let plot = Plot::new(pair, bars);
    plot.percent_axis(out);
    plot.bars(&pair.after, BESIDE, Paint::from(filled()), out);
    if let Some(before) = &pair.before {
        plot.bars(before, 0.0, Paint::from(OUTLINE), out);
    }
    plot.figure_axis(texts, out)?;
    let at = [bars.center()[0], room.max[1] - 0.6];
    out.text(at, SMALL, pair.unit.as_str()).middle().color(Color::DARK_GREY);
    Ok(())
}

/// How bars lie on the paper.
struct Plot {
    area: Rect,
    /// Width of a bin, in the unit of the figures.
    bin: f64,
    /// Bins that are shown.
    shown: usize,
    /// Whether the last bin is shown, which takes all above, too.
    open: bool,
    /// Steps of the axis of per cent, and where it ends.
    step: f64,
    top: f64,
}

impl Plot {
    fn new(pair: &HistogramPair, area: Rect) -> Self {
        let all = || pair.before.iter().chain([&pair.after]);
        let used = |h: &Histogram| h.counts.iter().rposition(|&n| n > 0).map_or(0, |i| i + 1);
        let bins = pair.after.counts.len();
        let used = all().map(used).max().unwrap_or(0);
        let tallest = all().flat_map(shares).fold(0.0, f64::max);
        // Four or five lines at most.
        let step = PERCENT_STEPS.into_iter().find(|step| tallest <= 5.0 * step).unwrap_or(25.0);
        Self {
            area,
            bin: pair.after.bin,
            shown: used.max(LEAST_BARS).min(bins),
            open: used == bins,
            step,
            top: (tallest / step).ceil().max(1.0) * step,
        }
    }

    /// The left edge of a bin.
    fn x(&self, bin: usize) -> f64 {
        self.area.min[0] + self.area.width() * bin as f64 / self.shown.max(1) as f64
    }

    fn y(&self, percent: f64) -> f64 {
        self.area.max[1] - self.area.height() * percent / self.top
    }

    fn bars(&self, histogram: &Histogram, beside: f64, paint: Paint, out: &mut impl Draw) {
        let foot = self.area.max[1];
        for (i, share) in shares(histogram).enumerate().take(self.shown) {
            if share > 0.0 {
                let wide = self.x(i + 1) - self.x(i);
                let at = [self.x(i) + beside * wide, self.y(share)];
                out.rect(at, [wide * (1.0 - 2.0 * beside), foot - at[1]], paint);
            }
        }
    }

    /// Lines across, each with its figure at the left.
    fn percent_axis(&self, out: &mut impl Draw) {
        let [left, right] = [self.area.min[0], self.area.max[0]];
        for k in 0..=(self.top / self.step).round() as usize {
            let percent = self.step * k as f64;
            let y = self.y(percent);
            out.line([left, y], [right, y], FAINT);
            out.text([left - 1.2, y], SMALL, fixed(percent, 0)).end().vcenter();
        }
    }

    /// The line below the bars, with figures where bins meet.
    fn figure_axis(&self, texts: &Texts, out: &mut impl Draw) -> Result<(), SheetError> {
        let format = Format { units: PaperUnits::Mm, decimal: texts.decimal() };
        let foot = self.area.max[1];
        out.line([self.area.min[0], foot], [self.area.max[0], foot], THIN);
        let decimals = if self.bin < 0.95 { 1 } else { 0 };
        let label = |i: usize| format.fixed(self.bin * i as f64, decimals);
        let width = |text: &str| text_width(text, SMALL, Weight::Regular);
        let widest = width(&label(self.shown))? + APART;
        let wide = self.x(1) - self.x(0);
        let every = [1, 2, 5].into_iter().find(|&n| n as f64 * wide >= widest).unwrap_or(10);
        let baseline = foot + 1.0 + SMALL;
        let mut end = self.area.max[0] + RIGHT;
        if self.open {
            let more = texts.say(say::More {})?;
            end -= width(&more)? + APART;
            out.text([self.area.max[0] + RIGHT, baseline], SMALL, more).end();
        }
        for i in (0..=self.shown).step_by(every) {
            out.line([self.x(i), foot], [self.x(i), foot + 0.9], THIN);
            let half = width(&label(i))? / 2.0;
            let x = self.x(i);
            if x + half <= end + 1e-9 {
                out.text([x, baseline], SMALL, label(i)).middle();
            }
        }
        Ok(())
    }
}

/// The part of each bin in all, per cent.
fn shares(histogram: &Histogram) -> impl Iterator<Item = f64> {
    let total = histogram.total().max(1) as f64;
    histogram.counts.iter().map(move |&n| 100.0 * n as f64 / total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Figure, Item, Shape};
    use crate::sheets::Language;

    fn english() -> Texts {
        Texts::built_in(Language::En).unwrap()
    }

    fn pair(before: Option<Vec<usize>>, after: Vec<usize>) -> HistogramPair {
        let histogram = |counts| Histogram { bin: 0.1, counts };
        HistogramPair {
            title: "Angles".to_owned(),
            unit: "degrees".to_owned(),
            of: "% of corners".to_owned(),
            good: "Good: all at the left.".to_owned(),
            before: before.map(histogram),
            after: histogram(after),
        }
    }

    /// Heights of filled bars and of outlines, from left to right.
    fn heights(drawing: &Drawing) -> [Vec<f64>; 2] {
        let bars = |wanted: Paint| {
            let height = |item: &Item| match item {
                Item::Figure(Figure { shape: Shape::Area(rings), paint }) if *paint == wanted => {
                    Some(rings[0][2][1] - rings[0][0][1])
                }
                _ => None,
            };
            // The first is the sign of the key.
            drawing.items().filter_map(height).skip(1).collect()
        };
        [bars(filled().into()), bars(OUTLINE.into())]
    }

    #[test]
    fn bars_are_as_tall_as_their_part_of_all() {
        let drawing =
            histograms(&[pair(Some(vec![4, 4, 2]), vec![30, 0, 10])], &english()).unwrap();
        let [after, before] = heights(&drawing);
        assert_eq!((after.len(), before.len()), (2, 3));
        assert!((after[0] / after[1] - 3.0).abs() < 1e-9);
        // 40 % beside 75 %, whatever the numbers counted.
        assert!((before[0] / after[0] - 40.0 / 75.0).abs() < 1e-9);
    }

    #[test]
    fn texts_stay_in_the_picture_and_apart() {
        let mut far = vec![0; 20];
        (far[0], far[19]) = (1, 999);
        let mut all = Vec::new();
        for bin in [0.1, 2.0, 50.0, 2e6] {
            for counts in [far.clone(), vec![1; 20], vec![7]] {
                let mut one = pair(Some(counts.clone()), counts);
                one.after.bin = bin;
                all.push(one);
            }
        }
        let drawing = histograms(&all, &english()).unwrap();
        let mut seen: Vec<Rect> = Vec::new();
        for item in drawing.items() {
            if let Item::Text(text) = item {
                let extent = text.extent().unwrap();
                assert!(drawing.frame().inset(1.0).contains_rect(&extent), "{}", text.string);
                let clear = seen.iter().all(|other| !other.overlaps(&extent));
                assert!(clear, "{} at {:?}", text.string, text.at);
                seen.push(extent);
            }
        }
    }

    #[test]
    fn the_last_bar_says_that_it_takes_all_above() {
        let says_more = |counts: Vec<usize>| {
            let drawing = histograms(&[pair(None, counts)], &english()).unwrap();
            drawing.items().any(|i| matches!(i, Item::Text(t) if t.string == "more"))
        };
        let (mut near, mut far) = (vec![0; 20], vec![0; 20]);
        (near[18], far[19]) = (1, 1);
        assert!(!says_more(near) && says_more(far));
    }

    #[test]
    fn nothing_to_show_is_drawn_as_nothing() {
        assert!(histograms(&[], &english()).is_ok());
        assert!(histograms(&[pair(None, vec![0; 20])], &english()).is_ok());
    }
}
