//! Whether turn and slide suit a pattern: within what is safe, and such that rods that
//! should join do.

use super::crossing::inradius;
use super::{Figure, Guest, Join, Line, Member, Pattern, Rule, Shape, UnitKind, Unmet};
use nalgebra::{Point2, Vector2};
use std::f64::consts::TAU;
use thiserror::Error;

/// What is wrong with a turn or a slide. Angles in degrees.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum ShapeError {
    /// The turn is not safe.
    #[error("turn = {turn:.4}deg: the pattern {pattern} {}", turns(safe))]
    Turn { pattern: String, turn: f64, safe: [f64; 2] },
    /// The slide is not safe.
    #[error("slide = {slide}: the pattern {pattern} {}", slides(safe))]
    Slide { pattern: String, slide: f64, safe: [f64; 2] },
    /// Turn and slide are each safe, but not together.
    #[error(
        "turn = {turn:.4}deg with slide = {slide}: the mirror image of the pattern {pattern} has \
         both of the other sign; change the sign of one of them"
    )]
    Signs { pattern: String, turn: f64, slide: f64 },
    /// The hole of a unit closes.
    #[error(
        "turn = {turn:.4}deg with slide = {slide}: the holes of every {unit} would be {side:.3} \
         tile edges a side, and rods need {LEAST_SIDE} to pass. Try a larger turn, or another slide"
    )]
    Hole { turn: f64, slide: f64, unit: String, side: f64 },
    /// Shared rods slide only where tiles alternate.
    #[error(
        "slide = {slide}: shared rods slide where tiles alternate like the fields of a chessboard; \
         round some corner of {tiling} there is an odd number of them. Leave --slide out"
    )]
    Alternate { slide: f64, tiling: &'static str },
    /// Ends that should meet do not.
    #[error(
        "slide = {slide}: the ends of the rods of {units} would be {apart:.3} tile edges apart. \
         They meet at slide 0, or where one of the two units is the mirror image of the other"
    )]
    Ends { slide: f64, units: String, apart: f64 },
    /// Rods that should be one are two.
    #[error(
        "{units} share a rod, but the two draw it differently: {apart:.3} tile edges and {angle:.1} \
         degrees apart"
    )]
    Shared { units: String, apart: f64, angle: f64 },
    /// A rod that should rest on a neighbour's misses it.
    #[error(
        "turn = {turn:.4}deg with slide = {slide}: a rod that goes across the edge from {from} into \
         {into} does not come to rest on one of its rods{}", instead_of(*.instead)
    )]
    Rest { turn: f64, slide: f64, from: String, into: String, instead: Option<f64> },
    /// A rod that touches too few others within its unit.
    #[error(
        "unit \"{unit}\": {rod} touches {} within the unit, and needs two to be held. Draw it \
         across more of them", counted(*.contacts)
    )]
    Loose { unit: String, rod: String, contacts: usize },
    /// The outer rods make no circuit.
    #[error("turn = {turn:.4}deg with slide = {slide}: the rods of {unit} run round in no circuit")]
    Circuit { turn: f64, slide: f64, unit: String },
}

fn counted(contacts: usize) -> &'static str {
    if contacts == 0 { "no other rod" } else { "one other rod" }
}

fn turns([least, most]: &[f64; 2]) -> String {
    if least == most {
        "stays as it is: its units have a radius of their own, or are drawn by hand. Leave --turn \
         out"
        .into()
    } else {
        format!("holds together between {least} and {most} degrees, either way round")
    }
}

fn slides([least, most]: &[f64; 2]) -> String {
    if least == most {
        "stays as it is: its rods do not slide. Leave --slide out".into()
    } else {
        format!("holds together between {least} and {most} tile edges")
    }
}

fn instead_of(slide: Option<f64>) -> String {
    match slide {
        Some(slide) => format!(". With --slide {slide:.2} it would"),
        None => ". No slide would help; try another turn (--turn)".into(),
    }
}

/// Points and lines that should be the same are no farther apart, tile edges: what a
/// person writes in six digits.
const SAME: f64 = 1e-5;

/// Least side of a unit's hole, tile edges: at a usual fit two rods wide.
const LEAST_SIDE: f64 = 0.1;

