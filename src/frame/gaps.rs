//! The equations of the contacts: the gap of each, and its gradient.
//!
//! The gap of a contact is g = (P − Q)·n, with P and Q the nearest points of the
//! two axes and n the unit vector across both, outwards. Moving the ends of the
//! rods changes it, to first order, by n weighted with where P lies between the
//! ends of its rod: the change of n itself drops out. These gradients are the rows of
//! the Jacobian J.
//!
//! Where two ends meet, the three coordinates of their distance are such gaps.

use super::axis::Axis;
use super::{ContactKind, End};
use crate::ids::{ContactId, IdVec, RodId};
use crate::surface::Vector3;

/// A contact to be closed.
#[derive(Clone, Debug)]
pub struct Joint {
    /// The rod on the outer side.
    pub over: RodId,
    /// The rod below.
    pub under: RodId,
    /// The outer side of the surface.
    pub outward: Vector3,
    /// Where one crosses over the other the wanted distance of the axes, mm.
    pub diameter: f64,
    /// How they touch.
    pub kind: ContactKind,
}

/// Which of so many rods have contacts with which.
pub fn touching(rods: usize, joints: &IdVec<ContactId, Joint>) -> IdVec<RodId, Vec<RodId>> {
    let mut touching: IdVec<RodId, Vec<RodId>> = vec![Vec::with_capacity(4); rods].into();
    for joint in joints {
        touching[joint.over].push(joint.under);
        touching[joint.under].push(joint.over);
    }
    touching
}

/// A row as one of its rods meets it.
#[derive(Clone, Copy, Debug)]
pub struct Incidence {
    /// The row.
    pub row: usize,
    /// Whether the rod is the over rod.
    pub over: bool,
}

/// The rows that each rod takes part in.
pub fn incidence(rods: usize, rows: &[Row]) -> IdVec<RodId, Vec<Incidence>> {
    let mut around: IdVec<RodId, Vec<Incidence>> = vec![Vec::new(); rods].into();
    for (row, Row { rods: [over, under], .. }) in rows.iter().enumerate() {
        around[*over].push(Incidence { row, over: true });
        around[*under].push(Incidence { row, over: false });
    }
    around
}

/// One equation: a gap, and its gradient. A crossing has one, ends that meet have one for
/// each axis of space.
#[derive(Clone, Debug)]
pub struct Row {
    /// The contact.
    pub contact: ContactId,
    /// The over rod and the under rod.
    pub rods: [RodId; 2],
    /// The gap as it is, mm.
    pub gap: f64,
    /// The gap that is wanted, mm.
    pub wanted: f64,
    /// What errors are measured by: the rod diameter.
    pub diameter: f64,
    /// Unit vector along which the gap is measured, from the under to the over rod.
    pub across: Vector3,
    /// Where the contact lies between the ends of its two rods, 0 at A and 1 at B.
    pub at: [f64; 2],
}

/// The gradient with respect to the ends of one rod: `normal` times the weights.
pub struct RodRow {
    /// Unit normal.
    pub normal: Vector3,
    /// Weight of end A.
    pub at_a: f64,
    /// Weight of end B.
    pub at_b: f64,
}

impl Row {
    /// The gradient at the over rod or at the under rod.
    pub fn at_rod(&self, over: bool) -> RodRow {
        let (sign, t) = if over { (1.0, self.at[0]) } else { (-1.0, self.at[1]) };
        RodRow { normal: self.across * sign, at_a: 1.0 - t, at_b: t }
    }

    /// The error of the gap, as part of the diameter.
    pub fn error(&self) -> f64 {
        (self.gap - self.wanted).abs() / self.diameter
    }
}

/// What two rows share through one rod that both meet: a part of their entry in J Jᵀ.
pub fn product(rows: &[Row], first: Incidence, second: Incidence) -> f64 {
    let [p, q] = [first, second].map(|i| rows[i.row].at_rod(i.over));
    p.normal.dot(&q.normal) * (p.at_a * q.at_a + p.at_b * q.at_b)
}

/// The equations of all joints, in their order.
///
/// # Errors
/// A contact whose rods are parallel.
pub fn rows(
    axes: &IdVec<RodId, Axis>,
    joints: &IdVec<ContactId, Joint>,
) -> Result<Vec<Row>, ContactId> {
    let along: IdVec<RodId, Vector3> = axes.iter().map(Axis::direction).collect();
    let lengths: IdVec<RodId, f64> = axes.iter().map(Axis::length).collect();
    let mut rows = Vec::with_capacity(joints.len());
    for (contact, &Joint { over, under, outward, diameter, kind }) in joints.enumerate() {
        let (rods, [first, second]) = ([over, under], [&axes[over], &axes[under]]);
        match kind {
            ContactKind::Cross => {
                let ways = rods.map(|rod| &along[rod]);
                let x = first.cross_along(second, ways, &outward).ok_or(contact)?;
                let at = [x.at_first / lengths[over], x.at_second / lengths[under]];
                let (gap, across, wanted) = (x.rise, x.across, diameter);
                rows.push(Row { contact, rods, gap, wanted, diameter, across, at });
            }
            ContactKind::End(ends) => {
                let at = ends.map(|end| if end == End::A { 0.0 } else { 1.0 });
                let apart = first.end(ends[0]) - second.end(ends[1]);
                for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                    let (gap, across, wanted) = (apart.dot(&axis), axis, 0.0);
                    rows.push(Row { contact, rods, gap, wanted, diameter, across, at });
                }
            }
        }
    }
    Ok(rows)
}

/// N rods on the ground in a closed circuit, all through nearly one height.
#[cfg(test)]
pub fn circuit(n: usize, diameter: f64) -> (IdVec<RodId, Axis>, IdVec<ContactId, Joint>) {
    use crate::ids::Id;
    use std::f64::consts::TAU;
    let axes = (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
            let (out, along) = (Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0));
            let middle = out * 20.0 + Vector3::z() * (i as f64 * 0.01);
            let tilt = Vector3::z() * 0.1;
            Axis {
                a: (middle - along * 60.0 - tilt).into(),
                b: (middle + along * 60.0 + tilt).into(),
            }
        })
        .collect();
    let joints = (0..n)
        .map(|i| Joint {
            over: RodId::new(i),
            under: RodId::new((i + 1) % n),
            outward: Vector3::z(),
            diameter,
            kind: ContactKind::Cross,
        })
        .collect();
    (axes, joints)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;

    /// The gradient of a gap against central differences.
    #[test]
    fn gradients_agree_with_finite_differences() {
        let (axes, joints) = circuit(4, 3.0);
        let base = rows(&axes, &joints).unwrap();
        let h = 1e-5;
        for (id, joint) in joints.enumerate() {
            for (rod, over) in [(joint.over, true), (joint.under, false)] {
                let row = base[id.index()].at_rod(over);
                for axis in 0..3 {
                    for (end, weight) in [(0, row.at_a), (1, row.at_b)] {
                        let gaps = [h, -h].map(|h| {
                            let mut moved = axes.clone();
                            let end = if end == 0 { &mut moved[rod].a } else { &mut moved[rod].b };
                            end[axis] += h;
                            rows(&moved, &joints).unwrap()[id.index()].gap
                        });
                        let numeric = (gaps[0] - gaps[1]) / (2.0 * h);
                        assert!((numeric - row.normal[axis] * weight).abs() < 1e-7);
                    }
                }
            }
        }
    }
}
