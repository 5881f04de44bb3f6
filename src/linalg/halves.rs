//! Cholesky factorisation of a matrix whose unknowns are in two halves and a seam, on two
//! cores: each half is factored together with the seam, as faer does it, and what both leave
//! of the seam is a dense matrix.
//!
//! With S the seam and C₁ and C₂ what eliminating either half takes from it, the halves end
//! with factors of S − C₁ and of S − C₂. Their sum less S is S − C₁ − C₂, which is left to be
//! factored. Both are parts of a positive definite matrix and so positive definite as well.
//! The result does not depend on how many cores there are.

use super::cholesky::{as_it_stands, supernodes, zeros};
use super::dissection::Dissection;
use super::pattern::started;
use super::{LinalgError, LowerPattern};
use crate::parallel::both;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot;
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::sparse::linalg::cholesky::SymbolicCholesky;
use faer::sparse::linalg::cholesky::supernodal::{
    SupernodalLltRef, SupernodeRef, SymbolicSupernodalCholesky, factorize_supernodal_numeric_llt,
    factorize_supernodal_numeric_llt_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Accum, Mat, MatMut, MatRef, Par, Spec};

/// No number.
const NONE: u32 = u32::MAX;

/// A matrix in two halves, factored.
pub struct Halves {
    halves: [Half; 2],
    /// The unknowns of the seam.
    seam: Vec<u32>,
    /// The entries of the seam in its lower triangle: row, column, and where the value is.
    entries: Vec<(usize, usize, u32)>,
    /// What the halves leave of the seam; its factor.
    left: Mat<f64>,
    scratch: MemBuffer,
    size: usize,
}

impl Halves {
    /// Analyses the matrix with a block of `K` × `K` for each entry of the pattern; nothing
    /// where the seam does not come last.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn new<const K: usize>(
        nodes: &LowerPattern,
        dissection: &Dissection,
    ) -> Result<Option<Self>, LinalgError> {
        let Dissection { halves: [one, other], seam } = dissection;
        let (one, other) =
            both(|| Half::new::<K>(nodes, one, seam), || Half::new::<K>(nodes, other, seam));
        let (Some(one), Some(other)) = (one?, other?) else { return Ok(None) };
        let halves = [one, other];
        let unknowns: Vec<u32> = seam.iter().flat_map(|&node| block::<K>(node)).collect();
        let s = unknowns.len();
        let mut entries = Vec::new();
        for (column, &left) in seam.iter().enumerate() {
            for (row, &lower) in seam.iter().enumerate() {
                // Each pair once, the way round that the pattern has it.
                if lower >= left {
                    each_of_block::<K>(nodes, [row, column], [lower, left], |row, column, from| {
                        entries.push((row.max(column), row.min(column), from));
                    });
                }
            }
        }
        let memory = cholesky_in_place_scratch::<f64>(s, Par::Seq, Spec::default());
        let size = K * nodes.size();
        let scratch = MemBuffer::try_new(memory).map_err(|_| LinalgError::TooLarge { size })?;
        let left = Mat::zeros(s, s);
        Ok(Some(Self { halves, seam: unknowns, entries, left, scratch, size }))
    }

    /// Factors the matrix with these values, one for each entry of the pattern of unknowns.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row at which the factorisation stopped.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        let size = self.size;
        let singular = |row: u32| LinalgError::NotPositiveDefinite { size, row: row as usize };
        let [one, other] = &mut self.halves;
        let (one, other) = both(|| one.factor(values), || other.factor(values));
        let (one, other) = (one.map_err(singular)?, other.map_err(singular)?);
        self.left.copy_from(one + other);
        for &(row, column, from) in &self.entries {
            self.left[(row, column)] -= values[from as usize];
        }
        cholesky_in_place(
            self.left.as_mut(),
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Spec::default(),
        )
        .map(drop)
        .map_err(|NonPositivePivot { index }| singular(self.seam[index]))
    }

    /// Replaces the right-hand side by the solution of the matrix factored last.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let [one, other] = &mut self.halves;
        let all: &[f64] = rhs;
        both(|| one.forward(all), || other.forward(all));
        let take = |(k, &unknown): (usize, &u32)| {
            all[unknown as usize] + one.x[one.own + k] + other.x[other.own + k]
        };
        let mut seam: Vec<f64> = self.seam.iter().enumerate().map(take).collect();
        let mut x = column(&mut seam);
        solve_lower_triangular_in_place(self.left.as_ref(), x.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(self.left.transpose(), x.as_mut(), Par::Seq);
        both(|| one.backward(&seam), || other.backward(&seam));
        let own = self.halves.iter().flat_map(|half| half.unknowns.iter().zip(&half.x[..half.own]));
        for (&unknown, x) in own.chain(self.seam.iter().zip(&seam)) {
            rhs[unknown as usize] = *x;
        }
    }
}

