//! A weave becomes a frame: rods straight, who goes over, contacts closed, rods cut and
//! checked.

use super::assemble::{Ground, assemble};
use super::axis::Axis;
use super::circuits::circuits;
use super::clash::clashes;
use super::close::bounds::Limits;
use super::close::marks::Marks;
use super::close::{CloseError, Closing, Task, Way, close};
use super::cut::disorder;
use super::fault::Fault;
use super::formed::{FormSettings, Formed};
use super::gaps::Joint;
use super::layer::layer;
use super::lift::{Lifted, Parallel, lift};
use super::share::{Share, Shared, share};
use super::sizes::{Sizes, gap_between};
use super::trim::{Lengths, Trimmed, Trimming, trim};
use super::weave::{RodEnd, Weave, WovenContact, WovenRod};
use super::{ContactKind, Frame};
use crate::ids::{ContactId, IdVec, RodId};
use crate::linalg::LinalgError;
use crate::surface::Point3;
use std::collections::BTreeSet;

/// Least distance between two contacts along a rod, in diameters. Nearer, and
/// there is no room for the two rods side by side.
pub const ENGAGEMENT: f64 = 1.0;

/// How far rod ends may move in the mean for the shape of units, in diameters: a frame that
/// stays near what was lifted lies on the surface, and looks as it was drawn.
const ROAM: f64 = 1.25;

/// Rounds of closing and cutting rods that taper before giving up. Tapers of some hundredths
/// take seven to ten.
const MOST_ROUNDS: usize = 40;

/// Longest piece added to a rod so that it stands on the ground, in tile edges.
const REACH: f64 = 1.5;

/// The frame of a weave, or what is wrong with which of its units. `edge` is the mean tile
/// edge, mm.
///
/// # Errors
/// Contacts that contradict each other.
pub fn finish(
    weave: &Weave,
    edge: f64,
    settings: &FormSettings,
    sizes: Sizes,
) -> Result<Result<Formed, Vec<Fault>>, LinalgError> {
    let lifted = match lift(weave) {
        Ok(lifted) => lifted,
        Err(Parallel(unit)) => {
            return Ok(Err(vec![Fault { units: vec![unit], reason: "has parallel rods".into() }]));
        }
    };
    let rises = lifted.rises(weave);
    let &FormSettings { diameter, overhang, round, surface_low, .. } = settings;
    let how = Trimming { overhang, reach: REACH * edge, surface_low, sizes: &sizes };
    let gaps = first_gaps(weave, &lifted, &how, round);
    let resting = joints(weave, &rises.iter().map(|_| true).collect(), &gaps);
    let over = match layer(&lifted.axes, &resting, &rises, settings.layering) {
        Ok(over) => over,
        Err(c) => return Ok(Err(vec![open_contact(weave, c)])),
    };
    let joints = joints(weave, &over, &gaps);
    let lifted_middles = lifted.middles(weave);
    let (axes, middles, share) = (&lifted.axes, &lifted_middles, settings.share);
    let start = Start { weave, lifted: axes, middles, joints, how, round, share, edge, diameter };
    Ok(start.best(settings.way)?.map(|Closed { frame, shared, closing, moves }| Formed {
        frame,
        shared,
        tiles: weave.units.iter().map(|unit| unit.tile).collect(),
        closing,
        moves,
        ending_over: over,
        rises,
        lifted_middles,
    }))
}

/// Lifted rods of which it is known who goes over.
struct Start<'a> {
    weave: &'a Weave,
    lifted: &'a IdVec<RodId, Axis>,
    /// The contacts as lifted, mm.
    middles: &'a IdVec<ContactId, Point3>,
    joints: IdVec<ContactId, Joint>,
    how: Trimming<'a>,
    round: f64,
    share: Share,
    edge: f64,
    diameter: f64,
}

/// A frame that is closed and cut.
struct Closed {
    frame: Frame,
    shared: Option<Shared>,
    closing: Closing,
    /// How far rod ends moved, mm.
    moves: Vec<f64>,
}

