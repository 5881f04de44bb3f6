//! Between a frame, which computes, and a structure, which is a file.

use super::{
    ChiralityName, ContactEntry, ContactKindName, DroppedEntry, Report, RodEntry, Structure,
    StructureFault, SupportEntry, UnitEntry,
};
use crate::chart::SurfacePoint;
use crate::frame::axis::Axis;
use crate::frame::clash::Clash;
use crate::frame::{Chirality, Contact, ContactKind, Dropped, Frame, Rod, Support, Unit};
use crate::ids::{ContactId, Id, IdVec, RodId, UnitId};
use crate::shop::lengths::LengthClasses;
use crate::surface::{Point3, Vector3};
use std::collections::HashMap;
use std::fmt::Display;

impl Structure {
    /// The file's view of a frame.
    pub fn from_frame(frame: &Frame, classes: &LengthClasses, clashes: &[Clash]) -> Self {
        Self {
            rod_diameter: frame.diameter,
            ground: frame.ground,
            rods: frame.rods.enumerate().map(|(r, rod)| rod_entry(r, rod, classes)).collect(),
            contacts: frame.contacts.enumerate().map(contact_entry).collect(),
            units: frame.units.enumerate().map(|(u, unit)| unit_entry(u, unit)).collect(),
            supports: frame.supports.iter().map(support_entry).collect(),
            report: Report {
                clashes: clashes.iter().map(clash_entry).collect(),
                dropped: frame.dropped.iter().enumerate().map(dropped_entry).collect(),
            },
        }
    }

    /// The frame that a file describes. The normals at the middles of units are not
    /// in the file: they are the mean of those at the contacts round them.
    ///
    /// # Errors
    /// [`StructureFault`], when elements are not numbered in order, or of a kind that
    /// a frame does not know.
    pub fn to_frame(&self) -> Result<Frame, StructureFault> {
        self.check()?;
        let places = Places {
            rods: places(self.rods.iter().map(|r| r.id.as_str()))?,
            contacts: places(self.contacts.iter().map(|c| c.id.as_str()))?,
            units: places(self.units.iter().map(|u| u.id.as_str()))?,
        };
        let contacts: IdVec<ContactId, Contact> =
            self.contacts.iter().map(|c| places.contact(c)).collect();
        let along = along_rods(self.rods.len(), &contacts);
        let support = |s: &SupportEntry| Support {
            rod: places.rods[s.rod.as_str()],
            end: s.end.into(),
            point: s.point.into(),
        };
        let dropped =
            |d: &DroppedEntry| Dropped { center: d.center.into(), reason: d.reason.clone() };
        Ok(Frame {
            diameter: self.rod_diameter,
            ground: self.ground,
            rods: self
                .rods
                .iter()
                .zip(along.iter())
                .map(|(r, along)| places.rod(r, self.diameters(r), along))
                .collect(),
            units: self.units.iter().map(|u| places.unit(u, &contacts)).collect(),
            contacts,
            supports: self.supports.iter().map(support).collect(),
            dropped: self.report.dropped.iter().map(dropped).collect(),
        })
    }
}

fn rod_entry(r: RodId, rod: &Rod, classes: &LengthClasses) -> RodEntry {
    RodEntry {
        id: r.to_string(),
        a: rod.axis.a.into(),
        b: rod.axis.b.into(),
        length: rod.axis.length(),
        class: classes.of(r).name.clone(),
        units: strings(&rod.units),
        border: rod.border,
        diameter: Some(rod.diameters.into()),
    }
}

fn contact_entry((c, contact): (ContactId, &Contact)) -> ContactEntry {
    let [end_over, end_under] = match contact.kind {
        ContactKind::Cross => [None; 2],
        ContactKind::End(ends) => ends.map(|end| Some(end.into())),
    };
    ContactEntry {
        id: c.to_string(),
        kind: contact.kind.into(),
        over: contact.over.to_string(),
        under: contact.under.to_string(),
        at_over: contact.at_over,
        at_under: contact.at_under,
        angle: contact.angle.to_degrees(),
        gap: contact.gap,
        normal: contact.normal.into(),
        unit: contact.unit.to_string(),
        end_over,
        end_under,
    }
}

