//! What the statics of a frame found, for programs.

mod figures;
mod json;

pub use figures::{StaticsFigures, StiffenedFigures, TriedFigures, statics_figures};
pub use json::statics_json;
