//! The map of the feet, seen from above, at full size: to be laid on the ground.

use super::page::{BODY, SMALL, TITLE};
use super::support_tiles;
use super::text::TextError;
use super::text::message::messages;
use super::{Format, PaperUnits, Sheet, SheetError, SheetSettings, page};
use crate::drawing::font::text_width;
use crate::drawing::{Color, Dash, Draw, Drawing, Placement, crosses};
use crate::drawing::{Point, Rect, Stroke, Text, Weight};
use crate::frame::Frame;
use crate::shop::feet::middle;
use crate::shop::{Foot, feet};
use crate::units::MM_PER_INCH;

messages! {
    mod say in "support-map.toml" {
        "title" => Title { model: String }
        "facts" => Facts { scale: String, diameters: String }
        "no-feet" => NoFeet {}
        "x-axis" => XAxis {}
        "y-axis" => YAxis {}
        "middle" => Middle {}
    }
}

/// Room round the outermost feet for arrows and numbers, mm on paper.
const AROUND: f64 = 25.0;
/// Longest side that is drawn at full size, mm; PDF and its readers end at 5080.
const LONGEST_SIDE: f64 = 4800.0;
/// Room for the title above the map, mm.
const ABOVE: f64 = 20.0;
/// Room for the scale bar below the map, mm.
const BELOW: f64 = 15.0;
/// Lengths of the scale bar, mm on paper: 100 mm, or 4 in.
const BAR: f64 = 100.0;
const BAR_INCH: f64 = 4.0 * MM_PER_INCH;
/// How far the cross of a foot sticks out of its circle, mm.
const CROSS: f64 = 3.0;
/// Font size of the number of a foot, mm.
const NUMBER: f64 = 4.0;
/// Length of the arrow that shows where a rod heads, mm.
const ARROW: f64 = 12.0;
/// Half the size of the cross at the model's middle, mm.
const MIDDLE: f64 = 8.0;
/// Length of the arrows of the axes at the middle, mm.
const AXES: f64 = 22.0;

/// Layer of chords between neighbouring feet.
pub(super) const CHORDS: &str = "chords";
/// Layer of the circles of the feet, as wide as the rods.
const FEET: &str = "feet";
/// Layer of the crosses on the centres of the feet.
const CENTRES: &str = "centres";
/// Layer of arrows that show where the rods head.
const HEADINGS: &str = "headings";
/// Layer of the model's middle and its axes.
const MIDDLE_LAYER: &str = "middle";
/// Layer of the numbers of the feet and the words at the middle.
pub(super) const NUMBERS: &str = "numbers";
/// Layer of the title and the scale bar.
const TITLE_LAYER: &str = "title";

/// What is said where nothing stands on the ground.
pub(super) fn no_feet(settings: &SheetSettings) -> Result<String, TextError> {
    settings.say(say::NoFeet {})
}

/// The whole map on one sheet, at full size: circles are as wide as the rods. A
/// footprint too large for one sheet is drawn at a stated smaller scale.
///
/// # Errors
/// [`SheetError::Drawing`] if the frame holds numbers that are not finite.
pub fn drawing(frame: &Frame, settings: &SheetSettings) -> Result<Drawing, SheetError> {
    let map = FootMap::new(frame);
    let n = map.scale();
    Ok(sheet(frame, &map, n, settings)?.0)
}

/// The same at full size however large it is, for CAD files, and where on it the model's
/// origin lies.
///
/// # Errors
/// As [`drawing`].
pub fn full_size(frame: &Frame, settings: &SheetSettings) -> Result<(Drawing, Point), SheetError> {
    sheet(frame, &FootMap::new(frame), 1.0, settings)
}

