//! What closing must keep: contacts in order along their rods with room between them, and
//! rods apart that do not touch (paper, section 5.2, its constraints).
//!
//! Rods are looked at as they will be cut: from their first contact to their last, with
//! what is left beyond.

use super::equations::{Equations, Move, pair};
use super::touch::{Place, Touch};
use crate::frame::axis::Axis;
use crate::frame::gaps::{Joint, Row, touching};
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::parallel::in_parallel;
use crate::surface::Vector3;
use crate::surface::bvh::{Aabb, Bvh};
use std::collections::{BTreeMap, BTreeSet};

/// What the rods need. Lengths in mm.
#[derive(Clone, Debug)]
pub struct Limits {
    /// The contacts of each rod, from end A to end B.
    pub along: IdVec<RodId, Vec<ContactId>>,
    /// Least distance between each of them and the next.
    pub room: IdVec<RodId, Vec<f64>>,
    /// What is left of each rod beyond its first contact and beyond its last.
    pub beyond: IdVec<RodId, [f64; 2]>,
    /// How thick each rod is.
    pub thickness: IdVec<RodId, f64>,
    /// What errors are measured by: the nominal diameter.
    pub diameter: f64,
}

/// A bound that may have to be held.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Bound {
    /// Room on a rod between the contact of this number and the next one.
    Room(RodId, u32),
    /// Two rods that do not touch, the lower number first.
    Apart([RodId; 2]),
}

impl Bound {
    /// The rods that it is about.
    pub fn rods(&self) -> impl Iterator<Item = RodId> + use<> {
        let (first, second) = match *self {
            Self::Room(rod, _) => (rod, None),
            Self::Apart([rod, other]) => (rod, Some(other)),
        };
        std::iter::once(first).chain(second)
    }
}

/// Bounds are held with this much to spare, as part of the diameter, so that rounding does
/// not break them.
const SPARE: f64 = 1e-6;

/// What is broken by less, as part of the diameter, is rounding.
const BROKEN: f64 = 1e-9;

/// Rods this near to each other are watched, in diameters.
const WATCHED: f64 = 4.0;

/// Rods that may have moved farther than this, in diameters, are looked at anew: two of them
/// can have come nearer by twice as much, and their cut ends by more.
const STRAYED: f64 = WATCHED / 4.0;

/// The bounds of some axes.
pub struct Bounds<'a> {
    joints: &'a IdVec<ContactId, Joint>,
    limits: &'a Limits,
    /// Which rods have contacts with which.
    touching: IdVec<RodId, Vec<RodId>>,
    /// Pairs that are near each other but in no contact.
    near: Vec<[RodId; 2]>,
    /// How far ends may have moved since these were looked up, mm.
    moved: f64,
}

impl<'a> Bounds<'a> {
    /// Those of rods near these axes.
    pub fn new(
        axes: &IdVec<RodId, Axis>,
        joints: &'a IdVec<ContactId, Joint>,
        rows: &[Row],
        limits: &'a Limits,
    ) -> Self {
        let touching = touching(axes.len(), joints);
        let mut bounds = Self { joints, limits, touching, near: Vec::new(), moved: 0.0 };
        bounds.watch(axes, rows);
        bounds
    }

    /// Heeds that no end moved farther than this, mm: after long ways, which rods are near each
    /// other is looked up anew.
    pub fn follow(&mut self, axes: &IdVec<RodId, Axis>, rows: &[Row], farthest: f64) {
        self.moved += farthest;
        if self.moved.is_nan() || self.moved > STRAYED * self.limits.diameter {
            self.watch(axes, rows);
        }
    }

