//! The strip of a rod card: the rod at full size with its marks, to lay the rod on.

use super::legend::{OVER_TICK, SIGN_HALF, SIGN_HEIGHT, UNDER_TICK, sign};
use super::page::{SMALL, THIN};
use super::text::message::messages;
use super::{SheetError, SheetSettings};
use crate::drawing::font::text_width;
use crate::drawing::{Color, Draw, Point, Stroke, Weight};
use crate::shop::{Mark, Side};

messages! {
    mod say in "rod-cards.toml" {
        "measure" => Measure {}
        "from-here" => FromHere {}
    }
}

/// Room left of end A for the triangle and what it says, mm.
const BEFORE: f64 = 19.0;
/// Room right of end B for its letter, mm.
const AFTER: f64 = 5.0;
/// Length of the triangle at end A, mm.
const TRIANGLE: f64 = 4.0;
/// Thicker rods are drawn no wider than this, mm: only their length is measured.
const WIDEST: f64 = 10.0;
/// Between the rod and the sign of a mark, mm.
const LEADER: f64 = 2.3;
/// Least distance of the middles of two signs on one side, mm.
const APART: f64 = 2.0 * SIGN_HALF + 0.6;
/// Half the gap in the picture of a rod that is broken, mm.
const BREAK: f64 = 0.9;

/// How a rod is laid out along the paper.
pub(super) struct Strip {
    length: f64,
    /// Rod thickness as drawn, at its thicker end, mm.
    thickness: f64,
    /// What its ends A and B are narrower, on either side, mm.
    narrower: [f64; 2],
    /// End A, the marks and end B: distance from end A, and place on the paper from
    /// the left of the card.
    stops: Vec<(f64, f64)>,
    /// Longest stretch between two stops that is drawn at full length.
    cap: f64,
}

impl Strip {
    /// Lays a rod out on a card `width` mm wide.
    pub fn new(length: f64, diameters: [f64; 2], marks: &[Mark], width: f64) -> Self {
        let room = width - BEFORE - AFTER;
        let at: Vec<f64> =
            [0.0].into_iter().chain(marks.iter().map(|m| m.at)).chain([length]).collect();
        let gaps: Vec<f64> = at.windows(2).map(|w| (w[1] - w[0]).max(0.0)).collect();
        let cap = cap(&gaps, room);
        let mut x = BEFORE;
        let mut stops = vec![(at[0], x)];
        for (gap, &s) in gaps.iter().zip(&at[1..]) {
            x += gap.min(cap);
            stops.push((s, x));
        }
        let thickest = diameters[0].max(diameters[1]);
        let thickness = thickest.min(WIDEST);
        let narrower = diameters.map(|d| (1.0 - d / thickest) * thickness / 2.0);
        Self { length, thickness, narrower, stops, cap }
    }

    /// Whether some stretch is drawn shorter than it is.
    pub fn is_broken(&self) -> bool {
        self.stops.windows(2).any(|w| self.breaks(w))
    }

    fn breaks(&self, stops: &[(f64, f64)]) -> bool {
        stops[1].0 - stops[0].0 > self.cap
    }

    /// Height that the strip takes with the signs of its marks, mm.
    pub fn height(&self) -> f64 {
        self.thickness + 2.0 * (LEADER + SIGN_HEIGHT)
    }

    /// Draws the strip with the top left corner of its room at `[x, y]`.
    pub fn draw(
        &self,
        out: &mut impl Draw,
        [x, y]: Point,
        marks: &[Mark],
        settings: &SheetSettings,
    ) -> Result<(), SheetError> {
        let top = y + SIGN_HEIGHT + LEADER;
        self.rod(out, [x, top]);
        self.ends(out, [x, top], settings)?;
        for above in [true, false] {
            self.marks(out, [x, top], marks, above);
        }
        self.figures(out, [x, top], marks, settings)
    }

