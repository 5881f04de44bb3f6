//! From a placed pattern to a finished frame; what does not work is left out, one
//! unit at a time, and the rest is solved again (paper, section 4.2 and Fig. 21).

use super::assemble::{Ground, assemble};
use super::axis::Axis;
use super::clash::clashes;
use super::close::{CloseError, Closing, Joint, close};
use super::crop::crop;
use super::cut::{crossings, cut, disorder, seats};
use super::fault::{Fault, cover};
use super::layer::{Layering, layer};
use super::lift::{Lifted, lift};
use super::stand::{Standing, ground_level, stand};
use super::weave::{Weave, weave};
use super::{Dropped, Frame};
use crate::chart::Chart;
use crate::ids::{ContactId, IdVec, RodId, TileId};
use crate::linalg::LinalgError;
use crate::pattern::{Pattern, UnitShape};
use crate::tiling::{Placement, Tiling};
use nalgebra::Point2;
use std::collections::BTreeSet;
use thiserror::Error;

/// What a frame is made from, besides surface, pattern and placement. Lengths in mm.
#[derive(Clone, Copy, Debug)]
pub struct FormSettings {
    /// Rod diameter.
    pub diameter: f64,
    /// Turn of the rods, radians.
    pub turn: f64,
    /// Rod left beyond its last contact.
    pub overhang: f64,
    /// Rod lengths are multiples of this; 0 for any length.
    pub round: f64,
    /// Who goes over.
    pub layering: Layering,
    /// The lowest height of the surface.
    pub surface_low: f64,
}

/// A finished frame and how it came about.
#[derive(Clone, Debug)]
pub struct Formed {
    /// The frame.
    pub frame: Frame,
    /// What the last closing took.
    pub closing: Closing,
    /// How far each end of each rod moved in it, mm.
    pub moves: Vec<f64>,
    /// Rise of every contact before closing, mm.
    pub rises: IdVec<ContactId, f64>,
}

/// Why there is no frame.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum FormError {
    /// Hardly a unit fits the surface.
    #[error(
        "only {units} units of edge {edge:.1} mm fit the surface, and a frame needs at least \
         {least}. Use smaller units (--unit), thinner rods (--rod) or a larger model (--span)"
    )]
    TooFewUnits { units: usize, least: usize, edge: f64 },
    /// The units have no room for the rods.
    #[error(
        "units of edge {edge:.1} mm are too small for {diameter} mm rods: the contacts of a unit \
         of {sides} rods would lie {apart:.1} mm apart. Use an edge of at least {least:.1} mm \
         (--unit), a larger turn (--turn) or thinner rods (--rod)"
    )]
    TooTight { edge: f64, diameter: f64, sides: usize, apart: f64, least: f64 },
    /// More units than can be laid out.
    #[error(
        "units of edge {edge} mm would be some {about:.0} on this surface, more than the \
         {MOST_UNITS} that fit in memory. Use larger units (--unit) or thicker rods (--rod)"
    )]
    TooManyUnits { edge: f64, about: f64 },
    /// Too much had to be left out.
    #[error(
        "{dropped} of {total} units of edge {edge:.1} mm do not work with {diameter} mm rods; the \
         first: {first}. Leave out --unit to let the units be fitted to the rods, or try another \
         turn (--turn), a shorter overhang (--overhang) or another pattern (--pattern)"
    )]
    TooManyDropped { dropped: usize, total: usize, edge: f64, diameter: f64, first: String },
    /// A linear system could not be solved.
    #[error("the contacts could not be closed: {0}")]
    Linear(#[from] LinalgError),
}

/// Fewest units that make a frame: three, so that a rod can lie between two.
const LEAST_UNITS: usize = 3;

/// Most tiles that are laid out: some gigabytes. More can only be a slip of a unit.
pub const MOST_UNITS: usize = 1_000_000;

/// Largest part of the units that may be left out before the whole is refused.
/// More, and what remains is not the surface that was asked for.
const DROPPED_PART: f64 = 0.2;

/// Units are left out one at a time, since each loss relieves its neighbours; of very
/// many, one more at a time for each so many.
const AT_ONCE: usize = 40;

/// Least distance between two contacts along a rod, in diameters. Nearer, and
/// there is no room for the two rods side by side.
const ENGAGEMENT: f64 = 1.0;

/// Longest piece added to a rod so that it stands on the ground, in tile edges.
const REACH: f64 = 1.5;

