//! Walks round a vertex, from unit to unit as the rules allow (paper, section 3.2).
//!
//! A walk goes clockwise. It enters a unit through one side and leaves it through the
//! next one counter-clockwise, as the two meet in the vertex. The least angle is 60°, so
//! that seven units never fit: walks end after six at the latest.

use crate::pattern::UnitKind;
use crate::pattern::joints::Joints;

/// The angle of a unit's tile is a whole multiple of 360° / [`FULL`] for 3 to 12 sides.
pub const FULL: u32 = 27720;

/// Longer searches are given up: they take seconds. Rules that make a tiling need some
/// thousands of steps.
const MOST_STEPS: usize = 300_000;

/// The interior angle of a regular polygon, 360° / [`FULL`].
pub fn interior(sides: usize) -> u32 {
    // Up to twelve sides this is exact: FULL is their least common multiple.
    FULL / 2 - FULL / sides as u32
}

/// How a walk ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The angles make 360°, and the last unit connects to the first.
    Closed,
    /// The angles make 360°, but the last unit does not connect to the first.
    Open,
    /// The last unit does not fit in the angle that is left.
    Past,
    /// No rule goes on from the last unit.
    Stuck,
}

/// The rules allow more walks than can be followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TooManyWalks;

/// Follows all walks and shows each at its end, as the slots through which its units are
/// entered. Those from one start follow each other; starts are in the order of the slots.
pub fn follow(
    kinds: &[UnitKind],
    joints: &Joints,
    visit: &mut impl FnMut(&[usize], End),
) -> Result<(), TooManyWalks> {
    let mut walker = Walker { kinds, joints, path: Vec::new(), steps: 0, visit };
    for leaving in 0..joints.count() {
        let kind = joints.owner(leaving).kind;
        let entered = joints.turned(leaving, kinds[kind].sides - 1);
        if !joints.partners(leaving).is_empty() {
            walker.path = vec![entered];
            walker.go_on(interior(kinds[kind].sides))?;
        }
    }
    Ok(())
}

struct Walker<'a, V> {
    kinds: &'a [UnitKind],
    joints: &'a Joints,
    path: Vec<usize>,
    steps: usize,
    visit: &'a mut V,
}

impl<V: FnMut(&[usize], End)> Walker<'_, V> {
    /// Goes on from a path of this angle, which is less than 360°.
    fn go_on(&mut self, angle: u32) -> Result<(), TooManyWalks> {
        let joints = self.joints;
        let last = *self.path.last().expect("walks start with a unit");
        let next = joints.partners(joints.turned(last, 1));
        if next.is_empty() {
            (self.visit)(&self.path, End::Stuck);
        }
        for &entered in next {
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return Err(TooManyWalks);
            }
            let sum = angle + interior(self.kinds[joints.owner(entered).kind].sides);
            self.path.push(entered);
            if sum < FULL {
                self.go_on(sum)?;
            } else {
                let end = self.end(entered, sum);
                (self.visit)(&self.path, end);
            }
            self.path.pop();
        }
        Ok(())
    }

    fn end(&self, last: usize, sum: u32) -> End {
        if sum > FULL {
            return End::Past;
        }
        match self.joints.join(self.joints.turned(last, 1), self.path[0]) {
            Some(_) => End::Closed,
            None => End::Open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_whole() {
        for sides in 3..=12u32 {
            assert_eq!(FULL % sides, 0);
            let degrees = f64::from(interior(sides as usize)) * 360.0 / f64::from(FULL);
            let wanted = 180.0 - 360.0 / f64::from(sides);
            assert!((degrees - wanted).abs() < 1e-12, "{sides}: {degrees}");
        }
    }
}
