//! Marks on a rod: where it meets its partners, and how.

use super::letters;
use crate::frame::{ContactKind, End, Frame};
use crate::ids::{ContactId, RodId};
use crate::surface::Vector3;
use std::f64::consts::TAU;

/// Angles this near to a full turn are printed as none, radians: far below what a
/// protractor shows, far above rounding.
const FULL_TURN: f64 = 1e-9;

/// How a rod lies to its partner.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// Over it, on the outer side of the surface.
    Over,
    /// Under it.
    Under,
    /// End to end: its partner's end that it meets.
    Meets(End),
}

impl Side {
    /// `O`, `U` or `E`, as papers mark it.
    pub fn letter(self) -> &'static str {
        match self {
            Self::Over => "O",
            Self::Under => "U",
            Self::Meets(_) => "E",
        }
    }
}

/// A contact as it is marked on one of its two rods. mm and radians.
#[derive(Clone, PartialEq, Debug)]
pub struct Mark {
    /// The contact.
    pub contact: ContactId,
    /// Its letter on this rod: `a` is nearest to end A.
    pub letter: String,
    /// Distance from end A.
    pub at: f64,
    /// How this rod lies to its partner.
    pub side: Side,
    /// The other rod.
    pub partner: RodId,
    /// The letter of the same contact on the other rod.
    pub partner_letter: String,
    /// Distance from end A of the other rod.
    pub at_partner: f64,
    /// Between the two axes, 0 to π/2.
    pub angle: f64,
    /// Where the partner lies round this rod: clockwise, seen from end A, from the
    /// partner of the first mark. 0 to 2π. Of a partner that it meets end to end: where
    /// that goes off.
    pub clock: f64,
    /// Whether this rod ends here, but for its overhang; if not, it goes on through.
    pub ending: bool,
}

/// The marks of a rod, from end A to end B.
pub fn marks(frame: &Frame, rod: RodId) -> Vec<Mark> {
    let contacts = in_order(frame, rod);
    let ending = ending_contacts(frame, rod);
    let along = frame.rods[rod].axis.direction();
    let towards: Vec<Vector3> = contacts.iter().map(|&c| toward_partner(frame, c, rod)).collect();
    let clock = |i: usize| right_handed_turn(&towards[0], &towards[i], &along);
    let mark = |(i, &contact): (usize, &ContactId)| {
        let seen = frame.seen_from(contact, rod);
        Mark {
            contact,
            letter: letters(i, 'a'),
            at: seen.at,
            side: side(frame, contact, seen.over),
            partner: seen.partner,
            partner_letter: letter_on(frame, contact, seen.partner),
            at_partner: seen.at_partner,
            angle: frame.contacts[contact].angle,
            clock: clock(i),
            ending: ending.contains(&contact),
        }
    };
    contacts.iter().enumerate().map(mark).collect()
}

fn side(frame: &Frame, contact: ContactId, over: bool) -> Side {
    match (frame.contacts[contact].kind, over) {
        (ContactKind::Cross, true) => Side::Over,
        (ContactKind::Cross, false) => Side::Under,
        (ContactKind::End([_, under]), true) => Side::Meets(under),
        (ContactKind::End([over, _]), false) => Side::Meets(over),
    }
}

/// The contacts of a rod by distance from end A.
fn in_order(frame: &Frame, rod: RodId) -> Vec<ContactId> {
    let at = |c: &ContactId| frame.seen_from(*c, rod).at;
    let mut contacts = frame.rods[rod].contacts.clone();
    contacts.sort_by(|a, b| at(a).total_cmp(&at(b)).then(a.cmp(b)));
    contacts
}

fn letter_on(frame: &Frame, contact: ContactId, rod: RodId) -> String {
    let place = in_order(frame, rod).iter().position(|&c| c == contact);
    place.map_or_else(String::new, |i| letters(i, 'a'))
}

