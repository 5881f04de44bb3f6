//! The linear model of a frame that is put together mark on mark.

use super::Errors;
use crate::frame::axis::Axis;
use crate::frame::close::across::Across;
use crate::frame::close::equations::{Move, pair};
use crate::frame::close::touch::Touch;
use crate::frame::gaps::{Joint, Row, rows};
use crate::frame::{ContactKind, End, Frame};
use crate::ids::{ContactId, Id, IdVec, RodId};
use crate::linalg::{BlockSolver, LinalgError, LowerPattern};
use crate::surface::Vector3;
use nalgebra::{Matrix2, SVector, Vector2};

/// The ways in which a stick moves: two across at each end, and along itself.
const WAYS: usize = Across::WAYS + 1;

/// A gradient by these ways.
type Ways = SVector<f64, WAYS>;

/// A gap that is open counts so many times a mark that is off. More, and digits are lost; less,
/// and sticks do not touch.
const FIRM: f64 = 1e6;

/// A move of a rod end counts so much of a mark that is off by as much. More, and rods are held
/// where they were planned; less, and a flat frame, whose sticks rise and sink without any mark
/// being off, moves farther than a linear model holds.
const STAY: f64 = 1e-4;

/// An equation: gradients by rod, and what is wanted.
#[derive(Clone, Debug)]
struct Equation {
    parts: Vec<(RodId, Ways)>,
    wanted: Wanted,
}

/// What an equation wants, by the errors.
#[derive(Clone, Copy, Debug)]
enum Wanted {
    /// A contact at its mark on the over rod (0) or the under rod (1).
    Mark(ContactId, usize),
    /// A contact as wide as its rods are thick.
    Gap(ContactId),
    /// Two ends together, along an axis of space: the shares of the errors of both lengths.
    Ends(ContactId, [f64; 2]),
    /// The foot of a rod on the ground.
    Foot,
}

impl Wanted {
    fn weight(self) -> f64 {
        match self {
            Self::Mark(..) | Self::Ends(..) => 1.0,
            Self::Gap(_) | Self::Foot => FIRM,
        }
    }

    fn value(self, errors: &Errors) -> f64 {
        match self {
            Self::Mark(contact, side) => errors.marks[contact][side],
            Self::Gap(contact) => errors.gaps[contact],
            Self::Ends(contact, [over, under]) => {
                let [e, f] = errors.marks[contact];
                over * e + under * f
            }
            Self::Foot => 0.0,
        }
    }
}

/// The equations of a frame, and their normal matrix, factored.
pub struct Model {
    equations: Vec<Equation>,
    /// The equations of each contact's two marks.
    marks: IdVec<ContactId, Option<[usize; 2]>>,
    /// Directions of the over and the under rod of each contact.
    along: IdVec<ContactId, [Vector3; 2]>,
    solver: BlockSolver<WAYS>,
    rods: usize,
}

impl Model {
    /// That of a frame.
    ///
    /// # Errors
    /// [`LinalgError`] where a contact's rods are parallel or memory does not suffice.
    pub fn new(frame: &Frame) -> Result<Self, LinalgError> {
        let axes: IdVec<RodId, Axis> = frame.rods.iter().map(|rod| rod.axis).collect();
        let joints = frame.joints();
        let parallel = LinalgError::NotPositiveDefinite { row: 0, size: axes.len() };
        let gaps = rows(&axes, &joints).map_err(|_| parallel.clone())?;
        let mut all = Equations { axes: &axes, list: Vec::new() };
        let mut marks: IdVec<ContactId, Option<[usize; 2]>> = vec![None; joints.len()].into();
        for row in &gaps {
            all.add_gap(row, &joints[row.contact]);
        }
        for (id, joint) in joints.enumerate().filter(|(_, j)| j.kind == ContactKind::Cross) {
            let touch = Touch::new(&axes, joint).ok_or_else(|| parallel.clone())?;
            marks[id] = Some([0, 1].map(|side| all.add_mark(id, &touch, side)));
        }
        for support in &frame.supports {
            all.add_foot(support.rod, support.end);
        }
        let equations = all.list;
        let solver = factored(axes.len(), &equations)?;
        let directions = |j: &Joint| [j.over, j.under].map(|rod| axes[rod].direction());
        let along = joints.iter().map(directions).collect();
        Ok(Self { equations, marks, along, solver, rods: axes.len() })
    }

    /// The moves of all rods when the frame is put together with errors.
    pub fn put_together(&mut self, errors: &Errors) -> Vec<f64> {
        let mut moves = vec![0.0; WAYS * self.rods];
        for equation in &self.equations {
            let pull = equation.wanted.weight() * equation.wanted.value(errors);
            add(&mut moves, equation, pull);
        }
        self.solver.solve(&mut moves);
        moves
    }

    /// How far a contact's two marks are from it along their rods, mm; nothing where ends meet.
    pub fn off_marks(
        &self,
        contact: ContactId,
        errors: &Errors,
        moves: &[f64],
    ) -> Option<Vector2<f64>> {
        let off = |row: usize| {
            let equation = &self.equations[row];
            equation.wanted.value(errors) - dot(equation, moves)
        };
        let [over, under] = self.marks[contact]?;
        Some(Vector2::new(off(over), off(under)))
    }

