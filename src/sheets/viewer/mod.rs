//! The viewer: one page for a browser that shows the frame, its rod cards and its steps.
//!
//! The page holds its style, its scripts and its data, and asks no network for anything.
//! Figures come as they are printed on the papers, so that page and papers never differ;
//! positions come in mm to be drawn only.

mod data;
mod stress;
mod words;

#[cfg(test)]
mod tests;

pub use stress::with_stress;
pub(in crate::sheets) use words::say;

use super::{SheetError, SheetSettings};
use crate::frame::Frame;
use crate::shop::Assembly;
use crate::statics::study::Study;

const PAGE: &str = include_str!("../../../templates/viewer/viewer.html");
const STYLE: &str = include_str!("../../../templates/viewer/viewer.css");
/// The scripts in the order in which they build on one another.
const SCRIPTS: [&str; 10] = [
    include_str!("../../../templates/viewer/dom.js"),
    include_str!("../../../templates/viewer/camera.js"),
    include_str!("../../../templates/viewer/gl.js"),
    include_str!("../../../templates/viewer/stress.js"),
    include_str!("../../../templates/viewer/scene.js"),
    include_str!("../../../templates/viewer/pick.js"),
    include_str!("../../../templates/viewer/card.js"),
    include_str!("../../../templates/viewer/steps.js"),
    include_str!("../../../templates/viewer/gestures.js"),
    include_str!("../../../templates/viewer/main.js"),
];

/// The page `viewer.html`; without an assembly it has no steps, without a study no stresses.
///
/// # Errors
/// [`SheetError::Text`] when a text cannot be put together, [`SheetError::Data`] when a figure
/// is no number.
pub fn viewer(
    frame: &Frame,
    assembly: Option<&Assembly>,
    study: Option<&Study>,
    settings: &SheetSettings,
) -> Result<String, SheetError> {
    let data = data::data(frame, assembly, settings)?;
    let data = in_script(&serde_json::to_string(&data)?);
    let pieces = [
        ("language", escaped(settings.texts.language())),
        ("title", escaped(&settings.model)),
        ("style", STYLE.to_owned()),
        ("data", data),
        ("stress", stress::stress_json(study, settings)?),
        ("script", SCRIPTS.concat()),
    ];
    Ok(joined(&pieces))
}

/// The page with the pieces in their places, which are written `%name%`. What a piece says is
/// not searched again.
fn joined(pieces: &[(&str, String)]) -> String {
    let mut page = String::new();
    for (i, part) in PAGE.split('%').enumerate() {
        match pieces.iter().find(|(name, _)| i % 2 == 1 && *name == part) {
            Some((_, text)) => page.push_str(text),
            None => page.push_str(part),
        }
    }
    page
}

/// JSON as it may stand in an element of the page: a `</script>` in a name would end it.
fn in_script(json: &str) -> String {
    json.replace("</", "<\\/")
}

/// Text as it may stand in HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
