//! The cost of a choice of who goes over, and contacts turned over while it falls.
//!
//! With h the rises, w the wanted gaps (the diameter, where all rods have one) and
//! K = J Jᵀ, the least move of rod ends that meets the linearised contacts of a choice s
//! has the squared size
//!
//! ```text
//! (s w − h)ᵀ K⁻¹ (s w − h)
//! ```
//!
//! the *cost*. With g = K⁻¹ (s w − h), turning contact i over changes it by
//! −4 sᵢ w gᵢ + 4 w² K⁻¹ᵢᵢ.

use super::factor::Factor;

/// A choice on the rows of a core, and what it costs.
pub struct Choice<'a> {
    /// +1 where the ending rod goes over, −1 where it goes under.
    signs: Vec<f64>,
    /// w of every row.
    wanted: Vec<f64>,
    /// What gains are measured by.
    diameter: f64,
    /// K⁻¹.
    factor: &'a Factor,
    /// K⁻¹ᵢᵢ of the rows that may be turned over.
    diagonal: Vec<f64>,
    /// What is wanted less what is, of all rows: s w − h; −h where ends meet.
    residual: Vec<f64>,
    /// g = K⁻¹ (s w − h).
    pull: Vec<f64>,
}

/// What a turn has to save, in squared diameters: as much as moving one rod end by a
/// diameter. A rod turned to end below another may have to be tied there; with less, some
/// contacts of vaults are turned though the rods move hardly any less. With more, flat
/// sheets rise more.
const GAIN: f64 = 1.0;

/// Changes of the cost that differ by less, in squared diameters, count as equal, so that
/// ties on regular patterns do not hang on rounding.
const TIE: f64 = 1e-6;

impl<'a> Choice<'a> {
    /// The choice `signs` on a core with this K⁻¹, whose diagonal is given where rows may be
    /// turned over, and the residuals of all rows, those of the core first.
    pub fn new(
        factor: &'a Factor,
        diagonal: Vec<f64>,
        signs: Vec<f64>,
        residual: Vec<f64>,
        wanted: Vec<f64>,
        diameter: f64,
    ) -> Self {
        let pull = factor.times(&residual);
        Self { signs, wanted, diameter, factor, diagonal, residual, pull }
    }

    /// The cost, mm², where all rows are in the core.
    #[cfg(test)]
    pub fn cost(&self) -> f64 {
        self.residual.iter().zip(&self.pull).map(|(r, g)| r * g).sum()
    }

    /// The sign of a row.
    pub fn sign(&self, i: usize) -> f64 {
        self.signs[i]
    }

    /// By how much turning a row over would change the cost, mm².
    pub fn change(&self, i: usize) -> f64 {
        let w = self.wanted[i];
        4.0 * w * (w * self.diagonal[i] - self.signs[i] * self.pull[i])
    }

    /// Turns a row over.
    pub fn flip(&mut self, i: usize) {
        let step = -2.0 * self.signs[i] * self.wanted[i];
        self.residual[i] += step;
        for (pull, part) in self.pull.iter_mut().zip(self.factor.column(i)) {
            *pull += step * part;
        }
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
    use nalgebra::DMatrix;
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

    fn factor(k: &DMatrix<f64>) -> Factor {
        let n = k.nrows();
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        Factor::new(n, n, &lower.map(|at| (at.0, at.1, k[at])).collect::<Vec<_>>()).unwrap()
    }

    fn choice<'a>(factor: &'a Factor, signs: &[f64], rises: &[f64], w: f64) -> Choice<'a> {
        let residual = signs.iter().zip(rises).map(|(s, h)| s * w - h).collect();
        let diagonal = (0..signs.len()).map(|i| factor.diagonal(i)).collect();
        Choice::new(factor, diagonal, signs.to_vec(), residual, vec![w; signs.len()], w)
    }

    proptest! {
        #[test]
        fn a_flip_changes_the_cost_by_the_formula((k, signs, rises) in system(8), i in 0..8usize) {
            let w = 1.5;
            let factor = factor(&k);
            let mut now = choice(&factor, &signs, &rises, w);
            let (cost, change) = (now.cost(), now.change(i));
            now.flip(i);
            let mut turned = signs;
            turned[i] = -turned[i];
            let anew = choice(&factor, &turned, &rises, w);
            let size = 1.0 + cost.abs() + change.abs();
            prop_assert!((anew.cost() - cost - change).abs() < 1e-9 * size);
            prop_assert!((now.cost() - anew.cost()).abs() < 1e-9 * size);
            let largest = anew.pull.iter().fold(1.0, |most, g| g.abs().max(most));
            for (now, anew) in now.pull.iter().zip(&anew.pull) {
                prop_assert!((now - anew).abs() < 1e-9 * largest);
            }
        }

        #[test]
        fn the_cost_falls_until_no_single_flip_saves_enough((k, signs, rises) in system(8)) {
            let factor = factor(&k);
            let mut now = choice(&factor, &signs, &rises, 1.0);
            let before = now.cost();
            let free = [0, 1, 2, 4, 5, 7];
            now.settle(&free);
            prop_assert!(now.cost() <= before + 1e-9);
            prop_assert!(free.iter().all(|&i| now.change(i) >= -GAIN - 1e-9));
            prop_assert_eq!([now.sign(3), now.sign(6)], [signs[3], signs[6]]);
        }
    }
}
