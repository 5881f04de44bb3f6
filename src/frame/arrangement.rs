//! How the rods of a frame lie on each other (paper, Fig. 4), and where they have to be
//! tied to stay there.

use super::form::Formed;
use super::{Contact, ContactKind, Frame, Unit};
use crate::ids::{ContactId, IdVec};

/// Units by who goes over in them, and the contacts to be tied.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Arrangement {
    /// Units in which every rod ends on top of the next.
    pub over: usize,
    /// Units in which every rod ends below the next.
    pub under: usize,
    /// Units in which some do, and some do not. Those without a circuit are in none of the
    /// three.
    pub mixed: usize,
    /// Contacts that gravity would open.
    pub tied: Vec<ContactId>,
}

/// Counts the units of a frame, and lists its contacts to be tied.
pub fn arrangement(formed: &Formed) -> Arrangement {
    let (frame, ending_over) = (&formed.frame, &formed.ending_over);
    let mut found = Arrangement::default();
    for unit in &frame.units {
        match over_and_under(frame, unit, ending_over) {
            [0, 0] => {}
            [_, 0] => found.over += 1,
            [0, _] => found.under += 1,
            _ => found.mixed += 1,
        }
    }
    let tied = |&(id, c): &(ContactId, &Contact)| drops(c, ending_over[id]);
    found.tied = frame.contacts.enumerate().filter(tied).map(|(id, _)| id).collect();
    found
}

/// How many rods of a unit's circuit end on top of the next one, and how many below.
fn over_and_under(frame: &Frame, unit: &Unit, ending_over: &IdVec<ContactId, bool>) -> [usize; 2] {
    let round = frame.circuit(unit);
    let over = round.iter().filter(|&&c| ending_over[c]).count();
    [over, round.len() - over]
}

/// Whether the end of a rod would drop away from the rod that it ends at: it hangs below
/// that rod. Weight alone is looked at, not what the rest of the frame presses; on an
/// upright wall, where neither rod lies on the other, nothing counts as dropping.
fn drops(contact: &Contact, ending_over: bool) -> bool {
    let up = contact.normal.z;
    contact.kind == ContactKind::Cross && if ending_over { up < 0.0 } else { up > 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::canvas::PlaneCanvas;
    use crate::frame::canvas::fixture::Sheet;
    use crate::frame::close::Way;
    use crate::frame::form::{FormSettings, form};
    use crate::frame::layer::Layering;
    use crate::ids::Id;
    use crate::pattern::Pattern;
    use crate::surface::Vector3;
    use crate::tiling::Placement;

    fn formed(layering: Layering) -> Formed {
        let pattern = Pattern::named("4.4.4.4").unwrap();
        let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 1.0 };
        let canvas = PlaneCanvas::new(&Sheet, pattern, placement, pattern.usual()).unwrap();
        let settings = FormSettings {
            diameter: 0.02,
            overhang: 0.05,
            round: 0.0,
            share: crate::frame::share::Share::Off,
            layering,
            way: Way::default(),
            surface_low: -9.0,
            sizes: Default::default(),
        };
        form(&canvas, &settings).unwrap()
    }

    #[test]
    fn all_over_needs_no_tie_and_all_under_needs_all() {
        let mut formed = formed(Layering::Reciprocal);
        let units = formed.frame.units.len();
        let found = arrangement(&formed);
        assert_eq!(found, Arrangement { over: units, ..Arrangement::default() });
        formed.ending_over.iter_mut().for_each(|over| *over = false);
        let found = arrangement(&formed);
        assert_eq!((found.over, found.under, found.mixed), (0, units, 0));
        assert!(found.tied.into_iter().eq(formed.frame.contacts.ids()));
    }

    #[test]
    fn contacts_are_tied_where_the_end_of_a_rod_lies_below() {
        let formed = formed(Layering::Auto);
        let found = arrangement(&formed);
        assert_eq!(found.over + found.under + found.mixed, formed.frame.units.len());
        assert!(found.mixed > 0 && !found.tied.is_empty());
        for (id, over) in formed.ending_over.enumerate() {
            assert_eq!(found.tied.contains(&id), !over, "{id}");
        }
    }

    #[test]
    fn below_is_towards_the_ground_on_either_side_of_a_surface() {
        let mut contact = formed(Layering::Reciprocal).frame.contacts[ContactId::new(0)].clone();
        for (up, over, dropping) in
            [(1.0, true, false), (1.0, false, true), (-1.0, true, true), (-1.0, false, false)]
        {
            contact.normal = Vector3::z() * up;
            assert_eq!(drops(&contact, over), dropping, "{up} {over}");
        }
    }
}
