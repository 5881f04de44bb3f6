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

/// A number with all its digits: the stiffness of a notch stands in a matrix beside one that is
/// ten thousand times as large, of which it is the difference.
pub(super) fn exact(x: f64) -> String {
    let short = x.to_string();
    if short.len() <= WIDTH { short } else { format!("{x:e}") }
}
