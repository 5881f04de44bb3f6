//! Which rod of each contact goes over the other (paper, section 4.2 and Fig. 4).
//!
//! Where the surface is curved, the rises decide. Where it is flat or saddle-shaped they
//! are near zero, and the choice is free: the paper leaves it at that. Here contacts are
//! then turned over, one at a time, while the [cost](flip) falls: the least squared move of
//! rod ends that meets all contacts. This is done on overlapping [patches]; on each,
//! contacts outside it count as free, so its cost is a lower bound.

mod factor;
mod flip;
mod patches;

use super::axis::Axis;
use super::gaps::{Incidence, Joint, Row, incidence, product, rows};
use crate::ids::{ContactId, IdVec, RodId};
use factor::Factor;
use flip::Choice;
use patches::{Patch, patches};
use serde::{Deserialize, Serialize};

/// The rule by which over and under are chosen.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Layering {
    /// As follow where the surface is curved; elsewhere so that the rods move least
    #[default]
    Auto,
    /// The rod that lies higher on the surface goes over
    Follow,
    /// Every rod ends on top of the next one, all round every unit
    Reciprocal,
}

/// Rises of more than this, in diameters, decide by their sign. Against such a rise a
/// contact has to be moved by 1.25 diameters or more, with it by at most 0.75. At 0.5,
/// contacts on the flanks of vaults are turned over too, and the largest move grows.
const CLEAR: f64 = 0.25;

/// Rises below this, in diameters, are rounding of a flat surface.
const FLAT: f64 = 1e-6;

/// The most contacts that a patch decides on.
const CORE: usize = 150;

/// Rings of contacts round them that it takes into account.
const RINGS: usize = 3;

/// The most times that all patches are gone through; patches whose contacts were left as
/// they are since are passed over.
const SWEEPS: usize = 12;

/// For every contact, whether the ending rod goes over the passing one. The axes run from
/// contact to contact, and each joint is given with its ending rod over; `rises` holds
/// the height of the ending rod over the passing one, mm, and none where ends meet.
///
/// # Errors
/// A contact whose rods are parallel.
pub fn layer(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    rises: &IdVec<ContactId, Option<f64>>,
    rule: Layering,
) -> Result<IdVec<ContactId, bool>, ContactId> {
    match rule {
        Layering::Auto => auto(axes, joints, [CORE, RINGS]),
        Layering::Follow => Ok(rises.iter().map(|r| r.is_none_or(|rise| rise >= 0.0)).collect()),
        Layering::Reciprocal => Ok(rises.iter().map(|_| true).collect()),
    }
}

/// The equations of all contacts, and the choice so far.
struct System {
    rows: Vec<Row>,
    /// The rows of each rod.
    around: IdVec<RodId, Vec<Incidence>>,
    /// The first row of each contact.
    first: IdVec<ContactId, usize>,
    /// +1 or −1 for every row.
    signs: Vec<f64>,
    /// Rows whose sign is free.
    free: Vec<bool>,
    /// K⁻¹ᵢᵢ on the patch whose core holds the row, once known: signs do not change it.
    diagonal: Vec<Option<f64>>,
}

fn auto(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
    [core, rings]: [usize; 2],
) -> Result<IdVec<ContactId, bool>, ContactId> {
    let mut system = System::new(axes, joints)?;
    // On domes no contact is free, and there is nothing to do.
    if system.free.contains(&true) {
        let rods_of = joints.iter().map(|j| [j.over, j.under]).collect();
        let mut patches = patches(&rods_of, axes.len(), core, rings);
        patches.retain(|p| p.core.iter().any(|&c| system.free[system.first[c]]));
        system.settle_all(&patches);
    }
    Ok(joints.ids().map(|c| system.signs[system.first[c]] > 0.0).collect())
}

impl System {
    fn new(axes: &IdVec<RodId, Axis>, joints: &IdVec<ContactId, Joint>) -> Result<Self, ContactId> {
        let rows = rows(axes, joints)?;
        let mut first: IdVec<ContactId, usize> = vec![0; joints.len()].into();
        for (i, row) in rows.iter().enumerate().rev() {
            first[row.contact] = i;
        }
        let start = |row: &Row| if row.gap < -FLAT * row.diameter { -1.0 } else { 1.0 };
        let signs = rows.iter().map(|r| if crosses(r) { start(r) } else { 1.0 }).collect();
        let free = rows.iter().map(|r| crosses(r) && r.gap.abs() <= CLEAR * r.diameter).collect();
        let diagonal = vec![None; rows.len()];
        Ok(Self { around: incidence(axes.len(), &rows), rows, first, signs, free, diagonal })
    }

