//! Writers: one file a format.

mod figure;
mod json;
pub mod obj;
pub mod structure;
