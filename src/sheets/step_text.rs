//! What is said beside the picture of a step.

use super::step_picture::{CLOSES, LIFTED};
use super::text::TextError;
use super::text::message::messages;
use super::{Format, SheetSettings};
use crate::frame::Frame;
use crate::ids::{ContactId, PropId, RodId};
use crate::shop::order::{Assembly, Check, Lift, Order, Prop, Step};
use crate::shop::{LengthClasses, Side, marks};
use std::collections::BTreeMap;

messages! {
    mod say in "steps.toml" {
        "title" => Title {}
        "crown" => Crown { steps: usize }
        "ground" => Ground { steps: usize, props: usize, most: usize }
        "guide" => Guide { lifted: String, closes: String }
        "step" => StepTitle { number: usize, count: usize, unit: String }
        "part" => PartFacts { class: String, length: String }
        "over" => Over { mark: String, rod: String, mate: String }
        "under" => Under { mark: String, rod: String, mate: String }
        "meets" => Meets { mark: String, rod: String, end: String }
        "turned" => Turned { angle: String, right: bool }
        "set" => Set { prop: String, rod: String, distance: String, height: String }
        "lift" => Lifted { rods: String, count: usize, below: String }
        "closing" => Closing { rod: String, units: String, count: usize }
        "tie" => Tie { contacts: String, count: usize }
        "tied" => Tied { mark: String, over: String, under: String }
        "take-away" => TakeAway { props: String, count: usize }
        "check" => Checked {
            rod: String, mark: String, other: String, other_mark: String, distance: String,
        }
    }
}

/// How steps are read, above the first of them.
pub(super) fn guide(
    assembly: &Assembly,
    settings: &SheetSettings,
) -> Result<[String; 2], TextError> {
    let steps = assembly.steps.len();
    let order = match assembly.order {
        Order::Crown => settings.say(say::Crown { steps })?,
        Order::Ground => {
            let (props, most) = (assembly.props(), assembly.most_props());
            settings.say(say::Ground { steps, props, most })?
        }
    };
    let [lifted, closes] = [LIFTED, CLOSES].map(str::to_owned);
    Ok([order, settings.say(say::Guide { lifted, closes })?])
}

/// A new rod, and what it meets.
pub(super) struct Part {
    /// Its number, with a sign if it closes a circuit.
    pub number: String,
    /// Class and length.
    pub facts: String,
    /// What it meets of the rods that lie already.
    pub contacts: String,
}

/// What is said of a step.
pub(super) struct StepText {
    /// Its number.
    pub title: String,
    /// The new rods, in the order in which they are laid.
    pub parts: Vec<Part>,
    /// What to do besides, a sentence each.
    pub notes: Vec<String>,
}

/// What all steps share.
pub(super) struct Writer<'a> {
    pub frame: &'a Frame,
    pub classes: &'a LengthClasses,
    pub settings: &'a SheetSettings,
    pub count: usize,
}

