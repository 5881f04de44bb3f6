//! `rodwright convert`: a surface or a structure in another format.

use super::Failure;
use super::input::{Input, Preparation};
use super::terminal::{Terminal, print};
use crate::surface::Mesh;
use crate::write::convert::{Format, structure_file, surface_file, worst_rounding};
use crate::write::file::replace;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
#[command(
    after_help = "Surfaces go to all formats that hold geometry. Structures go to all: with a \
                  body for each rod, cut level where it stands on the ground; to dxf with the \
                  axis of each rod as a line, on a layer for each class of lengths; to json as \
                  structure.json, and to csv, contacts-csv and supports-csv as the tables of a \
                  folder. Files are in mm with z up, glTF in metres with y up. stl, glb and gltf \
                  hold seven digits, dxf six decimals, tables three, the others all digits."
)]
pub struct Args {
    /// A surface file, a folder written by rodwright, or its structure.json
    #[arg(value_name = "IN")]
    input: PathBuf,

    /// The file to write, over an earlier one if there is one; - for standard output
    #[arg(value_name = "OUT")]
    out: PathBuf,

    /// The format to write [default: by the ending of OUT]
    #[arg(long, value_name = "FORMAT", value_enum, hide_default_value = true)]
    to: Option<Format>,

    #[command(flatten)]
    preparation: Preparation,

    /// Say what was mended
    #[arg(short, long)]
    verbose: bool,
}

pub fn run(args: &Args, terminal: &Terminal) -> Result<(), Failure> {
    let format = format(args)?;
    let bytes = match Input::read(&args.input)? {
        Input::Structure(structure) => {
            args.preparation.refuse(&args.input)?;
            structure_file(&structure, format).map_err(Failure::input)?
        }
        Input::Surface(reading) => {
            let prepared = args.preparation.apply(*reading)?;
            if args.verbose {
                prepared.notes.iter().for_each(|note| terminal.note(note));
            }
            rounding(&prepared.mesh, format).iter().for_each(|w| terminal.warning(w));
            let file = surface_file(&prepared.mesh, format).map_err(Failure::input)?;
            file.ok_or_else(|| {
                Failure::usage(format!(
                    "surfaces are not written as {format}, only as {}",
                    list(Format::all().filter(|format| format.is_for_surfaces()))
                ))
            })?
        }
    };
    if args.out == Path::new("-") {
        return print(&bytes);
    }
    replace(&args.out, &bytes)
        .map_err(|e| Failure::file(format!("cannot write {}: {e}", args.out.display())))
}

fn format(args: &Args) -> Result<Format, Failure> {
    args.to.or_else(|| Format::of_file(&args.out)).ok_or_else(|| {
        Failure::usage(format!(
            "the ending of {} names no format: end it in one that does, or add --to with one of {}",
            args.out.display(),
            list(Format::all())
        ))
    })
}

fn list(formats: impl IntoIterator<Item = Format>) -> String {
    formats.into_iter().map(|f| f.to_string()).collect::<Vec<_>>().join(", ")
}

/// Rounding beyond this share of the size is told: from there on vertices can come to lie
/// at one place, and are joined when the file is read.
const COARSE: f64 = 1e-6;

/// What to say where single precision is too coarse for a surface far from the origin.
fn rounding(mesh: &Mesh, format: Format) -> Option<String> {
    let [lo, hi] = mesh.bounds()?;
    let moved = worst_rounding(mesh);
    let coarse = format.is_single() && moved > COARSE * (hi - lo).norm();
    coarse.then(|| {
        format!(
            "{format} holds seven digits, so vertices moved by up to {moved:.1e} mm: move the \
             surface to the origin, or write obj, ply or off"
        )
    })
}
