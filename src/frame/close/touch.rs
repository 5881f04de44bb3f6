//! Where a contact lies along its two rods, and how that place moves with them.
//!
//! The nearest points P = A₁ + τ₁ d₁ and Q = A₂ + τ₂ d₂ of two axes, with d = B − A, are
//! those with (P − Q)·d₁ = (P − Q)·d₂ = 0. Differentiating both gives the gradients of τ₁
//! and τ₂, and with them those of P and Q.

use super::equations::{Move, pair};
use crate::frame::ContactKind;
use crate::frame::axis::Axis;
use crate::frame::gaps::Joint;
use crate::ids::{IdVec, RodId};
use crate::surface::{Point3, Vector3};
use nalgebra::SMatrix;

/// How a point moves with the ends of a rod.
pub type PointMove = SMatrix<f64, 3, 6>;

/// A contact along its rods.
#[derive(Clone, Debug)]
pub struct Touch {
    /// The over rod and the under rod.
    pub rods: [RodId; 2],
    /// τ: where it lies between the ends of either, 0 at A and 1 at B.
    pub at: [f64; 2],
    /// The gradient of τ of the first index with respect to the rod of the second.
    pub slide: [[Move; 2]; 2],
}

/// A place on a rod, as part of its axis, and how it slides when rods move.
#[derive(Clone, Debug)]
pub struct Place {
    /// 0 at A and 1 at B.
    pub at: f64,
    /// Gradients of `at`; a rod may come twice.
    pub slide: Vec<(RodId, Move)>,
}

impl Touch {
    /// The contact of a joint; `None` where its rods are parallel.
    pub fn new(axes: &IdVec<RodId, Axis>, joint: &Joint) -> Option<Self> {
        let rods = [joint.over, joint.under];
        let [p, q] = rods.map(|rod| &axes[rod]);
        if let ContactKind::End(ends) = joint.kind {
            let at = ends.map(|end| f64::from(end == crate::frame::End::B));
            return Some(Self { rods, at, slide: [[Move::zeros(); 2]; 2] });
        }
        let x = p.cross(q, &joint.outward)?;
        let at = [x.at_first / p.length(), x.at_second / q.length()];
        let apart = x.across * x.rise;
        let (d, e) = (p.b - p.a, q.b - q.a);
        let (a, b, c) = (d.norm_squared(), d.dot(&e), e.norm_squared());
        // α and β: what the two conditions lose when the ends move and τ does not.
        let weigh = |v: &Vector3, t: f64| pair(v * (1.0 - t), v * t);
        let turned = pair(-apart, apart);
        let alpha = [-weigh(&d, at[0]) - turned, weigh(&d, at[1])];
        let beta = [-weigh(&e, at[0]), weigh(&e, at[1]) - turned];
        let det = a * c - b * b;
        let slide = |m: [f64; 2]| [0, 1].map(|r| (alpha[r] * m[0] + beta[r] * m[1]) / det);
        Some(Self { rods, at, slide: [slide([c, -b]), slide([b, -a])] })
    }

    /// How the middle between the two nearest points moves with either rod.
    pub fn middle_moves(&self, axes: &IdVec<RodId, Axis>) -> [PointMove; 2] {
        let along = self.rods.map(|rod| axes[rod].b - axes[rod].a);
        [0, 1].map(|r| {
            let mut m =
                along[0] * self.slide[0][r].transpose() + along[1] * self.slide[1][r].transpose();
            for k in 0..3 {
                m[(k, k)] += 1.0 - self.at[r];
                m[(k, k + 3)] += self.at[r];
            }
            m * 0.5
        })
    }

    /// The contact as a place on one of its two rods.
    pub fn place(&self, rod: RodId) -> Place {
        let side = self.side(rod);
        Place { at: self.at[side], slide: self.rods.into_iter().zip(self.slide[side]).collect() }
    }

    /// Which of its two rods a rod is.
    pub fn side(&self, rod: RodId) -> usize {
        usize::from(self.rods[0] != rod)
    }
}

/// The middle between the nearest points of the rods of a joint.
pub fn middle(axes: &IdVec<RodId, Axis>, joint: &Joint) -> Option<Point3> {
    let (p, q) = (&axes[joint.over], &axes[joint.under]);
    match joint.kind {
        ContactKind::End([first, second]) => Some(nalgebra::center(&p.end(first), &q.end(second))),
        ContactKind::Cross => p.middle(q, &joint.outward),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::close::equations::{Moves, moved};
    use crate::frame::gaps::circuit;

    /// Places along rods and middles against central differences.
    #[test]
    fn gradients_agree_with_finite_differences() {
        let (axes, joints) = circuit(5, 3.0);
        let h = 1e-5;
        for joint in &joints {
            let touch = Touch::new(&axes, joint).unwrap();
            let middles = touch.middle_moves(&axes);
            for side in 0..2 {
                for k in 0..6 {
                    let mut moves: Moves = vec![Move::zeros(); axes.len()].into();
                    moves[touch.rods[side]][k] = 1.0;
                    let [more, less] = [h, -h].map(|h| moved(&axes, &moves, h));
                    let [plus, minus] = [&more, &less].map(|a| Touch::new(a, joint).unwrap());
                    for of in 0..2 {
                        let numeric = (plus.at[of] - minus.at[of]) / (2.0 * h);
                        assert!((numeric - touch.slide[of][side][k]).abs() < 1e-8);
                    }
                    let [plus, minus] = [&more, &less].map(|a| middle(a, joint).unwrap());
                    let numeric = (plus - minus) / (2.0 * h);
                    assert!((numeric - middles[side].column(k)).norm() < 1e-7);
                }
            }
        }
    }
}
