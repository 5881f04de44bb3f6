//! What commands are given to work on: a structure or a surface, told apart by content.

use super::Failure;
use crate::surface::component::Component;
use crate::surface::cut::CutPlane;
use crate::surface::prepare::{Prepared, prepare};
use crate::surface::read::{ReadError, Reading, read, read_bytes};
use crate::surface::up::Up;
use crate::write::structure::{Structure, StructureError, parse_structure, read_structure};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::fmt;
use std::path::Path;

/// A file or folder, read.
pub enum Input {
    /// A folder written by rodwright, or its structure.json.
    Structure(Box<Structure>),
    /// A surface file.
    Surface(Box<Reading>),
}

impl Input {
    /// Reads a folder, a structure or a surface.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            let structure = read_structure(&path.join("structure.json"));
            return structure.map(Self::structure).map_err(structure_failure);
        }
        // Devices and pipes are refused before they are read.
        if !path.is_file() {
            return read(path).map(Self::surface).map_err(surface_failure);
        }
        let bytes = std::fs::read(path)
            .map_err(|e| Failure::file(format!("{}: cannot be read: {e}", path.display())))?;
        if is_structure(path, &bytes) {
            parse_structure(path, &bytes).map(Self::structure).map_err(structure_failure)
        } else {
            let reading = read_bytes(&path.display().to_string(), &bytes, path.parent());
            reading.map(Self::surface).map_err(surface_failure)
        }
    }

    fn structure(structure: Structure) -> Self {
        Self::Structure(structure.into())
    }

    fn surface(reading: Reading) -> Self {
        Self::Surface(reading.into())
    }
}

/// Whether a file is a JSON object other than glTF, which must have an `asset`. Of JSON
/// that is damaged only the name can tell.
fn is_structure(path: &Path, bytes: &[u8]) -> bool {
    #[derive(Deserialize)]
    struct Head {
        asset: Option<IgnoredAny>,
    }
    if !bytes.trim_ascii_start().starts_with(b"{") {
        return false;
    }
    match serde_json::from_slice(bytes) {
        Ok(Head { asset }) => asset.is_none(),
        Err(_) => path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("gltf")),
    }
}

fn structure_failure(e: StructureError) -> Failure {
    let hint = e.hint().map(|h| format!(". Hint: {h}")).unwrap_or_default();
    Failure::file(format!("{e}{hint}"))
}

fn surface_failure(e: ReadError) -> Failure {
    let message = format!("{e}. Hint: {}", e.hint());
    if e.is_io() { Failure::File(message) } else { Failure::Input(message) }
}

/// What is done to a surface before it is used.
#[derive(clap::Args)]
pub struct Preparation {
    /// The axis of the file that points up [default: z; y for glTF]
    #[arg(long, value_name = "AXIS")]
    up: Option<Up>,

    /// Keep only what lies above a height, e.g. z=120mm, or z=40% of the whole height
    #[arg(long, value_name = "PLANE")]
    cut: Option<CutPlane>,

    /// Keep one piece: the largest, or the one of this number, as counted after the cut
    #[arg(long, value_name = "PIECE")]
    component: Option<Component>,
}

impl Preparation {
    /// Turns, cuts and reduces a surface as asked.
    pub fn apply(&self, reading: Reading) -> Result<Prepared, Failure> {
        prepare(reading, self.up, self.component, self.cut, None).map_err(|e| {
            // Tables end with a line of their own.
            let text = e.to_string();
            let end = if text.contains('\n') { "\n" } else { ". " };
            Failure::input(format!("{text}{end}Hint: {}", e.hint()))
        })
    }

    /// Whether the axis that points up is given.
    pub fn turns(&self) -> bool {
        self.up.is_some()
    }

    /// Refuses these options where the input is a structure.
    pub fn refuse(&self, path: &Path) -> Result<(), Failure> {
        let given = self.to_string();
        let Some(option) = given.split(' ').next().filter(|o| !o.is_empty()) else {
            return Ok(());
        };
        Err(Failure::usage(format!(
            "{option} is for surfaces, but {} is a finished structure",
            path.display()
        )))
    }
}

/// The options as given, in the order in which they are applied.
impl fmt::Display for Preparation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let options = [
            self.up.map(|u| format!("--up {u}")),
            self.cut.map(|c| format!("--cut {c}")),
            self.component.map(|c| format!("--component {c}")),
        ];
        f.write_str(&options.into_iter().flatten().collect::<Vec<_>>().join(" "))
    }
}
