//! What readers of text formats have in common: lines with their numbers, and the
//! error that names one.

use std::borrow::Cow;

/// A line that cannot be read.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("line {line}: {problem}: {text:?}")]
pub struct LineError {
    /// Its number, counted from 1.
    pub line: usize,
    /// What is wrong with it.
    pub problem: String,
    /// The line, shortened.
    pub text: String,
}

/// Characters of a line that a message shows.
const SHOWN: usize = 60;

/// One line of a file.
#[derive(Clone, Debug)]
pub(super) struct Line<'a> {
    /// Its number, counted from 1.
    pub number: usize,
    /// Without its end; what is not UTF-8 replaced.
    pub text: Cow<'a, str>,
}

impl Line<'_> {
    /// Its words, up to a comment if `comment` starts one.
    pub fn words(&self, comment: Option<char>) -> impl Iterator<Item = &str> {
        let end = comment.and_then(|c| self.text.find(c)).unwrap_or(self.text.len());
        self.text[..end].split_whitespace()
    }

    pub fn error(&self, problem: impl Into<String>) -> LineError {
        let text = self.text.trim().chars().take(SHOWN).collect();
        LineError { line: self.number, problem: problem.into(), text }
    }

    /// Three coordinates, the first words of the rest of the line.
    pub fn point<'a>(
        &self,
        words: &mut impl Iterator<Item = &'a str>,
    ) -> Result<[f64; 3], LineError> {
        let mut at = [0.0; 3];
        for c in &mut at {
            let number = words.next().and_then(|w| w.parse().ok());
            *c = number.ok_or_else(|| self.error("a vertex needs three numbers"))?;
        }
        Ok(at)
    }
}

/// Lines of a text, ended by LF, CR LF or CR.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, number: 0 }
    }

    /// What was not taken yet.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// Lines taken so far.
    pub fn taken(&self) -> usize {
        self.number
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let (line, rest) = match end {
            Some(i) if self.rest[i..].starts_with(b"\r\n") => {
                (&self.rest[..i], &self.rest[i + 2..])
            }
            Some(i) => (&self.rest[..i], &self.rest[i + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        self.number += 1;
        Some(Line { number: self.number, text: String::from_utf8_lossy(line) })
    }
}
