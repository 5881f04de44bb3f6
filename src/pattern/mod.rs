//! RF-units and the pattern library (paper, section 3).

mod library;
mod unit;

pub use library::{LIBRARY, Pattern};
pub use unit::{FlatUnit, Line};
