//! What the page shows, as its scripts read it: figures in words, places in mm.

use super::say;
use super::words::words;
use crate::frame::Frame;
use crate::ids::{Id, IdVec, RodId, UnitId};
use crate::sheets::rod_cards::{self, Book};
use crate::sheets::step_text::{Writer, guide};
use crate::sheets::text::TextError;
use crate::sheets::{SheetError, SheetSettings};
use crate::shop::order::{Assembly, Prop};
use crate::shop::{LengthClasses, Mark, classes, marks};
use crate::surface::Point3;
use serde::Serialize;
use std::collections::BTreeMap;

/// The whole data. Rods, steps and units refer to one another by place in their list.
#[derive(Serialize)]
pub(super) struct Data {
    format: &'static str,
    version: u32,
    model: String,
    words: BTreeMap<&'static str, String>,
    /// Height of the ground, mm.
    ground: f64,
    rods: Vec<RodData>,
    units: Vec<UnitData>,
    /// Where rods stand on the ground, mm.
    feet: Vec<[f64; 3]>,
    /// How steps are read.
    guide: Vec<String>,
    steps: Vec<StepData>,
}

#[derive(Serialize)]
struct RodData {
    id: String,
    a: [f64; 3],
    b: [f64; 3],
    /// Diameters at A and B, mm.
    d: [f64; 2],
    /// Cut length, in words.
    cut: String,
    diameter: String,
    /// The class in words, and its place.
    class: String,
    k: usize,
    border: bool,
    /// The step that places it, in words, and its place.
    placed: Option<String>,
    step: Option<usize>,
    marks: Vec<MarkData>,
    /// What its foot needs, a line each.
    foot: Vec<String>,
}

#[derive(Serialize)]
struct MarkData {
    contact: String,
    letter: String,
    /// Distance from end A: as printed, and mm.
    at: String,
    x: f64,
    side: &'static str,
    /// Place of the partner, and its mark and distance as printed.
    mate: usize,
    text: String,
    angle: String,
    clock: String,
    word: String,
}

#[derive(Serialize)]
struct UnitData {
    id: String,
    rods: Vec<usize>,
}

#[derive(Serialize)]
struct StepData {
    title: String,
    rods: Vec<usize>,
    /// The new rods: number, class and length, what they meet.
    parts: Vec<[String; 3]>,
    notes: Vec<String>,
    /// Props that stand while the step is done.
    props: Vec<PropData>,
}

#[derive(Serialize)]
struct PropData {
    id: String,
    point: [f64; 3],
    height: f64,
}

/// Reads the data off the frame and its steps.
pub(super) fn data(
    frame: &Frame,
    assembly: Option<&Assembly>,
    settings: &SheetSettings,
) -> Result<Data, SheetError> {
    let classes = classes(frame);
    let mut step_of: IdVec<RodId, Option<usize>> = vec![None; frame.rods.len()].into();
    for (n, step) in assembly.iter().flat_map(|a| a.steps.iter().enumerate()) {
        step.rods.iter().for_each(|&rod| step_of[rod] = Some(n));
    }
    let cards = Cards { frame, classes: &classes, settings, book: Book::new(frame, settings, 0.0) };
    let rods: Result<_, TextError> =
        frame.rods.ids().map(|rod| cards.rod(rod, step_of[rod])).collect();
    let unit = |id: UnitId| UnitData { id: id.to_string(), rods: places(&frame.units[id].rods) };
    let with_steps = assembly.filter(|assembly| !assembly.steps.is_empty());
    Ok(Data {
        format: "rodwright-viewer",
        version: 1,
        model: settings.model.clone(),
        words: words(settings)?,
        ground: hundredths(frame.ground),
        rods: rods?,
        units: frame.units.ids().map(unit).collect(),
        feet: frame.supports.iter().map(|s| point(&s.point)).collect(),
        guide: with_steps.map_or(Ok(Vec::new()), |a| guide(a, settings).map(Vec::from))?,
        steps: with_steps.map_or(Ok(Vec::new()), |a| steps(frame, &classes, a, settings))?,
    })
}

/// What all rods share.
struct Cards<'a> {
    frame: &'a Frame,
    classes: &'a LengthClasses,
    settings: &'a SheetSettings,
    book: Book<'a>,
}

impl Cards<'_> {
    fn rod(&self, id: RodId, step: Option<usize>) -> Result<RodData, TextError> {
        let (settings, format) = (self.settings, self.settings.format());
        let (rod, class) = (&self.frame.rods[id], self.classes.of(id));
        let (length, sawn) = (format.measure(rod.axis.length()), settings.sawn.contains(&id));
        let diameter = format.diameter(rod.diameters);
        let (name, count) = (class.name.clone(), class.rods.len());
        let placed = |n: usize| settings.say(say::Placed { step: n + 1 });
        let marks = marks(self.frame, id);
        Ok(RodData {
            id: id.to_string(),
            a: point(&rod.axis.a),
            b: point(&rod.axis.b),
            d: rod.diameters.map(hundredths),
            cut: settings.say(rod_cards::say::Cut { length, diameter: String::new(), sawn })?,
            diameter: settings.say(say::Diameter { diameter })?,
            class: settings.say(rod_cards::say::Class { name, count })?,
            k: self.classes.iter().position(|c| c.name == class.name).unwrap_or(0),
            border: rod.border,
            placed: step.map(placed).transpose()?,
            step,
            marks: marks.iter().map(|m| self.mark(m)).collect::<Result<_, _>>()?,
            foot: self.book.feet_of(id)?,
        })
    }

    fn mark(&self, mark: &Mark) -> Result<MarkData, TextError> {
        let (settings, format) = (self.settings, self.settings.format());
        let distance = format.length(mark.at_partner);
        let clock = rod_cards::say::Clock { angle: format.heading(mark.clock) };
        Ok(MarkData {
            contact: mark.contact.to_string(),
            letter: mark.letter.clone(),
            at: format.length(mark.at),
            x: hundredths(mark.at),
            side: mark.side.letter(),
            mate: mark.partner.index(),
            text: format!("{} @ {distance}", mark.partner_letter),
            angle: format.angle(mark.angle),
            clock: settings.say(clock)?,
            word: rod_cards::word(mark, settings)?,
        })
    }
}

fn steps(
    frame: &Frame,
    classes: &LengthClasses,
    assembly: &Assembly,
    settings: &SheetSettings,
) -> Result<Vec<StepData>, TextError> {
    let writer = Writer { frame, classes, settings, count: assembly.steps.len() };
    let mut steps = Vec::new();
    for (n, (step, standing)) in assembly.steps.iter().zip(assembly.standing()).enumerate() {
        // The reader turns the view, so nobody is told to walk round the model.
        let text = writer.step(n, step, 0.0)?;
        steps.push(StepData {
            title: text.title,
            rods: places(&step.rods),
            parts: text.parts.into_iter().map(|p| [p.number, p.facts, p.contacts]).collect(),
            notes: text.notes,
            props: standing.iter().map(prop).collect(),
        });
    }
    Ok(steps)
}

fn prop(prop: &Prop) -> PropData {
    PropData { id: prop.id.to_string(), point: point(&prop.point), height: hundredths(prop.height) }
}

fn places(rods: &[RodId]) -> Vec<usize> {
    rods.iter().map(|rod| rod.index()).collect()
}

fn point(p: &Point3) -> [f64; 3] {
    [p.x, p.y, p.z].map(hundredths)
}

/// To 0.01 mm: far below what a picture shows. Never `-0.0`.
fn hundredths(mm: f64) -> f64 {
    (mm * 100.0).round() / 100.0 + 0.0
}
