//! Reciprocal frames from sticks.

pub mod drawing;
pub mod ids;
pub mod surface;
