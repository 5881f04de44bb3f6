//! Feet: where rods stand on the ground, and at which angles.

use crate::frame::{End, Frame};
use crate::ids::RodId;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The foot of a rod. mm and radians; headings run counter-clockwise from +x, seen
/// from above, 0 to 2π.
#[derive(Clone, PartialEq, Debug)]
pub struct Foot {
    /// The rod.
    pub rod: RodId,
    /// The end that it stands on.
    pub end: End,
    /// The rod's diameter at that end.
    pub diameter: f64,
    /// Where the axis meets the ground.
    pub x: f64,
    /// Where the axis meets the ground.
    pub y: f64,
    /// Angle of the rod above the horizontal.
    pub elevation: f64,
    /// Heading of the rod from its foot into the frame.
    pub azimuth: f64,
    /// What to saw off the square end so that it stands flat: π/2 − elevation.
    pub bevel: f64,
    /// Distance from the model's middle, in plan.
    pub radius: f64,
    /// Heading from the model's middle to the foot.
    pub bearing: f64,
    /// The next foot counter-clockwise about the middle, if there is another one.
    pub next: Option<Neighbor>,
}

/// The next foot round.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Neighbor {
    /// Its place in the list of feet.
    pub index: usize,
    /// Its rod.
    pub rod: RodId,
    /// Straight distance of the two feet, mm.
    pub chord: f64,
}

/// The model's middle in plan: that of the box round all axes, mm.
pub fn middle(frame: &Frame) -> [f64; 2] {
    let [lo, hi] = frame.bounds();
    [(lo.x + hi.x) / 2.0, (lo.y + hi.y) / 2.0]
}

/// All feet, in the order of the frame's supports.
pub fn feet(frame: &Frame) -> Vec<Foot> {
    let [mx, my] = middle(frame);
    let mut feet: Vec<Foot> = frame
        .supports
        .iter()
        .map(|support| {
            let other = match support.end {
                End::A => End::B,
                End::B => End::A,
            };
            let up = frame.end(support.rod, other) - frame.end(support.rod, support.end);
            let elevation = up.z.atan2(up.x.hypot(up.y));
            let [x, y] = [support.point.x, support.point.y];
            Foot {
                rod: support.rod,
                end: support.end,
                diameter: frame.rods[support.rod].diameter_of(support.end),
                x,
                y,
                elevation,
                azimuth: heading(up.x, up.y),
                bevel: FRAC_PI_2 - elevation,
                radius: (x - mx).hypot(y - my),
                bearing: heading(x - mx, y - my),
                next: None,
            }
        })
        .collect();
    link(&mut feet);
    feet
}

/// Counter-clockwise from +x, 0 to 2π.
fn heading(x: f64, y: f64) -> f64 {
    let angle = y.atan2(x).rem_euclid(TAU);
    // A tiny negative angle becomes 2π by rounding.
    if angle >= TAU { 0.0 } else { angle }
}

/// Tells every foot which one comes next round the middle.
fn link(feet: &mut [Foot]) {
    if feet.len() < 2 {
        return;
    }
    let mut order: Vec<usize> = (0..feet.len()).collect();
    order.sort_by(|&i, &j| feet[i].bearing.total_cmp(&feet[j].bearing).then(i.cmp(&j)));
    for (k, &i) in order.iter().enumerate() {
        let index = order[(k + 1) % order.len()];
        let (foot, next) = (&feet[i], &feet[index]);
        let chord = (next.x - foot.x).hypot(next.y - foot.y);
        feet[i].next = Some(Neighbor { index, rod: next.rod, chord });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;

    #[test]
    fn feet_of_a_regular_circuit_stand_on_a_regular_polygon() {
        for n in 3..=9 {
            let frame = fixture::circuit(n, 3.0);
            let feet = feet(&frame);
            assert_eq!(feet.len(), n);
            let center =
                frame.rods.iter().map(|r| r.axis.a.coords).sum::<crate::surface::Vector3>()
                    / n as f64;
            let radius = (frame.rods[feet[0].rod].axis.a.coords - center).xy().norm();
            for (i, foot) in feet.iter().enumerate() {
                let next = foot.next.unwrap();
                assert_eq!(next.index, (i + 1) % n);
                let chord = 2.0 * radius * (TAU / 2.0 / n as f64).sin();
                assert!((next.chord - chord).abs() < 1e-6, "{n}: {}", next.chord);
                assert!((foot.elevation - feet[0].elevation).abs() < 1e-6);
                assert_eq!(foot.bevel, FRAC_PI_2 - foot.elevation);
                let turn = (foot.azimuth - feet[0].azimuth).rem_euclid(TAU);
                let wanted = TAU * i as f64 / n as f64;
                assert!((turn - wanted).abs() < 1e-6 || (TAU - turn).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_leaning_rod() {
        let mut frame = fixture::circuit(3, 3.0);
        let rod = frame.supports[0].rod;
        let axis = &mut frame.rods[rod].axis;
        axis.a = [10.0, 20.0, 0.0].into();
        axis.b = [10.0, 20.0 - 100.0, 100.0].into();
        frame.supports[0].point = axis.a;
        let foot = &feet(&frame)[0];
        assert!((foot.elevation.to_degrees() - 45.0).abs() < 1e-9);
        assert!((foot.azimuth.to_degrees() - 270.0).abs() < 1e-9);
        assert!((foot.bevel.to_degrees() - 45.0).abs() < 1e-9);
        assert_eq!([foot.x, foot.y], [10.0, 20.0]);
        let [mx, my] = middle(&frame);
        assert!((mx + foot.radius * foot.bearing.cos() - 10.0).abs() < 1e-9);
        assert!((my + foot.radius * foot.bearing.sin() - 20.0).abs() < 1e-9);
    }

    #[test]
    fn headings_stay_below_a_full_turn() {
        assert_eq!(heading(1.0, -1e-20), 0.0);
        assert_eq!(heading(0.0, 0.0), 0.0);
        assert!((heading(0.0, -1.0).to_degrees() - 270.0).abs() < 1e-12);
    }
}
