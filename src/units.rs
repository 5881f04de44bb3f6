//! Lengths, angles, forces and pressures as people write them: `3mm`, `12 cm`, `1/8in`, `2ft`,
//! `20deg`, `100N`, `2kg`, `0.5kPa`.
//!
//! These types stand at the border of the program. Inside, lengths are plain `f64` in mm,
//! angles in radians, forces in N, pressures in MPa.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A finite length, held in mm.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Length(f64);

/// A finite angle, held in radians.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Angle(f64);

/// A finite force, held in N. A mass stands for its weight.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Force(f64);

/// A finite pressure, held in kPa, which is kN/m². A mass on an area stands for its weight.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Pressure(f64);

/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.80665;

/// Newtons to the pound-force.
const NEWTON_PER_POUND: f64 = 0.453_592_37 * GRAVITY;
/// Square metres to the square foot.
const M2_PER_FOOT2: f64 = 0.092_903_04;

/// Why a text is not a length, angle, force or pressure.
#[derive(Error, Debug, PartialEq)]
pub enum UnitError {
    /// The text holds no number at its start.
    #[error("`{0}` does not start with a number; write for example {1}")]
    NoNumber(String, &'static str),
    /// The text behind the number is not a unit of this kind.
    #[error("`{unit}` in `{text}` is not a unit; use {known}")]
    UnknownUnit { text: String, unit: String, known: &'static str },
    /// The number is infinite or not a number.
    #[error("`{0}` is not a finite number")]
    NotFinite(String),
}

/// Millimetres to the inch.
pub const MM_PER_INCH: f64 = 25.4;

impl Length {
    /// A length of `mm` millimetres.
    ///
    /// # Errors
    /// [`UnitError::NotFinite`] for infinities and NaN.
    pub fn from_mm(mm: f64) -> Result<Self, UnitError> {
        if mm.is_finite() { Ok(Self(mm)) } else { Err(UnitError::NotFinite(mm.to_string())) }
    }

    /// In millimetres.
    pub fn mm(self) -> f64 {
        self.0
    }
}

impl Angle {
    /// An angle of `deg` degrees.
    ///
    /// # Errors
    /// [`UnitError::NotFinite`] for infinities and NaN.
    pub fn from_degrees(deg: f64) -> Result<Self, UnitError> {
        if deg.is_finite() {
            Ok(Self(deg.to_radians()))
        } else {
            Err(UnitError::NotFinite(deg.to_string()))
        }
    }

    /// In radians.
    pub fn radians(self) -> f64 {
        self.0
    }

    /// In degrees, to twelve decimals: what was given in degrees comes back as given.
    pub fn degrees(self) -> f64 {
        tidy(self.0.to_degrees())
    }
}

impl Force {
    /// In newtons.
    pub fn newtons(self) -> f64 {
        self.0
    }

    fn from_newtons(newtons: f64) -> Result<Self, UnitError> {
        finite(newtons).map(Self)
    }
}

impl Pressure {
    /// In megapascals, which is N/mm².
    pub fn mpa(self) -> f64 {
        self.0 * 1e-3
    }

    fn from_kpa(kpa: f64) -> Result<Self, UnitError> {
        finite(kpa).map(Self)
    }
}

fn finite(x: f64) -> Result<f64, UnitError> {
    if x.is_finite() { Ok(x) } else { Err(UnitError::NotFinite(x.to_string())) }
}

/// Splits `text` into its leading number (a decimal, or a fraction such as
/// `1/8` or `1 1/2`) and the trimmed rest.
fn split_number<'a>(text: &'a str, example: &'static str) -> Result<(f64, &'a str), UnitError> {
    let t = text.trim();
    let none = || UnitError::NoNumber(text.to_string(), example);
    let end = number_end(t);
    let head = t[..end].trim();
    let value = if let Some((front, denominator)) = head.split_once('/') {
        let (whole, numerator) = front.trim().rsplit_once(' ').unwrap_or(("0", front.trim()));
        let parse = |s: &str| s.trim().parse::<f64>().map_err(|_| none());
        parse(whole)? + parse(numerator)? / parse(denominator)?
    } else {
        head.parse::<f64>().map_err(|_| none())?
    };
    if !value.is_finite() {
        return Err(UnitError::NotFinite(text.to_string()));
    }
    Ok((value, t[end..].trim()))
}

/// Where the number at the start of `t` ends: digits, signs, points, spaces and
/// slashes, and an exponent only where a digit or a sign follows it.
fn number_end(t: &str) -> usize {
    let bytes = t.as_bytes();
    let mut end = 0;
    while end < bytes.len() {
        let next = bytes.get(end + 1);
        let part_of_number = match bytes[end] {
            b'0'..=b'9' | b'.' | b'+' | b'-' | b'/' | b' ' => true,
            b'e' | b'E' => matches!(next, Some(b'0'..=b'9' | b'-' | b'+')),
            _ => false,
        };
        if !part_of_number {
            break;
        }
        end += 1;
    }
    end
}

impl FromStr for Length {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (value, unit) = split_number(text, "3mm, 1.2 cm or 1/8in")?;
        let scale = match unit {
            "" | "mm" => 1.0,
            "cm" => 10.0,
            "m" => 1000.0,
            "in" | "inch" | "\"" => MM_PER_INCH,
            "ft" | "'" => 12.0 * MM_PER_INCH,
            _ => return Err(unknown(text, unit, "mm, cm, m, in or ft")),
        };
        Self::from_mm(value * scale)
    }
}

