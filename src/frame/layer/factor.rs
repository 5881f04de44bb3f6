//! A factor of the matrix K of a patch, made to be asked for the core of its inverse.
//!
//! K = L D Lᵀ, with the rows of the rim eliminated first. What the inverse does between
//! rows of the core then hangs on the last columns of L alone, which are few: a column of
//! it takes microseconds. Within rim and core, the row of fewest neighbours goes first
//! (minimum degree); rows are factored one by one (Davis, *Direct Methods for Sparse Linear
//! Systems*, 4.7).

/// L and D, with rows in the order of elimination.
pub struct Factor {
    /// Where each row stands in that order.
    place: Vec<usize>,
    /// Where each column of L starts in `below`, and the end.
    starts: Vec<usize>,
    /// The entries of L below its diagonal, by columns.
    below: Vec<(u32, f64)>,
    /// D.
    pivots: Vec<f64>,
    /// The number of rows of the core.
    core: usize,
}

/// Added to the diagonal of K, as part of its largest entry: rounding cannot make the
/// sum indefinite then, and no move that matters is as weak as this.
const DIAGONAL: f64 = 1e-9;

impl Factor {
    /// Factors a K of `size` rows, the first `core` of them the core, given as parts of its
    /// entries: each pair of rows stands for both halves, and parts of one entry are added
    /// up. None where K cannot be inverted.
    pub fn new(size: usize, core: usize, parts: &[(usize, usize, f64)]) -> Option<Self> {
        let mut diagonal = vec![0.0; size];
        for &(i, _, value) in parts.iter().filter(|(i, j, _)| i == j) {
            diagonal[i] += value;
        }
        let small = DIAGONAL * diagonal.into_iter().fold(0.0, f64::max);
        let Order { place, columns } = Order::new(size, core, parts);
        let mut rows: Vec<Vec<(usize, f64)>> = (0..size).map(|i| vec![(i, small)]).collect();
        for &(i, j, value) in parts {
            let [p, q] = [place[i], place[j]];
            rows[p.max(q)].push((p.min(q), value));
        }
        let mut starts = vec![0];
        starts.extend(columns.iter().scan(0, |end, column| {
            *end += column.len();
            Some(*end)
        }));
        let below = vec![(0, 0.0); starts[size]];
        let mut factor = Self { place, starts, below, pivots: Vec::with_capacity(size), core };
        factor.eliminate(&columns, &rows).then_some(factor)
    }

    /// Finds L and D row by row; false where a pivot is not positive.
    fn eliminate(&mut self, columns: &[Vec<usize>], rows: &[Vec<(usize, f64)>]) -> bool {
        let mut entries: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
        for (column, below) in columns.iter().enumerate() {
            below.iter().for_each(|&row| entries[row].push(column));
        }
        // Up to where each column has been filled.
        let mut filled = self.starts.clone();
        let mut left = vec![0.0; rows.len()];
        for (row, (parts, entries)) in rows.iter().zip(&entries).enumerate() {
            parts.iter().for_each(|&(column, value)| left[column] += value);
            let mut pivot = std::mem::take(&mut left[row]);
            for &column in entries {
                let value = std::mem::take(&mut left[column]);
                for &(other, l) in &self.below[self.starts[column]..filled[column]] {
                    left[other as usize] -= l * value;
                }
                let l = value / self.pivots[column];
                pivot -= l * value;
                self.below[filled[column]] = (row as u32, l);
                filled[column] += 1;
            }
            if pivot.is_nan() || pivot <= 0.0 {
                return false;
            }
            self.pivots.push(pivot);
        }
        true
    }

    /// The part of K⁻¹ v in the core.
    pub fn times(&self, v: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; v.len()];
        for (&place, v) in self.place.iter().zip(v) {
            x[place] = *v;
        }
        self.forward(&mut x, 0);
        self.back(x)
    }

    /// The part of a column of K⁻¹ in the core; `i` in the core.
    pub fn column(&self, i: usize) -> Vec<f64> {
        self.back(self.forward_of(i))
    }

    /// K⁻¹ᵢᵢ; `i` in the core.
    pub fn diagonal(&self, i: usize) -> f64 {
        let x = self.forward_of(i);
        let start = self.place[i];
        x[start..].iter().zip(&self.pivots[start..]).map(|(x, d)| x * x / d).sum()
    }

    /// L⁻¹ times a unit vector.
    fn forward_of(&self, i: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.pivots.len()];
        x[self.place[i]] = 1.0;
        self.forward(&mut x, self.place[i]);
        x
    }

    /// Replaces x, zero up to `start`, by L⁻¹ x.
    fn forward(&self, x: &mut [f64], start: usize) {
        for column in start..x.len() {
            let value = x[column];
            if value != 0.0 {
                for &(row, l) in self.column_below(column) {
                    x[row as usize] -= l * value;
                }
            }
        }
    }

    /// The part of L⁻ᵀ D⁻¹ x in the core.
    fn back(&self, mut x: Vec<f64>) -> Vec<f64> {
        for column in (x.len() - self.core..x.len()).rev() {
            let known = self.column_below(column).iter().map(|&(row, l)| l * x[row as usize]);
            x[column] = x[column] / self.pivots[column] - known.sum::<f64>();
        }
        self.place[..self.core].iter().map(|&place| x[place]).collect()
    }

    fn column_below(&self, column: usize) -> &[(u32, f64)] {
        &self.below[self.starts[column]..self.starts[column + 1]]
    }
}

