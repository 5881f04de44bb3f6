//! The picture of a pattern in the plane: its tiles, its rods, and one unit set apart so
//! that one sees what a unit is.
//!
//! In the plane nothing says who goes over: rods are shown with their ends on top.

use super::band::{Band, rounded};
use super::page::{BODY, SMALL, printable};
use crate::chart::Flat;
use crate::drawing::font::{LEADING, fit_size, wrap};
use crate::drawing::{Color, Draw, Drawing, DrawingError, Item, Paint, Point, Rect, Stroke};
use crate::drawing::{Weight, clip};
use crate::frame::canvas::{PlaneCanvas, PlaneError};
use crate::frame::crop::{crop, held};
use crate::frame::plane_rods::{PlaneRod, plane_rods};
use crate::frame::weave::{Weave, weave};
use crate::ids::{Id, IdVec, RodId, TileId, UnitId};
use crate::pattern::{Pattern, Shape};
use crate::tiling::{Placement, Tiling};
use nalgebra::{Point2, Vector2};
use std::f64::consts::PI;

/// White round a picture with a caption, mm.
const MARGIN: f64 = 2.0;
/// How many tiles of mean size lie across the shorter side of the picture: enough to see
/// what repeats, few enough to see how rods rest on each other.
const ACROSS: f64 = 6.0;
/// How many of the largest tiles lie across it, at least: one whole, and its neighbours.
const LARGEST_ACROSS: f64 = 2.6;
/// Tiles are looked at so far about the pattern's start, in edges, to find their mean size
/// and a largest one: more than any of the tilings takes to repeat.
const SURVEY: f64 = 10.0;
/// Rods are woven so far beyond the picture, in widths of the largest tile, that those in
/// it have all their neighbours.
const BEYOND: f64 = 2.5;
/// Thickness of a rod, in edges.
const THICKNESS: f64 = 1.0 / 14.0;
/// Thinnest rod, mm.
const THINNEST: f64 = 0.25;
/// How far a rod sticks out beyond the rod on which it rests, in thicknesses.
const OVERHANG: f64 = 1.3;
/// Units are taken for those of a tile where their middles lie nearer than this, in edges:
/// far nearer than the middles of two tiles.
const SAME_PLACE: f64 = 0.05;

/// Edges of tiles.
const EDGE: Stroke = Stroke::new(0.13).color(Color::grey(0xB4));
/// The edge of the picture.
const FRAME: Stroke = Stroke::new(0.15).color(Color::GREY);
/// Rods of other units.
const ROD: Color = Color::grey(0x94);
/// Rods of the unit that is set apart, but for one.
const UNIT_ROD: Color = Color::BLUE;
/// One rod of it.
const ONE_ROD: Color = Color::BLACK;

/// Why a pattern cannot be drawn.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PictureError {
    /// Its rods form no units.
    #[error(
        "the pattern {name} cannot be drawn with rods turned by {turn:.1} degrees: {reason}. Use \
         another turn"
    )]
    Unwoven {
        /// The pattern.
        name: String,
        /// Turn of its rods, degrees.
        turn: f64,
        /// What is wrong, as a clause.
        reason: &'static str,
    },
    /// The tiles, as where the picture is far longer than wide.
    #[error("the pattern cannot be laid out: {0}")]
    Plane(#[from] PlaneError),
    /// The drawing.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
}

/// The picture of a pattern with its name and summary below, `size` mm wide and high, from
/// some 30 mm either way.
///
/// # Errors
/// [`PictureError`] where rods of this shape form no units.
pub fn pattern_picture(
    pattern: &Pattern,
    shape: Shape,
    size: [f64; 2],
) -> Result<Drawing, PictureError> {
    let mut picture = Drawing::new(size[0], size[1]);
    // On dark screens black lines need a ground.
    picture.rect([0.0, 0.0], size, Paint::from(Color::WHITE));
    let inside = picture.frame().inset(MARGIN);
    let (name, summary) = (printable(&pattern.name), printable(&pattern.summary));
    let lines = wrap(&summary, SMALL, Weight::Regular, inside.width())?;
    let caption = 1.6 * BODY + SMALL * LEADING * lines.len() as f64;
    let room = Rect { max: [inside.max[0], inside.max[1] - caption], ..inside };
    swatch(pattern, shape, room, &mut picture)?;
    let texts = picture.layer("captions");
    let (x, y) = (inside.center()[0], room.max[1] + 1.3 * BODY);
    let fitted = fit_size(&name, BODY, Weight::Bold, inside.width())?;
    texts.text([x, y], fitted, name).bold().middle();
    for (i, line) in lines.into_iter().enumerate() {
        let y = y + SMALL * LEADING * (i as f64 + 1.0);
        let fitted = fit_size(&line, SMALL, Weight::Regular, inside.width())?;
        texts.text([x, y], fitted, line).middle().color(Color::DARK_GREY);
    }
    Ok(picture)
}

