//! What is wrong with a frame, and which units to leave out for it.

use crate::ids::UnitId;
use std::collections::BTreeMap;

/// Something wrong with some units.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// The units, any one of which would mend it by its absence.
    pub units: Vec<UnitId>,
    /// What is wrong, as a clause.
    pub reason: String,
}

/// Units whose absence would mend all faults, each with the first of its faults: in
/// turn the unit with the most faults left, of equals the outermost.
pub fn cover(faults: &[Fault]) -> Vec<(UnitId, String)> {
    let mut left: Vec<&Fault> = faults.iter().collect();
    let mut chosen = Vec::new();
    while !left.is_empty() {
        let mut counts: BTreeMap<UnitId, usize> = BTreeMap::new();
        for unit in left.iter().flat_map(|f| &f.units) {
            *counts.entry(*unit).or_default() += 1;
        }
        let (&unit, _) = counts
            .iter()
            .max_by_key(|&(unit, count)| (*count, *unit))
            .expect("every fault names at least one unit");
        let (mended, rest): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|f| f.units.contains(&unit));
        chosen.push((unit, mended[0].reason.clone()));
        left = rest;
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;

    fn fault(units: &[usize], reason: &str) -> Fault {
        Fault { units: units.iter().map(|&u| UnitId::new(u)).collect(), reason: reason.into() }
    }

    #[test]
    fn the_unit_with_most_faults_goes_first_and_of_equals_the_outermost() {
        let faults = [fault(&[1, 2], "p"), fault(&[2, 5], "q"), fault(&[7, 8], "r")];
        let chosen: Vec<_> = cover(&faults).into_iter().map(|(u, r)| (u.index(), r)).collect();
        assert_eq!(chosen, [(2, "p".to_string()), (8, "r".to_string())]);
    }
}
