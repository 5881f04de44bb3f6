//! The texts of all languages, and what becomes of texts of the user's.

use super::language::FILES;
use super::*;
use crate::sheets::{cover, cut_list, page};
use std::fs;

fn of(language: Language) -> Texts {
    Texts::built_in(language).unwrap_or_else(|e| panic!("{e}"))
}

/// A folder with files of texts.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// What is wrong with files of texts, after the folder's path.
fn fault(files: &[(&str, &str)]) -> String {
    let folder = folder(files);
    let error = Texts::with_folder(Language::En, folder.path()).unwrap_err().to_string();
    let start = folder.path().display().to_string();
    error.split_once(&format!("{start}/")).unwrap_or_else(|| panic!("{error}")).1.to_owned()
}

/// Loading tries every text with the same values and finds what is missing or too much.
#[test]
fn all_languages_have_the_same_texts_and_all_can_be_said() {
    // And the handout.
    let count = FILES.iter().flat_map(|file| file.all()).count() + 1;
    for language in Language::ALL {
        let texts = of(language);
        assert_eq!(texts.0.sources.len(), count);
        assert_eq!(texts.language(), language.name());
    }
    assert!(count > 100);
}

/// A value that a text leaves out is a figure that the reader of that language misses.
#[test]
fn texts_use_all_their_values_in_every_language() {
    // The words about a pattern are English.
    let left_out = [("de", "note-pattern", "summary")];
    for language in Language::ALL {
        let texts = of(language);
        for file in FILES {
            for entry in file.all() {
                let name = template_name(file.name, entry.key);
                let template = texts.0.environment.get_template(&name).unwrap();
                let used = template.undeclared_variables(false);
                for (value, _) in entry.values {
                    let known = left_out.contains(&(language.name(), entry.key, value));
                    assert!(known || used.contains(*value), "{language:?} {name}: {value}");
                }
            }
        }
    }
}

#[test]
fn a_key_stands_in_one_list_only() {
    for file in FILES {
        let mut keys: Vec<&str> = file.all().map(|entry| entry.key).collect();
        let count = keys.len();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), count, "{}", file.name);
    }
}

#[test]
fn lines_are_joined_and_plurals_agree() {
    let texts = of(Language::En);
    let parts = |rods, feet| texts.say(cover::say::Parts { rods, contacts: 2, feet }).unwrap();
    assert_eq!(parts(1, 1), "1 rod, 2 contacts, 1 foot");
    assert_eq!(parts(21, 0), "21 rods, 2 contacts, 0 feet");
    let units = cover::say::Units { units: 3, clockwise: 2, counter_clockwise: 1 };
    assert_eq!(
        texts.say(units).unwrap(),
        "3 units; seen from outside, 2 run clockwise and 1 counter-clockwise"
    );
    let worth = cut_list::say::WorthBars { spent: 8, least: 8, proven: true };
    assert_eq!(
        texts.say(worth).unwrap(),
        "8 bars to buy; no plan needs fewer than 8 bars: this is the best possible."
    );
}

#[test]
fn a_text_of_the_users_takes_the_place_of_ours_and_the_rest_stays() {
    let folder = folder(&[
        ("cover.toml", "title = \"Our dome\"\n"),
        ("page.toml", "decimal = \"·\""),
        ("README.md", "Texts of our school."),
        (".hidden", "x"),
    ]);
    let texts = Texts::with_folder(Language::De, folder.path()).unwrap();
    assert_eq!(texts.say(cover::say::Title {}).unwrap(), "Our dome");
    assert_eq!((texts.decimal(), texts.language()), ('·', "de"));
    let (ours, german) = (cover::say::ToBuy {}, of(Language::De));
    assert_eq!(texts.say(cover::say::ToBuy {}).unwrap(), german.say(ours).unwrap());
    assert_ne!(texts, german);
    assert_eq!(german, of(Language::De));
}

#[test]
fn what_is_wrong_is_said_with_file_and_line() {
    for (text, start) in [
        ("title = \"x\"\n\ntitel = \"y\"", "cover.toml: line 3: cover.toml has no text titel"),
        (
            "\npage-number = \"y\"",
            "cover.toml: line 2: the text page-number belongs into page.toml",
        ),
        ("title = \"x\"\nmodel = \"{{ \"", "cover.toml: line 2: the text model: syntax error"),
        ("title = \"{% if %}\"", "cover.toml: line 1: the text title: syntax error"),
        ("title = 3", "cover.toml: line 1: invalid type"),
        ("title = \"x\"\ntitle = \"y\"", "cover.toml: line 2: duplicate key"),
        ("title = \"x\nmodel = 3", "cover.toml: line 1: "),
        ("[cover]\ntitle = \"x\"", "cover.toml: line 1: "),
        (
            "title = \"x\"\ncost = \"{{ price }}\"",
            "cover.toml: line 2: the text cost has no value price: its values are cost",
        ),
        (
            "title = \"{{ cost }}\"",
            "cover.toml: line 1: the text title has no value cost: it takes",
        ),
        (
            "title = \"x\"\ncost = '''\na\n{% if false %}{{ prize }}{% endif %}'''",
            "cover.toml: line 4: the text cost has no value prize",
        ),
        ("cost = '''\n{{ cost }}\n{{ cost|shout }}'''", "cover.toml: line 3: the text cost: "),
        ("cost = \"\"\"a {{ cost }}\n b {% endif %}\"\"\"", "cover.toml: line 2: the text cost: "),
        ("title = 'a\u{732b}'", "cover.toml: line 1: the text title: the font of the papers"),
        ("cost = '{{ cost + 1 }}'", "cover.toml: line 1: the text cost: "),
    ] {
        let said = fault(&[("cover.toml", text)]);
        assert!(said.starts_with(start), "{text:?}\n  gives {said}\n  not   {start}");
    }
    let said = fault(&[("page.toml", "language = 'de'\ndecimal = ''")]);
    assert!(said.starts_with("page.toml: line 2: the text decimal must be one sign"), "{said}");
}

#[test]
fn files_that_are_not_texts_are_refused_with_those_that_are() {
    let said = fault(&[("covers.toml", "")]);
    assert!(
        said.starts_with("covers.toml is not a file of texts: there are page.toml, "),
        "{said}"
    );
    let error = Texts::with_folder(Language::En, Path::new("no/such/folder")).unwrap_err();
    assert!(error.is_io() && error.to_string().contains("no/such/folder"), "{error}");
}

/// A template that works in trials may still fail on a model, which is an error that names it.
#[test]
fn a_text_that_fails_on_a_model_is_named() {
    let text = "page-number = '{% if count == 4711 %}{{ number // 0 }}{% endif %}'";
    let folder = folder(&[("page.toml", text)]);
    let texts = Texts::with_folder(Language::En, folder.path()).unwrap();
    let error = texts.say(page::say::PageNumber { number: 1, count: 4711 }).unwrap_err();
    assert!(error.to_string().starts_with("page.toml: the text page-number cannot"), "{error}");
}