impl Start<'_> {
    /// Closed in a way. Where that leads into trouble, by the least move, and at last by the
    /// least move alone: bounds that contradict contacts do more harm than good. Of several
    /// troubles, the least.
    fn best(&self, way: Way) -> Result<Result<Closed, Vec<Fault>>, LinalgError> {
        let mut least: Option<Vec<Fault>> = None;
        let ways = match way {
            Way::Shape => &[(Way::Shape, true), (Way::Least, true), (Way::Least, false)][..],
            Way::Least => &[(Way::Least, true), (Way::Least, false)],
            Way::Paper => &[(Way::Paper, true)],
        };
        for &(way, bounded) in ways {
            match self.closed(way, bounded)? {
                Ok(closed) => return Ok(Ok(closed)),
                Err(faults) if least.as_ref().is_none_or(|f| faults.len() < f.len()) => {
                    least = Some(faults);
                }
                Err(_) => {}
            }
        }
        Ok(Err(least.unwrap_or_default()))
    }

    fn closed(&self, way: Way, bounded: bool) -> Result<Result<Closed, Vec<Fault>>, LinalgError> {
        let mut axes = self.lifted.clone();
        let mut joints = self.joints.clone();
        let (closing, trimmed) = match self.close_to_size(&mut axes, &mut joints, way, bounded)? {
            Ok(done) => done,
            Err(faults) => return Ok(Err(faults)),
        };
        let moves =
            self.lifted.iter().zip(axes.iter()).flat_map(|(old, new)| old.moves_to(new)).collect();
        let made = checked(self.weave, trimmed, &joints, self.how.sizes, self.share);
        Ok(made.map(|(frame, shared)| Closed { frame, shared, closing, moves }))
    }

    /// Closes the axes and cuts them to length; where rods taper, again until every gap is
    /// that of the rods where they touch.
    fn close_to_size(
        &self,
        axes: &mut IdVec<RodId, Axis>,
        joints: &mut IdVec<ContactId, Joint>,
        mut way: Way,
        bounded: bool,
    ) -> Result<Result<(Closing, Trimmed), Vec<Fault>>, LinalgError> {
        let weave = self.weave;
        let (circuits, limits) = (circuits(weave, self.middles), self.limits());
        let mut lengths = Lengths::new(self.round);
        let mut unsettled = Vec::new();
        let mut first = None;
        for _ in 0..MOST_ROUNDS {
            let (limits, edge) = (bounded.then_some(&limits), self.edge);
            let roam = Some(ROAM * self.diameter);
            let task =
                Task { joints, circuits: &circuits, limits, marks: Marks::default(), roam, edge };
            let open = |c| open_contact(weave, c);
            let closing = match close(axes, &task, way) {
                Ok(closing) => closing,
                Err(CloseError::Linear(e)) => return Err(e),
                Err(CloseError::Parallel(c)) => return Ok(Err(vec![open(c)])),
                Err(CloseError::Diverged { open: all }) => {
                    return Ok(Err(all.into_iter().map(open).collect()));
                }
            };
            // What comes after the first round is next to nothing.
            let Closing { error, .. } = closing;
            let closing = Closing { error, ..*first.get_or_insert(closing) };
            if way == Way::Shape {
                way = Way::Least;
            }
            let trimmed = match trim(weave, axes, joints, &self.how, &mut lengths) {
                Ok(trimmed) => trimmed,
                Err(fault) => return Ok(Err(vec![fault])),
            };
            unsettled = self.how.sizes.refit(joints, &trimmed.diameters);
            if unsettled.is_empty() {
                return Ok(Ok((closing, trimmed)));
            }
        }
        let fault = |c: ContactId| Fault {
            units: vec![weave.contacts[c].unit],
            reason: "its rods taper so much that the places where they touch do not settle".into(),
        };
        Ok(Err(unsettled.into_iter().map(fault).collect()))
    }

    /// What closing has to keep: the frame is cut and checked for it afterwards.
    fn limits(&self) -> Limits {
        let Self { weave, how, .. } = self;
        let beyond = |end| if end == RodEnd::Meets { 0.0 } else { how.overhang + self.round / 2.0 };
        let beside = |rod: RodId, c: ContactId| {
            let WovenContact { ending, passing, .. } = weave.contacts[c];
            how.sizes.middle(if ending == rod { passing } else { ending })
        };
        let room = |(rod, woven): (RodId, &WovenRod)| {
            let between = |pair: &[ContactId]| {
                ENGAGEMENT * gap_between([pair[0], pair[1]].map(|c| beside(rod, c)))
            };
            woven.contacts.windows(2).map(between).collect()
        };
        Limits {
            along: weave.rods.iter().map(|rod| rod.contacts.clone()).collect(),
            room: weave.rods.enumerate().map(room).collect(),
            beyond: weave.rods.iter().map(|rod| rod.ends.map(beyond)).collect(),
            thickness: how.sizes.ends.iter().map(|[a, b]| a.max(*b)).collect(),
            diameter: self.diameter,
        }
    }
}

