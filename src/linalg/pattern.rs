//! Where a symmetric matrix has entries: the lower triangle by columns.

use super::LinalgError;
use std::array;

/// The lower triangle of a symmetric pattern in compressed columns, each sorted and
/// beginning with its diagonal. Indices take 32 bits: half the memory of the wide
/// ones, and a factor with more entries would not fit into memory anyway.
#[derive(Clone, PartialEq, Debug)]
pub struct LowerPattern {
    /// Where each column starts in `rows`, and the end.
    pub(super) starts: Vec<u32>,
    pub(super) rows: Vec<u32>,
}

impl LowerPattern {
    /// The pattern of `size` unknowns with these pairs of unknowns and the whole
    /// diagonal. Pairs stand for both halves, either way round, any number of times.
    /// They are walked through twice.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when the entries cannot be counted in 32 bits.
    ///
    /// # Panics
    /// On a pair beyond `size`.
    pub fn new(
        size: usize,
        pairs: impl Iterator<Item = (usize, usize)> + Clone,
    ) -> Result<Self, LinalgError> {
        let too_large = || LinalgError::TooLarge { size };
        let below = || pairs.clone().filter(|(i, j)| i != j).map(|(i, j)| (i.max(j), i.min(j)));
        let mut ends = vec![1_usize; size];
        for (_, column) in below() {
            ends[column] += 1;
        }
        let mut total = 0;
        for end in &mut ends {
            let start = total;
            total += *end;
            *end = start;
        }
        u32::try_from(total).map_err(|_| too_large())?;
        u32::try_from(2 * size + 1).map_err(|_| too_large())?;
        let mut rows = vec![0_u32; total];
        let mut put = |row: usize, column: usize| {
            rows[ends[column]] = row as u32;
            ends[column] += 1;
        };
        (0..size).for_each(|i| put(i, i));
        below().for_each(|(row, column)| put(row, column));
        Ok(Self::from_columns(rows, &ends))
    }

    /// Sorts the columns that end at `ends` and drops what is there twice.
    fn from_columns(mut rows: Vec<u32>, ends: &[usize]) -> Self {
        let mut starts = Vec::with_capacity(ends.len() + 1);
        starts.push(0);
        let (mut from, mut kept) = (0, 0);
        for &end in ends {
            rows[from..end].sort_unstable();
            let first = kept;
            for k in from..end {
                if kept == first || rows[kept - 1] != rows[k] {
                    rows[kept] = rows[k];
                    kept += 1;
                }
            }
            starts.push(kept as u32);
            from = end;
        }
        rows.truncate(kept);
        rows.shrink_to_fit();
        Self { starts, rows }
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of entries of the lower triangle.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// The rows of a column, the diagonal first.
    pub fn column(&self, column: usize) -> &[u32] {
        &self.rows[self.starts[column] as usize..self.starts[column + 1] as usize]
    }

    /// Whether a pair of unknowns, either way round, is in the pattern.
    pub fn holds(&self, i: usize, j: usize) -> bool {
        self.find(i.max(j), i.min(j)).is_some()
    }

    /// Where among the entries of its column a row stands, if it does.
    fn find(&self, row: usize, column: usize) -> Option<usize> {
        self.column(column).binary_search(&(row as u32)).ok()
    }

    /// Where an entry stands among all.
    ///
    /// # Panics
    /// When the pair is not in the pattern or stands above the diagonal.
    pub fn position(&self, row: usize, column: usize) -> usize {
        self.starts[column] as usize + self.find(row, column).expect("the pattern holds the pair")
    }

    /// Number of entries of the pattern with `k` unknowns in place of each.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when they cannot be counted in 32 bits.
    pub(super) fn entries_times(&self, k: usize) -> Result<usize, LinalgError> {
        let total = k * k * self.entries() - self.size() * k * (k - 1) / 2;
        u32::try_from(total).map_err(|_| LinalgError::TooLarge { size: k * self.size() })?;
        Ok(total)
    }

    /// The pattern with `k` unknowns in place of each, side by side. Every entry becomes a
    /// block of k × k, those on the diagonal its lower half; see
    /// [`block_starts`](Self::block_starts).
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when the entries cannot be counted in 32 bits.
    pub fn times(&self, k: usize) -> Result<Self, LinalgError> {
        let total = self.entries_times(k)?;
        let mut times = Self {
            starts: Vec::with_capacity(k * self.size() + 1),
            rows: Vec::with_capacity(total),
        };
        times.starts.push(0);
        for column in 0..self.size() {
            for within in 0..k {
                let of = |&row: &u32| (0..k as u32).map(move |i| k as u32 * row + i);
                times.rows.extend(self.column(column).iter().flat_map(of).skip(within));
                times.starts.push(times.rows.len() as u32);
            }
        }
        Ok(times)
    }

    /// Where each column of the block of an entry begins in [`times`](Self::times) `K`: the
    /// place of the block's first row there. On the diagonal the rows above the diagonal are
    /// not stored, but counted. Nothing where the pattern does not have the pair.
    pub(super) fn find_block<const K: usize>(
        &self,
        row: usize,
        column: usize,
    ) -> Option<[usize; K]> {
        let rank = self.find(row, column)?;
        let entries = self.column(column).len();
        let before = K * K * self.starts[column] as usize - column * K * (K - 1) / 2;
        let first = before + K * rank;
        // Each column within the block lacks one more entry at its top.
        Some(array::from_fn(|within| first + within * K * entries - within * (within + 1) / 2))
    }

    /// The same of a pair that the pattern has.
    ///
    /// # Panics
    /// When it does not, or the pair stands above the diagonal.
    pub(super) fn block_starts<const K: usize>(&self, row: usize, column: usize) -> [usize; K] {
        self.find_block(row, column).expect("the pattern holds the pair")
    }
}

/// Where each of some lists begins if one stands after the other, and the end of all; what was
/// the length of a list becomes where it begins, to be filled from there.
pub(super) fn started(lengths: &mut [u32]) -> Vec<u32> {
    let mut starts = Vec::with_capacity(lengths.len() + 1);
    let mut total = 0;
    for length in lengths {
        starts.push(total);
        total += std::mem::replace(length, total);
    }
    starts.push(total);
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle_fan() -> LowerPattern {
        let pairs = [(0, 1), (3, 1), (1, 0), (2, 0), (2, 2), (3, 0)];
        LowerPattern::new(4, pairs.into_iter()).unwrap()
    }

    #[test]
    fn pairs_are_sorted_once_each_with_the_diagonal_first() {
        let pattern = triangle_fan();
        let columns: Vec<&[u32]> = (0..4).map(|c| pattern.column(c)).collect();
        assert_eq!(columns, [&[0, 1, 2, 3][..], &[1, 3], &[2], &[3]]);
        assert_eq!(pattern.position(3, 1), 5);
    }

    #[test]
    fn blocks_are_found_in_the_larger_pattern() {
        let pattern = triangle_fan();
        blocks_are_found::<1>(&pattern);
        blocks_are_found::<2>(&pattern);
        blocks_are_found::<4>(&pattern);
    }

    fn blocks_are_found<const K: usize>(pattern: &LowerPattern) {
        let times = pattern.times(K).unwrap();
        assert_eq!(times.size(), 4 * K);
        for column in 0..4 {
            for &row in pattern.column(column) {
                let row = row as usize;
                for (within, start) in pattern.block_starts::<K>(row, column).iter().enumerate() {
                    let above = if row == column { within } else { 0 };
                    for i in above..K {
                        assert_eq!(start + i, times.position(K * row + i, K * column + within));
                    }
                }
            }
        }
    }
}
