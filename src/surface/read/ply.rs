//! PLY, the Stanford polygon format: text and both binary forms.
//!
//! The header declares elements with their properties, numbers or lists of numbers.
//! Taken are `x`, `y`, `z` of the element `vertex` and the list `vertex_indices` (or
//! `vertex_index`) of `face`; everything else is skipped by its declared size. The
//! crates for PLY gather every property of every element, many times the size of the
//! file, so it is read here: the header in this file, the body in `ply_body`. Left out:
//! triangle strips. Figures are taken as mm, z up.

use super::ply_body;
use super::soup::{FaceError, Soup};
use super::text::{Line, LineError, Lines};

/// What is wrong with a PLY file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PlyError {
    /// A line that cannot be read, in the header or of a text file.
    #[error(transparent)]
    Line(#[from] LineError),
    /// The header does not end.
    #[error("the header does not end: there is no line end_header")]
    OpenHeader,
    /// An element or property that the header must declare.
    #[error("the header declares no {0}")]
    Undeclared(&'static str),
    /// A property whose type does not suit it.
    #[error("property {property} of element {element} has an unsuited type")]
    Unsuited {
        /// The element.
        element: String,
        /// The property.
        property: String,
    },
    /// Triangle strips.
    #[error("the file holds triangle strips (tristrips), which are not read")]
    Strips,
    /// The file ends too early.
    #[error("element {element}: the header says that there are {said}, but the file ends in {at}")]
    Short {
        /// The element.
        element: String,
        /// How many the header says there are.
        said: u64,
        /// The one in which the file ends, counted from 1.
        at: u64,
    },
    /// A list of negative length.
    #[error("{element} {at}: a list has {length} entries")]
    Length {
        /// The element.
        element: String,
        /// Which of them, counted from 1.
        at: u64,
        /// The length.
        length: i64,
    },
    /// Bytes after the last element.
    #[error("{bytes} bytes are left over after the last element")]
    LeftOver {
        /// How many.
        bytes: usize,
    },
    /// A face that does not fit the vertices.
    #[error(transparent)]
    Face(#[from] FaceError),
}

impl PlyError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Line(_) => "correct the line, or export the surface again",
            Self::Strips => "export with triangles or polygons instead of strips",
            Self::Undeclared(_) => "export the surface as a mesh, with its faces",
            Self::Face(e) => e.hint(),
            _ => "the file is damaged or was written wrongly: export the surface again",
        }
    }
}

/// How the body is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes in a binary file.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// What a property is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    One(Scalar),
    List { length: Scalar, entry: Scalar },
}

/// What a property is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Use {
    /// A coordinate: 0, 1 or 2.
    Coordinate(usize),
    Corners,
    Skip,
}

/// A property of an element.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Property {
    name: String,
    pub kind: Kind,
    pub purpose: Use,
}

/// A table of the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// Whether a file starts like PLY.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply") && bytes.get(3).is_none_or(u8::is_ascii_whitespace)
}

/// Vertices and faces.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, PlyError> {
    let mut lines = Lines::new(bytes);
    let (form, mut elements) = header(&mut lines)?;
    let vertices = assign(&mut elements)?;
    match form {
        Form::Text => ply_body::read_text(lines, &elements, vertices),
        Form::LittleEndian | Form::BigEndian => {
            let little = form == Form::LittleEndian;
            ply_body::read_binary(lines.rest(), &elements, vertices, little)
        }
    }
}

/// The lines up to `end_header`.
fn header(lines: &mut Lines) -> Result<(Form, Vec<Element>), PlyError> {
    let mut form = None;
    let mut elements: Vec<Element> = Vec::new();
    lines.next(); // the word ply
    loop {
        let line = lines.next().ok_or(PlyError::OpenHeader)?;
        let words: Vec<&str> = line.words(None).collect();
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", kind, _] => {
                form = Some(match kind {
                    "ascii" => Form::Text,
                    "binary_little_endian" => Form::LittleEndian,
                    "binary_big_endian" => Form::BigEndian,
                    _ => return Err(line.error("the format is not known").into()),
                });
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| line.error("a whole number is needed"))?;
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", ..] => {
                let element = elements.last_mut();
                let element = element.ok_or_else(|| line.error("a property of no element"))?;
                element.properties.push(property(&line, &words[1..])?);
            }
            ["end_header"] => break,
            _ => return Err(line.error("the header line is not known").into()),
        }
    }
    Ok((form.ok_or(PlyError::Undeclared("format"))?, elements))
}

fn property(line: &Line, words: &[&str]) -> Result<Property, PlyError> {
    let scalar = |word: &str| {
        Scalar::of(word).ok_or_else(|| line.error(format!("the type {word:?} is not known")))
    };
    let (kind, name) = match *words {
        ["list", length, entry, name] => {
            let length = scalar(length)?;
            if !length.is_whole() {
                return Err(line.error("the length of a list is a whole number").into());
            }
            (Kind::List { length, entry: scalar(entry)? }, name)
        }
        [kind, name] if kind != "list" => (Kind::One(scalar(kind)?), name),
        _ => return Err(line.error("a property needs its type and its name").into()),
    };
    Ok(Property { name: name.into(), kind, purpose: Use::Skip })
}

/// Finds the properties that matter; gives the number of vertices.
fn assign(elements: &mut [Element]) -> Result<u64, PlyError> {
    if elements.iter().any(|e| e.name == "tristrips" && e.count > 0) {
        return Err(PlyError::Strips);
    }
    let vertex = elements.iter_mut().find(|e| e.name == "vertex");
    let vertex = vertex.ok_or(PlyError::Undeclared("element vertex"))?;
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        let property = vertex.properties.iter_mut().find(|p| p.name == name);
        let property =
            property.ok_or(PlyError::Undeclared("property x, y and z of element vertex"))?;
        if !matches!(property.kind, Kind::One(_)) {
            return Err(unsuited("vertex", property));
        }
        property.purpose = Use::Coordinate(k);
    }
    let vertices = vertex.count;
    let face = elements.iter_mut().find(|e| e.name == "face");
    let face = face.ok_or(PlyError::Undeclared("element face"))?;
    let list = |p: &&mut Property| ["vertex_indices", "vertex_index"].contains(&p.name.as_str());
    let property = face.properties.iter_mut().find(list);
    let property =
        property.ok_or(PlyError::Undeclared("property vertex_indices of element face"))?;
    match property.kind {
        Kind::List { entry, .. } if entry.is_whole() => property.purpose = Use::Corners,
        _ => return Err(unsuited("face", property)),
    }
    Ok(vertices)
}

fn unsuited(element: &str, property: &Property) -> PlyError {
    PlyError::Unsuited { element: element.into(), property: property.name.clone() }
}
