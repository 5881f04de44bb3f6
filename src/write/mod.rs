//! Writers: one file a format.

pub mod cutlist;
mod figure;
mod json;
pub mod obj;
pub mod structure;
pub mod tables;
