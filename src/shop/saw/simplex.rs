//! The revised simplex method with the inverse of the basis at hand: made for column
//! generation, where columns are added between pivots and the prices of the rows are wanted
//! (Chvátal, *Linear Programming*, 1983, chapters 7 and 13).
//!
//! Rows are some hundred and the inverse is dense. What is made of the prices and values has to
//! allow for their noise.
//!
//! Of libraries, microlp 0.7 gives no prices, and on the dual with cuts took 36 s for 1000 rods.
//! clarabel 0.11, an interior point solver that starts anew each round, its solution taken as it
//! is and not moved to a vertex, took six times as long on 69 random tasks, with 56 plans proven
//! for 57 and 2 worse for 1 better.

use super::work::Work;

/// A column: what one unit of it costs, and its entries by row.
#[derive(Clone, Debug)]
pub struct Column {
    /// Cost of one unit.
    pub cost: f64,
    /// Row and entry.
    pub entries: Vec<(usize, f64)>,
}

/// The least cost of columns, none used less than 0 times, that add up to the right-hand side.
#[derive(Clone, Debug)]
pub struct Simplex {
    columns: Vec<Column>,
    /// The column of each row of the basis.
    basis: Vec<usize>,
    is_basic: Vec<bool>,
    /// Inverse of the basis, row by row.
    inverse: Vec<f64>,
    /// How much of each basic column is used.
    values: Vec<f64>,
    /// What one unit of each row is worth.
    prices: Vec<f64>,
    right: Vec<f64>,
    pivots: usize,
}

/// A column is taken in when it saves this much, of costs about 1. Smaller, and noise is taken
/// in; larger, and prices are farther off.
const SAVING: f64 = 1e-9;
/// Entries so small are no pivots: dividing by them makes noise large.
const LEAST_PIVOT: f64 = 1e-9;
/// Pivots after which the inverse is made anew: noise grows with them.
const FRESH: usize = 1000;
/// The right-hand side is raised by up to so much, differently in each row, so that no two
/// columns reach 0 at once, and pivots never go round in a circle. Smaller, and noise hides it;
/// larger, and values are farther off.
const APART: f64 = 1e-6;
/// The golden ratio, whose multiples lie apart.
const GOLDEN: f64 = 0.618_033_988_749_895;

impl Simplex {
    /// A program with one column for each row, which holds 1 in it and nothing else.
    pub fn new(right: Vec<f64>, costs: &[f64]) -> Self {
        let m = right.len();
        let apart = |(r, b): (usize, f64)| b + APART * (1.0 + (r as f64 * GOLDEN).fract());
        let right: Vec<f64> = right.into_iter().enumerate().map(apart).collect();
        let column = |(row, &cost): (usize, &f64)| Column { cost, entries: vec![(row, 1.0)] };
        let mut inverse = vec![0.0; m * m];
        (0..m).for_each(|r| inverse[r * m + r] = 1.0);
        Self {
            columns: costs.iter().enumerate().map(column).collect(),
            basis: (0..m).collect(),
            is_basic: vec![true; m],
            inverse,
            values: right.clone(),
            prices: costs.to_vec(),
            right,
            pivots: 0,
        }
    }

    /// Adds a column, which is not used yet.
    pub fn add(&mut self, column: Column) {
        self.columns.push(column);
        self.is_basic.push(false);
    }

    /// What one unit of each row is worth.
    pub fn prices(&self) -> &[f64] {
        &self.prices
    }

    /// What the columns cost as they are used.
    pub fn value(&self) -> f64 {
        self.basis.iter().zip(&self.values).map(|(&c, x)| self.columns[c].cost * x).sum()
    }

    /// The columns in use, by their numbers, and how much of each.
    pub fn used(&self) -> impl Iterator<Item = (usize, f64)> {
        self.basis.iter().copied().zip(self.values.iter().copied())
    }

    /// Takes in columns while they save. False if there is no more work left, or noise
    /// has the better of it.
    pub fn solve(&mut self, work: &mut Work) -> bool {
        let m = self.right.len();
        while let Some(column) = self.saving() {
            if !work.spend(m * m) {
                return false;
            }
            let steps = self.steps(&self.columns[column].entries);
            let Some(row) = self.leaving(&steps) else { return false };
            self.pivot(row, column, &steps);
            self.pivots += 1;
            if self.pivots.is_multiple_of(FRESH) && !(work.spend(m * m * m) && self.refresh()) {
                return false;
            }
        }
        true
    }

