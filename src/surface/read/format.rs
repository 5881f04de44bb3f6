//! Which format a file has, from its content.

use super::{Cause, off, ply, stl};

/// A format that is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Format {
    Obj,
    Gltf,
    BinaryStl,
    TextStl,
    Ply,
    Off,
}

impl Format {
    /// The format of a file, without a byte order mark.
    pub fn of(bytes: &[u8]) -> Result<Self, Cause> {
        let text = bytes.trim_ascii();
        if text.is_empty() {
            return Err(Cause::Empty);
        }
        let is_vertex =
            |line: &[u8]| matches!(line.trim_ascii_start(), [b'v' | b'f', b' ' | b'\t', ..]);
        let looks_like = guess(bytes);
        Ok(match () {
            () if bytes.starts_with(b"glTF") => Self::Gltf,
            // Before all text: its first 80 bytes may be anything.
            () if stl::is_binary(bytes) => Self::BinaryStl,
            () if text.starts_with(b"{") => Self::Gltf,
            () if ply::is_ply(bytes) => Self::Ply,
            () if stl::is_text(bytes) => Self::TextStl,
            () if off::is_off(bytes) => Self::Off,
            () if looks_like.is_some() => return Err(Cause::Format { looks_like }),
            () if bytes.split(|b| *b == b'\n').any(is_vertex) => Self::Obj,
            () if stl::is_damaged_binary(bytes) => Self::BinaryStl,
            () => return Err(Cause::Format { looks_like: None }),
        })
    }
}

/// Formats that are met often but not read, by their first bytes.
fn guess(bytes: &[u8]) -> Option<&'static str> {
    let starts = |start: &str| bytes.starts_with(start.as_bytes());
    match () {
        () if starts("PK\x03\x04") => Some("a 3MF or ZIP archive"),
        () if starts("Kaydara FBX") => Some("an FBX file"),
        () if starts("ISO-10303-21") => Some("a STEP file"),
        () if starts("BLENDER") => Some("a Blender file"),
        () if starts("3D Geometry File Format") => Some("a Rhino file"),
        () => None,
    }
}
