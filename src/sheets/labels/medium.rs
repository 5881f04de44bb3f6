//! What rod labels are printed on: sheets of labels as they are sold, or strips cut from
//! plain paper.
//!
//! Sizes are those of the layouts that vendors publish for word processors, as they stand in
//! the label lists of LibreOffice and gLabels, moved to the middle of the sheet where they
//! are rounded (by 0.1 mm at most). L7160 and 5160 have pitches in inches, 2.6 × 1.5 and
//! 2 3/4 × 1; L7651 1.6 × 5/6 in, L8658 1.1 in × 10 mm. Lists differ by less than a
//! millimetre: some round the pitch of L7651 to 21.2 mm a row, or put the columns of 5160
//! 2 25/32 in apart. [`SAFE`](super::SAFE) allows for that.

use crate::drawing::Rect;
use crate::sheets::Paper;
use crate::units::MM_PER_INCH;
use serde::{Deserialize, Deserializer, Serialize, de};

/// What rod labels are printed on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, clap::ValueEnum)]
pub enum LabelMedium {
    /// Plain paper with lines to cut along
    #[default]
    #[serde(rename = "strips")]
    Strips,
    /// Avery L7160, A4, 3 × 7 labels of 63.5 × 38.1 mm
    #[serde(rename = "l7160")]
    L7160,
    /// Avery L7651, A4, 5 × 13 labels of 38.1 × 21.2 mm
    #[serde(rename = "l7651")]
    L7651,
    /// Avery L8658, A4, 7 × 27 labels of 25.4 × 10 mm
    #[serde(rename = "l8658")]
    L8658,
    /// Avery 5160, Letter, 3 × 10 labels of 2 5/8 × 1 in
    #[serde(rename = "5160")]
    #[value(name = "5160")]
    Avery5160,
    /// Avery 5167, Letter, 4 × 20 labels of 1 3/4 × 1/2 in
    #[serde(rename = "5167")]
    #[value(name = "5167")]
    Avery5167,
}

/// Labels in columns and rows on a sheet. Lengths in mm, from the sheet's top left corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LabelGrid {
    /// The sheet.
    pub paper: Paper,
    /// Columns and rows.
    pub count: [usize; 2],
    /// Width and height of a label.
    pub size: [f64; 2],
    /// Top left corner of the first label.
    pub origin: [f64; 2],
    /// From a label to the next one to its right, and to the next one below it.
    pub pitch: [f64; 2],
}

impl LabelMedium {
    /// The layout of the sheet; none for strips, which come on any paper.
    pub fn grid(self) -> Option<LabelGrid> {
        let (paper, count, size, origin, pitch) = match self {
            Self::Strips => return None,
            Self::L7160 => (Paper::A4, [3, 7], [63.5, 38.1], [7.21, 15.15], [66.04, 38.1]),
            // The rows are 21.17 mm apart; the label is sold as one of 21.2 mm.
            Self::L7651 => (Paper::A4, [5, 13], [38.1, 21.17], [4.67, 10.895], [40.64, 21.17]),
            Self::L8658 => (Paper::A4, [7, 27], [25.4, 10.0], [8.48, 13.5], [27.94, 10.0]),
            Self::Avery5160 => (
                Paper::Letter,
                [3, 10],
                inches([2.625, 1.0]),
                inches([0.1875, 0.5]),
                inches([2.75, 1.0]),
            ),
            Self::Avery5167 => (
                Paper::Letter,
                [4, 20],
                inches([1.75, 0.5]),
                inches([0.28125, 0.5]),
                inches([2.0625, 0.5]),
            ),
        };
        Some(LabelGrid { paper, count, size, origin, pitch })
    }
}

fn inches(lengths: [f64; 2]) -> [f64; 2] {
    lengths.map(|length| length * MM_PER_INCH)
}

impl LabelGrid {
    /// How many labels are on a sheet.
    pub fn labels(&self) -> usize {
        self.count[0] * self.count[1]
    }

    /// A label, counted from 0 along the rows.
    pub fn rect(&self, index: usize) -> Rect {
        let place = [index % self.count[0], index / self.count[0]];
        let corner = [0, 1].map(|i| self.origin[i] + place[i] as f64 * self.pitch[i]);
        Rect::new(corner, self.size)
    }
}

/// A name, in capitals or not; TOML may have `5160` as a number.
impl<'de> Deserialize<'de> for LabelMedium {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Given {
            Text(String),
            Number(i64),
        }
        let name = match Given::deserialize(deserializer)? {
            Given::Text(text) => text,
            Given::Number(number) => number.to_string(),
        };
        let known = <Self as clap::ValueEnum>::from_str(&name, true);
        known.map_err(|_| {
            let names = <Self as clap::ValueEnum>::value_variants().iter();
            let names: Vec<String> = names
                .filter_map(clap::ValueEnum::to_possible_value)
                .map(|value| value.get_name().to_owned())
                .collect();
            de::Error::custom(format!("no labels are named `{name}`, only {}", names.join(", ")))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;

    /// Layouts are rounded to 0.01 mm.
    const ROUNDED: f64 = 0.011;

    #[test]
    fn every_grid_stands_in_the_middle_of_its_sheet_and_labels_are_apart() {
        let mut labels = Vec::new();
        for medium in LabelMedium::value_variants() {
            let Some(grid) = medium.grid() else { continue };
            labels.push(grid.labels());
            let (first, last) = (grid.rect(0), grid.rect(grid.labels() - 1));
            let sheet = grid.paper.size();
            for (i, side) in sheet.into_iter().enumerate() {
                let ends = [first.min[i], side - last.max[i]];
                assert!((ends[0] - ends[1]).abs() <= 2.0 * ROUNDED, "{medium:?}: {ends:?}");
                assert!(ends[0] > 4.0 && grid.size[i] <= grid.pitch[i], "{medium:?}");
            }
        }
        assert_eq!(labels, [21, 65, 189, 30, 80]);
    }

    #[test]
    fn sizes_are_those_on_the_package() {
        for (medium, size) in [
            (LabelMedium::L7160, [63.5, 38.1]),
            (LabelMedium::L7651, [38.1, 21.2]),
            (LabelMedium::L8658, [25.4, 10.0]),
            (LabelMedium::Avery5160, [66.675, 25.4]),
            (LabelMedium::Avery5167, [44.45, 12.7]),
        ] {
            let found = medium.grid().unwrap().size;
            assert!((0..2).all(|i| (found[i] - size[i]).abs() < 0.05), "{medium:?}: {found:?}");
        }
        let last = LabelMedium::L7160.grid().unwrap().rect(20);
        assert!((last.min[0] - (7.21 + 2.0 * 66.04)).abs() < 1e-9);
        assert!((last.min[1] - (15.15 + 6.0 * 38.1)).abs() < 1e-9);
    }

    #[test]
    fn names_are_read_in_any_case_and_as_numbers() {
        #[derive(Deserialize)]
        struct File {
            labels: LabelMedium,
        }
        let read = |text: &str| toml::from_str::<File>(text).map(|file| file.labels);
        assert_eq!(read("labels = \"L7160\"").unwrap(), LabelMedium::L7160);
        assert_eq!(read("labels = 5167").unwrap(), LabelMedium::Avery5167);
        let message = read("labels = \"7160\"").unwrap_err().to_string();
        assert!(message.contains("strips, l7160, l7651, l8658, 5160, 5167"), "{message}");
    }
}
