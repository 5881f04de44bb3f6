//! The map between a plane and the guiding surface (paper, section 4.1).

mod abf;
mod conformal;
mod distortion;
mod fill;
mod flat;
mod holes;
mod layout;
mod planar;
mod rim;
mod sheet;

pub use abf::{Flattening, flatten};
pub use conformal::{Conformal, Method, conformal};
pub use distortion::{Distortion, Uneven};
pub use fill::{Filling, fill};
pub use flat::{Flat, Unwrapped, in_plane};
pub use layout::layout;
pub use planar::PlanarChart;
pub use sheet::Sheet;

use crate::linalg::LinalgError;
use crate::surface::{Point3, Vector3};
use nalgebra::Point2;
use thiserror::Error;

/// A plane that is wrapped round a surface. Lengths in the plane agree with those
/// on the surface in the mean.
pub trait Chart {
    /// Lower and upper corner of the part of the plane that is mapped, mm.
    fn bounds(&self) -> [Point2<f64>; 2];

    /// The place of the surface that belongs to a point of the plane; `None`
    /// outside the chart.
    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint>;

    /// Whether a strip of the plane, `half_width` mm to either side of the segment from
    /// `a` to `b`, round at its ends, meets a hole inside the chart.
    fn crosses_hole(&self, _a: Point2<f64>, _b: Point2<f64>, _half_width: f64) -> bool {
        false
    }
}

/// A place on the guiding surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SurfacePoint {
    /// Where it is, mm.
    pub position: Point3,
    /// The outward unit normal, smooth over the triangles.
    pub normal: Vector3,
}

/// Why a surface has no chart.
#[derive(Error, Debug, Clone, PartialEq)]
pub enum ChartError {
    /// The angles did not settle.
    #[error(
        "the surface could not be flattened: after {steps} steps its angles are still \
         {residual:.1e} rad from closing. Cut it into gentler pieces, or remesh it with \
         triangles of more even shape"
    )]
    NoConvergence { steps: usize, residual: f64 },
    /// Triangles of the flat mesh lie upside down.
    #[error(
        "the flattened surface folds over itself at {count} of {total} triangles (the first \
         near triangle {first}). Cut the surface into gentler pieces, or remesh it finer there"
    )]
    Folded { count: usize, total: usize, first: crate::ids::FaceId },
    /// Far parts of the flat mesh lie on top of each other.
    #[error(
        "the flattened surface overlaps itself: its border near ({:.1}, {:.1}, {:.1}) mm comes to \
         lie on another part. Cut the surface there or above (--cut), or use its own polygons \
         (--pattern mesh)", .at[0], .at[1], .at[2]
    )]
    Overlaps { at: [f64; 3] },
    /// A linear system failed.
    #[error("the surface could not be flattened: {0}. Remesh it without slivers")]
    Linear(#[from] LinalgError),
}

#[cfg(test)]
mod tests;
