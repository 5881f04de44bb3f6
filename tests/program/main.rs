//! The program, run as a user runs it.

mod as_built;
mod building;
mod check;
mod converting;
mod footprint;
mod forming;
mod inspecting;
mod jigs;
mod labels;
mod order;
mod papers;
mod patterns;
mod refusals;
mod relaxing;
mod run;
mod samples;
mod sawing;
mod sizes;
mod statics;
mod strips;
mod tiles;
mod tolerance;
mod viewer;
