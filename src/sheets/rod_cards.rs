//! Rod cards: for every rod its length, its marks at full size, and its partners.

use super::page::{BODY, Flow, Leaf, SMALL, TABLE, THIN};
use super::strip::Strip;
use super::text::TextError;
use super::text::message::messages;
use super::{SheetError, SheetSettings};
use crate::drawing::font::{LEADING, elide, text_width};
use crate::drawing::{Anchor, Color, Draw, Item, Placement, Stroke, Weight};
use crate::frame::Frame;
use crate::ids::RodId;
use crate::shop::lengths::are_mixed;
use crate::shop::{Foot, LengthClasses, Mark, Side, classes, feet, marks};
use std::collections::BTreeMap;

messages! {
    mod say in "rod-cards.toml" {
        "title" => Title {}
        "range" => Range { first: String, last: String }
        "cut" => Cut { length: String, diameter: String, sawn: bool }
        "class" => Class { name: String, count: usize }
        "strip-broken" => StripBroken {}
        "strip-full" => StripFull {}
        "clock" => Clock { angle: String }
        "meets" => Meets { end: String }
        "ends" => Ends {}
        "passes" => Passes {}
        "no-contacts" => NoContacts {}
        "foot-end" => FootEnd { end: String }
        "foot-angles" => FootAngles { elevation: String, heading: String }
        "foot-bevel" => FootBevel { end: String, angle: String }
    }
}

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
    let mut flow = Flow::new(settings, "rod-cards", &settings.say(say::Title {})?);
    let book = Book::new(frame, settings, flow.area().width());
    // The first and the last rod of each page.
    let mut ranges: Vec<[RodId; 2]> = Vec::new();
    for rod in frame.rods.ids() {
        let card = book.card(rod)?;
        flow.need(card.height);
        ranges.resize(flow.count(), [rod; 2]);
        if let Some(range) = ranges.last_mut() {
            range[1] = rod;
        }
        let at = [flow.area().min[0], flow.y];
        flow.page().place(&card.items, &Placement::at(at));
        flow.skip(card.height);
    }
    let mut leaves = flow.finish(None);
    for (leaf, range) in leaves.iter_mut().zip(ranges) {
        let [first, last] = range.map(|rod| rod.to_string());
        if leaf.listing.chapter.is_some() {
            leaf.listing.name = Some(settings.say(say::Range { first, last })?);
        }
    }
    Ok(leaves)
}

/// What all cards share.
pub(super) struct Book<'a> {
    frame: &'a Frame,
    classes: LengthClasses,
    feet: BTreeMap<RodId, Vec<Foot>>,
    /// Whether each card has to say how thick its rod is.
    mixed: bool,
    settings: &'a SheetSettings,
    width: f64,
}

/// A card, its top left corner at the origin.
pub(super) struct Card {
    pub items: Vec<Item>,
    pub height: f64,
}

impl<'a> Book<'a> {
    pub fn new(frame: &'a Frame, settings: &'a SheetSettings, width: f64) -> Self {
        let mut by_rod: BTreeMap<RodId, Vec<Foot>> = BTreeMap::new();
        for foot in feet(frame) {
            by_rod.entry(foot.rod).or_default().push(foot);
        }
        Self {
            frame,
            classes: classes(frame),
            feet: by_rod,
            mixed: are_mixed(frame),
            settings,
            width,
        }
    }

