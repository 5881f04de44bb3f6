//! What a finished frame is like, in figures.

use super::form::Formed;
use super::guide::Guide;
use super::histogram::{BeforeAfter, Histogram};
use super::regularity::{Regularity, regularity};
use super::{Contact, Frame};
use crate::ids::{ContactId, IdVec};
use crate::surface::Point3;
use serde::Serialize;

/// Figures of a frame. Lengths in mm, angles in degrees.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Measures {
    /// Number of rods.
    pub rods: usize,
    /// Number of units.
    pub units: usize,
    /// Number of contacts.
    pub contacts: usize,
    /// Number of rods that stand on the ground.
    pub supports: usize,
    /// Sum of all rod lengths.
    pub total_length: f64,
    /// Shortest and longest rod.
    pub lengths: [f64; 2],
    /// Number of different rod lengths.
    pub distinct_lengths: usize,
    /// Largest error of a gap, as part of the nominal diameter.
    pub worst_gap: f64,
    /// How far rod ends moved in closing, in rod diameters.
    pub moves: Spread,
    /// Rise of the contacts before closing, in rod diameters.
    pub rises: Spread,
    /// Distance of the contacts' middles from the guiding surface.
    pub from_surface: Spread,
    /// Deviation of the inner polygons' angles from regular, degrees.
    pub unit_angles: Spread,
    /// Deviation of the inner polygons' sides from their mean, as part of it.
    pub unit_sides: Spread,
    /// Figures of single rods and contacts, counted in bins.
    pub histograms: Histograms,
}

/// Root mean square, median, and largest of the absolute values of a set of figures,
/// and their plain mean.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Spread {
    pub mean: f64,
    pub rms: f64,
    pub median: f64,
    pub max: f64,
}

/// How figures of single rods and contacts are spread (paper, Fig. 12 and 14): of the
/// lifted rods, before any contact is closed, and of the finished frame.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Histograms {
    /// Deviation of the inner polygons' angles from regular, degrees.
    pub unit_angles: BeforeAfter,
    /// Deviation of the inner polygons' sides from their mean, as part of it.
    pub unit_sides: BeforeAfter,
    /// Distance of the contacts' middles from the guiding surface, in rod diameters.
    pub off_surface: BeforeAfter,
    /// How far rod ends moved in closing, in rod diameters.
    pub moves: Histogram,
}

/// Least widths of bins, as the figures are given. Frames that came out well show several
/// bars then, and are counted in the same bins.
const ANGLE_BIN: f64 = 1.0;
const SIDE_BIN: f64 = 0.02;
const DIAMETER_BIN: f64 = 0.1;

/// Rods whose lengths differ by less are of one length, mm. Cut lengths are multiples
/// of the rounding step up to the noise of arithmetic; a larger bound would only
/// matter below steps of a thousandth, a smaller one would split lengths by noise.
pub const SAME_LENGTH: f64 = 1e-6;

/// Measures a frame against its surface.
pub fn measure(formed: &Formed, guide: &Guide) -> Measures {
    let frame = &formed.frame;
    let mut lengths: Vec<f64> = frame.rods.iter().map(|r| r.axis.length()).collect();
    lengths.sort_by(f64::total_cmp);
    let distinct = lengths.windows(2).filter(|l| l[1] - l[0] > SAME_LENGTH).count();
    let w = frame.diameter;
    let gap_error = |c: &Contact| (c.gap - frame.wanted_gap(c)).abs() / w;
    let middles: IdVec<ContactId, Point3> =
        frame.contacts.ids().map(|c| frame.contact_middle(c)).collect();
    let moves: Vec<f64> = formed.moves.iter().map(|m| m / w).collect();
    let from_surface = guide.distances(&middles);
    let regular = units(frame, &middles);
    let histograms = histograms(formed, guide, &regular, &from_surface, &moves);
    Measures {
        rods: frame.rods.len(),
        units: frame.units.len(),
        contacts: frame.contacts.len(),
        supports: frame.supports.len(),
        total_length: lengths.iter().sum(),
        lengths: [lengths[0], lengths[lengths.len() - 1]],
        distinct_lengths: distinct + 1,
        worst_gap: frame.contacts.iter().map(gap_error).fold(0.0, f64::max),
        moves: spread(moves.into_iter()),
        rises: spread(formed.rises.iter().flatten().map(|r| r / w)),
        from_surface: spread(from_surface.into_iter()),
        unit_angles: spread(regular.angles.into_iter()),
        unit_sides: spread(regular.sides.into_iter()),
        histograms,
    }
}

/// How regular the units are whose contacts have these middles.
fn units(frame: &Frame, middles: &IdVec<ContactId, Point3>) -> Regularity {
    let corners = |unit| frame.circuit(unit).iter().map(|&c| middles[c]).collect();
    regularity(frame.units.iter().map(corners))
}

fn histograms(
    formed: &Formed,
    guide: &Guide,
    regular: &Regularity,
    from_surface: &[f64],
    moves: &[f64],
) -> Histograms {
    let frame = &formed.frame;
    let before = units(frame, &formed.lifted_middles);
    let lifted = guide.distances(&formed.lifted_middles);
    let diameters = |mm: &[f64]| mm.iter().map(|d| d / frame.diameter).collect::<Vec<_>>();
    Histograms {
        unit_angles: BeforeAfter::new(&before.angles, &regular.angles, ANGLE_BIN),
        unit_sides: BeforeAfter::new(&before.sides, &regular.sides, SIDE_BIN),
        off_surface: BeforeAfter::new(&diameters(&lifted), &diameters(from_surface), DIAMETER_BIN),
        moves: Histogram::new(moves, DIAMETER_BIN),
    }
}

/// The spread of some figures.
pub(crate) fn spread(values: impl Iterator<Item = f64>) -> Spread {
    let values: Vec<f64> = values.collect();
    let n = values.len().max(1) as f64;
    let mut sizes: Vec<f64> = values.iter().map(|x| x.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    Spread {
        mean: values.iter().sum::<f64>() / n,
        rms: (values.iter().map(|x| x * x).sum::<f64>() / n).sqrt(),
        median: sizes.get(sizes.len() / 2).copied().unwrap_or(0.0),
        max: sizes.last().copied().unwrap_or(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_of_a_few_numbers() {
        let s = spread([3.0, -4.0, 0.0].into_iter());
        assert_eq!((s.median, s.max), (3.0, 4.0));
        assert!((s.mean + 1.0 / 3.0).abs() < 1e-15 && (s.rms - (25f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
