//! Letters of single strokes, which a laser scores in one pass.
//!
//! They stand on a grid: capitals are 4 wide and 6 high, small letters 3 and 4. Strokes meet and
//! cross, but no two lie on each other: the laser would burn twice.

use super::Point;

/// Steps of the grid in the height of a capital.
const HEIGHT: f64 = 6.0;
/// Free steps between two letters.
const SPACING: f64 = 1.5;
/// Width of a character that is not known, in steps; nothing is drawn of it.
const UNKNOWN: u8 = 3;

/// A character, its width, and its strokes: points as two signs, x and y, strokes with spaces
/// between. `z` and `y` are the first and the second line below the baseline.
#[rustfmt::skip]
const LETTERS: &[(char, u8, &str)] = &[
    ('0', 4, "103041453616050110 0145"),
    ('1', 2, "042620"),
    ('2', 4, "05163645440040"),
    ('3', 4, "0516364544334241301001 1333"),
    ('4', 4, "30360242"),
    ('5', 4, "460603334241301001"),
    ('6', 4, "4536160501103041423303"),
    ('7', 4, "064610"),
    ('8', 4, "130405163645443313 1302011030414233"),
    ('9', 4, "0110304145361605041343"),
    ('A', 4, "0004264440 0242"),
    ('B', 4, "00063645443303 3342413000"),
    ('C', 4, "4536160501103041"),
    ('D', 4, "00062644422000"),
    ('E', 4, "46060040 0333"),
    ('F', 4, "460600 0333"),
    ('G', 4, "45361605011030414323"),
    ('H', 4, "0006 4046 0343"),
    ('I', 2, "1016 0020 0626"),
    ('J', 4, "4641301001"),
    ('K', 4, "0006 4602 1340"),
    ('L', 4, "060040"),
    ('M', 4, "0006234640"),
    ('N', 4, "00064046"),
    ('O', 4, "103041453616050110"),
    ('P', 4, "00063645443303"),
    ('Q', 4, "103041453616050110 2240"),
    ('R', 4, "00063645443303 2340"),
    ('S', 4, "453616050413334241301001"),
    ('T', 4, "0646 2620"),
    ('U', 4, "060110304146"),
    ('V', 4, "062046"),
    ('W', 4, "0610233046"),
    ('X', 4, "0046 0640"),
    ('Y', 4, "062346 2320"),
    ('Z', 4, "06460040"),
    ('a', 3, "3430 3324140301102031"),
    ('b', 3, "0600 0314243331201001"),
    ('c', 3, "3324140301102031"),
    ('d', 3, "3630 3324140301102031"),
    ('e', 3, "02323324140301102031"),
    ('f', 2, "261510 0424"),
    ('g', 3, "3324140301102031 343z2y1y0z"),
    ('h', 3, "0600 0314243330"),
    ('i', 0, "0004 0506"),
    ('j', 1, "141z0y 1516"),
    ('k', 3, "0600 3401 1230"),
    ('l', 0, "0600"),
    ('m', 4, "0400 031423344340 2320"),
    ('n', 3, "0400 0314243330"),
    ('o', 3, "102031332414030110"),
    ('p', 3, "040y 0314243331201001"),
    ('q', 3, "343y 3324140301102031"),
    ('r', 3, "0400 03142433"),
    ('s', 3, "3414031222312000"),
    ('t', 2, "161120 0424"),
    ('u', 3, "0401102031 3430"),
    ('v', 4, "042044"),
    ('w', 4, "0410233044"),
    ('x', 3, "0034 0430"),
    ('y', 4, "0420 441y"),
    ('z', 3, "04340030"),
    ('.', 1, "0010"),
    ('-', 3, "0333"),
    ('+', 4, "0343 2521"),
    ('/', 4, "0046"),
    ('°', 2, "0424260604"),
    (' ', 2, ""),
];

/// Lines of text: how high, and turned by how much.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Lettering {
    /// Height of a capital, mm.
    pub height: f64,
    /// The way that a line runs, counter-clockwise from x, radians.
    pub angle: f64,
}

impl Lettering {
    /// Upright letters.
    pub fn new(height: f64) -> Self {
        Self { height, angle: 0.0 }
    }

    /// The strokes of a line of text that begins at a point of its baseline. Characters that
    /// are not known leave room.
    pub fn at(self, start: Point, text: &str) -> Vec<Vec<Point>> {
        let step = self.height / HEIGHT;
        let (sin, cos) = self.angle.sin_cos();
        let mut strokes = Vec::new();
        let mut pen = 0.0;
        for character in text.chars() {
            let (width, drawn) = glyph(character);
            let place = |[x, y]: Point| {
                let (x, y) = ((pen + x) * step, y * step);
                [start[0] + x * cos - y * sin, start[1] + x * sin + y * cos]
            };
            strokes.extend(drawn.iter().map(|stroke| stroke.iter().map(|&p| place(p)).collect()));
            pen += width + SPACING;
        }
        strokes
    }