    /// The outline of the rod, with break signs.
    fn rod(&self, out: &mut impl Draw, [x, top]: Point) {
        let (from, to) = (x + BEFORE, x + self.stops[self.stops.len() - 1].1);
        let (bottom, [a, b]) = (top + self.thickness, self.narrower);
        out.polygon(
            [[from, top + a], [to, top + b], [to, bottom - b], [from, bottom - a]],
            Stroke::new(0.25).fill(Color::PALE_GREY),
        );
        for stops in self.stops.windows(2).filter(|w| self.breaks(w)) {
            let middle = x + (stops[0].1 + stops[1].1) / 2.0;
            let (above, below) = (top - 0.8, top + self.thickness + 0.8);
            let lean = 0.7;
            out.polygon(
                [
                    [middle - BREAK + lean, above],
                    [middle + BREAK + lean, above],
                    [middle + BREAK - lean, below],
                    [middle - BREAK - lean, below],
                ],
                Color::WHITE,
            );
            for side in [-BREAK, BREAK] {
                let (a, b) = ([middle + side + lean, above], [middle + side - lean, below]);
                out.line(a, b, Stroke::new(0.25));
            }
        }
    }

    /// The triangle at end A, and both letters.
    fn ends(
        &self,
        out: &mut impl Draw,
        [x, top]: Point,
        settings: &SheetSettings,
    ) -> Result<(), SheetError> {
        let middle = top + self.thickness / 2.0;
        let tip = x + BEFORE;
        out.polygon(
            [[tip, middle], [tip - TRIANGLE, middle - 2.0], [tip - TRIANGLE, middle + 2.0]],
            Color::BLACK,
        );
        let right = tip - TRIANGLE - 1.0;
        out.text([right, middle - SMALL * 0.85], 4.0, "A").end().bold();
        out.text([right, middle + SMALL * 0.55], SMALL, settings.say(say::Measure {})?).end();
        out.text([right, middle + SMALL * 1.65], SMALL, settings.say(say::FromHere {})?).end();
        let b = x + self.stops[self.stops.len() - 1].1 + 1.5;
        out.text([b, middle], 4.0, "B").bold().vcenter();
        Ok(())
    }

    /// Ticks and signs of the marks on one side: under below the rod, all others above.
    fn marks(&self, out: &mut impl Draw, [x, top]: Point, marks: &[Mark], above: bool) {
        let stops = &self.stops[1..];
        let mine: Vec<(&Mark, f64)> = marks
            .iter()
            .zip(stops)
            .filter(|(m, _)| (m.side != Side::Under) == above)
            .map(|(m, stop)| (m, x + stop.1))
            .collect();
        let at: Vec<f64> = mine.iter().map(|(_, x)| *x).collect();
        let end = x + self.stops[self.stops.len() - 1].1 + AFTER;
        let signs = spread(&at, [x + BEFORE - 1.0, end - SIGN_HALF]);
        let bottom = top + self.thickness;
        let (edge, far) = if above { (top, top - LEADER) } else { (bottom, bottom + LEADER) };
        let knee = edge + (far - edge) * 0.4;
        let stroke = if above { OVER_TICK } else { UNDER_TICK };
        for ((mark, x), sign_x) in mine.into_iter().zip(signs) {
            let opposite = if above { bottom } else { top };
            out.line([x, opposite], [x, knee], stroke);
            out.line([x, knee], [sign_x, far], THIN);
            let middle = if above { far - SIGN_HEIGHT / 2.0 } else { far + SIGN_HEIGHT / 2.0 };
            sign(out, [sign_x, middle], &mark.letter, mark.side);
        }
    }

