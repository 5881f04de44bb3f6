//! The bricks of a DXF file: pairs of a group code and a value, a line each, and handles.

use std::fmt::Display;

/// Handles up to this one are given to the fixed parts of the file.
const LAST_FIXED: u32 = 0x1F;

/// A file as it grows.
pub(super) struct Writer {
    text: String,
    next: u32,
}

impl Default for Writer {
    fn default() -> Self {
        Self { text: String::new(), next: LAST_FIXED + 1 }
    }
}

impl Writer {
    /// What was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The first handle that is still free.
    pub fn next_handle(&self) -> u32 {
        self.next
    }

    /// A group code and its value.
    pub fn pair(&mut self, code: u16, value: impl Display) {
        self.text.push_str(&format!("{code:>3}\n{value}\n"));
    }

    /// A number with a decimal point.
    pub fn real(&mut self, code: u16, x: f64) {
        self.pair(code, number(x));
    }

    /// A point: x at `code`, y and z at 10 and 20 more.
    pub fn point(&mut self, code: u16, p: [f64; 3]) {
        for (step, x) in [0, 10, 20].into_iter().zip(p) {
            self.real(code + step, x);
        }
    }

    /// The next free handle as that of what is being written.
    pub fn new_handle(&mut self) {
        self.new_handle_at(5);
    }

    /// The same where the handle has another group code.
    pub fn new_handle_at(&mut self, code: u16) {
        self.handle(code, self.next);
        self.next += 1;
    }

    /// A handle: hexadecimal.
    pub fn handle(&mut self, code: u16, handle: u32) {
        self.pair(code, format_args!("{handle:X}"));
    }

    /// Whose part the following is.
    pub fn owner(&mut self, handle: u32) {
        self.handle(330, handle);
    }

    /// Opens a section.
    pub fn section(&mut self, name: &str) {
        self.pair(0, "SECTION");
        self.pair(2, name);
    }

    /// Closes it.
    pub fn end_section(&mut self) {
        self.pair(0, "ENDSEC");
    }
}

/// At most six decimals, at least one, never an exponent, never `-0.0`. The sixth decimal
/// is a nanometre: finer than what CAD programs take for one point.
fn number(x: f64) -> String {
    let long = format!("{x:.6}");
    let short = long.trim_end_matches('0');
    let keep = if short.ends_with('.') { short.len() + 1 } else { short.len() };
    match &long[..keep] {
        "-0.0" => "0.0".to_owned(),
        kept => kept.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_plain() {
        let shown: Vec<_> = [0.0, -1e-9, 12.5, -100.0, 1.0 / 3.0, 1e7, 1e-5].map(number).into();
        let expected = ["0.0", "0.0", "12.5", "-100.0", "0.333333", "10000000.0", "0.00001"];
        assert_eq!(shown, expected);
    }
}
