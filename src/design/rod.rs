//! The rods as a design file gives them: one diameter, or a table with rods of others.
//!
//! ```toml
//! [rod]
//! diameter = "3mm"
//! [rod.sizes]
//! border = "5mm"              # rods at the border
//! R012 = "4mm"                # one rod, by its number
//! R020 = ["6mm", "4mm"]       # tapered: at end A and at end B
//! all = "3.5mm"               # all that are not named otherwise
//! ```

use crate::frame::sizes::SizeTable;
use crate::ids::RodId;
use crate::units::{Length, UnitError};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::str::FromStr;

/// The rods as given: on the command line only a diameter.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RodSetting {
    /// The nominal diameter.
    pub diameter: Option<Length>,
    /// Rods of other diameters.
    pub sizes: SizeTable,
}

impl RodSetting {
    /// The diameter of this, or else of `other`, and the other diameters of both.
    pub fn or(self, other: Self) -> Self {
        let sizes = if self.sizes.is_empty() { other.sizes } else { self.sizes };
        Self { diameter: self.diameter.or(other.diameter), sizes }
    }
}

impl From<Length> for RodSetting {
    fn from(diameter: Length) -> Self {
        Self { diameter: Some(diameter), sizes: SizeTable::default() }
    }
}

impl FromStr for RodSetting {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        text.parse::<Length>().map(Self::from)
    }
}

/// What a design file holds where there is a table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    diameter: Option<Length>,
    #[serde(default)]
    sizes: Named,
}

impl<'de> Deserialize<'de> for RodSetting {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RodVisitor)
    }
}

/// Not an untagged enum: its errors would say neither key nor reason.
struct RodVisitor;

impl<'de> Visitor<'de> for RodVisitor {
    type Value = RodSetting;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a length such as \"3mm\", or a table with diameter and sizes")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<RodSetting, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_f64<E: Error>(self, mm: f64) -> Result<RodSetting, E> {
        Length::from_mm(mm).map(RodSetting::from).map_err(E::custom)
    }

    fn visit_i64<E: Error>(self, mm: i64) -> Result<RodSetting, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RodSetting, A::Error> {
        let table = Table::deserialize(MapAccessDeserializer::new(map))?;
        Ok(RodSetting { diameter: table.diameter, sizes: table.sizes.0 })
    }
}

/// The table of other diameters.
#[derive(Default)]
struct Named(SizeTable);

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(NamedVisitor)
    }
}

struct NamedVisitor;

impl<'de> Visitor<'de> for NamedVisitor {
    type Value = Named;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table of diameters by border, all, or the numbers of rods")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named, A::Error> {
        let mut table = SizeTable::default();
        while let Some(key) = map.next_key::<Who>()? {
            let Ends(ends) = map.next_value()?;
            let twice = match key {
                Who::Border => table.border.replace(ends).is_some(),
                Who::All => table.all.replace(ends).is_some(),
                Who::Rod(rod) => table.rods.insert(rod, ends).is_some(),
            };
            if twice {
                return Err(A::Error::custom(format!("{key} is given two diameters")));
            }
        }
        Ok(Named(table))
    }
}

/// Which rods a diameter is for.
#[derive(Clone, Copy)]
enum Who {
    Border,
    All,
    Rod(RodId),
}

impl fmt::Display for Who {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Border => f.write_str("border"),
            Self::All => f.write_str("all"),
            Self::Rod(rod) => rod.fmt(f),
        }
    }
}

impl<'de> Deserialize<'de> for Who {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let key = String::deserialize(deserializer)?;
        match key.as_str() {
            "border" => Ok(Self::Border),
            "all" => Ok(Self::All),
            _ => RodId::read(&key).map(Self::Rod).ok_or_else(|| {
                D::Error::custom(format!(
                    "`{key}` names no rods: use border, all, or the number of a rod such as R012"
                ))
            }),
        }
    }
}

/// One diameter, or those at end A and at end B, mm.
struct Ends([f64; 2]);

impl<'de> Deserialize<'de> for Ends {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EndsVisitor)
    }
}

struct EndsVisitor;