    /// The true length of every stretch that is drawn shorter, where there is room.
    fn figures(
        &self,
        out: &mut impl Draw,
        [x, top]: Point,
        marks: &[Mark],
        settings: &SheetSettings,
    ) -> Result<(), SheetError> {
        let y = top - LEADER - SIGN_HEIGHT / 2.0;
        for stops in self.stops.windows(2).filter(|w| self.breaks(w)) {
            let text = format!("‹ {} ›", settings.format().length(stops[1].0 - stops[0].0));
            let middle = x + (stops[0].1 + stops[1].1) / 2.0;
            let half = text_width(&text, SMALL, Weight::Regular)? / 2.0 + SIGN_HALF + 0.5;
            let clear = |m: &(f64, f64)| (x + m.1 - middle).abs() > half + APART;
            let free = stops[1].1 - stops[0].1 > 2.0 * half;
            if free && (marks.len() < 6 || self.stops.iter().all(clear)) {
                out.text([middle, y], SMALL, text).middle().vcenter();
            }
        }
        Ok(())
    }

    /// The cut length as drawn between ends A and B, mm.
    #[cfg(test)]
    pub fn drawn_length(&self) -> f64 {
        self.stops[self.stops.len() - 1].1 - BEFORE
    }

    /// The cut length, mm.
    pub fn length(&self) -> f64 {
        self.length
    }
}

/// The largest c with Σ min(gap, c) ≤ room; infinite if all gaps fit.
fn cap(gaps: &[f64], room: f64) -> f64 {
    let mut sorted = gaps.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut left = room;
    for (i, &gap) in sorted.iter().enumerate() {
        let share = left / (sorted.len() - i) as f64;
        if gap > share {
            return share;
        }
        left -= gap;
    }
    f64::INFINITY
}

/// Moves rising positions as little as needed to be [`APART`], within the limits if
/// there is room: groups that collide are centred on where they belong.
fn spread(at: &[f64], [lo, hi]: [f64; 2]) -> Vec<f64> {
    // Each group: number of members, sum of the places of its first sign.
    let mut groups: Vec<(usize, f64)> = Vec::new();
    let start = |&(n, sum): &(usize, f64)| {
        let n = n as f64;
        (sum / n).min(hi - (n - 1.0) * APART).max(lo)
    };
    for &x in at {
        groups.push((1, x));
        while let [.., a, b] = groups[..] {
            if start(&a) + a.0 as f64 * APART <= start(&b) {
                break;
            }
            // The members of b start that much later than those of a.
            let sum = a.1 + b.1 - b.0 as f64 * a.0 as f64 * APART;
            groups.truncate(groups.len() - 2);
            groups.push((a.0 + b.0, sum));
        }
    }
    groups.iter().flat_map(|g| (0..g.0).map(|k| start(g) + k as f64 * APART)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_longest_stretches_are_broken() {
        assert_eq!(cap(&[10.0, 20.0, 30.0], 60.0), f64::INFINITY);
        assert_eq!(cap(&[10.0, 100.0, 100.0], 110.0), 50.0);
        assert_eq!(cap(&[100.0, 100.0], 50.0), 25.0);
    }

    proptest! {
        #[test]
        fn capped_stretches_fill_the_room(gaps in proptest::collection::vec(0.0..300.0f64, 1..8)) {
            let c = cap(&gaps, 160.0);
            let drawn: f64 = gaps.iter().map(|g| g.min(c)).sum();
            prop_assert!(drawn <= 160.0 + 1e-9);
            prop_assert!(c.is_infinite() || (drawn - 160.0).abs() < 1e-9);
        }

        #[test]
        fn signs_keep_their_order_and_distance(
            mut at in proptest::collection::vec(20.0..180.0f64, 0..12),
        ) {
            at.sort_by(f64::total_cmp);
            let signs = spread(&at, [15.0, 185.0]);
            prop_assert_eq!(signs.len(), at.len());
            prop_assert!(signs.windows(2).all(|w| w[1] - w[0] >= APART - 1e-9));
            prop_assert!(signs.iter().all(|x| (15.0 - 1e-9..=185.0 + 1e-9).contains(x)));
            if at.windows(2).all(|w| w[1] - w[0] >= APART) {
                prop_assert!(signs.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-9));
            }
        }
    }
}
