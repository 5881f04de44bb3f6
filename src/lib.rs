//! Reciprocal frames from sticks.

pub mod chart;
pub mod drawing;
pub mod frame;
pub mod ids;
pub mod linalg;
pub mod pattern;
pub mod sheets;
pub mod shop;
pub mod surface;
pub mod tiling;
pub mod units;
pub mod write;
