//! The reciprocal frame: rods, the contacts between them, and the units that they
//! form. One file a step, in the order of [`form`](form::form): crop, weave, lift,
//! layer, close, cut, stand, and the measures of the result.

pub mod arrangement;
pub mod as_built;
pub mod assemble;
pub mod axis;
pub mod canvas;
pub mod circuits;
pub mod clash;
pub mod close;
pub mod crop;
pub mod cut;
pub mod fault;
mod finish;
pub mod fit;
pub mod fit_turn;
#[cfg(test)]
pub(crate) mod fixture;
pub mod footprint;
pub mod form;
pub mod formed;
pub mod gaps;
pub mod guide;
pub mod histogram;
pub mod layer;
pub mod lift;
pub mod measure;
pub mod plane_rods;
pub mod regularity;
pub mod relax;
pub mod share;
pub mod sizes;
pub mod stand;
pub mod tolerance;
pub mod trim;
pub mod weave;

use crate::chart::SurfacePoint;
use crate::ids::{ContactId, IdVec, RodId, UnitId};
use crate::surface::{Point3, Vector3};
use axis::Axis;
use gaps::Joint;
use sizes::{diameter_at, gap_between};

/// A finished reciprocal frame. Lengths in mm, angles in radians, z up.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The nominal diameter of the rods: errors and moves are expressed by it.
    pub diameter: f64,
    /// Height of the ground.
    pub ground: f64,
    /// The rods, cut to length.
    pub rods: IdVec<RodId, Rod>,
    /// The contacts, each between two rods.
    pub contacts: IdVec<ContactId, Contact>,
    /// The units.
    pub units: IdVec<UnitId, Unit>,
    /// Where rods stand on the ground, in the order of the rods.
    pub supports: Vec<Support>,
    /// Units that were left out, and why.
    pub dropped: Vec<Dropped>,
}

/// A straight round stick, which may taper.
#[derive(Clone, Debug)]
pub struct Rod {
    /// The axis; it starts at end A, the numbered end.
    pub axis: Axis,
    /// Diameters at end A and at end B; it tapers evenly between them.
    pub diameters: [f64; 2],
    /// The units that it belongs to: two where they share it.
    pub units: Vec<UnitId>,
    /// Whether an end of it is free: it is at the border of the frame.
    pub border: bool,
    /// Its contacts, from end A to end B.
    pub contacts: Vec<ContactId>,
}

/// How two rods touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ContactKind {
    /// One crosses over the other, the axes both radii apart.
    Cross,
    /// Two ends meet, that of the over rod first; over and under only name the rods.
    End([End; 2]),
}

/// A place where two rods touch.
#[derive(Clone, Debug)]
pub struct Contact {
    /// How they touch.
    pub kind: ContactKind,
    /// The rod on the outer side of the surface.
    pub over: RodId,
    /// The rod below.
    pub under: RodId,
    /// From end A of the over rod to the contact, along its axis.
    pub at_over: f64,
    /// The same along the under rod.
    pub at_under: f64,
    /// Between the axes, 0 to π/2.
    pub angle: f64,
    /// Distance of the axes: the sum of the radii there, and 0 where ends meet.
    pub gap: f64,
    /// Unit normal of the guiding surface at the contact.
    pub normal: Vector3,
    /// The unit that it belongs to.
    pub unit: UnitId,
}

/// N rods in a closed circuit.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The middle, on the guiding surface.
    pub center: SurfacePoint,
    /// Which way the rods run round.
    pub chirality: Chirality,
    /// The number of its outer rods.
    pub sides: usize,
    /// Its outer rods, counter-clockwise seen from outside, then its inner ones.
    pub rods: Vec<RodId>,
    /// The contacts in its tile. In a circuit, contact i between outer rods i and i + 1
    /// comes first.
    pub contacts: Vec<ContactId>,
}

/// The sense in which the rods of a unit run round its centre, seen from outside.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Chirality {
    /// Clockwise.
    Clockwise,
    /// Counter-clockwise.
    CounterClockwise,
}

impl Chirality {
    /// `cw` or `ccw`, as files name it.
    pub fn code(self) -> &'static str {
        match self {
            Self::Clockwise => "cw",
            Self::CounterClockwise => "ccw",
        }
    }
}

/// One of the two ends of a rod.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The numbered end, from which marks are measured.
    A,
    /// The other one.
    B,
}

impl End {
    /// `A` or `B`, as builders read it.
    pub fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// A rod end that stands on the ground.
#[derive(Clone, Debug)]
pub struct Support {
    /// The rod.
    pub rod: RodId,
    /// Which of its ends.
    pub end: End,
    /// Where the axis meets the ground.
    pub point: Point3,
}

/// A unit that was left out of the frame.
#[derive(Clone, PartialEq, Debug)]
pub struct Dropped {
    /// Its middle on the guiding surface.
    pub center: Point3,
    /// What was wrong with it, as a sentence.
    pub reason: String,
}

impl Rod {
    /// The diameter at a distance from end A, mm.
    pub fn diameter_at(&self, s: f64) -> f64 {
        diameter_at(self.diameters, s / self.axis.length())
    }

