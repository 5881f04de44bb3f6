//! The map of the feet on pages: an overview with all figures, and tiles at full size.
//!
//! Tiles overlap. Every tile has crop marks in the middle of its overlaps, so that the
//! marks of two neighbours lie on the same points of the ground: cut along them, or
//! lay them on each other.

use super::page::{BODY, Column, Flow, Leaf, Listing, SMALL, TABLE, TABLE_LEADING, THIN, Table};
use super::support_map::{CHORDS, FootMap, NUMBERS, Numbers, Taken, no_feet};
use super::text::TextError;
use super::text::message::messages;
use super::{SheetError, SheetSettings, page};
use crate::drawing::font::{LEADING, wrap};
use crate::drawing::{
    Anchor, Color, Draw, Drawing, DrawingError, Item, Placement, Point, Rect, Stroke, Weight,
};
use crate::drawing::{Text, clip};
use crate::frame::Frame;
use crate::shop::Foot;

messages! {
    mod say in "support-map.toml" {
        "overview" => Overview {}
        "join" => Join {}
        "too-large" => TooLarge {}
        "explained" => Explained { x: String, y: String }
        "foot" => Foot {}
        "end" => End {}
        "x" => X {}
        "y" => Y {}
        "radius" => Radius {}
        "bearing" => Bearing {}
        "elevation" => Elevation {}
        "heading" => Heading {}
        "bevel" => Bevel {}
        "next" => Next {}
        "chord" => Chord {}
        "tiles" => Tiles {}
        "tile" => Tile { tile: String }
        "tile-title" => TileTitle { tile: String }
        "above" => Above { tile: String }
        "below" => Below { tile: String }
        "left" => Left { tile: String }
        "right" => Right { tile: String }
    }
}

/// How far neighbouring tiles overlap, mm.
const OVERLAP: f64 = 10.0;
/// Room above a tile for its name, mm.
const NAME: f64 = 7.0;
/// How far texts stay from the edge of a tile, mm.
const INSIDE: f64 = 0.8;
/// Half the size of a crop mark, mm.
const CROP: f64 = 4.0;
/// More tiles than this are not printed: nobody joins so many.
const MOST_TILES: usize = 150;
/// Room round the outermost feet on the map of the tiles, mm: for arrows and numbers.
const AROUND_SMALL: f64 = 14.0;
/// Largest part of a page that the map of the tiles takes.
const OVERVIEW_SHARE: f64 = 0.5;
/// It gets smaller than that, down to this part, where the table of the feet then ends on
/// the same page.
const LEAST_OVERVIEW_SHARE: f64 = 0.35;
/// Room between the map and the text below it, mm.
const BELOW_MAP: f64 = 4.0;

/// The overview page (and more, if the table is long).
pub(super) fn overview(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "support-map", &settings.say(say::Overview {})?);
    let map = FootMap::new(frame);
    if map.feet.is_empty() {
        flow.paragraph(&no_feet(settings)?)?;
        return Ok(flow.finish(None));
    }
    let tiling = Tiling::new(&map, settings);
    let explained = explained(&map, tiling.as_ref(), settings)?;
    let lines = wrap(&explained, BODY, Weight::Regular, flow.area().width())?.len();
    let words = lines as f64 * BODY * LEADING + BODY;
    let table_height = (map.feet.len() + 2) as f64 * TABLE * TABLE_LEADING;
    let share = (flow.room() - BELOW_MAP - words - table_height) / flow.room();
    let share = if share < LEAST_OVERVIEW_SHARE { OVERVIEW_SHARE } else { share };
    let room = Rect {
        min: [flow.area().min[0], flow.y],
        max: [flow.area().max[0], flow.y + flow.room() * share.min(OVERVIEW_SHARE)],
    };
    let height = small_map(flow.page(), &map, tiling.as_ref(), room, settings)?;
    flow.skip(height + BELOW_MAP);
    flow.paragraph(&explained)?;
    flow.table(&table(&map, settings)?)?;
    Ok(flow.finish(None))
}

/// The tiles at full size, row by row; none if the map is too large for that.
pub(super) fn tiles(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let map = FootMap::new(frame);
    let Some(tiling) = Tiling::new(&map, settings) else { return Ok(Vec::new()) };
    let full = map.draw(1.0, &mut Taken::default(), Numbers::All, settings)?;
    let mut leaves = Vec::new();
    for tile in tiling.used(&full) {
        leaves.push(tiling.leaf(tile, &full, &map.feet, settings)?);
    }
    Ok(leaves)
}