/// Draws the pattern into `room`, filling it, onto the layers `tiles` and `rods`.
pub(super) fn swatch(
    pattern: &Pattern,
    shape: Shape,
    room: Rect,
    out: &mut Drawing,
) -> Result<(), PictureError> {
    let window = Window::new(pattern, room);
    let (low, high) = window.reach(window.widest);
    let tiling = pattern.tiling.patch(low, high);
    let woven = woven(pattern, shape, &window)?;
    let unit = nearest(woven.units.iter().map(|u| u.center.position.xy()), window.middle)
        .filter(|&(_, off)| off < SAME_PLACE)
        .ok_or_else(|| unwoven(pattern, shape, "its rods form no circuit"))?;
    let mut tiles: Vec<Item> = Vec::new();
    if let Some((tile, _)) = nearest(tiling.centers.iter().copied(), window.middle) {
        let corners = &tiling.net.tiles[TileId::new(tile)].corners;
        tiles.polygon(
            corners.iter().map(|&v| window.place(tiling.vertices[v])),
            Paint::from(UNIT_ROD.tint(0.18)),
        );
    }
    edges(&tiling, &window, &mut tiles);
    out.layer("tiles").items.extend(clip(&tiles, room));
    let rods = bands(&woven, UnitId::new(unit.0), &window);
    let layer = out.layer("rods");
    layer.items.extend(clip(&rods, room));
    layer.rect(room.min, room.size(), FRAME);
    Ok(())
}

/// The part of the plane that is drawn, in tile edges, and its place on paper.
struct Window {
    /// The middle of a largest tile: the unit that is set apart.
    middle: Point2<f64>,
    half: Vector2<f64>,
    /// Width of the largest tile.
    widest: f64,
    /// mm to the edge.
    scale: f64,
    room: Rect,
}

impl Window {
    fn new(pattern: &Pattern, room: Rect) -> Self {
        let corner = Point2::new(SURVEY, SURVEY);
        let tiling = pattern.tiling.patch(-corner, corner);
        let sides = |t: TileId| tiling.net.tiles[t].corners.len();
        let largest = tiling.net.tiles.ids().map(sides).max().unwrap_or(3);
        let area = |n: usize| n as f64 / 4.0 / (PI / n as f64).tan();
        let total: f64 = tiling.net.tiles.ids().map(|t| area(sides(t))).sum();
        let mean = (total / tiling.net.tiles.len() as f64).sqrt();
        let widest = 1.0 / (PI / largest as f64).sin();
        let across = (ACROSS * mean).max(LARGEST_ACROSS * widest);
        let scale = room.width().min(room.height()) / across;
        let size = room.size();
        let centers = tiling.centers.enumerate().filter(|(t, _)| sides(*t) == largest);
        let centers: Vec<Point2<f64>> = centers.map(|(_, &c)| c).collect();
        let middle = nearest(centers.iter().copied(), Point2::origin());
        Self {
            middle: middle.map_or_else(Point2::origin, |(i, _)| centers[i]),
            half: Vector2::from(size) / (2.0 * scale),
            widest,
            scale,
            room,
        }
    }

    /// The corners of the window, moved out by `margin`.
    fn reach(&self, margin: f64) -> (Point2<f64>, Point2<f64>) {
        let reach = self.half + Vector2::repeat(margin);
        (self.middle - reach, self.middle + reach)
    }

    fn place(&self, p: Point2<f64>) -> Point {
        let ([x, y], d) = (self.room.center(), (p - self.middle) * self.scale);
        [rounded(x + d.x), rounded(y - d.y)]
    }

    /// Thickness of a rod on paper, mm.
    fn thickness(&self) -> f64 {
        (THICKNESS * self.scale).max(THINNEST)
    }
}

