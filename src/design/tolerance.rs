//! How exact marks and sticks are, as given: `marks 0.5mm, diameter 0.1mm` on the command line,
//! and a table in a design file.

use crate::units::Length;
use serde::Deserialize;
use std::str::FromStr;

/// Errors of marks and diameters, ± two standard deviations; what is not given is exact.
#[derive(Clone, Copy, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToleranceSetting {
    /// Of every mark.
    pub marks: Option<Length>,
    /// Of the diameter of every stick.
    pub diameter: Option<Length>,
}

impl FromStr for ToleranceSetting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut setting = Self::default();
        for part in text.split(',').map(str::trim) {
            let (name, length) = part.split_once(char::is_whitespace).unwrap_or((part, ""));
            let field = match name {
                "marks" => &mut setting.marks,
                "diameter" => &mut setting.diameter,
                _ => return Err(format!("`{part}` is none of `marks 0.5mm`, `diameter 0.1mm`")),
            };
            let length = length.trim().parse::<Length>().map_err(|e| format!("{name}: {e}"))?;
            if field.replace(length).is_some() {
                return Err(format!("{name} is given twice"));
            }
        }
        Ok(setting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Settings;

    fn mm(setting: ToleranceSetting) -> [Option<f64>; 2] {
        [setting.marks, setting.diameter].map(|l| l.map(Length::mm))
    }

    #[test]
    fn text_and_table_are_read() {
        for (text, both) in [
            ("marks 0.5mm, diameter 0.1mm", [Some(0.5), Some(0.1)]),
            ("diameter 0.1 ,marks 0.05cm", [Some(0.5), Some(0.1)]),
            ("marks 0.5", [Some(0.5), None]),
        ] {
            assert_eq!(mm(text.parse().unwrap()), both, "{text}");
        }
        let file = "tolerance = { marks = '0.5mm', diameter = 0.1 }";
        let settings: Settings = toml::from_str(file).unwrap();
        assert_eq!(settings.tolerance.map(mm), Some([Some(0.5), Some(0.1)]));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [
            ("", "`` is none of"),
            ("0.5mm", "`0.5mm` is none of"),
            ("marks", "marks: "),
            ("marks 1, marks 2", "given twice"),
            ("marks 1 furlong", "furlong"),
        ] {
            let message = text.parse::<ToleranceSetting>().unwrap_err();
            assert!(message.contains(word), "{text}: {message}");
        }
        assert!(toml::from_str::<Settings>("tolerance = { gaps = 1 }").is_err());
    }
}
