//! OFF, the Object File Format of Geomview, as text.
//!
//! A header, the numbers of vertices, faces and edges, then a line for each vertex and
//! a line for each face: the number of its corners, the corners counted from 0, and
//! perhaps a colour. Texture coordinates, colours and normals beside the vertices (ST,
//! C and N in the header) are skipped. The grammar is a page long and no crate in use
//! reads its variants, so it is read here. Left out: the binary form, and points of
//! another dimension (4OFF, nOFF). Figures are taken as mm, z up.

use super::soup::{FaceError, FaceName, LastVertex, Soup};
use super::text::{Line, LineError, Lines};
use crate::surface::Point3;

/// What is wrong with an OFF file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum OffError {
    /// A line that cannot be read.
    #[error(transparent)]
    Line(#[from] LineError),
    /// A kind of OFF that is not read.
    #[error("this is {0}, which is not read")]
    Kind(&'static str),
    /// The file ends too early.
    #[error("the file says that it has {said} {what}, but ends after {found}")]
    Short {
        /// Vertices or faces.
        what: &'static str,
        /// How many the file says it has.
        said: usize,
        /// How many there are.
        found: usize,
    },
    /// A face that does not fit the vertices.
    #[error(transparent)]
    Face(#[from] FaceError),
}

impl OffError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Line(_) => "correct the line, or export the surface again",
            Self::Kind(_) => "export as plain OFF in text, with three coordinates a vertex",
            Self::Short { .. } => "the file is damaged or cut short: export the surface again",
            Self::Face(e) => e.hint(),
        }
    }
}

/// Whether a file starts like OFF, after comments.
pub(super) fn is_off(bytes: &[u8]) -> bool {
    Lines::new(bytes)
        .take(MOST_COMMENTS)
        .find_map(|l| l.words(Some('#')).next().map(|word| header(word).is_some()))
        .unwrap_or(false)
}

/// Lines looked at for the header word, so that a large foreign file is told quickly.
const MOST_COMMENTS: usize = 200;

/// The letters before OFF and what is stuck to its end.
fn header(word: &str) -> Option<(&str, &str)> {
    let (kind, rest) = word.split_once("OFF")?;
    let mut left = kind;
    for flag in ["ST", "C", "N", "4", "n"] {
        left = left.strip_prefix(flag).unwrap_or(left);
    }
    // Some sets of models leave out the line end after the header.
    let fits = left.is_empty() && rest.bytes().all(|b| b.is_ascii_digit());
    fits.then_some((kind, rest))
}

/// Vertices and faces.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, OffError> {
    let mut lines = Lines::new(bytes).filter(|l| l.words(Some('#')).next().is_some());
    let [vertices, faces] = counts(&mut lines)?;
    let mut soup = Soup::default();
    for line in lines.by_ref().take(vertices) {
        let mut words = line.words(Some('#'));
        soup.points.push(Point3::from(line.point(&mut words)?));
    }
    let found = soup.points.len();
    if found < vertices {
        return Err(OffError::Short { what: "vertices", said: vertices, found });
    }
    for line in lines.by_ref().take(faces) {
        let corners = face(&line, vertices)?;
        soup.push(corners, Some(line.number));
    }
    let found = soup.face_count();
    if found < faces {
        return Err(OffError::Short { what: "faces", said: faces, found });
    }
    match lines.next() {
        Some(line) => Err(line.error("more lines than vertices and faces").into()),
        None => Ok(soup),
    }
}

/// The numbers of vertices and faces, on the header's line or the next.
fn counts<'a>(lines: &mut impl Iterator<Item = Line<'a>>) -> Result<[usize; 2], OffError> {
    let missing = OffError::Short { what: "numbers in its header", said: 3, found: 0 };
    let first = lines.next().ok_or(missing.clone())?;
    let mut words = first.words(Some('#')).peekable();
    let word = words.next().unwrap_or_default();
    let (kind, stuck) = header(word).ok_or_else(|| first.error("no OFF header"))?;
    if kind.contains('4') {
        return Err(OffError::Kind("an OFF file with four coordinates a vertex (4OFF)"));
    }
    if kind.contains('n') {
        return Err(OffError::Kind("an OFF file of another dimension (nOFF)"));
    }
    if words.peek() == Some(&"BINARY") {
        return Err(OffError::Kind("a binary OFF file"));
    }
    let parse = |line: &Line, words: Vec<&str>| {
        let wrong = || line.error("the numbers of vertices and faces are needed");
        match words[..] {
            [v, f] | [v, f, _] => match (v.parse(), f.parse()) {
                (Ok(v), Ok(f)) => Ok([v, f]),
                _ => Err(wrong().into()),
            },
            _ => Err(wrong().into()),
        }
    };
    let here: Vec<&str> = Some(stuck).filter(|s| !s.is_empty()).into_iter().chain(words).collect();
    if !here.is_empty() {
        return parse(&first, here);
    }
    let second = lines.next().ok_or(missing)?;
    parse(&second, second.words(Some('#')).collect())
}

fn face(line: &Line, vertices: usize) -> Result<Vec<u32>, OffError> {
    let mut words = line.words(Some('#'));
    let needed = || line.error("a face needs the number of its corners, then the corners");
    let count: usize = words.next().and_then(|w| w.parse().ok()).ok_or_else(needed)?;
    let mut corners = Vec::new();
    for word in words.take(count) {
        let index: i128 = word.parse().map_err(|_| needed())?;
        let Some(index) = u32::try_from(index).ok().filter(|i| (*i as usize) < vertices) else {
            let (face, vertex) = (FaceName::Line(line.number), word.to_owned());
            let end = LastVertex { vertices, from: 0 };
            return Err(FaceError::VertexOutOfRange { face, vertex, end }.into());
        };
        corners.push(index);
    }
    if corners.len() < count {
        let found = corners.len();
        let problem = format!("the face says that it has {count} corners, but names {found}");
        return Err(line.error(problem).into());
    }
    Ok(corners)
}
