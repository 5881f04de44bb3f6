//! What must hold in every structure: checked before one is written and after one
//! is read.

use super::{ContactKindName, Structure};
use std::collections::HashSet;
use thiserror::Error;

/// What is wrong inside a structure.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum StructureFault {
    /// There is nothing to build.
    #[error("it has no rods")]
    NoRods,
    /// The diameter is no diameter.
    #[error("a rod diameter of {0} mm is not a length above 0")]
    Diameter(f64),
    /// The diameter of a rod is no diameter.
    #[error("{rod} has a diameter of {diameter} mm, which is not a length above 0")]
    RodDiameter {
        /// The rod.
        rod: String,
        /// What it is given, mm.
        diameter: f64,
    },
    /// Two elements share a name.
    #[error("{0} stands there twice")]
    Duplicate(String),
    /// An element names another one that is not there.
    #[error("{by} names {missing}, which is not there")]
    Missing {
        /// The element that names it.
        by: String,
        /// The name without an element.
        missing: String,
    },
    /// A number is infinite or not a number.
    #[error("{0} holds a number that is not finite")]
    NotFinite(String),
    /// A rod has no length, so no direction.
    #[error("{0} has the same point at both ends")]
    NoLength(String),
    /// A contact of a rod with itself.
    #[error("{0} names one rod twice")]
    Itself(String),
    /// An end contact does not say which ends meet.
    #[error("{0} is an end contact without end_over and end_under")]
    NoEnds(String),
    /// An element is not numbered by its place, as a frame numbers it.
    #[error("{found} stands where {expected} is expected")]
    Order {
        /// The name in the file.
        found: String,
        /// The name of that place.
        expected: String,
    },
    /// A unit has fewer rods than sides.
    #[error("{0} has fewer rods than sides")]
    Sides(String),
    /// A value that JSON cannot hold.
    #[error("it cannot be written as JSON: {0}")]
    Json(String),
}

impl Structure {
    /// Whether all numbers are finite, all names are there and none is there twice.
    ///
    /// # Errors
    /// The first [`StructureFault`].
    pub fn check(&self) -> Result<(), StructureFault> {
        if !(self.rod_diameter > 0.0 && self.rod_diameter.is_finite()) {
            return Err(StructureFault::Diameter(self.rod_diameter));
        }
        finite("ground", &[self.ground])?;
        if self.rods.is_empty() {
            return Err(StructureFault::NoRods);
        }
        let names = Names {
            rods: unique(self.rods.iter().map(|r| r.id.as_str()))?,
            contacts: unique(self.contacts.iter().map(|c| c.id.as_str()))?,
            units: unique(self.units.iter().map(|u| u.id.as_str()))?,
        };
        self.check_rods(&names)?;
        self.check_contacts(&names)?;
        self.check_units(&names)?;
        for s in &self.supports {
            let by = format!("the support of {}", s.rod);
            named(&names.rods, &by, &s.rod)?;
            finite(&by, &s.point)?;
        }
        for (one, other, distance) in &self.report.clashes {
            let by = "a clash";
            named(&names.rods, by, one)?;
            named(&names.rods, by, other)?;
            finite(by, &[*distance])?;
        }
        self.report.dropped.iter().try_for_each(|d| finite(&d.unit, &d.center))
    }

    fn check_rods(&self, names: &Names) -> Result<(), StructureFault> {
        for rod in &self.rods {
            if let Some(&bad) = self.diameters(rod).iter().find(|d| !(**d > 0.0 && d.is_finite())) {
                return Err(StructureFault::RodDiameter { rod: rod.id.clone(), diameter: bad });
            }
            finite(&rod.id, &rod.a)?;
            finite(&rod.id, &rod.b)?;
            finite(&rod.id, &[rod.length])?;
            if rod.a == rod.b {
                return Err(StructureFault::NoLength(rod.id.clone()));
            }
            rod.units.iter().try_for_each(|u| named(&names.units, &rod.id, u))?;
        }
        Ok(())
    }

    fn check_contacts(&self, names: &Names) -> Result<(), StructureFault> {
        for c in &self.contacts {
            named(&names.rods, &c.id, &c.over)?;
            named(&names.rods, &c.id, &c.under)?;
            named(&names.units, &c.id, &c.unit)?;
            finite(&c.id, &[c.at_over, c.at_under, c.angle, c.gap])?;
            finite(&c.id, &c.normal)?;
            if c.over == c.under {
                return Err(StructureFault::Itself(c.id.clone()));
            }
            if c.kind == ContactKindName::End && (c.end_over.is_none() || c.end_under.is_none()) {
                return Err(StructureFault::NoEnds(c.id.clone()));
            }
        }
        Ok(())
    }

    fn check_units(&self, names: &Names) -> Result<(), StructureFault> {
        for u in &self.units {
            finite(&u.id, &u.center)?;
            if u.rods.len() < u.sides {
                return Err(StructureFault::Sides(u.id.clone()));
            }
            u.rods.iter().try_for_each(|r| named(&names.rods, &u.id, r))?;
            u.contacts.iter().try_for_each(|c| named(&names.contacts, &u.id, c))?;
        }
        Ok(())
    }
}

/// The names that elements may refer to.
struct Names<'a> {
    rods: HashSet<&'a str>,
    contacts: HashSet<&'a str>,
    units: HashSet<&'a str>,
}

fn unique<'a>(ids: impl Iterator<Item = &'a str>) -> Result<HashSet<&'a str>, StructureFault> {
    let mut seen = HashSet::new();
    for id in ids {
        if !seen.insert(id) {
            return Err(StructureFault::Duplicate(id.to_owned()));
        }
    }
    Ok(seen)
}

fn named(names: &HashSet<&str>, by: &str, id: &str) -> Result<(), StructureFault> {
    if names.contains(id) {
        Ok(())
    } else {
        Err(StructureFault::Missing { by: by.to_owned(), missing: id.to_owned() })
    }
}

fn finite(at: &str, numbers: &[f64]) -> Result<(), StructureFault> {
    if numbers.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(StructureFault::NotFinite(at.to_owned()))
    }
}
