//! Sparse Cholesky factorisation that keeps its symbolic part.

use super::{LinalgError, LowerPattern};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot;
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par, Side, Spec};
use nalgebra::SMatrix;

/// Factors A = L Lᴴ with A Hermitian, positive definite and of fixed pattern; `T` is
/// `f64` or a complex number of two.
///
/// One fill-reducing order (AMD) and one symbolic factorisation serve all values.
/// It runs on one thread: faer's threads make systems of this kind slower.
pub struct Cholesky<T: ComplexField> {
    pattern: LowerPattern,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<T>,
    scratch: MemBuffer,
}

impl<T: ComplexField> Cholesky<T> {
    /// Analyses a matrix of this pattern.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new(pattern: LowerPattern) -> Result<Self, LinalgError> {
        Self::ordered(pattern, SymmetricOrdering::Amd, SupernodalThreshold::AUTO)
    }

    /// Analyses a matrix with `k` unknowns in place of each one of the pattern. The order
    /// is sought on the pattern itself: k² times less to look through.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn of_blocks(pattern: &LowerPattern, k: usize) -> Result<Self, LinalgError> {
        let order = amd_order(pattern)?;
        let within = |&i: &u32| (0..k as u32).map(move |j| k as u32 * i + j);
        let forward: Vec<u32> = order.iter().flat_map(within).collect();
        let mut inverse = vec![0; forward.len()];
        for (new, &old) in forward.iter().enumerate() {
            inverse[old as usize] = new as u32;
        }
        let order = PermRef::new_checked(&forward, &inverse, forward.len());
        // The columns of a block are alike, so that they go together even in small systems.
        let columns = SupernodalThreshold::FORCE_SUPERNODAL;
        Self::ordered(pattern.times(k)?, SymmetricOrdering::Custom(order), columns)
    }

    fn ordered(
        pattern: LowerPattern,
        order: SymmetricOrdering<'_, u32>,
        supernodal_flop_ratio_threshold: SupernodalThreshold,
    ) -> Result<Self, LinalgError> {
        let too_large = LinalgError::TooLarge { size: pattern.size() };
        let symbolic = factorize_symbolic_cholesky(
            symbolic(&pattern),
            Side::Lower,
            order,
            CholeskySymbolicParams { supernodal_flop_ratio_threshold, ..Default::default() },
        )
        .map_err(|_| too_large.clone())?;
        let numeric = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, Spec::default());
        let solve = symbolic.solve_in_place_scratch::<T>(1, Par::Seq);
        let scratch = MemBuffer::try_new(numeric.or(solve)).map_err(|_| too_large.clone())?;
        let mut factor = Vec::new();
        factor.try_reserve_exact(symbolic.len_val()).map_err(|_| too_large)?;
        factor.resize(symbolic.len_val(), T::zero_impl());
        Ok(Self { pattern, symbolic, factor, scratch })
    }

    /// Factors the matrix with these values, one for each entry of the pattern.
    ///
    /// # Panics
    /// When the number of values differs from the number of entries.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row at which the factorisation stopped.
    pub fn factor(&mut self, values: &[T]) -> Result<(), LinalgError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value an entry");
        let size = self.pattern.size();
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(symbolic(&self.pattern), values),
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
    pub fn solve(&mut self, rhs: &mut [T]) {
        let x = MatMut::from_column_major_slice_mut(rhs, self.pattern.size(), 1);
        let stack = MemStack::new(&mut self.scratch);
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            x,
            Par::Seq,
            stack,
        );
    }
}

fn symbolic(pattern: &LowerPattern) -> SymbolicSparseColMatRef<'_, u32> {
    let size = pattern.size();
    SymbolicSparseColMatRef::new_checked(size, size, &pattern.starts, None, &pattern.rows)
}

/// The unknowns in an order of little fill.
fn amd_order(pattern: &LowerPattern) -> Result<Vec<u32>, LinalgError> {
    let size = pattern.size();
    let too_large = || LinalgError::TooLarge { size };
    let (mut forward, mut inverse) = (vec![0; size], vec![0; size]);
    let need = amd::order_maybe_unsorted_scratch::<u32>(size, pattern.entries());
    let mut memory = MemBuffer::try_new(need).map_err(|_| too_large())?;
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        symbolic(pattern),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| too_large())?;
    Ok(forward)
}

