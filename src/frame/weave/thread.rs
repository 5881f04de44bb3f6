//! Makes one rod of all that different tiles see of it, and runs its line through the
//! surface.

use super::{Placed, RodEnd, Unweavable, Weave, WovenContact, WovenRod, WovenUnit};
use crate::frame::canvas::Canvas;
use crate::frame::{Chirality, ContactKind, End};
use crate::ids::{ContactId, IdVec, RodId, TileEdgeId, TileId, UnitId};
use crate::pattern::{Join, Member};
use crate::surface::Point3;
use nalgebra::Point2;

/// A contact as it lies along a rod.
#[derive(Clone, Copy)]
struct Seat {
    /// From the tile edge that the rod crosses towards end B, in the flat picture of the
    /// tile; for inner rods from end A.
    along: f64,
    contact: ContactId,
    /// Where it lies in the flat picture of which tile.
    tile: TileId,
    at: Point2<f64>,
}

/// Where a rod crosses its tile edge, and what lies along it.
#[derive(Clone)]
struct Course {
    /// For outer rods the crossing, in the pictures of the tiles that see it.
    crossing: Vec<(TileId, Point2<f64>)>,
    seats: Vec<Seat>,
}

/// A weave that is being made.
struct Loom<'a, C> {
    canvas: &'a C,
    placed: &'a IdVec<UnitId, Placed>,
    unit_of: &'a IdVec<TileId, Option<UnitId>>,
    weave: Weave,
    courses: IdVec<RodId, Course>,
}

/// Makes the weave of tiles that are placed; `unit_of` tells which unit a tile hosts.
///
/// # Errors
/// The tiles of rods that touch fewer than two others, or whose way leaves the surface.
pub(super) fn thread(
    canvas: &impl Canvas,
    placed: &IdVec<UnitId, Placed>,
    unit_of: &IdVec<TileId, Option<UnitId>>,
) -> Result<Weave, Vec<Unweavable>> {
    let (weave, courses) = (Weave::default(), IdVec::default());
    let mut loom = Loom { canvas, placed, unit_of, weave, courses };
    loom.add_rods();
    loom.add_contacts();
    loom.join_ends();
    loom.run()
}

