//! The footprint: the surface laid flat on the tiling of the pattern, and which tiles
//! became units (paper, Fig. 9). It shows what `--origin` and `--rotate` change.

use super::page::{BODY, Flow, Leaf, SMALL, TITLE};
use super::support_map::{SCALE_BAR_HEIGHT, scale_bar};
use super::text::TextError;
use super::text::message::messages;
use super::view::round_scale;
use super::{SheetError, SheetSettings};
use crate::drawing::font::{LEADING, elide, text_width, wrap};
use crate::drawing::{Color, Dash, Draw, Drawing, Item, Paint, Point, Rect};
use crate::drawing::{Stroke, Weight, clip};
use crate::frame::footprint::Footprint;
use nalgebra::Point2;

messages! {
    mod say in "footprint.toml" {
        "title" => Title {}
        "own-title" => OwnTitle { model: String }
        "scale" => Scale { scale: String }
        "introduction" => Introduction {}
        "start" => Start { x: String, y: String, unit: String, turn: String, edge: String }
        "key-unit" => KeyUnit {}
        "key-rod" => KeyRod {}
        "key-border" => KeyBorder {}
        "key-start" => KeyStart {}
    }
}

/// White round the drawing on its own, mm.
const MARGIN: f64 = 10.0;
/// White between text, picture, key and scale bar, mm.
const GAP: f64 = 4.0;
/// Least height of the picture, mm.
const LEAST_PICTURE: f64 = 40.0;
/// Length of the arrow along the pattern, mm.
const ARROW: f64 = 13.0;
/// Radius of the arc from the page's own direction to the arrow, mm.
const ARC: f64 = 8.0;
/// Half the size of the cross where the pattern starts, mm.
const CROSS: f64 = 3.0;
/// Width of a sign of the key, mm.
const SIGN: f64 = 6.0;
/// Turns of the pattern below this, radians, are not shown: rounding.
const NO_TURN: f64 = 1e-9;

/// Layer of the tiling.
const TILES: &str = "tiles";
/// Layer of the rods: one line each.
const RODS: &str = "rods";
/// Layer of the flat surface's border.
const OUTLINE: &str = "outline";
/// Layer of the place and direction of the pattern.
const START: &str = "start";
const TEXTS: &str = "texts";

/// Tiles that became units: a light blue.
const UNIT: Color = Color::rgb(0xD1, 0xE6, 0xF1);
/// Edges of tiles.
const TILE_EDGE: Stroke = Stroke::new(0.1).color(Color::grey(0xA8));
/// The edge of the picture.
const FRAME: Stroke = Stroke::new(0.15).color(Color::GREY);
/// Where the pattern starts, on a white ground.
const START_PEN: Stroke = Stroke::new(0.5);
const START_GROUND: Stroke = Stroke::new(1.4).color(Color::WHITE);

/// The footprint on a sheet of its own, as wide as the paper and no higher.
///
/// # Errors
/// [`SheetError::PaperTooSmall`]; [`SheetError::Drawing`] if the footprint holds numbers
/// that are not finite.
pub fn drawing(footprint: &Footprint, settings: &SheetSettings) -> Result<Drawing, SheetError> {
    let settings = settings.checked()?;
    let [width, height] = settings.paper.size();
    let mut sheet = Drawing::new(width, height);
    let mut area = sheet.frame().inset(MARGIN);
    let title = settings.say(say::OwnTitle { model: settings.model.clone() })?;
    let title = elide(&title, TITLE, Weight::Bold, area.width())?;
    sheet.layer(TEXTS).text([area.min[0], area.min[1] + TITLE], TITLE, title).bold();
    area.min[1] += TITLE * 1.4;
    let (n, bottom) = lay(footprint, &settings, area, &mut sheet)?;
    let scale = settings.say(say::Scale { scale: settings.format().plain(n) })?;
    sheet.layer(TEXTS).text([area.max[0], MARGIN + TITLE], BODY, scale).end();
    sheet.height = bottom + MARGIN;
    Ok(sheet)
}

/// The page of the workshop document.
pub(super) fn page(
    footprint: &Footprint,
    settings: &SheetSettings,
) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "footprint", &settings.say(say::Title {})?);
    let area = flow.area();
    let (n, _) = lay(footprint, settings, area, flow.page())?;
    Ok(flow.finish(Some(&settings.say(say::Scale { scale: settings.format().plain(n) })?)))
}

