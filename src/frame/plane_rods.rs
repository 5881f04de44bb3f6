//! The rods of a weave in the plane: where each begins and ends, and which rods pass over
//! it. For pictures of patterns, before any rod is straight in space.
//!
//! Of a weave on a flat chart ([`Flat`](crate::chart::Flat),
//! [`Unwrapped`](crate::chart::Unwrapped)); heights are left out of account.

use super::ContactKind;
use super::weave::Weave;
use crate::ids::{IdVec, RodId};
use crate::surface::Point3;
use nalgebra::{Point2, Unit, Vector2};

/// A rod in the plane, in the lengths of its chart.
#[derive(Clone, PartialEq, Debug)]
pub struct PlaneRod {
    /// Its outermost contacts, first the one towards end A; a border rod begins where it
    /// crosses its tile edge.
    pub ends: [Point2<f64>; 2],
    /// Whether it touches another rod there, so that it sticks out beyond; else it begins
    /// at the border, or meets another rod's end.
    pub rests: [bool; 2],
    /// Where rods rest on it, and which.
    pub under: Vec<(Point2<f64>, RodId)>,
}

/// Distances along a rod that count as the same, as part of its length: less, and
/// rounding parts two ends that meet; more, and a rod that rests close to an end is taken
/// for one that meets it.
const SAME: f64 = 1e-6;

/// The line of a rod, and where its contacts lie along it.
struct Course {
    from: Point2<f64>,
    along: Vector2<f64>,
    reach: [f64; 2],
}

impl Course {
    /// Of a rod through two places: it begins at the first or at its first contact.
    fn new(through: [Point3; 2]) -> Self {
        let [from, to] = through.map(|p| p.xy());
        // Places that coincide give no direction; any will do for a rod of no length.
        let along = Unit::try_new(to - from, 0.0).map_or_else(Vector2::x, Unit::into_inner);
        Self { from, along, reach: [0.0; 2] }
    }

    fn at(&self, p: Point3) -> f64 {
        (p.xy() - self.from).dot(&self.along)
    }

    fn take(&mut self, p: Point3) {
        let at = self.at(p);
        self.reach = [self.reach[0].min(at), self.reach[1].max(at)];
    }

    /// Which of the rod's ends lies at a contact.
    fn end_at(&self, p: Point3) -> Option<usize> {
        let slack = SAME * (self.reach[1] - self.reach[0]);
        (0..2).find(|&end| (self.reach[end] - self.at(p)).abs() <= slack)
    }
}

/// Where two rods touch.
struct Touch {
    ending: RodId,
    passing: RodId,
    at: Point3,
    /// Whether their ends meet, so that neither passes over the other.
    meet: bool,
}

/// The rods of a weave on a flat chart.
pub fn plane_rods(weave: &Weave) -> IdVec<RodId, PlaneRod> {
    let courses = weave.rods.iter().map(|rod| Course::new(rod.through)).collect();
    let touches: Vec<Touch> = weave
        .contacts
        .iter()
        .map(|c| Touch {
            ending: c.ending,
            passing: c.passing,
            at: c.on.position,
            meet: c.kind != ContactKind::Cross,
        })
        .collect();
    laid(courses, &touches)
}

