//! The pages with the frame in the colours of its stresses.

use super::marks::{self, NAMED};
use super::{Subject, legend, picture};
use crate::drawing::font::{LEADING, text_width, wrap};
use crate::drawing::{Draw, Drawing, Item, Placement, Point, Rect, Weight};
use crate::sheets::SheetError;
use crate::sheets::page::{BODY, Leaf, Listing, SMALL, area};
use crate::sheets::text::TextError;
use crate::sheets::text::message::messages;
use crate::sheets::view::View;

messages! {
    mod say in "statics.toml" {
        "plan" => Plan {}
        "side" => Side {}
        "hottest" => Hottest { rod: String, stress: String, used: String, at: String, case: String }
        "unstressed" => Unstressed {}
        "beyond" => Beyond { count: usize }
        "size" => Size { scale: String }
        "colors" => Colors {}
        "key-hottest" => KeyHottest {}
        "key-foot" => KeyFoot {}
        "key-added" => KeyAdded {}
        "key-load" => KeyLoad { more: usize }
        "key-pull" => KeyPull { more: usize }
        "key-pale" => KeyPale {}
    }
}

/// Height of the eye above the horizontal in the view from the side, radians.
const EYE: f64 = std::f64::consts::PI / 6.0;
/// The eye's heading where the most stressed place is in the middle, radians.
const HEADING: f64 = -std::f64::consts::FRAC_PI_3;
/// How far a place must be from the middle to be walked to, as part of the frame's size.
const OFF_MIDDLE: f64 = 0.05;
/// Between the blocks below the picture, mm.
const GAP: f64 = 2.5;
/// White between picture and its room, for marks at the rim, mm.
const RIM: f64 = 5.0;
/// Height of a line of the key, and room for its signs, mm.
const KEY_LINE: f64 = 4.6;
const SIGN: f64 = 5.0;

/// From above and from the side.
pub(super) fn pages(subject: &Subject) -> Result<Vec<Leaf>, SheetError> {
    let side = View::from_side(heading(subject), EYE);
    let plan = subject.settings.say(say::Plan {})?;
    let from_side = subject.settings.say(say::Side {})?;
    Ok(vec![
        page(subject, ("stress-plan", plan), &View::plan(), false)?,
        page(subject, ("stress-side", from_side), &side, true)?,
    ])
}

/// The eye stands on the side of the most stressed place.
fn heading(subject: &Subject) -> f64 {
    let [low, high] = subject.frame.bounds();
    let Some(&rod) = subject.by_use().first() else { return HEADING };
    let at = subject.figures[rod].at * subject.scale();
    let off = subject.frame.rods[rod].axis.at(at) - nalgebra::center(&low, &high);
    if off.x.hypot(off.y) > OFF_MIDDLE * (high - low).norm() { off.y.atan2(off.x) } else { HEADING }
}

fn page(
    subject: &Subject,
    (stem, title): (&str, String),
    view: &View,
    aside: bool,
) -> Result<Leaf, SheetError> {
    let settings = &subject.settings;
    let area = area(settings);
    let [width, height] = settings.paper.size();
    let mut drawing = Drawing::new(width, height);
    let words = Words::new(subject, area.width(), aside)?;
    let room = Rect { max: [area.max[0], area.max[1] - words.height - GAP], ..area };
    let mut inner = room.inset(RIM);
    if aside && !subject.study.question.points.is_empty() {
        // Arrows of loads stand on the topmost rods.
        inner.min[1] += marks::ARROW;
    }
    let layout = view.layout(&subject.frame, inner);
    marks::feet(subject, view, &layout, drawing.layer("feet"));
    picture::draw(subject, view, &layout, drawing.layer("rods"));
    marks::draw(subject, view, &layout, room, drawing.layer("marks"))?;
    let n = layout.n;
    words.draw(subject, n, [area.min[0], room.max[1] + GAP], drawing.layer("legend"));
    let scale = format!("1:{}", subject.format().plain(n));
    let listing = Listing::default();
    Ok(Leaf { stem: stem.to_owned(), title, scale: Some(scale), drawing, listing })
}

/// What stands below the picture.
struct Words {
    bar: Vec<Item>,
    key: Vec<Item>,
    key_height: f64,
    lines: Vec<(String, Weight)>,
    height: f64,
}

impl Words {
    fn new(subject: &Subject, room: f64, aside: bool) -> Result<Self, SheetError> {
        let bar = legend::bar(subject, room)?;
        let (key, key_height) = key(subject, room, aside)?;
        let mut lines = Vec::new();
        for (text, weight) in sentences(subject)? {
            lines.extend(wrap(&text, BODY, weight, room)?.into_iter().map(|line| (line, weight)));
        }
        let text = lines.len() as f64 * BODY * LEADING;
        let height = legend::HEIGHT + legend::LENGTH_HEIGHT + key_height + text + 3.0 * GAP;
        Ok(Self { bar, key, key_height, lines, height })
    }

