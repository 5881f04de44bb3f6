//! What the builder needs to know of a frame: how long to saw each rod, where to mark
//! it, how it meets its partners and the ground, and which bars to saw it from.
//!
//! Everything here is read off a finished [`Frame`](crate::frame::Frame); nothing
//! changes it. Lengths in mm, angles in radians. No paper and no file formats.

pub mod falsework;
pub mod feet;
pub mod gauges;
pub mod jigs;
pub mod laser;
pub mod lengths;
pub mod marks;
pub mod order;
pub mod saw;

#[cfg(test)]
pub(crate) use crate::frame::fixture;

pub use feet::{Foot, feet};
pub use jigs::{Jig, JigError, JigSettings, Jigs, jigs};
pub use lengths::{LengthClass, LengthClasses, Stick, classes};
pub use marks::{Mark, Side, marks};
pub use order::{Assembly, Order, OrderSettings, assembly};
pub use saw::{Aim, Bar, BarGroup, CutError, CutPlan, Offer, Piece, Purchase, Stock};

/// A name in letters, counted from zero: `a` … `z`, `aa`, `ab` … with `first` = `'a'`.
pub(crate) fn letters(index: usize, first: char) -> String {
    let first = first as u32;
    let mut left = index + 1;
    let mut name = Vec::new();
    while left > 0 {
        left -= 1;
        name.extend(char::from_u32(first + (left % 26) as u32));
        left /= 26;
    }
    name.iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::letters;

    #[test]
    fn letters_go_on_after_z() {
        let names: Vec<_> = [0, 25, 26, 51, 52, 701, 702].map(|i| letters(i, 'A')).into();
        assert_eq!(names, ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]);
        assert_eq!(letters(2, 'a'), "c");
    }
}