impl EndsVisitor {
    fn both<E: Error>(lengths: [Length; 2]) -> Result<Ends, E> {
        match lengths.iter().find(|l| l.mm() <= 0.0) {
            Some(bad) => Err(E::custom(format!("a diameter of {bad} must be more than nothing"))),
            None => Ok(Ends(lengths.map(Length::mm))),
        }
    }
}

impl<'de> Visitor<'de> for EndsVisitor {
    type Value = Ends;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a length such as \"5mm\", or two for a tapered rod: at end A and at end B")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Ends, E> {
        let length = Length::deserialize(text.into_deserializer())?;
        Self::both([length; 2])
    }

    fn visit_f64<E: Error>(self, mm: f64) -> Result<Ends, E> {
        Self::both([Length::from_mm(mm).map_err(E::custom)?; 2])
    }

    fn visit_i64<E: Error>(self, mm: i64) -> Result<Ends, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Ends, A::Error> {
        let lengths = Vec::<Length>::deserialize(SeqAccessDeserializer::new(seq))?;
        let two = <[Length; 2]>::try_from(lengths);
        Self::both(two.map_err(|l| A::Error::invalid_length(l.len(), &self))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Settings;

    fn read(text: &str) -> Result<RodSetting, String> {
        let settings: Result<Settings, _> = toml::from_str(text);
        settings.map(|s| s.rod.unwrap_or_default()).map_err(|e| e.to_string())
    }

    #[test]
    fn a_length_and_a_table_are_read() {
        for text in ["rod = '3mm'", "rod = 3", "rod = 3.0", "[rod]\ndiameter = '3mm'"] {
            assert_eq!(read(text).unwrap(), "3mm".parse().unwrap(), "{text}");
        }
        let text = "[rod]\ndiameter = 3\n[rod.sizes]\nborder = '5mm'\nR012 = 4\nr20 = ['6mm', 4]\n\
                    all = ['1/8in', '3mm']";
        let RodSetting { diameter, sizes } = read(text).unwrap();
        assert_eq!(diameter.map(Length::mm), Some(3.0));
        assert_eq!((sizes.border, sizes.all), (Some([5.0; 2]), Some([3.175, 3.0])));
        let rods: Vec<_> = sizes.rods.iter().map(|(r, d)| (r.to_string(), *d)).collect();
        assert_eq!(rods, [("R012".into(), [4.0; 2]), ("R020".into(), [6.0, 4.0])]);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_key_or_value() {
        for (text, word) in [
            ("rod = '3 furlongs'", "furlongs"),
            ("rod = true", "a table with diameter and sizes"),
            ("[rod]\nwidth = 3", "unknown field `width`"),
            ("[rod.sizes]\nrim = 3", "`rim` names no rods"),
            ("[rod.sizes]\nR000 = 3", "`R000` names no rods"),
            ("[rod.sizes]\n'R+12' = 3", "`R+12` names no rods"),
            ("[rod.sizes]\nR = 3", "`R` names no rods"),
            ("[rod.sizes]\nR12 = 3\nR012 = 4", "R012 is given two diameters"),
            ("[rod.sizes]\nborder = '0mm'", "0mm must be more than nothing"),
            ("[rod.sizes]\nborder = -2", "-2mm must be more than nothing"),
            ("[rod.sizes]\nborder = ['3mm', '-1mm']", "-1mm must be more than nothing"),
            ("[rod.sizes]\nborder = ['3mm']", "invalid length 1"),
            ("[rod.sizes]\nborder = ['3mm', '3mm', '3mm']", "invalid length 3"),
            ("[rod.sizes]\nborder = 'thick'", "thick"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(word), "{text}: {message}");
        }
    }

    #[test]
    fn the_command_line_changes_the_diameter_only() {
        let file = read("[rod]\ndiameter = 3\n[rod.sizes]\nborder = 5").unwrap();
        let both = "4mm".parse::<RodSetting>().unwrap().or(file);
        assert_eq!(both.diameter.map(Length::mm), Some(4.0));
        assert_eq!(both.sizes.border, Some([5.0; 2]));
    }
}