fn unit_entry(u: UnitId, unit: &Unit) -> UnitEntry {
    UnitEntry {
        id: u.to_string(),
        sides: unit.sides,
        chirality: match unit.chirality {
            Chirality::Clockwise => ChiralityName::Cw,
            Chirality::CounterClockwise => ChiralityName::Ccw,
        },
        center: unit.center.position.into(),
        rods: strings(&unit.rods),
        contacts: strings(&unit.contacts),
    }
}

fn support_entry(s: &Support) -> SupportEntry {
    SupportEntry { rod: s.rod.to_string(), end: s.end.into(), point: s.point.into() }
}

fn clash_entry(clash: &Clash) -> (String, String, f64) {
    let [one, other] = clash.rods.map(|r| r.to_string());
    (one, other, clash.distance)
}

fn dropped_entry((i, d): (usize, &Dropped)) -> DroppedEntry {
    DroppedEntry {
        unit: format!("D{:03}", i + 1),
        center: d.center.into(),
        reason: d.reason.clone(),
    }
}

fn strings<T: Display>(ids: &[T]) -> Vec<String> {
    ids.iter().map(T::to_string).collect()
}

/// The number of each name.
struct Places<'a> {
    rods: HashMap<&'a str, RodId>,
    contacts: HashMap<&'a str, ContactId>,
    units: HashMap<&'a str, UnitId>,
}

fn places<'a, I: Id + Display>(
    ids: impl Iterator<Item = &'a str>,
) -> Result<HashMap<&'a str, I>, StructureFault> {
    let place = |(i, id): (usize, &'a str)| {
        let expected = I::new(i).to_string();
        if id == expected {
            Ok((id, I::new(i)))
        } else {
            Err(StructureFault::Order { found: id.to_owned(), expected })
        }
    };
    ids.enumerate().map(place).collect()
}

/// The contacts of every rod by distance from end A.
fn along_rods(
    rods: usize,
    contacts: &IdVec<ContactId, Contact>,
) -> IdVec<RodId, Vec<(f64, ContactId)>> {
    let mut along: IdVec<RodId, Vec<_>> = vec![Vec::new(); rods].into();
    for (c, contact) in contacts.enumerate() {
        along[contact.over].push((contact.at_over, c));
        along[contact.under].push((contact.at_under, c));
    }
    for list in along.iter_mut() {
        list.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }
    along
}

/// Names are looked up without a check: [`Structure::check`] found them all.
impl Places<'_> {
    fn contact(&self, c: &ContactEntry) -> Contact {
        let kind = match (c.end_over, c.end_under) {
            (Some(over), Some(under)) if c.kind == ContactKindName::End => {
                ContactKind::End([over.into(), under.into()])
            }
            _ => ContactKind::Cross,
        };
        Contact {
            kind,
            over: self.rods[c.over.as_str()],
            under: self.rods[c.under.as_str()],
            at_over: c.at_over,
            at_under: c.at_under,
            angle: c.angle.to_radians(),
            gap: c.gap,
            normal: c.normal.into(),
            unit: self.units[c.unit.as_str()],
        }
    }

    fn rod(&self, r: &RodEntry, diameters: [f64; 2], along: &[(f64, ContactId)]) -> Rod {
        Rod {
            axis: Axis { a: r.a.into(), b: r.b.into() },
            diameters,
            units: r.units.iter().map(|u| self.units[u.as_str()]).collect(),
            border: r.border,
            contacts: along.iter().map(|&(_, c)| c).collect(),
        }
    }

    fn unit(&self, u: &UnitEntry, contacts: &IdVec<ContactId, Contact>) -> Unit {
        let round: Vec<ContactId> = u.contacts.iter().map(|c| self.contacts[c.as_str()]).collect();
        let normal: Vector3 = round.iter().map(|&c| contacts[c].normal).sum();
        Unit {
            center: SurfacePoint {
                position: Point3::from(u.center),
                normal: normal.try_normalize(0.0).unwrap_or_else(Vector3::z),
            },
            chirality: match u.chirality {
                ChiralityName::Cw => Chirality::Clockwise,
                ChiralityName::Ccw => Chirality::CounterClockwise,
            },
            sides: u.sides,
            rods: u.rods.iter().map(|r| self.rods[r.as_str()]).collect(),
            contacts: round,
        }
    }
}
