//! What the cover tells of the run, and the titles of the documents.

use super::text::TextError;
use super::text::message::messages;
use super::{Format, Texts};
use crate::frame::fit::Fit;
use crate::frame::share::Shared;

messages! {
    mod say in "cover.toml" {
        "note-pattern" => Pattern { name: String, summary: String }
        "note-fit" => Fitted { turn: String, edge: String }
        "note-shared" => SharedLengths { after: usize, before: usize, extra: String }
    }
}

/// A run as the cover tells of it.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// Name of the pattern.
    pub pattern: &'a str,
    /// What it looks like, in a few English words.
    pub summary: &'a str,
    /// Size and turn.
    pub fit: &'a Fit,
    /// How rods share lengths, if they do.
    pub shared: Option<&'a Shared>,
}

/// The notes on a run, a line each.
///
/// # Errors
/// [`TextError`] when a text cannot be put together.
pub fn notes(run: &Run, format: Format, texts: &Texts) -> Result<Vec<String>, TextError> {
    let Run { pattern, summary, fit, shared } = *run;
    let mut notes = vec![
        texts.say(say::Pattern { name: pattern.into(), summary: summary.into() })?,
        texts.say(say::Fitted { turn: format.angle(fit.turn), edge: format.measure(fit.edge) })?,
    ];
    if let Some(&Shared { before, after, extra, .. }) = shared {
        let extra = format.total(extra);
        notes.push(texts.say(say::SharedLengths { after, before, extra })?);
    }
    Ok(notes)
}
