//! Reads surfaces from files.
//!
//! The format follows from the content, not the name. Every reader gives vertices and
//! triangles as the file has them; [`mend`](crate::surface::mend) then makes a sound
//! mesh of them or says why not. No reader trusts a size that it finds in a file, and
//! memory stays within a small multiple of the file's size.

mod accessor;
pub mod gltf;
pub mod obj;
mod polygon;
pub mod uri;

use crate::surface::Mesh;
use crate::surface::mend::{MendError, Mended, mend};
use std::path::Path;
use std::{fs, io};

/// Formats that can be read, for messages.
pub const READABLE: &str = "OBJ (.obj), glTF (.gltf) and GLB (.glb)";

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
    reading(bytes, folder).map_err(|cause| ReadError { file: name.into(), cause })
}

fn reading(bytes: &[u8], folder: Option<&Path>) -> Result<Reading, Cause> {
    // Some programs begin text with a byte order mark.
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut notes = Vec::new();
    let (mesh, y_up_metres) = match Format::of(bytes)? {
        Format::Obj => (obj::read(bytes, &mut notes)?, false),
        Format::Gltf => (gltf::read(bytes, folder, &mut notes)?, true),
    };
    let Mended { mesh, notes: mends } = mend(mesh)?;
    notes.extend(mends);
    Ok(Reading { mesh, notes, y_up_metres })
}

enum Format {
    Obj,
    Gltf,
}

impl Format {
    fn of(bytes: &[u8]) -> Result<Self, Cause> {
        let text = bytes.trim_ascii();
        if text.is_empty() {
            return Err(Cause::Empty);
        }
        if bytes.starts_with(b"glTF") || text.starts_with(b"{") {
            return Ok(Self::Gltf);
        }
        let is_vertex =
            |line: &[u8]| matches!(line.trim_ascii_start(), [b'v' | b'f', b' ' | b'\t', ..]);
        let looks_like = guess(bytes);
        if looks_like.is_none() && bytes.split(|b| *b == b'\n').any(is_vertex) {
            return Ok(Self::Obj);
        }
        Err(Cause::Format { looks_like })
    }
}

/// Formats that are met often, by their first bytes.
fn guess(bytes: &[u8]) -> Option<&'static str> {
    let starts = |start: &str| bytes.starts_with(start.as_bytes());
    // Binary STL: 80 bytes of anything, the number of triangles, 50 bytes for each.
    let count = bytes.get(80..84).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let is_stl = count.is_some_and(|n| bytes.len() as u64 == 84 + 50 * u64::from(n));
    match () {
        () if starts("ply\n") || starts("ply\r") => Some("a PLY file"),
        () if starts("OFF\n") || starts("OFF\r") || starts("OFF ") => Some("an OFF file"),
        () if is_stl || starts("solid ") || starts("solid\n") => Some("an STL file"),
        () if starts("PK\x03\x04") => Some("a 3MF or ZIP archive"),
        () if starts("Kaydara FBX") => Some("an FBX file"),
        () if starts("ISO-10303-21") => Some("a STEP file"),
        () if starts("BLENDER") => Some("a Blender file"),
        () if starts("3D Geometry File Format") => Some("a Rhino file"),
        () => None,
    }
}
