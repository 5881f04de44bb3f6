//! Bars as people write them: `1000mm`, `2000mm @ 2.10 x 5`, `1000mm of 5mm @ 1.20`; and
//! offcuts: `430mm`, `2x610mm`. In a design file also as tables:
//!
//! ```toml
//! stock = ["1000mm @ 1.20", { length = "2000mm", price = 2.1, count = 5 }]
//! offcuts = ["430mm", { length = "610mm", count = 2, diameter = "5mm" }]
//! ```

use crate::shop::Offer;
use crate::units::{Length, UnitError};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Bars on sale.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StockItem(pub Offer);

/// Offcuts at hand.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OffcutItem(pub Offer);

/// Why a text is no bar.
#[derive(Error, Debug, PartialEq)]
pub enum StockError {
    /// A length that is none.
    #[error("{0}")]
    Length(#[from] UnitError),
    /// A length of nothing, or less.
    #[error("`{0}`: a {1} must be more than nothing")]
    NotPositive(String, &'static str),
    /// A count that is none.
    #[error("`{0}`: `{1}` is no count; write how many there are, as in {2}")]
    Count(String, String, &'static str),
    /// A price that is none.
    #[error("`{0}`: `{1}` is no price; write a number above 0, as in 1000mm @ 1.20")]
    Price(String, String),
}

const STOCK_EXAMPLE: &str = "1000mm x 5";
const OFFCUT_EXAMPLE: &str = "2x610mm";

impl FromStr for StockItem {
    type Err = StockError;

    fn from_str(text: &str) -> Result<Self, StockError> {
        let (bar, price, count) = match text.split_once('@') {
            Some((bar, price)) => {
                let (price, count) = before_times(price);
                (bar, Some(price), count)
            }
            None => {
                let (bar, count) = before_times(text);
                (bar, None, count)
            }
        };
        let price = price.map(|price| {
            let value = price.trim().parse().ok().filter(|p: &f64| *p > 0.0 && p.is_finite());
            value.ok_or_else(|| StockError::Price(text.trim().into(), price.trim().into()))
        });
        let count = count.map(|n| counted(text, n, STOCK_EXAMPLE)).transpose()?;
        Ok(Self(Offer { price: price.transpose()?, count, ..bar_of(bar)? }))
    }
}

impl FromStr for OffcutItem {
    type Err = StockError;

    fn from_str(text: &str) -> Result<Self, StockError> {
        let (count, bar) = match text.split_once(TIMES) {
            // The unit of a length holds no x, so what comes before one is a count, or the count
            // comes last.
            Some((bar, count)) if bar.contains(char::is_alphabetic) => (Some(count), bar),
            Some((count, bar)) => (Some(count), bar),
            None => (None, text),
        };
        let count = count.map_or(Ok(1), |n| counted(text, n, OFFCUT_EXAMPLE))?;
        let Offer { length, diameter, .. } = bar_of(bar)?;
        Ok(Self(Offer { diameter, ..Offer::offcuts(length, count) }))
    }
}

/// Signs between a length and how many there are.
const TIMES: [char; 3] = ['x', 'X', '×'];

fn before_times(text: &str) -> (&str, Option<&str>) {
    text.split_once(TIMES).map_or((text, None), |(before, count)| (before, Some(count)))
}

fn counted(text: &str, count: &str, example: &'static str) -> Result<usize, StockError> {
    let wrong = || StockError::Count(text.trim().into(), count.trim().into(), example);
    count.trim().parse().ok().filter(|&n| n > 0).ok_or_else(wrong)
}

/// A length, and a diameter after the word `of`.
fn bar_of(text: &str) -> Result<Offer, StockError> {
    let positive = |text: &str, what| match text.trim().parse::<Length>()?.mm() {
        mm if mm > 0.0 => Ok(mm),
        _ => Err(StockError::NotPositive(text.trim().into(), what)),
    };
    let (length, diameter) = match text.split_once(" of ") {
        Some((length, diameter)) => (length, Some(positive(diameter, "diameter")?)),
        None => (text, None),
    };
    Ok(Offer { diameter, ..Offer::plain(positive(length, "length")?) })
}

impl fmt::Display for StockItem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Offer { price, count, .. } = self.0;
        write_bar(f, &self.0)?;
        price.map_or(Ok(()), |price| write!(f, " @ {price}"))?;
        count.map_or(Ok(()), |count| write!(f, " x {count}"))
    }
}

impl fmt::Display for OffcutItem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some(count) = self.0.count.filter(|&n| n != 1) {
            write!(f, "{count}x")?;
        }
        write_bar(f, &self.0)
    }
}

fn write_bar(f: &mut fmt::Formatter, bar: &Offer) -> fmt::Result {
    write!(f, "{}mm", bar.length)?;
    bar.diameter.map_or(Ok(()), |d| write!(f, " of {d}mm"))
}

/// What a design file holds where there is a table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    length: Length,
    price: Option<f64>,
    count: Option<usize>,
    diameter: Option<Length>,
}