/// From the axis of `rod` across to the axis of its partner; to the far end of a partner
/// that it meets end to end, as seen along the rod.
fn toward_partner(frame: &Frame, contact: ContactId, rod: RodId) -> Vector3 {
    let seen = frame.seen_from(contact, rod);
    if let Side::Meets(end) = side(frame, contact, seen.over) {
        let along = frame.rods[rod].axis.direction();
        let partner = &frame.rods[seen.partner].axis;
        let away = if end == End::A { partner.direction() } else { -partner.direction() };
        return away - along * away.dot(&along);
    }
    let here = frame.rods[rod].axis.at(seen.at);
    let there = frame.rods[seen.partner].axis.at(seen.at_partner);
    there - here
}

/// The angle from one vector to another, turned the right-handed way about `axis`,
/// 0 to 2π. To someone who looks along `axis` that way is clockwise.
fn right_handed_turn(from: &Vector3, to: &Vector3, axis: &Vector3) -> f64 {
    let angle = from.cross(to).dot(axis).atan2(from.dot(to)).rem_euclid(TAU);
    // A tiny negative angle wraps to a full turn by rounding: that is none.
    if TAU - angle < FULL_TURN { 0.0 } else { angle }
}

/// The contacts at which a rod ends: its last one, and its first one unless its end A is
/// free.
fn ending_contacts(frame: &Frame, rod: RodId) -> Vec<ContactId> {
    let contacts = in_order(frame, rod);
    let first = contacts.first().filter(|_| !frame.rods[rod].border);
    first.into_iter().chain(contacts.last()).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_right_handed_turn_is_clockwise_to_who_looks_along() {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        assert!((right_handed_turn(&x, &y, &z) - FRAC_PI_2).abs() < 1e-12);
        assert!((right_handed_turn(&y, &x, &z) - 3.0 * FRAC_PI_2).abs() < 1e-12);
        assert!((right_handed_turn(&x, &-x, &z) - TAU / 2.0).abs() < 1e-12);
        assert_eq!(right_handed_turn(&x, &(x - y * 1e-15), &z), 0.0);
    }

    #[test]
    fn marks_of_a_circuit() {
        for n in 3..=8 {
            let frame = fixture::circuit(n, 3.0);
            for rod in frame.rods.ids() {
                let marks = marks(&frame, rod);
                let letters: Vec<_> = marks.iter().map(|m| m.letter.as_str()).collect();
                assert_eq!(letters, ["a", "b"]);
                // It passes under the rod before it and ends over the one after it.
                assert_eq!([marks[0].side, marks[1].side], [Side::Under, Side::Over]);
                assert_eq!([marks[0].ending, marks[1].ending], [false, true]);
                assert_eq!(marks[1].partner_letter, "a");
                assert_eq!(marks[0].clock, 0.0);
                assert!(marks[0].at < marks[1].at && marks[1].at < frame.rods[rod].axis.length());
                // The partners lie on opposite sides, but for the tilt of the rods.
                assert!((marks[1].clock - TAU / 2.0).abs() < 0.6, "{}", marks[1].clock);
            }
        }
    }

    /// The clock angle leads from the first partner's place round the rod to the others'.
    #[test]
    fn clock_angles_find_the_partners() {
        let frame = fixture::circuit(5, 3.0);
        for (rod, r) in frame.rods.enumerate() {
            let along = nalgebra::Unit::new_normalize(r.axis.direction());
            let marks = marks(&frame, rod);
            let first = toward_partner(&frame, marks[0].contact, rod);
            for mark in &marks {
                let turned = nalgebra::Rotation3::from_axis_angle(&along, mark.clock) * first;
                let found = r.axis.at(mark.at) + turned;
                let partner = frame.rods[mark.partner].axis.at(mark.at_partner);
                assert!((found - partner).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn one_rod_ends_and_one_passes_at_every_contact() {
        let frame = fixture::circuit(7, 2.0);
        let all = frame.rods.ids().flat_map(|r| marks(&frame, r));
        let mut ends = vec![0; frame.contacts.len()];
        for mark in all.filter(|m| m.ending) {
            ends[crate::ids::Id::index(mark.contact)] += 1;
        }
        assert!(ends.iter().all(|&n| n == 1));
    }
}
