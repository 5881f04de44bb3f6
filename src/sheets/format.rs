//! How figures are printed.

use crate::frame::Frame;
use crate::shop::lengths::diameters;
use crate::units::MM_PER_INCH;
use serde::{Deserialize, Serialize};

/// The unit in which documents print lengths. Files stay in mm.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
pub enum PaperUnits {
    /// Millimetres, to 0.1 mm.
    #[default]
    #[serde(rename = "mm")]
    #[value(name = "mm")]
    Mm,
    /// Decimal inches, to 0.01 in.
    #[serde(rename = "in")]
    #[value(name = "in")]
    Inch,
    /// Inches and sixteenths, as on a tape measure.
    #[serde(rename = "in/16")]
    #[value(name = "in/16")]
    Sixteenths,
    /// Inches and thirty-seconds.
    #[serde(rename = "in/32")]
    #[value(name = "in/32")]
    ThirtySeconds,
}

/// What is off a fraction of an inch by less than this is printed as the fraction where
/// rounding would mislead, mm: sticks and saws vary by more.
const SAME_FRACTION: f64 = 0.02;

impl PaperUnits {
    /// `mm` or `in`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Inch | Self::Sixteenths | Self::ThirtySeconds => "in",
        }
    }

    /// Whether lengths are in inches, in decimals or fractions.
    pub fn is_inches(self) -> bool {
        self != Self::Mm
    }

    /// A length without its unit: every length on paper is printed by this.
    pub fn length(self, mm: f64) -> String {
        match self {
            Self::Mm => fixed(mm, 1),
            Self::Inch => fixed(mm / MM_PER_INCH, 2),
            Self::Sixteenths => fraction(mm / MM_PER_INCH, 16),
            Self::ThirtySeconds => fraction(mm / MM_PER_INCH, 32),
        }
    }

    /// A small width with its unit, such as that of a saw cut: as a fraction of an inch only
    /// if it is one.
    pub fn width(self, mm: f64) -> String {
        format!("{} {}", self.exact(mm), self.name())
    }

    fn exact(self, mm: f64) -> String {
        let parts = match self {
            Self::Mm | Self::Inch => return self.length(mm),
            Self::Sixteenths => 16.0,
            Self::ThirtySeconds => 32.0,
        };
        let fraction = (mm / MM_PER_INCH * parts).round() / parts * MM_PER_INCH;
        if (mm - fraction).abs() < SAME_FRACTION { self.length(mm) } else { Self::Inch.length(mm) }
    }

    /// A length with its unit.
    pub fn measure(self, mm: f64) -> String {
        format!("{} {}", self.length(mm), self.name())
    }

    /// The diameter of a stick, given at end A and at end B, with its unit: `3.0 mm`, or
    /// `6.0→4.0 mm` of one that tapers.
    pub fn diameter(self, [a, b]: [f64; 2]) -> String {
        if a == b { self.width(a) } else { format!("{}→{}", self.exact(a), self.width(b)) }
    }

    /// The diameters of all rods of a frame; of many only the thinnest and the thickest.
    pub fn diameters(self, frame: &Frame) -> String {
        match &diameters(frame)[..] {
            [] => self.width(frame.diameter),
            few if few.len() <= FEW_DIAMETERS => {
                few.iter().map(|&(ends, _)| self.diameter(ends)).collect::<Vec<_>>().join(", ")
            }
            many => {
                let all = || many.iter().flat_map(|(ends, _)| *ends);
                let least = all().fold(f64::INFINITY, f64::min);
                format!("{}–{}", self.exact(least), self.width(all().fold(least, f64::max)))
            }
        }
    }

    /// A long length with its unit: metres, or feet.
    pub fn total(self, mm: f64) -> String {
        match self {
            Self::Mm => format!("{} m", fixed(mm / 1000.0, 2)),
            _ => format!("{} ft", fixed(mm / (12.0 * MM_PER_INCH), 1)),
        }
    }
}

/// As many diameters are named one by one.
const FEW_DIAMETERS: usize = 3;

/// How figures are printed on the papers: lengths in their unit, decimals after their sign.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Format {
    /// The unit of lengths.
    pub units: PaperUnits,
    /// The sign between whole numbers and decimals.
    pub decimal: char,
}

impl Format {
    /// A length without its unit.
    pub fn length(self, mm: f64) -> String {
        self.local(self.units.length(mm))
    }

    /// A length with its unit.
    pub fn measure(self, mm: f64) -> String {
        self.local(self.units.measure(mm))
    }

    /// A small width with its unit, as [`PaperUnits::width`].
    pub fn width(self, mm: f64) -> String {
        self.local(self.units.width(mm))
    }

    /// The diameter of a stick, as [`PaperUnits::diameter`].
    pub fn diameter(self, ends: [f64; 2]) -> String {
        self.local(self.units.diameter(ends))
    }

