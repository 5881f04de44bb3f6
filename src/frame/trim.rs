//! Closed axes become rods: cut to length, and let down to the ground.

use super::Support;
use super::axis::Axis;
use super::cut::{Seat, Steps, crossings, cut, seats};
use super::fault::Fault;
use super::gaps::Joint;
use super::sizes::Sizes;
use super::stand::{Standing, ground_level, stand};
use super::weave::Weave;
use crate::ids::{ContactId, IdVec, RodId};
use std::collections::BTreeSet;

/// How rods are cut. Lengths in mm.
#[derive(Clone, Copy, Debug)]
pub struct Trimming<'a> {
    /// Rod left beyond its last contact.
    pub overhang: f64,
    /// Longest piece that may be added to a rod so that it stands.
    pub reach: f64,
    /// The lowest height of the surface.
    pub surface_low: f64,
    /// How thick the rods are.
    pub sizes: &'a Sizes,
}

/// Rods as they are cut.
#[derive(Clone, Debug)]
pub struct Trimmed {
    /// The contacts along each closed axis.
    pub along: IdVec<RodId, Vec<Seat>>,
    /// The axes cut at their outermost contacts and the overhang.
    pub cut: IdVec<RodId, Axis>,
    /// The same, some of them let down to the ground.
    pub axes: IdVec<RodId, Axis>,
    /// The diameters of the over and the under rod at every contact, mm.
    pub diameters: IdVec<ContactId, [f64; 2]>,
    /// Height of the ground, mm.
    pub ground: f64,
    /// The rods that reach it.
    pub supports: Vec<Support>,
}

/// The lengths of rods as they are cut, and as they are let down.
#[derive(Clone, Debug)]
pub struct Lengths {
    cut: Steps,
    standing: Steps,
    /// The rods that stood in the last try. Others are not let down any more: one that just
    /// reaches the ground, and no longer does when it is as thick as that makes it, would
    /// otherwise go up and down.
    stood: Option<BTreeSet<RodId>>,
}

impl Lengths {
    /// Multiples of `round` mm; 0 for any length.
    pub fn new(round: f64) -> Self {
        Self { cut: Steps::new(round), standing: Steps::new(round), stood: None }
    }
}

/// Cuts closed axes to length and lets those at the border stand. `lengths` are those of an
/// earlier try, which are kept where they will do.
///
/// # Errors
/// The unit of a contact whose rods are parallel.
pub fn trim(
    weave: &Weave,
    closed: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    how: &Trimming,
    lengths: &mut Lengths,
) -> Result<Trimmed, Fault> {
    let along = seats(closed.len(), joints, &crossings(weave, closed, joints)?);
    let cut: IdVec<RodId, Axis> = closed
        .enumerate()
        .map(|(r, axis)| {
            let length = |least| lengths.cut.length(r, least);
            cut(axis, weave.rods[r].ends, &along[r], how.overhang, length)
        })
        .collect();
    let ground = ground_level(how.surface_low, &cut);
    let mut axes = cut.clone();
    let among = lengths.stood.as_ref();
    let standing = Standing { ground, reach: how.reach, sizes: &how.sizes.ends, among };
    let supports = stand(weave, &mut axes, &standing, &mut lengths.standing);
    lengths.stood = Some(supports.iter().map(|support| support.rod).collect());
    let diameters = how.sizes.at_contacts(weave, &axes, joints)?;
    Ok(Trimmed { along, cut, axes, diameters, ground, supports })
}
