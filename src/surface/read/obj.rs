//! Wavefront OBJ: vertices and faces of all objects and groups, through `tobj`.
//!
//! The text is thinned before it is handed over: only `v` and `f` lines stay, with the
//! first number of each corner and without colours; continued lines are joined. That
//! keeps what the library would trip over away from it: names that are not UTF-8,
//! polylines (it takes `l` for faces), texture indices out of range (its arithmetic
//! overflows), and groups (it starts numbering anew in each). A point element after
//! each vertex makes it keep all vertices in the order of the file, so that numbers in
//! messages are those of the file. Materials are not read.

use super::soup::{FaceError, FaceName, LastVertex, Soup};
use super::text::LineError;
use crate::surface::Point3;
use std::cell::Cell;
use std::fmt::Write as _;
use std::io::{BufRead, Read};

/// What is wrong with an OBJ file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ObjError {
    /// A line that cannot be read.
    #[error(transparent)]
    Line(#[from] LineError),
    /// A face that does not fit the vertices.
    #[error(transparent)]
    Face(#[from] FaceError),
}

impl ObjError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Line(_) => "correct the line, or export the surface again",
            Self::Face(e) => e.hint(),
        }
    }
}

/// Vertices and faces of all objects and groups, in the order of the file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, ObjError> {
    let thin = Thin::new(bytes);
    let taken = Cell::new(0);
    let mut reader = Counted { rest: thin.text.as_bytes(), taken: &taken };
    let options = tobj::LoadOptions::default();
    let loaded = tobj::load_obj_buf(&mut reader, &options, |_| Ok(Default::default()));
    let models = match loaded {
        Ok((models, _)) => models,
        Err(tobj::LoadError::FaceVertexOutOfBounds) => return Err(thin.out_of_range()),
        Err(e) => return Err(thin.line_error(taken.get(), e)),
    };
    let mesh = models.into_iter().next().map(|m| m.mesh).unwrap_or_default();
    Ok(build(&mesh, &thin))
}

/// The lines of a file that matter here.
struct Thin {
    text: String,
    /// The number in the file of each line of `text`, counted from 1.
    numbers: Vec<usize>,
    vertices: usize,
}

impl Thin {
    fn new(bytes: &[u8]) -> Self {
        let mut thin = Self { text: String::new(), numbers: Vec::new(), vertices: 0 };
        let mut joined = String::new();
        for (at, line) in bytes.split(|b| *b == b'\n').enumerate() {
            let line = String::from_utf8_lossy(line);
            let line = line.trim_end();
            if let Some(start) = line.strip_suffix('\\') {
                joined += start;
                joined.push(' ');
                continue;
            }
            joined += line;
            thin.keep(&joined, at + 1);
            joined.clear();
        }
        thin.keep(&joined, bytes.split(|b| *b == b'\n').count());
        thin
    }

    fn keep(&mut self, line: &str, number: usize) {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let words: Vec<&str> = words.collect();
                // Three coordinates, perhaps a weight; six or seven numbers end in a colour.
                let kept = if words.len() >= 6 { 3 } else { words.len().min(5) };
                self.push(format_args!("v {}", words[..kept].join(" ")), number);
                self.push(format_args!("f -1"), number);
                self.vertices += 1;
            }
            Some("f") => {
                let corners: Vec<&str> = words.map(|w| w.split('/').next().unwrap_or(w)).collect();
                self.push(format_args!("f {}", corners.join(" ")), number);
            }
            _ => {}
        }
    }

    fn push(&mut self, line: std::fmt::Arguments, number: usize) {
        writeln!(self.text, "{line}").expect("writing to a string does not fail");
        self.numbers.push(number);
    }

    /// The error for the line last taken by the library.
    fn line_error(&self, taken: usize, error: tobj::LoadError) -> ObjError {
        let at = taken.saturating_sub(1);
        let problem = match error {
            tobj::LoadError::PositionParseError => "a vertex needs three numbers",
            tobj::LoadError::ColorParseError => "a vertex has three numbers, or four, or six",
            tobj::LoadError::ScalingByZeroError => "the weight of a vertex must not be 0",
            tobj::LoadError::FaceParseError => "a face needs whole numbers",
            _ => "cannot be read",
        };
        let text = self.text.lines().nth(at).unwrap_or_default().chars().take(60).collect();
        LineError { line: self.number(at), problem: problem.into(), text }.into()
    }

    /// The first face that uses a vertex that is not there.
    fn out_of_range(&self) -> ObjError {
        let mut seen = 0;
        for (at, line) in self.text.lines().enumerate() {
            seen += i64::from(line.starts_with('v'));
            let words = line.strip_prefix("f ").unwrap_or_default().split(' ');
            for (word, index) in words.filter_map(|w| Some((w, w.parse::<i64>().ok()?))) {
                let index = if index < 0 { seen.saturating_add(index) + 1 } else { index };
                if !(1..=self.vertices as i64).contains(&index) {
                    let (face, vertex) = (FaceName::Line(self.number(at)), word.to_owned());
                    let end = LastVertex { vertices: self.vertices, from: 1 };
                    return FaceError::VertexOutOfRange { face, vertex, end }.into();
                }
            }
        }
        FaceError::NoFaces { vertices: self.vertices }.into()
    }

    fn number(&self, at: usize) -> usize {
        self.numbers.get(at).copied().unwrap_or_default()
    }
}

/// Hands out text and counts the lines taken, to find the one that cannot be read.
struct Counted<'a> {
    rest: &'a [u8],
    taken: &'a Cell<usize>,
}

impl Read for Counted<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.rest.read(buffer)
    }
}

impl BufRead for Counted<'_> {
    /// One line at a time.
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        let end = self.rest.iter().position(|b| *b == b'\n').map_or(self.rest.len(), |i| i + 1);
        Ok(&self.rest[..end])
    }

    fn consume(&mut self, amount: usize) {
        let (taken, rest) = self.rest.split_at(amount.min(self.rest.len()));
        self.taken.set(self.taken.get() + taken.iter().filter(|b| **b == b'\n').count());
        self.rest = rest;
    }
}

fn build(loaded: &tobj::Mesh, thin: &Thin) -> Soup {
    let mut soup = Soup::default();
    soup.count_from = 1;
    let points = loaded.positions.chunks_exact(3);
    soup.points = points.map(|c| Point3::new(c[0], c[1], c[2])).collect();
    // Without arities all faces are triangles; then there are no point elements either.
    let mut faces = loaded.indices.as_slice();
    let lines = thin.text.lines().zip(&thin.numbers).filter(|(l, _)| l.starts_with('f'));
    for (&arity, (_, &line)) in loaded.face_arities.iter().zip(lines) {
        let Some((face, rest)) = faces.split_at_checked(arity as usize) else { break };
        faces = rest;
        if face.len() > 1 {
            soup.push(face.iter().copied(), Some(line));
        }
    }
    soup
}
