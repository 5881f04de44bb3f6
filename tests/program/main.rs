//! The program, run as a user runs it.

mod building;
mod check;
mod refusals;
mod run;
