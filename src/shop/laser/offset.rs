//! Outlines moved sideways, for the width of the cut.

use super::{Point, area};

/// A ring grown by `by` on all sides, or shrunk where that is negative; corners stay sharp.
/// `None` where a side would vanish: the ring has details finer than that.
///
/// Every corner moves to where the two moved sides meet, so that the area grows by exactly
/// by·P + by²·Σ tan(θ/2), P the length of the ring and θ the turns at its corners.
pub fn offset(ring: &[Point], by: f64) -> Option<Vec<Point>> {
    let n = ring.len();
    let outward = if area(ring) < 0.0 { -by } else { by };
    let side = |i: usize| {
        let (a, b) = (ring[i % n], ring[(i + 1) % n]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        [dx / length, dy / length]
    };
    let corner = |i: usize| {
        let ([ax, ay], [bx, by]) = (side(i + n - 1), side(i));
        let grow = outward / (1.0 + ax * bx + ay * by);
        // Right of the way that a counter-clockwise ring runs is outside.
        [ring[i][0] + grow * (ay + by), ring[i][1] - grow * (ax + bx)]
    };
    let moved: Vec<Point> = (0..n).map(corner).collect();
    let keeps = |i: usize| {
        let (a, b, [dx, dy]) = (moved[i], moved[(i + 1) % n], side(i));
        (b[0] - a[0]) * dx + (b[1] - a[1]) * dy > 0.0
    };
    (0..n).all(keeps).then_some(moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn polygon(corners: usize, radius: f64) -> Vec<Point> {
        let corner = |i: usize| {
            let (sin, cos) = (TAU * i as f64 / corners as f64).sin_cos();
            [radius * cos, radius * sin]
        };
        (0..corners).map(corner).collect()
    }

    #[test]
    fn regular_polygons_grow_by_their_inradius() {
        for corners in 3..40 {
            for by in [-0.4, -0.1, 0.1, 2.0] {
                let inradius = 5.0 * (PI / corners as f64).cos();
                let grown = offset(&polygon(corners, 5.0), by).unwrap();
                let factor = (inradius + by) / inradius;
                let wanted = area(&polygon(corners, 5.0)) * factor * factor;
                assert!((area(&grown) - wanted).abs() < 1e-9, "{corners} {by}");
            }
        }
    }

    /// A bracket with an inner corner, in both senses: 20·10 − 10·6, perimeter 60.
    #[test]
    fn inner_corners_move_the_other_way() {
        let mut ring =
            vec![[0.0, 0.0], [20.0, 0.0], [20.0, 4.0], [10.0, 4.0], [10.0, 10.0], [0.0, 10.0]];
        for _ in 0..2 {
            let grown = offset(&ring, 0.5).unwrap();
            // Five right corners and an inner one: tan 45° counts four times.
            let wanted = 140.0 + 0.5 * 60.0 + 0.25 * 4.0;
            assert!((area(&grown).abs() - wanted).abs() < 1e-12);
            assert!(grown.iter().any(|p| p == &[10.5, 4.5]), "{grown:?}");
            ring.reverse();
        }
    }

    #[test]
    fn what_is_finer_than_the_cut_is_refused() {
        assert!(offset(&polygon(6, 1.0), -0.9).is_none());
        assert!(offset(&polygon(6, 1.0), -0.8).is_some());
    }
}
