//! Texts are tried when they are loaded: with every kind of value that a model may give.

use super::TextError;
use super::file::{Sourced, Texted};
use super::message::{Entry, Kind};
use crate::drawing::Weight;
use crate::drawing::font::text_width;
use crate::sheets::handout::markdown::{Unprintable, blocks};
use minijinja::{Environment, ErrorKind, Template, Value};
use std::path::PathBuf;

/// Numbers of things that texts are tried with: none, one, and several of them.
const COUNTS: [usize; 4] = [1, 0, 2, 21];
/// What stands for words; optional ones are empty.
const WORDS: [&str; 2] = ["1", ""];

/// Adds a template to the environment, if it is sound.
pub(super) fn message(
    environment: &mut Environment<'static>,
    name: &str,
    entry: &Entry,
    text: &Sourced,
) -> Result<(), TextError> {
    printable(entry.key, text)?;
    let fault = |e: &minijinja::Error| {
        let problem = format!("the text {}: {}", entry.key, problem(e));
        text.fault(e.line().unwrap_or(1), problem)
    };
    environment.add_template_owned(name.to_owned(), text.source.clone()).map_err(|e| fault(&e))?;
    let template = environment.get_template(name).map_err(|e| fault(&e))?;
    known_values(environment, &template, entry, text)?;
    for values in trials(entry) {
        template.render(Value::from_pairs(values)).map_err(|e| fault(&e))?;
    }
    Ok(())
}

/// Refuses a handout with something in it that is not printed.
pub(super) fn markdown(
    environment: &Environment<'_>,
    name: &str,
    entry: &Entry,
    text: &Sourced,
) -> Result<(), TextError> {
    for values in trials(entry) {
        let fault = |e: &minijinja::Error| text.fault(e.line().unwrap_or(1), problem(e));
        let template = environment.get_template(name).map_err(|e| fault(&e))?;
        let tried = template.render(Value::from_pairs(values)).map_err(|e| fault(&e))?;
        blocks(&tried).map_err(|Unprintable { near, problem }| {
            let holds = |line: &str| line.contains(&near);
            let line = text.source.lines().position(holds).unwrap_or(0) + 1;
            text.fault(line, format!("`{near}`: {problem}"))
        })?;
    }
    Ok(())
}

/// Refuses characters that the font of the papers does not have.
fn printable(key: &str, text: &Sourced) -> Result<(), TextError> {
    for (i, line) in text.source.lines().enumerate() {
        let mut buffer = [0; 4];
        let strange = line.chars().find(|&c| {
            let string = &*c.encode_utf8(&mut buffer);
            c != '\t'
                && [Weight::Regular, Weight::Bold]
                    .iter()
                    .any(|&w| text_width(string, 1.0, w).is_err())
        });
        if let Some(c) = strange {
            let problem = format!(
                "the text {key}: the font of the papers has no {c:?} (U+{:04X}); it is DejaVu \
                 Sans Condensed, which knows Latin, Greek and Cyrillic letters",
                u32::from(c)
            );
            return Err(text.fault(i + 1, problem));
        }
    }
    Ok(())
}

/// Refuses values that the message does not have, even where no trial would ask for them.
fn known_values(
    environment: &Environment<'_>,
    template: &Template<'_, '_>,
    entry: &Entry,
    text: &Sourced,
) -> Result<(), TextError> {
    let mut asked: Vec<String> = template.undeclared_variables(false).into_iter().collect();
    asked.sort();
    let known = |name: &String| {
        entry.values.iter().any(|(value, _)| value == name)
            || environment.globals().any(|(global, _)| global == name)
    };
    let Some(unknown) = asked.into_iter().find(|name| !known(name)) else { return Ok(()) };
    let line = text.source.lines().position(|line| holds_word(line, &unknown)).unwrap_or(0) + 1;
    let values: Vec<&str> = entry.values.iter().map(|(name, _)| *name).collect();
    let there_are = match &values[..] {
        [] => "it takes no values".to_owned(),
        some => format!("its values are {}", some.join(", ")),
    };
    Err(text.fault(line, format!("the text {} has no value {unknown}: {there_are}", entry.key)))
}

/// Whether a word stands in a line on its own.
fn holds_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == word)
}

/// Values to try a text with: every one of each kind comes up.
fn trials(entry: &Entry) -> impl Iterator<Item = Vec<(&'static str, Value)>> {
    let values = entry.values;
    (0..2 * COUNTS.len()).map(move |trial| {
        let value = |&(name, kind): &(&'static str, Kind)| {
            let value = match kind {
                Kind::Words => Value::from(WORDS[trial / COUNTS.len()]),
                Kind::Count => Value::from(COUNTS[trial % COUNTS.len()]),
                Kind::Flag => Value::from(trial % 2 == 0),
                Kind::List => Value::from(vec!["1"; COUNTS[trial % COUNTS.len()]]),
            };
            (name, value)
        };
        values.iter().map(value).collect()
    })
}

/// What minijinja finds wrong, without the name that the template has inside.
pub(super) fn problem(e: &minijinja::Error) -> String {
    match e.detail() {
        Some(detail) if e.kind() == ErrorKind::SyntaxError => format!("{}: {detail}", e.kind()),
        Some(detail) => format!("{detail} ({})", e.kind()),
        None => e.kind().to_string(),
    }
}

/// The decimal sign is something else.
pub(super) fn not_one_sign(own: Option<&Texted>, text: &str) -> TextError {
    let file = own.map_or_else(|| PathBuf::from("page.toml"), |own| own.path.clone());
    let is_it = |line: &str| line.trim_start().starts_with("decimal");
    let line = own.and_then(|own| own.text.lines().position(is_it)).unwrap_or(0) + 1;
    let problem = format!("the text decimal must be one sign, as . or , are, not {text:?}");
    TextError::At { file, line, problem }
}
