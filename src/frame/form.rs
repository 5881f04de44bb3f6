//! From a placed pattern to a finished frame; what does not work is left out, one
//! unit at a time, and the rest is solved again (paper, section 4.2 and Fig. 21).

use super::Dropped;
use super::canvas::{Canvas, Sizing};
use super::crop::{crop, held};
use super::fault::{Fault, cover};
use super::finish::{ENGAGEMENT, finish};
pub use super::formed::{FormSettings, Formed};
use super::layer::Layering;
use super::lift::{Parallel, lift};
use super::sizes::{Sizes, gap_between};
use super::weave::{Weave, WovenContact, weave};
use crate::ids::{ContactId, Id, RodId, TileId};
use crate::linalg::LinalgError;
use thiserror::Error;

/// Why there is no frame.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum FormError {
    /// Hardly a unit fits the surface.
    #[error(
        "only {units} units of edge {edge:.1} mm fit the surface, and a frame needs at least \
         {least}. Use {smaller}, thinner rods (--rod) or a larger model (--span)"
    )]
    TooFewUnits { units: usize, least: usize, edge: f64, smaller: &'static str },
    /// The units that a surface has are too small for the rods.
    #[error(
        "units of edge {edge:.1} mm are too small for {diameter} mm rods, which need some \
         {least:.0} mm. Use {larger}, or rods of at most {suits:.1} mm (--rod)"
    )]
    TooSmall { edge: f64, diameter: f64, least: f64, suits: f64, larger: &'static str },
    /// The units have no room for the rods.
    #[error(
        "units of edge {edge:.1} mm are too small for {diameter} mm rods: the contacts of a unit \
         of {sides} rods would lie {apart:.1} mm apart. Use {larger}, with an edge of at least \
         {least:.1} mm, a larger turn (--turn) or thinner rods (--rod)"
    )]
    TooTight {
        edge: f64,
        diameter: f64,
        sides: usize,
        apart: f64,
        least: f64,
        larger: &'static str,
    },
    /// Too much had to be left out.
    #[error(
        "{dropped} of {total} units of edge {edge:.1} mm do not work with {diameter} mm rods; the \
         first: {first}. Try {}{other}, another turn (--turn) or a shorter overhang (--overhang)",
        .fitting.map_or_else(String::new, |fitting| format!("{fitting}, "))
    )]
    TooManyDropped {
        dropped: usize,
        total: usize,
        edge: f64,
        diameter: f64,
        first: String,
        fitting: Option<&'static str>,
        other: &'static str,
    },
    /// A rod is given a diameter and is not there.
    #[error(
        "a diameter is given for rod {rod}, but the frame has {rods} rods: the last one is {last}. \
         Give the number of a rod that is there, or leave {rod} out"
    )]
    NoSuchRod { rod: RodId, rods: usize, last: RodId },
    /// Rods have more contacts than they can meet.
    #[error(
        "{contacts} contacts are more than {rods} straight rods can meet at once. Use a pattern \
         whose rods touch fewer others (join, reach, inner)"
    )]
    TooManyContacts { contacts: usize, rods: usize },
    /// A linear system could not be solved.
    #[error("the contacts could not be closed: {0}")]
    Linear(#[from] LinalgError),
}

/// Fewest units that make a frame: three, so that a rod can lie between two.
const LEAST_UNITS: usize = 3;

/// Largest part of the units that may be left out before the whole is refused.
/// More, and what remains is not the surface that was asked for.
const DROPPED_PART: f64 = 0.2;

/// Units are left out one at a time, since each loss relieves its neighbours; of very
/// many, one more at a time for each so many.
const AT_ONCE: usize = 40;

