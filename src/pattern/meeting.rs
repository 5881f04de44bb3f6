//! Where the rods in a tile meet: those of its own unit, and those of neighbours that
//! come in to rest on them (paper, section 3.1 and Fig. 6b, c).
//!
//! Contacts are found from the plane geometry alone, so that a pattern passes from one
//! kind of connection to another as its figures change.

use super::{FlatUnit, Line, Stick};
use nalgebra::{Point2, Vector2};

/// A rod as a tile sees it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Member {
    /// The rod of the tile's own unit across this edge.
    Outer(usize),
    /// An inner rod of the tile's own unit.
    Inner(usize),
    /// The rod of the neighbour across this edge.
    Guest(usize),
}

/// Two rods that touch in a tile.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Meeting {
    /// The rod that ends there, but for its overhang; where both do or none, the one
    /// that comes later in the order of [`Member`].
    pub ending: Member,
    /// The other one.
    pub passing: Member,
    /// Where.
    pub at: Point2<f64>,
    /// How far along the ending and the passing rod: from the edge inwards, and for inner
    /// rods from their first end.
    pub along: [f64; 2],
}

impl Meeting {
    /// The side of the tile on whose very edge the two rods across it touch: both tiles see
    /// that contact.
    pub fn on_side(&self) -> Option<usize> {
        match (self.ending, self.passing) {
            (Member::Guest(i), Member::Outer(j)) | (Member::Outer(j), Member::Guest(i)) => {
                (i == j && self.along.iter().all(|s| s.abs() < TOUCH)).then_some(i)
            }
            _ => None,
        }
    }
}

/// A rod of a neighbour that comes in across an edge.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Guest {
    /// Which edge.
    pub side: usize,
    /// Its line, into the tile.
    pub line: Line,
    /// It rests on the rod of the unit that it meets as this one: the first is 1.
    pub reach: usize,
}

/// The rods of a unit in its tile's flat picture.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Figure {
    /// The outer rods, in the order of the edges.
    pub outer: Vec<Line>,
    /// Where hand-drawn outer rods end, as distances from the edge; empty where they make
    /// a circuit.
    pub stops: Vec<f64>,
    /// The inner rods.
    pub inner: Vec<Stick>,
}

/// All contacts in a tile.
#[derive(Clone, PartialEq, Debug)]
pub struct Meetings {
    /// The contacts; in a circuit, contact i between outer rods i and i + 1 comes first.
    pub all: Vec<Meeting>,
    /// How many of them make the circuit: as many as there are outer rods, or none.
    pub circuit: usize,
    /// Whether the unit is counter-clockwise.
    pub counter_clockwise: bool,
}

/// Why rods do not make a unit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unmet {
    /// The outer rods do not run round in one circuit.
    NoCircuit,
    /// The rod that comes in across this edge does not meet as many rods as it should.
    Guest(usize),
}

/// A piece of a rod: from a point along a unit vector, between two distances.
#[derive(Clone, Copy, Debug)]
struct Piece {
    member: Member,
    at: Point2<f64>,
    along: Vector2<f64>,
    to: f64,
}

/// Rods that come this near to each other's ends still meet, tile edges: rounding.
const TOUCH: f64 = 1e-9;

impl Figure {
    /// The contacts in the tile, with the guests that come in.
    ///
    /// # Errors
    /// [`Unmet`].
    pub fn meetings(&self, guests: &[Guest]) -> Result<Meetings, Unmet> {
        let n = self.outer.len();
        let mut meetings = if self.stops.is_empty() {
            circuit(&self.outer)?
        } else {
            let first = &self.outer[0];
            let middle = self.outer.iter().fold(Vector2::zeros(), |s, l| s + l.at.coords);
            let away = (middle / n as f64 - first.at.coords).perp(&first.inward);
            Meetings { all: Vec::new(), circuit: 0, counter_clockwise: away > 0.0 }
        };
        if self.stops.is_empty() && self.inner.is_empty() && guests.is_empty() {
            return Ok(meetings);
        }
        let mut pieces = self.pieces(&meetings);
        if self.stops.is_empty() {
            // Outer rods meet in their circuit only.
            add_crossings(&mut meetings.all, &pieces[..n], &pieces[n..]);
            add_pairs(&mut meetings.all, &pieces[n..]);
        } else {
            add_pairs(&mut meetings.all, &pieces);
        }
        let own = pieces.len();
        for guest in guests {
            let piece = visit(guest, &pieces[..own]).ok_or(Unmet::Guest(guest.side))?;
            pieces.push(piece);
        }
        let (own, coming) = pieces.split_at(own);
        add_crossings(&mut meetings.all, own, coming);
        add_pairs(&mut meetings.all, coming);
        let circuit = meetings.circuit;
        let ends = ends(&meetings.all, &pieces);
        meetings.all[circuit..].iter_mut().for_each(|m| settle(m, &ends));
        Ok(meetings)
    }

