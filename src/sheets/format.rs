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
}

impl PaperUnits {
    /// `mm` or `in`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Inch => "in",
        }
    }

    /// A length without its unit: every length on paper is printed by this.
    pub fn length(self, mm: f64) -> String {
        match self {
            Self::Mm => fixed(mm, 1),
            Self::Inch => fixed(mm / MM_PER_INCH, 2),
        }
    }

    /// A length with its unit.
    pub fn measure(self, mm: f64) -> String {
        format!("{} {}", self.length(mm), self.name())
    }

    /// The diameter of a stick, given at end A and at end B, with its unit: `3.0 mm`, or
    /// `6.0→4.0 mm` of one that tapers.
    pub fn diameter(self, [a, b]: [f64; 2]) -> String {
        if a == b { self.measure(a) } else { format!("{}→{}", self.length(a), self.measure(b)) }
    }

    /// The diameters of all rods of a frame; of many only the thinnest and the thickest.
    pub fn diameters(self, frame: &Frame) -> String {
        match &diameters(frame)[..] {
            [] => self.measure(frame.diameter),
            few if few.len() <= FEW_DIAMETERS => {
                few.iter().map(|&(ends, _)| self.diameter(ends)).collect::<Vec<_>>().join(", ")
            }
            many => {
                let all = || many.iter().flat_map(|(ends, _)| *ends);
                let least = all().fold(f64::INFINITY, f64::min);
                format!("{}–{}", self.length(least), self.measure(all().fold(least, f64::max)))
            }
        }
    }

    /// A long length with its unit: metres, or feet.
    pub fn total(self, mm: f64) -> String {
        match self {
            Self::Mm => format!("{} m", fixed(mm / 1000.0, 2)),
            Self::Inch => format!("{} ft", fixed(mm / (12.0 * MM_PER_INCH), 1)),
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