    /// A contact that is made last, its marks pulling `by_hand` as much as the others.
    pub fn last(&mut self, contact: ContactId, by_hand: f64) -> Last {
        let free = Last { contact, set_free: Matrix2::identity() };
        let Some(marks) = self.marks[contact] else { return free };
        // H = M A⁻¹ Mᵀ: how much the two marks themselves say about where the contact lies.
        let mut own = Matrix2::zeros();
        for (column, &row) in marks.iter().enumerate() {
            let mut moves = vec![0.0; WAYS * self.rods];
            add(&mut moves, &self.equations[row], 1.0);
            self.solver.solve(&mut moves);
            for (line, &other) in marks.iter().enumerate() {
                own[(line, column)] = dot(&self.equations[other], &moves);
            }
        }
        let left = Matrix2::identity() - own * (1.0 - by_hand);
        Last { set_free: left.try_inverse().unwrap_or(free.set_free), ..free }
    }
}

/// A contact that is made last.
pub struct Last {
    contact: ContactId,
    /// (I − (1 − κ) H)⁻¹: makes what is left of its marks when they pull as much as all others
    /// into what is left when they pull κ times that (as of deleted residuals: Cook and
    /// Weisberg, *Residuals and Influence in Regression*, 1982, 2.2).
    set_free: Matrix2<f64>,
}

impl Last {
    /// How far the two marks are apart, mm.
    pub fn off(&self, model: &Model, errors: &Errors, moves: &[f64]) -> f64 {
        let Some(tied) = model.off_marks(self.contact, errors, moves) else { return 0.0 };
        let off = self.set_free * tied;
        let [u, v] = model.along[self.contact];
        (u * off.x - v * off.y).norm()
    }
}

/// Equations while they are collected.
struct Equations<'a> {
    axes: &'a IdVec<RodId, Axis>,
    list: Vec<Equation>,
}

impl Equations<'_> {
    /// A gradient by the ends as one by the ways.
    fn ways(&self, rod: RodId, part: &Move) -> Ways {
        let axis = &self.axes[rod];
        let (u, across) = (axis.direction(), Across::new(axis).of(part));
        let along = part.fixed_rows::<3>(0).dot(&u) + part.fixed_rows::<3>(3).dot(&u);
        Ways::new(across[0], across[1], across[2], across[3], along)
    }

    fn push(&mut self, parts: &[(RodId, Move)], wanted: Wanted) -> usize {
        let parts = parts.iter().map(|(rod, part)| (*rod, self.ways(*rod, part))).collect();
        self.list.push(Equation { parts, wanted });
        self.list.len() - 1
    }

    /// A gap; of ends that meet, how far they are apart along an axis of space. End B is as far
    /// off along its rod as it was sawn wrong.
    fn add_gap(&mut self, row: &Row, joint: &Joint) {
        let parts = [(row.rods[0], true), (row.rods[1], false)].map(|(rod, over)| {
            let at = row.at_rod(over);
            (rod, pair(at.normal * at.at_a, at.normal * at.at_b))
        });
        let wanted = match joint.kind {
            ContactKind::Cross => Wanted::Gap(row.contact),
            ContactKind::End(ends) => {
                let longer = |side: usize| match ends[side] {
                    End::A => 0.0,
                    End::B => self.axes[row.rods[side]].direction().dot(&row.across),
                };
                Wanted::Ends(row.contact, [-longer(0), longer(1)])
            }
        };
        self.push(&parts, wanted);
    }

    /// The place of a contact along one of its rods, mm.
    fn add_mark(&mut self, contact: ContactId, touch: &Touch, side: usize) -> usize {
        let length = self.axes[touch.rods[side]].length();
        let parts = [0, 1].map(|by| (touch.rods[by], touch.slide[side][by] * length));
        self.push(&parts, Wanted::Mark(contact, side))
    }

    /// The height of a foot.
    fn add_foot(&mut self, rod: RodId, end: End) {
        let (up, none) = (Vector3::z(), Vector3::zeros());
        let part = if end == End::A { pair(up, none) } else { pair(none, up) };
        self.push(&[(rod, part)], Wanted::Foot);
    }
}

/// The normal matrix of the equations, factored.
fn factored(rods: usize, equations: &[Equation]) -> Result<BlockSolver<WAYS>, LinalgError> {
    let pairs = equations.iter().filter_map(|e| match e.parts[..] {
        [(p, _), (q, _)] => Some((p.index(), q.index())),
        _ => None,
    });
    let mut solver = BlockSolver::new(LowerPattern::new(rods, pairs)?)?;
    let own = nalgebra::SMatrix::<f64, WAYS, WAYS>::identity() * STAY;
    (0..rods).for_each(|rod| solver.add(rod, rod, &own));
    for Equation { parts, wanted } in equations {
        for (i, (rod, part)) in parts.iter().enumerate() {
            for (other, with) in &parts[..=i] {
                let block = part * with.transpose() * wanted.weight();
                solver.add(rod.index(), other.index(), &block);
            }
        }
    }
    solver.factor()?;
    Ok(solver)
}

/// Adds the gradient of an equation times a factor.
fn add(moves: &mut [f64], equation: &Equation, factor: f64) {
    for (rod, part) in &equation.parts {
        let own = &mut moves[WAYS * rod.index()..][..WAYS];
        own.iter_mut().zip(part.iter()).for_each(|(to, p)| *to += p * factor);
    }
}

/// By how much an equation changes with moves.
fn dot(equation: &Equation, moves: &[f64]) -> f64 {
    let of = |(rod, part): &(RodId, Ways)| {
        let own = &moves[WAYS * rod.index()..][..WAYS];
        own.iter().zip(part.iter()).map(|(m, p)| m * p).sum::<f64>()
    };
    equation.parts.iter().map(of).sum()
}
