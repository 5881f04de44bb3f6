//! A part cut from flat board.

use super::offset::offset;
use super::ring::{bounds, rectangle};

/// A place on a board, mm; y up, seen from the marked side.
pub type Point = [f64; 2];

/// A line on a board.
#[derive(Clone, PartialEq, Debug)]
pub enum Curve {
    /// Straight pieces from point to point. Of a cut, the last point is joined to the first.
    Path(Vec<Point>),
    /// A circle.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
}

/// A part cut from flat board.
#[derive(Clone, PartialEq, Debug)]
pub struct Board {
    /// What it is, as error messages name it.
    pub name: String,
    /// The outer cut: a ring of corners, the last one joined to the first.
    pub outline: Vec<Point>,
    /// Inner cuts.
    pub holes: Vec<Curve>,
    /// Lines that are only scored: numbers, ticks.
    pub scores: Vec<Curve>,
    /// Areas that are engraved: rings.
    pub engraved: Vec<Vec<Point>>,
    /// Whether the laser is to follow the lines as they are, whatever it takes away.
    pub exact: bool,
}

impl Board {
    /// A plain board.
    pub fn new(name: impl Into<String>, outline: Vec<Point>) -> Self {
        Self {
            name: name.into(),
            outline,
            holes: Vec::new(),
            scores: Vec::new(),
            engraved: Vec::new(),
            exact: false,
        }
    }

    /// A plain rectangle from the origin.
    pub fn rectangle(name: impl Into<String>, [w, h]: [f64; 2]) -> Self {
        Self::new(name, rectangle([0.0; 2], [w, h]))
    }

    /// Scores lines.
    pub fn score(&mut self, paths: impl IntoIterator<Item = Vec<Point>>) {
        self.scores.extend(paths.into_iter().map(Curve::Path));
    }

    /// The board as the laser has to follow it where it takes away `kerf`: the outline moved
    /// out by half of it, holes moved in. `None` where a detail is finer than that.
    pub fn compensated(&self, kerf: f64) -> Option<Self> {
        if self.exact || kerf == 0.0 {
            return Some(self.clone());
        }
        let inward = |hole: &Curve| match hole {
            Curve::Path(ring) => offset(ring, -kerf / 2.0).map(Curve::Path),
            &Curve::Circle { center, radius } => {
                let radius = radius - kerf / 2.0;
                (radius > 0.0).then_some(Curve::Circle { center, radius })
            }
        };
        Some(Self {
            outline: offset(&self.outline, kerf / 2.0)?,
            holes: self.holes.iter().map(inward).collect::<Option<_>>()?,
            ..self.clone()
        })
    }

    /// Lower left and upper right corner of the box round the outline.
    pub fn bounds(&self) -> [Point; 2] {
        bounds(&self.outline)
    }

    /// Width and height of that box.
    pub fn size(&self) -> [f64; 2] {
        let [lo, hi] = self.bounds();
        [hi[0] - lo[0], hi[1] - lo[1]]
    }

    /// The board moved, and turned a quarter to the left before if `turned`, so that the lower
    /// left corner of its box comes to lie at `corner`.
    pub fn placed(&self, corner: Point, turned: bool) -> Self {
        let turn = |[x, y]: Point| if turned { [-y, x] } else { [x, y] };
        let board = self.mapped(&turn);
        let [lo, _] = board.bounds();
        board.mapped(&|[x, y]| [x - lo[0] + corner[0], y - lo[1] + corner[1]])
    }

    /// The board with all points moved; distances must stay as they are.
    fn mapped(&self, to: &dyn Fn(Point) -> Point) -> Self {
        let path = |points: &Vec<Point>| points.iter().map(|&p| to(p)).collect::<Vec<_>>();
        let curve = |curve: &Curve| match curve {
            Curve::Path(points) => Curve::Path(path(points)),
            &Curve::Circle { center, radius } => Curve::Circle { center: to(center), radius },
        };
        Self {
            name: self.name.clone(),
            outline: path(&self.outline),
            holes: self.holes.iter().map(curve).collect(),
            scores: self.scores.iter().map(curve).collect(),
            engraved: self.engraved.iter().map(path).collect(),
            exact: self.exact,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::area;
    use super::*;

    #[test]
    fn outlines_grow_and_holes_shrink_by_half_the_cut() {
        let mut board = Board::rectangle("test", [30.0, 20.0]);
        board.holes.push(Curve::Path(rectangle([5.0, 5.0], [10.0, 3.0])));
        board.holes.push(Curve::Circle { center: [22.0, 10.0], radius: 4.0 });
        let cut = board.compensated(0.2).unwrap();
        assert!((area(&cut.outline) - 30.2 * 20.2).abs() < 1e-9);
        let [Curve::Path(slot), Curve::Circle { radius, .. }] = &cut.holes[..] else {
            panic!("the holes are kept")
        };
        assert!((area(slot) - 9.8 * 2.8).abs() < 1e-9);
        assert!((radius - 3.9).abs() < 1e-12);
        assert_eq!(board.compensated(0.0).unwrap(), board);
        board.exact = true;
        assert_eq!(board.compensated(0.2).unwrap(), board);
    }

    #[test]
    fn a_quarter_turn_does_not_mirror() {
        let board = Board::new("test", vec![[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 2.0]]);
        let turned = board.placed([10.0, 20.0], true);
        assert_eq!(turned.bounds(), [[10.0, 20.0], [12.0, 24.0]]);
        assert_eq!(area(&turned.outline), area(&board.outline));
        assert_eq!(turned.outline[2], [11.0, 24.0]);
    }
}
