//! The words on the page, by the names that its scripts and its HTML use.

use crate::sheets::SheetSettings;
use crate::sheets::text::TextError;
use crate::sheets::text::message::messages;
use std::collections::BTreeMap;

messages! {
    mod say in "viewer.toml" {
        "model" => Model {}
        "hint" => Hint {}
        "search" => Search {}
        "not-found" => NotFound {}
        "colors" => Colors {}
        "plain" => Plain {}
        "sides" => Sides {}
        "border" => Border {}
        "classes" => Classes {}
        "over" => Over {}
        "under" => Under {}
        "border-rod" => BorderRod {}
        "inner-rod" => InnerRod {}
        "end-a" => EndA {}
        "theme" => Theme {}
        "home" => Home {}
        "closer" => Closer {}
        "farther" => Farther {}
        "print" => Print {}
        "first" => First {}
        "back" => Back {}
        "forward" => Forward {}
        "all" => All {}
        "steps" => Steps {}
        "no-webgl" => NoWebgl {}
        "mark" => MarkHead {}
        "from-a" => FromA {}
        "mate" => Mate {}
        "angle" => Angle {}
        "lies" => Lies {}
        "stress" => Stress {}
        "stress-title" => StressTitle { stress: String, scale: String }
        "rod-stress" => RodStress { stress: String, used: String, at: String, case: String }
        "diameter" => Diameter { diameter: String }
        "placed" => Placed { step: usize }
    }
}

/// The words that stand on the page whatever the frame is.
pub(super) fn words(settings: &SheetSettings) -> Result<BTreeMap<&'static str, String>, TextError> {
    macro_rules! said {
        ($($key:literal: $name:ident),* $(,)?) => {
            BTreeMap::from([$(($key, settings.say(say::$name {})?)),*])
        };
    }
    Ok(said! {
        "model": Model, "hint": Hint, "search": Search, "not-found": NotFound,
        "colors": Colors, "plain": Plain, "sides": Sides, "border": Border,
        "classes": Classes, "over": Over, "under": Under, "border-rod": BorderRod,
        "inner-rod": InnerRod, "end-a": EndA, "theme": Theme, "home": Home,
        "closer": Closer, "farther": Farther, "print": Print, "first": First,
        "back": Back, "forward": Forward, "all": All, "steps": Steps,
        "no-webgl": NoWebgl, "mark": MarkHead, "from-a": FromA, "mate": Mate,
        "angle": Angle, "lies": Lies, "stress": Stress,
    })
}