/// The rods of these courses, as long as their contacts need them.
fn laid(mut courses: IdVec<RodId, Course>, touches: &[Touch]) -> IdVec<RodId, PlaneRod> {
    for &Touch { ending, passing, at, .. } in touches {
        courses[ending].take(at);
        courses[passing].take(at);
    }
    let mut rods: IdVec<RodId, PlaneRod> = courses
        .iter()
        .map(|c| PlaneRod {
            ends: c.reach.map(|s| c.from + c.along * s),
            rests: [false; 2],
            under: Vec::new(),
        })
        .collect();
    for &Touch { ending, passing, at, .. } in touches.iter().filter(|t| !t.meet) {
        rods[passing].under.push((at.xy(), ending));
        for rod in [ending, passing] {
            if let Some(end) = courses[rod].end_at(at) {
                rods[rod].rests[end] = true;
            }
        }
    }
    rods
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Flat, in_plane};
    use crate::frame::canvas::PlaneCanvas;
    use crate::frame::crop::{crop, held};
    use crate::frame::weave::weave;
    use crate::ids::Id;
    use crate::pattern::{Pattern, Shape, library};
    use crate::tiling::Placement;

    fn woven(pattern: &Pattern, shape: Shape) -> Weave {
        let sheet = Flat { low: Point2::new(-9.0, -9.0), high: Point2::new(9.0, 9.0) };
        let placement = Placement { origin: Point2::origin(), rotation: 0.3, edge: 1.0 };
        let canvas = PlaneCanvas::new(&sheet, pattern, placement, shape).expect("few tiles");
        weave(&canvas, &crop(&canvas, &held(&canvas))).expect("a flat sheet")
    }

    /// Of shared rods, each inside rests on two and carries two; border rods begin free, but
    /// for those of large slides, whose first contact lies beyond the edge.
    #[test]
    fn rods_run_from_rest_to_rest_and_every_contact_is_a_crossing() {
        for pattern in library() {
            let weave = woven(pattern, pattern.usual());
            let rods = plane_rods(&weave);
            let crossings: usize = rods.iter().map(|r| r.under.len()).sum();
            let crossed = weave.contacts.iter().filter(|c| c.kind == ContactKind::Cross).count();
            assert_eq!(crossings, crossed, "{}", pattern.name);
            if pattern.name != pattern.tiling.name {
                continue;
            }
            let mut touching = vec![0; rods.len()];
            for r in weave.contacts.iter().flat_map(|c| [c.ending, c.passing]) {
                touching[r.index()] += 1;
            }
            for (rod, touching) in rods.iter().zip(touching) {
                assert_eq!(rod.rests, [touching == 4, true], "{}", pattern.name);
                assert_eq!(rod.under.len(), touching / 2);
            }
            for (at, over) in rods.iter().flat_map(|r| &r.under) {
                let ends = rods[*over].ends;
                assert!(ends.iter().any(|end| (end - at).norm() < 1e-9), "{}", pattern.name);
            }
        }
    }

    /// Units of four unit squares turned by φ: contacts at the corners of a square of
    /// inradius sin φ / 2, so a rod is cos φ + sin φ long between its outermost contacts.
    #[test]
    fn lengths_are_those_of_the_closed_form() {
        let pattern = &library()[0];
        for turn in [0.1f64, 0.35, -0.25] {
            let weave = woven(pattern, Shape { turn, slide: 0.0 });
            let expected = turn.cos() + turn.sin().abs();
            for rod in plane_rods(&weave).iter() {
                let length = (rod.ends[1] - rod.ends[0]).norm();
                let part = if rod.rests[0] { 1.0 } else { 0.5 };
                assert!((length - part * expected).abs() < 1e-9, "{length}");
            }
        }
    }

    #[test]
    fn rods_that_meet_end_to_end_do_not_cross() {
        let mut courses: IdVec<RodId, Course> = IdVec::new();
        let mut rod = |from: [f64; 2], to: [f64; 2]| {
            courses.push(Course::new([from, to].map(|p| in_plane(p.into()).position)))
        };
        let first = rod([0.0, 0.0], [1.0, 0.0]);
        let second = rod([2.0, 1.0], [2.0, 0.5]);
        let at = in_plane(Point2::new(2.0, 0.0)).position;
        let rods = laid(courses, &[Touch { ending: first, passing: second, at, meet: true }]);
        assert_eq!(rods[first].ends, [[0.0, 0.0].into(), [2.0, 0.0].into()]);
        assert_eq!(rods[second].ends, [[2.0, 1.0].into(), [2.0, 0.0].into()]);
        assert!(rods.iter().all(|r| r.under.is_empty() && r.rests == [false; 2]));
    }
}