    /// The diameters of all rods, as [`PaperUnits::diameters`].
    pub fn diameters(self, frame: &Frame) -> String {
        self.local(self.units.diameters(frame))
    }

    /// A long length with its unit: metres, or feet.
    pub fn total(self, mm: f64) -> String {
        self.local(self.units.total(mm))
    }

    /// An angle given in radians, in degrees.
    pub fn angle(self, radians: f64) -> String {
        self.local(angle(radians))
    }

    /// A heading given in radians, in degrees from 0 to below 360.
    pub fn heading(self, radians: f64) -> String {
        self.local(heading(radians))
    }

    /// A share in per cent.
    pub fn percent(self, share: f64) -> String {
        self.local(format!("{} %", fixed(share * 100.0, 1)))
    }

    /// With three digits, as what is calculated and not measured deserves.
    pub fn three_digits(self, x: f64) -> String {
        let decimals = if x == 0.0 { 0.0 } else { 2.0 - x.abs().log10().floor() };
        self.fixed(x, decimals.clamp(0.0, 6.0) as usize)
    }

    /// A factor with four digits at most: `10`, `16.67`.
    pub fn factor(self, x: f64) -> String {
        let decimals = if x == 0.0 { 0.0 } else { 3.0 - x.abs().log10().floor() };
        let power = 10f64.powf(decimals.clamp(0.0, 6.0));
        self.plain((x * power).round() / power)
    }

    /// A share in per cent to three digits: where it may be very small.
    pub fn share(self, share: f64) -> String {
        format!("{} %", self.three_digits(100.0 * share))
    }

    /// A length to three digits, with its unit: where it may be very small.
    pub fn small(self, mm: f64) -> String {
        let unit = if self.units.is_inches() { MM_PER_INCH } else { 1.0 };
        format!("{} {}", self.three_digits(mm / unit), self.units.name())
    }

    /// A weight in kg to three figures or so.
    pub fn weight(self, kg: f64) -> String {
        let decimals = match kg {
            ..1.0 => 3,
            ..10.0 => 2,
            _ => 1,
        };
        self.fixed(kg, decimals)
    }

    /// With so many decimals; never `-0.0`.
    pub fn fixed(self, x: f64, decimals: usize) -> String {
        self.local(fixed(x, decimals))
    }

    /// With as many decimals as it has: `1:2.5` of a scale.
    pub fn plain(self, x: f64) -> String {
        self.local(x.to_string())
    }

    /// Figures are made with a point, and get their sign here.
    pub fn local(self, figures: String) -> String {
        match self.decimal {
            '.' => figures,
            sign => figures.replace('.', &sign.to_string()),
        }
    }
}

/// An angle given in radians, in degrees.
pub(super) fn angle(radians: f64) -> String {
    format!("{}°", fixed(radians.to_degrees(), 1))
}

/// A heading given in radians, in degrees from 0 to below 360.
pub(super) fn heading(radians: f64) -> String {
    let degrees = radians.to_degrees();
    // 359.96° would be printed as a full turn.
    let degrees = if degrees >= 359.95 { 0.0 } else { degrees };
    format!("{}°", fixed(degrees, 1))
}

