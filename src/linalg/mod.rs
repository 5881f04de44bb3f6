//! Sparse symmetric positive definite systems, a thin layer over faer.
//!
//! The matrix is a sum of small dense blocks (one a triangle, one a rod). Its
//! pattern is analysed once; values are filled in and factored as often as needed.

mod cholesky;
mod cover;
mod cut;
mod dissection;
mod halves;
mod pattern;
mod solver;

pub use cholesky::Cholesky;
pub use pattern::LowerPattern;
pub use solver::{BlockSolver, SpdSolver, block_entries};

use thiserror::Error;

/// Why a linear system could not be solved.
#[derive(Error, Debug, Clone, PartialEq)]
pub enum LinalgError {
    /// The matrix has a direction without stiffness; the row where it showed.
    #[error("the system of {size} unknowns is singular or nearly so at unknown {row}")]
    NotPositiveDefinite { size: usize, row: usize },
    /// More entries than memory or index range allows.
    #[error("the system of {size} unknowns is too large")]
    TooLarge { size: usize },
}
