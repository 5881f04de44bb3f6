//! What the inner polygons of a weave are to look like once they are closed: as their
//! tiles' flat pictures have them.

use super::close::shape::Circuit;
use super::weave::{Weave, WovenUnit};

/// The circuits of all units that have one.
pub fn circuits(weave: &Weave) -> Vec<Circuit> {
    weave.units.iter().filter(|unit| unit.corners.len() >= 3).map(circuit).collect()
}

fn circuit(unit: &WovenUnit) -> Circuit {
    let flat = &unit.corners;
    let n = flat.len();
    let next = |i: usize| (i + 1) % n;
    let sides: Vec<f64> = (0..n).map(|i| (flat[next(i)] - flat[i]).norm()).collect();
    let mean = sides.iter().sum::<f64>() / n as f64;
    let cosine = |i: usize| {
        let (back, ahead) = (flat[(i + n - 1) % n] - flat[i], flat[next(i)] - flat[i]);
        back.angle(&ahead).cos()
    };
    Circuit {
        contacts: unit.contacts[..n].to_vec(),
        place: unit.center,
        cosines: (0..n).map(cosine).collect(),
        sides: sides.iter().map(|side| side / mean).collect(),
    }
}