/// Text, picture, key and scale bar from the top of `area` down. Returns n of the scale
/// 1:n, and where the last of them ends.
fn lay(
    footprint: &Footprint,
    settings: &SheetSettings,
    area: Rect,
    out: &mut Drawing,
) -> Result<(f64, f64), SheetError> {
    let [left, top] = area.min;
    let mut lines = Vec::new();
    for sentence in words(footprint, settings)? {
        lines.extend(wrap(&sentence, BODY, Weight::Regular, area.width())?);
    }
    let leading = BODY * LEADING;
    let picture_top = top + leading * lines.len() as f64 + GAP;
    out.layer(TEXTS).text_lines([left, top + BODY], BODY, leading, Default::default(), lines);

    let key = Key::new(area.width(), settings)?;
    let below = GAP + key.height + GAP + SCALE_BAR_HEIGHT;
    let room = (area.max[1] - below - picture_top).max(LEAST_PICTURE);
    let room = Rect::new([left, picture_top], [area.width(), room]);
    let map = Map::new(footprint, room);
    map.draw(out);

    let y = map.picture.max[1] + GAP;
    key.draw([left, y], &map, out);
    let y = y + key.height + GAP;
    let n = map.n;
    scale_bar(out.layer(TEXTS), [left, y + SCALE_BAR_HEIGHT / 2.0], n, settings.format());
    Ok((n, y + SCALE_BAR_HEIGHT))
}

/// What the picture shows, a paragraph each.
fn words(footprint: &Footprint, settings: &SheetSettings) -> Result<[String; 2], TextError> {
    let format = settings.format();
    let Footprint { origin, rotation, edge, .. } = footprint;
    let start = say::Start {
        x: format.length(origin.x),
        y: format.length(origin.y),
        unit: settings.units.name().to_owned(),
        turn: format.angle(*rotation),
        edge: format.measure(*edge),
    };
    Ok([settings.say(say::Introduction {})?, settings.say(start)?])
}

/// The footprint on paper.
struct Map<'a> {
    footprint: &'a Footprint,
    /// The scale is 1:n.
    n: f64,
    /// Where it lies, mm.
    picture: Rect,
}

impl<'a> Map<'a> {
    /// At the largest round scale that fits, at the top of the room and in its middle.
    fn new(footprint: &'a Footprint, room: Rect) -> Self {
        let [low, high] = footprint.window;
        let size = [high.x - low.x, high.y - low.y];
        let n = round_scale((0..2).map(|i| size[i] / room.size()[i]).fold(0.0, f64::max));
        let [width, height] = size.map(|s| s / n);
        let picture = Rect::new([room.center()[0] - width / 2.0, room.min[1]], [width, height]);
        Self { footprint, n, picture }
    }

    fn place(&self, p: Point2<f64>) -> Point {
        let [low, _] = self.footprint.window;
        [self.picture.min[0] + (p.x - low.x) / self.n, self.picture.max[1] - (p.y - low.y) / self.n]
    }

    fn ring(&self, line: &[Point2<f64>]) -> Vec<Point> {
        line.iter().map(|&p| self.place(p)).collect()
    }

    /// The line of a rod.
    fn rod(&self) -> Stroke {
        let edge = self.footprint.edge / self.n;
        Stroke::new((edge / 20.0).clamp(0.15, 0.55)).color(Color::BLUE)
    }

    /// The line of the surface's border: wider than that of a rod.
    fn border(&self) -> Stroke {
        Stroke::new(self.rod().width.max(0.25) * 1.6).round()
    }

    fn draw(&self, out: &mut Drawing) {
        self.tiles(out.layer(TILES));
        let rods = out.layer(RODS);
        for &[a, b] in &self.footprint.rods {
            rods.line(self.place(a), self.place(b), self.rod());
        }
        let rings = self.footprint.outline.iter().map(|line| self.ring(line)).collect();
        out.layer(OUTLINE).area(rings, self.border());
        out.layer(START).items.extend(clip(&self.start(), self.picture));
    }

