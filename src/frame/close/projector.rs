//! The least moves that meet linear equations: with J the gradients, the least move with
//! J dx = r is dx = Jᵀ (J Jᵀ)⁻¹ r.

use super::equations::{Equations, Move, Moves};
use crate::frame::axis::Axis;
use crate::ids::{IdVec, RodId};
use crate::linalg::{LinalgError, SpdSolver, block_entries};
use crate::surface::{Point3, Vector3};

/// A part of a row, by its rod.
#[derive(Clone, Copy)]
struct Meeting {
    row: u32,
    part: u32,
}

/// J Jᵀ + S, factored, with S a diagonal.
pub struct Projector {
    solver: SpdSolver,
    /// What meets at each rod.
    around: IdVec<RodId, Vec<Meeting>>,
    /// The rods of all parts.
    rods: Vec<RodId>,
    values: Vec<f64>,
    rows: usize,
}

impl Projector {
    /// Analyses equations in the moves of these axes.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    fn new(axes: &IdVec<RodId, Axis>, equations: &Equations) -> Result<Self, LinalgError> {
        let mut around: IdVec<RodId, Vec<Meeting>> = vec![Vec::with_capacity(4); axes.len()].into();
        let rows = equations.len();
        for row in 0..rows {
            for part in equations.range(row) {
                let (rod, _) = equations.parts()[part];
                around[rod].push(Meeting { row: row as u32, part: part as u32 });
            }
        }
        let mut entries = Vec::new();
        for at in &around {
            let row = |i: usize| at[i].row as usize;
            entries.extend(block_entries(at.len()).map(|(i, j)| (row(i), row(j))));
        }
        entries.extend((0..rows).map(|row| (row, row)));
        let values = Vec::with_capacity(entries.len());
        let rods = equations.parts().iter().map(|part| part.0).collect();
        let places: Vec<Point3> = (0..rows).map(|row| place(axes, equations, row)).collect();
        Ok(Self { solver: SpdSolver::placed(&entries, &places)?, around, rods, values, rows })
    }

    /// The projector in `slot`, and whether it was made anew because there was none or it was
    /// for other equations.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] when memory does not suffice.
    pub fn for_equations<'a>(
        slot: &'a mut Option<Self>,
        axes: &IdVec<RodId, Axis>,
        equations: &Equations,
    ) -> Result<(&'a mut Self, bool), LinalgError> {
        match slot.take().filter(|known| known.suits(equations)) {
            Some(known) => Ok((slot.insert(known), false)),
            None => Ok((slot.insert(Self::new(axes, equations)?), true)),
        }
    }

    /// Whether these equations look at the same rods as those that were analysed.
    fn suits(&self, equations: &Equations) -> bool {
        self.rods.len() == equations.parts().len()
            && self.rows == equations.len()
            && self.rods.iter().zip(equations.parts()).all(|(rod, part)| *rod == part.0)
    }

    /// Factors J Jᵀ + S; `shift` gives the diagonal of S by row.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] where equations contradict each other or
    /// say the same.
    ///
    /// # Panics
    /// When the equations have other rods than those that were analysed.
    pub fn factor(
        &mut self,
        equations: &Equations,
        shift: impl Fn(usize) -> f64,
    ) -> Result<(), LinalgError> {
        assert_eq!(self.rows, equations.len(), "the equations that were analysed");
        let parts = equations.parts();
        self.values.clear();
        for at in &self.around {
            let part = |i: usize| &parts[at[i].part as usize].1;
            self.values.extend(block_entries(at.len()).map(|(i, j)| part(i).dot(part(j))));
        }
        self.values.extend((0..self.rows).map(shift));
        self.solver.factor(&self.values)
    }

    /// Takes away what of some moves changes the equations, so that J dx = 0.
    pub fn keep_contacts(&mut self, equations: &Equations, moves: &mut Moves) {
        let mut pull = equations.changes(moves);
        self.solver.solve(&mut pull);
        equations.pull(&pull, -1.0, moves);
    }

    /// The least moves, and (J Jᵀ + S)⁻¹ r: the pull of each row.
    pub fn least_moves(&mut self, equations: &Equations) -> (Moves, Vec<f64>) {
        let mut pull = equations.lacking.clone();
        self.solver.solve(&mut pull);
        let mut moves: Moves = vec![Move::zeros(); self.around.len()].into();
        equations.pull(&pull, 1.0, &mut moves);
        (moves, pull)
    }
}

/// Where an equation lies: amid its rods.
fn place(axes: &IdVec<RodId, Axis>, equations: &Equations, row: usize) -> Point3 {
    let parts = &equations.parts()[equations.range(row)];
    let middles = parts.iter().map(|(rod, _)| nalgebra::center(&axes[*rod].a, &axes[*rod].b));
    Point3::from(middles.map(|p| p.coords).sum::<Vector3>() / parts.len() as f64)
}
