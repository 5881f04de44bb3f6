//! Cuts a surface by a level plane and keeps what lies above.
//!
//! Every vertex lies above the plane, below it, or in it; the rest follows from these
//! signs alone. Triangles with no corner above are dropped, those in the plane among
//! them. Edges that lead from above to below get a vertex where they meet the plane,
//! which both neighbours share, so that the cut surface hangs together as before. Where
//! the plane touches a saddle in a vertex, the parts above get a vertex each.
//!
//! The triangles at the cut can be as thin as they come: a vertex is moved into the
//! plane only when it lies within [`SNAP`] of it, so that the surface keeps its shape.

use crate::ids::{FaceId, IdVec, VertexId};
use crate::surface::bow_ties::split_bow_ties;
use crate::surface::component::{part, part_of_polygons};
use crate::surface::polygons::PolygonMesh;
use crate::surface::{Mesh, Point3};
use crate::units::{Length, UnitError};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt;
use std::str::FromStr;

/// A level plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CutPlane {
    /// At this height in the surface's own figures.
    Height(Length),
    /// At so many percent of the way from its lowest to its highest point.
    Percent(f64),
}

/// Why a text is no plane.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum CutPlaneError {
    /// It does not begin with `z=`.
    #[error("{0:?} is no plane to cut at; write z=120mm for a height, or z=40% for a share of it")]
    NoAxis(String),
    /// What follows is neither a height nor a share.
    #[error("{0:?} is no plane to cut at: {1}")]
    NoHeight(String, String),
    /// The share is not one of the height.
    #[error("{0:?} is no plane to cut at: a share of the height is from 0% to 100%")]
    Share(String),
}

/// Why a surface cannot be cut.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum CutFault {
    /// The plane passes over or under the whole surface.
    #[error(
        "the cut {plane} is at {} mm, but the surface reaches from {} to {} mm",
        figure(*.at), figure(.range[0]), figure(.range[1])
    )]
    Outside {
        /// The plane asked for.
        plane: CutPlane,
        /// Its height, mm.
        at: f64,
        /// Heights of the lowest and the highest point, mm.
        range: [f64; 2],
    },
    /// Nothing is left above the plane, though it touches the surface.
    #[error(
        "nothing lies above the cut {plane}: the surface reaches from {} to {} mm",
        figure(.range[0]), figure(.range[1])
    )]
    NothingAbove {
        /// The plane asked for.
        plane: CutPlane,
        /// Heights of the lowest and the highest point, mm.
        range: [f64; 2],
    },
    /// There is no surface.
    #[error("there is nothing to cut: the surface has no triangles")]
    Empty,
}

impl CutFault {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Outside { .. } | Self::NothingAbove { .. } => {
                "cut between these heights, which are those before --span, or at a share of \
                 them such as --cut z=30%"
            }
            Self::Empty => "export the surface again",
        }
    }
}

/// A height in a message, to the micrometre.
fn figure(mm: f64) -> f64 {
    // Adding zero turns -0 into 0.
    (mm * 1e3).round() / 1e3 + 0.0
}

/// Vertices nearer to the plane than this share of the bounding box's diagonal are moved
/// into it. Smaller, and triangles come up that are too small to be told from points;
/// larger, and the surface changes visibly.
const SNAP: f64 = 1e-6;

impl CutPlane {
    /// Its height on a mesh that reaches from `low` to `high`, mm.
    pub fn height(self, [low, high]: [f64; 2]) -> f64 {
        match self {
            Self::Height(h) => h.mm(),
            // Exact at both ends.
            Self::Percent(p) => low * (1.0 - p / 100.0) + high * (p / 100.0),
        }
    }
}

/// What lies above a plane, as a mesh whose vertices are those left, in their order, and
/// then the new ones. It may be in several pieces.
///
/// # Errors
/// A plane that passes by the surface, or leaves nothing of it.
pub fn cut(mesh: &Mesh, plane: CutPlane) -> Result<Mesh, CutFault> {
    let mesh = part(mesh, |_| true);
    let Level { at, snap, range } = level(plane, mesh.bounds())?;
    let mut cutter = Cutter::new(mesh, at, snap);
    for face in cutter.mesh.triangles.ids() {
        cutter.add(face);
    }
    let Cutter { mut mesh, triangles, .. } = cutter;
    if triangles.is_empty() {
        return Err(CutFault::NothingAbove { plane, range });
    }
    mesh.triangles = triangles;
    Ok(split_bow_ties(part(&mesh, |_| true)).0)
}

/// The polygons that lie wholly above a plane or in it, as a mesh of their own.
///
/// # Errors
/// A plane that passes by the surface, or leaves no polygon whole.
pub fn whole_above(mesh: &PolygonMesh, plane: CutPlane) -> Result<PolygonMesh, CutFault> {
    let Level { at, snap, range } = level(plane, mesh.bounds())?;
    let above = |face: &&Vec<VertexId>| face.iter().all(|&v| mesh.points[v].z >= at - snap);
    let kept = part_of_polygons(mesh, mesh.faces.iter().filter(above));
    if kept.faces.is_empty() { Err(CutFault::NothingAbove { plane, range }) } else { Ok(kept) }
}

