//! Which rod of each contact goes over the other (paper, section 4.2 and Fig. 4).

use crate::ids::{ContactId, IdVec};
use serde::{Deserialize, Serialize};

/// The rule by which over and under are chosen.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Layering {
    /// The rod that lies higher after the lift goes over: the frame follows the surface.
    #[default]
    Follow,
    /// Every rod ends on top of the next one, all round every unit.
    Reciprocal,
}

/// For every contact, whether the ending rod goes over the passing one; `rises`
/// holds the height of the ending rod over the passing one, mm, and none where ends meet.
pub fn layer(rises: &IdVec<ContactId, Option<f64>>, rule: Layering) -> IdVec<ContactId, bool> {
    rises
        .iter()
        .map(|&rise| match rule {
            Layering::Follow => rise.is_none_or(|rise| rise >= 0.0),
            Layering::Reciprocal => true,
        })
        .collect()
}
