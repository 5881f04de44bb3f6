//! The stresses as the page reads them: colours along rods, the bar of the colours, words.
//!
//! They stand in an element of their own, so that a finished page can be given others.

use super::say;
use crate::drawing::scale_color;
use crate::ids::{IdVec, RodId};
use crate::sheets::statics::{tick_figure, ticks};
use crate::sheets::text::TextError;
use crate::sheets::{SheetError, SheetSettings, page};
use crate::statics::along::{RodFigures, Stretch, along, most_used, rod_figures, share};
use crate::statics::study::Study;
use serde::Serialize;

/// Colours between no stress and the largest.
const STEPS: usize = 40;

#[derive(Serialize)]
struct StressData {
    format: &'static str,
    version: u32,
    /// The colours, `#rrggbb`, from none to most.
    colors: Vec<String>,
    /// Figures below the bar: how far along it, and what is said there.
    ticks: Vec<(f64, String)>,
    /// What the bar says.
    title: String,
    rods: Vec<RodStress>,
}

#[derive(Serialize)]
struct RodStress {
    /// Where stretches end, mm from end A of the model, and the places of their colours, in turn.
    along: Vec<f64>,
    /// Where the stress is largest, mm from end A.
    at: f64,
    /// That stress in words.
    text: String,
}

/// The data of a study as it stands in the page; nothing without one.
pub(super) fn stress_json(
    study: Option<&Study>,
    settings: &SheetSettings,
) -> Result<String, SheetError> {
    let Some(study) = study else { return Ok(String::new()) };
    let data = data(study, settings)?;
    Ok(super::in_script(&serde_json::to_string(&data)?))
}

fn data(study: &Study, settings: &SheetSettings) -> Result<StressData, TextError> {
    let format = settings.format();
    let figures = rod_figures(study);
    let (largest, stretches) = (most_used(&figures), along(study));
    let taken = &study.question.taken;
    let tick = |used: f64| {
        let at = if largest > 0.0 { used / (100.0 * largest) } else { 0.0 };
        (rounded(at, 1e4), tick_figure(used, 100.0 * largest, format))
    };
    let title = say::StressTitle {
        stress: format.three_digits(largest * taken.material.strength),
        scale: format.factor(taken.scale),
    };
    let one = Rods { figures: &figures, stretches: &stretches, largest, study, settings };
    Ok(StressData {
        format: "rodwright-viewer-stress",
        version: 1,
        colors: (0..=STEPS)
            .map(|i| scale_color(i as f64 / STEPS as f64).to_string().to_lowercase())
            .collect(),
        ticks: ticks(100.0 * largest).into_iter().map(tick).collect(),
        title: settings.say(title)?,
        rods: figures.ids().map(|rod| one.rod(rod)).collect::<Result<_, _>>()?,
    })
}

/// What all rods share.
struct Rods<'a> {
    figures: &'a IdVec<RodId, RodFigures>,
    stretches: &'a IdVec<RodId, Vec<Stretch>>,
    largest: f64,
    study: &'a Study,
    settings: &'a SheetSettings,
}

impl Rods<'_> {
    fn rod(&self, id: RodId) -> Result<RodStress, TextError> {
        let (format, figures) = (self.settings.format(), &self.figures[id]);
        let scale = self.study.question.taken.scale;
        let mut along: Vec<f64> = Vec::new();
        for stretch in &self.stretches[id] {
            let step = (share(stretch.utilisation, self.largest) * STEPS as f64).round();
            // Neighbours of one colour are one.
            if along.last() == Some(&step) {
                along.truncate(along.len() - 2);
            }
            along.extend([rounded(stretch.to / scale, 1e2), step]);
        }
        let case = self.study.cases.get(figures.case);
        let case = case.map_or_else(String::new, |c| page::printable(&c.combination.name));
        let text = self.settings.say(say::RodStress {
            stress: format.three_digits(figures.stress),
            used: format.share(figures.utilisation),
            at: format.measure(figures.at),
            case,
        })?;
        Ok(RodStress { along, at: rounded(figures.at, 1e2), text })
    }
}

fn rounded(x: f64, per_one: f64) -> f64 {
    (x * per_one).round() / per_one + 0.0
}

/// Where the data begin and end in a page.
const OPENING: &str = r#"<script id="stress" type="application/json">"#;
const CLOSING: &str = "</script>";

/// A finished page with the stresses of another study, or none, in place of its own; `None`
/// where the page has no place for them. Figures in it are in the units and the language of
/// the settings.
///
/// # Errors
/// As [`viewer`](super::viewer).
pub fn with_stress(
    html: &str,
    study: Option<&Study>,
    settings: &SheetSettings,
) -> Result<Option<String>, SheetError> {
    let Some((before, rest)) = html.split_once(OPENING) else { return Ok(None) };
    let Some((_, after)) = rest.split_once(CLOSING) else { return Ok(None) };
    let data = stress_json(study, settings)?;
    Ok(Some([before, OPENING, &data, CLOSING, after].concat()))
}
