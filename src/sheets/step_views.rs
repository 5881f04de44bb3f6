//! From where each step is looked at: the same side as long as what is new can be seen from
//! there.

use super::view::View;
use crate::frame::Frame;
use crate::shop::order::{Assembly, Step};
use crate::surface::Vector3;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Height of the eye over the horizontal: so that a dome is seen to 50° down its far side.
const ELEVATION: f64 = 50.0 * PI / 180.0;
/// Sides that it may be looked at from, an eighth of a turn apart.
const SIDES: usize = 8;
/// The first side: from the front and the right, as on the cover.
const FIRST: usize = 7;
/// Least cosine of the angle between the eye and what faces outwards where something is new:
/// 66°. Flatter, and one would look along the surface.
const FACING: f64 = 0.4;

/// A side to look from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct ViewSide(usize);

impl ViewSide {
    /// Where the eye stands, seen from above, counter-clockwise from +x.
    fn azimuth(self) -> f64 {
        self.0 as f64 * FRAC_PI_4
    }

    /// The view from there.
    pub fn view(self) -> View {
        View::from_side(self.azimuth(), ELEVATION)
    }

    fn toward(self) -> Vector3 {
        self.view().toward()
    }

    /// How far one walks round the model from another side, degrees; to the right positive.
    pub fn walk_from(self, other: Self) -> f64 {
        let turn = (self.azimuth() - other.azimuth()).rem_euclid(TAU);
        (if turn > PI { turn - TAU } else { turn }).to_degrees()
    }
}

/// The side for every step.
pub(super) fn sides(frame: &Frame, assembly: &Assembly) -> Vec<ViewSide> {
    let mut side = ViewSide(FIRST);
    let mut sides = Vec::with_capacity(assembly.steps.len());
    for step in &assembly.steps {
        let outward = outward(frame, step);
        let facing = |side: ViewSide| side.toward().dot(&outward);
        if facing(side) < FACING {
            let all = (0..SIDES).map(ViewSide);
            let best = all.max_by(|&a, &b| facing(a).total_cmp(&facing(b)).then(b.cmp(&a)));
            side = best.unwrap_or(side);
        }
        sides.push(side);
    }
    sides
}

/// Which way the surface faces where a step is.
fn outward(frame: &Frame, step: &Step) -> Vector3 {
    let made = step.over.iter().chain(&step.under);
    let sum: Vector3 = made.map(|&c| frame.contacts[c].normal).sum();
    sum.try_normalize(0.0).unwrap_or_else(Vector3::z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use crate::shop::order::{Order, OrderSettings, assembly};

    #[test]
    fn who_walks_to_the_right_goes_counter_clockwise() {
        let [front, right, left, back] = [6, 0, 4, 2].map(ViewSide);
        assert!((right.walk_from(front) - 90.0).abs() < 1e-9);
        assert!((left.walk_from(front) + 90.0).abs() < 1e-9);
        assert!((back.walk_from(front) - 180.0).abs() < 1e-9);
        assert_eq!(front.walk_from(front), 0.0);
    }

    #[test]
    fn a_flat_sheet_is_seen_from_one_side_and_a_dome_from_all_round() {
        let settings = OrderSettings { order: Some(Order::Crown), step_rods: None };
        for (surface, turns) in [("flat", 0..1), ("igloo", 2..30)] {
            let frame = fixture::on_sample(surface, "4.4.4.4");
            let assembly = assembly(&frame, &[], settings).unwrap();
            let sides = sides(&frame, &assembly);
            assert_eq!(sides.len(), assembly.steps.len());
            let changes = sides.windows(2).filter(|w| w[0] != w[1]).count();
            assert!(turns.contains(&changes), "{surface}: {changes}");
            let seen = |(step, side): (&Step, &ViewSide)| {
                side.toward().dot(&outward(&frame, step)) >= FACING
            };
            assert!(assembly.steps.iter().zip(&sides).all(seen), "{surface}");
        }
    }
}
