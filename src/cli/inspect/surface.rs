//! What `inspect` tells about a surface: its size, its pieces, and whether a frame can be
//! made on it.

use super::Args;
use crate::cli::Failure;
use crate::cli::page::Page;
use crate::cli::terminal::Terminal;
use crate::surface::Mesh;
use crate::surface::prepare::Prepared;
use crate::surface::read::Reading;
use crate::surface::shape::Shape;
use crate::surface::topology::{Topology, TopologyError, require_chartable};

/// The page about a surface, as the options leave it.
pub fn page(args: &Args, reading: Reading, terminal: &Terminal) -> Result<String, Failure> {
    let mut page = Page::new(terminal);
    let turned = reading.y_up_metres && !args.preparation.turns();
    let Prepared { mesh, notes } = args.preparation.apply(reading)?;
    let topology = Topology::new(&mesh).map_err(Failure::input)?;
    let shape = Shape::new(&mesh, &topology);
    page.head(&args.path.display().to_string());
    sizes(&mut page, &mesh, &shape);
    if turned {
        page.row("axes", "turned from y up and metres, as glTF has it, to z up and mm");
    }
    let changes = args.preparation.to_string();
    if !changes.is_empty() {
        page.row("after", changes);
    }
    for (i, note) in notes.iter().enumerate() {
        page.row(if i == 0 { "mended" } else { "" }, note);
    }
    page.head(if shape.pieces.len() == 1 { "Piece" } else { "Pieces" });
    page.text += &format!("{shape}\n");
    page.head("For a frame");
    verdict(&mut page, &mesh);
    Ok(page.text)
}

fn sizes(page: &mut Page, mesh: &Mesh, shape: &Shape) {
    page.row("triangles", mesh.triangles.len());
    page.row("vertices", mesh.points.len());
    if let Some([lo, hi]) = mesh.bounds() {
        let size = hi - lo;
        page.row("size", format!("{:.1} × {:.1} × {:.1} mm", size.x, size.y, size.z));
        page.row("heights", format!("{:.1} to {:.1} mm", lo.z, hi.z));
    }
    let area: f64 = shape.pieces.iter().map(|p| p.area).sum();
    page.row("area", format!("{area:.0} mm²"));
}

fn verdict(page: &mut Page, mesh: &Mesh) {
    match require_chartable(mesh) {
        Ok(_) => page.line("ready: one piece with a border and no handle"),
        // The table stands above already.
        Err(TopologyError::NotChartable(shape)) => {
            page.line("not yet: it takes one piece with a border and no handle");
            for (i, step) in shape.advice().iter().enumerate() {
                page.row(if i == 0 { "to do" } else { "then" }, step);
            }
        }
        Err(e) => {
            page.line(format!("not yet: {e}"));
            page.row("to do", e.hint());
        }
    }
}