impl FromStr for Angle {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (value, unit) = split_number(text, "20deg or 0.35rad")?;
        match unit {
            "" | "deg" | "°" => Self::from_degrees(value),
            "rad" => Self::from_degrees(value.to_degrees()),
            _ => Err(unknown(text, unit, "deg or rad")),
        }
    }
}

impl FromStr for Force {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (value, unit) = split_number(text, "100N, 2kg or 5lbf")?;
        let scale = match unit {
            "" | "N" => 1.0,
            "kN" => 1e3,
            "kg" => GRAVITY,
            "g" => GRAVITY * 1e-3,
            "lb" | "lbf" => NEWTON_PER_POUND,
            _ => return Err(unknown(text, unit, "N, kN, kg, g or lb")),
        };
        Self::from_newtons(value * scale)
    }
}

impl FromStr for Pressure {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (value, unit) = split_number(text, "0.5kPa, 50kg/m2 or 10psf")?;
        let scale = match unit {
            "" | "kPa" | "kN/m2" | "kN/m²" => 1.0,
            "Pa" | "N/m2" | "N/m²" => 1e-3,
            "kg/m2" | "kg/m²" => GRAVITY * 1e-3,
            "psf" => NEWTON_PER_POUND / M2_PER_FOOT2 * 1e-3,
            _ => return Err(unknown(text, unit, "kPa, Pa, kN/m2, N/m2, kg/m2 or psf")),
        };
        Self::from_kpa(value * scale)
    }
}

fn unknown(text: &str, unit: &str, known: &'static str) -> UnitError {
    UnitError::UnknownUnit { text: text.to_string(), unit: unit.to_string(), known }
}

/// With the shortest digits that read back as the same number.
impl fmt::Display for Force {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}N", self.0)
    }
}

/// With the shortest digits that read back as the same number.
impl fmt::Display for Pressure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}kPa", self.0)
    }
}

/// With the shortest digits that read back as the same number.
impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}mm", self.0)
    }
}

/// In degrees where the degrees read back as the same angle, else in radians.
impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let degrees = self.degrees();
        if degrees.to_radians() == self.0 {
            write!(f, "{degrees}deg")
        } else {
            write!(f, "{}rad", self.0)
        }
    }
}

/// The nearest number of twelve decimals: undoes the last-bit noise of a
/// conversion to radians and back.
fn tidy(x: f64) -> f64 {
    (x * 1e12).round() / 1e12
}

macro_rules! serde_as_text {
    ($type:ty, $from_number:path) => {
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
                s.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(untagged)]
                enum Raw {
                    Number(f64),
                    Text(String),
                }
                match Raw::deserialize(d)? {
                    Raw::Number(x) => $from_number(x),
                    Raw::Text(t) => t.parse(),
                }
                .map_err(de::Error::custom)
            }
        }
    };
}

serde_as_text!(Length, Length::from_mm);
serde_as_text!(Angle, Angle::from_degrees);
serde_as_text!(Pressure, Pressure::from_kpa);

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mm(text: &str) -> f64 {
        text.parse::<Length>().unwrap().mm()
    }

    #[test]
    fn lengths_take_units_and_fractions() {
        assert_eq!(mm("3mm"), 3.0);
        assert_eq!(mm("3"), 3.0);
        assert_eq!(mm(" 12 cm "), 120.0);
        assert_eq!(mm("0.6 m"), 600.0);
        assert_eq!(mm("1/8in"), 3.175);
        assert!((mm("1 1/2 in") - 38.1).abs() < 1e-12);
        assert!((mm("2ft") - 609.6).abs() < 1e-9);
        assert_eq!(mm("1e2mm"), 100.0);
    }

    #[test]
    fn angles_are_degrees_unless_said() {
        let a: Angle = "20".parse().unwrap();
        assert!((a.degrees() - 20.0).abs() < 1e-12);
        let b: Angle = "0.5rad".parse().unwrap();
        assert!((b.radians() - 0.5).abs() < 1e-15);
    }

    #[test]
    fn masses_are_weights() {
        let newtons = |text: &str| text.parse::<Force>().unwrap().newtons();
        assert_eq!([newtons("100N"), newtons("-1.5kN"), newtons("3")], [100.0, -1500.0, 3.0]);
        assert_eq!(newtons("2kg"), 2.0 * 9.80665);
        assert!((newtons("1lbf") - 4.448_221_615).abs() < 1e-9);
        let mpa = |text: &str| text.parse::<Pressure>().unwrap().mpa();
        assert_eq!([mpa("0.5kPa"), mpa("500 Pa"), mpa("0.5")], [0.5e-3; 3]);
        assert!((mpa("1psf") - 47.880_259e-6).abs() < 1e-12);
        assert!("5 apples".parse::<Force>().unwrap_err().to_string().contains("kg"));
    }

    #[test]
    fn nonsense_is_named() {
        for bad in ["", "mm", "three mm", "1/0in", "--3", "inf", "NaN", "1/"] {
            assert!(bad.parse::<Length>().is_err(), "{bad}");
        }
        let unit = "3 furlongs".parse::<Length>().unwrap_err().to_string();
        assert!(unit.contains("furlongs") && unit.contains("cm"), "{unit}");
    }

    proptest! {
        #[test]
        fn printing_and_reading_give_the_same(mm in -1e6..1e6f64, deg in -360.0..360.0f64) {
            let length = Length::from_mm(mm).unwrap();
            prop_assert_eq!(length.to_string().parse::<Length>().unwrap(), length);
            let angle = Angle::from_degrees(deg).unwrap();
            let back = angle.to_string().parse::<Angle>().unwrap();
            prop_assert!((back.radians() - angle.radians()).abs() <= 1e-15 * 6.3);
        }
    }
}