impl Writer<'_> {
    fn format(&self) -> Format {
        self.settings.format()
    }

    /// What is said of a step; `walk` is how far the view is turned from that of the step
    /// before, degrees.
    pub fn step(&self, number: usize, step: &Step, walk: f64) -> Result<StepText, TextError> {
        let unit = step.unit.map_or_else(String::new, |unit| unit.to_string());
        let title = say::StepTitle { number: number + 1, count: self.count, unit };
        let parts = step.rods.iter().map(|&rod| self.part(step, rod)).collect::<Result<_, _>>()?;
        let mut notes = Vec::new();
        notes.extend(self.turned(walk)?);
        for prop in &step.props {
            notes.push(self.set(prop)?);
        }
        notes.extend(self.lifted(&step.lifts)?);
        notes.extend(self.closing(step)?);
        notes.extend(self.ties(&step.ties)?);
        notes.extend(self.taken_away(&step.remove_props)?);
        for check in &step.checks {
            notes.push(self.check(check)?);
        }
        Ok(StepText { title: self.settings.say(title)?, parts, notes })
    }

    fn part(&self, step: &Step, rod: RodId) -> Result<Part, TextError> {
        let closes = step.closes.iter().any(|c| c.rod == rod);
        let class = self.classes.of(rod);
        let place = |r: RodId| step.rods.iter().position(|&other| other == r);
        let made =
            |contact: ContactId| step.over.contains(&contact) || step.under.contains(&contact);
        // Rods of this step that come later say it for both.
        let earlier = |partner: RodId| place(partner) < place(rod);
        let mut met = Vec::new();
        for it in marks(self.frame, rod) {
            if !(made(it.contact) && earlier(it.partner)) {
                continue;
            }
            let (mark, rod, mate) = (it.letter, it.partner.to_string(), it.partner_letter);
            met.push(match it.side {
                Side::Over => self.settings.say(say::Over { mark, rod, mate })?,
                Side::Under => self.settings.say(say::Under { mark, rod, mate })?,
                Side::Meets(end) => {
                    let end = end.letter().to_owned();
                    self.settings.say(say::Meets { mark, rod, end })?
                }
            });
        }
        let length = self.format().measure(class.length);
        Ok(Part {
            number: format!("{rod}{}", if closes { CLOSES } else { "" }),
            facts: self.settings.say(say::PartFacts { class: class.name.clone(), length })?,
            contacts: met.join(", "),
        })
    }

    fn set(&self, prop: &Prop) -> Result<String, TextError> {
        self.settings.say(say::Set {
            prop: prop.id.to_string(),
            rod: prop.rod.to_string(),
            distance: self.format().measure(prop.at),
            height: self.format().measure(prop.height),
        })
    }

    fn ties(&self, ties: &[ContactId]) -> Result<Option<String>, TextError> {
        let mut names = Vec::new();
        for &contact in ties {
            let c = &self.frame.contacts[contact];
            let marks = marks(self.frame, c.over);
            let mark = marks.iter().find(|m| m.contact == contact);
            let mark = mark.map_or_else(String::new, |m| m.letter.clone());
            let (over, under) = (c.over.to_string(), c.under.to_string());
            names.push(self.settings.say(say::Tied { mark, over, under })?);
        }
        let tie = say::Tie { contacts: names.join(", "), count: names.len() };
        (!names.is_empty()).then(|| self.settings.say(tie)).transpose()
    }

    fn check(&self, check: &Check) -> Result<String, TextError> {
        let [from, to] = &check.marks;
        self.settings.say(say::Checked {
            rod: from.rod.to_string(),
            mark: from.mark.clone(),
            other: to.rod.to_string(),
            other_mark: to.mark.clone(),
            distance: self.format().measure(check.distance),
        })
    }

    fn turned(&self, walk: f64) -> Result<Option<String>, TextError> {
        let angle = format!("{:.0}°", walk.abs());
        let turned = say::Turned { angle, right: walk > 0.0 };
        (walk != 0.0).then(|| self.settings.say(turned)).transpose()
    }

    /// Which rods to lift for which.
    fn lifted(&self, lifts: &[Lift]) -> Result<Vec<String>, TextError> {
        let mut by_rod: BTreeMap<usize, (RodId, Vec<String>)> = BTreeMap::new();
        for (i, lift) in lifts.iter().enumerate() {
            let first = lifts.iter().position(|other| other.below == lift.below).unwrap_or(i);
            by_rod.entry(first).or_insert((lift.below, Vec::new())).1.push(lift.rod.to_string());
        }
        let sentence = |(below, rods): &(RodId, Vec<String>)| {
            let (count, rods) = (rods.len(), rods.join(", "));
            self.settings.say(say::Lifted { rods, count, below: below.to_string() })
        };
        by_rod.values().map(sentence).collect()
    }

    fn closing(&self, step: &Step) -> Result<Vec<String>, TextError> {
        let mut by_rod: BTreeMap<RodId, Vec<String>> = BTreeMap::new();
        for closing in &step.closes {
            by_rod.entry(closing.rod).or_default().push(closing.unit.to_string());
        }
        let sentence = |(rod, units): (&RodId, &Vec<String>)| {
            let rod = format!("{rod}{CLOSES}");
            self.settings.say(say::Closing { rod, count: units.len(), units: units.join(", ") })
        };
        by_rod.iter().map(sentence).collect()
    }

    fn taken_away(&self, props: &[PropId]) -> Result<Option<String>, TextError> {
        let names: Vec<String> = props.iter().map(PropId::to_string).collect();
        let away = say::TakeAway { props: names.join(", "), count: names.len() };
        (!names.is_empty()).then(|| self.settings.say(away)).transpose()
    }
}
