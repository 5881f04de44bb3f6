//! A small frame for tests: one unit that stands on its rods' ends A.

use crate::chart::{Method, PlanarChart, SurfacePoint};
use crate::frame::axis::Axis;
use crate::frame::canvas::PlaneCanvas;
use crate::frame::close::{Way, project};
use crate::frame::fit::fit;
use crate::frame::footprint::{Footprint, footprint};
use crate::frame::form::{FormSettings, form};
use crate::frame::gaps::Joint;
use crate::frame::guide::Guide;
use crate::frame::measure::{Measures, measure};
use crate::frame::{Chirality, Contact, ContactKind, End, Frame, Rod, Support, Unit};
use crate::ids::{ContactId, Id, IdVec, RodId, UnitId};
use crate::pattern::Pattern;
use crate::surface::{Vector3, samples::sample, topology::require_disk};
use crate::tiling::Placement;
use std::f64::consts::TAU;

/// Radius of the hole, mm.
const RADIUS: f64 = 40.0;
/// Rod left beyond the last contact, at least, mm.
const OVERHANG: f64 = 6.0;

/// `n` rods in a closed circuit, each with end A on the ground and end B on the next
/// rod; cut lengths are multiples of half a mm.
pub(crate) fn circuit(n: usize, diameter: f64) -> Frame {
    let mut axes: IdVec<RodId, Axis> = (0..n).map(|i| tangent(i, n, 2.0 * diameter)).collect();
    let id = |i: usize| RodId::new(i % n);
    let joints: IdVec<ContactId, Joint> = (0..n)
        .map(|i| Joint {
            over: id(i),
            under: id(i + 1),
            outward: Vector3::z(),
            diameter,
            kind: ContactKind::Cross,
        })
        .collect();
    project(&mut axes, &joints).unwrap();
    let axes: IdVec<RodId, Axis> = (0..n).map(|i| cut(&axes, &joints, i)).collect();
    let contacts: IdVec<ContactId, Contact> = joints.iter().map(|j| contact(&axes, j)).collect();
    let around = |i: usize| vec![ContactId::new((i + n - 1) % n), ContactId::new(i)];
    let rods: IdVec<RodId, Rod> = axes
        .enumerate()
        .map(|(r, &axis)| Rod {
            axis,
            diameters: [diameter; 2],
            units: vec![UnitId::new(0)],
            border: true,
            contacts: around(r.index()),
        })
        .collect();
    let supports =
        rods.enumerate().map(|(rod, r)| Support { rod, end: End::A, point: r.axis.a }).collect();
    let unit = Unit {
        center: SurfacePoint { position: [0.0, 0.0, 2.0 * diameter].into(), normal: Vector3::z() },
        chirality: Chirality::CounterClockwise,
        sides: n,
        rods: rods.ids().collect(),
        contacts: contacts.ids().collect(),
    };
    Frame {
        diameter,
        ground: 0.0,
        rods,
        contacts,
        units: vec![unit].into(),
        supports,
        dropped: Vec::new(),
    }
}

fn tangent(i: usize, n: usize, height: f64) -> Axis {
    let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
    let middle = Vector3::new(cos * RADIUS, sin * RADIUS, height);
    let along = Vector3::new(-sin, cos, 0.02) * RADIUS;
    Axis { a: (middle - along).into(), b: (middle + along).into() }
}

/// From the ground to the overhang, to a length that is a multiple of half a mm.
fn cut(axes: &IdVec<RodId, Axis>, joints: &IdVec<ContactId, Joint>, i: usize) -> Axis {
    let axis = &axes[RodId::new(i)];
    let joint = &joints[ContactId::new(i)];
    let last = axis.cross(&axes[joint.under], &Vector3::z()).unwrap().at_first;
    let foot = -axis.a.z / axis.direction().z;
    let length = ((last + OVERHANG - foot) * 2.0 - 1e-6).ceil() / 2.0;
    axis.between(foot, foot + length)
}

fn contact(axes: &IdVec<RodId, Axis>, joint: &Joint) -> Contact {
    let (over, under) = (&axes[joint.over], &axes[joint.under]);
    let x = over.cross(under, &joint.outward).unwrap();
    Contact {
        kind: joint.kind,
        over: joint.over,
        under: joint.under,
        at_over: x.at_first,
        at_under: x.at_second,
        angle: over.direction().dot(&under.direction()).abs().min(1.0).acos(),
        gap: x.rise,
        normal: joint.outward,
        unit: UnitId::new(0),
    }
}

/// A real frame: 3 mm rods on a sample surface.
pub(crate) fn on_sample(surface: &str, pattern: &str) -> Frame {
    laid_on_sample(surface, pattern, [0.0; 2], 0.0).0
}

/// The same with its pattern moved and turned, the plane on which it was laid out, and its
/// figures.
pub(crate) fn laid_on_sample(
    surface: &str,
    pattern: &str,
    origin: [f64; 2],
    rotation: f64,
) -> (Frame, Footprint, Measures) {
    let mesh = sample(surface).unwrap();
    let surface_low = mesh.bounds().unwrap()[0].z;
    let topology = require_disk(&mesh).unwrap();
    let chart = PlanarChart::new(mesh, &topology, Method::Abf).unwrap();
    let pattern = Pattern::named(pattern).unwrap();
    let (shape, diameter) = (pattern.usual(), 3.0);
    let start = Placement { origin: origin.into(), rotation, edge: 1.0 };
    let edge = fit(&chart, pattern, &start, shape, diameter).unwrap().edge;
    let settings = FormSettings {
        diameter,
        overhang: OVERHANG,
        round: 0.5,
        share: crate::frame::share::Share::Off,
        layering: Default::default(),
        way: Way::default(),
        surface_low,
        sizes: Default::default(),
    };
    let placement = Placement { edge, ..start };
    let canvas = PlaneCanvas::new(&chart, pattern, placement, shape).unwrap();
    let formed = form(&canvas, &settings).unwrap();
    let plane = footprint(&canvas, pattern, &formed.tiles);
    let guide = Guide::Chart { mesh: chart.mesh().clone(), distortion: chart.distortion().clone() };
    let measures = measure(&formed, &guide);
    (formed.frame, plane, measures)
}