    /// The card of a rod.
    pub fn card(&self, rod: RodId) -> Result<Card, SheetError> {
        let mut items = Vec::new();
        let marks = marks(self.frame, rod);
        let length = self.frame.rods[rod].axis.length();
        let strip = Strip::new(length, self.frame.rods[rod].diameters, &marks, self.width);
        self.head(&mut items, rod, &strip)?;
        let mut y = HEAD;
        strip.draw(&mut items, [0.0, y], &marks, self.settings)?;
        y += strip.height() + 1.2;
        let top = y;
        self.lines(&mut items, y, &marks)?;
        y += LINE * marks.len() as f64;
        let feet = self.feet_of(rod)?;
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

    fn head(&self, items: &mut Vec<Item>, rod: RodId, strip: &Strip) -> Result<(), SheetError> {
        let class = self.classes.of(rod);
        let number = rod.to_string();
        let base = NUMBER * 0.85;
        let mut x = text_width(&number, NUMBER, Weight::Bold)? + 5.0;
        items.text([0.0, base], NUMBER, number).bold();
        let (settings, format) = (self.settings, self.settings.format());
        let diameter = match self.mixed {
            true => format.diameter(self.frame.rods[rod].diameters),
            false => String::new(),
        };
        let (length, sawn) = (format.measure(strip.length()), settings.sawn.contains(&rod));
        let cut = settings.say(say::Cut { length, diameter, sawn })?;
        items.text([x, base], 5.0, cut.as_str()).bold();
        x += text_width(&cut, 5.0, Weight::Bold)? + 5.0;
        let class =
            settings.say(say::Class { name: class.name.clone(), count: class.rods.len() })?;
        x += text_width(&class, BODY, Weight::Regular)? + 3.0;
        items.text([x - 3.0, base], BODY, class).end();
        let scale = match strip.is_broken() {
            true => settings.say(say::StripBroken {})?,
            false => settings.say(say::StripFull {})?,
        };
        let scale = elide(&scale, SMALL, Weight::Regular, self.width - x)?;
        items.text([self.width, base], SMALL, scale).end();
        Ok(())
    }

    /// A line for every mark.
    fn lines(&self, items: &mut Vec<Item>, top: f64, marks: &[Mark]) -> Result<(), SheetError> {
        let (settings, format) = (self.settings, self.settings.format());
        // Left ends of words and right ends of figures, mm.
        let [letter, at, side, partner, crossing, clock, ending] =
            [1.0, 22.0, 27.0, 34.0, 80.0, 105.0, 108.0];
        for (i, mark) in marks.iter().enumerate() {
            let y = top + BODY + LINE * i as f64;
            items.text([letter, y], BODY, mark.letter.as_str()).bold();
            items.text([at, y], BODY, format.length(mark.at)).bold().end();
            items.text([side, y], BODY, mark.side.letter()).bold();
            let distance = format.length(mark.at_partner);
            let text = format!("{} {} @ {distance}", mark.partner, mark.partner_letter);
            items.text([partner, y], BODY, text);
            items.text([crossing, y], BODY, format.angle(mark.angle)).end();
            let angle = settings.say(say::Clock { angle: format.heading(mark.clock) })?;
            items.text([clock, y], BODY, angle).end();
            items.text([ending, y], SMALL, word(mark, settings)?);
        }
        if marks.is_empty() {
            items.text([letter, top + TABLE], BODY, settings.say(say::NoContacts {})?);
        }
        Ok(())
    }

    /// What a rod that stands on the ground needs.
    pub fn feet_of(&self, rod: RodId) -> Result<Vec<String>, TextError> {
        let (settings, format) = (self.settings, self.settings.format());
        let feet = self.feet.get(&rod).map_or(&[][..], Vec::as_slice);
        let lines = |foot: &Foot| {
            let end = foot.end.letter().to_owned();
            let elevation = format.angle(foot.elevation);
            let heading = format.heading(foot.azimuth);
            let angle = format.angle(foot.bevel);
            Ok([
                settings.say(say::FootEnd { end: end.clone() })?,
                settings.say(say::FootAngles { elevation, heading })?,
                settings.say(say::FootBevel { end, angle })?,
            ])
        };
        let lines: Vec<[String; 3]> = feet.iter().map(lines).collect::<Result<_, TextError>>()?;
        Ok(lines.into_iter().flatten().collect())
    }
}

/// What becomes of a rod at a mark.
pub(super) fn word(mark: &Mark, settings: &SheetSettings) -> Result<String, TextError> {
    match (mark.side, mark.ending) {
        (Side::Meets(end), _) => settings.say(say::Meets { end: end.letter().to_owned() }),
        (_, true) => settings.say(say::Ends {}),
        (_, false) => settings.say(say::Passes {}),
    }
}