fn explained(
    map: &FootMap,
    tiling: Option<&Tiling>,
    settings: &SheetSettings,
) -> Result<String, TextError> {
    let format = settings.format();
    let [x, y] = map.middle.map(|c| format.length(c));
    let tiles = match tiling {
        Some(_) => settings.say(say::Join {})?,
        None => settings.say(say::TooLarge {})?,
    };
    Ok(format!("{tiles} {}", settings.say(say::Explained { x, y })?))
}

fn table(map: &FootMap, settings: &SheetSettings) -> Result<Table, TextError> {
    let format = settings.format();
    let row = |f: &Foot| {
        let (next, chord) = match f.next {
            Some(next) => (next.rod.to_string(), format.length(next.chord)),
            None => (String::new(), String::new()),
        };
        vec![
            f.rod.to_string(),
            f.end.letter().to_owned(),
            format.length(f.x),
            format.length(f.y),
            format.length(f.radius),
            format.heading(f.bearing),
            format.angle(f.elevation),
            format.heading(f.azimuth),
            format.angle(f.bevel),
            next,
            chord,
        ]
    };
    let columns = vec![
        Column::text(settings.say(say::Foot {})?),
        Column::text(settings.say(say::End {})?),
        Column::figure(settings.say(say::X {})?),
        Column::figure(settings.say(say::Y {})?),
        Column::figure(settings.say(say::Radius {})?),
        Column::figure(settings.say(say::Bearing {})?),
        Column::figure(settings.say(say::Elevation {})?),
        Column::figure(settings.say(say::Heading {})?),
        Column::figure(settings.say(say::Bevel {})?),
        Column::text(settings.say(say::Next {})?),
        Column::figure(settings.say(say::Chord {})?),
    ];
    Ok(Table { columns, rows: map.feet.iter().map(row).collect() })
}

/// The whole map in `room`, with the tiles; returns the height it takes.
fn small_map(
    out: &mut Drawing,
    map: &FootMap,
    tiling: Option<&Tiling>,
    room: Rect,
    settings: &SheetSettings,
) -> Result<f64, SheetError> {
    let ratio = |what: Rect, margin: f64| {
        (0..2).map(|i| what.size()[i] / (room.size()[i] - 2.0 * margin)).fold(0.0, f64::max)
    };
    let grid = tiling.map(Tiling::extent);
    let n = grid.map_or(0.0, |g| ratio(g, 0.0)).max(ratio(map.core(1.0), AROUND_SMALL)).max(1.0);
    let mut on_paper = map.core(n).inset(-AROUND_SMALL);
    if let Some(g) = grid {
        on_paper = on_paper.union(&Rect { min: g.min.map(|c| c / n), max: g.max.map(|c| c / n) });
    }
    let height = on_paper.height();
    let offset = [room.center()[0] - on_paper.center()[0], room.min[1] - on_paper.min[1]];
    let place = Placement::at(offset);
    let used = match tiling {
        Some(tiling) => {
            tiling.used(&map.draw(1.0, &mut Taken::default(), Numbers::All, settings)?)
        }
        None => Vec::new(),
    };
    let mut items: Vec<Item> = Vec::new();
    let mut taken = Taken::default();
    if let Some(tiling) = tiling {
        tiling.draw_grid(&mut items, n, &used);
        taken.lines = tiling.grid_lines(n);
    }
    // Always in small letters and arrows, even if the scale is 1:1.
    let small = map.draw(n.max(1.0 + f64::EPSILON), &mut taken, Numbers::WhereFree, settings)?;
    items.extend(small.items().cloned());
    if let Some(tiling) = tiling {
        tiling.draw_names(&mut items, n, &used, &taken.places)?;
    }
    out.place(&items, &place);
    Ok(height)
}

/// Column and row of a tile, from 0.
type Place = [usize; 2];

/// Tiles over the map.
struct Tiling {
    /// Top left corner of tile A1 on the map, mm.
    origin: Point,
    /// Width and height of a tile, mm.
    size: [f64; 2],
    /// Columns and rows.
    count: Place,
}

