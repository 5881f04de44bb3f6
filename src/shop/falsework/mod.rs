//! Falsework: a base plate with a prop under every unit, cut by laser, that holds the rods in
//! their places until the frame carries itself.
//!
//! The plate lies on the table, and its upper side is the ground. Every prop is a board
//! across its rod with a saddle on top; it stands in two slots of the plate, and the taller ones
//! have a brace that crosses them. The frame is lifted off when it is closed.

mod boards;
mod choose;
mod clear;
mod marks;
mod plate;
mod stand;

#[cfg(test)]
mod tests;

pub use choose::Choice;
pub use plate::{PlateError, Seams};
pub use stand::{Shape, Stand};

use super::Assembly;
use super::laser::Board;
use crate::frame::Frame;

/// The falsework of a frame.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Falsework {
    /// Where props stand, and what has none.
    pub choice: Choice,
    /// The pieces of the plate, then props and braces.
    pub boards: Vec<Board>,
}

/// The falsework of a frame, from board so thick that comes in sheets of this width and height,
/// mm.
///
/// # Errors
/// [`PlateError`] where the plate would be too large for a laser.
pub fn falsework(
    frame: &Frame,
    assembly: Option<&Assembly>,
    sheet: [f64; 2],
    thickness: f64,
) -> Result<Falsework, PlateError> {
    let seams = Seams::of(frame, sheet, thickness)?;
    let choice = choose::choose(frame, assembly, &seams, thickness);
    let mut boards = marks::plate(frame, &seams, &choice.stands, thickness);
    for (stand, shape) in &choice.stands {
        boards.push(boards::prop(stand, shape, thickness));
        boards.extend(boards::brace(stand, shape, thickness));
    }
    Ok(Falsework { choice, boards })
}
