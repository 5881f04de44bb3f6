//! The pictures of the handout: views of the model, one of its units large, a card.

use super::markdown::Subject;
use crate::drawing::{Draw, Item, Placement, Point, Rect, Text};
use crate::frame::{Contact, Frame, Rod, Unit};
use crate::ids::{Id, IdVec, RodId, UnitId};
use crate::sheets::page::BODY;
use crate::sheets::rod_cards::Book;
use crate::sheets::view::View;
use crate::sheets::{SheetError, SheetSettings};
use crate::surface::Point3;

/// Height of a view as part of its width, and the most it may be, mm.
const VIEW: (f64, f64) = (0.72, 85.0);
/// Height of the unit as part of its width, and the most it may be, mm.
const UNIT: (f64, f64) = (0.7, 72.0);
/// How far rods of the unit reach beyond its contacts: so much of the distance between two.
const BEYOND: f64 = 0.75;
/// Contacts of a rod are taken to be so many diameters apart at least.
const LEAST_STRETCH: f64 = 4.0;
/// Room round the unit for the numbers of its rods, mm.
const NUMBERS: f64 = 9.0;
/// From the end of a rod to the middle of its number, mm.
const BESIDE: f64 = 5.0;

/// What the pictures are drawn from.
pub(super) struct Pictures<'a> {
    pub frame: &'a Frame,
    pub settings: &'a SheetSettings,
    /// The unit that is shown.
    pub unit: Option<UnitId>,
    /// The rod whose card is shown.
    pub rod: Option<RodId>,
}

impl Pictures<'_> {
    /// Height of a picture that is so wide, mm.
    pub fn height(&self, of: Subject, width: f64) -> Result<f64, SheetError> {
        let share = |(part, most): (f64, f64)| (width * part).min(most);
        Ok(match of {
            Subject::Isometric | Subject::Plan => share(VIEW),
            Subject::Unit if self.unit.is_some() => share(UNIT),
            Subject::RodCard => match self.rod {
                Some(rod) => Book::new(self.frame, self.settings, width).card(rod)?.height,
                None => 0.0,
            },
            Subject::Unit => 0.0,
        })
    }

    /// The picture in its room.
    pub fn draw(&self, of: Subject, room: Rect) -> Result<Vec<Item>, SheetError> {
        let mut items = Vec::new();
        match of {
            Subject::Isometric => drop(View::isometric().draw(self.frame, room, &mut items)),
            Subject::Plan => drop(View::plan().draw(self.frame, room, &mut items)),
            Subject::Unit => {
                if let Some(unit) = self.unit {
                    draw_unit(self.frame, &self.frame.units[unit], room, &mut items)?;
                }
            }
            Subject::RodCard => {
                if let Some(rod) = self.rod {
                    let card = Book::new(self.frame, self.settings, room.width()).card(rod)?;
                    items.place(&card.items, &Placement::at(room.min));
                }
            }
        }
        Ok(items)
    }
}

/// The unit that shows best what a unit is: a circuit of rods that cross, if there is one
/// without rods of the border, high up and in the middle. None in a frame without units.
pub(super) fn example(frame: &Frame) -> Option<UnitId> {
    let middle = crate::shop::feet::middle(frame);
    let rank = |&(id, unit): &(UnitId, &Unit)| {
        let circuit = is_circuit(frame, unit);
        let inner = !unit.rods.iter().any(|&rod| frame.rods[rod].border);
        let p = unit.center.position;
        let off = (p.x - middle[0]).hypot(p.y - middle[1]);
        // Whole mm, so that rounding does not choose between units that lie alike.
        (!circuit, !inner, off.round() as i64, -(p.z.round() as i64), id)
    };
    frame.units.enumerate().min_by_key(rank).map(|(id, _)| id)
}

/// Whether each rod of a unit lies over one neighbour and under the other.
pub(super) fn is_circuit(frame: &Frame, unit: &Unit) -> bool {
    let round = frame.circuit(unit);
    let over = |k: usize| {
        let c = &frame.contacts[round[k]];
        c.over == unit.rods[k]
    };
    !round.is_empty() && (1..round.len()).all(|k| over(k) == over(0))
}

/// The rods of a unit alone, cut off a little beyond the contacts that they have in it, and
/// their numbers.
fn alone(frame: &Frame, unit: &Unit) -> (Frame, Vec<RodId>) {
    let of_unit: Vec<&Contact> = unit.contacts.iter().map(|&c| &frame.contacts[c]).collect();
    let mut names: Vec<RodId> = of_unit.iter().flat_map(|c| [c.over, c.under]).collect();
    names.sort();
    names.dedup();
    let mut rods = IdVec::default();
    // Where each rod is cut off: its new end A, from the old one.
    let mut starts = Vec::new();
    for &name in &names {
        let whole = &frame.rods[name];
        let at = of_unit.iter().filter_map(|c| match name {
            _ if c.over == name => Some(c.at_over),
            _ if c.under == name => Some(c.at_under),
            _ => None,
        });
        let both = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = at.fold(both, |(low, high), s| (low.min(s), high.max(s)));
        let beyond = BEYOND * (high - low).max(LEAST_STRETCH * whole.thickest());
        let from = (low - beyond).max(0.0);
        let to = (high + beyond).min(whole.axis.length());
        starts.push(from);
        rods.push(Rod {
            axis: whole.axis.between(from, to),
            diameters: [from, to].map(|s| whole.diameter_at(s)),
            units: Vec::new(),
            border: false,
            contacts: Vec::new(),
        });
    }
    let mut contacts = IdVec::default();
    let new = |old: RodId| names.binary_search(&old).expect("rods of contacts were all named");
    for c in of_unit {
        let (over, under) = (new(c.over), new(c.under));
        let (at_over, at_under) = (c.at_over - starts[over], c.at_under - starts[under]);
        let [over, under] = [over, under].map(RodId::new);
        let id = contacts.push(Contact { over, under, at_over, at_under, ..c.clone() });
        rods[over].contacts.push(id);
        rods[under].contacts.push(id);
    }
    let part = Frame {
        diameter: frame.diameter,
        ground: frame.ground,
        rods,
        contacts,
        units: IdVec::default(),
        supports: Vec::new(),
        dropped: Vec::new(),
    };
    (part, names)
}

/// The unit seen from outside, each rod with its number at the end that lies farther out.
fn draw_unit(
    frame: &Frame,
    unit: &Unit,
    room: Rect,
    out: &mut Vec<Item>,
) -> Result<(), SheetError> {
    let (part, names) = alone(frame, unit);
    let view = View::onto(&unit.center.normal);
    let inner = room.inset(NUMBERS);
    view.draw(&part, inner, out);
    let layout = view.layout(&part, inner);
    let place = |p: &Point3| layout.place(view.project(p));
    let middle = place(&unit.center.position);
    for (rod, name) in part.rods.iter().zip(names) {
        let [a, b] = [place(&rod.axis.a), place(&rod.axis.b)];
        let far = |p: Point| (p[0] - middle[0]).hypot(p[1] - middle[1]);
        let (inside, outside) = if far(a) > far(b) { (b, a) } else { (a, b) };
        let d = [outside[0] - inside[0], outside[1] - inside[1]];
        let length = d[0].hypot(d[1]).max(f64::MIN_POSITIVE);
        let at = [0, 1].map(|i| outside[i] + d[i] / length * BESIDE);
        let mut text = Text::new(at, BODY, name.to_string());
        text.bold().middle().vcenter();
        out.push(text.into());
    }
    Ok(())
}
