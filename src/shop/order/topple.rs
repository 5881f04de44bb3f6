//! Whether what stands would topple.
//!
//! Feet bear, but do not pull: the weight of a body of rods that hang together has to lie
//! above the outline of its feet and props. The weight of a rod goes by its volume.

use super::rests::resting_ends;
use super::site::Site;
use crate::frame::{Frame, Rod};
use crate::ids::{Id, RodId};
use crate::shop::Stick;
use crate::surface::hull::{convex_hull, depth_in};
use std::collections::BTreeSet;

/// The weight lies at least so far inside the outline, in diameters: marks slip, sticks bend.
const INSIDE: f64 = 1.0;

/// Rods in bodies that hang together.
pub struct Bodies {
    /// The next rod towards the one that stands for the body of each.
    parents: Vec<usize>,
    /// Of the rods that stand for one.
    bodies: Vec<Body>,
    inside: f64,
}

/// Some rods that hang together.
#[derive(Clone, Default)]
struct Body {
    rods: Vec<RodId>,
    /// Volume of its rods, mm³, and that times where their middles are in plan.
    weight: f64,
    moment: [f64; 2],
    /// Outline of its feet.
    feet: Vec<[f64; 2]>,
}

impl Bodies {
    /// No rod is placed yet.
    pub fn new(frame: &Frame) -> Self {
        let count = frame.rods.len();
        let bodies = vec![Body::default(); count];
        Self { parents: (0..count).collect(), bodies, inside: INSIDE * frame.diameter }
    }

    /// Takes in rods that were placed.
    pub fn add(&mut self, site: &Site, rods: &[RodId]) {
        for &rod in rods {
            let r = &site.frame.rods[rod];
            let [x, y, _]: [f64; 3] = nalgebra::center(&r.axis.a, &r.axis.b).into();
            let weight = volume(r);
            let ends = resting_ends(site, rod).map(|end| site.frame.end(rod, end));
            self.bodies[rod.index()] = Body {
                rods: vec![rod],
                weight,
                moment: [x * weight, y * weight],
                feet: ends.map(|p| [p.x, p.y]).collect(),
            };
        }
        for &rod in rods {
            for &contact in site.frame.rods[rod].contacts.iter().filter(|&&c| site.made(c)) {
                self.join(rod, site.frame.seen_from(contact, rod).partner);
            }
        }
    }

    fn join(&mut self, first: RodId, second: RodId) {
        let [mut to, mut from] = [first, second].map(|rod| self.body_of(rod));
        if to == from {
            return;
        }
        if self.bodies[to].rods.len() < self.bodies[from].rods.len() {
            std::mem::swap(&mut to, &mut from);
        }
        self.parents[from] = to;
        let joined = std::mem::take(&mut self.bodies[from]);
        let body = &mut self.bodies[to];
        body.rods.extend(joined.rods);
        body.weight += joined.weight;
        (0..2).for_each(|i| body.moment[i] += joined.moment[i]);
        body.feet.extend(joined.feet);
        body.feet = convex_hull(std::mem::take(&mut body.feet));
    }

    /// The number of the body of a rod.
    pub fn body_of(&self, rod: RodId) -> usize {
        let mut at = rod.index();
        while self.parents[at] != at {
            at = self.parents[at];
        }
        at
    }

    /// The numbers of the bodies of some rods.
    pub fn bodies_of(&self, rods: &[RodId]) -> BTreeSet<usize> {
        rods.iter().map(|&rod| self.body_of(rod)).collect()
    }

    /// The rods of a body.
    pub fn rods(&self, body: usize) -> &[RodId] {
        &self.bodies[body].rods
    }

    /// Whether a body would topple from its feet and props.
    pub fn topples(&self, body: usize, props: &[[f64; 2]]) -> bool {
        self.margin(body, props) < self.inside
    }

    /// How far inside the outline of its feet and props the weight of a body lies, mm.
    fn margin(&self, body: usize, props: &[[f64; 2]]) -> f64 {
        let body = &self.bodies[body];
        let points = body.feet.iter().chain(props).copied().collect();
        depth_in(&convex_hull(points), body.middle())
    }

