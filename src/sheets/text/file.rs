//! Files of texts: TOML, a key and a template on each line or over several.

use super::TextError;
use super::language::{FILES, Handout, Language, MessageFile};
use super::message::Entry;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// A file as it was read.
pub(super) struct Texted {
    /// Where it is.
    pub path: PathBuf,
    /// What is in it.
    pub text: String,
}

/// A template, and where it stands.
pub(super) struct Sourced {
    /// The file.
    pub file: PathBuf,
    /// The line on which it begins.
    pub first_line: usize,
    /// The line on which it ends.
    pub last_line: usize,
    /// The template.
    pub source: String,
}

impl Sourced {
    /// A fault on a line of the template, counted from 1.
    pub fn fault(&self, line: usize, problem: String) -> TextError {
        let line = (self.first_line + line.max(1) - 1).min(self.last_line);
        TextError::At { file: self.file.clone(), line, problem }
    }
}

/// The files of texts in a folder, by their names.
pub(super) fn read_folder(folder: &Path) -> Result<BTreeMap<String, Texted>, TextError> {
    let unreadable = |file: &Path| {
        let file = file.to_path_buf();
        move |source| TextError::Unreadable { file, source }
    };
    let mut files = BTreeMap::new();
    let mut entries = std::fs::read_dir(folder)
        .and_then(Iterator::collect::<Result<Vec<_>, _>>)
        .map_err(unreadable(folder))?;
    // The first fault is the same on every machine.
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if name.starts_with('.') || name.to_ascii_lowercase().starts_with("readme") {
            continue;
        }
        if !super::names().any(|known| known == name) {
            let known = super::names().collect::<Vec<_>>().join(", ");
            return Err(TextError::UnknownFile { file: path, known });
        }
        let text = std::fs::read_to_string(&path).map_err(unreadable(&path))?;
        files.insert(name, Texted { path, text });
    }
    Ok(files)
}

/// The messages of a file, in their order: those of the user where there are some, else
/// those that the program brings.
pub(super) fn messages(
    file: &MessageFile,
    language: Language,
    own: Option<&Texted>,
) -> Result<Vec<(&'static Entry, Sourced)>, TextError> {
    let name = language.name();
    let built_in = Texted {
        path: PathBuf::from(format!("{name}/{}", file.name)),
        text: file.built_in(language).to_owned(),
    };
    let mut texts = read(&built_in, file)?;
    if let Some(own) = own {
        texts.extend(read(own, file)?);
    }
    let found = |entry: &'static Entry| {
        let missing = || TextError::At {
            file: built_in.path.clone(),
            line: 1,
            problem: format!("the text {} is missing", entry.key),
        };
        Ok((entry, texts.remove(entry.key).ok_or_else(missing)?))
    };
    file.all().map(found).collect()
}

/// The template of the handout.
pub(super) fn handout(language: Language, own: Option<&Texted>) -> Sourced {
    let (file, source) = match own {
        Some(own) => (own.path.clone(), own.text.clone()),
        None => {
            let path = format!("{}/{}", language.name(), Handout::NAME);
            (PathBuf::from(path), Handout::built_in(language).to_owned())
        }
    };
    let last_line = source.lines().count().max(1);
    Sourced { file, first_line: 1, last_line, source }
}

/// The messages that stand in a file.
fn read(texted: &Texted, file: &MessageFile) -> Result<BTreeMap<String, Sourced>, TextError> {
    let Texted { path, text } = texted;
    let at = |line: usize, problem: String| TextError::At { file: path.clone(), line, problem };
    let line_of = |place: usize| text[..place].matches('\n').count() + 1;
    let table: BTreeMap<Spanned<String>, Spanned<String>> = toml::from_str(text).map_err(|e| {
        let line = e.span().map_or(1, |span| line_of(span.start.min(text.len())));
        at(line, e.message().to_owned())
    })?;
    let mut found = BTreeMap::new();
    for (key, template) in table {
        let line = line_of(key.span().start);
        let name = key.into_inner();
        if file.entry(&name).is_none() {
            return Err(at(line, unknown_key(file, &name)));
        }
        let Range { start, end } = template.span();
        let opens_line = ["'''", "\"\"\""].iter().any(|quotes| {
            text[start..].strip_prefix(quotes).is_some_and(|t| t.starts_with(['\n', '\r']))
        });
        let sourced = Sourced {
            file: path.clone(),
            first_line: line_of(start) + usize::from(opens_line),
            last_line: line_of(end),
            source: template.into_inner(),
        };
        found.insert(name, sourced);
    }
    Ok(found)
}

fn unknown_key(file: &MessageFile, key: &str) -> String {
    let elsewhere = FILES.iter().find(|other| other.entry(key).is_some());
    match elsewhere {
        Some(other) => format!("the text {key} belongs into {}", other.name),
        None => {
            let known: Vec<&str> = file.all().map(|entry| entry.key).collect();
            format!("{} has no text {key}: its texts are {}", file.name, known.join(", "))
        }
    }
}