/// The map at 1:n with its title and scale bar, and where the model's origin lies on it.
fn sheet(
    frame: &Frame,
    map: &FootMap,
    n: f64,
    settings: &SheetSettings,
) -> Result<(Drawing, Point), SheetError> {
    let settings = settings.checked()?;
    let extent = map.extent(n);
    let format = settings.format();
    let title = settings.say(say::Title { model: settings.model.clone() })?;
    let diameters = format.diameters(frame);
    let facts = settings.say(say::Facts { scale: format.plain(n), diameters })?;
    let words =
        text_width(&title, TITLE, Weight::Bold)?.max(text_width(&facts, BODY, Weight::Regular)?);
    let words = if map.feet.is_empty() { words.max(NO_FEET_WIDTH) } else { words };
    let width = extent.width().max(words + 20.0).max(BAR + 40.0);
    let mut sheet = Drawing::new(width, extent.height() + ABOVE + BELOW);
    let origin = [width / 2.0 - extent.center()[0], ABOVE - extent.min[1]];
    let drawn = map.draw(n, &mut Taken::default(), Numbers::All, &settings)?;
    sheet.place_drawing(&drawn, &Placement::at(origin));
    let top = sheet.layer(TITLE_LAYER);
    top.text([10.0, 10.0], TITLE, title).bold();
    top.text([10.0, 15.5], BODY, facts);
    if map.feet.is_empty() {
        let lines =
            crate::drawing::font::wrap(&no_feet(&settings)?, BODY, Weight::Regular, width - 20.0)?;
        top.text_lines([10.0, 24.0], BODY, BODY * 1.3, Default::default(), lines);
    }
    scale_bar(top, [10.0, ABOVE + extent.height() + 4.0], n, format);
    Ok((sheet, origin))
}

/// Least width of the sheet where it only says that there are no feet, mm.
const NO_FEET_WIDTH: f64 = 150.0;

/// The pages of support-map.pdf: an overview with all figures, then the tiles at
/// full size, to be joined.
///
/// # Errors
/// As [`sheets`](super::sheets).
pub fn pages(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Sheet>, SheetError> {
    let settings = settings.checked()?;
    let mut leaves = support_tiles::overview(frame, &settings)?;
    leaves.extend(support_tiles::tiles(frame, &settings)?);
    page::stamp(leaves, &settings.format().diameters(frame), &settings)
}

/// Height of a scale bar, mm.
pub(super) const SCALE_BAR_HEIGHT: f64 = 4.0;

/// A bar that is 100 mm or 4 in long on paper, and what it stands for.
pub(super) fn scale_bar(out: &mut impl Draw, [x, y]: Point, n: f64, format: Format) {
    let pen = Stroke::new(0.3);
    let bar = match format.units {
        PaperUnits::Mm => BAR,
        _ => BAR_INCH,
    };
    out.line([x, y], [x + bar, y], pen);
    for end in [x, x + bar] {
        let half = SCALE_BAR_HEIGHT / 2.0;
        out.line([end, y - half], [end, y + half], pen);
    }
    out.text([x + bar + 3.0, y], BODY, format.measure(bar * n)).vcenter();
}

/// Which feet get their number printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Numbers {
    /// All of them.
    All,
    /// Those whose number finds room.
    WhereFree,
}

/// What numbers keep clear of, on paper.
#[derive(Default)]
pub(super) struct Taken {
    /// Places that nothing else may be on.
    pub places: Vec<Rect>,
    /// Lines that are crossed only where there is no other room.
    pub lines: Vec<[Point; 2]>,
}

impl Taken {
    fn holds(&self, place: &Rect) -> bool {
        self.places.iter().any(|taken| taken.overlaps(place))
    }

    fn is_crossed(&self, place: &Rect) -> bool {
        self.lines.iter().any(|&line| crosses(line, place.inset(-BESIDE)))
    }
}

/// The feet and what their map is drawn from.
pub(super) struct FootMap {
    pub feet: Vec<Foot>,
    pub middle: [f64; 2],
}

impl FootMap {
    pub fn new(frame: &Frame) -> Self {
        let middle = if frame.rods.is_empty() { [0.0; 2] } else { middle(frame) };
        Self { feet: feet(frame), middle }
    }

    /// n of the scale 1:n at which the map fits one sheet: 1, unless it is too large.
    pub fn scale(&self) -> f64 {
        let fits = |n: &f64| self.extent(*n).size().iter().all(|&side| side <= LONGEST_SIDE);
        [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0].into_iter().find(fits).unwrap_or(1000.0)
    }

