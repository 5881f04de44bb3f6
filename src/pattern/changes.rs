//! Names most like one that was mistyped.

/// The `count` names most like `name`, the likeliest first: those that begin with it, then
/// those that take fewest changes.
pub(super) fn nearest<'a>(name: &str, mut names: Vec<&'a str>, count: usize) -> Vec<&'a str> {
    names.sort_by_cached_key(|known| (!known.starts_with(name), changes(name, known)));
    names.truncate(count);
    names
}

/// Letters to insert, remove or replace to make one text of the other (Levenshtein).
fn changes(from: &str, to: &str) -> usize {
    let mut row: Vec<usize> = (0..=to.chars().count()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in to.chars().enumerate() {
            let least = (row[j].min(row[j + 1]) + 1).min(diagonal + usize::from(a != b));
            diagonal = std::mem::replace(&mut row[j + 1], least);
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Pattern;

    #[test]
    fn a_slip_of_the_pen_is_seen() {
        assert_eq!(changes("kitten", "sitting"), 3);
        assert_eq!(changes("", "3.6"), 3);
        assert_eq!(Pattern::near("3.6.6.3")[0], "3.6.3.6");
        assert_eq!(Pattern::near("3.3.3.4.4+4.4.4.4")[..2], LIKE_SQUARES);
        assert_eq!(Pattern::near("").len(), 3);
    }

    const LIKE_SQUARES: [&str; 2] = ["3.3.3.4.4+4.4.4.4-1", "3.3.3.4.4+4.4.4.4-2"];
}
