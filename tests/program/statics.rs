//! The statics of samples, by the program.

use super::run::{build_sample, rodwright};
