//! Writers: one file a format.

pub mod cutlist;
mod figure;
pub mod folder;
pub mod glb;
mod json;
pub mod obj;
pub mod report;
pub mod structure;
pub mod tables;
