//! The conformal map of a surface: by ABF++, or by LSCM, or by LSCM where ABF++ fails.

use super::{ChartError, Flattening, Sheet, abf, layout};
use crate::ids::{FaceId, Id, VertexId};
use crate::surface::Mesh;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// How the surface is flattened.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Angle based (ABF++): the better map where the surface is far from flat.
    #[default]
    Abf,
    /// Least squares conformal map: as good on gentle surfaces, in a fraction of the time.
    Lscm,
}

/// A sheet in the plane.
#[derive(Clone, Debug)]
pub struct Conformal {
    /// The place of each vertex, of any scale.
    pub flat: Vec<Point2<f64>>,
    /// What made the map.
    pub method: Method,
    /// Why it was made by another method than asked for: a sentence.
    pub fallback: Option<String>,
    /// Steps that ABF++ took; 0 for LSCM, which takes none.
    pub steps: usize,
}

/// Flattens a sheet. Where ABF++ fails or its map folds, LSCM is tried.
///
/// # Errors
/// [`ChartError::Folded`] when both maps fold; the error of ABF++ when LSCM fails too.
pub fn conformal(mesh: &Mesh, sheet: &Sheet, method: Method) -> Result<Conformal, ChartError> {
    match method {
        Method::Abf => abf_or_lscm(mesh, sheet, abf::MAX_STEPS),
        Method::Lscm => lscm(mesh, sheet),
    }
}

/// ABF++ of at most so many steps, or else LSCM.
pub(super) fn abf_or_lscm(
    mesh: &Mesh,
    sheet: &Sheet,
    max_steps: usize,
) -> Result<Conformal, ChartError> {
    let why = match abf_map(mesh, sheet, max_steps) {
        Ok(map) => return Ok(map),
        Err(why) => why,
    };
    let cause = match &why {
        ChartError::NoConvergence { steps, .. } => format!("did not settle in {steps} steps"),
        ChartError::Folded { count, .. } => format!("turned {count} triangles over"),
        ChartError::Linear(error) => format!("stopped: {error}"),
        ChartError::Overlaps { .. } => return Err(why),
    };
    match lscm(mesh, sheet) {
        Ok(map) => {
            let fallback = Some(format!("ABF++ {cause}, so the map was made by LSCM"));
            Ok(Conformal { fallback, ..map })
        }
        // A fold says more about the surface than steps or unknowns.
        Err(folded @ ChartError::Folded { .. }) if !matches!(why, ChartError::Folded { .. }) => {
            Err(folded)
        }
        Err(_) => Err(why),
    }
}

fn abf_map(mesh: &Mesh, sheet: &Sheet, max_steps: usize) -> Result<Conformal, ChartError> {
    let Flattening { angles, steps, .. } = abf::flatten_within(sheet, max_steps)?;
    let flat = placed(mesh, sheet, &angles)?;
    Ok(Conformal { flat, method: Method::Abf, fallback: None, steps })
}

fn lscm(mesh: &Mesh, sheet: &Sheet) -> Result<Conformal, ChartError> {
    let flat = placed(mesh, sheet, &sheet.angles)?;
    Ok(Conformal { flat, method: Method::Lscm, fallback: None, steps: 0 })
}

/// The layout of given angles, refused where it folds.
fn placed(mesh: &Mesh, sheet: &Sheet, angles: &[[f64; 3]]) -> Result<Vec<Point2<f64>>, ChartError> {
    let pins = far_pair(mesh, &sheet.rim);
    let distance = (mesh.points[pins[0]] - mesh.points[pins[1]]).norm();
    let flat = layout(sheet, angles, pins, distance)?;
    refuse_folds(sheet, &flat)?;
    Ok(flat)
}

/// Two rim vertices far apart: the farthest from the first, and the farthest from that.
/// Without a rim, any two vertices: the map folds, and its error says so.
fn far_pair(mesh: &Mesh, rim: &[bool]) -> [VertexId; 2] {
    let closed = !rim.contains(&true);
    let rim = || mesh.points.ids().filter(|v| closed || rim[v.index()]);
    let farthest = |from: VertexId| {
        let distance = |v: &VertexId| (mesh.points[*v] - mesh.points[from]).norm_squared();
        rim().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(from)
    };
    let first = farthest(rim().next().unwrap_or(VertexId::new(0)));
    [first, farthest(first)]
}

/// Triangles that fill holes may fold: nothing stands on them.
fn refuse_folds(sheet: &Sheet, flat: &[Point2<f64>]) -> Result<(), ChartError> {
    let total = sheet.real;
    let mut folded = (0..total).filter(|&t| {
        let [a, b, c] = sheet.triangles[t].map(|v| flat[v.index()]);
        let area = (b - a).perp(&(c - a));
        area.is_nan() || area <= 0.0
    });
    match folded.next() {
        None => Ok(()),
        Some(first) => {
            let first = FaceId::new(first);
            Err(ChartError::Folded { count: 1 + folded.count(), total, first })
        }
    }
}
