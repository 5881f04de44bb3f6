//! Solvers for real systems made of blocks, which keep where each of them goes.

use super::dissection::dissect;
use super::halves::Halves;
use super::{Cholesky, LinalgError, LowerPattern};
use nalgebra::{Point3, SMatrix};

/// Systems of fewer unknowns are not worth two threads.
const WORTH_HALVES: usize = 5000;

/// A matrix, factored whole or in halves.
enum Factor {
    Whole(Box<Cholesky<f64>>),
    Halves(Box<Halves>),
}

impl Factor {
    /// Of a matrix with a block of `K` × `K` for each entry of the pattern: in halves where
    /// nodes have places and it is worth it.
    fn new<const K: usize>(
        nodes: &LowerPattern,
        places: Option<&[Point3<f64>]>,
    ) -> Result<Self, LinalgError> {
        if let Some(places) = places.filter(|places| K * places.len() >= WORTH_HALVES)
            && let Some(dissection) = dissect(nodes, places)?
            && let Some(halves) = Halves::new::<K>(nodes, &dissection)?
        {
            return Ok(Self::Halves(Box::new(halves)));
        }
        Ok(Self::Whole(Box::new(Cholesky::of_blocks(nodes, K)?)))
    }

    fn make(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        match self {
            Self::Whole(whole) => whole.factor(values),
            Self::Halves(halves) => halves.factor(values),
        }
    }

    fn solve(&mut self, rhs: &mut [f64]) {
        match self {
            Self::Whole(whole) => whole.solve(rhs),
            Self::Halves(halves) => halves.solve(rhs),
        }
    }
}

/// Solver for A x = b with A real, given as a list of entries.
pub struct SpdSolver {
    factor: Factor,
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
        Self::with(size, entries, None)
    }

    /// The same for unknowns that lie at these places: large systems are factored faster.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    ///
    /// # Panics
    /// When there are not as many places as unknowns.
    pub fn placed(entries: &[(usize, usize)], places: &[Point3<f64>]) -> Result<Self, LinalgError> {
        Self::with(places.len(), entries, Some(places))
    }

    fn with(
        size: usize,
        entries: &[(usize, usize)],
        places: Option<&[Point3<f64>]>,
    ) -> Result<Self, LinalgError> {
        let pattern = LowerPattern::new(size, entries.iter().copied())?;
        let position = |&(i, j): &(usize, usize)| pattern.position(i.max(j), i.min(j)) as u32;
        let positions = entries.iter().map(position).collect();
        let values = vec![0.0; pattern.entries()];
        Ok(Self { factor: Factor::new::<1>(&pattern, places)?, positions, values })
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
        self.factor.make(&self.values)
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    ///
    /// # Panics
    /// When the length differs from the number of unknowns.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.factor.solve(rhs);
    }
}

/// Solver for A x = b with A real and made of K × K blocks: K unknowns a node, side by
/// side. Blocks are added where they belong, without a list.
pub struct BlockSolver<const K: usize> {
    nodes: LowerPattern,
    factor: Factor,
    values: Vec<f64>,
}

impl<const K: usize> BlockSolver<K> {
    /// Analyses the matrix with a block for each entry of the pattern.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new(nodes: LowerPattern) -> Result<Self, LinalgError> {
        Self::with(nodes, None)
    }

    /// The same for nodes that lie at these places: large systems are factored faster.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    ///
    /// # Panics
    /// When there are not as many places as nodes.
    pub fn placed(nodes: LowerPattern, places: &[Point3<f64>]) -> Result<Self, LinalgError> {
        Self::with(nodes, Some(places))
    }

    fn with(nodes: LowerPattern, places: Option<&[Point3<f64>]>) -> Result<Self, LinalgError> {
        let values = vec![0.0; nodes.entries_times(K)?];
        let factor = Factor::new::<K>(&nodes, places)?;
        Ok(Self { nodes, factor, values })
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
        self.factor.make(&self.values)
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    ///
    /// # Panics
    /// When the length is not K times the number of nodes.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.factor.solve(rhs);
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
