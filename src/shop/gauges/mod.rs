//! Gauges for the bench, cut by laser: to mark rods, to set angles and saw stops, to sort sticks
//! by diameter, and to find how wide the laser cuts.

mod angles;
mod coupon;
mod diameter;
mod marking;
mod stops;

pub use angles::{AngleGroup, angle_gauges, angle_groups};
pub use coupon::coupon;
pub use diameter::diameter_gauges;
pub use marking::{Marking, marking_gauges};
pub use stops::stop_blocks;