    /// Goes through the patches until nothing changes.
    fn settle_all(&mut self, patches: &[Patch]) {
        // When each contact was last turned over, and each patch last seen to.
        let mut turned: IdVec<ContactId, usize> = vec![1; self.first.len()].into();
        let mut seen = vec![0; patches.len()];
        let mut now = 1;
        for _ in 0..SWEEPS {
            let before = now;
            for (patch, seen) in patches.iter().zip(&mut seen) {
                if patch.core.iter().chain(&patch.rim).all(|&c| turned[c] <= *seen) {
                    continue;
                }
                now += 1;
                for contact in self.settle(patch) {
                    turned[contact] = now;
                }
                *seen = now;
            }
            if now == before {
                break;
            }
        }
    }

    /// Chooses in the core of a patch; the contacts that were turned over.
    fn settle(&mut self, patch: &Patch) -> Vec<ContactId> {
        let mut places = self.rows_of(&patch.core);
        let core = places.len();
        let free: Vec<usize> = (0..core).filter(|&i| self.free[places[i]]).collect();
        places.extend(self.rows_of(&patch.rim));
        let Some(factor) = self.factor(&places, core) else { return Vec::new() };
        let mut diagonal = vec![0.0; core];
        for &i in &free {
            diagonal[i] = *self.diagonal[places[i]].get_or_insert_with(|| factor.diagonal(i));
        }
        let mut choice = self.choice(&places, &factor, diagonal);
        choice.settle(&free);
        let mut turned = Vec::new();
        for i in free {
            let row = places[i];
            if self.signs[row] != choice.sign(i) {
                self.signs[row] = choice.sign(i);
                turned.push(self.rows[row].contact);
            }
        }
        turned
    }

    /// The choice so far on some rows, those of a core first.
    fn choice<'a>(&self, places: &[usize], factor: &'a Factor, diagonal: Vec<f64>) -> Choice<'a> {
        let rows = || places.iter().map(|&row| (&self.rows[row], self.signs[row]));
        let signs = rows().map(|(_, sign)| sign).take(diagonal.len()).collect();
        let residual = rows().map(|(row, sign)| sign * row.wanted - row.gap).collect();
        let wanted = rows().map(|(row, _)| row.wanted).take(diagonal.len()).collect();
        let diameter = rows().next().map_or(0.0, |(row, _)| row.diameter);
        Choice::new(factor, diagonal, signs, residual, wanted, diameter)
    }

    /// Factors K of some rows, the first `core` of them the core; none where they
    /// contradict each other, as closing will find.
    fn factor(&self, places: &[usize], core: usize) -> Option<Factor> {
        let mut order: Vec<(usize, usize)> =
            places.iter().enumerate().map(|(i, &row)| (row, i)).collect();
        order.sort_unstable();
        let place = |row: usize| {
            order.binary_search_by_key(&row, |&(row, _)| row).ok().map(|at| order[at].1)
        };
        let mut parts = Vec::new();
        for (i, &row) in places.iter().enumerate() {
            for (rod, over) in self.rows[row].rods.into_iter().zip([true, false]) {
                for &other in &self.around[rod] {
                    if let Some(j) = place(other.row).filter(|&j| j <= i) {
                        parts.push((i, j, product(&self.rows, Incidence { row, over }, other)));
                    }
                }
            }
        }
        Factor::new(places.len(), core, &parts)
    }

    /// The rows of some contacts.
    fn rows_of(&self, contacts: &[ContactId]) -> Vec<usize> {
        let of = |&c: &ContactId| (self.first[c]..).take_while(move |&i| self.is_of(i, c));
        contacts.iter().flat_map(of).collect()
    }

    fn is_of(&self, row: usize, contact: ContactId) -> bool {
        self.rows.get(row).is_some_and(|r| r.contact == contact)
    }
}

/// Whether a row is of a crossing: where ends meet, no gap is wanted.
fn crosses(row: &Row) -> bool {
    row.wanted > 0.0
}

#[cfg(test)]
mod tests;
