//! Joins vertices that lie at one place, as files leave them at texture seams, between
//! groups, and in triangle soups.
//!
//! A grid of cells twice the tolerance wide holds the vertices kept so far; a vertex is
//! compared with those in the at most eight cells that its neighbourhood touches. Each
//! vertex goes to the nearest kept one within the tolerance, so the outcome depends on
//! the order of vertices only, and chains of near vertices do not grow together.

use crate::ids::{IdVec, VertexId};
use crate::surface::Point3;
use std::collections::HashMap;

/// What was joined. Vertices keep their numbers; joined ones are left unused.
pub(super) struct Weld {
    /// The vertex that each vertex goes to, itself if it is kept.
    pub target: IdVec<VertexId, VertexId>,
    /// How many vertices were joined to another.
    pub joined: usize,
    /// How many of these were near the other, not exactly there.
    pub near: usize,
}

impl Weld {
    /// Moves faces to the kept vertices.
    pub fn apply<F: AsMut<[VertexId]>>(&self, faces: &mut [F]) {
        for v in faces.iter_mut().flat_map(|f| f.as_mut()) {
            *v = self.target[*v];
        }
    }
}

/// Joins vertices no farther apart than `tolerance`, mm. All points must be finite.
pub(super) fn weld(points: &IdVec<VertexId, Point3>, tolerance: f64) -> Weld {
    let mut grid = Grid::new(tolerance);
    let (mut joined, mut near) = (0, 0);
    let mut target: IdVec<VertexId, VertexId> = IdVec::new();
    for (v, &p) in points.enumerate() {
        match grid.nearest(points, p) {
            Some(kept) => {
                joined += 1;
                near += usize::from(points[kept] != p);
                target.push(kept);
            }
            None => {
                grid.insert(p, v);
                target.push(v);
            }
        }
    }
    Weld { target, joined, near }
}

struct Grid {
    tolerance: f64,
    cells: HashMap<[i64; 3], Vec<VertexId>>,
}

impl Grid {
    fn new(tolerance: f64) -> Self {
        Self { tolerance, cells: HashMap::new() }
    }

    /// Cell numbers along each axis. With coordinates up to 1e9 and a tolerance that is
    /// a share of the size they stay within range; a cast saturates in any case.
    fn cell(&self, p: Point3) -> [i64; 3] {
        let width = (2.0 * self.tolerance).max(f64::MIN_POSITIVE);
        [p.x, p.y, p.z].map(|c| (c / width).floor() as i64)
    }

    fn insert(&mut self, p: Point3, v: VertexId) {
        let cell = self.cell(p);
        self.cells.entry(cell).or_default().push(v);
    }

    fn nearest(&self, points: &IdVec<VertexId, Point3>, p: Point3) -> Option<VertexId> {
        let reach = nalgebra::Vector3::repeat(self.tolerance);
        let (lo, hi) = (self.cell(p - reach), self.cell(p + reach));
        let mut best: Option<(f64, VertexId)> = None;
        for x in lo[0]..=hi[0] {
            for y in lo[1]..=hi[1] {
                for z in lo[2]..=hi[2] {
                    for &v in self.cells.get(&[x, y, z]).into_iter().flatten() {
                        let distance = (points[v] - p).norm();
                        let better = best.is_none_or(|b| (distance, v) < b);
                        if distance <= self.tolerance && better {
                            best = Some((distance, v));
                        }
                    }
                }
            }
        }
        best.map(|(_, v)| v)
    }
}
