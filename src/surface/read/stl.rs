//! STL, binary and text.
//!
//! Binary: 80 bytes of anything, the number of facets, 50 bytes for each. Whether a
//! file is binary follows from its length, since some begin with `solid` like text.
//! Text: `facet`, `outer loop`, three `vertex` lines, `endloop`, `endfacet`; any number
//! of solids, capitals or not. A missing `endsolid` is allowed; a text that ends within
//! a facet is not. Normals are not read: they follow from the corners. The format is so
//! small that it is read here: common readers tell the forms apart by the first word.
//! Figures are taken as mm, z up. The mender joins the corners of neighbours.

use super::soup::{FaceName, Soup};
use super::text::{Line, LineError, Lines};
use crate::surface::Point3;

/// What is wrong with an STL file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum StlError {
    /// A line that cannot be read.
    #[error(transparent)]
    Line(#[from] LineError),
    /// The text ends within a facet.
    #[error("the text ends after line {line}, within the facet that starts on line {facet}")]
    CutFacet {
        /// The last line.
        line: usize,
        /// The line of the facet.
        facet: usize,
    },
    /// The number of facets does not fit the length of the file.
    #[error(
        "the file says that it has {facets} facets, which take {said} bytes, but there are {found}"
    )]
    Length {
        /// How many facets it says it has.
        facets: u32,
        /// Bytes that they take, with the header.
        said: u64,
        /// Bytes that there are.
        found: usize,
    },
    /// The header is not complete.
    #[error("the file ends within its header: {found} bytes of {HEADER}")]
    Header {
        /// Bytes that there are.
        found: usize,
    },
    /// A coordinate is not a finite number.
    #[error("{facet}: a corner is at ({}, {}, {}), which is not a place", .at[0], .at[1], .at[2])]
    NotFinite {
        /// The facet.
        facet: FaceName,
        /// The corner's coordinates.
        at: [f64; 3],
    },
    /// No facets.
    #[error("the file has no facets")]
    NoFacets,
}

impl StlError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Line(_) => "correct the line, or export the surface again",
            Self::NoFacets => "export the surface as a mesh, with its faces",
            _ => "the file is damaged or cut short: export the surface again",
        }
    }
}

/// Bytes of a binary file before the first facet.
const HEADER: usize = 84;

/// Bytes of a facet: a normal, three corners, two bytes of anything.
const FACET: usize = 50;

/// Where in a facet the corners start, after the normal.
const CORNERS: usize = 12;

/// The number of facets that a binary file says it has, and the length that takes.
fn said(bytes: &[u8]) -> Option<(u32, u64)> {
    let count = bytes.get(HEADER - 4..HEADER)?.try_into().ok().map(u32::from_le_bytes)?;
    Some((count, HEADER as u64 + FACET as u64 * u64::from(count)))
}

/// Whether the length fits the binary form.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    said(bytes).is_some_and(|(_, length)| length == bytes.len() as u64)
}

/// Whether a file that is neither text nor of a fitting length still looks like the
/// binary form: its first 80 bytes are a line of text filled up with zeros or spaces.
pub(super) fn is_damaged_binary(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(HEADER - 4)];
    let plain = |b: &u8| matches!(b, 0 | b' '..=b'~' | b'\n' | b'\r' | b'\t');
    bytes.len() > HEADER && bytes.contains(&0) && start.iter().all(plain)
}

/// Whether a file starts like the text form.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    let word = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    word.eq_ignore_ascii_case(b"solid") && !bytes.contains(&0)
}

/// Reads the binary form.
pub(super) fn read_binary(bytes: &[u8]) -> Result<Soup, StlError> {
    let (facets, length) = said(bytes).ok_or(StlError::Header { found: bytes.len() })?;
    if length != bytes.len() as u64 {
        return Err(StlError::Length { facets, said: length, found: bytes.len() });
    }
    let mut builder = Builder::default();
    for (i, facet) in bytes[HEADER..].chunks_exact(FACET).enumerate() {
        let number = |b: &[u8]| b.try_into().map_or(f64::NAN, |b| f64::from(f32::from_le_bytes(b)));
        for corner in facet[CORNERS..CORNERS + 36].chunks_exact(12) {
            let at = [&corner[..4], &corner[4..8], &corner[8..]].map(number);
            builder.corner(at, FaceName::Face(i + 1))?;
        }
        builder.close(None);
    }
    builder.finish()
}

/// Reads the text form.
pub(super) fn read_text(bytes: &[u8]) -> Result<Soup, StlError> {
    let mut builder = Builder::default();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next() {
        match first_word(&line).as_str() {
            "" | "solid" | "endsolid" => {}
            "facet" => read_facet(line.number, &mut lines, &mut builder)?,
            _ => return Err(line.error("a facet or the end of the solid is needed").into()),
        }
    }
    builder.finish()
}

fn first_word(line: &Line) -> String {
    line.words(None).next().unwrap_or_default().to_ascii_lowercase()
}

fn read_facet(facet: usize, lines: &mut Lines, builder: &mut Builder) -> Result<(), StlError> {
    for wanted in ["outer", "vertex", "vertex", "vertex", "endloop", "endfacet"] {
        let line = lines
            .find(|l| !first_word(l).is_empty())
            .ok_or(StlError::CutFacet { line: lines.taken(), facet })?;
        if first_word(&line) != wanted {
            return Err(line.error(format!("{wanted:?} is needed here")).into());
        }
        if wanted == "vertex" {
            let mut numbers = line.words(None).skip(1);
            let at = line.point(&mut numbers)?;
            builder.corner(at, FaceName::Line(line.number))?;
        }
    }
    builder.close(Some(facet));
    Ok(())
}

/// Gathers facets of three corners each.
#[derive(Default)]
struct Builder {
    soup: Soup,
}

impl Builder {
    fn corner(&mut self, at: [f64; 3], facet: FaceName) -> Result<(), StlError> {
        if !at.iter().all(|c| c.is_finite()) {
            return Err(StlError::NotFinite { facet, at });
        }
        self.soup.points.push(Point3::from(at));
        Ok(())
    }

    fn close(&mut self, line: Option<usize>) {
        // Memory ends before there are 2^32 corners of 24 bytes and more each.
        let end = self.soup.points.len() as u32;
        self.soup.push(end - 3..end, line);
    }

    fn finish(self) -> Result<Soup, StlError> {
        if self.soup.face_count() == 0 { Err(StlError::NoFacets) } else { Ok(self.soup) }
    }
}
