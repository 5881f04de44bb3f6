//! Rod cards: for every rod its length, its marks at full size, and its partners.

use super::format::{angle, heading};
use super::page::{BODY, Flow, Leaf, SMALL, TABLE, THIN};
use super::strip::Strip;
use super::{PaperUnits, SheetError, SheetSettings};
use crate::drawing::font::{LEADING, elide, text_width};
use crate::drawing::{Anchor, Color, Draw, DrawingError, Item, Placement, Stroke, Weight};
use crate::frame::{End, Frame};
use crate::ids::RodId;
use crate::shop::lengths::are_mixed;
use crate::shop::{Foot, LengthClasses, Mark, Side, classes, feet, marks};
use std::collections::BTreeMap;

/// Font size of the rod's number, mm.
const NUMBER: f64 = 7.2;
/// Height of the line with number and length, mm.
const HEAD: f64 = 8.0;
/// Height of the line of a mark, mm.
const LINE: f64 = BODY * LEADING;
/// Space below a card, down to the line that parts it from the next, mm.
const BELOW: f64 = 1.6;
/// Cards at least so wide have the foot beside the marks, mm.
const FOOT_BESIDE: f64 = 165.0;

/// The pages of the rod cards.
pub(super) fn rod_cards(frame: &Frame, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "rod-cards", "Rod cards");
    let book = Book::new(frame, settings.units, flow.area().width());
    for rod in frame.rods.ids() {
        let card = book.card(rod)?;
        flow.need(card.height);
        let at = [flow.area().min[0], flow.y];
        flow.page().place(&card.items, &Placement::at(at));
        flow.skip(card.height);
    }
    Ok(flow.finish(None))
}

/// What all cards share.
pub(super) struct Book<'a> {
    frame: &'a Frame,
    classes: LengthClasses,
    feet: BTreeMap<RodId, Vec<Foot>>,
    /// Whether each card has to say how thick its rod is.
    mixed: bool,
    units: PaperUnits,
    width: f64,
}

/// A card, its top left corner at the origin.
pub(super) struct Card {
    pub items: Vec<Item>,
    pub height: f64,
}

impl<'a> Book<'a> {
    pub fn new(frame: &'a Frame, units: PaperUnits, width: f64) -> Self {
        let mut by_rod: BTreeMap<RodId, Vec<Foot>> = BTreeMap::new();
        for foot in feet(frame) {
            by_rod.entry(foot.rod).or_default().push(foot);
        }
        Self { frame, classes: classes(frame), feet: by_rod, mixed: are_mixed(frame), units, width }
    }

    /// The card of a rod.
    pub fn card(&self, rod: RodId) -> Result<Card, DrawingError> {
        let mut items = Vec::new();
        let marks = marks(self.frame, rod);
        let length = self.frame.rods[rod].axis.length();
        let strip = Strip::new(length, self.frame.rods[rod].diameters, &marks, self.width);
        self.head(&mut items, rod, &strip)?;
        let mut y = HEAD;
        strip.draw(&mut items, [0.0, y], &marks, self.units)?;
        y += strip.height() + 1.2;
        let top = y;
        self.lines(&mut items, y, &marks)?;
        y += LINE * marks.len() as f64;
        let feet = self.feet_of(rod);
        if self.width >= FOOT_BESIDE {
            items.text_lines([self.width, top + BODY], BODY, LINE, Anchor::End, &feet);
            y = y.max(top + LINE * feet.len() as f64);
        } else {
            items.text_lines([0.0, y + BODY], BODY, LINE, Anchor::Start, &feet);
            y += LINE * feet.len() as f64;
        }
        let rule = Stroke { color: Color::GREY, ..THIN };
        items.line([0.0, y + BELOW], [self.width, y + BELOW], rule);
        Ok(Card { items, height: y + 2.0 * BELOW })
    }

    fn head(&self, items: &mut Vec<Item>, rod: RodId, strip: &Strip) -> Result<(), DrawingError> {
        let class = self.classes.of(rod);
        let number = rod.to_string();
        let base = NUMBER * 0.85;
        let mut x = text_width(&number, NUMBER, Weight::Bold)? + 5.0;
        items.text([0.0, base], NUMBER, number).bold();
        let mut cut = format!("cut {}", self.units.measure(strip.length()));
        if self.mixed {
            cut = format!("{cut}, Ø {}", self.units.diameter(self.frame.rods[rod].diameters));
        }
        items.text([x, base], 5.0, cut.as_str()).bold();
        x += text_width(&cut, 5.0, Weight::Bold)? + 5.0;
        let same = class.rods.len();
        let others = if same == 1 { "alone".to_owned() } else { format!("1 of {same}") };
        let class = format!("class {} ({others})", class.name);
        x += text_width(&class, BODY, Weight::Regular)? + 3.0;
        items.text([x - 3.0, base], BODY, class).end();
        let scale = if strip.is_broken() { "strip broken: use the figures" } else { "strip 1:1" };
        let scale = elide(scale, SMALL, Weight::Regular, self.width - x)?;
        items.text([self.width, base], SMALL, scale).end();
        Ok(())
    }

    /// A line for every mark.
    fn lines(&self, items: &mut Vec<Item>, top: f64, marks: &[Mark]) -> Result<(), DrawingError> {
        let units = self.units;
        // Left ends of words and right ends of figures, mm.
        let [letter, at, side, partner, crossing, clock, ending] =
            [1.0, 22.0, 27.0, 34.0, 80.0, 105.0, 108.0];
        for (i, mark) in marks.iter().enumerate() {
            let y = top + BODY + LINE * i as f64;
            items.text([letter, y], BODY, mark.letter.as_str()).bold();
            items.text([at, y], BODY, units.length(mark.at)).bold().end();
            items.text([side, y], BODY, mark.side.letter()).bold();
            let distance = units.length(mark.at_partner);
            let text = format!("{} {} @ {distance}", mark.partner, mark.partner_letter);
            items.text([partner, y], BODY, text);
            items.text([crossing, y], BODY, angle(mark.angle)).end();
            items.text([clock, y], BODY, format!("clock {}", heading(mark.clock))).end();
            items.text([ending, y], SMALL, word(mark));
        }
        if marks.is_empty() {
            items.text([letter, top + TABLE], BODY, "no contacts");
        }
        Ok(())
    }

    /// What a rod that stands on the ground needs.
    fn feet_of(&self, rod: RodId) -> Vec<String> {
        let feet = self.feet.get(&rod).map_or(&[][..], Vec::as_slice);
        let lines = |foot: &Foot| {
            let end = match foot.end {
                End::A => "A",
                End::B => "B",
            };
            [
                format!("end {end} stands on the ground"),
                format!("elevation {}, heading {}", angle(foot.elevation), heading(foot.azimuth)),
                format!("saw end {end} at {} off square", angle(foot.bevel)),
            ]
        };
        feet.iter().flat_map(lines).collect()
    }
}
/// What becomes of a rod at a mark.
fn word(mark: &Mark) -> &'static str {
    match (mark.side, mark.ending) {
        (Side::Meets(End::A), _) => "meets its end A",
        (Side::Meets(End::B), _) => "meets its end B",
        (_, true) => "ends",
        (_, false) => "passes",
    }
}
