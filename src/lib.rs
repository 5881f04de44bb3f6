//! Reciprocal frames from sticks: a surface in, everything needed to build it out.
//!
//! A *reciprocal frame* is a structure of rods that carry each other in closed circuits.
//! This crate covers a surface with one, makes every contact between two rods exact,
//! and draws the papers for the workshop. Lengths are mm, angles radians, z is up.
//!
//! ```
//! use rodwright::chart::{Method, PlanarChart};
//! use rodwright::frame::{canvas::PlaneCanvas, close::Way, fit::fit, layer::Layering};
//! use rodwright::frame::form::{FormSettings, form};
//! use rodwright::surface::{samples::sample, topology::require_disk};
//! use rodwright::{pattern::Pattern, tiling::Placement};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let dome = sample("igloo").ok_or("no such sample")?;
//! let chart = PlanarChart::new(dome.clone(), &require_disk(&dome)?, Method::Abf)?;
//! let pattern = Pattern::named("4.4.4.4").ok_or("no such pattern")?;
//! let (rod, shape) = (3.0, pattern.usual());
//! let start = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 20.0 * rod };
//! let edge = fit(&chart, pattern, &start, shape, rod)?.edge;
//! let settings = FormSettings {
//!     diameter: rod, sizes: Default::default(), overhang: 6.0, round: 0.5,
//!     share: Default::default(),
//!     layering: Layering::Auto, way: Way::default(), surface_low: 0.0,
//! };
//! let canvas = PlaneCanvas::new(&chart, pattern, Placement { edge, ..start }, shape)?;
//! let frame = form(&canvas, &settings)?.frame;
//! assert!(frame.contacts.iter().all(|c| (c.gap - rod).abs() < 1e-9 * rod));
//! # Ok(())
//! # }
//! ```
//!
//! The whole way from a design to a model is [`pipeline`]; what is written of the model,
//! [`documents`].

pub mod chart;
pub mod cli;
pub mod design;
pub mod documents;
pub mod drawing;
pub mod frame;
pub mod ids;
pub mod linalg;
pub mod parallel;
pub mod pattern;
pub mod pipeline;
pub mod sheets;
pub mod shop;
pub mod statics;
pub mod surface;
pub mod tiling;
pub mod units;
pub mod write;
