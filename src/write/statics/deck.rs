//! Lines and numbers of decks.

/// The most characters of a number that is written in full: CalculiX reads 20 of each.
const WIDTH: usize = 16;

/// Adds a line.
pub(super) fn line(text: &mut String, what: impl AsRef<str>) {
    text.push_str(what.as_ref());
    text.push('\n');
}

/// A number in full where it is short, else with 13 digits.
pub(super) fn number(x: f64) -> String {
    let short = x.to_string();
    if short.len() <= WIDTH { short } else { format!("{x:.12e}") }
}
