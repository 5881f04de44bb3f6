//! What a frame is made from, and what comes of it.

use super::Frame;
use super::close::{Closing, Way};
use super::layer::Layering;
use super::share::{Share, Shared};
use super::sizes::SizeTable;
use crate::ids::{ContactId, IdVec, TileId, UnitId};
use crate::surface::Point3;

/// What a frame is made from, besides its canvas. Lengths in mm.
#[derive(Clone, Debug)]
pub struct FormSettings {
    /// The nominal diameter of the rods.
    pub diameter: f64,
    /// Rods of other diameters.
    pub sizes: SizeTable,
    /// Rod left beyond its last contact.
    pub overhang: f64,
    /// Rod lengths are multiples of this; 0 for any length.
    pub round: f64,
    /// How rods share lengths.
    pub share: Share,
    /// Who goes over.
    pub layering: Layering,
    /// How contacts are closed.
    pub way: Way,
    /// The lowest height of the surface.
    pub surface_low: f64,
}

/// A finished frame and how it came about.
#[derive(Clone, Debug)]
pub struct Formed {
    /// The frame.
    pub frame: Frame,
    /// What sharing lengths came to, if rods do.
    pub shared: Option<Shared>,
    /// The tile of each unit.
    pub tiles: IdVec<UnitId, TileId>,
    /// What the last closing took.
    pub closing: Closing,
    /// How far each end of each rod moved in it, mm; where the frame was solved again with what
    /// was measured on its sticks, from where it was planned.
    pub moves: Vec<f64>,
    /// Whether the ending rod of each contact goes over the passing one; true where ends meet.
    pub ending_over: IdVec<ContactId, bool>,
    /// Rise of every crossing before closing, mm.
    pub rises: IdVec<ContactId, Option<f64>>,
    /// Middle of every contact before closing: half-way between its two rods.
    pub lifted_middles: IdVec<ContactId, Point3>,
}
