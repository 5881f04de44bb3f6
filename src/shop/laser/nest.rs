//! Parts laid out on sheets.
//!
//! Upright boxes are laid one by one, the largest first, into the free rectangle that they fill
//! best, as they are or turned by a quarter (Jylänki, *A Thousand Ways to Pack the Bin*, 2010:
//! maximal rectangles, best short side fit). Boxes of parts that are narrow at one end leave
//! some board unused; what they never do is overlap.

/// Free border of a sheet, mm: board is chipped there, and lies askew in the laser.
pub const MARGIN: f64 = 5.0;
/// Between parts, mm: what is left keeps its hold while the laser goes round.
pub const GAP: f64 = 3.0;
/// Width and height of the rectangle that every sheet has in its lower left corner, to be
/// measured after import and after cutting.
pub const REFERENCE: [f64; 2] = [100.0, 10.0];

/// Where a part lies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spot {
    /// The sheet, counted from zero.
    pub sheet: usize,
    /// Lower left corner of its box, mm.
    pub corner: [f64; 2],
    /// Whether it is turned by a quarter.
    pub turned: bool,
}

/// The places of all parts.
#[derive(Clone, PartialEq, Debug)]
pub struct Nest {
    /// In the order of the parts.
    pub spots: Vec<Spot>,
    /// How many sheets they take.
    pub sheets: usize,
}

/// Width and height within the margins of a sheet that a part may fill beside the reference.
pub fn room([width, height]: [f64; 2]) -> [f64; 2] {
    [width - 2.0 * MARGIN, height - 2.0 * MARGIN - REFERENCE[1] - GAP]
}

/// Lays boxes of these widths and heights out on sheets.
///
/// # Errors
/// The first box that fits no sheet.
pub fn nest(sizes: &[[f64; 2]], sheet: [f64; 2]) -> Result<Nest, usize> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    let sides = |i: usize| {
        let [w, h] = sizes[i];
        [w.max(h), w.min(h)]
    };
    order.sort_by(|&i, &j| {
        let ([a, b], [c, d]) = (sides(i), sides(j));
        c.total_cmp(&a).then(d.total_cmp(&b)).then(i.cmp(&j))
    });
    let mut sheets: Vec<Free> = Vec::new();
    let mut spots = vec![Spot { sheet: 0, corner: [0.0; 2], turned: false }; sizes.len()];
    for i in order {
        let found = sheets.iter().enumerate().find_map(|(k, free)| Some((k, free.fit(sizes[i])?)));
        let (k, (corner, turned)) = match found {
            Some(found) => found,
            None => {
                let free = Free::new(sheet);
                let fit = free.fit(sizes[i]).ok_or(i)?;
                sheets.push(free);
                (sheets.len() - 1, fit)
            }
        };
        let [w, h] = sizes[i];
        sheets[k].take(corner, if turned { [h, w] } else { [w, h] });
        spots[i] = Spot { sheet: k, corner, turned };
    }
    Ok(Nest { spots, sheets: sheets.len() })
}

/// A lower left corner, and whether the box is turned.
type Fit = ([f64; 2], bool);

/// What is free of a sheet: rectangles from corner to corner that may overlap, none within
/// another. They reach beyond the sheet's margins by the gap that a part needs there only
/// towards others.
struct Free(Vec<[[f64; 2]; 2]>);

impl Free {
    fn new([width, height]: [f64; 2]) -> Self {
        let far = [width - MARGIN + GAP, height - MARGIN + GAP];
        let mut free = Self(vec![[[MARGIN; 2], far]]);
        free.take([MARGIN; 2], REFERENCE);
        free
    }

