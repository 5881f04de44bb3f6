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

pub use board::{Board, Curve, Point, rectangle};
pub use letters::{Lettering, width_of};
pub use material::Material;
pub use nest::{GAP, MARGIN, Nest, REFERENCE, Spot, nest, room};
pub use offset::{area, offset};
