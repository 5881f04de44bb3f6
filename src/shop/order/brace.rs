//! Sets props where rods could move, and takes them away when they are not needed any more.

use super::props::{places, prop};
use super::rests::{anchor, rests};
use super::site::Site;
use super::topple::Bodies;
use super::{Order, Prop, Step};
use crate::frame::Frame;
use crate::ids::{Id, IdVec, PropId, RodId};
use crate::linalg::LinalgError;
use crate::statics::freedom::{Motion, Pose, Row, contact_rows, loose};
use std::collections::BTreeSet;

/// Placed rods up to so many are checked as a whole after every step of a crown.
const FEW: usize = 150;
/// More are checked as a whole when they have grown by this factor,
const GROWN: f64 = 1.1;
/// and up to so many: it takes seconds then. Beyond, each step is checked against what lies
/// near it in a crown, and against what lies already from the ground up.
const MANY: usize = 3000;
/// From the ground up, props on which more than a few rods lean are tried when the rods
/// placed have grown by this factor.
const REGROWN: f64 = 1.25;
/// Others are tried in every step, but when they have stood for more than so many only when
/// they have stood twice as long.
const OFTEN: usize = 8;
/// The most props below a rod: with two it does not move.
const MOST: usize = 2;
/// The most props that a step needs to keep a body from toppling: three, had it no feet.
const STEADY: usize = 3;
/// A prop is of use where a rod moves by at least this part of the largest motion of any.
const MOVES: f64 = 1e-3;

/// A prop that stands.
#[derive(Clone, Copy)]
struct Standing {
    prop: Prop,
    /// The step in which it was set.
    set: usize,
    /// Rods placed before this step are held without it, and without what came later.
    since: usize,
}

/// The props that stand, and what has been checked.
pub struct Bracing {
    poses: IdVec<RodId, Pose>,
    bodies: Bodies,
    standing: Vec<Standing>,
    /// How many were set so far.
    count: usize,
    /// How many rods were placed at the last check of the whole.
    checked: usize,
    order: Order,
}

impl Bracing {
    /// Nothing stands yet.
    pub fn new(frame: &Frame, order: Order) -> Self {
        let poses = Pose::all(frame);
        Self {
            poses,
            bodies: Bodies::new(frame),
            standing: Vec::new(),
            count: 0,
            checked: 0,
            order,
        }
    }

