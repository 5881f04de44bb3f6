//! A tree of boxes over anything that has a box: narrows a search among n items to
//! about log n of them.
//!
//! Median split along the longest side of the centres' box, stored as an array.
//! Building takes O(n log n) and gives the same tree for the same input; equal
//! centres are split by index, so that the depth stays logarithmic for any input.
//! The nearest-item search visits the nearer child first.

use nalgebra::{Point, SVector};

/// An axis-parallel box in `D` dimensions.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Aabb<const D: usize> {
    /// Lower corner.
    pub lo: Point<f64, D>,
    /// Upper corner.
    pub hi: Point<f64, D>,
}

impl<const D: usize> Aabb<D> {
    /// The box that holds nothing: `join` with it changes nothing.
    pub fn empty() -> Self {
        Self {
            lo: SVector::<f64, D>::repeat(f64::INFINITY).into(),
            hi: SVector::<f64, D>::repeat(f64::NEG_INFINITY).into(),
        }
    }

    /// The smallest box around points.
    pub fn around(points: &[Point<f64, D>]) -> Self {
        points.iter().fold(Self::empty(), |b, p| Self { lo: b.lo.inf(p), hi: b.hi.sup(p) })
    }

    /// The smallest box around two boxes.
    pub fn join(&self, other: &Self) -> Self {
        Self { lo: self.lo.inf(&other.lo), hi: self.hi.sup(&other.hi) }
    }

    /// The box grown by `margin` on every side.
    pub fn grown(&self, margin: f64) -> Self {
        let m = SVector::<f64, D>::repeat(margin);
        Self { lo: self.lo - m, hi: self.hi + m }
    }

    /// Whether a point lies in it or on its border.
    pub fn contains(&self, p: &Point<f64, D>) -> bool {
        (0..D).all(|i| self.lo[i] <= p[i] && p[i] <= self.hi[i])
    }

    /// Whether two boxes share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..D).all(|i| self.lo[i] <= other.hi[i] && other.lo[i] <= self.hi[i])
    }

    /// Square of the distance from a point; 0 inside.
    pub fn distance_squared(&self, p: &Point<f64, D>) -> f64 {
        (0..D).map(|i| (self.lo[i] - p[i]).max(p[i] - self.hi[i]).max(0.0).powi(2)).sum()
    }

    /// Where a ray enters, as a multiple of its direction, 0 if it starts inside;
    /// `None` if it passes by. `inverse` holds 1 / direction in each coordinate.
    pub fn ray_entry(&self, origin: &Point<f64, D>, inverse: &SVector<f64, D>) -> Option<f64> {
        let (mut near, mut far) = (0.0_f64, f64::INFINITY);
        for i in 0..D {
            if inverse[i].is_infinite() {
                // Parallel to these two sides: 0 x infinity would make NaN below.
                if origin[i] < self.lo[i] || self.hi[i] < origin[i] {
                    return None;
                }
                continue;
            }
            let t0 = (self.lo[i] - origin[i]) * inverse[i];
            let t1 = (self.hi[i] - origin[i]) * inverse[i];
            near = near.max(t0.min(t1));
            far = far.min(t0.max(t1));
        }
        (near <= far * RAY_SLACK).then_some(near)
    }

    fn centre(&self) -> Point<f64, D> {
        nalgebra::center(&self.lo, &self.hi)
    }
}

/// Factor on where a ray leaves a box, above the rounding of the two products
/// (Ize 2013, "Robust BVH Ray Traversal"): smaller, and a ray along the side of a
/// flat box may slip past it; larger costs a few needless tests.
const RAY_SLACK: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Items in a leaf at most: 4 triangle tests cost about as much as two more levels.
const LEAF: usize = 4;

#[derive(Clone, Debug)]
struct Node<const D: usize> {
    bounds: Aabb<D>,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// A range of `Bvh::order`.
    Leaf { start: u32, end: u32 },
    /// The first child follows its parent; the second stands here.
    Branch { second: u32 },
}

/// A tree of boxes over items 0..n.
#[derive(Clone, Debug)]
pub struct Bvh<const D: usize> {
    nodes: Vec<Node<D>>,
    order: Vec<u32>,
}

impl<const D: usize> Bvh<D> {
    /// Builds the tree over the boxes of the items.
    pub fn new(boxes: &[Aabb<D>]) -> Self {
        let count = u32::try_from(boxes.len()).expect("fewer than 2^32 items: memory ends first");
        let centres: Vec<_> = boxes.iter().map(Aabb::centre).collect();
        let mut tree = Self { nodes: Vec::new(), order: (0..count).collect() };
        if count > 0 {
            tree.split(boxes, &centres, 0, boxes.len());
        }
        tree
    }

