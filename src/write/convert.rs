//! The formats that surfaces and structures are converted to, and their names.

use super::dxf::{axes_dxf, mesh_dxf};
use super::glb::{GlbError, glb, gltf, mesh_glb, mesh_gltf};
use super::obj::write_obj_exact;
use super::off::write_off;
use super::ply::{write_ply, write_ply_text};
use super::rods::{all_rods, rods_obj, rods_stl, rods_stl_text};
use super::stl::{write_stl, write_stl_text};
use super::structure::{Structure, StructureFault};
use super::tables::{self, TableError};
use crate::shop::lengths::classes;
use crate::surface::Mesh;
use std::fmt;
use std::path::Path;
use thiserror::Error;

/// A format that is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub enum Format {
    /// Wavefront OBJ, mm, z up.
    Obj,
    /// Binary STL, mm, z up, single precision.
    Stl,
    /// STL as text, mm, z up.
    StlAscii,
    /// Binary PLY, little endian, doubles, mm, z up.
    Ply,
    /// PLY as text, mm, z up.
    PlyAscii,
    /// OFF, mm, z up.
    Off,
    /// glTF in one binary file, metres, y up, single precision.
    Glb,
    /// glTF as text that holds its buffer, metres, y up, single precision.
    Gltf,
    /// DXF of release 2000, mm, z up: surfaces as faces, structures as lines, the axes of
    /// their rods, on a layer for each class of lengths.
    Dxf,
    /// structure.json, of a structure.
    Json,
    /// rods.csv, of a structure.
    Csv,
    /// contacts.csv, of a structure.
    ContactsCsv,
    /// supports.csv, of a structure.
    SupportsCsv,
}

/// Every format with its name, and whether a file's ending calls for it.
const NAMES: [(Format, &str, bool); 13] = [
    (Format::Obj, "obj", true),
    (Format::Stl, "stl", true),
    (Format::StlAscii, "stl-ascii", false),
    (Format::Ply, "ply", true),
    (Format::PlyAscii, "ply-ascii", false),
    (Format::Off, "off", true),
    (Format::Glb, "glb", true),
    (Format::Gltf, "gltf", true),
    (Format::Dxf, "dxf", true),
    (Format::Json, "json", true),
    (Format::Csv, "csv", true),
    (Format::ContactsCsv, "contacts-csv", false),
    (Format::SupportsCsv, "supports-csv", false),
];

impl Format {
    /// All formats.
    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.iter().map(|n| n.0)
    }

    /// Whether surfaces are written in it; structures are in all.
    pub fn is_for_surfaces(self) -> bool {
        !matches!(self, Self::Json | Self::Csv | Self::ContactsCsv | Self::SupportsCsv)
    }

    /// The format that a file's ending calls for, in upper or lower case.
    pub fn of_file(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        let called = |n: &&(Self, &str, bool)| n.2 && n.1.eq_ignore_ascii_case(ending);
        NAMES.iter().find(called).map(|n| n.0)
    }

    /// Whether coordinates are rounded to single precision.
    pub fn is_single(self) -> bool {
        matches!(self, Self::Stl | Self::Glb | Self::Gltf)
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = NAMES.iter().find(|n| n.0 == *self).expect("every format stands in the table");
        f.pad(name.1)
    }
}

/// Why a structure could not be written.
#[derive(Error, Debug)]
pub enum ConvertError {
    /// As glTF.
    #[error(transparent)]
    Glb(#[from] GlbError),
    /// It does not hang together.
    #[error(transparent)]
    Structure(#[from] StructureFault),
    /// As a table.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// A surface as a file; `None` for a format that surfaces are not written in. Vertices,
/// where the format has them, and triangles keep their order, and coordinates all digits
/// that the format holds.
///
/// # Errors
/// What the writers of glTF say; see [`GlbError`].
pub fn surface_file(mesh: &Mesh, format: Format) -> Result<Option<Vec<u8>>, GlbError> {
    Ok(Some(match format {
        Format::Obj => write_obj_exact(mesh).into_bytes(),
        Format::Stl => write_stl(mesh),
        Format::StlAscii => write_stl_text(mesh).into_bytes(),
        Format::Ply => write_ply(mesh),
        Format::PlyAscii => write_ply_text(mesh).into_bytes(),
        Format::Off => write_off(mesh).into_bytes(),
        Format::Glb => mesh_glb(mesh)?,
        Format::Gltf => mesh_gltf(mesh)?.into_bytes(),
        Format::Dxf => mesh_dxf(mesh).into_bytes(),
        Format::Json | Format::Csv | Format::ContactsCsv | Format::SupportsCsv => return Ok(None),
    }))
}

/// A structure as a file: its rods as bodies, or lines in DXF; or its figures.
///
/// # Errors
/// [`ConvertError`], where the structure does not hang together.
pub fn structure_file(structure: &Structure, format: Format) -> Result<Vec<u8>, ConvertError> {
    Ok(match format {
        Format::Glb => glb(structure, None)?,
        Format::Gltf => gltf(structure)?.into_bytes(),
        Format::Obj => rods_obj(structure).into_bytes(),
        Format::Stl => rods_stl(structure),
        Format::StlAscii => rods_stl_text(structure).into_bytes(),
        Format::Ply => write_ply(&all_rods(structure)),
        Format::PlyAscii => write_ply_text(&all_rods(structure)).into_bytes(),
        Format::Off => write_off(&all_rods(structure)).into_bytes(),
        Format::Dxf => axes_dxf(structure).into_bytes(),
        Format::Json => structure.to_json()?.into_bytes(),
        Format::Csv => {
            let frame = structure.to_frame()?;
            tables::rods(&frame, &classes(&frame), None)?
        }
        Format::ContactsCsv => tables::contacts(&structure.to_frame()?)?,
        Format::SupportsCsv => tables::supports(&structure.to_frame()?)?,
    })
}

/// How far rounding to single precision moves a vertex of a mesh at most, mm.
pub fn worst_rounding(mesh: &Mesh) -> f64 {
    let coordinates = mesh.points.iter().flat_map(|p| [p.x, p.y, p.z]);
    coordinates.map(|x| (x - f64::from(x as f32)).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
#[path = "convert_tests.rs"]
mod tests;