/// The unknowns of a node.
fn block<const K: usize>(node: u32) -> impl Iterator<Item = u32> {
    (0..K as u32).map(move |i| K as u32 * node + i)
}

/// Gives the entries of the block of two nodes, of which the first is the lower one in the
/// pattern: row and column, if nodes are numbered as in `numbers`, and where the value is. None
/// where the pattern does not have the block.
fn each_of_block<const K: usize>(
    nodes: &LowerPattern,
    numbers: [usize; 2],
    [lower, left]: [u32; 2],
    mut take: impl FnMut(usize, usize, u32),
) {
    let Some(starts) = nodes.find_block::<K>(lower as usize, left as usize) else { return };
    for (within, start) in starts.into_iter().enumerate() {
        for i in if lower == left { within } else { 0 }..K {
            take(K * numbers[0] + i, K * numbers[1] + within, (start + i) as u32);
        }
    }
}

/// One half with the seam.
struct Half {
    symbolic: SymbolicCholesky<u32>,
    /// The lower triangle in the order of the factor, by columns.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// Where the value of each entry is among those of the whole matrix.
    from: Vec<u32>,
    values: Vec<f64>,
    factor: Vec<f64>,
    scratch: MemBuffer,
    /// The unknowns in the order of the factor, the seam's last.
    unknowns: Vec<u32>,
    /// How many of them are the half's own.
    own: usize,
    /// A vector, in the order of the factor.
    x: Vec<f64>,
}

impl Half {
    fn new<const K: usize>(
        nodes: &LowerPattern,
        own: &[u32],
        seam: &[u32],
    ) -> Result<Option<Self>, LinalgError> {
        let local = local_pattern(nodes, own, seam)?;
        let size = K * local.size();
        let too_large = || LinalgError::TooLarge { size };
        let symbolic = as_it_stands(&local.times(K)?)?;
        let Some((forward, inverse)) = symbolic.perm().map(|perm| perm.arrays()) else {
            return Ok(None);
        };
        if (K * own.len()..size).any(|i| forward[i] as usize != i) {
            return Ok(None);
        }
        let node = |i: usize| *own.get(i).unwrap_or_else(|| &seam[i - own.len()]);
        let (starts, rows, from) = placed::<K>(nodes, &local, node, inverse);
        let unknown = |&i: &u32| K as u32 * node(i as usize / K) + i % K as u32;
        let own = K * own.len();
        let unknowns = forward.iter().map(unknown).collect();
        let memory = factorize_supernodal_numeric_llt_scratch::<u32, f64>(
            supernodes(&symbolic),
            Par::Seq,
            Spec::default(),
        );
        let scratch = MemBuffer::try_new(memory).map_err(|_| too_large())?;
        let factor = zeros(symbolic.len_val()).ok_or_else(too_large)?;
        let values = vec![0.0; from.len()];
        let x = vec![0.0; size];
        Ok(Some(Self { symbolic, starts, rows, from, values, factor, scratch, unknowns, own, x }))
    }