/// Which of the points lies nearest to `to`, the first of several, and how far away.
/// Distances that differ by rounding alone count as the same.
fn nearest(points: impl Iterator<Item = Point2<f64>>, to: Point2<f64>) -> Option<(usize, f64)> {
    let steps = |d: f64| (d * 1e6).round();
    points
        .map(|p| (p - to).norm())
        .enumerate()
        .min_by(|(_, a), (_, b)| steps(*a).total_cmp(&steps(*b)))
}

fn unwoven(pattern: &Pattern, shape: Shape, reason: &'static str) -> PictureError {
    PictureError::Unwoven { name: pattern.name.clone(), turn: shape.turn.to_degrees(), reason }
}

/// The rods in the window and for some way round it.
fn woven(pattern: &Pattern, shape: Shape, window: &Window) -> Result<Weave, PictureError> {
    let (low, high) = window.reach(BEYOND * window.widest);
    let sheet = Flat { low, high };
    let placement = Placement { origin: Point2::origin(), rotation: 0.0, edge: 1.0 };
    let canvas = PlaneCanvas::new(&sheet, pattern, placement, shape)?;
    let tiles = crop(&canvas, &held(&canvas));
    weave(&canvas, &tiles).map_err(|failed| {
        unwoven(pattern, shape, failed.first().map_or("it has no units", |f| f.reason))
    })
}

/// The tiles, those that lie wholly in the room as one area, which makes a small file.
fn edges(tiling: &Tiling, window: &Window, out: &mut Vec<Item>) {
    let ring = |corners: &Vec<usize>| -> Vec<Point> {
        corners.iter().map(|&v| window.place(tiling.vertices[v])).collect()
    };
    let (inside, border): (Vec<_>, Vec<_>) = tiling
        .net
        .tiles
        .iter()
        .map(|tile| ring(&tile.corners))
        .partition(|ring| ring.iter().all(|&p| window.room.contains(p)));
    border.into_iter().for_each(|ring| out.polygon(ring, EDGE));
    out.area(inside, EDGE);
}

/// The bands of the rods, those of one unit in other colours.
fn bands(woven: &Weave, unit: UnitId, window: &Window) -> Vec<Item> {
    let rods = plane_rods(woven);
    let width = window.thickness();
    let mut own = woven.units[unit].rods.clone();
    own.sort();
    let mut items: Vec<Item> = Vec::new();
    for rod in rods.ids() {
        let color = match own.binary_search(&rod) {
            Err(_) => ROD,
            Ok(_) if own.first() == Some(&rod) => ONE_ROD,
            Ok(_) => UNIT_ROD,
        };
        for corners in band(rod, &rods, window).stretches(width) {
            items.polygon(corners, Paint::from(color));
        }
    }
    items
}

