//! report.json: what was measured on the way and of the result. Lengths in mm,
//! angles in degrees. It holds no times, so that the same run gives the same bytes.

use crate::chart::Method;
use crate::frame::Frame;
use crate::frame::arrangement::Arrangement;
use crate::frame::close::Closing;
use crate::frame::fit::{Fit, FitBy};
use crate::frame::guide::Guide;
use crate::frame::measure::Measures;
use crate::frame::relax::Relaxing;
use crate::frame::share::Shared;
use crate::shop::saw::{Aim, CutPlan};
use serde::Serialize;

/// The report of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    pub model: String,
    pub pattern: String,
    pub rod_diameter: f64,
    pub turn: f64,
    pub surface: Surface,
    pub fit: Fitted,
    /// How the pattern was relaxed, if it was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relax: Option<Relaxing>,
    pub closing: Closing,
    pub measures: Measures,
    pub arrangement: UnitCounts,
    /// Contacts that gravity would open: the end of a rod that hangs below the other rod.
    pub tied: Vec<String>,
    pub sawing: Sawing,
    /// What sharing lengths came to, if rods do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shared_lengths: Option<SharedLengths>,
    pub dropped: Vec<DroppedUnit>,
}

impl Report {
    /// The file's text.
    ///
    /// # Errors
    /// When a figure cannot be written, which no report causes.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}

/// The guiding surface.
#[derive(Clone, Debug, Serialize)]
pub struct Surface {
    /// Width, depth, height.
    pub size: [f64; 3],
    /// What was mended.
    pub mended: Vec<String>,
    /// What it is.
    #[serde(flatten)]
    pub kind: SurfaceKind,
}

/// What a guiding surface is.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum SurfaceKind {
    /// A mesh with a chart.
    Chart {
        triangles: usize,
        /// What flattened it.
        method: Method,
        /// Why it was not what was asked for.
        #[serde(skip_serializing_if = "Option::is_none")]
        fallback: Option<String>,
        /// Mean and largest change of a triangle angle.
        angle_distortion: [f64; 2],
        /// Least and greatest length on the surface of a unit length in the plane.
        scale: [f64; 2],
        /// The same at a twentieth of the area from either end.
        scale_most: [f64; 2],
        /// Steps of the flattening.
        flattening_steps: usize,
    },
    /// The polygons of a mesh.
    Mesh { polygons: usize },
    /// A polyhedron on a sphere.
    Sphere { radius: f64, polygons: usize },
}

/// The tile edge.
#[derive(Clone, Debug, Serialize)]
pub struct Fitted {
    pub edge: f64,
    /// `given`; `rise` (the edge at which the median rise equals the diameter); `turn`
    /// (the turn at which it does); `turn-limit` (the safe turn nearest to that); `plain`
    /// (surfaces without enough curvature: 20 diameters, or the usual turn).
    pub by: &'static str,
    /// Median rise at this edge: the diameter that would suit best.
    pub median_rise: f64,
}

/// Units by who goes over in them; those without a circuit are not counted.
#[derive(Clone, Debug, Serialize)]
pub struct UnitCounts {
    /// Every rod ends on top of the next.
    pub all_over: usize,
    /// Every rod ends below the next.
    pub all_under: usize,
    /// Some do, and some do not.
    pub mixed: usize,
}

/// The sawing plan.
#[derive(Clone, Debug, Serialize)]
pub struct Sawing {
    pub bars: usize,
    pub bought: f64,
    pub waste: f64,
    pub least_bars: usize,
    pub proven: bool,
    /// What was made small: `bars`, `length` or `cost`.
    pub aim: &'static str,
    /// Its value, and what no plan goes below: bars, mm, or money.
    pub spent: f64,
    pub least: f64,
    pub cuts: usize,
    /// Weight of the rods, kg.
    pub weight: f64,
}

/// Lengths that rods share.
#[derive(Clone, Debug, Serialize)]
pub struct SharedLengths {
    /// Different lengths before and after.
    pub before: usize,
    pub after: usize,
    /// What all rods got longer together.
    pub extra: f64,
    /// How many rods taper, or meet others at both ends, and so keep their length.
    pub kept: usize,
    /// Rods that keep their own length, having no room for more.
    pub own: Vec<String>,
}

/// A unit that was left out.
#[derive(Clone, Debug, Serialize)]
pub struct DroppedUnit {
    pub center: [f64; 3],
    pub reason: String,
}

/// The surface's part of the report.
pub fn surface(guide: &Guide, notes: &[String]) -> Surface {
    let kind = match guide {
        Guide::Chart { mesh, distortion: d } => SurfaceKind::Chart {
            triangles: mesh.triangles.len(),
            method: d.method,
            fallback: d.fallback.clone(),
            angle_distortion: [d.mean_angle, d.max_angle].map(f64::to_degrees),
            scale: d.scale,
            scale_most: d.scale_most,
            flattening_steps: d.steps,
        },
        Guide::Mesh(mesh) => SurfaceKind::Mesh { polygons: mesh.faces.len() },
        Guide::Sphere { faces, radius, .. } => {
            SurfaceKind::Sphere { radius: *radius, polygons: *faces }
        }
    };
    let size = guide.bounds().map_or([0.0; 3], |[lo, hi]| (hi - lo).into());
    Surface { size, mended: notes.to_vec(), kind }
}

/// The fit's part of the report.
pub fn fit(fit: &Fit) -> Fitted {
    let by = match fit.by {
        FitBy::Given => "given",
        FitBy::Edge => "rise",
        FitBy::Smaller => "move",
        FitBy::Turn => "turn",
        FitBy::TurnLimit => "turn-limit",
        FitBy::Plain => "plain",
    };
    Fitted { edge: fit.edge, by, median_rise: fit.rise }
}

/// The arrangement's parts of the report: the units, and the contacts to be tied.
pub fn arrangement(found: &Arrangement) -> (UnitCounts, Vec<String>) {
    let Arrangement { over, under, mixed, ref tied } = *found;
    let units = UnitCounts { all_over: over, all_under: under, mixed };
    (units, tied.iter().map(ToString::to_string).collect())
}

/// The sawing plan's part of the report.
pub fn sawing(plan: &CutPlan, density: f64) -> Sawing {
    Sawing {
        bars: plan.bars.len(),
        bought: plan.bought(),
        waste: plan.waste(),
        least_bars: plan.bound,
        proven: plan.is_proven(),
        aim: aim(plan),
        spent: plan.spent,
        least: plan.least,
        cuts: plan.cuts(),
        weight: plan.weight(density),
    }
}

/// What a plan makes small, in one word.
pub(super) fn aim(plan: &CutPlan) -> &'static str {
    match plan.aim {
        Aim::Bars => "bars",
        Aim::Length => "length",
        Aim::Cost => "cost",
    }
}

/// The part of the report on shared lengths.
pub fn shared(shared: &Shared) -> SharedLengths {
    let Shared { before, after, extra, kept, ref own } = *shared;
    let own = own.iter().map(ToString::to_string).collect();
    SharedLengths { before, after, extra, kept, own }
}

/// The units left out, and why.
pub fn dropped(frame: &Frame) -> Vec<DroppedUnit> {
    let unit = |d: &crate::frame::Dropped| DroppedUnit {
        center: d.center.coords.into(),
        reason: d.reason.clone(),
    };
    frame.dropped.iter().map(unit).collect()
}
