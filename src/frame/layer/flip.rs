//! The cost of a choice of who goes over, and contacts turned over while it falls.
//!
//! With h the rises, w the wanted gaps (the diameter, where all rods have one) and K = J Jᵀ, the least move of rod ends that
//! meets the linearised contacts of a choice s has the squared size
//!
//! ```text
//! (s w − h)ᵀ K⁻¹ (s w − h)
//! ```
//!
//! the *cost*. With g = K⁻¹ (s w − h), turning contact i over changes it by
//! −4 sᵢ w gᵢ + 4 w² K⁻¹ᵢᵢ.

use nalgebra::{Cholesky, DMatrix, DVector};

/// A choice on some rows, and what it costs.
#[derive(Clone, Debug)]
pub struct Choice {
    /// +1 where the ending rod goes over, −1 where it goes under.
    signs: Vec<f64>,
    /// w of every row.
    wanted: Vec<f64>,
    /// What gains are measured by.
    diameter: f64,
    /// K⁻¹.
    inverse: DMatrix<f64>,
    /// What is wanted less what is: s w − h; −h where ends meet.
    residual: DVector<f64>,
    /// g = K⁻¹ (s w − h).
    pull: DVector<f64>,
}

/// Added to the diagonal of K, as part of its largest entry: rounding cannot make the
/// sum indefinite then, and no move that matters is as weak as this.
const DIAGONAL: f64 = 1e-9;

/// What a turn has to save, in squared diameters: as much as moving one rod end by a
/// diameter. A rod turned to end below another may have to be tied there; with less, some
/// contacts of vaults are turned though the rods move hardly any less. With more, flat
/// sheets rise more.
const GAIN: f64 = 1.0;

/// Changes of the cost that differ by less, in squared diameters, count as equal, so that
/// ties on regular patterns do not hang on rounding.
const TIE: f64 = 1e-6;

impl Choice {
    /// The choice `signs` on rows with this K, and residuals from it; none where K cannot
    /// be inverted.
    pub fn new(
        mut k: DMatrix<f64>,
        signs: Vec<f64>,
        residual: Vec<f64>,
        wanted: Vec<f64>,
        diameter: f64,
    ) -> Option<Self> {
        let small = DIAGONAL * k.diagonal().amax();
        (0..k.nrows()).for_each(|i| k[(i, i)] += small);
        let inverse = Cholesky::new(k)?.inverse();
        let residual = DVector::from(residual);
        let pull = &inverse * &residual;
        Some(Self { signs, wanted, diameter, inverse, residual, pull })
    }

    /// The cost, mm².
    #[cfg(test)]
    pub fn cost(&self) -> f64 {
        self.residual.dot(&self.pull)
    }

    /// The sign of a row.
    pub fn sign(&self, i: usize) -> f64 {
        self.signs[i]
    }

    /// By how much turning a row over would change the cost, mm².
    pub fn change(&self, i: usize) -> f64 {
        let w = self.wanted[i];
        4.0 * w * (w * self.inverse[(i, i)] - self.signs[i] * self.pull[i])
    }

    /// Turns a row over.
    pub fn flip(&mut self, i: usize) {
        let step = -2.0 * self.signs[i] * self.wanted[i];
        self.residual[i] += step;
        self.pull.axpy(step, &self.inverse.column(i), 1.0);
        self.signs[i] = -self.signs[i];
    }

    /// Turns over the row among `free` that lowers the cost most, until none lowers it by
    /// [`GAIN`]; so this ends.
    pub fn settle(&mut self, free: &[usize]) {
        let [gain, tie] = [GAIN, TIE].map(|part| part * self.diameter * self.diameter);
        loop {
            let mut best = (-gain, None);
            for &i in free {
                let change = self.change(i);
                if change < best.0 - if best.1.is_some() { tie } else { 0.0 } {
                    best = (change, Some(i));
                }
            }
            match best.1 {
                Some(i) => self.flip(i),
                None => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A positive definite K = J Jᵀ of `n` rows, with signs and rises.
    fn system(n: usize) -> impl Strategy<Value = (DMatrix<f64>, Vec<f64>, Vec<f64>)> {
        let entries = proptest::collection::vec(-1.0..1.0f64, n * 2 * n);
        let signs = proptest::collection::vec(any::<bool>(), n);
        let rises = proptest::collection::vec(-2.0..2.0f64, n);
        (entries, signs, rises).prop_map(move |(j, signs, rises)| {
            let j = DMatrix::from_vec(n, 2 * n, j);
            let k = &j * j.transpose() + DMatrix::identity(n, n) * 0.1;
            let signs: Vec<f64> = signs.iter().map(|&s| if s { 1.0 } else { -1.0 }).collect();
            (k, signs, rises)
        })
    }

    fn choice(k: &DMatrix<f64>, signs: &[f64], rises: &[f64], w: f64) -> Choice {
        let residual = signs.iter().zip(rises).map(|(s, h)| s * w - h).collect();
        Choice::new(k.clone(), signs.to_vec(), residual, vec![w; signs.len()], w).unwrap()
    }

    proptest! {
        #[test]
        fn a_flip_changes_the_cost_by_the_formula((k, signs, rises) in system(8), i in 0..8usize) {
            let w = 1.5;
            let mut now = choice(&k, &signs, &rises, w);
            let (cost, change) = (now.cost(), now.change(i));
            now.flip(i);
            let mut turned = signs;
            turned[i] = -turned[i];
            let anew = choice(&k, &turned, &rises, w);
            let size = 1.0 + cost.abs() + change.abs();
            prop_assert!((anew.cost() - cost - change).abs() < 1e-9 * size);
            prop_assert!((now.cost() - anew.cost()).abs() < 1e-9 * size);
            prop_assert!((&now.pull - &anew.pull).amax() < 1e-9 * (1.0 + anew.pull.amax()));
        }

        #[test]
        fn the_cost_falls_until_no_single_flip_saves_enough((k, signs, rises) in system(8)) {
            let mut now = choice(&k, &signs, &rises, 1.0);
            let before = now.cost();
            let free = [0, 1, 2, 4, 5, 7];
            now.settle(&free);
            prop_assert!(now.cost() <= before + 1e-9);
            prop_assert!(free.iter().all(|&i| now.change(i) >= -GAIN - 1e-9));
            prop_assert_eq!([now.sign(3), now.sign(6)], [signs[3], signs[6]]);
        }
    }
}
