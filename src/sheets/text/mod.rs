//! The texts of the papers: in files, in several languages, for the user to change.
//!
//! A file of texts (`templates/papers/en/cover.toml`) holds messages by their keys. Each is a
//! minijinja template with named values, which come ready printed: figures with their decimal
//! sign, lengths in the unit of the papers. What messages there are, and which values each
//! has, the pages declare beside themselves with `messages!`.
//!
//! To add a message: declare it in the `messages!` of its page, give its text in every language,
//! and say it. What is forgotten does not compile or does not load. A new file of texts is one
//! line more in `language.rs`.
//!
//! All texts are tried when they are loaded, so that a fault in a file of the user's is found
//! before anything is made.

mod check;
mod error;
mod file;
mod language;
pub(super) mod message;

#[cfg(test)]
mod tests;

pub use error::TextError;
pub use language::{Language, built_in_files};

use file::Texted;
use language::{FILES, Handout};
use message::Message;
use minijinja::{Environment, UndefinedBehavior, Value};
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// All texts in one language, ready to be said.
#[derive(Clone)]
pub struct Texts(Arc<Loaded>);

struct Loaded {
    environment: Environment<'static>,
    /// Sources by template name: what tells two sets of texts apart.
    sources: BTreeMap<String, String>,
    language: String,
    decimal: char,
}

impl Texts {
    /// The texts that the program brings.
    ///
    /// # Errors
    /// [`TextError::At`] if one of them is broken, which the tests rule out.
    pub fn built_in(language: Language) -> Result<Self, TextError> {
        Self::load(language, &BTreeMap::new())
    }

    /// The texts that the program brings, with those of a folder in their place where it has
    /// some. Hidden files and READMEs in it are passed over.
    ///
    /// # Errors
    /// [`TextError`] with the file, the line and what is wrong.
    pub fn with_folder(language: Language, folder: &Path) -> Result<Self, TextError> {
        Self::load(language, &file::read_folder(folder)?)
    }

    /// `own` are files of the user's by their names.
    fn load(language: Language, own: &BTreeMap<String, Texted>) -> Result<Self, TextError> {
        let mut environment = environment();
        let mut sources = BTreeMap::new();
        for file in FILES {
            let texts = file::messages(file, language, own.get(file.name))?;
            for (entry, text) in texts {
                let name = template_name(file.name, entry.key);
                check::message(&mut environment, &name, entry, &text)?;
                sources.insert(name, text.source);
            }
        }
        let text = file::handout(language, own.get(Handout::NAME));
        let name = template_name(Handout::NAME, Handout::ENTRY.key);
        check::message(&mut environment, &name, Handout::ENTRY, &text)?;
        check::markdown(&environment, &name, Handout::ENTRY, &text)?;
        sources.insert(name, text.source);
        let mut loaded = Loaded { environment, sources, language: String::new(), decimal: '.' };
        loaded.language = loaded.say(super::page::say::Language {})?;
        loaded.decimal = loaded.decimal(own.get("page.toml"))?;
        Ok(Self(Arc::new(loaded)))
    }

    /// Puts a message into words.
    pub(super) fn say<M: Message>(&self, message: M) -> Result<String, TextError> {
        self.0.say(message)
    }

    /// Puts a message into words, its lines as they are.
    pub(super) fn text<M: Message>(&self, message: M) -> Result<String, TextError> {
        self.0.text(message)
    }

    /// The language that the texts are written in, as BCP 47 names it: `en`, `de-AT`.
    pub fn language(&self) -> &str {
        &self.0.language
    }

    /// The sign between whole numbers and decimals.
    pub fn decimal(&self) -> char {
        self.0.decimal
    }
}

impl Loaded {
    fn say<M: Message>(&self, message: M) -> Result<String, TextError> {
        Ok(one_line(&self.text(message)?))
    }

    fn text<M: Message>(&self, message: M) -> Result<String, TextError> {
        let failed = |e: minijinja::Error| TextError::Render {
            file: M::FILE,
            key: M::KEY,
            problem: check::problem(&e),
        };
        let template =
            self.environment.get_template(&template_name(M::FILE, M::KEY)).map_err(failed)?;
        template.render(Value::from_pairs(message.values())).map_err(failed)
    }

    /// The decimal sign, if the text of that name is one character.
    fn decimal(&self, own: Option<&Texted>) -> Result<char, TextError> {
        let text = self.say(super::page::say::Decimal {})?;
        let mut all = text.chars();
        match (all.next(), all.next()) {
            (Some(sign), None) => Ok(sign),
            _ => Err(check::not_one_sign(own, &text)),
        }
    }
}

/// The names of all files of texts.
fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|file| file.name).chain([Handout::NAME])
}

/// What all templates share: no value is taken for nothing when it is not there.
fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_auto_escape_callback(|_| minijinja::AutoEscape::None);
    environment
}

fn template_name(file: &str, key: &str) -> String {
    format!("{file}:{key}")
}

/// The text with its lines joined: in the files they are broken as it suits the eye.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(|line| line.trim_matches([' ', '\t', '\r']));
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ").replace('\t', " ")
}

/// Equal if all texts are.
impl PartialEq for Texts {
    fn eq(&self, other: &Self) -> bool {
        self.0.sources == other.0.sources
    }
}

impl fmt::Debug for Texts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Texts").field(&self.0.language).finish()
    }
}
