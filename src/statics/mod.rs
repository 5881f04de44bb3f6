//! What a frame carries: its rods as beams, its contacts as stiff joints, its feet on the
//! ground. First order, linear; no buckling, no slip.

pub mod along;
pub mod beam;
#[cfg(test)]
pub(crate) mod fixture;
pub mod framework;
pub mod freedom;
pub mod goal;
pub mod joint;
pub mod load;
pub mod loose;
pub mod material;
mod meshes;
pub mod model;
pub mod section;
pub mod solve;
mod start;
pub mod stress;
pub mod study;
mod system;
#[cfg(test)]
mod tests;
pub mod wish;