    /// The outer rods as far as they reach in, then the inner ones.
    fn pieces(&self, circuit: &Meetings) -> Vec<Piece> {
        let reach = |i: usize| match self.stops.get(i) {
            Some(&stop) => stop,
            None => {
                let farther = |m: &Meeting| (m.ending == Member::Outer(i)).then_some(m.along[0]);
                circuit.all.iter().find_map(farther).unwrap_or(0.0)
            }
        };
        let outer = self.outer.iter().enumerate().map(|(i, line)| Piece {
            member: Member::Outer(i),
            at: line.at,
            along: line.inward.normalize(),
            to: reach(i),
        });
        let inner = self.inner.iter().enumerate().map(|(i, [from, to])| Piece {
            member: Member::Inner(i),
            at: *from,
            along: (to - from).normalize(),
            to: (to - from).norm(),
        });
        outer.chain(inner).collect()
    }
}

/// The circuit of outer rods.
fn circuit(outer: &[Line]) -> Result<Meetings, Unmet> {
    let unit = FlatUnit::new(outer).ok_or(Unmet::NoCircuit)?;
    let n = outer.len();
    let along = |i: usize, p: Point2<f64>| (p - outer[i].at).dot(&outer[i].inward.normalize());
    let meeting = |(i, &at): (usize, &Point2<f64>)| {
        let (first, second) = (i, (i + 1) % n);
        let (ending, passing) =
            if unit.counter_clockwise { (second, first) } else { (first, second) };
        Meeting {
            ending: Member::Outer(ending),
            passing: Member::Outer(passing),
            at,
            along: [along(ending, at), along(passing, at)],
        }
    };
    Ok(Meetings {
        all: unit.contacts.iter().enumerate().map(meeting).collect(),
        circuit: n,
        counter_clockwise: unit.counter_clockwise,
    })
}

/// How far along both pieces their lines cross; `None` for parallels.
fn cross(p: &Piece, q: &Piece) -> Option<[f64; 2]> {
    let sine = p.along.perp(&q.along);
    let apart = q.at - p.at;
    (sine.abs() > TOUCH).then(|| [apart.perp(&q.along) / sine, apart.perp(&p.along) / sine])
}

fn within(piece: &Piece, at: f64) -> bool {
    (-TOUCH..=piece.to + TOUCH).contains(&at)
}

fn add_crossing(found: &mut Vec<Meeting>, p: &Piece, q: &Piece) {
    let Some([s, t]) = cross(p, q) else { return };
    if within(p, s) && within(q, t) {
        let (ending, passing) = (q.member, p.member);
        found.push(Meeting { ending, passing, at: p.at + p.along * s, along: [t, s] });
    }
}

fn add_crossings(found: &mut Vec<Meeting>, some: &[Piece], others: &[Piece]) {
    some.iter().for_each(|p| others.iter().for_each(|q| add_crossing(found, p, q)));
}

fn add_pairs(found: &mut Vec<Meeting>, pieces: &[Piece]) {
    for (i, p) in pieces.iter().enumerate() {
        pieces[i + 1..].iter().for_each(|q| add_crossing(found, p, q));
    }
}

/// A guest, as far as it goes: to the rod on which it rests.
fn visit(guest: &Guest, own: &[Piece]) -> Option<Piece> {
    let (at, along) = (guest.line.at, guest.line.inward.normalize());
    let ray = Piece { member: Member::Guest(guest.side), at, along, to: f64::INFINITY };
    let mut met: Vec<f64> = own
        .iter()
        .filter_map(|piece| {
            let [s, t] = cross(&ray, piece)?;
            (s > TOUCH && within(piece, t)).then_some(s)
        })
        .collect();
    met.sort_by(f64::total_cmp);
    met.get(guest.reach - 1).map(|&to| Piece { to, ..ray })
}

/// For each rod, how far along it its first and its last contact lie.
fn ends(all: &[Meeting], pieces: &[Piece]) -> Vec<(Member, [f64; 2])> {
    let span = |piece: &Piece| {
        let along = all.iter().flat_map(|m| [(m.ending, m.along[0]), (m.passing, m.along[1])]);
        let mine = along.filter(|(member, _)| *member == piece.member).map(|(_, at)| at);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        (piece.member, mine.fold(start, |[lo, hi], at| [lo.min(at), hi.max(at)]))
    };
    pieces.iter().map(span).collect()
}

/// Finds out which of the two rods of a contact ends there.
fn settle(meeting: &mut Meeting, ends: &[(Member, [f64; 2])]) {
    let ends_there = |member: Member, at: f64| {
        ends.iter().any(|&(m, [first, last])| {
            let inner = matches!(m, Member::Inner(_));
            m == member && (at >= last || inner && at <= first)
        })
    };
    let [t, s] = meeting.along;
    if ends_there(meeting.passing, s) && !ends_there(meeting.ending, t) {
        std::mem::swap(&mut meeting.ending, &mut meeting.passing);
        meeting.along = [s, t];
    }
}

#[cfg(test)]
mod tests;