/// Builds a frame of a pattern on a chart.
///
/// # Errors
/// [`FormError`] when too few units fit, or too many fail.
pub fn form(
    chart: &impl Chart,
    pattern: &Pattern,
    placement: &Placement,
    settings: &FormSettings,
) -> Result<Formed, FormError> {
    require_room(pattern, placement, settings)?;
    let about = most_units(chart, placement.edge);
    if about > MOST_UNITS as f64 {
        return Err(FormError::TooManyUnits { edge: placement.edge, about });
    }
    let tiling = patch(chart, pattern, placement);
    let mut without = BTreeSet::new();
    let mut dropped: Vec<Dropped> = Vec::new();
    let mut total = None;
    loop {
        let tiles = crop(&tiling, placement, settings.turn, chart, &without);
        if tiles.len() < LEAST_UNITS && dropped.is_empty() {
            let (units, least) = (tiles.len(), LEAST_UNITS);
            return Err(FormError::TooFewUnits { units, least, edge: placement.edge });
        }
        let total = *total.get_or_insert(tiles.len());
        let weave = weave(&tiling, &tiles, settings.turn);
        let faults = match attempt(chart, &weave, placement, settings)? {
            Ok(mut formed) => {
                formed.frame.dropped = dropped;
                return Ok(formed);
            }
            Err(faults) => faults,
        };
        let failing = cover(&faults);
        let lost = dropped.len() + failing.len();
        if lost as f64 > DROPPED_PART * total as f64 || tiles.len() <= LEAST_UNITS {
            return Err(too_many(lost, total, &failing[0].1, placement, settings));
        }
        for (unit, reason) in failing.into_iter().take(1 + lost / AT_ONCE) {
            let woven = &weave.units[unit];
            without.insert(woven.tile);
            let center = chart.lift(placement.apply(woven.center));
            let center = center.map_or_else(Default::default, |c| c.position);
            dropped.push(Dropped { center, reason });
        }
    }
}

/// Refuses units whose contacts lie nearer together than the rods are thick.
fn require_room(
    pattern: &Pattern,
    placement: &Placement,
    settings: &FormSettings,
) -> Result<(), FormError> {
    let (edge, diameter) = (placement.edge, settings.diameter);
    for sides in pattern.tiling().polygons() {
        let shape = UnitShape::new(sides, settings.turn);
        let side = shape.ending - shape.passing;
        if side * edge < ENGAGEMENT * diameter {
            let least = ENGAGEMENT * diameter / side;
            return Err(FormError::TooTight { edge, diameter, sides, apart: side * edge, least });
        }
    }
    Ok(())
}

/// An upper bound to the number of tiles of this edge on a chart: as if all were
/// triangles, in the box round it.
pub fn most_units(chart: &impl Chart, edge: f64) -> f64 {
    let [lo, hi] = chart.bounds();
    let triangle = 3f64.sqrt() / 4.0 * edge * edge;
    (hi.x - lo.x) * (hi.y - lo.y) / triangle
}

/// The tiles over the whole chart.
pub fn patch(chart: &impl Chart, pattern: &Pattern, placement: &Placement) -> Tiling {
    let [lo, hi] = chart.bounds();
    let corners = [(lo.x, lo.y), (lo.x, hi.y), (hi.x, lo.y), (hi.x, hi.y)];
    let corners = corners.map(|(x, y)| placement.invert(Point2::new(x, y)));
    let low = corners[1..].iter().fold(corners[0], |m, p| m.inf(p));
    let high = corners[1..].iter().fold(corners[0], |m, p| m.sup(p));
    pattern.tiling().patch(low, high)
}

fn too_many(
    dropped: usize,
    total: usize,
    first: &str,
    placement: &Placement,
    settings: &FormSettings,
) -> FormError {
    FormError::TooManyDropped {
        dropped,
        total,
        edge: placement.edge,
        diameter: settings.diameter,
        first: first.to_string(),
    }
}