impl Tiling {
    /// Tiles that cover the map, which lies in their middle; none if it has no feet,
    /// or is too large.
    fn new(map: &FootMap, settings: &SheetSettings) -> Option<Self> {
        if map.feet.is_empty() || map.scale() > 1.0 {
            return None;
        }
        let (extent, size) = (map.extent(1.0), tile_area(settings).size());
        let count = [0, 1].map(|i| {
            let more = (extent.size()[i] - OVERLAP) / (size[i] - OVERLAP);
            more.ceil().max(1.0) as usize
        });
        let origin = [0, 1].map(|i| {
            let span = count[i] as f64 * (size[i] - OVERLAP) + OVERLAP;
            extent.center()[i] - span / 2.0
        });
        let tiling = Self { origin, size, count };
        // Blank tiles do not count: there are at most four tiles to a foot.
        (count[0] * count[1] <= MOST_TILES || map.feet.len() * 4 <= MOST_TILES).then_some(tiling)
    }

    /// The part of the map on a tile.
    fn rect(&self, place: Place) -> Rect {
        let at = |i: usize| self.origin[i] + place[i] as f64 * (self.size[i] - OVERLAP);
        Rect::new([at(0), at(1)], self.size)
    }

    /// All tiles together.
    fn extent(&self) -> Rect {
        self.rect([0, 0]).union(&self.rect(self.count.map(|c| c - 1)))
    }

    /// The tiles with anything but chords and words on them, row by row.
    fn used(&self, map: &Drawing) -> Vec<Place> {
        let marks = || map.layers.iter().filter(|l| l.name != CHORDS && l.name != NUMBERS);
        let holds =
            |place: &Place| marks().any(|layer| !clip(&layer.items, self.rect(*place)).is_empty());
        let all = (0..self.count[1]).flat_map(|row| (0..self.count[0]).map(move |c| [c, row]));
        all.filter(holds).collect()
    }

    fn leaf(
        &self,
        tile: Place,
        map: &Drawing,
        feet: &[Foot],
        settings: &SheetSettings,
    ) -> Result<Leaf, SheetError> {
        let (rect, area) = (self.rect(tile), tile_area(settings));
        let [width, height] = settings.paper.size();
        let mut drawing = Drawing::new(width, height);
        let place = Placement::at([area.min[0] - rect.min[0], area.min[1] - rect.min[1]]);
        for layer in &map.layers {
            let mut items = clip(&layer.items, rect);
            if layer.name == NUMBERS {
                items = whole_texts(&layer.items, feet, rect)?;
            }
            drawing.place(&items, &place);
        }
        drawing.rect(area.min, area.size(), Stroke::new(0.1).color(Color::GREY));
        let marks = area.inset(OVERLAP / 2.0);
        for [x, y] in corners(&marks) {
            drawing.line([x - CROP, y], [x + CROP, y], THIN);
            drawing.line([x, y - CROP], [x, y + CROP], THIN);
        }
        let base = area.min[1] - 2.2;
        drawing
            .text([area.min[0], base], 5.0, settings.say(say::Tile { tile: name(tile) })?)
            .bold();
        let around = self.neighbors(tile, settings)?;
        drawing.text([area.max[0], base], SMALL, around).end();
        let title = settings.say(say::TileTitle { tile: name(tile) })?;
        let stem = format!("support-map-{}", name(tile).to_lowercase());
        let listing = Listing {
            chapter: Some(settings.say(say::Tiles {})?),
            name: Some(settings.say(say::Tile { tile: name(tile) })?),
            label: Some(name(tile)),
        };
        Ok(Leaf { stem, title, scale: Some("1:1".to_owned()), drawing, listing })
    }

    /// Which tiles lie around.
    fn neighbors(&self, [c, r]: Place, settings: &SheetSettings) -> Result<String, TextError> {
        let mut parts = Vec::new();
        if r > 0 {
            parts.push(settings.say(say::Above { tile: name([c, r - 1]) })?);
        }
        if r + 1 < self.count[1] {
            parts.push(settings.say(say::Below { tile: name([c, r + 1]) })?);
        }
        if c > 0 {
            parts.push(settings.say(say::Left { tile: name([c - 1, r]) })?);
        }
        if c + 1 < self.count[0] {
            parts.push(settings.say(say::Right { tile: name([c + 1, r]) })?);
        }
        Ok(parts.join(" · "))
    }

