//! Form finding as a whole: what every frame keeps to, whatever the surface and the design.

mod case;
mod motion;
mod random;
mod refinement;
mod rules;