/// One try at a frame: the frame, or what is wrong with which units.
fn attempt(
    chart: &impl Chart,
    weave: &Weave,
    placement: &Placement,
    settings: &FormSettings,
) -> Result<Result<Formed, Vec<Fault>>, FormError> {
    let lifted = match lift(weave, placement, chart) {
        Ok(lifted) => lifted,
        Err(e) => return Ok(Err(vec![Fault { units: vec![e.unit], reason: e.reason.into() }])),
    };
    let rises = lifted.rises(weave);
    let joints = joints(weave, &lifted, &layer(&rises, settings.layering), settings.diameter);
    let mut axes = lifted.axes.clone();
    let closing = match close(&mut axes, &joints) {
        Ok(closing) => closing,
        Err(CloseError::Linear(e)) => return Err(e.into()),
        Err(CloseError::Parallel(c)) => return Ok(Err(vec![open_contact(weave, c)])),
        Err(CloseError::Diverged { open }) => {
            return Ok(Err(open.into_iter().map(|c| open_contact(weave, c)).collect()));
        }
    };
    let moves = lifted
        .axes
        .iter()
        .zip(&axes)
        .flat_map(|(old, new)| [(new.a - old.a).norm(), (new.b - old.b).norm()])
        .collect();
    Ok(finish(weave, &lifted, &axes, &joints, placement, settings).map(|frame| Formed {
        frame,
        closing,
        moves,
        rises,
    }))
}

fn open_contact(weave: &Weave, contact: ContactId) -> Fault {
    let units = vec![weave.contacts[contact].unit];
    Fault { units, reason: "two of its rods could not be brought to touch".into() }
}

fn joints(
    weave: &Weave,
    lifted: &Lifted,
    ending_over: &IdVec<ContactId, bool>,
    diameter: f64,
) -> IdVec<ContactId, Joint> {
    weave
        .contacts
        .enumerate()
        .map(|(id, c)| {
            let (over, under) =
                if ending_over[id] { (c.ending, c.passing) } else { (c.passing, c.ending) };
            Joint { over, under, outward: lifted.normals[id], gap: diameter }
        })
        .collect()
}

/// Cuts the closed axes, checks them, lets them stand, and puts the frame together.
fn finish(
    weave: &Weave,
    lifted: &Lifted,
    closed: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    placement: &Placement,
    settings: &FormSettings,
) -> Result<Frame, Vec<Fault>> {
    let FormSettings { diameter, overhang, round, .. } = *settings;
    let along = seats(weave, joints, &crossings(weave, closed, joints).map_err(|f| vec![f])?);
    let faults = disorder(weave, &along, ENGAGEMENT * diameter);
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut axes: IdVec<RodId, Axis> =
        closed.enumerate().map(|(r, axis)| cut(axis, &along[r], overhang, round)).collect();
    let pairs: BTreeSet<[RodId; 2]> =
        joints.iter().map(|j| [j.over.min(j.under), j.over.max(j.under)]).collect();
    let faults = clash_faults(weave, &axes, diameter, &pairs);
    if !faults.is_empty() {
        return Err(faults);
    }
    let ground = ground_level(settings.surface_low, &axes);
    let how = Standing { ground, reach: REACH * placement.edge, diameter, round };
    let supports = stand(weave, &mut axes, &how);
    let on = Ground { diameter, ground, supports };
    assemble(weave, lifted, &axes, joints, on).map_err(|fault| vec![fault])
}

fn clash_faults(
    weave: &Weave,
    axes: &IdVec<RodId, Axis>,
    diameter: f64,
    pairs: &BTreeSet<[RodId; 2]>,
) -> Vec<Fault> {
    clashes(axes, diameter, pairs)
        .iter()
        .map(|clash| {
            let units = clash.rods.iter().flat_map(|&r| weave.rods[r].units).flatten().collect();
            let reason = format!(
                "one of its rods would run into another: their axes pass at {:.2} mm",
                clash.distance
            );
            Fault { units, reason }
        })
        .collect()
}

/// The tiles that a pattern would have on a chart, and its median rise, mm: what
/// [`fit`](super::fit) looks at. `None` where it has too few or too many.
pub fn median_rise(
    chart: &impl Chart,
    pattern: &Pattern,
    placement: &Placement,
    turn: f64,
) -> Option<(Vec<TileId>, f64)> {
    if most_units(chart, placement.edge) > MOST_UNITS as f64 {
        return None;
    }
    let tiling = patch(chart, pattern, placement);
    let tiles = crop(&tiling, placement, turn, chart, &BTreeSet::new());
    if tiles.len() < LEAST_UNITS {
        return None;
    }
    let weave = weave(&tiling, &tiles, turn);
    let mut rises: Vec<f64> =
        lift(&weave, placement, chart).ok()?.rises(&weave).iter().map(|rise| rise.abs()).collect();
    rises.sort_by(f64::total_cmp);
    Some((tiles, rises[rises.len() / 2]))
}