    /// Where a tile lies on the map at 1:n, to the middle of its overlaps.
    fn cell(&self, place: Place, n: f64) -> Rect {
        let rect = self.rect(place).inset(OVERLAP / 2.0);
        Rect { min: rect.min.map(|c| c / n), max: rect.max.map(|c| c / n) }
    }

    /// The outlines of the tiles at 1:n; blank tiles are grey.
    fn draw_grid(&self, out: &mut impl Draw, n: f64, used: &[Place]) {
        let pen = Stroke::new(0.15).color(Color::GREY);
        for row in 0..self.count[1] {
            for column in 0..self.count[0] {
                let cell = self.cell([column, row], n);
                if used.contains(&[column, row]) {
                    out.rect(cell.min, cell.size(), pen);
                } else {
                    out.rect(cell.min, cell.size(), pen.fill(Color::PALE_GREY));
                }
            }
        }
    }

    /// The lines between the tiles at 1:n, and round them.
    fn grid_lines(&self, n: f64) -> Vec<[Point; 2]> {
        let all = self.cell([0, 0], n).union(&self.cell(self.count.map(|c| c - 1), n));
        let (low, high) = (all.min, all.max);
        let [columns, rows] = self.count;
        let upright = (0..columns).map(|c| self.cell([c, 0], n).min[0]).chain([high[0]]);
        let level = (0..rows).map(|r| self.cell([0, r], n).min[1]).chain([high[1]]);
        let upright = upright.map(|x| [[x, low[1]], [x, high[1]]]);
        upright.chain(level.map(|y| [[low[0], y], [high[0], y]])).collect()
    }

    /// The name of each printed tile in a corner that is free.
    fn draw_names(
        &self,
        out: &mut impl Draw,
        n: f64,
        used: &[Place],
        taken: &[Rect],
    ) -> Result<(), DrawingError> {
        for &tile in used {
            let cell = self.cell(tile, n);
            let (top, bottom) = (cell.min[1] + BODY + 0.6, cell.max[1] - 1.2);
            let (left, right) = (cell.min[0] + 1.2, cell.max[0] - 1.2);
            let corners = [(left, top), (right, top), (left, bottom), (right, bottom)];
            for (x, y) in corners {
                let mut text = Text::new([x, y], BODY, name(tile));
                text.bold().anchor(if x == left { Anchor::Start } else { Anchor::End });
                let extent = text.extent()?;
                if !taken.iter().any(|t| t.overlaps(&extent)) {
                    out.push(text);
                    break;
                }
            }
        }
        Ok(())
    }
}

/// The part of a page that shows the map.
fn tile_area(settings: &SheetSettings) -> Rect {
    let area = page::area(settings);
    Rect { min: [area.min[0], area.min[1] + NAME], ..area }
}

/// `A1`: column letter, row number.
fn name([column, row]: Place) -> String {
    format!("{}{}", crate::shop::letters(column, 'A'), row + 1)
}

fn corners(r: &Rect) -> [Point; 4] {
    [r.min, [r.max[0], r.min[1]], r.max, [r.min[0], r.max[1]]]
}

/// The texts of a tile, moved so that all of each is on it: the numbers of the feet
/// that stand on it, and other words that lie mostly on it.
fn whole_texts(items: &[Item], feet: &[Foot], rect: Rect) -> Result<Vec<Item>, DrawingError> {
    let mut kept = Vec::new();
    for item in items {
        let Item::Text(text) = item else { continue };
        let extent = text.extent()?;
        let foot = feet.iter().find(|f| f.rod.to_string() == text.string);
        let about = foot.map_or(extent.center(), |f| FootMap::place(f.x, f.y, 1.0));
        if rect.contains(about) {
            let shift = [0, 1].map(|i| {
                let (low, high) = (rect.min[i] + INSIDE, rect.max[i] - INSIDE);
                (low - extent.min[i]).max(0.0) + (high - extent.max[i]).min(0.0)
            });
            let at = [text.at[0] + shift[0], text.at[1] + shift[1]];
            kept.push(Text { at, ..text.clone() }.into());
        }
    }
    Ok(kept)
}
