//! Writers: one file a format.

pub mod assembly;
pub mod convert;
pub mod cutlist;
pub mod dxf;
mod figure;
pub mod file;
pub mod folder;
pub mod glb;
mod json;
pub mod obj;
pub mod off;
pub mod ply;
pub mod report;
mod rod_shape;
pub mod rods;
pub mod statics;
pub mod stl;
pub mod structure;
pub mod tables;
