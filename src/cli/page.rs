//! Text for people to read: lines under headings.

use super::terminal::Terminal;
use std::fmt::{Display, Write as _};

/// Columns that every terminal has.
const WIDTH: usize = 80;

/// Lines of text under a heading.
pub struct Page<'a> {
    pub text: String,
    terminal: &'a Terminal,
}

impl<'a> Page<'a> {
    pub fn new(terminal: &'a Terminal) -> Self {
        Self { text: String::new(), terminal }
    }

    pub fn head(&mut self, title: &str) {
        let title = self.terminal.bold(title);
        writeln!(self.text, "{title}").expect("writing to a string cannot fail");
    }

    pub fn row(&mut self, label: &str, value: impl Display) {
        writeln!(self.text, "  {label:<14} {value}").expect("writing to a string cannot fail");
    }

    pub fn line(&mut self, line: impl Display) {
        writeln!(self.text, "  {line}").expect("writing to a string cannot fail");
    }

    /// Text behind a beginning of a line, broken between words; further lines start below
    /// the text.
    pub fn broken(&mut self, start: &str, text: &str) {
        let indent = start.chars().count();
        let mut column = indent;
        self.text.push_str(start);
        for word in text.split_whitespace() {
            let width = word.chars().count();
            if column > indent && column + 1 + width > WIDTH {
                write!(self.text, "\n{:indent$}", "").expect("writing to a string cannot fail");
                column = indent;
            } else if column > indent {
                self.text.push(' ');
                column += 1;
            }
            self.text.push_str(word);
            column += width;
        }
        self.text.truncate(self.text.trim_end().len());
        self.text.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_broken_between_words() {
        let terminal = Terminal::new(clap::ColorChoice::Never);
        let mut page = Page::new(&terminal);
        let start = format!("{:<60}", "squares");
        page.broken(&start, "four rods a unit, the plainest grid");
        page.broken("none  ", "");
        page.broken("", &"x".repeat(99));
        let lines: Vec<&str> = page.text.lines().collect();
        assert_eq!(lines[0], format!("{start}four rods a unit,"));
        assert_eq!(lines[1], format!("{:60}the plainest grid", ""));
        assert_eq!((lines[2], lines[3].len(), lines.len()), ("none", 99, 4));
    }
}
