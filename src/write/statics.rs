//! What the statics of a frame found, for programs.

mod deck;
mod figures;
#[cfg(test)]
mod fixture;
pub mod inp;
mod json;
pub mod mac;

pub use figures::{StaticsFigures, StiffenedFigures, TriedFigures, statics_figures};
pub use json::statics_json;