    /// Whole tiles are one area, which makes a small file; those at the edge are cut.
    fn tiles(&self, out: &mut impl Draw) {
        let Footprint { tiles, units, .. } = self.footprint;
        let rings: Vec<Vec<Point>> = tiles.iter().map(|tile| self.ring(tile)).collect();
        let tinted = rings.iter().zip(units).filter(|(_, unit)| **unit);
        out.area(tinted.map(|(ring, _)| ring.clone()).collect(), Paint::from(UNIT));
        let (whole, cut): (Vec<_>, Vec<_>) =
            rings.into_iter().partition(|ring| ring.iter().all(|&p| self.picture.contains(p)));
        let mut edges: Vec<Item> = Vec::new();
        cut.into_iter().for_each(|ring| edges.polygon(ring, TILE_EDGE));
        out.items_mut().extend(clip(&edges, self.picture));
        out.area(whole, TILE_EDGE);
        out.rect(self.picture.min, self.picture.size(), FRAME);
    }

    /// A cross where the pattern starts, an arrow along its first edges, and an arc to it
    /// from the page's own direction.
    fn start(&self) -> Vec<Item> {
        let mut items = Vec::new();
        let [x, y] = self.place(self.footprint.origin);
        let turn = self.footprint.rotation;
        let (sin, cos) = turn.sin_cos();
        let tip = [x + ARROW * cos, y - ARROW * sin];
        for pen in [START_GROUND, START_PEN] {
            items.line([x, y], [x + (ARROW - 1.0) * cos, y - (ARROW - 1.0) * sin], pen);
            cross(&mut items, [x, y], pen);
        }
        if turn.abs() > NO_TURN {
            let thin = Stroke { width: 0.25, ..START_PEN };
            items.line([x, y], [x + ARROW, y], thin.dash(Dash::new([1.2, 0.8])));
            // On paper y points down, so that the arc runs the other way round.
            items.arc([x, y], ARC, 0.0, -turn.to_degrees() % 360.0, thin);
        }
        items.arrow_head(tip, [cos, -sin], 2.6, START_PEN);
        items
    }
}

fn cross(out: &mut impl Draw, [x, y]: Point, pen: Stroke) {
    // Askew, so that it stands out from the tiles.
    for (dx, dy) in [(CROSS, CROSS), (CROSS, -CROSS)] {
        let (dx, dy) = (dx / 2f64.sqrt(), dy / 2f64.sqrt());
        out.line([x - dx, y - dy], [x + dx, y + dy], pen);
    }
}

/// What the signs of the picture mean, side by side as far as there is room.
struct Key {
    /// Where each sign with its words begins, from the top left corner.
    places: Vec<Point>,
    words: [String; 4],
    height: f64,
}

impl Key {
    /// Height of a line, mm.
    const LINE: f64 = 5.5;

    fn new(width: f64, settings: &SheetSettings) -> Result<Self, SheetError> {
        let words = [
            settings.say(say::KeyUnit {})?,
            settings.say(say::KeyRod {})?,
            settings.say(say::KeyBorder {})?,
            settings.say(say::KeyStart {})?,
        ];
        let (mut places, mut x, mut y) = (Vec::new(), 0.0, 0.0);
        for words in &words {
            let wide = SIGN + 1.5 + text_width(words, SMALL, Weight::Regular)?;
            if x > 0.0 && x + wide > width {
                (x, y) = (0.0, y + Self::LINE);
            }
            places.push([x, y]);
            x += wide + GAP;
        }
        Ok(Self { places, words, height: y + Self::LINE })
    }