    /// Sets the props that a step needs, and takes away those that are not needed after it.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn brace(&mut self, site: &Site, step: &mut Step) -> Result<(), LinalgError> {
        self.hold(site, step);
        match self.order {
            Order::Ground => {
                self.bodies.add(site, &step.rods);
                self.fix(site, &step.rods.clone(), step)?;
                self.steady(site, step);
                self.release(site, step)?;
                spare(step);
                Ok(())
            }
            Order::Crown => {
                let near = neighborhood(site, &step.rods);
                self.fix(site, &near, step)?;
                let placed = site.sequence().len();
                let done = placed == site.frame.rods.len();
                let grown = placed <= FEW || placed as f64 >= self.checked as f64 * GROWN;
                if placed <= MANY && (grown || done) {
                    self.fix(site, site.sequence(), step)?;
                    self.checked = placed;
                }
                // The frame is lifted for the next step: props stand no longer.
                step.remove_props = self.standing.drain(..).map(|s| s.prop.id).collect();
                Ok(())
            }
        }
    }

    /// Takes away what is left at the end, and returns what the frame could not do without.
    pub fn clear(&mut self, last: &mut Step) -> Vec<PropId> {
        let missed: Vec<PropId> = self.standing.drain(..).map(|s| s.prop.id).collect();
        last.remove_props.extend(&missed);
        missed
    }

    /// Props for rods that fewer than two contacts and feet hold.
    fn hold(&mut self, site: &Site, step: &mut Step) {
        for &rod in &step.rods.clone() {
            for _ in site.holds(rod, |_| false)..2 {
                if let Some(at) = self.place(site, rod) {
                    self.set(site, rod, at, step);
                }
            }
        }
    }

    /// Sets props until none of these rods moves, the others standing still.
    fn fix(&mut self, site: &Site, rods: &[RodId], step: &mut Step) -> Result<(), LinalgError> {
        for _ in 0..MOST * rods.len() {
            let rows = self.rows(site, rods, &[]);
            let Some(motion) = loose(rods, &rows)? else { break };
            let Some((rod, at)) = self.most_moved(site, rods, &motion) else { break };
            self.set(site, rod, at, step);
        }
        Ok(())
    }

    /// Sets props until what the rods of a step belong to does not topple.
    fn steady(&mut self, site: &Site, step: &mut Step) {
        for body in self.bodies.bodies_of(&step.rods) {
            for _ in 0..STEADY {
                let props = self.props_below(body, &[]);
                if !self.bodies.topples(body, &props) {
                    break;
                }
                let place = |&rod: &RodId| Some((rod, self.place(site, rod)?));
                let all = self.bodies.rods(body);
                let near =
                    if all.len() > FEW { neighborhood(site, &step.rods) } else { all.to_vec() };
                let places: Vec<(RodId, f64)> = near.iter().filter_map(place).collect();
                let points = places.iter().map(|&(rod, at)| site.frame.rods[rod].axis.at(at));
                let points: Vec<[f64; 2]> = points.map(|p| [p.x, p.y]).collect();
                let Some(best) = self.bodies.best_place(body, &props, &points) else { break };
                let (rod, at) = places[best];
                self.set(site, rod, at, step);
            }
        }
    }

    /// Where the props of a body stand in plan, but for some.
    fn props_below(&self, body: usize, without: &[PropId]) -> Vec<[f64; 2]> {
        let below = |s: &&Standing| {
            self.bodies.body_of(s.prop.rod) == body && !without.contains(&s.prop.id)
        };
        self.standing.iter().filter(below).map(|s| [s.prop.point.x, s.prop.point.y]).collect()
    }

    /// Whether a body would topple without some props, but not with them.
    fn steadies(&self, props: &[PropId]) -> bool {
        let rods = self.standing.iter().filter(|s| props.contains(&s.prop.id)).map(|s| s.prop.rod);
        let rods: Vec<RodId> = rods.collect();
        let topples =
            |body, without: &[PropId]| self.bodies.topples(body, &self.props_below(body, without));
        let bodies = self.bodies.bodies_of(&rods);
        bodies.into_iter().any(|body| topples(body, props) && !topples(body, &[]))
    }

    /// The rod that a prop would help most.
    fn most_moved(&self, site: &Site, rods: &[RodId], motion: &Motion) -> Option<(RodId, f64)> {
        let moves = |&rod: &RodId| {
            let at = self.place(site, rod)?;
            Some((motion.at(&self.poses, rod, at).norm(), rod, at))
        };
        let all = rods.iter().filter_map(moves);
        let most = all.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        (most.0 > MOVES).then_some((most.1, most.2))
    }

    /// The best place on a rod for one more prop.
    fn place(&self, site: &Site, rod: RodId) -> Option<f64> {
        let standing = self.standing.iter().filter(|s| s.prop.rod == rod).count();
        places(site.frame, rod).into_iter().take(MOST).nth(standing)
    }

    fn set(&mut self, site: &Site, rod: RodId, at: f64, step: &mut Step) {
        let floor = match self.order {
            Order::Ground => site.frame.ground,
            Order::Crown => {
                let ends = site.sequence().iter().map(|&r| &site.frame.rods[r].axis);
                ends.flat_map(|axis| [axis.a.z, axis.b.z]).fold(f64::INFINITY, f64::min)
            }
        };
        let prop = prop(site.frame, PropId::new(self.count), rod, at, floor);
        self.count += 1;
        let set = site.step - 1;
        self.standing.push(Standing { prop, set, since: set });
        step.props.push(prop);
    }

    /// Takes away the props without which nothing moves, the newest first.
    fn release(&mut self, site: &Site, step: &mut Step) -> Result<(), LinalgError> {
        let placed = site.sequence().len();
        let done = placed == site.frame.rods.len();
        let grown = placed as f64 >= self.checked as f64 * REGROWN;
        let whole = placed <= MANY;
        if (done || whole && grown) && placed > FEW {
            self.release_all(site, step)?;
            self.checked = placed;
        }
        for Standing { prop, set, since } in self.standing.clone().into_iter().rev() {
            let rods = site.since(if whole { since } else { set });
            let age = site.step - 1 - set;
            let due = match rods.len() {
                n if n > FEW && whole => grown || done,
                _ => age <= OFTEN || age.is_power_of_two() || done && whole,
            };
            let others = self.standing.iter().filter(|s| s.prop.rod == prop.rod).count() - 1;
            let holds = site.holds(prop.rod, |_| false) + others >= 2;
            if !due || !holds || self.steadies(&[prop.id]) {
                continue;
            }
            if loose(rods, &self.rows(site, rods, &[prop.id]))?.is_none() {
                self.take_away(&[prop.id], since, step);
            }
        }
        step.remove_props.sort_unstable();
        Ok(())
    }

    /// Takes away all props, if nothing moves without any of them.
    fn release_all(&mut self, site: &Site, step: &mut Step) -> Result<(), LinalgError> {
        let Some(since) = self.standing.iter().map(|s| s.since).min() else { return Ok(()) };
        let hangs = |s: &Standing| site.holds(s.prop.rod, |_| false) < 2;
        if self.standing.iter().any(hangs) {
            return Ok(());
        }
        let props: Vec<PropId> = self.standing.iter().map(|s| s.prop.id).collect();
        if self.steadies(&props) {
            return Ok(());
        }
        let rods = site.since(since);
        if loose(rods, &self.rows(site, rods, &props))?.is_none() {
            self.take_away(&props, since, step);
        }
        Ok(())
    }

    /// Takes props away. What has been placed since then leans on those that are left.
    fn take_away(&mut self, props: &[PropId], since: usize, step: &mut Step) {
        self.standing.retain(|s| !props.contains(&s.prop.id));
        self.standing.iter_mut().for_each(|s| s.since = s.since.min(since));
        step.remove_props.extend(props);
    }

    /// All equations in which these rods take part, but for some props.
    fn rows(&self, site: &Site, rods: &[RodId], without: &[PropId]) -> Vec<Row> {
        let frame = site.frame;
        let among: BTreeSet<RodId> = rods.iter().copied().collect();
        let mut rows = Vec::new();
        for &rod in rods {
            for &contact in frame.rods[rod].contacts.iter().filter(|&&c| site.made(c)) {
                // A contact between two of them comes once.
                let partner = frame.seen_from(contact, rod).partner;
                if rod < partner || !among.contains(&partner) {
                    rows.extend(contact_rows(frame, &self.poses, contact));
                }
            }
            rows.extend(rests(site, &self.poses, rod));
        }
        for Standing { prop, .. } in &self.standing {
            if among.contains(&prop.rod) && !without.contains(&prop.id) {
                rows.extend(self.poses[prop.rod].held(prop.rod, prop.at));
            }
        }
        if self.order == Order::Crown && rods.len() == site.sequence().len() {
            rows.extend(anchor(site, &self.poses));
        }
        rows
    }
}

/// Forgets props that are set and taken away in the same step: others that came with them
/// make up for them.
fn spare(step: &mut Step) {
    let gone = std::mem::take(&mut step.remove_props);
    let set: Vec<PropId> = step.props.iter().map(|prop| prop.id).collect();
    step.props.retain(|prop| !gone.contains(&prop.id));
    step.remove_props = gone.into_iter().filter(|prop| !set.contains(prop)).collect();
}

/// The rods of a step, those that they touch, and those that touch these.
fn neighborhood(site: &Site, rods: &[RodId]) -> Vec<RodId> {
    let mut near: BTreeSet<RodId> = rods.iter().copied().collect();
    for _ in 0..2 {
        let round = near.iter().flat_map(|&rod| {
            let contacts = site.frame.rods[rod].contacts.iter().filter(|&&c| site.made(c));
            contacts.map(move |&c| site.frame.seen_from(c, rod).partner)
        });
        let more: Vec<RodId> = round.collect();
        near.extend(more);
    }
    near.into_iter().collect()
}