/// A number of things: `1 rod`, `2 rods`.
pub(super) fn counted(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// A number in whole parts of one, shortened: `4 13/16`, `-1/4`, `7`.
fn fraction(x: f64, parts: u32) -> String {
    let all = (x.abs() * f64::from(parts)).round();
    let (whole, mut rest, mut parts) =
        ((all / f64::from(parts)).floor(), all % f64::from(parts), parts);
    while rest > 0.0 && rest % 2.0 == 0.0 {
        (rest, parts) = (rest / 2.0, parts / 2);
    }
    let sign = if x < 0.0 && all > 0.0 { "-" } else { "" };
    match (whole > 0.0, rest > 0.0) {
        (_, false) => format!("{sign}{whole}"),
        (false, true) => format!("{sign}{rest}/{parts}"),
        (true, true) => format!("{sign}{whole} {rest}/{parts}"),
    }
}

/// With so many decimals; never `-0.0`.
pub(super) fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use proptest::prelude::*;

    #[test]
    fn fractions_are_inches_too() {
        for units in <PaperUnits as clap::ValueEnum>::value_variants() {
            assert_eq!(units.is_inches(), units.name() == "in");
        }
    }

    #[test]
    fn lengths_in_both_units() {
        assert_eq!(PaperUnits::Mm.measure(112.44), "112.4 mm");
        assert_eq!(PaperUnits::Inch.measure(254.0), "10.00 in");
        assert_eq!(PaperUnits::Mm.diameter([5.0; 2]), "5.0 mm");
        assert_eq!(PaperUnits::Mm.diameter([6.0, 4.0]), "6.0→4.0 mm");
        assert_eq!(PaperUnits::Mm.length(-0.04), "0.0");
        assert_eq!(PaperUnits::Mm.length(-0.06), "-0.1");
        assert_eq!(PaperUnits::Mm.total(12_345.0), "12.35 m");
        assert_eq!(PaperUnits::Inch.total(3048.0), "10.0 ft");
    }

    #[test]
    fn inches_in_fractions_are_shortened_and_rounded_to_the_nearest() {
        let [coarse, fine] = [PaperUnits::Sixteenths, PaperUnits::ThirtySeconds];
        for (inches, sixteenths, thirty_seconds) in [
            (0.0, "0", "0"),
            (4.0, "4", "4"),
            (4.5, "4 1/2", "4 1/2"),
            (0.25, "1/4", "1/4"),
            (-0.75, "-3/4", "-3/4"),
            (4.41, "4 7/16", "4 13/32"),
            (4.99, "5", "5"),
            (-0.01, "0", "0"),
            (11.0 + 31.0 / 32.0, "12", "11 31/32"),
        ] {
            assert_eq!(coarse.length(inches * MM_PER_INCH), sixteenths);
            assert_eq!(fine.length(inches * MM_PER_INCH), thirty_seconds);
        }
        assert_eq!(coarse.measure(101.6), "4 in");
        // A stick of 3 mm is none of 1/8 in.
        assert_eq!([3.0, 3.175, 1.0].map(|mm| coarse.width(mm)), ["0.12 in", "1/8 in", "0.04 in"]);
        assert_eq!(coarse.diameter([6.35, 5.0]), "1/4→0.20 in");
    }

    proptest! {
        #[test]
        fn fractions_are_off_by_half_a_part_at_most(mm in -5000.0..5000.0f64) {
            let read = |text: &str| {
                let (sign, text) = match text.strip_prefix('-') {
                    Some(rest) => (-1.0, rest),
                    None => (1.0, text),
                };
                let part = |part: &str| match part.split_once('/') {
                    Some((a, b)) => a.parse::<f64>().unwrap() / b.parse::<f64>().unwrap(),
                    None => part.parse().unwrap(),
                };
                sign * text.split(' ').map(part).sum::<f64>() * MM_PER_INCH
            };
            for (units, parts) in [(PaperUnits::Sixteenths, 16.0), (PaperUnits::ThirtySeconds, 32.0)] {
                let off = (read(&units.length(mm)) - mm).abs();
                prop_assert!(off <= MM_PER_INCH / parts / 2.0 + 1e-9);
            }
        }
    }

    #[test]
    fn diameters_of_a_frame_are_named_or_bounded() {
        let mut frame = crate::shop::fixture::circuit(5, 3.0);
        assert_eq!(PaperUnits::Mm.diameters(&frame), "3.0 mm");
        frame.rods[Id::new(1)].diameters = [6.0, 4.0];
        frame.rods[Id::new(2)].diameters = [5.0; 2];
        assert_eq!(PaperUnits::Mm.diameters(&frame), "3.0 mm, 5.0 mm, 6.0→4.0 mm");
        frame.rods[Id::new(3)].diameters = [2.0, 3.0];
        assert_eq!(PaperUnits::Mm.diameters(&frame), "2.0–6.0 mm");
    }

    #[test]
    fn three_digits_are_kept_of_small_and_large() {
        let format = Format { units: PaperUnits::Inch, decimal: '.' };
        for (x, text) in [
            (0.0, "0"),
            (1.0, "1.00"),
            (12.345, "12.3"),
            (-0.001_234, "-0.00123"),
            (98_765.4, "98765"),
        ] {
            assert_eq!(format.three_digits(x), text);
        }
        assert_eq!(
            (format.share(0.01), format.small(0.254)),
            ("1.00 %".into(), "0.0100 in".into())
        );
    }

    #[test]
    fn a_full_turn_is_none() {
        assert_eq!(heading(359.96_f64.to_radians()), "0.0°");
        assert_eq!(heading(359.94_f64.to_radians()), "359.9°");
        assert_eq!(angle(1.0_f64.atan()), "45.0°");
    }

    #[test]
    fn decimals_stand_after_the_sign_of_the_language() {
        let format = Format { units: PaperUnits::Mm, decimal: ',' };
        assert_eq!(format.measure(112.44), "112,4 mm");
        assert_eq!(format.diameter([6.0, 4.0]), "6,0→4,0 mm");
        assert_eq!(format.angle(0.5f64.to_radians()), "0,5°");
        assert_eq!(format.percent(0.1234), "12,3 %");
        assert_eq!((format.plain(2.5), format.plain(10.0)), ("2,5".to_owned(), "10".to_owned()));
        let english = Format { decimal: '.', ..format };
        assert_eq!(
            (english.percent(0.1234), english.fixed(-0.0, 2)),
            ("12.3 %".into(), "0.00".into())
        );
    }
}
