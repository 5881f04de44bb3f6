//! Reads surfaces from files.
//!
//! The format follows from the content, not the name. Every reader fills a `soup` of
//! points and faces as the file has them. The soup is cut into triangles, or kept in
//! polygons, and mended ([`mend`](crate::surface::mend),
//! [`polygons`](crate::surface::polygons)), or the answer says why not. No reader trusts
//! a size that it finds in a file, and memory stays within a small multiple of the
//! file's size.

mod accessor;
mod format;
pub mod gltf;
pub mod obj;
pub mod off;
pub mod ply;
mod ply_body;
pub(super) mod polygon;
pub mod soup;
pub mod stl;
pub mod text;
pub mod uri;

use crate::surface::Mesh;
use crate::surface::mend::MendError;
use crate::surface::polygons::PolygonMesh;
use format::Format;
use soup::Soup;
use std::path::Path;
use std::{fs, io};

/// Formats that can be read, for messages.
pub const READABLE: &str =
    "OBJ (.obj), glTF (.gltf), GLB (.glb), STL (.stl), PLY (.ply) and OFF (.off)";

/// A surface as read, and what was done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct Reading {
    /// The sound mesh, mm, z up.
    pub mesh: Mesh,
    /// One sentence for each kind of mend, for those who ask.
    pub notes: Vec<String>,
    /// The format is in metres with y up by its specification (glTF), and the mesh was
    /// turned and scaled accordingly. Otherwise figures are as in the file, taken for
    /// mm and z up.
    pub y_up_metres: bool,
}

/// A surface as read, in the polygons of the file, and what was done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct PolygonReading {
    /// The sound mesh, mm, z up.
    pub mesh: PolygonMesh,
    /// One sentence for each kind of mend, for those who ask.
    pub notes: Vec<String>,
    /// As in [`Reading`].
    pub y_up_metres: bool,
}

/// Why a surface cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {cause}")]
pub struct ReadError {
    /// The file as given.
    pub file: String,
    /// What is wrong with it.
    pub cause: Cause,
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum Cause {
    /// The file is not there, or cannot be read.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// A folder, a device or a pipe.
    #[error("is not a file")]
    NotAFile,
    /// No bytes.
    #[error("the file is empty")]
    Empty,
    /// Not a format that is read.
    #[error("{}; readable formats are {READABLE}", .looks_like.map_or(
        "the format is not known".into(), |f| format!("this is {f}, which is not read")))]
    Format {
        /// The format that it seems to be.
        looks_like: Option<&'static str>,
    },
    /// A fault of an OBJ file.
    #[error(transparent)]
    Obj(#[from] obj::ObjError),
    /// A fault of a glTF file.
    #[error(transparent)]
    Gltf(#[from] gltf::GltfError),
    /// A fault of an STL file.
    #[error(transparent)]
    Stl(#[from] stl::StlError),
    /// A fault of a PLY file.
    #[error(transparent)]
    Ply(#[from] ply::PlyError),
    /// A fault of an OFF file.
    #[error(transparent)]
    Off(#[from] off::OffError),
    /// A fault of the faces, whatever the format.
    #[error(transparent)]
    Face(#[from] soup::FaceError),
    /// The file was read, but is no surface.
    #[error(transparent)]
    Mesh(#[from] MendError),
}

impl ReadError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match &self.cause {
            Cause::Io(_) | Cause::NotAFile => "check the name of the file",
            Cause::Empty => "export the surface again",
            Cause::Format { .. } => "export the surface in one of these formats",
            Cause::Obj(e) => e.hint(),
            Cause::Gltf(e) => e.hint(),
            Cause::Stl(e) => e.hint(),
            Cause::Ply(e) => e.hint(),
            Cause::Off(e) => e.hint(),
            Cause::Face(e) => e.hint(),
            Cause::Mesh(e) => e.hint(),
        }
    }

    /// Whether the file itself could not be had, as opposed to what is in it.
    pub fn is_io(&self) -> bool {
        matches!(self.cause, Cause::Io(_) | Cause::NotAFile)
    }
}

/// Reads a surface from a file.
///
/// # Errors
/// A file that cannot be had, is of no known format, is damaged, or holds no surface.
pub fn read(path: &Path) -> Result<Reading, ReadError> {
    let file = || path.display().to_string();
    let bytes = load(path).map_err(|cause| ReadError { file: file(), cause })?;
    read_bytes(&file(), &bytes, path.parent())
}

/// Reads a surface from a file, in the polygons of the file.
///
/// # Errors
/// As [`read`]; also a face whose outline meets itself.
pub fn read_polygons(path: &Path) -> Result<PolygonReading, ReadError> {
    let file = || path.display().to_string();
    let bytes = load(path).map_err(|cause| ReadError { file: file(), cause })?;
    read_polygons_bytes(&file(), &bytes, path.parent())
}

fn load(path: &Path) -> Result<Vec<u8>, Cause> {
    if !fs::metadata(path)?.is_file() {
        return Err(Cause::NotAFile);
    }
    Ok(fs::read(path)?)
}

/// Reads a surface from the content of a file. `name` is for messages; buffers of a
/// .gltf file are looked for in `folder` and nowhere else.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Reading, ReadError> {
    let mut notes = Vec::new();
    let mesh = soup(bytes, folder, &mut notes)
        .and_then(|(soup, y_up_metres)| Ok((soup.into_triangles(&mut notes)?, y_up_metres)));
    let (mesh, y_up_metres) = mesh.map_err(|cause| ReadError { file: name.into(), cause })?;
    Ok(Reading { mesh, notes, y_up_metres })
}

/// Reads a surface from the content of a file, in the polygons of the file; `name` and
/// `folder` as in [`read_bytes`].
///
/// # Errors
/// As [`read_polygons`].
pub fn read_polygons_bytes(
    name: &str,
    bytes: &[u8],
    folder: Option<&Path>,
) -> Result<PolygonReading, ReadError> {
    let mut notes = Vec::new();
    let mesh = soup(bytes, folder, &mut notes)
        .and_then(|(soup, y_up_metres)| Ok((soup.into_polygons(&mut notes)?, y_up_metres)));
    let (mesh, y_up_metres) = mesh.map_err(|cause| ReadError { file: name.into(), cause })?;
    Ok(PolygonReading { mesh, notes, y_up_metres })
}

/// Points and faces as the file has them, and whether they came in metres with y up.
fn soup(
    bytes: &[u8],
    folder: Option<&Path>,
    notes: &mut Vec<String>,
) -> Result<(Soup, bool), Cause> {
    // Some programs begin text with a byte order mark.
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    Ok(match Format::of(bytes)? {
        Format::Obj => (obj::read(bytes)?, false),
        Format::Gltf => (gltf::read(bytes, folder, notes)?, true),
        Format::BinaryStl => (stl::read_binary(bytes)?, false),
        Format::TextStl => (stl::read_text(bytes)?, false),
        Format::Ply => (ply::read(bytes)?, false),
        Format::Off => (off::read(bytes)?, false),
    })
}
