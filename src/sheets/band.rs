//! A rod in the plane as a band that breaks off where another passes over it.
//!
//! The band is cut along the band above, so that the white on both sides of that one is
//! equally wide however the two cross.

use crate::drawing::Point;

/// White left at each side of a band that passes over another: at least so much, mm, and
/// at least so many widths of a band.
const CLEAR: f64 = 0.12;
const CLEAR_WIDTHS: f64 = 0.25;
/// Sine of the angle below which a crossing is treated as one at this angle. Smaller, and
/// grazing bands would take away long stretches of each other.
const GRAZING: f64 = 0.3;
/// Stretches shorter than this many widths are left out: specks.
const SPECK: f64 = 0.2;
/// Coordinates are rounded to this many to the millimetre: a fifth of a printer's dot.
const STEPS_PER_MM: f64 = 100.0;

/// A straight band on paper, mm, y down.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Band {
    /// Both ends of its middle line.
    pub ends: [Point; 2],
    /// Where bands pass over it, each with that one's direction, of any length but zero.
    pub under: Vec<(Point, [f64; 2])>,
}

/// A border across a band: how far along it lies at its one side and at its other.
type Border = [f64; 2];

impl Band {
    /// The stretches that are seen of a band so wide: polygons of four corners.
    pub fn stretches(&self, width: f64) -> Vec<[Point; 4]> {
        let [a, b] = self.ends;
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let mut gaps: Vec<[Border; 2]> = self
            .under
            .iter()
            .map(|&(at, over)| gap(dot(minus(at, a), along), along, over, width))
            .collect();
        gaps.sort_by(|p, q| (p[0][0] + p[0][1]).total_cmp(&(q[0][0] + q[0][1])));
        let mut seen = Vec::new();
        let mut from: Border = [0.0; 2];
        for [before, after] in gaps {
            seen.push([from, before]);
            from = [from[0].max(after[0]), from[1].max(after[1])];
        }
        seen.push([from, [length; 2]]);
        let half = width / 2.0;
        let corner = |s: f64, side: f64| {
            [0, 1].map(|i| {
                let across = [-along[1], along[0]][i];
                rounded(a[i] + along[i] * s + across * side * half)
            })
        };
        seen.into_iter()
            // Negated so that bands of no length, whose figures are no numbers, are left out.
            .filter(|[from, to]| {
                (0..2).all(|k| to[k].min(length) - from[k].max(0.0) > SPECK * width)
            })
            .map(|[from, to]| {
                let (from, to) = (from.map(|s| s.max(0.0)), to.map(|s| s.min(length)));
                [
                    corner(from[0], -1.0),
                    corner(to[0], -1.0),
                    corner(to[1], 1.0),
                    corner(from[1], 1.0),
                ]
            })
            .collect()
    }
}

/// The borders of the gap that a band over this one leaves in it.
fn gap(at: f64, along: [f64; 2], over: [f64; 2], width: f64) -> [Border; 2] {
    let length = over[0].hypot(over[1]);
    let over = over.map(|x| x / length);
    let sine = along[0] * over[1] - along[1] * over[0];
    let cosine = dot(along, over);
    let sine = sine.abs().max(GRAZING).copysign(sine);
    let reach = (width / 2.0 + CLEAR.max(CLEAR_WIDTHS * width)) / sine.abs();
    // At this side of the band, half a width off its middle, the other one crosses later.
    let lag = width / 2.0 * cosine / sine;
    [[at - reach - lag, at - reach + lag], [at + reach - lag, at + reach + lag]]
}

fn minus(a: Point, b: Point) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A coordinate on paper as it is written.
pub(super) fn rounded(x: f64) -> f64 {
    (x * STEPS_PER_MM).round() / STEPS_PER_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance of a point from a line through `at`.
    fn off(p: Point, at: Point, direction: [f64; 2]) -> f64 {
        let d = minus(p, at);
        (d[0] * direction[1] - d[1] * direction[0]).abs() / direction[0].hypot(direction[1])
    }

    /// Both corners beside a gap are as far from the band above, at any angle.
    #[test]
    fn gaps_are_cut_along_the_band_above() {
        for degrees in [20.0f64, 45.0, 90.0, 120.0, -70.0] {
            let over = [degrees.to_radians().cos(), degrees.to_radians().sin()];
            let at = [10.0, 5.0];
            let band = Band { ends: [[0.0, 5.0], [30.0, 5.0]], under: vec![(at, over)] };
            let seen = band.stretches(1.0);
            assert_eq!(seen.len(), 2);
            let beside = [seen[0][1], seen[0][2], seen[1][0], seen[1][3]];
            for corner in beside {
                let clear = off(corner, at, over);
                assert!((clear - 0.75).abs() < 0.02, "{degrees}: {clear}");
            }
        }
    }

    #[test]
    fn a_band_that_nothing_crosses_is_one_rectangle() {
        let band = Band { ends: [[1.0, 1.0], [1.0, 4.0]], under: Vec::new() };
        let [[a, b, c, d]] = band.stretches(0.5)[..] else { panic!("one stretch") };
        assert_eq!([a, b, c, d], [[1.25, 1.0], [1.25, 4.0], [0.75, 4.0], [0.75, 1.0]]);
    }

    #[test]
    fn specks_and_bands_of_no_length_are_left_out() {
        let square = [0.0, 1.0];
        let band = Band {
            ends: [[0.0, 0.0], [10.0, 0.0]],
            under: vec![([0.9, 0.0], square), ([5.0, 0.0], square), ([5.2, 0.0], square)],
        };
        let seen = band.stretches(1.0);
        assert_eq!(seen.len(), 2);
        assert!(seen.iter().flatten().all(|p| (1.65..=10.0).contains(&p[0])));
        let point = Band { ends: [[1.0, 1.0]; 2], under: vec![([1.0, 1.0], square)] };
        assert!(point.stretches(1.0).is_empty());
    }
}