    /// The column that saves most.
    fn saving(&self) -> Option<usize> {
        let excess =
            |c: &Column| c.cost - c.entries.iter().map(|&(r, a)| self.prices[r] * a).sum::<f64>();
        let free = (0..self.columns.len()).filter(|&c| !self.is_basic[c]);
        let saving = free.map(|c| (excess(&self.columns[c]), c));
        saving.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|s| s.0 < -SAVING).map(|s| s.1)
    }

    /// How much of each basic column one unit of another column replaces.
    fn steps(&self, entries: &[(usize, f64)]) -> Vec<f64> {
        let row = |row: &[f64]| entries.iter().map(|&(r, a)| row[r] * a).sum();
        self.inverse.chunks_exact(self.right.len()).map(row).collect()
    }

    /// The row of the basic column that is used up first.
    fn leaving(&self, steps: &[f64]) -> Option<usize> {
        let down = |&r: &usize| steps[r] > LEAST_PIVOT;
        let until = |r: usize| self.values[r].max(0.0) / steps[r];
        let rows = (0..steps.len()).filter(down).map(|r| (until(r), r));
        rows.min_by(|a, b| a.0.total_cmp(&b.0)).map(|r| r.1)
    }

    /// Puts a column in the place of another.
    fn pivot(&mut self, row: usize, column: usize, steps: &[f64]) {
        let m = self.right.len();
        let Column { cost, entries } = &self.columns[column];
        let excess = cost - entries.iter().map(|&(r, a)| self.prices[r] * a).sum::<f64>();
        let pivot = steps[row];
        let (before, rest) = self.inverse.split_at_mut(row * m);
        let (this, after) = rest.split_at_mut(m);
        this.iter_mut().for_each(|x| *x /= pivot);
        self.values[row] /= pivot;
        let others =
            before.chunks_exact_mut(m).zip(0..).chain(after.chunks_exact_mut(m).zip(row + 1..));
        for (other, r) in others.filter(|(_, r)| steps[*r] != 0.0) {
            other.iter_mut().zip(&*this).for_each(|(x, y)| *x -= steps[r] * y);
            self.values[r] -= steps[r] * self.values[row];
        }
        self.prices.iter_mut().zip(&*this).for_each(|(y, x)| *y += excess * x);
        self.is_basic[self.basis[row]] = false;
        self.is_basic[column] = true;
        self.basis[row] = column;
    }

    /// Makes the inverse, the values and the prices anew. False if the basis has none.
    fn refresh(&mut self) -> bool {
        let m = self.right.len();
        let wanted = std::mem::take(&mut self.basis);
        self.basis = (0..m).collect();
        self.prices = self.columns[..m].iter().map(|c| c.cost).collect();
        self.values.clone_from(&self.right);
        self.inverse.fill(0.0);
        (0..m).for_each(|r| self.inverse[r * m + r] = 1.0);
        let mut open: Vec<bool> = vec![true; m];
        // The first columns stay in their own rows.
        for &column in wanted.iter().filter(|&&c| c < m) {
            open[column] = false;
        }
        for &column in wanted.iter().filter(|&&c| c >= m) {
            let steps = self.steps(&self.columns[column].entries);
            let rows = (0..m).filter(|&r| open[r]);
            let Some(row) = rows.max_by(|&a, &b| steps[a].abs().total_cmp(&steps[b].abs())) else {
                return false;
            };
            if steps[row].abs() <= LEAST_PIVOT {
                return false;
            }
            open[row] = false;
            self.pivot(row, column, &steps);
        }
        self.is_basic.fill(false);
        self.basis.iter().for_each(|&c| self.is_basic[c] = true);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_can_be_done_by_hand() {
        // Least 3a + 2b with 2a + b = 8 and a + 3b = 9: only a = 3, b = 2.
        let mut simplex = Simplex::new(vec![8.0, 9.0], &[100.0, 100.0]);
        simplex.add(Column { cost: 3.0, entries: vec![(0, 2.0), (1, 1.0)] });
        simplex.add(Column { cost: 2.0, entries: vec![(0, 1.0), (1, 3.0)] });
        assert!(simplex.solve(&mut Work::default()));
        assert!((simplex.value() - 13.0).abs() < 1e-4);
        // 2y + z = 3 and y + 3z = 2.
        let [y, z] = [simplex.prices()[0], simplex.prices()[1]];
        assert!((y - 1.4).abs() < 1e-9 && (z - 0.2).abs() < 1e-9, "{y} {z}");
        let mut again = simplex.clone();
        assert!(again.refresh());
        assert!((again.value() - simplex.value()).abs() < 1e-9);
        assert!((again.prices()[0] - y).abs() < 1e-9);
    }

    #[test]
    fn work_has_an_end() {
        let mut simplex = Simplex::new(vec![8.0; 40], &[100.0; 40]);
        (0..40).for_each(|r| simplex.add(Column { cost: 1.0, entries: vec![(r, 1.0)] }));
        assert!(!simplex.clone().solve(&mut Work::of(40 * 1600 - 1)));
        assert!(simplex.solve(&mut Work::of(40 * 1600)));
    }
}
