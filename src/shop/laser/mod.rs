//! Parts that a laser cuts from flat board: their outlines, the width of the cut, and their
//! places on sheets.
//!
//! A [`Board`] is drawn at the size that it is to have. What the laser follows is wider by half
//! the cut outside, and narrower inside: [`Board::compensated`]. Lengths in mm, y up, seen from
//! the side that is marked.

mod board;
mod letters;
mod material;
mod nest;
mod offset;
mod ring;

pub use board::{Board, Curve, Point};
pub use letters::{Lettering, height_of, width_of};
pub use material::Material;
pub use nest::{GAP, MARGIN, Nest, REFERENCE, Spot, nest, room};
pub use offset::offset;
pub use ring::{area, bounds, holds, rectangle};
