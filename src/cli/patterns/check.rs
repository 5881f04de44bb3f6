//! `rodwright patterns --check`: which tilings the rules of a file make.

use super::page::rule_in_words;
use super::{failure, json};
use crate::cli::Failure;
use crate::cli::page::Page;
use crate::cli::terminal::{Terminal, print};
use crate::pattern::Draft;
use crate::pattern::grammar::ChoiceError;
use std::path::Path;

/// Tells what the rules make. Rules that make nothing, or not what the file or `cycle` asks
/// for, are an error; that they leave a choice is none.
pub fn run(
    file: &Path,
    cycle: Option<&str>,
    as_json: bool,
    terminal: &Terminal,
) -> Result<(), Failure> {
    let draft = Draft::read(file).map_err(|e| failure(&e, file))?;
    let chosen = draft.allowed.choose(cycle.or(draft.tiling()));
    let takes = chosen.as_ref().ok().map(|t| t.name);
    let text = if as_json {
        json::allowed(&draft.allowed, &draft.kinds, takes)
    } else {
        let why = match (cycle, draft.tiling()) {
            (Some(_), _) => "as asked for",
            (None, Some(_)) => "as the file says",
            (None, None) => "the only one",
        };
        page(&draft, takes.map(|name| (name, why)), terminal)
    };
    print(text.as_bytes())?;
    match chosen {
        Ok(_) | Err(ChoiceError::Several { .. }) => Ok(()),
        Err(e) => Err(failure(&e.into(), file)),
    }
}

fn page(draft: &Draft, takes: Option<(&str, &str)>, terminal: &Terminal) -> String {
    let Draft { kinds, rules, allowed, .. } = draft;
    let mut page = Page::new(terminal);
    page.head("Round a vertex");
    let wide = allowed.cycles.iter().map(|c| c.configuration.len()).max().unwrap_or(0);
    for cycle in &allowed.cycles {
        let units: Vec<&str> = cycle.kinds.iter().map(|&k| kinds[k].name.as_str()).collect();
        page.broken(&format!("  {:<wide$}  ", cycle.configuration), &units.join(", "));
    }
    page.head("Tilings");
    if allowed.tilings.is_empty() {
        page.line("none");
    }
    allowed.tilings.iter().for_each(|t| page.line(t.name));
    if !allowed.unlaid.is_empty() {
        page.head("Round each vertex, but not as a whole");
        let reasons = allowed.unlaid.iter().map(|(_, e)| e.to_string());
        reasons.for_each(|reason| page.broken("  ", &reason));
    }
    if !allowed.idle.is_empty() {
        page.head("Rules that take no part");
        for &i in &allowed.idle {
            page.broken(&format!("  {:<2}  ", i + 1), &rule_in_words(&rules[i], kinds));
        }
    }
    page.head("The file makes");
    match takes {
        Some((name, why)) => page.line(format!("{name}, {why}")),
        None if allowed.tilings.len() > 1 => page.broken(
            "  ",
            "any of these: say which with tiling = \"...\" in the file, or with --cycle NAME",
        ),
        None => page.line("nothing"),
    }
    page.text
}