impl Table {
    fn text(&self) -> String {
        let diameter = self.diameter.map_or_else(String::new, |d| format!(" of {d}"));
        format!("{}{diameter}", self.length)
    }
}

impl TryFrom<Table> for StockItem {
    type Error = StockError;

    fn try_from(table: Table) -> Result<Self, StockError> {
        let price = table.price.map_or_else(String::new, |p| format!(" @ {p}"));
        let count = table.count.map_or_else(String::new, |n| format!(" x {n}"));
        format!("{}{price}{count}", table.text()).parse()
    }
}

impl TryFrom<Table> for OffcutItem {
    type Error = StockError;

    fn try_from(table: Table) -> Result<Self, StockError> {
        if let Some(price) = table.price {
            return Err(StockError::Price(table.text(), format!("{price} of an offcut")));
        }
        format!("{}x{}", table.count.unwrap_or(1), table.text()).parse()
    }
}

/// Not an untagged enum: its errors would say neither key nor reason.
struct ItemVisitor<T>(std::marker::PhantomData<T>);

impl<'de, T> Visitor<'de> for ItemVisitor<T>
where
    T: FromStr<Err = StockError> + TryFrom<Table, Error = StockError>,
{
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a length such as \"1000mm\", or a table with length, price and count")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_f64<E: Error>(self, mm: f64) -> Result<T, E> {
        format!("{mm}mm").parse().map_err(E::custom)
    }

    fn visit_i64<E: Error>(self, mm: i64) -> Result<T, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
        let table = Table::deserialize(MapAccessDeserializer::new(map))?;
        table.try_into().map_err(A::Error::custom)
    }
}

impl<'de> Deserialize<'de> for StockItem {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ItemVisitor(std::marker::PhantomData))
    }
}

impl<'de> Deserialize<'de> for OffcutItem {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ItemVisitor(std::marker::PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Settings;

    #[test]
    fn bars_are_read_as_they_are_written() {
        for (text, again) in [
            ("1000mm", "1000mm"),
            (" 2m @ 2.10 x 5", "2000mm @ 2.1 x 5"),
            ("2 m@2.10", "2000mm @ 2.1"),
            ("36in x 4", "914.4mm x 4"),
            ("1m of 5mm @ 1.2", "1000mm of 5mm @ 1.2"),
        ] {
            let item: StockItem = text.parse().unwrap();
            assert_eq!(item.to_string(), again);
            assert_eq!(again.parse(), Ok(item));
        }
        for (text, again) in [
            ("430mm", "430mm"),
            ("2x610mm", "2x610mm"),
            ("3 × 61cm", "3x610mm"),
            ("610mm x 2", "2x610mm"),
            ("2x610mm of 5mm", "2x610mm of 5mm"),
        ] {
            let item: OffcutItem = text.parse().unwrap();
            assert_eq!(item.to_string(), again);
            assert!(item.0.at_hand && again.parse() == Ok(item));
        }
    }

    #[test]
    fn what_is_no_bar_is_refused_with_its_text() {
        for (text, word) in [
            ("0mm", "a length must be more than nothing"),
            ("long", "does not start with a number"),
            ("1000mm @ free", "`free` is no price"),
            ("1000mm @ -1", "`-1` is no price"),
            ("1000mm @ 1 x 0", "`0` is no count"),
            ("1000mm x 1.5", "`1.5` is no count"),
            ("1000mm of 0mm", "a diameter must be"),
        ] {
            let message = text.parse::<StockItem>().unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        for text in ["0x610mm", "x610mm", "-2x610mm", "2x", "2x-5mm"] {
            assert!(text.parse::<OffcutItem>().is_err(), "{text}");
        }
    }

    #[test]
    fn files_hold_texts_numbers_and_tables() {
        let text = "stock = [900, '1m @ 1.2', {length = '2m', price = 2.1, count = 5}]\n\
                    offcuts = ['2x430mm', {length = 610, count = 3, diameter = '5mm'}]";
        let settings: Settings = toml::from_str(text).unwrap();
        let stock: Vec<String> = settings.stock.unwrap().iter().map(|s| s.to_string()).collect();
        assert_eq!(stock, ["900mm", "1000mm @ 1.2", "2000mm @ 2.1 x 5"]);
        let old: Vec<String> = settings.offcuts.unwrap().iter().map(|s| s.to_string()).collect();
        assert_eq!(old, ["2x430mm", "3x610mm of 5mm"]);
        for (text, word) in [
            ("stock = [{length = '1m', prize = 2}]", "unknown field `prize`"),
            ("stock = [{price = 2}]", "missing field `length`"),
            ("stock = [{length = '1m', count = 0}]", "`0` is no count"),
            ("offcuts = [{length = '1m', price = 1}]", "is no price"),
            ("stock = [true]", "a table with length, price and count"),
        ] {
            let message = toml::from_str::<Settings>(text).unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
    }
}
