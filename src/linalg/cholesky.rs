//! Sparse Cholesky factorisation that keeps its symbolic part.

use super::{LinalgError, LowerPattern};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot;
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par, Side, Spec};

/// From so many operations an entry of the factor, as part of what faer takes, columns go
/// together. With what faer takes, systems of some ten thousand unknowns take twice as long.
const TOGETHER: SupernodalThreshold = SupernodalThreshold(0.5);

/// Factors A = L Lᴴ with A Hermitian, positive definite and of fixed pattern; `T` is
/// `f64` or a complex number of two.
///
/// One fill-reducing order (minimum degree, AMD) and one symbolic factorisation serve all values.
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
        let columns = if k > 1 { SupernodalThreshold::FORCE_SUPERNODAL } else { TOGETHER };
        Self::ordered(pattern.times(k)?, SymmetricOrdering::Custom(order), columns)
    }

    fn ordered(
        pattern: LowerPattern,
        order: SymmetricOrdering<'_, u32>,
        columns: SupernodalThreshold,
    ) -> Result<Self, LinalgError> {
        let too_large = LinalgError::TooLarge { size: pattern.size() };
        let symbolic = analysed(&pattern, order, columns)?;
        let numeric = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, Spec::default());
        let solve = symbolic.solve_in_place_scratch::<T>(1, Par::Seq);
        let scratch = MemBuffer::try_new(numeric.or(solve)).map_err(|_| too_large.clone())?;
        let factor = zeros(symbolic.len_val()).ok_or(too_large)?;
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
        let unknown = |index: usize| {
            // Where there are no supernodes, faer counts from one.
            let simplicial = matches!(self.symbolic.raw(), SymbolicCholeskyRaw::Simplicial(_));
            let index = index - usize::from(simplicial);
            self.symbolic.perm().map_or(index, |perm| perm.arrays().0[index] as usize)
        };
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
                row: unknown(index),
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

/// So many zeros, if memory suffices.
pub(super) fn zeros<T: ComplexField>(count: usize) -> Option<Vec<T>> {
    let mut zeros = Vec::new();
    zeros.try_reserve_exact(count).ok()?;
    zeros.resize(count, T::zero_impl());
    Some(zeros)
}

fn analysed(
    pattern: &LowerPattern,
    order: SymmetricOrdering<'_, u32>,
    supernodal_flop_ratio_threshold: SupernodalThreshold,
) -> Result<SymbolicCholesky<u32>, LinalgError> {
    factorize_symbolic_cholesky(
        symbolic(pattern),
        Side::Lower,
        order,
        CholeskySymbolicParams { supernodal_flop_ratio_threshold, ..Default::default() },
    )
    .map_err(|_| LinalgError::TooLarge { size: pattern.size() })
}

/// The factor of a matrix in the order in which its unknowns stand, but for what no fill
/// depends on; in supernodes.
pub(super) fn as_it_stands(pattern: &LowerPattern) -> Result<SymbolicCholesky<u32>, LinalgError> {
    let order: Vec<u32> = (0..pattern.size() as u32).collect();
    let order = PermRef::new_checked(&order, &order, order.len());
    analysed(pattern, SymmetricOrdering::Custom(order), SupernodalThreshold::FORCE_SUPERNODAL)
}

/// The supernodes of a factor that has them.
pub(super) fn supernodes(symbolic: &SymbolicCholesky<u32>) -> &SymbolicSupernodalCholesky<u32> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(supernodes) => supernodes,
        SymbolicCholeskyRaw::Simplicial(_) => unreachable!("supernodes were asked for"),
    }
}

/// The unknowns in an order of little fill.
pub(super) fn amd_order(pattern: &LowerPattern) -> Result<Vec<u32>, LinalgError> {
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