    /// Where a point of the ground lies on paper, mm, y down.
    pub fn place(x: f64, y: f64, n: f64) -> Point {
        [x / n, -y / n]
    }

    /// The part of the paper that the map takes, with room for arrows and numbers.
    pub fn extent(&self, n: f64) -> Rect {
        self.core(n).inset(-AROUND)
    }

    /// The smallest rectangle round all feet and the middle, mm on paper.
    pub fn core(&self, n: f64) -> Rect {
        let feet = self.feet.iter().map(|f| Self::place(f.x, f.y, n));
        let middle = Self::place(self.middle[0], self.middle[1], n);
        Rect::around(feet.chain([middle])).unwrap_or(Rect::new(middle, [0.0; 2]))
    }

    /// The map at 1:n in paper coordinates. `taken` is what numbers keep clear of; what the
    /// map takes is added.
    pub fn draw(
        &self,
        n: f64,
        taken: &mut Taken,
        numbers: Numbers,
        settings: &SheetSettings,
    ) -> Result<Drawing, SheetError> {
        let mut map = Drawing::new(1.0, 1.0);
        let at = |f: &Foot| Self::place(f.x, f.y, n);
        let chord = Stroke::new(0.15).color(Color::GREY).dash(Dash::DASH_DOT);
        let guides = map.layer(CHORDS);
        for (i, foot) in self.feet.iter().enumerate() {
            // With two feet both chords are the same.
            if let Some(next) = foot.next.filter(|next| self.feet.len() > 2 || next.index > i) {
                let ends = [at(foot), at(&self.feet[next.index])];
                guides.line(ends[0], ends[1], chord);
                taken.lines.push(ends);
            }
        }
        let radius = |foot: &Foot| foot.diameter / 2.0 / n;
        let small = n > 1.0;
        for foot in &self.feet {
            let radius = radius(foot);
            draw_foot(&mut map, foot, at(foot), radius, small);
            taken.places.push(Rect::new(at(foot), [0.0; 2]).inset(-reach(radius, small)));
            taken.places.push(arrow_box(foot, at(foot), radius, small));
        }
        if !self.feet.is_empty() {
            self.draw_middle(&mut map, n, &mut taken.places, settings)?;
        }
        for foot in &self.feet {
            let size = if small { SMALL } else { NUMBER };
            let radius = reach(radius(foot), small);
            if let Some(text) = number(foot, at(foot), radius, size, taken, numbers)? {
                taken.places.push(text.extent()?);
                map.layer(NUMBERS).push(text);
            }
        }
        Ok(map)
    }

    /// A cross at the model's middle, with the headings 0° and 90°.
    fn draw_middle(
        &self,
        map: &mut Drawing,
        n: f64,
        taken: &mut Vec<Rect>,
        settings: &SheetSettings,
    ) -> Result<(), SheetError> {
        let [x, y] = Self::place(self.middle[0], self.middle[1], n);
        let length = if n > 1.0 { AXES / 2.0 } else { AXES };
        let cross = if n > 1.0 { MIDDLE / 2.0 } else { MIDDLE };
        let pen = Stroke::new(0.25);
        let lines = map.layer(MIDDLE_LAYER);
        lines.line([x - cross, y], [x + cross, y], pen);
        lines.line([x, y - cross], [x, y + cross], pen);
        lines.circle([x, y], cross / 4.0, pen);
        lines.arrow([x, y], [x + length, y], 2.5, pen);
        lines.arrow([x, y], [x, y - length], 2.5, pen);
        taken.push(Rect::new([x, y - length], [length, length]).inset(-1.0));
        let texts = map.layer(NUMBERS);
        let words = [
            settings.say(say::XAxis {})?,
            settings.say(say::YAxis {})?,
            settings.say(say::Middle {})?,
        ];
        let [zero, quarter, name] = words;
        let zero = texts.text([x + length + 1.0, y], SMALL, zero).vcenter().clone();
        let quarter = texts.text([x, y - length - 1.5], SMALL, quarter).middle().clone();
        let name = texts.text([x, y + cross + SMALL + 0.8], SMALL, name).middle().clone();
        for text in [zero, quarter, name] {
            taken.push(text.extent()?);
        }
        Ok(())
    }
}