    /// Factors the half; returns what it leaves of the seam, in the lower triangle, or the
    /// unknown at which it stopped.
    fn factor(&mut self, values: &[f64]) -> Result<Mat<f64>, u32> {
        for (value, &from) in self.values.iter_mut().zip(&self.from) {
            *value = values[from as usize];
        }
        let size = self.x.len();
        let pattern = SymbolicSparseColMatRef::new_unsorted_checked(
            size,
            size,
            &self.starts,
            None,
            &self.rows,
        );
        let supernodes = supernodes(&self.symbolic);
        factorize_supernodal_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new(pattern, &self.values),
            LltRegularization::default(),
            supernodes,
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Spec::default(),
        )
        .map_err(|NonPositivePivot { index }| self.unknowns[index])?;
        Ok(self.left(supernodes))
    }

    /// L Lᵀ of the part of the factor that is the seam's.
    fn left(&self, symbolic: &SymbolicSupernodalCholesky<u32>) -> Mat<f64> {
        let s = self.x.len() - self.own;
        let mut lower = Mat::<f64>::zeros(s, s);
        let factor = SupernodalLltRef::new(symbolic, &self.factor);
        for node in (0..symbolic.n_supernodes()).map(|n| factor.supernode(n)) {
            let (start, columns) = (node.start(), node.val().ncols());
            for column in self.own.saturating_sub(start)..columns {
                let at = start + column - self.own;
                for (k, row) in rows(&node, column).enumerate() {
                    lower[(row - self.own, at)] = node.val()[(column + k, column)];
                }
            }
        }
        let mut left = Mat::zeros(s, s);
        triangular::matmul(
            left.as_mut(),
            BlockStructure::TriangularLower,
            Accum::Replace,
            lower.as_ref(),
            BlockStructure::TriangularLower,
            lower.transpose(),
            BlockStructure::TriangularUpper,
            1.0,
            Par::Seq,
        );
        left
    }

    /// Solves L x = b for the half; what that takes from the seam is left in its place.
    fn forward(&mut self, rhs: &[f64]) {
        let (own, seam) = self.x.split_at_mut(self.own);
        own.iter_mut().zip(&self.unknowns).for_each(|(x, &i)| *x = rhs[i as usize]);
        seam.fill(0.0);
        let symbolic = supernodes(&self.symbolic);
        let factor = SupernodalLltRef::new(symbolic, &self.factor);
        let mut below = Vec::new();
        for node in (0..symbolic.n_supernodes()).map(|n| factor.supernode(n)) {
            let Some((start, top, bottom)) = parts(&node, self.own) else { break };
            let columns = top.ncols();
            let mut x = column(&mut self.x[start..start + columns]);
            solve_lower_triangular_in_place(top, x.as_mut(), Par::Seq);
            below.clear();
            below.resize(bottom.nrows(), 0.0);
            matmul(column(&mut below), Accum::Replace, bottom, x.as_ref(), 1.0, Par::Seq);
            for (row, below) in rows(&node, columns).zip(&below) {
                self.x[row] -= below;
            }
        }
    }

    /// Solves Lᵀ x = b, given the solution for the seam.
    fn backward(&mut self, seam: &[f64]) {
        self.x[self.own..].copy_from_slice(seam);
        let symbolic = supernodes(&self.symbolic);
        let factor = SupernodalLltRef::new(symbolic, &self.factor);
        let mut below = Vec::new();
        for node in (0..symbolic.n_supernodes()).rev().map(|n| factor.supernode(n)) {
            let Some((start, top, bottom)) = parts(&node, self.own) else { continue };
            let columns = top.ncols();
            below.clear();
            below.extend(rows(&node, columns).map(|row| self.x[row]));
            let mut x = column(&mut self.x[start..start + columns]);
            let by = column(&mut below);
            matmul(x.as_mut(), Accum::Add, bottom.transpose(), by.as_ref(), -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), x.as_mut(), Par::Seq);
        }
    }
}

