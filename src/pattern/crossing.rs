//! How the rod of a unit crosses the edge of its tile (paper, section 3.1).
//!
//! A tile edge has a frame of its own: the origin in its middle, x along the edge
//! clockwise round the tile, y outwards; lengths in tile edges. A rod crosses at
//! (δ, 0) along (−sin φ, cos φ). With r the inradius of the tile, the unit's inner polygon
//! has the inradius r sin φ + δ cos φ, and the unit is counter-clockwise where that is
//! positive.

use super::{Join, Shape, Stick, UnitKind};
use nalgebra::{Point2, Vector2};
use std::f64::consts::PI;

/// Where and how a rod crosses the edge of its tile.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Crossing {
    /// δ, from the edge's middle along the edge.
    pub slide: f64,
    /// φ, against the edge's normal, radians.
    pub turn: f64,
}

impl Crossing {
    /// Where the rod crosses, in the frame of the edge.
    pub fn at(&self) -> Point2<f64> {
        Point2::new(self.slide, 0.0)
    }

    /// Unit direction out of the tile, in the frame of the edge.
    pub fn outward(&self) -> Vector2<f64> {
        Vector2::new(-self.turn.sin(), self.turn.cos())
    }

    /// The same in the mirror.
    fn mirrored(self) -> Self {
        Self { slide: -self.slide, turn: -self.turn }
    }
}

/// Inradius of a regular tile of this many sides, tile edges.
pub fn inradius(sides: usize) -> f64 {
    0.5 / (PI / sides as f64).tan()
}

impl UnitKind {
    /// How the unit's rods cross the edges of its tile, seen from it. `even` is the colour
    /// of the tile where those that share an edge differ in colour: shared rods slide the
    /// one way seen from even tiles, the other way seen from the others.
    pub fn crossing(&self, join: Join, shape: Shape, even: bool) -> Crossing {
        if join == Join::Shared && self.outer.is_empty() {
            let slide = if even { shape.slide } else { -shape.slide };
            return Crossing { slide, turn: shape.turn };
        }
        let own = match self.outer.first() {
            Some(stick) => drawn(stick, self.sides),
            None => self.own(shape),
        };
        if self.mirrored { own.mirrored() } else { own }
    }

    /// The crossing of rods that the unit does not share. A radius that is k of the
    /// tile's inradius r asks for r sin φ + δ cos φ = ±k r, with the sign of the turn.
    fn own(&self, Shape { turn, slide }: Shape) -> Crossing {
        let Some(k) = self.radius else { return Crossing { slide, turn } };
        let r = inradius(self.sides);
        let away = (k * r).copysign(turn);
        let turn = (away / r.hypot(slide)).asin() - slide.atan2(r);
        Crossing { slide, turn }
    }

    /// How far in from the edge outer rods that are drawn by hand end, tile edges; `None`
    /// for those of a circuit.
    pub fn stop(&self) -> Option<f64> {
        let [_, inner] = self.outer.first()?;
        let at = drawn(self.outer.first()?, self.sides).slide;
        Some((inner - Point2::new(inradius(self.sides), -at)).norm())
    }

    /// The inner rods, as they lie when the tile is not turned.
    pub fn inner_rods(&self) -> impl Iterator<Item = Stick> + '_ {
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        self.inner.iter().map(move |stick| stick.map(|p| Point2::new(p.x, sign * p.y)))
    }
}

/// The crossing of a rod that is drawn from its outer to its inner end. The first edge is
/// the line x = r, its frame's axes are −y and x.
fn drawn([outer, inner]: &Stick, sides: usize) -> Crossing {
    let out = (outer - inner).normalize();
    let ahead = (inradius(sides) - inner.x) / out.x;
    Crossing { slide: -(inner.y + out.y * ahead), turn: out.y.atan2(out.x) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn kind(sides: usize, radius: Option<f64>) -> UnitKind {
        let (outer, inner) = (Vec::new(), Vec::new());
        UnitKind { name: "k".into(), sides, mirrored: false, radius, outer, inner }
    }

    /// Distance of a rod from the middle of its tile, positive counter-clockwise.
    fn away(crossing: Crossing, sides: usize) -> f64 {
        let middle = Point2::new(0.0, -inradius(sides));
        (crossing.at() - middle).perp(&crossing.outward())
    }

    proptest! {
        #[test]
        fn rods_lie_at_the_distance_of_the_formula(
            sides in 3usize..=12, turn in -0.7..0.7f64, slide in -0.3..0.3f64,
        ) {
            let shape = Shape { turn, slide };
            let r = inradius(sides);
            let formula = r * turn.sin() + slide * turn.cos();
            let seen = kind(sides, None).crossing(Join::Shared, shape, true);
            prop_assert!((away(seen, sides) - formula).abs() < 1e-12);
            // From the tile on the other side the same rod slides the other way.
            let other = kind(sides, None).crossing(Join::Shared, shape, false);
            let formula = r * turn.sin() - slide * turn.cos();
            prop_assert!((away(other, sides) - formula).abs() < 1e-12);
        }

        #[test]
        fn a_radius_is_kept_whatever_the_slide(
            sides in 3usize..=12, k in 0.05..0.8f64, slide in -0.3..0.3f64,
        ) {
            for turn in [-1.0, 1.0] {
                let own = kind(sides, Some(k)).crossing(Join::End, Shape { turn, slide }, true);
                let wanted = turn * k * inradius(sides);
                prop_assert!((away(own, sides) - wanted).abs() < 1e-12);
                prop_assert_eq!(own.slide, slide);
            }
        }

        #[test]
        fn drawn_rods_are_found_again(
            sides in 3usize..=12, turn in -0.7..0.7f64, slide in -0.3..0.3f64, long in 0.1..0.4f64,
        ) {
            // From the frame of the edge to that of the unit.
            let crossing = Crossing { slide, turn };
            let place = |p: Point2<f64>| Point2::new(inradius(sides) + p.y, -p.x);
            let [out, inn] = [long, -long].map(|s| place(crossing.at() + crossing.outward() * s));
            let drawn = UnitKind { outer: vec![[out, inn]], ..kind(sides, None) };
            let found = drawn.crossing(Join::End, Shape { turn: 0.0, slide: 0.0 }, true);
            prop_assert!((found.slide - slide).abs() < 1e-12 && (found.turn - turn).abs() < 1e-12);
            prop_assert!((drawn.stop().unwrap() - long).abs() < 1e-12);
            let mirrored = UnitKind { mirrored: true, ..drawn };
            let seen = mirrored.crossing(Join::End, Shape { turn: 0.0, slide: 0.0 }, true);
            prop_assert_eq!(seen, found.mirrored());
        }
    }
}
