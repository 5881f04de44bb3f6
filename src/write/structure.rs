//! `structure.json`, version 1: the whole structure with every digit.
//!
//! Lengths in mm, angles in degrees, z up. Keys come in a fixed order, and each rod,
//! contact, unit and support takes a line of its own, so that two files compare line
//! by line. Files of version 1 may carry more keys than are read here: they are
//! skipped.
//!
//! Numbers are written as the shortest text that is read back as the same double.

mod check;
mod frame;
mod read;

pub use check::StructureFault;
pub use read::{StructureError, parse_structure, read_structure};

use super::json::Document;
use crate::frame::End;
use serde::{Deserialize, Serialize};

/// What the key `format` says in every such file.
pub const FORMAT: &str = "rodwright-structure";
/// The version that is written, and the only one that is read.
pub const VERSION: u64 = 1;

/// A structure as the file holds it.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Structure {
    /// Nominal diameter of the rods, mm.
    pub rod_diameter: f64,
    /// Height of the ground, mm.
    pub ground: f64,
    /// The rods, in the order of their numbers.
    pub rods: Vec<RodEntry>,
    /// The contacts, in the order of their numbers.
    pub contacts: Vec<ContactEntry>,
    /// The units, in the order of their numbers.
    pub units: Vec<UnitEntry>,
    /// Where rods stand on the ground.
    pub supports: Vec<SupportEntry>,
    /// What is wrong or missing.
    #[serde(default)]
    pub report: Report,
}

/// A rod.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RodEntry {
    /// `R001` …
    pub id: String,
    /// End A of the axis, the numbered end.
    pub a: [f64; 3],
    /// End B of the axis.
    pub b: [f64; 3],
    /// Length of the axis.
    pub length: f64,
    /// Name of its length class.
    pub class: String,
    /// The units that it belongs to.
    pub units: Vec<String>,
    /// Whether it belongs to one unit only.
    pub border: bool,
    /// Its diameter; the nominal one where a file has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<DiameterEntry>,
}

/// The diameter of a rod, mm.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(untagged)]
pub enum DiameterEntry {
    /// All along.
    Even(f64),
    /// At end A and at end B; it tapers evenly between them.
    Tapered([f64; 2]),
}

impl DiameterEntry {
    /// At end A and at end B.
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Even(diameter) => [diameter; 2],
            Self::Tapered(ends) => ends,
        }
    }
}

impl From<[f64; 2]> for DiameterEntry {
    fn from([a, b]: [f64; 2]) -> Self {
        if a == b { Self::Even(a) } else { Self::Tapered([a, b]) }
    }
}

/// A place where two rods touch.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ContactEntry {
    /// `C0001` …
    pub id: String,
    /// How they touch.
    pub kind: ContactKindName,
    /// The rod on the outer side.
    pub over: String,
    /// The other rod.
    pub under: String,
    /// From end A of the over rod to the contact, along the axis.
    pub at_over: f64,
    /// The same along the under rod.
    pub at_under: f64,
    /// Between the axes, 0 to 90.
    pub angle: f64,
    /// Distance of the axes.
    pub gap: f64,
    /// Unit normal of the surface at the contact.
    pub normal: [f64; 3],
    /// The unit that it belongs to.
    pub unit: String,
    /// Of an end contact: which end of the over rod it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_over: Option<EndName>,
    /// Of an end contact: which end of the under rod it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_under: Option<EndName>,
}

/// How two rods touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactKindName {
    /// One lies across the other.
    Cross,
    /// Two ends meet.
    End,
}

impl ContactKindName {
    /// `cross` or `end`, as files name it.
    pub fn code(self) -> &'static str {
        match self {
            Self::Cross => "cross",
            Self::End => "end",
        }
    }
}

impl From<crate::frame::ContactKind> for ContactKindName {
    fn from(kind: crate::frame::ContactKind) -> Self {
        match kind {
            crate::frame::ContactKind::Cross => Self::Cross,
            crate::frame::ContactKind::End(_) => Self::End,
        }
    }
}

/// An end of a rod, as files name it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EndName {
    /// The numbered end.
    A,
    /// The other one.
    B,
}

impl EndName {
    /// `A` or `B`, as builders read it.
    pub fn letter(self) -> &'static str {
        End::from(self).letter()
    }
}

impl From<End> for EndName {
    fn from(end: End) -> Self {
        match end {
            End::A => Self::A,
            End::B => Self::B,
        }
    }
}

impl From<EndName> for End {
    fn from(end: EndName) -> Self {
        match end {
            EndName::A => Self::A,
            EndName::B => Self::B,
        }
    }
}

/// A unit.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct UnitEntry {
    /// `U001` …
    pub id: String,
    /// Number of its rods.
    pub sides: usize,
    /// Which way its rods run round, seen from outside.
    pub chirality: ChiralityName,
    /// Its middle, on the surface.
    pub center: [f64; 3],
    /// Its rods in order.
    pub rods: Vec<String>,
    /// Its contacts in order.
    pub contacts: Vec<String>,
}

/// A sense of rotation, as files name it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChiralityName {
    /// Clockwise.
    Cw,
    /// Counter-clockwise.
    Ccw,
}

/// A rod end that stands on the ground.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SupportEntry {
    /// The rod.
    pub rod: String,
    /// Which of its ends.
    pub end: EndName,
    /// Where the axis meets the ground.
    pub point: [f64; 3],
}

/// What is wrong with a structure, and what was left out of it.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Report {
    /// Pairs of rods that run into each other, with the distance of their axes.
    #[serde(default)]
    pub clashes: Vec<(String, String, f64)>,
    /// Units that were left out.
    #[serde(default)]
    pub dropped: Vec<DroppedEntry>,
}

/// A unit that was left out.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct DroppedEntry {
    /// `D001` …: it has no number among the units.
    pub unit: String,
    /// Its middle, on the surface.
    pub center: [f64; 3],
    /// Why.
    pub reason: String,
}

impl Structure {
    /// The text of the file.
    ///
    /// # Errors
    /// [`StructureFault`] for a structure that could not be read back.
    pub fn to_json(&self) -> Result<String, StructureFault> {
        self.check()?;
        self.document().map_err(|e| StructureFault::Json(e.to_string()))
    }

    fn document(&self) -> Result<String, serde_json::Error> {
        let mut document = Document::new();
        document.value("format", FORMAT)?;
        document.value("version", &VERSION)?;
        document.value("rod_diameter", &self.rod_diameter)?;
        document.value("ground", &self.ground)?;
        document.list("rods", &self.rods)?;
        document.list("contacts", &self.contacts)?;
        document.list("units", &self.units)?;
        document.list("supports", &self.supports)?;
        let mut report = Document::new();
        report.list("clashes", &self.report.clashes)?;
        report.list("dropped", &self.report.dropped)?;
        document.nested("report", report)?;
        Ok(document.finish())
    }

    /// The diameters of a rod at end A and at end B, mm.
    pub fn diameters(&self, rod: &RodEntry) -> [f64; 2] {
        rod.diameter.map_or([self.rod_diameter; 2], DiameterEntry::ends)
    }

    /// The rod of that name.
    pub fn rod(&self, id: &str) -> Option<&RodEntry> {
        self.rods.iter().find(|r| r.id == id)
    }

    /// The contact of that name.
    pub fn contact(&self, id: &str) -> Option<&ContactEntry> {
        self.contacts.iter().find(|c| c.id == id)
    }

    /// The unit of that name.
    pub fn unit(&self, id: &str) -> Option<&UnitEntry> {
        self.units.iter().find(|u| u.id == id)
    }
}

#[cfg(test)]
mod tests;
