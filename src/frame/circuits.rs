//! What the inner polygons of a weave are to look like once they are closed: as their
//! tiles' flat pictures have them.

use super::close::shape::Circuit;
use super::weave::{Weave, WovenUnit};
use crate::chart::SurfacePoint;
use crate::ids::{ContactId, IdVec};
use crate::surface::{Point3, Vector3};

/// The circuits of all units that have one; `middles` are the contacts as lifted, mm.
///
/// Which way is up at a unit is that of its lifted polygon. The smooth normal of the surface
/// there would hang on how the surface is cut into triangles.
pub fn circuits(weave: &Weave, middles: &IdVec<ContactId, Point3>) -> Vec<Circuit> {
    let has_hole = |unit: &&WovenUnit| unit.corners.len() >= 3;
    weave.units.iter().filter(has_hole).map(|unit| circuit(unit, middles)).collect()
}

fn circuit(unit: &WovenUnit, middles: &IdVec<ContactId, Point3>) -> Circuit {
    let flat = &unit.corners;
    let n = flat.len();
    let next = |i: usize| (i + 1) % n;
    let sides: Vec<f64> = (0..n).map(|i| (flat[next(i)] - flat[i]).norm()).collect();
    let mean = sides.iter().sum::<f64>() / n as f64;
    let cosine = |i: usize| {
        let (back, ahead) = (flat[(i + n - 1) % n] - flat[i], flat[next(i)] - flat[i]);
        back.angle(&ahead).cos()
    };
    let contacts = unit.contacts[..n].to_vec();
    let arm = |i: usize| middles[contacts[i]] - middles[contacts[0]];
    let area: Vector3 = (1..n - 1).map(|i| arm(i).cross(&arm(i + 1))).sum();
    let SurfacePoint { position, normal: outward } = unit.center;
    let normal = area * area.dot(&outward).signum();
    let normal = normal.try_normalize(0.0).unwrap_or(outward);
    Circuit {
        contacts,
        place: SurfacePoint { position, normal },
        cosines: (0..n).map(cosine).collect(),
        sides: sides.iter().map(|side| side / mean).collect(),
    }
}