/// Least distance of two rods that lie side by side, tile edges: at a usual fit a rod's
/// diameter.
const LEAST_APART: f64 = 0.05;

/// Steps and bounds in which another slide is looked for, tile edges.
const SLIDE_STEP: f64 = 0.01;
const MOST_SLIDE: f64 = 0.45;

impl Pattern {
    /// Whether rods of this shape join as the rules say, and keep clear of each other.
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn check(&self, shape: Shape) -> Result<(), ShapeError> {
        self.check_range(shape)?;
        let Shape { turn, slide } = shape;
        let shared = self.rules.iter().any(|r| r.join == Join::Shared);
        if slide != 0.0 && shared && !self.alternates() {
            return Err(ShapeError::Alternate { slide, tiling: self.tiling.name });
        }
        for rule in &self.rules {
            match self.check_rule(rule, shape) {
                Err(ShapeError::Rest { from, into, .. }) => {
                    let turn = turn.to_degrees();
                    let instead = self.other_slide(shape);
                    return Err(ShapeError::Rest { turn, slide, from, into, instead });
                }
                done => done?,
            }
        }
        Ok(())
    }

    fn check_range(&self, shape: Shape) -> Result<(), ShapeError> {
        let (turn, slide) = (shape.turn.to_degrees(), shape.slide);
        let within = |[least, most]: [f64; 2], x: f64| least - SAME <= x && x <= most + SAME;
        let both = |sign: f64| {
            within(self.turn.safe, sign * turn) && within(self.slide.safe, sign * slide)
        };
        if both(1.0) || both(-1.0) {
            return Ok(());
        }
        let pattern = self.name.clone();
        if !within(self.turn.safe, turn) && !within(self.turn.safe, -turn) {
            let safe = self.turn.safe;
            return Err(ShapeError::Turn { pattern, turn, safe });
        }
        if !within(self.slide.safe, slide) && !within(self.slide.safe, -slide) {
            let safe = self.slide.safe;
            return Err(ShapeError::Slide { pattern, slide, safe });
        }
        Err(ShapeError::Signs { pattern, turn, slide })
    }

    /// The slide nearest to the one given at which all rods that rest do.
    fn other_slide(&self, shape: Shape) -> Option<f64> {
        let fits = |slide: f64| {
            let shape = Shape { slide, ..shape };
            slide.abs() <= MOST_SLIDE
                && self.rules.iter().all(|r| self.check_rule(r, shape).is_ok())
        };
        let steps = (2.0 * MOST_SLIDE / SLIDE_STEP) as i32;
        let near = (shape.slide / SLIDE_STEP).round() as i32;
        let candidates = (0..=steps).flat_map(|k| [near + k, near - k]);
        candidates.map(|k| f64::from(k) * SLIDE_STEP).find(|&slide| fits(slide))
    }

    /// Lays the two units of a rule side by side and joins their rods.
    fn check_rule(&self, rule: &Rule, shape: Shape) -> Result<(), ShapeError> {
        let [a, b] = rule.slots.map(|slot| &self.kinds[slot.kind]);
        let units = format!("{} and {}", a.name, b.name);
        let [ours, theirs] =
            [(a, true), (b, false)].map(|(kind, even)| kind.crossing(rule.join, shape, even));
        // The frame of their edge is ours turned half round.
        let apart = (ours.at() + theirs.at().coords).coords.norm();
        match rule.join {
            Join::Shared => {
                let angle = (ours.turn - theirs.turn).abs();
                if apart > SAME || angle > SAME {
                    let angle = angle.to_degrees();
                    return Err(ShapeError::Shared { units, apart, angle });
                }
            }
            Join::End if apart > SAME => {
                return Err(ShapeError::Ends { slide: shape.slide, units, apart });
            }
            Join::End => {}
            Join::Rest { reach } => {
                for (from, into) in [(a, b), (b, a)] {
                    rests(from, into, reach, shape)?;
                }
            }
        }
        [a, b].into_iter().try_for_each(|kind| sound(kind, rule.join, shape))
    }
}