/// A plane on a surface, mm.
struct Level {
    at: f64,
    /// Vertices this near count as in it.
    snap: f64,
    /// Heights of the lowest and the highest point.
    range: [f64; 2],
}

/// Where a plane lies on a surface of these bounds.
fn level(plane: CutPlane, bounds: Option<[Point3; 2]>) -> Result<Level, CutFault> {
    let [lo, hi] = bounds.ok_or(CutFault::Empty)?;
    let snap = SNAP * (hi - lo).norm();
    let range = [lo.z, hi.z];
    let at = plane.height(range);
    if at < lo.z - snap || at > hi.z + snap {
        return Err(CutFault::Outside { plane, at, range });
    }
    Ok(Level { at, snap, range })
}

/// Where a vertex lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    Above,
    In,
    Below,
}

struct Cutter {
    /// The mesh, with the new vertices behind its own.
    mesh: Mesh,
    /// Height of the plane.
    at: f64,
    sides: IdVec<VertexId, Side>,
    /// The new vertex of each edge that is cut, by its ends above and below.
    crossings: HashMap<[VertexId; 2], VertexId>,
    /// What is left.
    triangles: IdVec<FaceId, [VertexId; 3]>,
}

impl Cutter {
    /// Tells the sides, and moves vertices that lie next to the plane into it.
    fn new(mut mesh: Mesh, at: f64, snap: f64) -> Self {
        let side = |p: &mut Point3| {
            if (p.z - at).abs() <= snap {
                p.z = at;
                Side::In
            } else if p.z > at {
                Side::Above
            } else {
                Side::Below
            }
        };
        let sides = mesh.points.iter_mut().map(side).collect();
        Self { mesh, at, sides, crossings: HashMap::new(), triangles: IdVec::new() }
    }

    /// Adds what lies above of a triangle.
    fn add(&mut self, face: FaceId) {
        use Side::{Above, Below, In};
        let t = self.mesh.triangles[face];
        let sides = t.map(|v| self.sides[v]);
        if !sides.contains(&Above) {
            return;
        }
        if !sides.contains(&Below) {
            self.triangles.push(t);
            return;
        }
        // Turn the triangle so that `a` is above and whatever follows it is not: that
        // leaves three cases.
        let turn = (0..3).find(|&k| sides[k] == Above && sides[(k + 1) % 3] != Above);
        let k = turn.expect("a corner above and one below: some corner above is followed so");
        let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
        match [sides[(k + 1) % 3], sides[(k + 2) % 3]] {
            [In, _] => {
                let ca = self.crossing(a, c);
                self.triangles.push([a, b, ca]);
            }
            [_, In] => {
                let ab = self.crossing(a, b);
                self.triangles.push([a, ab, c]);
            }
            [_, Below] => {
                let (ab, ca) = (self.crossing(a, b), self.crossing(a, c));
                self.triangles.push([a, ab, ca]);
            }
            [_, Above] => {
                let (ab, cb) = (self.crossing(a, b), self.crossing(c, b));
                // The four corners a, ab, cb, c, cut along the shorter diagonal.
                if self.distance(a, cb) <= self.distance(ab, c) {
                    self.triangles.push([a, ab, cb]);
                    self.triangles.push([a, cb, c]);
                } else {
                    self.triangles.push([a, ab, c]);
                    self.triangles.push([ab, cb, c]);
                }
            }
        }
    }

    /// The vertex where an edge from above to below meets the plane.
    fn crossing(&mut self, above: VertexId, below: VertexId) -> VertexId {
        match self.crossings.entry([above, below]) {
            Entry::Occupied(found) => *found.get(),
            Entry::Vacant(place) => {
                let (p, q) = (self.mesh.points[above], self.mesh.points[below]);
                let share = (p.z - self.at) / (p.z - q.z);
                let mut new = p + (q - p) * share;
                new.z = self.at;
                *place.insert(self.mesh.points.push(new))
            }
        }
    }

    fn distance(&self, a: VertexId, b: VertexId) -> f64 {
        (self.mesh.points[a] - self.mesh.points[b]).norm()
    }
}

impl FromStr for CutPlane {
    type Err = CutPlaneError;

    fn from_str(text: &str) -> Result<Self, CutPlaneError> {
        let t = text.trim();
        let after = t.strip_prefix(['z', 'Z']).and_then(|t| t.trim_start().strip_prefix('='));
        let height = after.ok_or_else(|| CutPlaneError::NoAxis(t.into()))?.trim();
        let no_height = |e: String| CutPlaneError::NoHeight(t.into(), e);
        if let Some(share) = height.strip_suffix('%') {
            let share = share.trim_end();
            let percent: f64 =
                share.parse().map_err(|_| no_height(format!("`{share}` is not a number")))?;
            return if (0.0..=100.0).contains(&percent) {
                Ok(Self::Percent(percent))
            } else {
                Err(CutPlaneError::Share(t.into()))
            };
        }
        height.parse().map(Self::Height).map_err(|e: UnitError| no_height(e.to_string()))
    }
}

/// With the shortest digits that read back as the same plane.
impl fmt::Display for CutPlane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Height(h) => write!(f, "z={h}"),
            Self::Percent(p) => write!(f, "z={p}%"),
        }
    }
}

impl Serialize for CutPlane {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for CutPlane {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        String::deserialize(d)?.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
#[path = "cut_tests.rs"]
mod tests;