/// Solver for A x = b with A real, given as a list of entries.
pub struct SpdSolver {
    cholesky: Cholesky<f64>,
    /// Where the value of each entry goes.
    positions: Vec<u32>,
    values: Vec<f64>,
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
        let pattern = LowerPattern::new(size, entries.iter().copied())?;
        let position = |&(i, j): &(usize, usize)| pattern.position(i.max(j), i.min(j)) as u32;
        let positions = entries.iter().map(position).collect();
        let values = vec![0.0; pattern.entries()];
        Ok(Self { cholesky: Cholesky::new(pattern)?, positions, values })
    }

    /// Factors the matrix with these values, in the order of the entries of [`SpdSolver::new`].
    ///
    /// # Panics
    /// When the number of values differs from the number of entries.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row at which the factorisation stopped.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        assert_eq!(values.len(), self.positions.len(), "one value an entry");
        self.values.fill(0.0);
        for (&at, value) in self.positions.iter().zip(values) {
            self.values[at as usize] += value;
        }
        self.cholesky.factor(&self.values)
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    ///
    /// # Panics
    /// When the length differs from the number of unknowns.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.cholesky.solve(rhs);
    }
}

/// Solver for A x = b with A real and made of K × K blocks: K unknowns a node, side by
/// side. Blocks are added where they belong, without a list.
pub struct BlockSolver<const K: usize> {
    nodes: LowerPattern,
    cholesky: Cholesky<f64>,
    values: Vec<f64>,
}

impl<const K: usize> BlockSolver<K> {
    /// Analyses the matrix with a block for each entry of the pattern.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new(nodes: LowerPattern) -> Result<Self, LinalgError> {
        let cholesky = Cholesky::of_blocks(&nodes, K)?;
        let values = vec![0.0; cholesky.pattern.entries()];
        Ok(Self { nodes, cholesky, values })
    }

    /// Where blocks can be added.
    pub fn nodes(&self) -> &LowerPattern {
        &self.nodes
    }

    /// Sets all blocks to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds a block between two nodes, which stands for its mirror image too.
    ///
    /// # Panics
    /// When the pair of nodes is not in the pattern.
    pub fn add(&mut self, row: usize, column: usize, block: &SMatrix<f64, K, K>) {
        let (lower, left) = (row.max(column), row.min(column));
        let starts = self.nodes.block_starts::<K>(lower, left);
        for (within, start) in starts.into_iter().enumerate() {
            for i in if row == column { within } else { 0 }..K {
                let entry = if row < column { block[(within, i)] } else { block[(i, within)] };
                self.values[start + i] += entry;
            }
        }
    }

    /// Factors the sum of the blocks.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row at which the factorisation stopped.
    pub fn factor(&mut self) -> Result<(), LinalgError> {
        self.cholesky.factor(&self.values)
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    ///
    /// # Panics
    /// When the length is not K times the number of nodes.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.cholesky.solve(rhs);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix2;

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

    /// Blocks given either way round make the same system as their entries.
    #[test]
    fn blocks_of_two_agree_with_single_entries() {
        let own = Matrix2::new(4.0, 1.0, 1.0, 5.0);
        let between = Matrix2::new(-1.0, 0.5, 0.25, -1.5);
        let blocks = [
            (0, 0, own),
            (1, 1, own * 2.0),
            (2, 2, own),
            (2, 0, between),
            (0, 1, between),
            (1, 0, between),
        ];
        let nodes = LowerPattern::new(3, blocks.iter().map(|b| (b.0, b.1))).unwrap();
        let mut pairs = BlockSolver::<2>::new(nodes).unwrap();
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        for (row, column, block) in blocks {
            pairs.add(row, column, &block);
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                // Of a block on the diagonal, the lower half.
                if row != column || i >= j {
                    entries.push((2 * row + i, 2 * column + j));
                    values.push(block[(i, j)]);
                }
            }
        }
        let mut single = SpdSolver::new(6, &entries).unwrap();
        pairs.factor().unwrap();
        single.factor(&values).unwrap();
        let mut found = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
        let mut wanted = found;
        pairs.solve(&mut found);
        single.solve(&mut wanted);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-13, "{found} {wanted}");
        }
    }
}