/// Whether every rod of a unit, of either colour, is held, and the outer ones run round a
/// hole that is wide enough.
fn sound(kind: &UnitKind, join: Join, shape: Shape) -> Result<(), ShapeError> {
    let (turn, slide, unit) = (shape.turn.to_degrees(), shape.slide, kind.name.clone());
    for even in [true, false] {
        let figure = kind.figure(join, shape, even);
        let Ok(meetings) = figure.meetings(&[]) else {
            return Err(ShapeError::Circuit { turn, slide, unit });
        };
        let loose = |member: Member| {
            let count = meetings.all.iter().filter(|m| m.ending == member || m.passing == member);
            Some(count.count()).filter(|&n| n < 2).map(|n| (member, n))
        };
        let members =
            (0..kind.sides).map(Member::Outer).chain((0..figure.inner.len()).map(Member::Inner));
        if let Some((member, contacts)) = members.filter_map(loose).next() {
            let rod = match member {
                Member::Inner(i) => format!("inner rod {}", i + 1),
                Member::Outer(i) | Member::Guest(i) => format!("outer rod {}", i + 1),
            };
            return Err(ShapeError::Loose { unit, rod, contacts });
        }
        if let [first, second, ..] = &meetings.all[..meetings.circuit] {
            let side = (first.at - second.at).norm();
            if side < LEAST_SIDE - SAME {
                return Err(ShapeError::Hole { turn, slide, unit, side });
            }
        }
    }
    Ok(())
}

/// Whether a rod that goes from one unit into another comes to rest there.
fn rests(from: &UnitKind, into: &UnitKind, reach: usize, shape: Shape) -> Result<(), ShapeError> {
    let join = Join::Rest { reach };
    let home = from.figure(join, shape, true).outer[0];
    // Seen from the other unit, whose middle lies beyond our first edge.
    let middle = Vector2::new(inradius(from.sides) + inradius(into.sides), 0.0);
    let line = Line { at: (middle - home.at.coords).into(), inward: home.inward };
    let guest = Guest { side: 0, line, reach };
    let figure = into.figure(join, shape, true);
    if beside(&line, &figure.outer[0]) && figure.meetings(&[guest]) != Err(Unmet::Guest(0)) {
        return Ok(());
    }
    Err(ShapeError::Rest {
        turn: shape.turn.to_degrees(),
        slide: shape.slide,
        from: from.name.clone(),
        into: into.name.clone(),
        instead: None,
    })
}

/// Whether two rods across one edge do not lie one in the other.
fn beside(one: &Line, other: &Line) -> bool {
    let (u, v) = (one.inward.normalize(), other.inward.normalize());
    u.perp(&v).abs() > SAME || (other.at - one.at).perp(&u).abs() >= LEAST_APART
}

