//! The least vertex cover of pairs between two sides.

use std::collections::VecDeque;

/// Nobody.
const NONE: u32 = u32::MAX;

/// With whom each of a left side is paired on a right side.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    /// Where those of each of the left end in `others`.
    ends: Vec<u32>,
    others: Vec<u32>,
    /// How many are on the right.
    right: usize,
}

impl Pairs {
    /// None yet, with so many on the right.
    pub fn new(right: usize) -> Self {
        Self { right, ..Self::default() }
    }

    /// Adds the next of the left, paired with these of the right.
    pub fn push(&mut self, others: impl Iterator<Item = u32>) {
        self.others.extend(others);
        self.ends.push(self.others.len() as u32);
    }

    fn left(&self) -> u32 {
        self.ends.len() as u32
    }

    fn of(&self, i: u32) -> &[u32] {
        let start = if i == 0 { 0 } else { self.ends[i as usize - 1] };
        &self.others[start as usize..self.ends[i as usize] as usize]
    }
}

/// The fewest of a left and a right side of which one is in every pair. By Kőnig's theorem they
/// are as many as pairs can be chosen that share nobody; these are found by alternating paths.
pub fn least_cover(pairs: &Pairs) -> [Vec<u32>; 2] {
    let right = pairs.right;
    let mut matching = Matching::greedy(pairs);
    let mut search = Search::new(pairs);
    for i in 0..pairs.left() {
        if matching.of_left[i as usize] == NONE {
            search.begin();
            if let Some(end) = search.run(&[i], &matching) {
                matching.swap(&search.came_from, end);
            }
        }
    }
    let free: Vec<u32> =
        (0..pairs.left()).filter(|&i| matching.of_left[i as usize] == NONE).collect();
    search.begin();
    search.run(&free, &matching);
    let mut reached = vec![false; pairs.left() as usize];
    free.iter().for_each(|&i| reached[i as usize] = true);
    let covers: Vec<u32> = (0..right as u32).filter(|&j| search.is_seen(j)).collect();
    // All that are seen have a partner, or the matching could grow.
    covers.iter().for_each(|&j| reached[matching.of_right[j as usize] as usize] = true);
    let left = (0..pairs.left()).filter(|&i| !reached[i as usize]).collect();
    [left, covers]
}

/// Pairs that share nobody.
struct Matching {
    of_left: Vec<u32>,
    of_right: Vec<u32>,
}

impl Matching {
    /// Each of the left takes the first that is free.
    fn greedy(pairs: &Pairs) -> Self {
        let mut of_right = vec![NONE; pairs.right];
        let mut take = |i: u32| {
            let free = pairs.of(i).iter().copied().find(|&j| of_right[j as usize] == NONE)?;
            of_right[free as usize] = i;
            Some(free)
        };
        let of_left = (0..pairs.left()).map(|i| take(i).unwrap_or(NONE)).collect();
        Self { of_left, of_right }
    }

    /// Swaps the pairs along a path to somebody free on the right.
    fn swap(&mut self, came_from: &[u32], end: u32) {
        let mut right = end;
        while right != NONE {
            let left = came_from[right as usize];
            self.of_right[right as usize] = left;
            right = std::mem::replace(&mut self.of_left[left as usize], right);
        }
    }
}

/// A search along alternating paths.
struct Search<'a> {
    pairs: &'a Pairs,
    /// In which search each of the right was seen last.
    seen: Vec<u32>,
    round: u32,
    came_from: Vec<u32>,
    /// From whom to go on.
    next: VecDeque<u32>,
}

impl<'a> Search<'a> {
    fn new(pairs: &'a Pairs) -> Self {
        let right = pairs.right;
        let (seen, came_from) = (vec![0; right], vec![NONE; right]);
        Self { pairs, seen, round: 0, came_from, next: VecDeque::new() }
    }

    fn begin(&mut self) {
        self.round += 1;
    }

    fn is_seen(&self, j: u32) -> bool {
        self.seen[j as usize] == self.round
    }

    /// Goes on from some of the left until somebody free is met on the right, who is returned.
    fn run(&mut self, from: &[u32], matching: &Matching) -> Option<u32> {
        self.next.clear();
        self.next.extend(from);
        while let Some(i) = self.next.pop_front() {
            for &j in self.pairs.of(i) {
                if self.seen[j as usize] == self.round {
                    continue;
                }
                self.seen[j as usize] = self.round;
                self.came_from[j as usize] = i;
                match matching.of_right[j as usize] {
                    NONE => return Some(j),
                    partner => self.next.push_back(partner),
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(left: &[&[u32]], right: usize) -> Pairs {
        let mut pairs = Pairs::new(right);
        left.iter().for_each(|with| pairs.push(with.iter().copied()));
        pairs
    }

    fn is_cover(pairs: &Pairs, [left, right]: &[Vec<u32>; 2]) -> bool {
        let is_covered =
            |i: u32| left.contains(&i) || pairs.of(i).iter().all(|j| right.contains(j));
        (0..pairs.left()).all(is_covered)
    }

    #[test]
    fn one_that_is_in_all_pairs_covers_them() {
        assert_eq!(least_cover(&pairs(&[&[0, 1, 2]], 3)), [vec![0], vec![]]);
        assert_eq!(least_cover(&pairs(&[&[0], &[0], &[0]], 1)), [vec![], vec![0]]);
        assert_eq!(least_cover(&pairs(&[&[], &[]], 2)), [Vec::<u32>::new(), vec![]]);
    }

    /// Greedy pairs are too few here: 0-0 has to give way to 0-1 and 1-0.
    #[test]
    fn pairs_are_swapped_where_more_can_be_had() {
        let pairs = pairs(&[&[0, 1], &[0], &[2, 1], &[2]], 3);
        let cover = least_cover(&pairs);
        assert!(is_cover(&pairs, &cover));
        assert_eq!(cover[0].len() + cover[1].len(), 3);
    }

    /// Against all subsets, of all pairings of three with three.
    #[test]
    fn no_smaller_set_covers_all_pairs() {
        for bits in 0_u32..1 << 9 {
            let mut pairs = Pairs::new(3);
            for i in 0..3 {
                pairs.push((0..3).filter(|j| bits >> (3 * i + j) & 1 == 1));
            }
            let chosen = |set: u32| {
                let of = |side: u32| (0..3).filter(move |i| set >> (3 * side + i) & 1 == 1);
                [of(0).collect(), of(1).collect()]
            };
            let least = (0_u32..1 << 6)
                .filter(|&set| is_cover(&pairs, &chosen(set)))
                .map(u32::count_ones)
                .min()
                .unwrap();
            let cover = least_cover(&pairs);
            assert!(is_cover(&pairs, &cover), "{pairs:?}");
            assert_eq!((cover[0].len() + cover[1].len()) as u32, least, "{pairs:?}");
        }
    }
}
