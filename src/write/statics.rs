//! What the statics of a frame found, for programs.

mod json;

pub use json::statics_json;