    fn draw(&self, subject: &Subject, n: f64, [x, mut y]: Point, out: &mut impl Draw) {
        out.place(&self.bar, &Placement::at([x, y]));
        y += legend::HEIGHT + GAP;
        out.place(&legend::length_bar(subject, n), &Placement::at([x, y]));
        y += legend::LENGTH_HEIGHT + GAP;
        out.place(&self.key, &Placement::at([x, y]));
        y += self.key_height + GAP;
        for (line, weight) in &self.lines {
            out.text([x, y + BODY * 0.9], BODY, line.as_str()).weight(*weight);
            y += BODY * LEADING;
        }
    }
}

/// What is said below the picture.
fn sentences(subject: &Subject) -> Result<Vec<(String, Weight)>, TextError> {
    let settings = &subject.settings;
    let mut all = vec![(hottest(subject)?, Weight::Bold)];
    if let count @ 1.. = subject.beyond() {
        all.push((settings.say(say::Beyond { count })?, Weight::Bold));
    }
    all.push((settings.say(say::Colors {})?, Weight::Regular));
    all.extend(size(subject)?.map(|text| (text, Weight::Regular)));
    Ok(all)
}

/// The rod that is stressed most.
pub(super) fn hottest(subject: &Subject) -> Result<String, TextError> {
    let (settings, format) = (&subject.settings, subject.format());
    let Some(&rod) = subject.by_use().first().filter(|&&r| subject.figures[r].utilisation > 0.0)
    else {
        return settings.say(say::Unstressed {});
    };
    let figures = &subject.figures[rod];
    settings.say(say::Hottest {
        rod: rod.to_string(),
        stress: format.three_digits(figures.stress),
        used: format.share(figures.utilisation),
        at: subject.place(rod),
        case: subject.case(figures.case),
    })
}

/// What lengths are, where they are not those of the model.
pub(super) fn size(subject: &Subject) -> Result<Option<String>, TextError> {
    let scale = subject.format().factor(subject.scale());
    let said = (subject.scale() != 1.0).then(|| subject.settings.say(say::Size { scale }));
    said.transpose()
}

/// The signs that are on the page, with their meanings, in lines; and their height.
fn key(subject: &Subject, room: f64, aside: bool) -> Result<(Vec<Item>, f64), SheetError> {
    let mut items = Vec::new();
    let (mut x, mut y) = (0.0, KEY_LINE / 2.0);
    for (sign, meaning) in entries(subject, aside)? {
        let width = SIGN + text_width(&meaning, SMALL, Weight::Regular)? + 5.0;
        if x > 0.0 && x + width > room {
            (x, y) = (0.0, y + KEY_LINE);
        }
        sign.draw(&mut items, [x + SIGN / 2.0 - 0.5, y]);
        items.text([x + SIGN, y], SMALL, meaning).vcenter();
        x += width;
    }
    Ok((items, y + KEY_LINE / 2.0))
}

#[derive(Clone, Copy)]
enum Sign {
    Hottest,
    Foot { added: bool },
    Load,
    Pull,
    Pale,
}

impl Sign {
    fn draw(self, out: &mut impl Draw, [x, y]: Point) {
        match self {
            Self::Hottest => marks::hottest_sign(out, [x, y]),
            Self::Foot { added } => marks::foot_sign(out, [x, y], marks::FOOT, added),
            Self::Load => out.arrow([x, y - 1.9], [x, y + 1.9], marks::ARROW_HEAD, marks::LOAD_PEN),
            Self::Pull => out.circle([x, y], marks::RING, marks::RING_PEN),
            Self::Pale => picture::pale_sample(out, [x, y]),
        }
    }
}

fn entries(subject: &Subject, aside: bool) -> Result<Vec<(Sign, String)>, TextError> {
    let (settings, study) = (&subject.settings, subject.study);
    let (feet, own) = (study.model().feet.len(), study.own_feet);
    let mut all = Vec::new();
    if subject.largest() > 0.0 {
        all.push((Sign::Hottest, settings.say(say::KeyHottest {})?));
    }
    if own > 0 {
        all.push((Sign::Foot { added: false }, settings.say(say::KeyFoot {})?));
    }
    if feet > own {
        all.push((Sign::Foot { added: true }, settings.say(say::KeyAdded {})?));
    }
    if let count @ 1.. = study.question.points.len() {
        let more = count.saturating_sub(NAMED);
        all.push((Sign::Load, settings.say(say::KeyLoad { more })?));
    }
    if let count @ 1.. = subject.pulls.len() {
        let more = count.saturating_sub(NAMED);
        all.push((Sign::Pull, settings.say(say::KeyPull { more })?));
    }
    if aside {
        all.push((Sign::Pale, settings.say(say::KeyPale {})?));
    }
    Ok(all)
}
