//! The pages of statics.pdf: where a frame is stressed, what was taken for it, what came of it.

mod labels;
mod legend;
mod marks;
mod picture;
mod pictures;
mod tables;
#[cfg(test)]
mod tests;

pub(super) use legend::{say as say_legend, tick_figure, ticks};
pub(super) use pictures::say;
pub(super) use tables::say as say_tables;

use super::{Format, Sheet, SheetError, SheetSettings, page};
use crate::frame::Frame;
use crate::ids::{ContactId, IdVec, RodId};
use crate::statics::along::{RodFigures, Stretch, along, most_used, rod_figures};
use crate::statics::study::Study;

/// What the pages show, at the size studied.
struct Subject<'a> {
    /// The frame at that size.
    frame: Frame,
    study: &'a Study,
    figures: IdVec<RodId, RodFigures>,
    along: IdVec<RodId, Vec<Stretch>>,
    /// The contacts that pull, the strongest first, with their pull, N.
    pulls: Vec<(ContactId, f64)>,
    settings: SheetSettings,
}

/// The pages of a study: the frame from above and from the side with its rods in the colours of
/// their stresses, then what was taken and the figures. Lengths on them are those of the size
/// studied.
///
/// # Errors
/// As [`sheets`](super::sheets).
pub fn statics_sheets(
    frame: &Frame,
    study: &Study,
    settings: &SheetSettings,
) -> Result<Vec<Sheet>, SheetError> {
    let subject = Subject::new(frame, study, settings.checked()?);
    let mut leaves = pictures::pages(&subject)?;
    leaves.extend(tables::pages(&subject)?);
    let diameters = subject.format().diameters(&subject.frame);
    page::stamp(leaves, &diameters, &subject.settings)
}

impl<'a> Subject<'a> {
    fn new(frame: &Frame, study: &'a Study, settings: SheetSettings) -> Self {
        let frame = sized(frame, study.question.taken.scale);
        let (figures, along) = (rod_figures(study), along(study));
        Self { frame, study, figures, along, pulls: study.strongest_pulls(), settings }
    }

    fn format(&self) -> Format {
        self.settings.format()
    }

    /// The size studied, as a multiple of that of the model.
    fn scale(&self) -> f64 {
        self.study.question.taken.scale
    }

    /// The largest utilisation.
    fn largest(&self) -> f64 {
        most_used(&self.figures)
    }

    /// The rods by their utilisation, the largest first.
    fn by_use(&self) -> Vec<RodId> {
        let mut rods: Vec<RodId> = self.figures.ids().collect();
        let used = |rod: RodId| self.figures[rod].utilisation;
        rods.sort_by(|&a, &b| used(b).total_cmp(&used(a)).then(a.cmp(&b)));
        rods
    }

    /// How many rods are stressed beyond their strength.
    fn beyond(&self) -> usize {
        self.figures.iter().filter(|rod| rod.utilisation > 1.0).count()
    }

    /// Where the stress of a rod is largest, from end A, at the size studied.
    fn place(&self, rod: RodId) -> String {
        self.format().measure(self.figures[rod].at * self.scale())
    }

    /// The name of a case as it can be printed.
    fn case(&self, case: usize) -> String {
        let case = self.study.cases.get(case);
        case.map_or_else(String::new, |c| page::printable(&c.combination.name))
    }
}

/// A frame at another size, as far as it is drawn: rods, contacts and feet.
fn sized(frame: &Frame, scale: f64) -> Frame {
    let mut frame = frame.clone();
    frame.diameter *= scale;
    frame.ground *= scale;
    for rod in frame.rods.iter_mut() {
        for end in [&mut rod.axis.a, &mut rod.axis.b] {
            *end *= scale;
        }
        rod.diameters = rod.diameters.map(|d| d * scale);
    }
    for contact in frame.contacts.iter_mut() {
        contact.at_over *= scale;
        contact.at_under *= scale;
        contact.gap *= scale;
    }
    for support in &mut frame.supports {
        support.point *= scale;
    }
    frame
}
