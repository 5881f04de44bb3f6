//! The languages that the program brings, and the files of their texts.

use super::message::Entry;
use crate::sheets::{
    cover, cut_list, figures, footprint, handout, histograms, labels, legend, notes, page, parts,
    rod_cards, statics, step_text, strip, support_map, support_tiles, viewer,
};
use serde::{Deserialize, Serialize};

/// A language that the papers can be printed in.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, Default, Hash, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Language {
    /// English.
    #[default]
    En,
    /// German.
    De,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::En, Self::De];

    /// The name of its folder of texts.
    pub fn name(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::De => "de",
        }
    }
}

/// A file of messages.
pub(super) struct MessageFile {
    /// Its name.
    pub name: &'static str,
    /// The messages in it, in lists: some files serve several pages.
    pub entries: &'static [&'static [Entry]],
    /// The texts that the program brings, in the order of [`Language::ALL`].
    built_in: [&'static str; 2],
}

impl MessageFile {
    /// The text that the program brings.
    pub fn built_in(&self, language: Language) -> &'static str {
        self.built_in[language as usize]
    }

    /// The message of that key.
    pub fn entry(&self, key: &str) -> Option<&'static Entry> {
        self.all().find(|entry| entry.key == key)
    }

    /// All messages.
    pub fn all(&self) -> impl Iterator<Item = &'static Entry> {
        self.entries.iter().flat_map(|list| list.iter())
    }
}

/// A file of messages and its texts in all languages.
macro_rules! file {
    ($name:literal, $($entries:path),+) => {
        MessageFile {
            name: $name,
            entries: &[$($entries),+],
            built_in: [
                include_str!(concat!("../../../templates/papers/en/", $name)),
                include_str!(concat!("../../../templates/papers/de/", $name)),
            ],
        }
    };
}

/// All files of messages.
pub(super) const FILES: &[MessageFile] = &[
    file!("page.toml", page::say::ENTRIES),
    file!("cover.toml", cover::say::ENTRIES, notes::say::ENTRIES),
    file!("legend.toml", legend::say::ENTRIES),
    file!("figures.toml", figures::say::ENTRIES, histograms::say::ENTRIES),
    file!("footprint.toml", footprint::say::ENTRIES),
    file!("parts.toml", parts::say::ENTRIES),
    file!("cut-list.toml", cut_list::say::ENTRIES),
    file!("rod-cards.toml", rod_cards::say::ENTRIES, strip::say::ENTRIES),
    file!("steps.toml", step_text::say::ENTRIES),
    file!(
        "statics.toml",
        statics::say::ENTRIES,
        statics::say_legend::ENTRIES,
        statics::say_tables::ENTRIES
    ),
    file!("labels.toml", labels::say::ENTRIES),
    file!("support-map.toml", support_map::say::ENTRIES, support_tiles::say::ENTRIES),
    file!("viewer.toml", viewer::say::ENTRIES),
];

/// The handout: one template of CommonMark.
pub(super) struct Handout;

impl Handout {
    /// The name of its file.
    pub const NAME: &'static str = "handout.md";
    /// Its key and values.
    pub const ENTRY: &'static Entry = &handout::say::ENTRIES[0];

    /// The text that the program brings.
    pub fn built_in(language: Language) -> &'static str {
        match language {
            Language::En => include_str!("../../../templates/papers/en/handout.md"),
            Language::De => include_str!("../../../templates/papers/de/handout.md"),
        }
    }
}

/// All files that the program brings in a language: name and text.
pub fn built_in_files(language: Language) -> Vec<(&'static str, &'static str)> {
    let messages = FILES.iter().map(|file| (file.name, file.built_in(language)));
    messages.chain([(Handout::NAME, Handout::built_in(language))]).collect()
}