fn band(rod: RodId, rods: &IdVec<RodId, PlaneRod>, window: &Window) -> Band {
    let PlaneRod { ends, rests, under } = &rods[rod];
    let placed = |p: &PlaneRod| p.ends.map(|end| window.place(end));
    let direction = |[a, b]: [Point; 2]| [b[0] - a[0], b[1] - a[1]];
    let [mut a, mut b] = ends.map(|end| window.place(end));
    let [x, y] = direction([a, b]);
    let out = OVERHANG * window.thickness() / x.hypot(y);
    let beyond = rests.map(|rests| if rests { out } else { 0.0 });
    a = [a[0] - x * beyond[0], a[1] - y * beyond[0]];
    b = [b[0] + x * beyond[1], b[1] + y * beyond[1]];
    let under = under
        .iter()
        .map(|&(at, over)| (window.place(at), direction(placed(&rods[over]))))
        .collect();
    Band { ends: [a, b], under }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape::Area;
    use crate::drawing::{Figure, bounds, svg};
    use crate::frame::ContactKind;
    use crate::frame::weave::WovenContact;
    use crate::pattern::library;

    const SIZE: [f64; 2] = [60.0, 70.0];
    const ROOM: Rect = Rect::new([5.0, 7.0], [40.0, 30.0]);

    fn filled(items: &[Item], color: Color) -> Vec<&Figure> {
        items
            .iter()
            .filter_map(|item| match item {
                Item::Figure(f) => (f.paint.fill == Some(color)).then_some(f),
                Item::Text(_) => None,
            })
            .collect()
    }

    fn drawn(pattern: &Pattern, shape: Shape) -> Drawing {
        let mut out = Drawing::new(60.0, 60.0);
        swatch(pattern, shape, ROOM, &mut out).unwrap();
        out
    }

    /// Each of its shared rods lies under two others, so three stretches of it are seen.
    #[test]
    fn a_unit_is_set_apart_with_all_its_rods_in_whole_stretches() {
        for pattern in library() {
            let sides = pattern.tiling.polygons().last().copied().unwrap();
            let picture = drawn(pattern, pattern.usual());
            let rods = &picture.layers.iter().find(|l| l.name == "rods").unwrap().items;
            let one = filled(rods, ONE_ROD).len();
            let others = filled(rods, UNIT_ROD).len();
            if pattern.name == pattern.tiling.name {
                assert_eq!((one, others), (3, 3 * (sides - 1)), "{}", pattern.name);
            }
            assert!(one > 0 && others >= sides - 1, "{}", pattern.name);
            let tiles = &picture.layers.iter().find(|l| l.name == "tiles").unwrap().items;
            assert_eq!(filled(tiles, UNIT_ROD.tint(0.18)).len(), 1);
            let [Item::Figure(Figure { shape: Area(rings), .. }), ..] = &tiles[..] else {
                panic!("{}: the tinted tile comes first", pattern.name)
            };
            assert_eq!((rings.len(), rings[0].len()), (1, sides), "{}", pattern.name);
            let middle = |i: usize| rings[0].iter().map(|p| p[i]).sum::<f64>() / sides as f64;
            assert!((0..2).all(|i| (middle(i) - ROOM.center()[i]).abs() < 0.02));
        }
    }

    #[test]
    fn everything_stays_in_its_room_and_fills_it() {
        for pattern in library() {
            for layer in &drawn(pattern, pattern.usual()).layers {
                let extent = bounds(&layer.items).unwrap();
                assert!(ROOM.inset(-1e-9).contains_rect(&extent), "{}: {extent:?}", pattern.name);
                assert!((0..2).all(|i| extent.size()[i] > 0.99 * ROOM.size()[i]));
            }
        }
    }

    /// The band above is whole where the other one breaks off: no two bands overlap.
    #[test]
    fn bands_leave_a_gap_at_every_contact() {
        for pattern in library() {
            let window = Window::new(pattern, ROOM);
            let woven = woven(pattern, pattern.usual(), &window).unwrap();
            let rods = plane_rods(&woven);
            let width = window.thickness();
            let seen = |r: RodId, p: Point| {
                let stretches = band(r, &rods, &window).stretches(width);
                stretches.iter().any(|corners| holds(corners, p))
            };
            let mut crossings = 0;
            for (rod, laid) in rods.enumerate() {
                for &(at, over) in &laid.under {
                    let at = window.place(at);
                    assert!(seen(over, at) && !seen(rod, at), "{} {rod} {over}", pattern.name);
                    crossings += 1;
                }
            }
            let crossed = |c: &&WovenContact| c.kind == ContactKind::Cross;
            assert_eq!(
                crossings,
                woven.contacts.iter().filter(crossed).count(),
                "{}",
                pattern.name
            );
        }
    }

    fn holds(corners: &[Point; 4], p: Point) -> bool {
        let side = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        (0..4).all(|k| side(k) >= 0.0) || (0..4).all(|k| side(k) <= 0.0)
    }

    #[test]
    fn name_and_words_stand_below_within_the_picture_and_twice_the_same() {
        for pattern in library() {
            let picture = pattern_picture(pattern, pattern.usual(), SIZE).unwrap();
            let mut said = Vec::new();
            for item in picture.items() {
                if let Item::Text(text) = item {
                    assert!(picture.frame().contains_rect(&text.extent().unwrap()));
                    said.push(text.string.as_str());
                }
            }
            assert_eq!(said[0], pattern.name);
            assert_eq!(said[1..].join(" "), pattern.summary);
            let again = pattern_picture(pattern, pattern.usual(), SIZE).unwrap();
            assert_eq!(svg::render(&picture).unwrap(), svg::render(&again).unwrap());
        }
    }

    #[test]
    fn rods_that_form_no_units_are_refused_by_name() {
        let pattern = &library()[0];
        let error = pattern_picture(pattern, Shape { turn: 0.0, slide: 0.0 }, SIZE).unwrap_err();
        let said = error.to_string();
        assert!(said.contains(&pattern.name) && said.contains("0.0 degrees"), "{said}");
    }
}