/// An order of elimination and what it fills.
struct Order {
    /// Where each row stands in the order.
    place: Vec<usize>,
    /// By place, the places below the diagonal at which a column of L has entries.
    columns: Vec<Vec<usize>>,
}

impl Order {
    /// The rim before the core, and the row of fewest neighbours first. Neighbours are kept
    /// as sets of bits: with some hundred rows these are a few words each.
    fn new(size: usize, core: usize, parts: &[(usize, usize, f64)]) -> Self {
        let words = size.div_ceil(64);
        let mut near = vec![vec![0_u64; words]; size];
        for &(i, j, _) in parts.iter().filter(|(i, j, _)| i != j) {
            near[i][j / 64] |= 1 << (j % 64);
            near[j][i / 64] |= 1 << (i % 64);
        }
        let count = |set: &[u64]| set.iter().map(|word| word.count_ones()).sum::<u32>();
        let mut counts: Vec<u32> = near.iter().map(|set| count(set)).collect();
        let mut place = vec![0; size];
        let mut columns = Vec::with_capacity(size);
        for (range, base) in [(core..size, 0), (0..core, size - core)] {
            let mut left: Vec<usize> = range.collect();
            for at in base..base + left.len() {
                // The rows left over keep no order of their own, so ties go by number.
                let least = (0..left.len()).min_by_key(|&k| (counts[left[k]], left[k]));
                let Some(row) = least.map(|k| left.swap_remove(k)) else { break };
                place[row] = at;
                let around = std::mem::take(&mut near[row]);
                for other in members(&around) {
                    let set = &mut near[other];
                    set.iter_mut().zip(&around).for_each(|(word, more)| *word |= more);
                    set[row / 64] &= !(1 << (row % 64));
                    set[other / 64] &= !(1 << (other % 64));
                    counts[other] = count(set);
                }
                columns.push(around);
            }
        }
        let places = |set: &Vec<u64>| members(set).map(|row| place[row]).collect();
        let columns = columns.iter().map(places).collect();
        Self { place, columns }
    }
}

/// The members of a set of bits.
fn members(set: &[u64]) -> impl Iterator<Item = usize> {
    set.iter().enumerate().flat_map(|(i, &word)| {
        std::iter::successors(Some(word), |w| Some(w & w.wrapping_sub(1)))
            .take_while(|&w| w != 0)
            .map(move |w| 64 * i + w.trailing_zeros() as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    const SIZE: usize = 70;

    /// A sparse positive definite matrix as parts: springs between some rows.
    fn springs() -> impl Strategy<Value = Vec<(usize, usize, f64)>> {
        let spring = (0..SIZE, 0..SIZE, 0.1..2.0f64);
        proptest::collection::vec(spring, 1..150).prop_map(|springs| {
            let ends = |&(i, j, k): &(usize, usize, f64)| [(i, i, k), (j, j, k), (i, j, -k)];
            let apart = springs.iter().filter(|(i, j, _)| i != j).flat_map(ends);
            apart.chain((0..SIZE).map(|i| (i, i, 0.2))).collect()
        })
    }

    fn dense(parts: &[(usize, usize, f64)]) -> DMatrix<f64> {
        let mut k = DMatrix::zeros(SIZE, SIZE);
        for &(i, j, value) in parts {
            k[(i, j)] += value;
            if i != j {
                k[(j, i)] += value;
            }
        }
        k
    }

    proptest! {
        #[test]
        fn it_answers_as_the_dense_inverse(parts in springs(), core in 1..=SIZE) {
            let inverse = dense(&parts).try_inverse().unwrap();
            let factor = Factor::new(SIZE, core, &parts).unwrap();
            let v: Vec<f64> = (0..SIZE).map(|i| (i as f64).sin()).collect();
            let wanted = &inverse * DVector::from(v.clone());
            let found = factor.times(&v);
            prop_assert_eq!(found.len(), core);
            for i in 0..core {
                prop_assert!((found[i] - wanted[i]).abs() < 1e-6);
                prop_assert!((factor.diagonal(i) - inverse[(i, i)]).abs() < 1e-6);
                for (j, found) in factor.column(i).into_iter().enumerate() {
                    prop_assert!((found - inverse[(j, i)]).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn what_contradicts_itself_is_refused() {
        assert!(Factor::new(2, 2, &[(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)]).is_none());
        assert!(Factor::new(1, 1, &[(0, 0, f64::NAN)]).is_none());
    }

    /// A chain that is eliminated from its ends fills nothing.
    #[test]
    fn a_chain_stays_as_sparse_as_it_is() {
        let parts: Vec<_> = (0..99).flat_map(|i| [(i, i, 2.0), (i + 1, i, -1.0)]).collect();
        let order = Order::new(100, 100, &parts);
        assert_eq!(order.columns.iter().map(Vec::len).sum::<usize>(), 99);
    }
}
