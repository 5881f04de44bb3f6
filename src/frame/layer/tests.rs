use super::*;
use crate::chart::{Chart, Method, PlanarChart};
use crate::frame::canvas::PlaneCanvas;
use crate::frame::canvas::fixture::Sheet;
use crate::frame::close::Way;
use crate::frame::crop::{crop, held};
use crate::frame::form::{FormSettings, form};
use crate::frame::lift::lift;
use crate::frame::weave::weave;
use crate::pattern::Pattern;
use crate::surface::samples::sample;
use crate::surface::topology::require_disk;
use crate::tiling::Placement;

/// Axes, joints with every ending rod over, and rises.
struct Laid {
    axes: IdVec<RodId, Axis>,
    joints: IdVec<ContactId, Joint>,
    rises: IdVec<ContactId, Option<f64>>,
}

fn canvas<'a, C: Chart>(chart: &'a C, pattern: &str, edge: f64) -> PlaneCanvas<'a, C> {
    let pattern = Pattern::named(pattern).unwrap();
    let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge };
    PlaneCanvas::new(chart, pattern, placement, pattern.usual()).unwrap()
}

/// The diameter is the median rise where none is given.
fn laid<C: Chart>(chart: &C, pattern: &str, edge: f64, diameter: Option<f64>) -> Laid {
    let canvas = canvas(chart, pattern, edge);
    let weave = weave(&canvas, &crop(&canvas, &held(&canvas))).unwrap();
    let lifted = lift(&weave).unwrap();
    let rises = lifted.rises(&weave);
    let mut sizes: Vec<f64> = rises.iter().flatten().map(|rise| rise.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let diameter = diameter.unwrap_or(sizes[sizes.len() / 2]);
    let joints = weave.contacts.iter().map(|c| Joint {
        over: c.ending,
        under: c.passing,
        outward: c.on.normal,
        diameter,
        kind: c.kind,
    });
    Laid { joints: joints.collect(), axes: lifted.axes, rises }
}

impl Laid {
    /// The cost of a choice on all contacts at once, in squared diameters a contact.
    fn cost(&self, over: &IdVec<ContactId, bool>) -> f64 {
        let mut system = System::new(&self.axes, &self.joints).unwrap();
        for (sign, row) in system.signs.iter_mut().zip(&system.rows) {
            *sign = if over[row.contact] { 1.0 } else { -1.0 };
        }
        let all = Patch { core: self.joints.ids().collect(), rim: Vec::new() };
        let w = self.joints[all.core[0]].diameter;
        let places = system.rows_of(&all.core);
        let factor = system.factor(&places, places.len()).unwrap();
        let choice = system.choice(&places, &factor, vec![0.0; places.len()]);
        choice.cost() / (w * w * self.joints.len() as f64)
    }
}

#[test]
fn on_a_flat_sheet_the_cost_falls_from_hundreds_to_below_one() {
    let sheet = laid(&Sheet, "4.4.4.4", 1.0, Some(0.05));
    let follow = layer(&sheet.axes, &sheet.joints, &sheet.rises, Layering::Follow).unwrap();
    let chosen = layer(&sheet.axes, &sheet.joints, &sheet.rises, Layering::Auto).unwrap();
    let (before, after) = (sheet.cost(&follow), sheet.cost(&chosen));
    assert!(before > 50.0 && after < 1.0, "{before} {after}");
}

#[test]
fn patches_choose_as_well_as_the_whole() {
    for pattern in ["4.4.4.4", "3.3.3.3.3.3", "3.6.3.6"] {
        let sheet = laid(&Sheet, pattern, 1.0, Some(0.05));
        let whole = auto(&sheet.axes, &sheet.joints, [sheet.joints.len(), 0]).unwrap();
        let parts = auto(&sheet.axes, &sheet.joints, [40, RINGS]).unwrap();
        let [whole, parts] = [whole, parts].map(|over| sheet.cost(&over));
        assert!(parts < 1.25 * whole, "{pattern}: {parts} in patches, {whole} at once");
    }
}

#[test]
fn a_dome_is_layered_as_by_follow() {
    let dome = sample("igloo").unwrap();
    let chart = PlanarChart::new(dome.clone(), &require_disk(&dome).unwrap(), Method::Abf).unwrap();
    let Laid { axes, joints, rises } = laid(&chart, "4.4.4.4", 60.0, None);
    let follow = layer(&axes, &joints, &rises, Layering::Follow).unwrap();
    assert_eq!(layer(&axes, &joints, &rises, Layering::Auto).unwrap(), follow);
    assert!(follow.iter().all(|&over| over));
}

#[test]
fn clear_rises_keep_their_sign() {
    // Thin rods, for which all rises of a saddle but a few are clear.
    let saddle = sample("saddle").unwrap();
    let topology = require_disk(&saddle).unwrap();
    let chart = PlanarChart::new(saddle, &topology, Method::Abf).unwrap();
    let Laid { axes, joints, rises } = laid(&chart, "3.3.3.3.3.3", 60.0, None);
    let chosen = layer(&axes, &joints, &rises, Layering::Auto).unwrap();
    let mut clear = 0;
    for (id, rise) in rises.enumerate() {
        let rise = rise.unwrap();
        if rise.abs() > CLEAR * joints[id].diameter {
            assert_eq!(chosen[id], rise > 0.0, "{id}");
            clear += 1;
        }
    }
    assert!(clear > joints.len() / 2);
}

#[test]
fn a_flat_sheet_closes_with_little_move_and_nothing_left_out() {
    let canvas = canvas(&Sheet, "4.4.4.4", 1.0);
    let settings = FormSettings {
        diameter: 0.05,
        overhang: 0.1,
        round: 0.0,
        share: crate::frame::share::Share::Off,
        layering: Layering::Auto,
        way: Way::Least,
        surface_low: -9.0,
        sizes: Default::default(),
    };
    let formed = form(&canvas, &settings).unwrap();
    let mean = formed.moves.iter().sum::<f64>() / formed.moves.len() as f64;
    assert!(formed.frame.dropped.is_empty() && mean < settings.diameter, "{mean}");
}