    /// Looks up anew which rods are near each other.
    fn watch(&mut self, axes: &IdVec<RodId, Axis>, rows: &[Row]) {
        let places = self.places(axes, rows);
        let cut: IdVec<RodId, Axis> = axes.ids().map(|r| self.cut(axes, &places, r)).collect();
        let reach = |r: RodId| (self.limits.thickness[r] + WATCHED * self.limits.diameter) / 2.0;
        let boxes: Vec<Aabb<3>> =
            cut.enumerate().map(|(r, c)| Aabb::around(&[c.a, c.b]).grown(reach(r))).collect();
        let tree = Bvh::new(&boxes);
        let near = |&r: &RodId| {
            let mut near = Vec::new();
            tree.visit(
                |b| b.overlaps(&boxes[r.index()]),
                |i| {
                    let other = RodId::new(i);
                    if r < other
                        && !self.touching[r].contains(&other)
                        && cut[r].distance(&cut[other]) < reach(r) + reach(other)
                    {
                        near.push([r, other]);
                    }
                },
            );
            near.sort_unstable();
            near
        };
        let rods: Vec<RodId> = axes.ids().collect();
        self.moved = 0.0;
        self.near = in_parallel(&rods, near).into_iter().flatten().collect();
    }

    /// The contacts' places along their over rod and their under rod, mm from end A.
    fn places(&self, axes: &IdVec<RodId, Axis>, rows: &[Row]) -> IdVec<ContactId, [f64; 2]> {
        let mut places: IdVec<ContactId, [f64; 2]> = vec![[0.0; 2]; self.joints.len()].into();
        for row in rows {
            places[row.contact] = [0, 1].map(|s| row.at[s] * axes[row.rods[s]].length());
        }
        places
    }

    fn place(&self, places: &IdVec<ContactId, [f64; 2]>, rod: RodId, contact: ContactId) -> f64 {
        places[contact][usize::from(self.joints[contact].over != rod)]
    }

    /// A rod as it would be cut.
    fn cut(
        &self,
        axes: &IdVec<RodId, Axis>,
        places: &IdVec<ContactId, [f64; 2]>,
        rod: RodId,
    ) -> Axis {
        let (axis, along) = (&axes[rod], &self.limits.along[rod]);
        let (Some(&first), Some(&last)) = (along.first(), along.last()) else { return *axis };
        let [before, after] = self.limits.beyond[rod];
        let [from, to] = [first, last].map(|c| self.place(places, rod, c));
        axis.between(from - before, to + after)
    }

    /// The bounds that are broken, in order.
    pub fn broken(&self, axes: &IdVec<RodId, Axis>, rows: &[Row]) -> Vec<Bound> {
        let places = self.places(axes, rows);
        let slack = BROKEN * self.limits.diameter;
        let mut broken = Vec::new();
        for (rod, along) in self.limits.along.enumerate() {
            for (i, pair) in along.windows(2).enumerate() {
                let [p, q] = [pair[0], pair[1]].map(|c| self.place(&places, rod, c));
                if q - p < self.limits.room[rod][i] - slack {
                    broken.push(Bound::Room(rod, i as u32));
                }
            }
        }
        for &[r, other] in &self.near {
            let [p, q] = [r, other].map(|rod| self.cut(axes, &places, rod));
            if p.distance(&q) < self.apart([r, other]) - slack {
                broken.push(Bound::Apart([r, other]));
            }
        }
        broken
    }

    fn apart(&self, rods: [RodId; 2]) -> f64 {
        rods.iter().map(|&r| self.limits.thickness[r] / 2.0).sum()
    }

    /// Adds the equation that holds a bound; nothing where its rods are parallel or meet.
    /// Returns whether it did.
    pub fn hold(&self, bound: Bound, axes: &IdVec<RodId, Axis>, to: &mut Equations) -> bool {
        let spare = SPARE * self.limits.diameter;
        let row = match bound {
            Bound::Room(rod, i) => self.room(rod, i as usize, axes).map(|(value, parts)| {
                to.push(parts, self.limits.room[rod][i as usize] + spare - value);
            }),
            Bound::Apart(rods) => self.distance(rods, axes).map(|(value, parts)| {
                to.push(parts, self.apart(rods) + spare - value);
            }),
        };
        row.is_some()
    }

    /// Adds a row for every known bound, which moves nothing where it is not held. Bounds that
    /// have no equation are forgotten.
    pub fn hold_known(
        &self,
        known: &mut BTreeSet<Bound>,
        held: &mut BTreeSet<Bound>,
        axes: &IdVec<RodId, Axis>,
        to: &mut Equations,
    ) {
        known.retain(|&bound| {
            let row = to.len();
            let has_row = self.hold(bound, axes, to);
            if !has_row {
                held.remove(&bound);
            } else if !held.contains(&bound) {
                to.silence(row);
            }
            has_row
        });
    }

