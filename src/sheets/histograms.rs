//! Histograms as pictures: how regular the units are and how far rods are from where they
//! were laid, before and after closing (paper, Fig. 12 and 14).
//!
//! What the rods were before is an outline, what they are a filled bar, so that both are
//! told apart in black and white too.

use super::format::fixed;
use super::page::{BODY, FAINT, SMALL, THIN};
use crate::drawing::font::{LEADING, text_width, wrap};
use crate::drawing::{Color, Draw, Drawing, DrawingError, Paint, Point, Rect, Stroke, Weight};
use crate::frame::histogram::{BeforeAfter, Histogram};
use crate::frame::measure::Measures;
use crate::frame::relax::Relaxing;

/// Histograms of one kind of figure, to be compared.
#[derive(Clone, PartialEq, Debug)]
pub struct HistogramPair {
    /// What is measured.
    pub title: &'static str,
    /// What the bars run over, with its unit.
    pub unit: &'static str,
    /// What is counted.
    pub of: &'static str,
    /// What a good one looks like, in plain words.
    pub good: &'static str,
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

fn both(
    title: &'static str,
    unit: &'static str,
    of: &'static str,
    good: &'static str,
    pair: &BeforeAfter,
) -> HistogramPair {
    let BeforeAfter { before, after } = pair.clone();
    HistogramPair { title, unit, of, good, before: Some(before), after }
}

/// The histograms of a pattern that was relaxed (paper, Fig. 12).
pub fn relaxing_pairs(relaxing: &Relaxing) -> Vec<HistogramPair> {
    let lengths = BeforeAfter {
        before: per_cent(&relaxing.lengths.before),
        after: per_cent(&relaxing.lengths.after),
    };
    vec![
        both(
            "Relaxing: angles between units",
            "off the angle in the plane, degrees",
            "angles",
            "Before and after relaxing. Good: tall bars at the left.",
            &relaxing.angles,
        ),
        both(
            "Relaxing: distances of units",
            "off the mean distance, per cent",
            "neighbours",
            "Before and after relaxing. Good: bars farther to the left; units are alike in size.",
            &lengths,
        ),
    ]
}

/// The histograms of a frame; those without figures are left out.
pub fn histogram_pairs(measures: &Measures) -> Vec<HistogramPair> {
    let found = &measures.histograms;
    let sides = BeforeAfter {
        before: per_cent(&found.unit_sides.before),
        after: per_cent(&found.unit_sides.after),
    };
    let moves = HistogramPair {
        title: "Moves of the rods",
        unit: "moved in closing, rod diameters",
        of: "rod ends",
        good: "Good: nearly all below 1, so that the frame lies where it was drawn.",
        before: None,
        after: found.moves.clone(),
    };
    let mut pairs = vec![
        both(
            "Angles of the units",
            "off the regular polygon's angle, degrees",
            "corners",
            "Good: tall bars at the left and little beyond 10°; the holes look alike.",
            &found.unit_angles,
        ),
        both(
            "Sides of the units",
            "off the mean side of the unit, per cent",
            "sides",
            "Good: tall bars at the left and little beyond 20 %; the holes look alike.",
            &sides,
        ),
        both(
            "Distance from the surface",
            "contact to surface, rod diameters",
            "contacts",
            "Good: nearly all below 1, so that the frame has the shape you asked for.",
            &found.off_surface,
        ),
        moves,
    ];
    pairs.retain(|pair| pair.after.total() > 0);
    pairs
}

fn per_cent(part: &Histogram) -> Histogram {
    Histogram { bin: part.bin * 100.0, counts: part.counts.clone() }
}

/// The histograms as a picture on its own, two beside each other.
///
/// # Errors
/// [`DrawingError`] when a text has characters that the font has not.
pub fn histograms(pairs: &[HistogramPair]) -> Result<Drawing, DrawingError> {
    let rows = pairs.len().div_ceil(2) as f64;
    let height = 2.0 * MARGIN + KEY_HEIGHT + rows * (HEIGHT + GAP) - GAP;
    let mut picture = Drawing::new(WIDTH, height.max(2.0 * MARGIN + KEY_HEIGHT));
    // On dark screens black lines need a ground.
    let size = [picture.width, picture.height];
    picture.rect([0.0, 0.0], size, Paint::from(Color::WHITE));
    key([MARGIN, MARGIN], &mut picture)?;
    let mut y = MARGIN + KEY_HEIGHT;
    for row in pairs.chunks(2) {
        pair_row(row, Rect::new([MARGIN, y], [WIDTH - 2.0 * MARGIN, HEIGHT]), &mut picture)?;
        y += HEIGHT + GAP;
    }
    Ok(picture)
}

/// What outlines and filled bars mean, from the top left corner.
pub(super) fn key([x, y]: Point, out: &mut impl Draw) -> Result<(), DrawingError> {
    let (size, middle) = ([5.0, 2.6], y + SMALL * 0.5);
    let words =
        ["before closing: rods straight, not yet touching", "as built: all contacts closed"];
    let mut x = x;
    for (i, words) in words.into_iter().enumerate() {
        let paint = if i == 0 { Paint::from(OUTLINE) } else { Paint::from(filled()) };
        out.rect([x, middle - size[1] / 2.0], size, paint);
        out.text([x + size[0] + 1.5, middle], SMALL, words).vcenter();
        x += size[0] + 1.5 + text_width(words, SMALL, Weight::Regular)? + GAP;
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
    out: &mut impl Draw,
) -> Result<(), DrawingError> {
    let width = (room.width() - GAP) / 2.0;
    for (i, pair) in row.iter().enumerate() {
        let left = room.min[0] + (width + GAP) * i as f64;
        panel(pair, Rect::new([left, room.min[1]], [width, room.height()]), out)?;
    }
    Ok(())
}

/// One histogram with its texts, filling `room`.
fn panel(pair: &HistogramPair, room: Rect, out: &mut impl Draw) -> Result<(), DrawingError> {
    let [left, top] = room.min;
    out.text([left, top + BODY], BODY, pair.title).bold();
    let good = wrap(pair.good, SMALL, Weight::Regular, room.width())?;
    let y = top + BODY * LEADING + SMALL;
    out.text_lines([left, y], SMALL, LINE, Default::default(), &good);
    let y = y + LINE * good.len() as f64 + 0.8;
    out.text([left, y], SMALL, format!("% of {}", pair.of)).color(Color::DARK_GREY);

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
    plot.figure_axis(out)?;
    let at = [bars.center()[0], room.max[1] - 0.6];
    out.text(at, SMALL, pair.unit).middle().color(Color::DARK_GREY);
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
    fn figure_axis(&self, out: &mut impl Draw) -> Result<(), DrawingError> {
        let foot = self.area.max[1];
        out.line([self.area.min[0], foot], [self.area.max[0], foot], THIN);
        let decimals = if self.bin < 0.95 { 1 } else { 0 };
        let label = |i: usize| fixed(self.bin * i as f64, decimals);
        let width = |text: &str| text_width(text, SMALL, Weight::Regular);
        let widest = width(&label(self.shown))? + APART;
        let wide = self.x(1) - self.x(0);
        let every = [1, 2, 5].into_iter().find(|&n| n as f64 * wide >= widest).unwrap_or(10);
        let baseline = foot + 1.0 + SMALL;
        let mut end = self.area.max[0] + RIGHT;
        if self.open {
            out.text([end, baseline], SMALL, "more").end();
            end -= width("more")? + APART;
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

    fn pair(before: Option<Vec<usize>>, after: Vec<usize>) -> HistogramPair {
        let histogram = |counts| Histogram { bin: 0.1, counts };
        HistogramPair {
            title: "Angles",
            unit: "degrees",
            of: "corners",
            good: "Good: all at the left.",
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
        let drawing = histograms(&[pair(Some(vec![4, 4, 2]), vec![30, 0, 10])]).unwrap();
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
        let drawing = histograms(&all).unwrap();
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
            let drawing = histograms(&[pair(None, counts)]).unwrap();
            drawing.items().any(|i| matches!(i, Item::Text(t) if t.string == "more"))
        };
        let (mut near, mut far) = (vec![0; 20], vec![0; 20]);
        (near[18], far[19]) = (1, 1);
        assert!(!says_more(near) && says_more(far));
    }

    #[test]
    fn nothing_to_show_is_drawn_as_nothing() {
        assert!(histograms(&[]).is_ok());
        assert!(histograms(&[pair(None, vec![0; 20])]).is_ok());
    }
}