/// Builds a frame on a canvas.
///
/// Where [`Layering::Auto`] leaves units out, [`Layering::Follow`] is tried too, and the one
/// that leaves out fewer is taken: the least move may bring rods near each other.
///
/// # Errors
/// [`FormError`] when too few units fit, or too many fail.
pub fn form(canvas: &impl Canvas, settings: &FormSettings) -> Result<Formed, FormError> {
    let formed = form_layered(canvas, settings);
    let lost = |made: &Result<Formed, FormError>| {
        made.as_ref().map_or(usize::MAX, |formed| formed.frame.dropped.len())
    };
    if settings.layering != Layering::Auto || lost(&formed) == 0 {
        return formed;
    }
    let follow = FormSettings { layering: Layering::Follow, ..settings.clone() };
    let following = form_layered(canvas, &follow);
    if lost(&following) < lost(&formed) { following } else { formed }
}

fn form_layered(canvas: &impl Canvas, settings: &FormSettings) -> Result<Formed, FormError> {
    let mut held = held(canvas);
    let mut dropped: Vec<Dropped> = Vec::new();
    let mut total = None;
    loop {
        let tiles = crop(canvas, &held);
        if tiles.len() < LEAST_UNITS {
            // Where one large unit held the others together, they go with it.
            return Err(match (dropped.first(), total) {
                (Some(first), Some(all)) => {
                    too_many(all - tiles.len(), all, &first.reason, canvas, settings)
                }
                _ => too_few(tiles.len(), canvas),
            });
        }
        let all = *total.get_or_insert(tiles.len());
        let lost = |more: usize| (dropped.len() + more) as f64 > DROPPED_PART * all as f64;
        let failing = match attempt(canvas, &tiles, settings)? {
            Ok(mut formed) => {
                formed.frame.dropped = dropped;
                return Ok(formed);
            }
            Err(failing) => failing,
        };
        if lost(failing.all.len()) || tiles.len() <= LEAST_UNITS {
            let dropped = dropped.len() + failing.all.len();
            return Err(too_many(dropped, all, &failing.all[0].1, canvas, settings));
        }
        let at_once = failing.at_once.unwrap_or(1 + (dropped.len() + failing.all.len()) / AT_ONCE);
        for (tile, reason) in failing.all.into_iter().take(at_once) {
            held[tile] = false;
            let center = canvas.place(tile, canvas.middle(tile));
            dropped.push(Dropped {
                center: center.map_or_else(Default::default, |c| c.position),
                reason,
            });
        }
    }
}

/// Tiles without which the rest may work, each with its reason.
struct Failing {
    all: Vec<(TileId, String)>,
    /// How many to leave out before the next try; by default a few.
    at_once: Option<usize>,
}

fn too_few(units: usize, canvas: &impl Canvas) -> FormError {
    let Sizing { smaller, .. } = canvas.sizing();
    FormError::TooFewUnits { units, least: LEAST_UNITS, edge: canvas.edge(), smaller }
}

fn too_many(
    dropped: usize,
    total: usize,
    first: &str,
    canvas: &impl Canvas,
    settings: &FormSettings,
) -> FormError {
    let Sizing { fitting, other, .. } = canvas.sizing();
    FormError::TooManyDropped {
        dropped,
        total,
        edge: canvas.edge(),
        diameter: settings.diameter,
        first: first.to_string(),
        fitting: Some(fitting),
        other,
    }
}

/// Contacts for each rod from which contradictions are put down to their number. A straight
/// line has four freedoms, so four could be met, but for what neighbours already hold.
const CROWDED: usize = 3;

/// Why the equations of the contacts have no solution.
fn unsolved(weave: &Weave, e: LinalgError) -> FormError {
    let (contacts, rods) = (weave.contacts.len(), weave.rods.len());
    if contacts > CROWDED * rods { FormError::TooManyContacts { contacts, rods } } else { e.into() }
}