    /// The distance between two neighbouring contacts of a rod, mm, and its gradient.
    fn room(
        &self,
        rod: RodId,
        i: usize,
        axes: &IdVec<RodId, Axis>,
    ) -> Option<(f64, BTreeMap<RodId, Move>)> {
        let along = &self.limits.along[rod];
        let [p, q] = [along[i], along[i + 1]].map(|c| self.seat(rod, c, axes));
        let (p, q) = (p?, q?);
        let axis = &axes[rod];
        let (length, u) = (axis.length(), axis.direction());
        let mut parts = BTreeMap::from([(rod, pair(-u, u) * (q.at - p.at))]);
        add(&mut parts, &q.slide, length);
        add(&mut parts, &p.slide, -length);
        Some(((q.at - p.at) * length, parts))
    }

    /// The distance between two rods as they will be cut, mm, and its gradient.
    fn distance(
        &self,
        rods: [RodId; 2],
        axes: &IdVec<RodId, Axis>,
    ) -> Option<(f64, BTreeMap<RodId, Move>)> {
        let mut ends = Vec::with_capacity(4);
        for rod in rods {
            ends.push(self.end(rod, 0, axes)?);
            ends.push(self.end(rod, 1, axes)?);
        }
        let span = |rod: RodId, from: f64, to: f64| {
            let axis = &axes[rod];
            axis.between(from * axis.length(), to * axis.length())
        };
        let cut = [span(rods[0], ends[0].at, ends[1].at), span(rods[1], ends[2].at, ends[3].at)];
        let (part, _) = cut[0].nearest(&cut[1]);
        let points = [0, 1].map(|s| cut[s].a + (cut[s].b - cut[s].a) * part[s]);
        let apart = points[0] - points[1];
        let distance = apart.norm();
        if distance.is_nan() || distance <= SPARE * self.limits.diameter {
            return None;
        }
        let across: Vector3 = apart / distance;
        let mut parts = BTreeMap::new();
        for (s, sign) in [(0, 1.0), (1, -1.0)] {
            let (rod, n) = (rods[s], across * sign);
            let [from, to] = [ends[2 * s].at, ends[2 * s + 1].at];
            let at = from + (to - from) * part[s];
            add(&mut parts, &[(rod, pair(n * (1.0 - at), n * at))], 1.0);
            // At an end of the rod, the end itself slides along. Elsewhere the rods that it
            // slides with have no part, but a place, so that rows always name the same rods.
            let along = n.dot(&(axes[rod].b - axes[rod].a));
            let slides =
                [part[s] <= 0.0, part[s] >= 1.0].map(|at_end| if at_end { along } else { 0.0 });
            add(&mut parts, &ends[2 * s].slide, slides[0]);
            add(&mut parts, &ends[2 * s + 1].slide, slides[1]);
        }
        Some((distance, parts))
    }

    /// An end of a rod as it will be cut, at A (0) or B (1).
    fn end(&self, rod: RodId, end: usize, axes: &IdVec<RodId, Axis>) -> Option<Place> {
        let along = &self.limits.along[rod];
        let contact = if end == 0 { along.first() } else { along.last() };
        let mut place = self.seat(rod, *contact?, axes)?;
        let axis = &axes[rod];
        let (length, u) = (axis.length(), axis.direction());
        let beyond = self.limits.beyond[rod][end] * if end == 0 { -1.0 } else { 1.0 };
        place.at += beyond / length;
        place.slide.push((rod, pair(u, -u) * (beyond / (length * length))));
        Some(place)
    }

    /// Where a contact lies on one of its rods.
    fn seat(&self, rod: RodId, contact: ContactId, axes: &IdVec<RodId, Axis>) -> Option<Place> {
        Touch::new(axes, &self.joints[contact]).map(|touch| touch.place(rod))
    }
}

/// Adds gradients times a factor.
pub(super) fn add(parts: &mut BTreeMap<RodId, Move>, more: &[(RodId, Move)], factor: f64) {
    for (rod, part) in more {
        *parts.entry(*rod).or_insert_with(Move::zeros) += part * factor;
    }
}