    fn draw(&self, at: Point, map: &Map, out: &mut Drawing) {
        let corners = self.places.iter().map(|p| [at[0] + p[0], at[1] + p[1]]);
        for (i, ([x, y], words)) in corners.zip(&self.words).enumerate() {
            let y = y + Self::LINE / 2.0;
            let keys = out.layer("key");
            match i {
                0 => {
                    keys.rect([x, y - 1.8], [SIGN, 3.6], TILE_EDGE.fill(UNIT));
                }
                1 => keys.line([x, y], [x + SIGN, y], map.rod()),
                2 => keys.line([x, y], [x + SIGN, y], map.border()),
                _ => cross(keys, [x + SIGN / 2.0, y], START_PEN),
            }
            out.layer(TEXTS).text([x + SIGN + 1.5, y], SMALL, words.as_str()).vcenter();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Shape, bounds, svg};
    use crate::sheets::{Language, Paper, PaperUnits, Texts};
    use crate::shop::fixture;
    use std::sync::LazyLock;

    static STATION: LazyLock<Footprint> =
        LazyLock::new(|| fixture::laid_on_sample("train-station", "3.6.3.6", [25.0, -70.0], 0.5).1);

    fn settings(paper: Paper) -> SheetSettings {
        let notes = Vec::new();
        SheetSettings {
            model: "station".to_owned(),
            paper,
            units: PaperUnits::Mm,
            density: 600.0,
            sawn: Default::default(),
            notes,
            texts: Texts::built_in(Language::En).unwrap(),
        }
    }

    fn layer<'a>(sheet: &'a Drawing, name: &str) -> &'a [Item] {
        &sheet.layers.iter().find(|l| l.name == name).unwrap().items
    }

    fn rings(items: &[Item]) -> Vec<&[Vec<Point>]> {
        items
            .iter()
            .filter_map(|item| match item {
                Item::Figure(f) => match &f.shape {
                    Shape::Area(rings) => Some(rings.as_slice()),
                    _ => None,
                },
                Item::Text(_) => None,
            })
            .collect()
    }

    #[test]
    fn every_unit_is_tinted_and_every_rod_drawn() {
        let sheet = drawing(&STATION, &settings(Paper::A4)).unwrap();
        let units = STATION.units.iter().filter(|unit| **unit).count();
        assert!(units >= 12);
        assert_eq!(rings(layer(&sheet, TILES))[0].len(), units);
        assert_eq!(layer(&sheet, RODS).len(), STATION.rods.len());
        assert_eq!(rings(layer(&sheet, OUTLINE))[0].len(), STATION.outline.len());
    }

    /// The tiling fills the picture to its edge; the surface lies within with some of the
    /// tiling round it.
    #[test]
    fn the_picture_is_cut_at_its_edge_and_the_surface_lies_in_it() {
        for paper in [Paper::A4, Paper::Custom { width: 145.0, height: 200.0 }] {
            let sheet = drawing(&STATION, &settings(paper)).unwrap();
            let picture = bounds(layer(&sheet, TILES)).unwrap();
            let surface = bounds(layer(&sheet, OUTLINE)).unwrap();
            for name in [RODS, START] {
                assert!(picture.contains_rect(&bounds(layer(&sheet, name)).unwrap()), "{name}");
            }
            let room = [surface.min[0] - picture.min[0], picture.max[1] - surface.max[1]];
            assert!((room[0] - room[1]).abs() < 1e-9 && room[0] > 1.0);
            assert!(sheet.frame().inset(MARGIN).contains_rect(&picture));
            let texts = layer(&sheet, TEXTS).iter().filter_map(|item| match item {
                Item::Text(text) => Some(text),
                Item::Figure(_) => None,
            });
            for text in texts {
                let extent = text.extent().unwrap();
                assert!(sheet.frame().contains_rect(&extent), "{}", text.string);
                assert!(!picture.overlaps(&extent), "{}", text.string);
            }
        }
    }

    /// Two points of the plane lie n times as far apart as on paper, y upwards.
    #[test]
    fn the_scale_is_true() {
        let map = Map::new(&STATION, Rect::new([10.0, 20.0], [150.0, 90.0]));
        assert!(map.n >= 1.0);
        let [p, q] = STATION.rods[0];
        let ([a, b], d) = ([p, q].map(|p| map.place(p)), q - p);
        assert!(((b[0] - a[0]) * map.n - d.x).abs() < 1e-9);
        assert!(((a[1] - b[1]) * map.n - d.y).abs() < 1e-9);
    }

    #[test]
    fn the_arrow_points_as_the_pattern_is_turned() {
        let map = Map::new(&STATION, Rect::new([10.0, 20.0], [150.0, 90.0]));
        let [x, y] = map.place(STATION.origin);
        let start = map.start();
        let head = rings(&start[start.len() - 1..])[0][0][0];
        assert!(((head[0] - x) - ARROW * 0.5f64.cos()).abs() < 1e-9);
        assert!(((y - head[1]) - ARROW * 0.5f64.sin()).abs() < 1e-9);
        let straight = Footprint { rotation: 0.0, ..STATION.clone() };
        assert!(Map { footprint: &straight, ..map }.start().len() < start.len());
    }

    /// A pattern that starts far away is laid all the same, only its cross is not seen.
    #[test]
    fn a_start_beyond_the_picture_is_told_in_words_alone() {
        let far = Footprint { origin: Point2::new(1e5, 0.0), ..STATION.clone() };
        let sheet = drawing(&far, &settings(Paper::A4)).unwrap();
        assert!(layer(&sheet, START).is_empty());
        let text = svg::render(&sheet).unwrap();
        assert!(text.contains("starts at 100000.0, 0.0 mm") && text.contains("28.6°"));
    }
}