/// Circle, centre cross and arrow of a foot.
fn draw_foot(map: &mut Drawing, foot: &Foot, [x, y]: Point, radius: f64, small: bool) {
    let pen = Stroke::new(0.2);
    map.layer(FEET).circle([x, y], radius, Stroke::new(0.25));
    let reach = reach(radius, small);
    let centres = map.layer(CENTRES);
    centres.line([x - reach, y], [x + reach, y], pen);
    centres.line([x, y - reach], [x, y + reach], pen);
    let (from, to) = arrow(foot, [x, y], radius, small);
    map.layer(HEADINGS).arrow(from, to, if small { 1.6 } else { 2.6 }, Stroke::new(0.3));
}

/// Half the size of the cross of a foot, mm.
fn reach(radius: f64, small: bool) -> f64 {
    radius + if small { 1.0 } else { CROSS }
}

/// From the circle on, the way the rod heads; y down.
fn arrow(foot: &Foot, [x, y]: Point, radius: f64, small: bool) -> (Point, Point) {
    let (sin, cos) = foot.azimuth.sin_cos();
    let length = if small { ARROW / 2.0 } else { ARROW };
    let at = |d: f64| [x + cos * d, y - sin * d];
    (at(radius), at(radius + length))
}

fn arrow_box(foot: &Foot, at: Point, radius: f64, small: bool) -> Rect {
    let (a, b) = arrow(foot, at, radius, small);
    Rect::around([a, b]).unwrap_or(Rect::new(at, [0.0; 2])).inset(-0.5)
}

/// How far round a number may stand from where it should, in eighths of a turn.
const TURNS: [f64; 8] = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0];
/// How far out a number may be pushed, mm.
const STEPS: [f64; 4] = [0.0, 5.0, 10.0, 15.0];
/// How many of these steps a number goes rather than lie on a line.
const STEPS_OFF_LINES: usize = 2;
/// Least distance of a number from a line, mm.
const BESIDE: f64 = 0.4;

/// The number of a foot beside its circle: behind the rod if there is room.
fn number(
    foot: &Foot,
    at: Point,
    radius: f64,
    size: f64,
    taken: &Taken,
    numbers: Numbers,
) -> Result<Option<Text>, SheetError> {
    let steps = match numbers {
        Numbers::All => &STEPS[..],
        Numbers::WhereFree => &STEPS[..1],
    };
    let off_lines = &steps[..steps.len().min(STEPS_OFF_LINES)];
    for (steps, off_lines) in [(off_lines, true), (steps, false)] {
        for step in steps {
            for turn in TURNS {
                let text = number_at(foot, at, radius + step, turn, size)?;
                let extent = text.extent()?;
                let is_taken = taken.holds(&extent) || (off_lines && taken.is_crossed(&extent));
                if !is_taken {
                    return Ok(Some(text));
                }
            }
        }
    }
    Ok(match numbers {
        Numbers::All => Some(number_at(foot, at, radius, 0.0, size)?),
        Numbers::WhereFree => None,
    })
}

/// The number of a foot, `reach` from its centre and turned by eighths from behind the rod.
fn number_at(
    foot: &Foot,
    [x, y]: Point,
    reach: f64,
    turn: f64,
    size: f64,
) -> Result<Text, SheetError> {
    let angle = foot.azimuth + std::f64::consts::PI * (1.0 + turn / 4.0);
    let (sin, cos) = angle.sin_cos();
    let mut text = Text::new([0.0, 0.0], size, foot.rod.to_string());
    text.middle().vcenter();
    let half = text.extent()?.size().map(|s| s / 2.0);
    let reach = reach + 0.6 + cos.abs() * half[0] + sin.abs() * half[1];
    text.at = [text.at[0] + x + cos * reach, text.at[1] + y - sin * reach];
    Ok(text)
}
