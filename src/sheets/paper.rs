//! Paper sizes.

use crate::units::{Length, UnitError};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use std::str::FromStr;

/// What pages are printed on, upright.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Paper {
    /// 210 × 297 mm.
    #[default]
    A4,
    /// 297 × 420 mm.
    A3,
    /// 8.5 × 11 in.
    Letter,
    /// 11 × 17 in.
    Tabloid,
    /// Any other size, mm.
    Custom {
        /// Width, mm.
        width: f64,
        /// Height, mm.
        height: f64,
    },
}

/// Why a text is not a paper size.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PaperError {
    /// Neither a name nor a width and a height.
    #[error("`{0}` is not a paper: use a4, a3, letter, tabloid or a size such as 200x300mm")]
    Unknown(String),
    /// One side is not a length.
    #[error("`{text}` is not a paper: {reason}")]
    Side {
        /// The whole text.
        text: String,
        /// What is wrong with the side.
        reason: String,
    },
}

impl Paper {
    /// Width and height, mm.
    pub fn size(self) -> [f64; 2] {
        match self {
            Self::A4 => [210.0, 297.0],
            Self::A3 => [297.0, 420.0],
            Self::Letter => [215.9, 279.4],
            Self::Tabloid => [279.4, 431.8],
            Self::Custom { width, height } => [width, height],
        }
    }
}

/// The name, or the size as it can be read back.
impl fmt::Display for Paper {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::A4 => f.write_str("a4"),
            Self::A3 => f.write_str("a3"),
            Self::Letter => f.write_str("letter"),
            Self::Tabloid => f.write_str("tabloid"),
            Self::Custom { width, height } => write!(f, "{width}x{height}mm"),
        }
    }
}

impl FromStr for Paper {
    type Err = PaperError;

    fn from_str(text: &str) -> Result<Self, PaperError> {
        match text.trim().to_ascii_lowercase().as_str() {
            "a4" => Ok(Self::A4),
            "a3" => Ok(Self::A3),
            "letter" => Ok(Self::Letter),
            "tabloid" => Ok(Self::Tabloid),
            other => custom(other),
        }
    }
}

/// `200x300mm`, `8 in x 10 in`: a unit at the end counts for both sides.
fn custom(text: &str) -> Result<Paper, PaperError> {
    let (width, height) =
        text.split_once(['x', '×']).ok_or_else(|| PaperError::Unknown(text.to_owned()))?;
    let unit = height.trim_start_matches(|c: char| !c.is_alphabetic());
    let both = format!("{width}{unit}");
    let width = if width.contains(char::is_alphabetic) { width } else { &both };
    let side = |s: &str| -> Result<f64, PaperError> {
        let reason = match s.parse::<Length>() {
            Ok(l) if l.mm() > 0.0 => return Ok(l.mm()),
            Ok(_) => "a side must be above 0".to_owned(),
            Err(e) => UnitError::to_string(&e),
        };
        Err(PaperError::Side { text: text.to_owned(), reason })
    };
    Ok(Paper::Custom { width: side(width)?, height: side(height)? })
}

impl Serialize for Paper {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Paper {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_sizes_are_read_back() {
        for text in ["a4", "a3", "letter", "tabloid", "200x300mm", "200.5x300.25mm"] {
            assert_eq!(text.parse::<Paper>().unwrap().to_string(), text);
        }
        assert_eq!("A4".parse(), Ok(Paper::A4));
        let inches = Paper::Custom { width: 203.2, height: 254.0 };
        assert_eq!("8 in x 10 in".parse(), Ok(inches));
        assert_eq!("8x10in".parse(), Ok(inches));
        assert_eq!("200 x 300".parse(), Ok(Paper::Custom { width: 200.0, height: 300.0 }));
    }

    #[test]
    fn what_is_no_paper_is_refused() {
        for text in ["", "a9", "200", "x", "200x", "0x300", "-1x300", "200x300km"] {
            assert!(text.parse::<Paper>().is_err(), "{text}");
        }
    }
}
