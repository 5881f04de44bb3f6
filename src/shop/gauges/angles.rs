//! Angle gauges: wedges that are laid between two rods to set the angle at which they cross.

use crate::frame::{ContactKind, Frame};
use crate::shop::laser::{Board, Lettering};

/// Contacts share a gauge up to this far from its angle, degrees: what can be set by hand.
const WITHIN: f64 = 0.5;
/// Most gauges; those that most contacts need come first.
const MOST: usize = 40;
/// Least angle of a gauge, degrees: of narrower wedges no edge is left.
const LEAST: f64 = 8.0;
/// Length of a wedge's legs, mm.
const LEG: f64 = 40.0;
/// Least width of the tip, mm.
const TIP: f64 = 2.0;
/// Height of numbers, mm.
const LETTERS: f64 = 3.0;
/// How far along the wedge the number stands, as a share of its outer radius.
const NUMBER: f64 = 0.72;

/// Contacts that share an angle, but for half a degree.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AngleGroup {
    /// The angle, degrees.
    pub angle: f64,
    /// How many contacts.
    pub count: usize,
}

/// The groups into which the angles of crossing rods fall, narrow ones first.
pub fn angle_groups(frame: &Frame) -> Vec<AngleGroup> {
    let crossing = frame.contacts.iter().filter(|c| c.kind == ContactKind::Cross);
    let mut angles: Vec<f64> = crossing.map(|c| c.angle.to_degrees()).collect();
    angles.sort_by(f64::total_cmp);
    let mut groups = Vec::new();
    let mut left = &angles[..];
    while let Some(&first) = left.first() {
        let (group, rest) = left.split_at(left.partition_point(|a| a - first <= 2.0 * WITHIN));
        let angle = (first + group[group.len() - 1]) / 2.0;
        groups.push(AngleGroup { angle, count: group.len() });
        left = rest;
    }
    groups
}

/// The wedges, narrow ones first; of more groups than there are gauges, those with the most
/// contacts.
pub fn angle_gauges(frame: &Frame) -> Vec<Board> {
    let mut groups = angle_groups(frame);
    groups.retain(|group| group.angle >= LEAST);
    groups.sort_by(|a, b| b.count.cmp(&a.count).then(a.angle.total_cmp(&b.angle)));
    groups.truncate(MOST);
    groups.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    groups.iter().map(|group| wedge(group.angle, frame.thickest())).collect()
}

/// A wedge without its tip, which would stand in the way where the rods cross.
fn wedge(degrees: f64, diameter: f64) -> Board {
    let angle = degrees.to_radians();
    let from = diameter.max(TIP / (2.0 * (angle / 2.0).sin()));
    let to = from + LEG;
    let at = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
    let ring = vec![at(from, 0.0), at(to, 0.0), at(to, angle), at(from, angle)];
    let mut board = Board::new(format!("angle gauge of {degrees:.1}°"), ring);
    // The outer edge is a chord, nearer than the legs' ends.
    let middle = at(to * (angle / 2.0).cos() * NUMBER, angle / 2.0);
    let letters = Lettering { height: LETTERS, angle: angle / 2.0 };
    board.score(letters.centred(middle, &format!("{degrees:.1}°")));
    board
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;

    #[test]
    fn every_contact_is_within_half_a_degree_of_a_group() {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let groups = angle_groups(&frame);
        assert_eq!(groups.iter().map(|g| g.count).sum::<usize>(), frame.contacts.len());
        for contact in &frame.contacts {
            let angle = contact.angle.to_degrees();
            assert!(groups.iter().any(|g| (g.angle - angle).abs() <= WITHIN + 1e-9), "{angle}");
        }
    }

    #[test]
    fn the_legs_of_a_wedge_enclose_its_angle() {
        for degrees in [8.0, 20.5, 41.0, 90.0] {
            let board = wedge(degrees, 3.0);
            let [a, b, c, d] = board.outline[..] else { panic!("four corners") };
            let way = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]).atan2(q[0] - p[0]);
            assert!(((way(d, c) - way(a, b)).to_degrees() - degrees).abs() < 1e-9);
            assert!((d[0] - a[0]).hypot(d[1] - a[1]) >= TIP - 1e-9);
        }
    }
}
