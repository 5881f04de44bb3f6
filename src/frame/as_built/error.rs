//! Why a frame cannot be made with what was measured.

use crate::frame::Frame;
use crate::frame::gaps::Joint;
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::linalg::LinalgError;
use thiserror::Error;

/// Why a frame cannot be made with what was measured. Lengths in mm.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum AsBuiltError {
    /// A row does not fit the frame.
    #[error("line {line}: {problem}")]
    Row { line: u64, problem: String },
    /// Contacts stay open.
    #[error(
        "with these measurements {rods} can no longer be brought to touch ({contact}{more}). \
         Check the rows of these rods and of those beside them"
    )]
    Open { contact: ContactId, rods: String, more: String },
    /// Rods that taper do not settle.
    #[error(
        "with these measurements the place where {rods} touch ({contact}) does not settle. Check \
         their diameters"
    )]
    Unsettled { contact: ContactId, rods: String },
    /// A contact comes to lie beyond the stick, or too near to its end.
    #[error(
        "{rod} is too short: its contact with {mate} ({contact}) would lie {left:.1} mm from end \
         {end}, and {least:.1} mm is the least. Saw a new stick for {rod} and leave its rows out"
    )]
    FallsOff {
        rod: RodId,
        mate: RodId,
        contact: ContactId,
        end: &'static str,
        left: f64,
        least: f64,
    },
    /// Two rods on a third have no room beside each other.
    #[error(
        "with these measurements {first} and {second} would lie {apart:.1} mm apart on {rod}, and \
         they need {needed:.1} mm. Check the rows of {rod}, or saw and mark it anew and leave \
         them out"
    )]
    NoRoom { rod: RodId, first: RodId, second: RodId, apart: f64, needed: f64 },
    /// Rods run into each other.
    #[error(
        "with these measurements {} would run into {}: their axes pass at {distance:.1} mm. Check \
         the rows of both and of the rods that they touch",
        rods[0], rods[1]
    )]
    Clash { rods: [RodId; 2], distance: f64 },
    /// A linear system could not be solved.
    #[error("the contacts could not be closed with these measurements: {0}")]
    Linear(LinalgError),
}

impl AsBuiltError {
    pub(super) fn open(joints: &IdVec<ContactId, Joint>, open: &[ContactId]) -> Self {
        let contact = open.first().copied().unwrap_or(ContactId::new(0));
        let joint = &joints[contact];
        let more = match open.len().saturating_sub(1) {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        Self::Open { contact, rods: format!("{} and {}", joint.over, joint.under), more }
    }

    pub(super) fn unsettled(plan: &Frame, contact: ContactId) -> Self {
        let c = &plan.contacts[contact];
        Self::Unsettled { contact, rods: format!("{} and {}", c.over, c.under) }
    }
}
