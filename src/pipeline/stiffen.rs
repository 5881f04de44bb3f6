//! Form finding by the statics (named as future work in the paper): the turn and the slide of
//! the rods and the size of the units are changed, a step at a time, as long as the frame is
//! stressed less or moves less under the loads that are given.
//!
//! A compass search: each of the three goes up and down by a step; what is better is kept, and
//! where nothing is, the steps are halved. Frames in which more units fail, or whose units the
//! rods do not fit, are passed over.

use super::{Model, SUITING, planned, studied};
use crate::design::{Design, Tiles};
use crate::pattern::Shape;
use crate::statics::goal::Goal;
use crate::statics::wish::{LoadError, Wish};

/// What the search came to.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stiffened {
    /// What was to become small.
    pub goal: Goal,
    /// The frame as it was.
    pub before: Tried,
    /// The frame that was found.
    pub after: Tried,
    /// How many frames were tried.
    pub tried: usize,
}

/// A frame that was tried.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tried {
    /// Turn of the rods, radians.
    pub turn: f64,
    /// Slide of the rods, in tile edges.
    pub slide: f64,
    /// Tile edge, mm.
    pub edge: f64,
    /// How many rods it has.
    pub rods: usize,
    /// What was to become small.
    pub value: f64,
}

/// The first steps: turn in radians, slide in tile edges, tile edge as a factor.
const STEPS: [f64; 3] = [0.07, 0.04, 0.08];
/// How often the steps are halved.
const HALVINGS: usize = 3;
/// How many frames are tried at most.
const MOST: usize = 80;
/// What is better by less is none.
const BETTER: f64 = 1e-3;

/// A frame that can be built, and what it is worth.
struct Found {
    design: Design,
    model: Model,
    tried: Tried,
}

/// Looks for a frame that is stressed less or moves less than `first`, which `design` makes.
/// Without one, or where `first` does not stand, it is `first` that comes back. It has its stresses.
///
/// # Errors
/// [`LoadError`] when a load acts on no rod of `first`.
pub fn stiffened(
    design: &Design,
    goal: Goal,
    wish: &Wish,
    mut first: Model,
) -> Result<Model, LoadError> {
    let found = studied(&first, wish)?;
    let value = found.as_ref().ok().map(|study| goal.of(study));
    first.statics = Some(found);
    let Some(value) = value else { return Ok(first) };
    let before = tried(design, &first, value);
    let dropped = first.formed.frame.dropped.len();
    let mut best = Found { design: design.clone(), model: first, tried: before };
    let mut count = 0;
    let mut step = 1.0;
    for _ in 0..=HALVINGS {
        loop {
            let mut better = false;
            for way in ways(&design.tiles) {
                let next = changed(&best, way.map(|w| w * step));
                if count == MOST {
                    break;
                }
                count += 1;
                let Some(found) = next.and_then(|next| attempt(next, goal, wish, dropped)) else {
                    continue;
                };
                if found.tried.value < best.tried.value * (1.0 - BETTER) {
                    (best, better) = (found, true);
                }
            }
            if !better || count == MOST {
                break;
            }
        }
        step /= 2.0;
    }
    let stiffened = Stiffened { goal, before, after: best.tried, tried: count };
    Ok(Model { stiffened: Some(stiffened), ..best.model })
}

fn tried(design: &Design, model: &Model, value: f64) -> Tried {
    let Model { fit, formed, .. } = model;
    let rods = formed.frame.rods.len();
    Tried { turn: fit.turn, slide: design.slide, edge: fit.edge, rods, value }
}

/// The steps that are tried: turn, slide, tile edge. Only patterns have a size of their own.
fn ways(tiles: &Tiles) -> Vec<[f64; 3]> {
    let [turn, slide, edge] = STEPS;
    let mut ways = vec![[turn, 0.0, 0.0], [-turn, 0.0, 0.0], [0.0, slide, 0.0], [0.0, -slide, 0.0]];
    if matches!(tiles, Tiles::Pattern(_)) {
        ways.extend([[0.0, 0.0, edge], [0.0, 0.0, -edge]]);
    }
    ways
}

/// The design of a frame a step further; none where its pattern does not allow that.
fn changed(from: &Found, [turn, slide, edge]: [f64; 3]) -> Option<Design> {
    let Tried { turn: was, edge: size, .. } = from.tried;
    let mut design = from.design.clone();
    design.turn = Some(was + turn);
    design.slide += slide;
    if let Tiles::Pattern(pattern) = &design.tiles {
        pattern.check(Shape { turn: was + turn, slide: design.slide }).ok()?;
        design.unit = Some(size * (1.0 + edge));
    }
    Some(design)
}

/// The frame of a design with its worth, if it can be built, fits its rods and stands.
fn attempt(design: Design, goal: Goal, wish: &Wish, most_dropped: usize) -> Option<Found> {
    let model = planned(&design, &mut |_| {}).ok()?;
    let Model { fit, formed, .. } = &model;
    let fits =
        fit.is_flat(design.rod) || (1.0 / SUITING..=SUITING).contains(&(fit.rise / design.rod));
    if formed.frame.dropped.len() > most_dropped || !fits {
        return None;
    }
    let study = studied(&model, wish).ok()?.ok()?;
    let tried = tried(&design, &model, goal.of(&study));
    Some(Found { design, model: Model { statics: Some(Ok(study)), ..model }, tried })
}
