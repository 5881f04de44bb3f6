//! From a file's mesh to the guiding surface: turned upright, cut, reduced to one piece
//! and scaled, in this order.

use crate::ids::{IdVec, VertexId};
use crate::surface::bow_ties::split_bow_ties;
use crate::surface::component::{Component, ComponentError, keep, keep_polygons};
use crate::surface::cut::{CutFault, CutPlane, cut, whole_above};
use crate::surface::faces::bounds;
use crate::surface::mend::MendError;
use crate::surface::polygons::{PolygonMesh, mend_polygons};
use crate::surface::read::{PolygonReading, Reading};
use crate::surface::shape::counted;
use crate::surface::up::{Up, file_axes, upright, with_file_axes};
use crate::surface::{Mesh, Point3};

/// Why a mesh cannot be made the guiding surface asked for.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PrepareError {
    /// The mesh, once turned.
    #[error(transparent)]
    Mend(#[from] MendError),
    /// The cut.
    #[error(transparent)]
    Cut(#[from] CutFault),
    /// The piece to keep.
    #[error(transparent)]
    Component(#[from] ComponentError),
    /// A surface that stands on edge has no span.
    #[error("the surface has no horizontal extent, so --span cannot scale it")]
    NoSpan,
}

impl PrepareError {
    /// What to try.
    pub fn hint(&self) -> String {
        match self {
            Self::Mend(e) => e.hint().into(),
            Self::Cut(e) => e.hint().into(),
            Self::Component(e) => e.hint(),
            Self::NoSpan => "set --up to the axis that points up".into(),
        }
    }
}

/// The guiding surface, and what was done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct Prepared {
    /// The surface, mm, z up, without bow-ties.
    pub mesh: Mesh,
    /// What was mended, a sentence each: on reading, and here.
    pub notes: Vec<String>,
}

/// Makes the guiding surface of a file's mesh.
///
/// `up` is the axis of the file that points up; without it, the one of the format. The
/// cut is in figures of the file (mm after a format in metres). The component is counted
/// among the pieces that the cut leaves. `span` is the longest horizontal side that the
/// result is scaled to, mm; without it the figures stay.
///
/// # Errors
/// [`PrepareError`], with what to try.
pub fn prepare(
    reading: Reading,
    up: Option<Up>,
    component: Option<Component>,
    plane: Option<CutPlane>,
    span: Option<f64>,
) -> Result<Prepared, PrepareError> {
    let mut notes = reading.notes;
    let mesh = match up {
        Some(up) if reading.y_up_metres => upright(&with_file_axes(&reading.mesh), up)?,
        Some(up) => upright(&reading.mesh, up)?,
        None => reading.mesh,
    };
    // No vertices are joined after this.
    let (mut mesh, divided) = split_bow_ties(mesh);
    if divided > 0 {
        notes.push(counted(
            divided,
            "vertex divided, where parts touch in a point only",
            "vertices divided, where parts touch in a point only",
        ));
    }
    if let Some(plane) = plane {
        mesh = cut(&mesh, plane)?;
    }
    if let Some(component) = component {
        mesh = keep(&mesh, component)?;
    }
    scale(&mut mesh.points, span)?;
    Ok(Prepared { mesh, notes })
}

/// The same for a mesh whose polygons are to stay whole: a cut drops those that reach
/// below it.
///
/// # Errors
/// [`PrepareError`], with what to try.
pub fn prepare_polygons(
    reading: PolygonReading,
    up: Option<Up>,
    component: Option<Component>,
    plane: Option<CutPlane>,
    span: Option<f64>,
) -> Result<PolygonMesh, PrepareError> {
    let PolygonReading { mut mesh, y_up_metres, .. } = reading;
    if let Some(up) = up {
        let turn = |&p: &Point3| up.upright(if y_up_metres { file_axes(p) } else { p });
        let points = mesh.points.iter().map(turn).collect();
        mesh = mend_polygons(PolygonMesh { points, faces: mesh.faces })?.mesh;
    }
    if let Some(plane) = plane {
        mesh = whole_above(&mesh, plane)?;
    }
    if let Some(component) = component {
        mesh = keep_polygons(&mesh, component)?;
    }
    scale(&mut mesh.points, span)?;
    Ok(mesh)
}

/// Scales points about the origin so that their longest horizontal side is `span` mm.
fn scale(points: &mut IdVec<VertexId, Point3>, span: Option<f64>) -> Result<(), PrepareError> {
    let (Some(span), Some([lo, hi])) = (span, bounds(points)) else { return Ok(()) };
    let longest = (hi.x - lo.x).max(hi.y - lo.y);
    if longest <= 0.0 {
        return Err(PrepareError::NoSpan);
    }
    for p in points.iter_mut() {
        *p = Point3::from(p.coords * (span / longest));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{Id, VertexId};
    use crate::surface::samples;

    /// The igloo, lying with y up, and a speck of one triangle at its top.
    fn reading(y_up_metres: bool) -> Reading {
        let mut mesh = samples::sample("igloo").expect("a sample");
        let first = mesh.points.len();
        for p in [[0.0, 0.0, 230.0], [1.0, 0.0, 230.0], [0.0, 1.0, 230.0]] {
            mesh.points.push(Point3::from(p));
        }
        mesh.triangles.push([0, 1, 2].map(|i| VertexId::new(first + i)));
        // A format with y up is turned by its reader.
        let mesh = if y_up_metres { mesh } else { with_file_axes(&mesh) };
        Reading { mesh, notes: Vec::new(), y_up_metres }
    }

    #[test]
    fn the_steps_follow_one_another() {
        let plane: CutPlane = "z=110mm".parse().expect("a plane");
        let dome = |span| {
            let largest = Some(Component::Largest);
            prepare(reading(false), Some(Up::Y), largest, Some(plane), span).expect("a dome").mesh
        };
        let [lo, hi] = dome(None).bounds().expect("not empty");
        assert_eq!(lo.z, 110.0, "cut once upright");
        assert!((hi.z - 220.0).abs() < 1e-9, "the speck is gone");
        let [lo, hi] = dome(Some(1000.0)).bounds().expect("not empty");
        let span = (hi.x - lo.x).max(hi.y - lo.y);
        assert!((span - 1000.0).abs() < 1e-9, "scaled after the cut");
    }

    #[test]
    fn components_are_counted_after_the_cut() {
        let plane: CutPlane = "z=225mm".parse().expect("a plane");
        let speck = prepare(reading(true), None, Some(Component::Number(1)), Some(plane), None);
        assert_eq!(speck.expect("one piece is left").mesh.triangles.len(), 1);
    }

    #[test]
    fn an_axis_of_a_format_with_y_up_is_that_of_the_file() {
        let plain = prepare(reading(true), None, None, None, None);
        assert_eq!(prepare(reading(true), Some(Up::Y), None, None, None), plain);
    }

    #[test]
    fn bow_ties_are_divided_and_told() {
        let points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]];
        let mesh = Mesh {
            points: points.iter().map(|p| Point3::from(p.map(f64::from))).collect(),
            triangles: [[0, 1, 2], [0, 3, 4]].iter().map(|t| t.map(VertexId::new)).collect(),
        };
        let tie = Reading { mesh, notes: vec!["before".into()], y_up_metres: false };
        let prepared = prepare(tie, None, None, None, None).expect("two pieces");
        assert_eq!(prepared.mesh.points.len(), 6);
        let told = "1 vertex divided, where parts touch in a point only";
        assert_eq!(prepared.notes, ["before", told]);
    }

    #[test]
    fn a_sheet_on_edge_has_no_span() {
        let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]].map(Point3::from);
        let mesh = Mesh {
            points: points.to_vec().into(),
            triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
        };
        let line = Reading { mesh, notes: Vec::new(), y_up_metres: false };
        let error = prepare(line, None, None, None, Some(100.0)).expect_err("no extent");
        assert_eq!(error, PrepareError::NoSpan);
    }
}
