//! Sparse Cholesky factorisation that keeps its symbolic part.

use super::LinalgError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot;
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side, Spec};

/// Solver for A x = b with A symmetric positive definite and of fixed pattern.
///
/// One fill-reducing order (AMD) and one symbolic factorisation serve all values.
/// It runs on one thread: faer's threads make systems of this kind slower.
pub struct SpdSolver {
    size: usize,
    pattern: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    entries: usize,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    scratch: MemBuffer,
}

/// The pairs of positions in a block of `k` unknowns that its lower triangle
/// holds, in the order in which [`SpdSolver`] takes their values.
pub fn block_entries(k: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..k).flat_map(move |i| (0..=i).map(move |j| (i, j)))
}

impl SpdSolver {
    /// Analyses the matrix of `size` unknowns with these `(row, column)` entries.
    ///
    /// Each pair of unknowns stands for both halves and is given once a block,
    /// either way round; entries given several times are added up.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new(size: usize, entries: &[(usize, usize)]) -> Result<Self, LinalgError> {
        let too_large = LinalgError::TooLarge { size };
        let lower: Vec<Pair<usize, usize>> =
            entries.iter().map(|&(i, j)| Pair { row: i.max(j), col: i.min(j) }).collect();
        let (pattern, order) = SymbolicSparseColMat::try_new_from_indices(size, size, &lower)
            .map_err(|_| too_large.clone())?;
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| too_large.clone())?;
        let numeric = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let solve = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let scratch = MemBuffer::try_new(numeric.or(solve)).map_err(|_| too_large)?;
        let factor = vec![0.0; symbolic.len_val()];
        Ok(Self { size, pattern, order, entries: entries.len(), symbolic, factor, scratch })
    }

    /// Factors the matrix with these values, in the order of the entries of [`SpdSolver::new`].
    ///
    /// # Panics
    /// When the number of values differs from the number of entries.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row at which the factorisation stopped.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        assert_eq!(values.len(), self.entries, "one value an entry");
        let size = self.size;
        let matrix = SparseColMat::new_from_argsort(self.pattern.clone(), &self.order, values)
            .map_err(|_| LinalgError::TooLarge { size })?;
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix.as_ref(),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.scratch),
                Spec::default(),
            )
            .map(drop)
            .map_err(|NonPositivePivot { index }| LinalgError::NotPositiveDefinite {
                size,
                row: index,
            })
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    ///
    /// # Panics
    /// When the length differs from the number of unknowns.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let x = MatMut::from_column_major_slice_mut(rhs, self.size, 1);
        let stack = MemStack::new(&mut self.scratch);
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            x,
            Par::Seq,
            stack,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of springs held at both ends: the displacement under unit loads
    /// is the parabola i (n + 1 − i) / 2.
    #[test]
    fn a_chain_of_springs_bends_to_a_parabola() {
        for n in [1usize, 2, 10, 500] {
            let mut entries = Vec::new();
            let mut values = Vec::new();
            for i in 0..n {
                entries.push((i, i));
                values.push(2.0);
                if i > 0 {
                    entries.push((i - 1, i));
                    values.push(-1.0);
                }
            }
            let mut solver = SpdSolver::new(n, &entries).unwrap();
            for scale in [1.0, 4.0] {
                let scaled: Vec<f64> = values.iter().map(|v| v * scale).collect();
                solver.factor(&scaled).unwrap();
                let mut x = vec![scale; n];
                solver.solve(&mut x);
                for (i, x) in x.iter().enumerate() {
                    let exact = (i + 1) as f64 * (n - i) as f64 / 2.0;
                    assert!((x - exact).abs() < 1e-10 * exact, "{n} {i}: {x} {exact}");
                }
            }
        }
    }

    #[test]
    fn repeated_entries_add_up() {
        let mut solver = SpdSolver::new(1, &[(0, 0), (0, 0)]).unwrap();
        solver.factor(&[1.0, 3.0]).unwrap();
        let mut x = [8.0];
        solver.solve(&mut x);
        assert_eq!(x, [2.0]);
    }

    #[test]
    fn a_loose_chain_is_named_singular() {
        let mut solver = SpdSolver::new(2, &[(0, 0), (1, 0), (1, 1)]).unwrap();
        let loose = solver.factor(&[1.0, -1.0, 0.5]).unwrap_err();
        assert!(matches!(loose, LinalgError::NotPositiveDefinite { size: 2, .. }), "{loose}");
    }
}
