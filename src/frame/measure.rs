//! What a finished frame is like, in figures.

use super::form::Formed;
use super::guide::Guide;
use super::{Contact, Frame};
use crate::ids::{ContactId, IdVec};
use crate::surface::Point3;
use serde::Serialize;
use std::f64::consts::PI;

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
    /// The same two deviations, counted in bins.
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

/// Regularity of the units (paper, Fig. 12 and 14).
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Histograms {
    /// Deviation of angles, degrees.
    pub unit_angles: Histogram,
    /// Deviation of sides, part of the mean.
    pub unit_sides: Histogram,
}

/// Counts in bins of equal width from zero; the last bin takes all above, too.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Histogram {
    pub bin: f64,
    pub counts: Vec<usize>,
}

/// Number of bins of a histogram.
const BINS: usize = 20;

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
    let (angles, sides) = regularity(frame, &middles);
    Measures {
        rods: frame.rods.len(),
        units: frame.units.len(),
        contacts: frame.contacts.len(),
        supports: frame.supports.len(),
        total_length: lengths.iter().sum(),
        lengths: [lengths[0], lengths[lengths.len() - 1]],
        distinct_lengths: distinct + 1,
        worst_gap: frame.contacts.iter().map(gap_error).fold(0.0, f64::max),
        moves: spread(formed.moves.iter().map(|m| m / w)),
        rises: spread(formed.rises.iter().flatten().map(|r| r / w)),
        from_surface: spread(guide.distances(&middles).into_iter()),
        unit_angles: spread(angles.iter().copied()),
        unit_sides: spread(sides.iter().copied()),
        histograms: Histograms {
            unit_angles: histogram(&angles, 1.0),
            unit_sides: histogram(&sides, 0.02),
        },
    }
}

/// Deviations of the inner polygons from regular ones: angles in degrees, sides as
/// part of the mean side of the unit.
fn regularity(frame: &Frame, middles: &IdVec<ContactId, Point3>) -> (Vec<f64>, Vec<f64>) {
    let (mut angles, mut sides) = (Vec::new(), Vec::new());
    for unit in &frame.units {
        let round = frame.circuit(unit);
        let n = round.len();
        if n == 0 {
            continue;
        }
        let corner = |i: usize| middles[round[i % n]];
        let regular = PI - 2.0 * PI / n as f64;
        let lengths: Vec<f64> = (0..n).map(|i| (corner(i + 1) - corner(i)).norm()).collect();
        let mean = lengths.iter().sum::<f64>() / n as f64;
        sides.extend(lengths.iter().map(|length| length / mean - 1.0));
        angles.extend((0..n).map(|i| {
            let (back, ahead) = (corner(i) - corner(i + 1), corner(i + 2) - corner(i + 1));
            (back.angle(&ahead) - regular).to_degrees()
        }));
    }
    (angles, sides)
}

fn spread(values: impl Iterator<Item = f64>) -> Spread {
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

fn histogram(values: &[f64], bin: f64) -> Histogram {
    let mut counts = vec![0; BINS];
    for value in values {
        counts[((value.abs() / bin) as usize).min(BINS - 1)] += 1;
    }
    Histogram { bin, counts }
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

    #[test]
    fn histogram_counts_all_and_keeps_the_far_ones() {
        let h = histogram(&[0.1, -0.3, 1.7, 99.0], 1.0);
        assert_eq!((h.counts[0], h.counts[1], h.counts[BINS - 1]), (2, 1, 1));
    }
}