/// The gaps of all contacts before it is known who goes over. Where rods taper, the contacts
/// lie about where they do before closing.
fn first_gaps(weave: &Weave, lifted: &Lifted, how: &Trimming, round: f64) -> IdVec<ContactId, f64> {
    let between =
        |c: &WovenContact| gap_between([c.ending, c.passing].map(|r| how.sizes.middle(r)));
    let midway = weave.contacts.iter().map(between).collect();
    if !how.sizes.are_tapered() {
        return midway;
    }
    let resting = joints(weave, &weave.contacts.iter().map(|_| true).collect(), &midway);
    // What is wrong here comes out again when the contacts are closed.
    trim(weave, &lifted.axes, &resting, how, &mut Lengths::new(round))
        .map_or(midway, |trimmed| trimmed.diameters.iter().copied().map(gap_between).collect())
}

fn open_contact(weave: &Weave, contact: ContactId) -> Fault {
    let units = vec![weave.contacts[contact].unit];
    Fault { units, reason: "two of its rods could not be brought to touch".into() }
}

fn joints(
    weave: &Weave,
    ending_over: &IdVec<ContactId, bool>,
    gaps: &IdVec<ContactId, f64>,
) -> IdVec<ContactId, Joint> {
    weave
        .contacts
        .enumerate()
        .map(|(id, c)| {
            let (over, under) =
                if ending_over[id] { (c.ending, c.passing) } else { (c.passing, c.ending) };
            let kind = match c.kind {
                ContactKind::End([ending, passing]) if over == c.passing => {
                    ContactKind::End([passing, ending])
                }
                kind => kind,
            };
            Joint { over, under, outward: c.on.normal, diameter: gaps[id], kind }
        })
        .collect()
}

/// Checks the rods, lets them share lengths, and puts the frame together.
fn checked(
    weave: &Weave,
    mut trimmed: Trimmed,
    joints: &IdVec<ContactId, Joint>,
    sizes: &Sizes,
    how: Share,
) -> Result<(Frame, Option<Shared>), Vec<Fault>> {
    let Trimmed { along, cut, diameters, .. } = &trimmed;
    // The rods that lie beside each other on a rod have to have room there.
    let beside = |rod, c: ContactId| diameters[c][usize::from(joints[c].over == rod)];
    let room = |rod, pair: [ContactId; 2]| ENGAGEMENT * gap_between(pair.map(|c| beside(rod, c)));
    let faults = disorder(weave, along, room);
    if !faults.is_empty() {
        return Err(faults);
    }
    let pairs: BTreeSet<[RodId; 2]> =
        joints.iter().map(|j| [j.over.min(j.under), j.over.max(j.under)]).collect();
    let faults = clash_faults(weave, cut, &sizes.ends, &pairs);
    if !faults.is_empty() {
        return Err(faults);
    }
    let shared = share(how, weave, &mut trimmed, &sizes.ends, &pairs);
    let Trimmed { axes, ground, supports, .. } = trimmed;
    let on = Ground { sizes: sizes.clone(), ground, supports };
    let frame = assemble(weave, &axes, joints, on).map_err(|fault| vec![fault])?;
    Ok((frame, shared))
}

fn clash_faults(
    weave: &Weave,
    axes: &IdVec<RodId, Axis>,
    sizes: &IdVec<RodId, [f64; 2]>,
    pairs: &BTreeSet<[RodId; 2]>,
) -> Vec<Fault> {
    clashes(axes, sizes, pairs)
        .iter()
        .map(|clash| {
            let units = clash.rods.iter().flat_map(|&r| weave.rods[r].units.clone()).collect();
            let reason = format!(
                "one of its rods would run into another: their axes pass at {:.2} mm",
                clash.distance
            );
            Fault { units, reason }
        })
        .collect()
}
