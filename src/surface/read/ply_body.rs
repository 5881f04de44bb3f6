//! The body of a PLY file: elements one after the other, as the header declares them.
//!
//! No number of the file is trusted: before anything is skipped or taken, the bytes or
//! words that it needs must be there.

use super::ply::{Element, Kind, PlyError, Scalar, Use};
use super::soup::{FaceError, FaceName, LastVertex, Soup};
use super::text::{Line, Lines};
use crate::surface::Point3;

/// Puts vertices and corners into the soup.
struct Taker {
    soup: Soup,
    /// How many vertices the header declares.
    vertices: u64,
    corners: Vec<u32>,
    at: [f64; 3],
}

impl Taker {
    fn new(vertices: u64) -> Self {
        Self { soup: Soup::default(), vertices, corners: Vec::new(), at: [0.0; 3] }
    }

    fn corner(&mut self, index: i64, line: Option<usize>) -> Result<(), PlyError> {
        let inside = u64::try_from(index).is_ok_and(|i| i < self.vertices);
        match u32::try_from(index) {
            Ok(index) if inside => {
                self.corners.push(index);
                Ok(())
            }
            _ => {
                let number = FaceName::Face(self.soup.face_count() + 1);
                let face = line.map_or(number, FaceName::Line);
                let vertices = usize::try_from(self.vertices).unwrap_or(usize::MAX);
                let end = LastVertex { vertices, from: 0 };
                Err(FaceError::VertexOutOfRange { face, vertex: index.to_string(), end }.into())
            }
        }
    }

    /// Ends one element: a vertex or a face, if it is one.
    fn close(&mut self, element: &Element, line: Option<usize>) {
        let has = |purpose| element.properties.iter().any(|p| p.purpose == purpose);
        if has(Use::Coordinate(0)) {
            self.soup.points.push(Point3::from(self.at));
        } else if has(Use::Corners) {
            self.soup.push(self.corners.drain(..), line);
        }
    }
}

/// Reads elements of a line each.
pub(super) fn read_text(
    lines: Lines,
    elements: &[Element],
    vertices: u64,
) -> Result<Soup, PlyError> {
    let mut lines = lines.filter(|l| l.words(None).next().is_some());
    let mut taker = Taker::new(vertices);
    for element in elements.iter().filter(|e| !e.properties.is_empty()) {
        for i in 0..element.count {
            let short = || short(element, i);
            let line = lines.next().ok_or_else(short)?;
            take_line(&line, element, &mut taker)?;
            taker.close(element, Some(line.number));
        }
    }
    match lines.next() {
        Some(line) => Err(line.error("more lines than the header declares").into()),
        None => Ok(taker.soup),
    }
}

fn short(element: &Element, i: u64) -> PlyError {
    PlyError::Short { element: element.name.clone(), said: element.count, at: i + 1 }
}

fn take_line(line: &Line, element: &Element, taker: &mut Taker) -> Result<(), PlyError> {
    let mut words = line.words(None);
    let few = || line.error(format!("too few numbers for element {}", element.name));
    let whole = |word: &str| {
        word.parse::<i64>().map_err(|_| line.error(format!("{word:?} is not a whole number")))
    };
    for property in &element.properties {
        match (property.kind, property.purpose) {
            (Kind::One(_), Use::Coordinate(k)) => {
                let word = words.next().ok_or_else(few)?;
                let number = word.parse().ok();
                taker.at[k] = number.ok_or_else(|| line.error("a vertex needs three numbers"))?;
            }
            (Kind::One(_), _) => _ = words.next().ok_or_else(few)?,
            (Kind::List { .. }, purpose) => {
                let length = whole(words.next().ok_or_else(few)?)?;
                let length = u64::try_from(length)
                    .map_err(|_| line.error("the length of a list is not negative"))?;
                for _ in 0..length {
                    let word = words.next().ok_or_else(few)?;
                    if purpose == Use::Corners {
                        taker.corner(whole(word)?, Some(line.number))?;
                    }
                }
            }
        }
    }
    match words.next() {
        Some(_) => Err(line.error(format!("too many numbers for element {}", element.name)).into()),
        None => Ok(()),
    }
}

/// Reads elements of bytes.
pub(super) fn read_binary(
    bytes: &[u8],
    elements: &[Element],
    vertices: u64,
    little: bool,
) -> Result<Soup, PlyError> {
    let mut bytes = Bytes { rest: bytes, little };
    let mut taker = Taker::new(vertices);
    for element in elements.iter().filter(|e| !e.properties.is_empty()) {
        // Each takes at least a byte, so the file's own length ends this loop.
        for i in 0..element.count {
            take_bytes(&mut bytes, element, i, &mut taker)?;
            taker.close(element, None);
        }
    }
    // Some programs end the file with a line end.
    let left = bytes.rest.trim_ascii().len();
    if left > 0 { Err(PlyError::LeftOver { bytes: left }) } else { Ok(taker.soup) }
}

fn take_bytes(
    bytes: &mut Bytes,
    element: &Element,
    i: u64,
    taker: &mut Taker,
) -> Result<(), PlyError> {
    let short = || short(element, i);
    for property in &element.properties {
        match (property.kind, property.purpose) {
            (Kind::One(scalar), Use::Coordinate(k)) => {
                taker.at[k] = bytes.number(scalar).ok_or_else(short)?;
            }
            (Kind::One(scalar), _) => _ = bytes.take(scalar.size()).ok_or_else(short)?,
            (Kind::List { length, entry }, purpose) => {
                let length = bytes.whole(length).ok_or_else(short)?;
                let entries = usize::try_from(length).map_err(|_| {
                    let element = element.name.clone();
                    PlyError::Length { element, at: i + 1, length }
                })?;
                let size = entries.checked_mul(entry.size()).ok_or_else(short)?;
                let list = bytes.take(size).ok_or_else(short)?;
                if purpose == Use::Corners {
                    let mut list = Bytes { rest: list, little: bytes.little };
                    while let Some(index) = list.whole(entry) {
                        taker.corner(index, None)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Takes numbers off the front.
struct Bytes<'a> {
    rest: &'a [u8],
    little: bool,
}

impl<'a> Bytes<'a> {
    fn take(&mut self, size: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(size)?;
        self.rest = rest;
        Some(taken)
    }

    /// The bytes of a number as an unsigned one, the first byte lowest.
    fn bits(&mut self, scalar: Scalar) -> Option<u64> {
        let taken = self.take(scalar.size())?;
        let add = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        let bits =
            if self.little { taken.iter().rev().fold(0, add) } else { taken.iter().fold(0, add) };
        Some(bits)
    }

    fn whole(&mut self, scalar: Scalar) -> Option<i64> {
        let bits = self.bits(scalar)?;
        Some(match scalar {
            Scalar::I8 => i64::from(bits as i8),
            Scalar::I16 => i64::from(bits as i16),
            Scalar::I32 => i64::from(bits as i32),
            Scalar::U8 | Scalar::U16 | Scalar::U32 => bits as i64,
            // Lists of these are refused with the header.
            Scalar::F32 | Scalar::F64 => return None,
        })
    }

    fn number(&mut self, scalar: Scalar) -> Option<f64> {
        match scalar {
            Scalar::F32 => self.bits(scalar).map(|b| f64::from(f32::from_bits(b as u32))),
            Scalar::F64 => self.bits(scalar).map(f64::from_bits),
            whole => self.whole(whole).map(|n| n as f64),
        }
    }
}