    /// The diameter at an end, mm.
    pub fn diameter_of(&self, end: End) -> f64 {
        match end {
            End::A => self.diameters[0],
            End::B => self.diameters[1],
        }
    }

    /// Whether it is thicker at one end than at the other.
    pub fn is_tapered(&self) -> bool {
        self.diameters[0] != self.diameters[1]
    }

    /// The diameter at its thicker end, mm.
    pub fn thickest(&self) -> f64 {
        self.diameters[0].max(self.diameters[1])
    }
}

impl Frame {
    /// How far apart the axes of a contact are to be, mm: by the two radii where it lies,
    /// and not at all where ends meet.
    pub fn wanted_gap(&self, contact: &Contact) -> f64 {
        let Contact { over, under, at_over, at_under, .. } = *contact;
        match contact.kind {
            ContactKind::Cross => gap_between([
                self.rods[over].diameter_at(at_over),
                self.rods[under].diameter_at(at_under),
            ]),
            ContactKind::End(_) => 0.0,
        }
    }

    /// The contacts as they are to be closed, with the gaps that are wanted where they lie.
    pub fn joints(&self) -> IdVec<ContactId, Joint> {
        let joint = |c: &Contact| Joint {
            over: c.over,
            under: c.under,
            outward: c.normal,
            diameter: match c.kind {
                ContactKind::Cross => self.wanted_gap(c),
                // Only errors are measured by it.
                ContactKind::End(_) => self.diameter,
            },
            kind: c.kind,
        };
        self.contacts.iter().map(joint).collect()
    }

    /// The end at which a rod meets another in this contact, if ends meet there.
    pub fn met_end(&self, contact: ContactId, rod: RodId) -> Option<End> {
        let c = &self.contacts[contact];
        match c.kind {
            ContactKind::Cross => None,
            ContactKind::End([over, under]) => Some(if c.over == rod { over } else { under }),
        }
    }

    /// The ends at which a rod meets others end to end.
    pub fn met_ends(&self, rod: RodId) -> Vec<End> {
        self.rods[rod].contacts.iter().filter_map(|&c| self.met_end(c, rod)).collect()
    }

    /// The diameter of the thickest rod, mm.
    pub fn thickest(&self) -> f64 {
        self.rods.iter().map(Rod::thickest).reduce(f64::max).unwrap_or(self.diameter)
    }

    /// A contact as `rod`, one of its two rods, sees it.
    pub fn seen_from(&self, contact: ContactId, rod: RodId) -> Mating {
        let c = &self.contacts[contact];
        if c.over == rod {
            Mating { partner: c.under, at: c.at_over, at_partner: c.at_under, over: true }
        } else {
            Mating { partner: c.over, at: c.at_under, at_partner: c.at_over, over: false }
        }
    }

    /// The contacts of a unit's circuit, contact i between outer rods i and i + 1; none
    /// where its outer rods run in no circuit.
    pub fn circuit<'a>(&self, unit: &'a Unit) -> &'a [ContactId] {
        let n = unit.sides;
        let joins = |(i, &c): (usize, &ContactId)| {
            let [p, q] = [unit.rods[i], unit.rods[(i + 1) % n]];
            let c = &self.contacts[c];
            [c.over, c.under] == [p, q] || [c.under, c.over] == [p, q]
        };
        match unit.contacts.get(..n) {
            Some(first) if first.iter().enumerate().all(joins) => first,
            _ => &[],
        }
    }

    /// The middle of a contact, half-way between the two axes.
    pub fn contact_middle(&self, contact: ContactId) -> Point3 {
        let c = &self.contacts[contact];
        let over = self.rods[c.over].axis.at(c.at_over);
        nalgebra::center(&over, &self.rods[c.under].axis.at(c.at_under))
    }

    /// The position of an end of a rod.
    pub fn end(&self, rod: RodId, end: End) -> Point3 {
        self.rods[rod].axis.end(end)
    }

    /// Lower and upper corner of a box round all axes.
    pub fn bounds(&self) -> [Point3; 2] {
        let ends = self.rods.iter().flat_map(|r| [r.axis.a, r.axis.b]);
        let start = [Point3::from([f64::INFINITY; 3]), Point3::from([f64::NEG_INFINITY; 3])];
        ends.fold(start, |[lo, hi], p| [lo.inf(&p), hi.sup(&p)])
    }
}

/// A contact as one of its two rods sees it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mating {
    /// The other rod.
    pub partner: RodId,
    /// Distance from end A of this rod, mm.
    pub at: f64,
    /// Distance from end A of the other rod, mm.
    pub at_partner: f64,
    /// Whether this rod lies over the other.
    pub over: bool,
}