    fn split(&mut self, boxes: &[Aabb<D>], centres: &[Point<f64, D>], start: usize, end: usize) {
        let items = &mut self.order[start..end];
        let bounds = items.iter().fold(Aabb::empty(), |b: Aabb<D>, &i| b.join(&boxes[i as usize]));
        let me = self.nodes.len();
        let leaf = Kind::Leaf { start: start as u32, end: end as u32 };
        self.nodes.push(Node { bounds, kind: leaf });
        if items.len() <= LEAF {
            return;
        }
        let spread = items.iter().fold(Aabb::empty(), |b: Aabb<D>, &i| {
            let c = centres[i as usize];
            b.join(&Aabb { lo: c, hi: c })
        });
        let axis = (spread.hi - spread.lo).imax();
        let middle = items.len() / 2;
        items.select_nth_unstable_by(middle, |&i, &j| {
            let (a, b) = (centres[i as usize][axis], centres[j as usize][axis]);
            a.total_cmp(&b).then(i.cmp(&j))
        });
        self.split(boxes, centres, start, start + middle);
        self.nodes[me].kind = Kind::Branch { second: self.nodes.len() as u32 };
        self.split(boxes, centres, start + middle, end);
    }

    /// The item of least `cost`, with its cost. `bound` is a lower limit to the cost
    /// of all items in a box (infinite to skip it); of equal costs the lower item
    /// wins. Items of infinite or undefined cost are never taken.
    pub fn least(
        &self,
        bound: impl Fn(&Aabb<D>) -> f64,
        mut cost: impl FnMut(usize) -> f64,
    ) -> Option<(usize, f64)> {
        let root = self.nodes.first()?;
        let mut best: Option<(usize, f64)> = None;
        let mut stack = vec![(0_usize, bound(&root.bounds))];
        while let Some((at, limit)) = stack.pop() {
            if limit == f64::INFINITY || best.is_some_and(|(_, c)| limit > c) {
                continue;
            }
            match self.nodes[at].kind {
                Kind::Leaf { start, end } => {
                    for &item in &self.order[start as usize..end as usize] {
                        let (item, c) = (item as usize, cost(item as usize));
                        let better = best.is_none_or(|(i, b)| c < b || (c == b && item < i));
                        if c < f64::INFINITY && better {
                            best = Some((item, c));
                        }
                    }
                }
                Kind::Branch { second } => {
                    let a = (at + 1, bound(&self.nodes[at + 1].bounds));
                    let b = (second as usize, bound(&self.nodes[second as usize].bounds));
                    // The nearer one is popped first.
                    stack.extend(if a.1 <= b.1 { [b, a] } else { [a, b] });
                }
            }
        }
        best
    }

    /// Calls `found` for every item in a leaf whose box and whose parents' boxes are
    /// wanted. The caller tests the items themselves.
    pub fn visit(&self, want: impl Fn(&Aabb<D>) -> bool, mut found: impl FnMut(usize)) {
        let mut stack = Vec::new();
        stack.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(at) = stack.pop() {
            let node: &Node<D> = &self.nodes[at];
            if !want(&node.bounds) {
                continue;
            }
            match node.kind {
                Kind::Leaf { start, end } => {
                    for &item in &self.order[start as usize..end as usize] {
                        found(item as usize);
                    }
                }
                Kind::Branch { second } => stack.extend([second as usize, at + 1]),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point2;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = Vec<Aabb<2>>> {
        let side = || (-9_i32..9, 0_i32..4);
        proptest::collection::vec((side(), side()), 0..60).prop_map(|sides| {
            sides
                .iter()
                .map(|&((x, w), (y, h))| Aabb {
                    lo: Point2::new(x.into(), y.into()),
                    hi: Point2::new((x + w).into(), (y + h).into()),
                })
                .collect()
        })
    }

    proptest! {
        #[test]
        fn least_is_the_first_of_the_nearest_boxes(b in boxes(), x in -12_i32..12, y in -12_i32..12) {
            let p = Point2::new(x.into(), y.into());
            let cost = |i: usize| b[i].distance_squared(&p);
            let found = Bvh::new(&b).least(|b| b.distance_squared(&p), cost);
            let brute = (0..b.len()).map(|i| (i, cost(i))).min_by(|a, b| a.1.total_cmp(&b.1));
            prop_assert_eq!(found, brute);
        }

        #[test]
        fn visit_finds_all_boxes_that_overlap(b in boxes(), q in boxes()) {
            let tree = Bvh::new(&b);
            for q in q {
                let mut found = Vec::new();
                tree.visit(|n| n.overlaps(&q), |i| if b[i].overlaps(&q) { found.push(i) });
                found.sort_unstable();
                let brute: Vec<_> = (0..b.len()).filter(|&i| b[i].overlaps(&q)).collect();
                prop_assert_eq!(found, brute);
            }
        }
    }

    #[test]
    fn many_equal_boxes_make_a_shallow_tree() {
        let one = Aabb { lo: Point2::new(0.0, 0.0), hi: Point2::new(1.0, 1.0) };
        let tree = Bvh::new(&vec![one; 10_000]);
        assert_eq!(tree.least(|_| 0.0, |_| 1.0), Some((0, 1.0)));
    }
}
