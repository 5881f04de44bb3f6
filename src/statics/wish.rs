//! What is asked of the statics of a frame before the frame is there, and the question that
//! comes of it.

use super::framework::{Assumptions, Feet};
use super::joint::Hold;
use super::material::Material;
use super::study::{Combination, PointLoad, Question};
use crate::frame::{Frame, Rod};
use crate::ids::{Id, RodId};
use crate::surface::{Point3, Vector3};
use thiserror::Error;

/// What is asked, of whatever frame.
#[derive(Clone, PartialEq, Debug)]
pub struct Wish {
    /// What the rods are made of.
    pub material: Material,
    /// What that is called.
    pub material_name: String,
    /// How contacts hold.
    pub hold: Hold,
    /// How feet are held.
    pub feet: Feet,
    /// The longest horizontal side that is studied, mm, if that is not the frame's own.
    pub span: Option<f64>,
    /// Forces on rods.
    pub loads: Vec<WishedLoad>,
    /// Vertical load on the area in plan, MPa.
    pub pressure: f64,
    /// The cases to be solved.
    pub combinations: Vec<Combination>,
    /// Whether feet are added until it stands.
    pub add_feet: bool,
}

/// A force on a rod.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WishedLoad {
    /// Where it acts.
    pub on: Target,
    /// N.
    pub force: Vector3,
}

/// Where a force acts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Target {
    /// On a rod, so far from its end A in mm of the frame; without that, in its middle.
    Rod(RodId, Option<f64>),
    /// At the highest contact.
    Top,
    /// On the rod that comes nearest to a point, and there.
    Near(Point3),
}

/// Why a load cannot act.
#[derive(Error, Debug, Clone, PartialEq)]
pub enum LoadError {
    /// No such rod.
    #[error("a load acts on {rod}, but the rods of this frame are R001 to {last}")]
    NoRod {
        /// The rod that is not there.
        rod: RodId,
        /// The last one.
        last: RodId,
    },
    /// It lies beyond the rod's end.
    #[error("a load acts on {rod} {at} mm from its end A, but the rod is {length:.1} mm long")]
    OffRod {
        /// The rod.
        rod: RodId,
        /// Where.
        at: f64,
        /// How long the rod is.
        length: f64,
    },
}

impl Wish {
    /// The question about a frame.
    ///
    /// # Errors
    /// [`LoadError`] when a load acts on no rod.
    pub fn about(&self, frame: &Frame) -> Result<Question, LoadError> {
        let [low, high] = frame.bounds();
        let longest = (high.x - low.x).max(high.y - low.y);
        let scale = self.span.map_or(1.0, |span| span / longest);
        let Self { material, hold, feet, .. } = *self;
        let point = |load: &WishedLoad| {
            let (rod, at) = place(frame, load.on)?;
            Ok(PointLoad { rod, at, force: load.force })
        };
        Ok(Question {
            taken: Assumptions { material, hold, feet, scale },
            material: self.material_name.clone(),
            points: self.loads.iter().map(point).collect::<Result<_, _>>()?,
            pressure: self.pressure,
            combinations: self.combinations.clone(),
            add_feet: self.add_feet,
        })
    }
}

impl Wish {
    /// The same, with loads on rods of this frame held at their places, whatever rods other
    /// frames have there.
    ///
    /// # Errors
    /// [`LoadError`] when a load acts on no rod.
    pub fn in_places(&self, frame: &Frame) -> Result<Self, LoadError> {
        let in_place = |load: &WishedLoad| match load.on {
            Target::Rod(..) => {
                let (rod, at) = place(frame, load.on)?;
                Ok(WishedLoad { on: Target::Near(frame.rods[rod].axis.at(at)), ..*load })
            }
            Target::Top | Target::Near(_) => Ok(*load),
        };
        let loads = self.loads.iter().map(in_place).collect::<Result<_, _>>()?;
        Ok(Self { loads, ..self.clone() })
    }
}

/// The rod and the distance from its end A that come nearest to a point.
fn nearest(frame: &Frame, point: Point3) -> (RodId, Option<f64>) {
    let foot = |(id, rod): (RodId, &Rod)| {
        let (axis, length) = (&rod.axis, rod.axis.length());
        let at = (point - axis.a).dot(&axis.direction()).clamp(0.0, length);
        ((point - axis.at(at)).norm(), id, at)
    };
    let nearest = frame.rods.enumerate().map(foot).reduce(|a, b| if b.0 < a.0 { b } else { a });
    nearest.map_or((RodId::new(0), None), |(_, id, at)| (id, Some(at)))
}

/// The rod and the distance from its end A at which a load acts.
fn place(frame: &Frame, on: Target) -> Result<(RodId, f64), LoadError> {
    let (rod, at) = match on {
        Target::Rod(rod, at) => (rod, at),
        Target::Near(point) => nearest(frame, point),
        Target::Top => {
            let height = |c| frame.contact_middle(c).z;
            let top = frame.contacts.ids().reduce(|a, b| if height(b) > height(a) { b } else { a });
            let on = |c| (frame.contacts[c].over, Some(frame.contacts[c].at_over));
            top.map_or((RodId::new(0), None), on)
        }
    };
    if rod.index() >= frame.rods.len() {
        let last = RodId::new(frame.rods.len().saturating_sub(1));
        return Err(LoadError::NoRod { rod, last });
    }
    let length = frame.rods[rod].axis.length();
    let at = at.unwrap_or(length / 2.0);
    if (0.0..=length).contains(&at) {
        Ok((rod, at))
    } else {
        Err(LoadError::OffRod { rod, at, length })
    }
}