impl<C: Canvas> Loom<'_, C> {
    /// Makes the rods and the units, without contacts.
    fn add_rods(&mut self) {
        let (canvas, net) = (self.canvas, self.canvas.net());
        let mut shared: IdVec<TileEdgeId, Option<RodId>> = vec![None; net.edges.len()].into();
        for (unit, placed) in self.placed.enumerate() {
            let tile = placed.tile;
            let mut rods = Vec::with_capacity(placed.lines.len() + placed.inner);
            for (&edge, line) in net.tiles[tile].edges.iter().zip(&placed.lines) {
                let here = (tile, line.at);
                if let Some(known) = shared[edge] {
                    self.courses[known].crossing.push(here);
                    rods.push(known);
                    continue;
                }
                let beyond = net.across(edge, tile).and_then(|t| self.unit_of[t]);
                let (units, at_a) = match (beyond, canvas.join(edge)) {
                    (None, _) => (vec![unit], RodEnd::Free),
                    (Some(_), Join::End) => (vec![unit], RodEnd::Meets),
                    (Some(_), Join::Rest { .. }) => (vec![unit], RodEnd::Rests),
                    (Some(other), Join::Shared) => {
                        let left = net.edges[edge].left == tile;
                        (if left { vec![unit, other] } else { vec![other, unit] }, RodEnd::Rests)
                    }
                };
                let is_shared = units.len() == 2;
                self.courses.push(Course { crossing: vec![here], seats: Vec::new() });
                let rod = self.weave.rods.push(new_rod(units, at_a));
                shared[edge] = is_shared.then_some(rod);
                rods.push(rod);
            }
            for _ in 0..placed.inner {
                self.courses.push(Course { crossing: Vec::new(), seats: Vec::new() });
                rods.push(self.weave.rods.push(new_rod(vec![unit], RodEnd::Rests)));
            }
            let chirality = if placed.meetings.counter_clockwise {
                Chirality::CounterClockwise
            } else {
                Chirality::Clockwise
            };
            let (center, contacts) = (placed.center, Vec::new());
            let sides = placed.lines.len();
            let round = &placed.meetings.all[..placed.meetings.circuit];
            let corners = round.iter().map(|meeting| meeting.at).collect();
            self.weave.units.push(WovenUnit {
                tile,
                center,
                chirality,
                sides,
                rods,
                contacts,
                corners,
            });
        }
    }

    /// Makes the contacts that lie in the tiles.
    fn add_contacts(&mut self) {
        let net = self.canvas.net();
        for (unit, placed) in self.placed.enumerate() {
            let tile = placed.tile;
            for (meeting, &on) in placed.meetings.all.iter().zip(&placed.on) {
                if let Some(side) = meeting.on_side()
                    && net.edges[net.tiles[tile].edges[side]].left != tile
                {
                    continue;
                }
                let rod = |member| match member {
                    Member::Outer(i) => Some(self.weave.units[unit].rods[i]),
                    Member::Inner(i) => Some(self.weave.units[unit].rods[placed.lines.len() + i]),
                    Member::Guest(side) => {
                        let edge = net.tiles[tile].edges[side];
                        let home = net.across(edge, tile)?;
                        let side = net.tiles[home].edges.iter().position(|&e| e == edge)?;
                        Some(self.weave.units[self.unit_of[home]?].rods[side])
                    }
                };
                let (Some(ending), Some(passing)) = (rod(meeting.ending), rod(meeting.passing))
                else {
                    unreachable!("guests come from tiles that host a unit")
                };
                let kind = ContactKind::Cross;
                let contact =
                    self.weave.contacts.push(WovenContact { kind, ending, passing, unit, on });
                self.weave.units[unit].contacts.push(contact);
                let members = [meeting.ending, meeting.passing];
                for ((rod, member), along) in
                    [ending, passing].into_iter().zip(members).zip(meeting.along)
                {
                    // End B of a shared rod is in its second unit, that of others in their own.
                    let units = &self.weave.rods[rod].units;
                    let towards_b = match member {
                        Member::Guest(_) => false,
                        Member::Inner(_) => true,
                        Member::Outer(_) => units.last() == Some(&unit),
                    };
                    if let Member::Guest(side) = member {
                        let guest = placed.guests.iter().find(|g| g.side == side);
                        self.courses[rod].crossing.extend(guest.map(|g| (tile, g.line.at)));
                    }
                    let along = if towards_b { along } else { -along };
                    self.courses[rod].seats.push(Seat { along, contact, tile, at: meeting.at });
                }
            }
        }
    }

    /// Makes the contacts of rods that meet end to end, at their ends A.
    fn join_ends(&mut self) {
        let (canvas, net) = (self.canvas, self.canvas.net());
        let mut first: IdVec<TileEdgeId, Option<RodId>> = vec![None; net.edges.len()].into();
        for (unit, placed) in self.placed.enumerate() {
            for (i, &edge) in net.tiles[placed.tile].edges.iter().enumerate() {
                let rod = self.weave.units[unit].rods[i];
                if self.weave.rods[rod].ends[0] != RodEnd::Meets {
                    continue;
                }
                let Some(other) = first[edge].replace(rod) else { continue };
                let (tile, at) = (placed.tile, placed.lines[i].at);
                let Some(on) = canvas.place(tile, at) else { continue };
                let kind = ContactKind::End([End::A; 2]);
                let joined = WovenContact { kind, ending: other, passing: rod, unit, on };
                let contact = self.weave.contacts.push(joined);
                self.weave.units[unit].contacts.push(contact);
                for rod in [other, rod] {
                    self.courses[rod].seats.push(Seat { along: 0.0, contact, tile, at });
                }
            }
        }
    }

    /// Puts the contacts of every rod in order, and finds the two places through which it
    /// runs.
    fn run(mut self) -> Result<Weave, Vec<Unweavable>> {
        let mut failed = Vec::new();
        for (rod, course) in self.weave.rods.iter_mut().zip(self.courses.iter_mut()) {
            course.seats.sort_by(|p, q| p.along.total_cmp(&q.along));
            rod.contacts = course.seats.iter().map(|s| s.contact).collect();
            let fault = |reason| Unweavable { tile: self.placed[rod.units[0]].tile, reason };
            if course.seats.len() < 2 {
                failed.push(fault("one of its rods touches fewer than two others"));
                continue;
            }
            let place = |end| {
                let (tile, at) = place_of(course, rod.ends, end);
                self.canvas.place(tile, at).map(|p| p.position)
            };
            match (place(0), place(1)) {
                (Some(a), Some(b)) => rod.through = [a, b],
                _ => failed.push(fault("reaches beyond the surface")),
            }
        }
        if failed.is_empty() { Ok(self.weave) } else { Err(failed) }
    }
}

fn new_rod(units: Vec<UnitId>, at_a: RodEnd) -> WovenRod {
    let through = [Point3::origin(); 2];
    WovenRod { units, ends: [at_a, RodEnd::Rests], through, contacts: Vec::new() }
}

/// Part of the way between its two contacts, from either end, at which a rod that rests
/// on both and touches nothing else runs through the surface.
const BETWEEN: f64 = 0.25;

/// The place through which a rod runs at its end A (0) or B (1).
fn place_of(course: &Course, ends: [RodEnd; 2], end: usize) -> (TileId, Point2<f64>) {
    let seats = &course.seats;
    let (last, before) = if end == 0 {
        (seats[0], seats[1])
    } else {
        (seats[seats.len() - 1], seats[seats.len() - 2])
    };
    let crossing = |tile: TileId| course.crossing.iter().find(|(t, _)| *t == tile);
    match ends[end] {
        RodEnd::Free => *course.crossing.first().unwrap_or(&(last.tile, last.at)),
        RodEnd::Meets => (last.tile, last.at),
        RodEnd::Rests if seats.len() == 2 && ends == [RodEnd::Rests; 2] => {
            (last.tile, last.at + (before.at - last.at) * BETWEEN)
        }
        RodEnd::Rests if last.tile == before.tile => {
            (last.tile, nalgebra::center(&last.at, &before.at))
        }
        // Its last contact but one lies in another tile's picture: from the edge, then.
        RodEnd::Rests => {
            let edge = crossing(last.tile).map_or(last.at, |&(_, at)| at);
            (last.tile, nalgebra::center(&last.at, &edge))
        }
    }
}