/// Who of a half and the seam shares an entry, numbered in their order. All of the seam do, so
/// that no order which keeps the fill takes them apart.
fn local_pattern(
    nodes: &LowerPattern,
    own: &[u32],
    seam: &[u32],
) -> Result<LowerPattern, LinalgError> {
    let mut numbers = vec![NONE; nodes.size()];
    for (number, &node) in own.iter().chain(seam).enumerate() {
        numbers[node as usize] = number as u32;
    }
    let number = |node: u32| numbers[node as usize];
    let pairs = own.iter().chain(seam).flat_map(|&node| {
        let with = nodes.column(node as usize).iter().map(|&other| number(other));
        with.filter(|&other| other != NONE)
            .map(move |other| (number(node) as usize, other as usize))
    });
    let seam = own.len()..own.len() + seam.len();
    let among = seam.clone().flat_map(|i| (i..seam.end).map(move |j| (j, i)));
    LowerPattern::new(seam.end, pairs.chain(among))
}

/// The entries of a half in the order of its factor, where `inverse` says where each unknown
/// comes to stand: starts of columns, rows, and where values come from.
fn placed<const K: usize>(
    nodes: &LowerPattern,
    local: &LowerPattern,
    node: impl Fn(usize) -> u32,
    inverse: &[u32],
) -> (Vec<u32>, Vec<u32>, Vec<u32>) {
    let visit = |take: &mut dyn FnMut(u32, u32, u32)| {
        for column in 0..local.size() {
            for &row in local.column(column) {
                let ends = [row as usize, column].map(|i| (node(i), i));
                let [(left, column), (lower, row)] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                each_of_block::<K>(nodes, [row, column], [lower, left], |row, column, from| {
                    let [p, q] = [row, column].map(|i| inverse[i]);
                    take(p.max(q), p.min(q), from);
                });
            }
        }
    };
    let mut ends = vec![0_u32; K * local.size()];
    visit(&mut |_, column, _| ends[column as usize] += 1);
    let starts = started(&mut ends);
    let total = starts[ends.len()] as usize;
    let (mut rows, mut froms) = (vec![0; total], vec![0; total]);
    visit(&mut |row, column, from| {
        let at = &mut ends[column as usize];
        (rows[*at as usize], froms[*at as usize]) = (row, from);
        *at += 1;
    });
    (starts, rows, froms)
}

/// The first of the columns of a supernode which are the half's own: where they begin, their
/// square on the diagonal and what is below. Nothing where all are the seam's.
fn parts<'a>(
    node: &SupernodeRef<'a, u32, f64>,
    own: usize,
) -> Option<(usize, MatRef<'a, f64>, MatRef<'a, f64>)> {
    let start = node.start();
    let columns = node.val().ncols().min(own.checked_sub(start).filter(|&some| some > 0)?);
    let (top, bottom) = node.val().subcols(0, columns).split_at_row(columns);
    Some((start, top, bottom))
}

/// The rows of a supernode from one of its columns on.
fn rows(node: &SupernodeRef<'_, u32, f64>, from: usize) -> impl Iterator<Item = usize> {
    let (start, columns) = (node.start(), node.val().ncols());
    (start + from..start + columns).chain(node.pattern().iter().map(|&row| row as usize))
}