    /// The strokes of a line of text whose capitals have their middle at a point.
    pub fn centred(self, middle: Point, text: &str) -> Vec<Vec<Point>> {
        let (sin, cos) = self.angle.sin_cos();
        let (x, y) = (-width_of(text, self.height) / 2.0, -self.height / 2.0);
        self.at([middle[0] + x * cos - y * sin, middle[1] + x * sin + y * cos], text)
    }

    /// The strokes of lines of upright text, one below the other about a point.
    pub fn block(self, [x, y]: Point, lines: &[String]) -> Vec<Vec<Point>> {
        let above = |i: usize| (lines.len() as f64 - 1.0) / 2.0 - i as f64;
        let line =
            |(i, text): (usize, &String)| self.centred([x, y + above(i) * 1.5 * self.height], text);
        lines.iter().enumerate().flat_map(line).collect()
    }
}

/// The height of lines of text of capitals so high: half that is free between them.
pub fn height_of(lines: &[String], height: f64) -> f64 {
    height * (1.5 * lines.len() as f64 - 0.5)
}

/// The width of a line of text of capitals so high.
pub fn width_of(text: &str, height: f64) -> f64 {
    let steps: f64 = text.chars().map(|c| glyph(c).0 + SPACING).sum();
    (steps - SPACING).max(0.0) * height / HEIGHT
}

/// Width and strokes of a character, in steps.
fn glyph(character: char) -> (f64, Vec<Vec<Point>>) {
    let Some((_, width, strokes)) = LETTERS.iter().find(|(c, ..)| *c == character) else {
        return (f64::from(UNKNOWN), Vec::new());
    };
    let line = |sign: u8| match sign {
        b'z' => -1.0,
        b'y' => -2.0,
        digit => f64::from(digit.saturating_sub(b'0')),
    };
    let stroke = |s: &str| s.as_bytes().chunks(2).map(|p| [line(p[0]), line(p[1])]).collect();
    (f64::from(*width), strokes.split_whitespace().map(stroke).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segments(character: char) -> Vec<[Point; 2]> {
        let (_, strokes) = glyph(character);
        strokes.iter().flat_map(|s| s.windows(2).map(|w| [w[0], w[1]])).collect()
    }

    #[test]
    fn letters_stay_on_their_grid() {
        for (character, width, strokes) in LETTERS {
            assert!(strokes.split_whitespace().all(|s| s.len() % 2 == 0 && s.len() >= 4));
            for [x, y] in segments(*character).into_iter().flatten() {
                assert!((0.0..=f64::from(*width)).contains(&x), "{character}");
                assert!((-2.0..=6.0).contains(&y), "{character}");
            }
        }
        let capital = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit();
        for (character, ..) in LETTERS.iter().filter(|l| capital(l.0)) {
            let heights: Vec<f64> = segments(*character).concat().iter().map(|p| p[1]).collect();
            assert!(heights.contains(&0.0) && heights.contains(&6.0), "{character}");
        }
    }

    #[test]
    fn no_stroke_is_burnt_twice() {
        let cross = |[a, b]: [Point; 2], p: Point| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        for (character, ..) in LETTERS {
            let all = segments(*character);
            for (i, &s) in all.iter().enumerate() {
                let [a, b] = s;
                assert_ne!(a, b, "{character}");
                for t in &all[..i] {
                    if t.iter().any(|&p| cross(s, p) != 0.0) {
                        continue;
                    }
                    // On one line: they may only touch.
                    let along =
                        |p: Point| (p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1]);
                    let [u, v] = t.map(along);
                    let length = along(b);
                    assert!(u.max(v) <= 0.0 || u.min(v) >= length, "{character}: {s:?} {t:?}");
                }
            }
        }
    }

    #[test]
    fn a_line_of_text_is_as_wide_as_said_and_centred() {
        let strokes = Lettering::new(3.0).centred([10.0, 20.0], "R048");
        let all = strokes.concat();
        let span = |i: usize| {
            let of = all.iter().map(|p| p[i]);
            [of.clone().fold(f64::INFINITY, f64::min), of.fold(f64::NEG_INFINITY, f64::max)]
        };
        let [[left, right], [low, high]] = [span(0), span(1)];
        assert!((right - left - width_of("R048", 3.0)).abs() < 1e-9);
        assert!((right + left - 20.0).abs() < 1e-9);
        assert!((low - 18.5).abs() < 1e-9 && (high - 21.5).abs() < 1e-9);
    }
}