/// Refuses units whose contacts lie nearer together than the rods are thick, where
/// they are too many to be left out.
fn require_room(canvas: &impl Canvas, weave: &Weave, sizes: &Sizes) -> Result<(), FormError> {
    let (edge, diameter) = (canvas.edge(), sizes.nominal);
    let apart = |rod: RodId, pair: &[ContactId]| {
        let [a, b] = [pair[0], pair[1]].map(|c| &weave.contacts[c]);
        let partner = |c: &WovenContact| if c.ending == rod { c.passing } else { c.ending };
        // As far apart as they would be with rods of the nominal diameter beside each other.
        let part = diameter / gap_between([a, b].map(|c| sizes.middle(partner(c))));
        (a.unit == b.unit).then(|| (a.unit, (a.on.position - b.on.position).norm() * part))
    };
    let mut sides: Vec<(f64, usize)> =
        weave.units.iter().map(|unit| (f64::INFINITY, unit.sides)).collect();
    for (r, rod) in weave.rods.enumerate() {
        for (unit, apart) in rod.contacts.windows(2).filter_map(|pair| apart(r, pair)) {
            let least = &mut sides[unit.index()].0;
            *least = least.min(apart);
        }
    }
    sides.sort_by(|p, q| p.0.total_cmp(&q.0));
    let (apart, sides) = sides[(DROPPED_PART * sides.len() as f64) as usize];
    if apart >= ENGAGEMENT * diameter {
        return Ok(());
    }
    let least = edge * ENGAGEMENT * diameter / apart;
    let Sizing { larger, .. } = canvas.sizing();
    Err(FormError::TooTight { edge, diameter, sides, apart, least, larger })
}

/// One try at a frame: the frame, or which tiles fail.
fn attempt(
    canvas: &impl Canvas,
    tiles: &[TileId],
    settings: &FormSettings,
) -> Result<Result<Formed, Failing>, FormError> {
    let weave = match weave(canvas, tiles) {
        Ok(weave) => weave,
        Err(failed) => {
            let all: Vec<_> = failed.into_iter().map(|f| (f.tile, f.reason.into())).collect();
            let at_once = Some(all.len());
            return Ok(Err(Failing { all, at_once }));
        }
    };
    let sizes = sizes(&weave, settings)?;
    require_room(canvas, &weave, &sizes)?;
    let tile_of = |(unit, reason)| (weave.units[unit].tile, reason);
    let failing = |faults: Vec<Fault>| Failing {
        all: cover(&faults).into_iter().map(tile_of).collect(),
        at_once: None,
    };
    let finished = finish(&weave, canvas.edge(), settings, sizes);
    Ok(finished.map_err(|e| unsolved(&weave, e))?.map_err(failing))
}

/// How thick the rods of a weave are.
fn sizes(weave: &Weave, settings: &FormSettings) -> Result<Sizes, FormError> {
    let rods = weave.rods.len();
    Sizes::new(weave, &settings.sizes, settings.diameter).map_err(|rod| FormError::NoSuchRod {
        rod,
        rods,
        last: RodId::new(rods - 1),
    })
}

/// The number of units that a canvas would have, and their median rise, mm: what
/// fitting looks at.
///
/// # Errors
/// [`FormError::TooFewUnits`].
pub fn median_rise(canvas: &impl Canvas) -> Result<(usize, f64), FormError> {
    let mut held = held(canvas);
    loop {
        let tiles = crop(canvas, &held);
        if tiles.len() < LEAST_UNITS {
            return Err(too_few(tiles.len(), canvas));
        }
        let failed: Vec<TileId> = match weave(canvas, &tiles) {
            Err(failed) => failed.into_iter().map(|f| f.tile).collect(),
            Ok(weave) => match lift(&weave) {
                Err(Parallel(unit)) => vec![weave.units[unit].tile],
                Ok(lifted) => {
                    let rises = lifted.rises(&weave);
                    let mut sizes: Vec<f64> =
                        rises.iter().flatten().map(|rise| rise.abs()).collect();
                    sizes.sort_by(f64::total_cmp);
                    return Ok((tiles.len(), sizes[sizes.len() / 2]));
                }
            },
        };
        failed.into_iter().for_each(|tile| held[tile] = false);
    }
}
