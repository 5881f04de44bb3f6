//! report.json: what was measured on the way and of the result. Lengths in mm,
//! angles in degrees. It holds no times, so that the same run gives the same bytes.

use super::figure::rounded;
use crate::chart::Method;
use crate::frame::Frame;
use crate::frame::arrangement::Arrangement;
use crate::frame::as_built::AsBuilt;
use crate::frame::close::Closing;
use crate::frame::fit::{Fit, FitBy};
use crate::frame::guide::Guide;
use crate::frame::measure::Measures;
use crate::frame::relax::Relaxing;
use crate::frame::share::Shared;
use crate::frame::tolerance::{Misfit, TRIALS, UnitOff};
use crate::ids::RodId;
use crate::shop::saw::{Aim, CutPlan};
use crate::shop::{Assembly, JigError, Jigs};
use crate::write::statics::{StaticsFigures, StiffenedFigures};
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
    /// The order in which it is put together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assembly: Option<AssemblyFigures>,
    pub sawing: Sawing,
    /// What sharing lengths came to, if rods do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shared_lengths: Option<SharedLengths>,
    /// What became of measurements on sticks, if there were any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub as_built: Option<Rebuilt>,
    /// What errors of marks and diameters do, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerances>,
    /// What became of its turn, slide and tile edge, if it was stiffened.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffened: Option<StiffenedFigures>,
    /// Its stresses, or why it does not stand, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statics: Option<StaticsFigures>,
    /// What a laser cuts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jigs: Option<JigFigures>,
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

/// The order in which a frame is put together.
#[derive(Clone, Debug, Serialize)]
pub struct AssemblyFigures {
    /// `crown` or `ground`.
    pub order: &'static str,
    pub steps: usize,
    /// The most rods that a step places.
    pub most_rods: usize,
    /// Props that are set in all, and at most at once.
    pub props: usize,
    pub most_props: usize,
    /// How often a rod is lifted to slide another under it.
    pub lifts: usize,
    /// Props that the finished frame cannot do without.
    pub missed_props: usize,
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

/// A frame that was solved again with what was measured on its sticks.
#[derive(Clone, Debug, Serialize)]
pub struct Rebuilt {
    /// Rods that are sawn: those with a measurement.
    pub sawn: Vec<String>,
    /// Marks that are held, and diameters that were measured.
    pub marks: usize,
    pub diameters: usize,
    /// Largest distance left of a contact from its held mark, or of a sawn foot from the ground.
    pub deviation: f64,
    /// Largest error of a gap left, as part of the gap.
    pub worst_gap: f64,
    /// Largest change of a mark that is not held, and of a length that is not sawn.
    pub mark_change: f64,
    pub length_change: f64,
    /// Rods with a mark, as planned or measured, that is off by more than 0.5 mm now.
    pub mark_again: Vec<MarkAgain>,
    /// Rods, not sawn, whose length is another one now.
    pub saw_again: Vec<String>,
}

/// A rod to be marked again.
#[derive(Clone, Debug, Serialize)]
pub struct MarkAgain {
    pub rod: String,
    /// How far one of its marks is off at most.
    pub change: f64,
}

/// How far last contacts of units are off where marks and diameters are not exact.
#[derive(Clone, Debug, Serialize)]
pub struct Tolerances {
    /// Errors of marks and of diameters, ± two standard deviations.
    pub marks: f64,
    pub diameter: f64,
    pub trials: usize,
    pub seed: u32,
    /// Over all units and trials.
    pub median: f64,
    pub p95: f64,
    pub units: Vec<UnitTolerance>,
}

/// The same of one unit.
#[derive(Clone, Debug, Serialize)]
pub struct UnitTolerance {
    pub id: String,
    pub last_contact: String,
    pub median: f64,
    pub p95: f64,
}

/// What a laser cuts, or why that is left out.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum JigFigures {
    /// Jigs on sheets.
    Cut {
        sheets: usize,
        /// Width and height of a sheet.
        sheet: [f64; 2],
        parts: usize,
        /// Props of the falsework.
        props: usize,
        /// Units that no prop holds: they lie too low or too steep for one, or there is no room.
        units_without_prop: Vec<String>,
        /// Props of the assembly that the falsework has no room for.
        props_without_room: Vec<String>,
        /// Rods to be marked on their cards.
        rods_without_gauge: Vec<String>,
    },
    /// None.
    LeftOut { left_out: String },
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

/// The order's part of the report.
pub fn assembly(assembly: &Assembly) -> AssemblyFigures {
    AssemblyFigures {
        order: assembly.order.code(),
        steps: assembly.steps.len(),
        most_rods: assembly.steps.iter().map(|step| step.rods.len()).max().unwrap_or(0),
        props: assembly.props(),
        most_props: assembly.most_props(),
        lifts: assembly.lifts(),
        missed_props: assembly.missed.len(),
    }
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

/// What became of measurements.
pub fn as_built(what: &AsBuilt) -> Rebuilt {
    let names = |rods: &[RodId]| rods.iter().map(RodId::to_string).collect();
    let again = |&(rod, change): &(RodId, f64)| MarkAgain { rod: rod.to_string(), change };
    Rebuilt {
        sawn: names(&what.sawn),
        marks: what.marks,
        diameters: what.diameters,
        deviation: what.deviation,
        worst_gap: what.error,
        mark_change: what.mark_change,
        length_change: what.length_change,
        mark_again: what.mark_again.iter().map(again).collect(),
        saw_again: names(&what.saw_again),
    }
}

/// What errors of marks and diameters do. Figures that are drawn by chance are given to a
/// micrometre.
pub fn tolerance(misfit: &Misfit) -> Tolerances {
    let um = |mm: f64| rounded(mm, 3);
    let unit = |u: &UnitOff| UnitTolerance {
        id: u.unit.to_string(),
        last_contact: u.contact.to_string(),
        median: um(u.off.median),
        p95: um(u.off.p95),
    };
    Tolerances {
        marks: misfit.tolerance.marks,
        diameter: misfit.tolerance.diameter,
        trials: TRIALS,
        seed: misfit.seed,
        median: um(misfit.overall.median),
        p95: um(misfit.overall.p95),
        units: misfit.units.iter().map(unit).collect(),
    }
}

/// What a laser cuts, or why that is left out.
pub fn jigs(jigs: &Result<Jigs, JigError>) -> JigFigures {
    match jigs {
        Ok(jigs) => JigFigures::Cut {
            sheets: jigs.sheets.len(),
            sheet: jigs.sheet,
            parts: jigs.sheets.iter().map(Vec::len).sum(),
            props: jigs.props,
            units_without_prop: jigs.unheld.iter().map(ToString::to_string).collect(),
            props_without_room: jigs.missed.iter().map(ToString::to_string).collect(),
            rods_without_gauge: jigs.unmarked.iter().map(ToString::to_string).collect(),
        },
        Err(e) => JigFigures::LeftOut { left_out: e.to_string() },
    }
}

/// The units left out, and why.
pub fn dropped(frame: &Frame) -> Vec<DroppedUnit> {
    let unit = |d: &crate::frame::Dropped| DroppedUnit {
        center: d.center.coords.into(),
        reason: d.reason.clone(),
    };
    frame.dropped.iter().map(unit).collect()
}