impl UnitKind {
    /// The unit on a regular tile with its middle at the origin and the x axis through the
    /// middle of its first edge, all rods joined alike.
    pub fn figure(&self, join: Join, shape: Shape, even: bool) -> Figure {
        let crossing = self.crossing(join, shape, even);
        let r = inradius(self.sides);
        let line = |side: usize| {
            let (sin, cos) = (TAU * side as f64 / self.sides as f64).sin_cos();
            // Out of the tile, and clockwise along the edge.
            let (out, along) = (Vector2::new(cos, sin), Vector2::new(sin, -cos));
            let place = |v: Vector2<f64>| along * v.x + out * v.y;
            Line {
                at: Point2::from(out * r + place(crossing.at().coords)),
                inward: -place(crossing.outward()),
            }
        };
        let outer: Vec<Line> = (0..self.sides).map(line).collect();
        let stops = self.stop().map_or_else(Vec::new, |stop| vec![stop; self.sides]);
        Figure { outer, stops, inner: self.inner_rods().collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::library;

    fn shape(degrees: f64, slide: f64) -> Shape {
        Shape { turn: degrees.to_radians(), slide }
    }

    fn message(name: &str, shape: Shape) -> String {
        let pattern = Pattern::named(name).expect("in the library");
        pattern.check(shape).expect_err("out of range").to_string()
    }

    #[test]
    fn usual_shapes_and_their_mirror_images_are_safe() {
        for pattern in library() {
            let Shape { turn, slide } = pattern.usual();
            assert_eq!(pattern.check(Shape { turn, slide }), Ok(()), "{}", pattern.name);
            let mirrored = Shape { turn: -turn, slide: -slide };
            assert_eq!(pattern.check(mirrored), Ok(()), "{}", pattern.name);
        }
    }

    #[test]
    fn what_is_not_safe_is_said_with_what_is() {
        for (name, at, words) in [
            ("4.4.4.4", shape(40.0, 0.0), "holds together between 8 and 36 degrees"),
            ("4.4.4.4", shape(20.0, 0.2), "holds together between -0.05 and 0.05 tile edges"),
            ("6.6.6", shape(20.0, 0.1), "its rods do not slide"),
            ("4.4.4.4", shape(8.0, 0.05), "the holes of every square would be 0.0"),
            ("large-and-small", shape(-28.0, 0.1), "change the sign of one of them"),
            ("basket-end-to-end", shape(24.0, 0.0), "its units have a radius of their own"),
        ] {
            let message = message(name, at);
            assert!(message.contains(words), "{message}");
        }
    }

    fn squares(join: &str, figures: &str) -> Pattern {
        let text = format!(
            "tiling = \"4.4.4.4\"\n{figures}\n[[units]]\nname = \"square\"\nsides = 4\n\
             [[rules]]\nunits = [\"square\", \"square\"]\njoin = \"{join}\"\n"
        );
        Pattern::parse(&text, "squares").expect("a sound file")
    }

    #[test]
    fn ends_that_do_not_meet_are_measured() {
        let pattern = squares("end", "slide = { usual = 0, safe = [-0.3, 0.3] }");
        assert_eq!(pattern.check(shape(20.0, 0.0)), Ok(()));
        let found = pattern.check(shape(20.0, 0.1));
        assert!(
            matches!(found, Err(ShapeError::Ends { apart, .. }) if (apart - 0.2).abs() < 1e-12)
        );
    }

    /// With slide 0 the rods of two equal neighbours lie in one line, one in the other; a
    /// slide is named at which they lie side by side.
    #[test]
    fn a_slide_is_named_at_which_rods_reach() {
        let figures = "slide = { usual = 0.12, safe = [0, 0.45] }\n\
                       turn = { usual = 20, safe = [0, 44] }";
        let pattern = squares("rest", figures);
        assert_eq!(pattern.check(shape(22.0, 0.12)), Ok(()));
        let in_line = pattern.check(shape(22.0, 0.0));
        let Err(ShapeError::Rest { instead: Some(instead), .. }) = in_line else {
            panic!("{in_line:?}");
        };
        assert!((0.02..0.05).contains(&instead), "{instead}");
        assert_eq!(pattern.check(shape(22.0, instead)), Ok(()));
    }

    #[test]
    fn shared_rods_slide_only_where_tiles_alternate() {
        let text = "tiling = \"6.6.6\"\nslide = { usual = 0, safe = [-0.3, 0.3] }\n[[units]]\n\
                    name = \"hexagon\"\nsides = 6\n[[rules]]\nunits = [\"hexagon\", \"hexagon\"]\n\
                    join = \"shared\"\n";
        let pattern = Pattern::parse(text, "hexagons").expect("a sound file");
        assert!(matches!(pattern.check(shape(20.0, 0.1)), Err(ShapeError::Alternate { .. })));
    }

    /// A rod drawn by hand is shared only when its neighbour draws the same line.
    #[test]
    fn rods_that_two_units_draw_differently_are_not_one() {
        let drawn = |outer: &str| {
            let text = format!(
                "tiling = \"4.4.4.4\"\n[[units]]\nname = \"window\"\nsides = 4\nouter = [{outer}]\n\
                 [[rules]]\nunits = [\"window\", \"window\"]\njoin = \"shared\"\n"
            );
            Pattern::parse(&text, "windows").expect("a sound file").check(shape(20.0, 0.0))
        };
        assert!(matches!(
            drawn("[[0.6, 0.0], [0.2, 0.0]]"),
            Err(ShapeError::Loose { contacts: 0, .. })
        ));
        // Through the middle of the edge, and beside it.
        assert_eq!(drawn("[[0.6, 0.03], [-0.25, -0.225]]"), Ok(()));
        assert!(matches!(
            drawn("[[0.6, 0.13], [-0.25, -0.125]]"),
            Err(ShapeError::Shared { apart, .. }) if (apart - 0.2).abs() < 1e-9
        ));
    }
}