    /// The best place for a box, and whether it is turned.
    fn fit(&self, [w, h]: [f64; 2]) -> Option<Fit> {
        let mut best: Option<Fit> = None;
        let mut least = [f64::INFINITY; 3];
        for &[lo, hi] in &self.0 {
            for (turned, [w, h]) in [(false, [w, h]), (true, [h, w])] {
                let spare = [hi[0] - lo[0] - w - GAP, hi[1] - lo[1] - h - GAP];
                if spare[0].min(spare[1]) < -ROUNDING {
                    continue;
                }
                let key = [spare[0].min(spare[1]), lo[1], lo[0]];
                if key < least {
                    (least, best) = (key, Some((lo, turned)));
                }
            }
        }
        best
    }

    /// Takes a box out of what is free.
    fn take(&mut self, lo: [f64; 2], [w, h]: [f64; 2]) {
        let taken = [lo, [lo[0] + w + GAP, lo[1] + h + GAP]];
        let mut left = Vec::new();
        for rect in self.0.drain(..) {
            if (0..2).any(|i| taken[1][i] <= rect[0][i] || rect[1][i] <= taken[0][i]) {
                left.push(rect);
                continue;
            }
            for i in 0..2 {
                let (mut before, mut behind) = (rect, rect);
                before[1][i] = taken[0][i];
                behind[0][i] = taken[1][i];
                left.extend([before, behind].into_iter().filter(|r| r[1][i] - r[0][i] > GAP));
            }
        }
        let within = |a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]| {
            (0..2).all(|i| b[0][i] <= a[0][i] && a[1][i] <= b[1][i])
        };
        for (i, rect) in left.iter().enumerate() {
            let covered = left.iter().enumerate().any(|(j, other)| {
                // Of two alike the first one stays.
                i != j && within(rect, other) && (j < i || !within(other, rect))
            });
            if !covered {
                self.0.push(*rect);
            }
        }
    }
}

/// Boxes may be larger than a free place by this, mm: sums carry noise.
const ROUNDING: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_keep_apart_and_on_the_sheet(
            sizes in proptest::collection::vec([3.0..180.0f64, 3.0..180.0f64], 1..60),
        ) {
            let sheet = [300.0, 200.0];
            let nest = nest(&sizes, sheet).unwrap();
            let area: f64 = sizes.iter().map(|[w, h]| w * h).sum();
            prop_assert!(nest.sheets as f64 >= area / (sheet[0] * sheet[1]));
            let mut boxes: Vec<(usize, [[f64; 2]; 2])> = Vec::new();
            for (spot, &[w, h]) in nest.spots.iter().zip(&sizes) {
                let [w, h] = if spot.turned { [h, w] } else { [w, h] };
                let [x, y] = spot.corner;
                prop_assert!(x >= MARGIN && y >= MARGIN);
                prop_assert!(x + w <= sheet[0] - MARGIN + 1e-6 && y + h <= sheet[1] - MARGIN + 1e-6);
                boxes.push((spot.sheet, [[x, y], [x + w, y + h]]));
            }
            for k in 0..nest.sheets {
                boxes.push((k, [[MARGIN; 2], [MARGIN + REFERENCE[0], MARGIN + REFERENCE[1]]]));
            }
            for (i, (k, a)) in boxes.iter().enumerate() {
                for (_, b) in boxes[..i].iter().filter(|(l, _)| l == k) {
                    let apart = (0..2).any(|d| {
                        a[1][d] + GAP <= b[0][d] + 1e-6 || b[1][d] + GAP <= a[0][d] + 1e-6
                    });
                    prop_assert!(apart, "{a:?} {b:?}");
                }
            }
        }
    }

    #[test]
    fn a_part_that_fits_only_turned_is_turned_and_one_that_never_fits_is_named() {
        let sheet = [300.0, 200.0];
        assert!(nest(&[[20.0, 280.0]], sheet).unwrap().spots[0].turned);
        assert_eq!(nest(&[[20.0, 20.0], [295.0, 20.0]], sheet), Err(1));
        let [w, h] = room(sheet);
        assert_eq!(nest(&[[w, h]], sheet).unwrap().sheets, 1);
    }
}
