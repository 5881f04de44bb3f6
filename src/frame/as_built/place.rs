//! Where the sticks come to lie on their axes: sawn ones so that their marks are met, the others
//! cut anew.

use super::sticks::Sticks;
use super::{AsBuiltError, Cutting, touch_again};
use crate::frame::axis::Axis;
use crate::frame::cut::{Seat, crossing, cut, rounded_up, seats};
use crate::frame::gaps::Joint;
use crate::frame::weave::RodEnd;
use crate::frame::{End, Frame};
use crate::ids::{ContactId, IdVec, RodId};

/// A stick keeps the length that was planned while it is not more than so many steps longer
/// than it has to be: more than what rounding to be cut, and again to stand, may add. Fewer, and
/// lengths change that need not; more, and sticks are sawn too long.
const KEPT: f64 = 2.5;

/// A stick is long enough if this is all that it lacks, mm: rounding.
const LACKING: f64 = 1e-6;

/// How sticks are placed.
pub struct Placing<'a> {
    /// The frame as planned.
    pub plan: &'a Frame,
    /// What is sawn.
    pub sticks: &'a Sticks,
    /// How the others are cut.
    pub cutting: Cutting,
    /// Height of the ground, mm.
    pub ground: f64,
}

impl Placing<'_> {
    /// Places the sticks of a frame on these axes. The lowest height of an end that is not to
    /// stand on the ground, mm.
    ///
    /// # Errors
    /// The contact whose rods are parallel.
    pub fn place(
        &self,
        frame: &mut Frame,
        axes: &IdVec<RodId, Axis>,
        joints: &IdVec<ContactId, Joint>,
    ) -> Result<f64, AsBuiltError> {
        let crossings = joints
            .enumerate()
            .map(|(id, j)| crossing(axes, j).ok_or_else(|| AsBuiltError::open(joints, &[id])))
            .collect::<Result<_, _>>()?;
        let seats = seats(axes.len(), joints, &crossings);
        let mut stands: IdVec<RodId, bool> = vec![false; axes.len()].into();
        self.plan.supports.iter().for_each(|s| stands[s.rod] = true);
        let placed: IdVec<RodId, Axis> =
            axes.enumerate().map(|(r, axis)| self.stick(r, axis, &seats[r], stands[r])).collect();
        touch_again(frame, &placed, joints)?;
        for support in &mut frame.supports {
            support.point = placed[support.rod].a;
        }
        let low =
            |(r, axis): (RodId, &Axis)| if stands[r] { axis.b.z } else { axis.a.z.min(axis.b.z) };
        Ok(placed.enumerate().map(low).fold(f64::INFINITY, f64::min))
    }

    /// A stick on its axis.
    fn stick(&self, rod: RodId, axis: &Axis, seats: &[Seat], stands: bool) -> Axis {
        let planned = self.plan.rods[rod].axis.length();
        let ends = self.ends(rod);
        let Some(marks) = self.sticks.sawn.get(&rod) else {
            let length = |least| self.length(planned, least);
            return if stands {
                self.let_down(axis, seats, length)
            } else {
                cut(axis, ends, seats, self.cutting.overhang, length)
            };
        };
        let off = |s: &Seat| Some(s.at - marks.get(&s.contact)?);
        let offs: Vec<f64> = seats.iter().filter_map(off).collect();
        match ends {
            [RodEnd::Meets, RodEnd::Meets] => *axis,
            [RodEnd::Meets, _] => axis.between(0.0, planned),
            [_, RodEnd::Meets] => axis.between(axis.length() - planned, axis.length()),
            // Where its marks contradict others, the ground goes before them.
            _ if stands => self.let_down(axis, seats, |_| planned),
            _ if !offs.is_empty() => {
                let from = offs.iter().sum::<f64>() / offs.len() as f64;
                axis.between(from, from + planned)
            }
            _ => cut(axis, ends, seats, self.cutting.overhang, |_| planned),
        }
    }

    /// With end A on the ground, and long enough.
    fn let_down(&self, axis: &Axis, seats: &[Seat], length: impl FnOnce(f64) -> f64) -> Axis {
        let along = axis.direction();
        let from = (self.ground - axis.a.z) / along.z;
        let mut foot = axis.at(from);
        foot.z = self.ground;
        let last = seats.last().map_or(axis.length(), |s| s.at);
        let length = length(last + self.cutting.overhang - from);
        Axis { a: foot, b: foot + along * length }
    }

    /// The length of a stick that has to be at least so long: as planned if that will do.
    fn length(&self, planned: f64, least: f64) -> f64 {
        let step = self.cutting.round;
        let kept = planned >= least - LACKING && planned <= least + KEPT * step;
        if kept { planned } else { rounded_up(least, step) }
    }

    /// What is at either end of a rod, as far as cutting goes.
    fn ends(&self, rod: RodId) -> [RodEnd; 2] {
        let met = self.plan.met_ends(rod);
        [End::A, End::B].map(|e| if met.contains(&e) { RodEnd::Meets } else { RodEnd::Rests })
    }
}
