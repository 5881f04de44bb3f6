//! The patterns that come with the program: the files under templates/patterns/.

use super::Pattern;
use std::sync::LazyLock;

/// Name and text of the files with these names.
macro_rules! files {
    ($($name:literal,)*) => {
        &[$(($name, include_str!(concat!("../../templates/patterns/", $name, ".pattern.toml"))),)*]
    };
}

/// All pattern files, in the order in which they are listed.
const FILES: &[(&str, &str)] = files![
    "4.4.4.4",
    "3.3.3.3.3.3",
    "6.6.6",
    "3.6.3.6",
    "3.4.6.4",
    "3.3.3.4.4",
    "3.3.4.3.4",
    "3.3.3.3.6",
    "4.8.8",
    "3.12.12",
    "4.6.12",
    "3.3.3.3.3.3+3.3.3.3.6-1",
    "3.3.3.3.3.3+3.3.3.3.6-2",
    "3.3.3.3.3.3+3.3.3.4.4-1",
    "3.3.3.3.3.3+3.3.3.4.4-2",
    "3.3.3.3.3.3+3.3.4.3.4",
    "3.3.3.3.3.3+3.3.4.12",
    "3.3.3.3.3.3+3.3.6.6",
    "3.3.3.3.6+3.3.6.6",
    "3.3.3.4.4+3.3.4.3.4-1",
    "3.3.3.4.4+3.3.4.3.4-2",
    "3.3.3.4.4+3.4.6.4",
    "3.3.3.4.4+4.4.4.4-1",
    "3.3.3.4.4+4.4.4.4-2",
    "3.3.4.3.4+3.4.6.4",
    "3.3.6.6+3.6.3.6",
    "3.4.3.12+3.12.12",
    "3.4.4.6+3.4.6.4",
    "3.4.4.6+3.6.3.6-1",
    "3.4.4.6+3.6.3.6-2",
    "3.4.6.4+4.6.12",
    "da-vinci",
    "large-and-small",
    "stars",
    "basket",
    "rings",
    "squares-end-to-end",
    "triangles-end-to-end",
    "hexagons-end-to-end",
    "zigzag",
    "octagons-end-to-end",
    "basket-end-to-end",
    "octagons-linked",
    "rings-linked",
    "squares-resting",
    "triangles-resting",
    "hexagons-resting",
    "crossing",
    "window",
    "bug",
];

static LIBRARY: LazyLock<Vec<Pattern>> = LazyLock::new(|| {
    let read = |(name, text): &(&str, &str)| {
        Pattern::parse(text, name).expect("the files of the library are sound: tested below")
    };
    FILES.iter().map(read).collect()
});

/// All patterns that come with the program, in the order in which they are listed.
pub fn library() -> &'static [Pattern] {
    &LIBRARY
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tiling::UNIFORM;
    use std::collections::BTreeSet;

    #[test]
    fn every_file_is_in_the_list_and_sound() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/templates/patterns");
        let on_disk: BTreeSet<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        let listed = FILES.iter().map(|(name, _)| format!("{name}.pattern.toml")).collect();
        assert_eq!(on_disk, listed);
        for (name, text) in FILES {
            let pattern = Pattern::parse(text, "none").unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(pattern.name, *name);
        }
    }

    #[test]
    fn every_tiling_has_its_pattern_and_no_two_are_described_alike() {
        let patterns: BTreeSet<&str> = library().iter().map(|p| p.name.as_str()).collect();
        assert!(UNIFORM.iter().all(|t| patterns.contains(t.name)));
        let summaries: BTreeSet<&str> = library().iter().map(|p| p.summary.as_str()).collect();
        assert_eq!(summaries.len(), library().len());
        assert!(library().iter().all(|p| !p.source.is_empty()));
    }
}