    /// Which of several places in plan is best for one more prop, by its number: of those
    /// that keep the body from toppling the one with which it stands most safely, so that it
    /// does for the next steps, too; where none does, the one that is farthest out on the side
    /// to which it topples.
    pub fn best_place(
        &self,
        body: usize,
        props: &[[f64; 2]],
        places: &[[f64; 2]],
    ) -> Option<usize> {
        let margin = |i: usize| {
            let points: Vec<[f64; 2]> = props.iter().chain([&places[i]]).copied().collect();
            self.margin(body, &points)
        };
        let margins = (0..places.len()).map(|i| (margin(i), i));
        let safest = margins
            .filter(|(margin, _)| *margin >= self.inside)
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        let middle = self.bodies[body].middle();
        let held: Vec<[f64; 2]> = self.bodies[body].feet.iter().chain(props).copied().collect();
        let mean = |i: usize| held.iter().map(|p| p[i]).sum::<f64>() / held.len().max(1) as f64;
        let out = [0, 1].map(|i| middle[i] - if held.is_empty() { 0.0 } else { mean(i) });
        let beyond = |i: usize| (0..2).map(|k| (places[i][k] - middle[k]) * out[k]).sum::<f64>();
        let outmost =
            || (0..places.len()).max_by(|&a, &b| beyond(a).total_cmp(&beyond(b)).then(b.cmp(&a)));
        safest.map(|(_, i)| i).or_else(outmost)
    }
}

impl Body {
    /// Where its weight is in plan.
    fn middle(&self) -> [f64; 2] {
        self.moment.map(|m| m / self.weight)
    }
}

/// The volume of a rod, mm³.
fn volume(rod: &Rod) -> f64 {
    Stick { length: rod.axis.length(), diameters: rod.diameters }.volume()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use crate::shop::order::Order;

    fn standing(frame: &Frame) -> Bodies {
        let mut site = Site::new(frame, Order::Ground);
        let rods: Vec<RodId> = frame.rods.ids().collect();
        rods.iter().for_each(|&rod| site.place(rod));
        let mut bodies = Bodies::new(frame);
        bodies.add(&site, &rods);
        bodies
    }

    #[test]
    fn a_unit_stands_on_three_feet_and_topples_from_two() {
        let frame = fixture::circuit(3, 3.0);
        let bodies = standing(&frame);
        let body = bodies.body_of(RodId::new(2));
        assert_eq!(bodies.rods(body).len(), 3);
        assert!(!bodies.topples(body, &[]));
        let mut one_less = frame.clone();
        let foot = one_less.supports.remove(0);
        // High above the ground, its end does not lie there either.
        one_less.ground -= 100.0;
        let bodies = standing(&one_less);
        let body = bodies.body_of(RodId::new(2));
        assert!(bodies.topples(body, &[]));
        assert!(!bodies.topples(body, &[[foot.point.x, foot.point.y]]));
        // Of a place that helps not at all and two that do, that which helps more.
        let [away, foot] = [one_less.supports[0].point, foot.point].map(|p| [p.x, p.y]);
        let farther = foot.map(|x| 1.5 * x);
        assert_eq!(bodies.best_place(body, &[], &[away, foot, farther]), Some(2));
        // Where none does, that which is at least on the right side.
        let beside = [0, 1].map(|i| away[i] + 0.1 * (foot[i] - away[i]));
        assert_eq!(bodies.best_place(body, &[], &[away, beside]), Some(1));
    }

    #[test]
    fn a_rod_that_tapers_weighs_as_a_cone() {
        let mut frame = fixture::circuit(3, 3.0);
        let even = volume(&frame.rods[RodId::new(0)]);
        frame.rods[RodId::new(0)].diameters = [3.0, 0.0];
        assert!((volume(&frame.rods[RodId::new(0)]) - even / 3.0).abs() < 1e-9);
    }
}