fn column(x: &mut [f64]) -> MatMut<'_, f64> {
    let length = x.len();
    MatMut::from_column_major_slice_mut(x, length, 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::dissection::dissect;
    use crate::linalg::{BlockSolver, SpdSolver};
    use nalgebra::{Matrix2, Point3};

    /// A square net of springs on a dome, each held a little to the ground.
    fn net(side: usize) -> (Vec<Point3<f64>>, Vec<(usize, usize)>) {
        let place = |k: usize| {
            let [x, y] = [k % side, k / side].map(|i| i as f64 / side as f64 - 0.5);
            Point3::new(x, y, -x * x - y * y)
        };
        let places = (0..side * side).map(place).collect();
        let right = (0..side * side).filter(|k| k % side + 1 < side).map(|k| (k + 1, k));
        let up = (0..side * (side - 1)).map(|k| (k + side, k));
        (places, right.chain(up).collect())
    }

    fn stiffness(i: usize, j: usize) -> f64 {
        1.0 + ((7 * i + 3 * j) % 11) as f64
    }

    /// Solved in halves and whole, the same comes out.
    #[test]
    fn halves_solve_as_the_whole_does() {
        for side in [20, 71, 75] {
            let (places, springs) = net(side);
            let mut entries: Vec<(usize, usize)> = (0..places.len()).map(|i| (i, i)).collect();
            let mut values = vec![0.1; places.len()];
            for &(i, j) in &springs {
                entries.extend([(i, i), (j, j), (i, j)]);
                let k = stiffness(i, j);
                values.extend([k, k, -k]);
            }
            let mut whole = SpdSolver::new(places.len(), &entries).unwrap();
            let mut halves = SpdSolver::placed(&entries, &places).unwrap();
            for scale in [1.0, 3.0] {
                let scaled: Vec<f64> = values.iter().map(|v| v * scale).collect();
                whole.factor(&scaled).unwrap();
                halves.factor(&scaled).unwrap();
                let rhs: Vec<f64> = (0..places.len()).map(|i| ((i * i) % 17) as f64).collect();
                let (mut x, mut y) = (rhs.clone(), rhs);
                whole.solve(&mut x);
                halves.solve(&mut y);
                let most = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                let off = x.iter().zip(&y).fold(0.0_f64, |off, (x, y)| off.max((x - y).abs()));
                assert!(off < 1e-12 * most, "{side}: {off} of {most}");
            }
        }
    }

    #[test]
    fn blocks_of_halves_solve_as_the_whole_does() {
        let (places, springs) = net(60);
        let pattern = LowerPattern::new(places.len(), springs.iter().copied()).unwrap();
        let dissection = dissect(&pattern, &places).unwrap().unwrap();
        assert!(Halves::new::<2>(&pattern, &dissection).unwrap().is_some());
        let mut whole = BlockSolver::<2>::new(pattern.clone()).unwrap();
        let mut halves = BlockSolver::<2>::placed(pattern, &places).unwrap();
        for solver in [&mut whole, &mut halves] {
            for i in 0..places.len() {
                solver.add(i, i, &Matrix2::new(90.0, 1.0, 1.0, 80.0));
            }
            for &(i, j) in &springs {
                let k = stiffness(i, j);
                solver.add(j, i, &Matrix2::new(-k, 0.3 * k, 0.5, -0.7 * k));
            }
            solver.factor().unwrap();
        }
        let rhs: Vec<f64> = (0..2 * places.len()).map(|i| ((i * i) % 17) as f64).collect();
        let (mut x, mut y) = (rhs.clone(), rhs);
        whole.solve(&mut x);
        halves.solve(&mut y);
        assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-12));
    }

    /// Halves that nothing holds together have no seam.
    #[test]
    fn halves_without_a_seam_are_solved() {
        let pairs = [(1, 0), (3, 2)];
        let pattern = LowerPattern::new(4, pairs.into_iter()).unwrap();
        let dissection = Dissection { halves: [vec![1, 0], vec![2, 3]], seam: vec![] };
        let mut halves = Halves::new::<1>(&pattern, &dissection).unwrap().unwrap();
        halves.factor(&[2.0, 1.0, 2.0, 4.0, 2.0, 4.0]).unwrap();
        let mut x = [3.0, 3.0, 6.0, 6.0];
        halves.solve(&mut x);
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15), "{x:?}");
    }

    /// Wherever the matrix is not positive definite, in a half or in the seam, that is said.
    #[test]
    fn the_unknown_without_stiffness_is_named() {
        let (places, springs) = net(75);
        let pattern = LowerPattern::new(places.len(), springs.iter().copied()).unwrap();
        let Dissection { halves: [one, other], seam } =
            dissect(&pattern, &places).unwrap().unwrap();
        for weak in [one[100], other[100], seam[3]] {
            let mut solver = BlockSolver::<1>::placed(pattern.clone(), &places).unwrap();
            for i in 0..places.len() {
                let own = if i == weak as usize { -1.0 } else { 2.0 };
                solver.add(i, i, &nalgebra::Matrix1::new(own));
            }
            let error = solver.factor().unwrap_err();
            let wanted = LinalgError::NotPositiveDefinite { size: 75 * 75, row: weak as usize };
            assert_eq!(error, wanted);
        }
    }
}
