//! Makes a sound mesh of what a file holds, where the mend is certain, and says what
//! it did; refuses the rest with the places.
//!
//! In order: check numbers and indices; join vertices at one place; take out triangles
//! without area (a needle hands its middle vertex to the neighbour along its longest
//! side, so that no slit stays open), repeated triangles and unused vertices; refuse
//! edges with three triangles; turn triangles so that all face the same way (see
//! `orient`). Numbers in messages are those of the mesh as it
//! came in, counted from 1.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::orient::{Unorientable, orient};
use crate::surface::shape::{counted, place};
use crate::surface::topology::{PLACES, Side, sorted_sides};
use crate::surface::weld::{Weld, weld};
use crate::surface::{Mesh, Point3};
use std::collections::HashSet;

/// A mesh that can be worked with, and what was done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct Mended {
    /// The sound mesh.
    pub mesh: Mesh,
    /// One sentence for each kind of mend.
    pub notes: Vec<String>,
}

/// An edge in a message: its ends, numbered as in the file, and its middle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EdgePlace {
    /// Its end vertices, numbered as in the file.
    pub ends: [VertexId; 2],
    /// Its middle, mm.
    pub middle: Point3,
}

/// What cannot be mended.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum MendError {
    /// No triangles at all.
    #[error("the surface has no triangles")]
    Empty,
    /// A coordinate is not a finite number.
    #[error("vertex {vertex} is at ({}, {}, {}), which is not a place", .at[0], .at[1], .at[2])]
    NotFinite {
        /// The first such vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: [f64; 3],
    },
    /// A coordinate is too large to compute with.
    #[error("vertex {vertex} is at ({:e}, {:e}, {:e}), too far out", .at[0], .at[1], .at[2])]
    TooFar {
        /// The first such vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: [f64; 3],
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {face} uses vertex {vertex}, but the vertices end at {vertices}")]
    VertexOutOfRange {
        /// The triangle.
        face: FaceId,
        /// The vertex that it names.
        vertex: VertexId,
        /// How many vertices there are.
        vertices: usize,
    },
    /// All triangles are points or lines.
    #[error("the surface has no area: all {triangles} triangles are points or lines")]
    NoArea {
        /// How many triangles there are.
        triangles: usize,
    },
    /// Edges with three triangles or more.
    #[error(
        "{} more than two triangles, first {}",
        counted(*.count, "edge carries", "edges carry"), edges(.first)
    )]
    NonManifold {
        /// How many such edges there are.
        count: usize,
        /// The first of them.
        first: Vec<EdgePlace>,
    },
    /// A one-sided surface, such as a Möbius band.
    #[error("the surface has only one side: following it round comes back upside down at {}", edges(&[*.at]))]
    OneSided {
        /// An edge where the two senses meet.
        at: EdgePlace,
    },
}

impl MendError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Empty => "export the surface as a mesh, with its faces",
            Self::NotFinite { .. } | Self::VertexOutOfRange { .. } => {
                "the file is damaged or was written wrongly: export it again"
            }
            Self::TooFar { .. } => "move the surface to the origin and check its units",
            Self::NoArea { .. } => "export the surface again; check that its scale is not zero",
            Self::NonManifold { .. } => {
                "in the modelling program, select non-manifold edges and delete the inner walls \
                 or fins that meet there"
            }
            Self::OneSided { .. } => "cut the band across, or rebuild it with two sides",
        }
    }
}

fn edges(places: &[EdgePlace]) -> String {
    let text = |p: &EdgePlace| {
        format!("between vertices {} and {} near {}", p.ends[0], p.ends[1], place(p.middle))
    };
    places.iter().map(text).collect::<Vec<_>>().join("; ")
}

/// The farthest coordinate taken, mm: a thousand kilometres. Products of four lengths
/// stay far from overflow.
const FARTHEST: f64 = 1e9;

/// Vertices nearer than this share of the bounding box's diagonal are one vertex. Files
/// with six digits differ by that much at seams; larger, and fine detail is lost.
const WELD: f64 = 1e-6;

/// A triangle lower than this share of the bounding box's diagonal has no area: it is
/// as flat as the places of its corners are uncertain.
const FLAT: f64 = WELD;

/// Rounds of handing on needles' middle vertices. Each round mends all needles that do
/// not lie side by side; rows of them are shorter than this.
const NEEDLE_ROUNDS: usize = 32;

/// Mends a mesh as read from a file.
///
/// # Errors
/// What no mend is certain for; see [`MendError::hint`].
pub fn mend(mesh: Mesh) -> Result<Mended, MendError> {
    check(&mesh)?;
    let mut notes = Notes::default();
    let vertices_read = mesh.points.len();
    let triangles_read = mesh.triangles.len();
    let [lo, hi] = mesh.bounds().ok_or(MendError::Empty)?;
    let diagonal = (hi - lo).norm();

    let Weld { mut mesh, joined, near } = weld(mesh, WELD * diagonal);
    notes.say(
        joined - near,
        "vertex at the place of another joined to it",
        "vertices at the place of another joined to it",
    );
    notes.say(near, "vertex next to another joined to it", "vertices next to another joined to it");
    notes.say(
        remove_needles(&mut mesh, FLAT * diagonal),
        "triangle without area left out",
        "triangles without area left out",
    );
    notes.say(
        remove_repeats(&mut mesh),
        "repeated triangle left out",
        "repeated triangles left out",
    );
    if mesh.triangles.is_empty() {
        return Err(MendError::NoArea { triangles: triangles_read });
    }
    let (mut mesh, origin) = drop_unused(mesh);
    let unused = vertices_read - joined - mesh.points.len();
    notes.say(unused, "unused vertex left out", "unused vertices left out");

    let at = |[a, b]: [VertexId; 2], mesh: &Mesh| EdgePlace {
        ends: [origin[a], origin[b]],
        middle: nalgebra::center(&mesh.points[a], &mesh.points[b]),
    };
    let crowded = crowded_edges(&mesh);
    if !crowded.is_empty() {
        let first = crowded.iter().take(PLACES).map(|&e| at(e, &mesh)).collect();
        return Err(MendError::NonManifold { count: crowded.len(), first });
    }
    let turned =
        orient(&mut mesh).map_err(|Unorientable(e)| MendError::OneSided { at: at(e, &mesh) })?;
    notes.say(
        turned,
        "triangle turned round so that the surface faces one way, up or outward",
        "triangles turned round so that the surface faces one way, up or outward",
    );
    Ok(Mended { mesh, notes: notes.0 })
}

#[derive(Default)]
struct Notes(Vec<String>);

impl Notes {
    fn say(&mut self, count: usize, one: &str, many: &str) {
        if count > 0 {
            self.0.push(counted(count, one, many));
        }
    }
}

fn check(mesh: &Mesh) -> Result<(), MendError> {
    if mesh.triangles.is_empty() {
        return Err(MendError::Empty);
    }
    for (vertex, p) in mesh.points.enumerate() {
        let at = [p.x, p.y, p.z];
        if !at.iter().all(|c| c.is_finite()) {
            return Err(MendError::NotFinite { vertex, at });
        }
        if at.iter().any(|c| c.abs() > FARTHEST) {
            return Err(MendError::TooFar { vertex, at });
        }
    }
    let vertices = mesh.points.len();
    for (face, t) in mesh.triangles.enumerate() {
        if let Some(&vertex) = t.iter().find(|v| v.index() >= vertices) {
            return Err(MendError::VertexOutOfRange { face, vertex, vertices });
        }
    }
    Ok(())
}

/// Where a triangle without area lies: its longest side, if it has three corners.
enum Flat {
    /// Two corners are the same vertex.
    Folded,
    /// Side `k` is the longest, the corner across lies on it.
    Needle(usize),
}

fn flatness(mesh: &Mesh, face: FaceId, height: f64) -> Option<Flat> {
    let [a, b, c] = mesh.triangles[face];
    if a == b || b == c || c == a {
        return Some(Flat::Folded);
    }
    let corners = mesh.corners(face);
    let lengths = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).norm());
    let longest = (0..3).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
    let low = mesh.area_vector(face).norm() <= height * lengths[longest];
    low.then_some(Flat::Needle(longest))
}

/// Takes out triangles lower than `height`. Where a needle's longest side has a
/// neighbour, the neighbour is split at the needle's third corner. Counts those of the
/// file, not needles that come up on the way.
fn remove_needles(mesh: &mut Mesh, height: f64) -> usize {
    let mut found = 0;
    for round in 0.. {
        let flat: Vec<(FaceId, Flat)> =
            mesh.triangles.ids().filter_map(|f| Some((f, flatness(mesh, f, height)?))).collect();
        if flat.is_empty() {
            break;
        }
        if round == 0 {
            found = flat.len();
        }
        let sides = sorted_sides(&mesh.triangles);
        let mut gone = vec![false; mesh.triangles.len()];
        let mut added = Vec::new();
        for (face, kind) in flat {
            // Already split as the neighbour of another: its parts have their turn.
            if gone[face.index()] {
                continue;
            }
            if let Flat::Needle(side) = kind
                && round < NEEDLE_ROUNDS
                && let Some((other, parts)) = split_beside(mesh, &sides, face, side)
            {
                if gone[other.index()] {
                    continue; // to the next round
                }
                gone[other.index()] = true;
                added.extend(parts);
            }
            gone[face.index()] = true;
        }
        let kept = mesh.triangles.enumerate().filter(|(f, _)| !gone[f.index()]);
        mesh.triangles = kept.map(|(_, t)| *t).chain(added).collect();
    }
    found
}

/// The neighbour along a needle's longest side, and the two parts that it falls into
/// when cut at the needle's third corner. `None` on a border, at an edge of more than
/// two triangles, and beside the same triangle once more.
fn split_beside(
    mesh: &Mesh,
    sides: &[Side],
    needle: FaceId,
    longest: usize,
) -> Option<(FaceId, [[VertexId; 3]; 2])> {
    let t = mesh.triangles[needle];
    let (a, b, middle) = (t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]);
    let edge = [a.min(b), a.max(b)];
    let beside = &sides[sides.partition_point(|s| s.edge < edge)..];
    let count = beside.partition_point(|s| s.edge == edge);
    let [one, two] = beside[..count] else { return None };
    let h = if one.halfedge.face() == needle { two.halfedge } else { one.halfedge };
    let n = mesh.triangles[h.face()];
    let (from, to, tip) = (n[h.side()], n[(h.side() + 1) % 3], n[(h.side() + 2) % 3]);
    (tip != middle).then_some((h.face(), [[from, middle, tip], [middle, to, tip]]))
}

/// Takes out triangles on the same three vertices as an earlier one.
fn remove_repeats(mesh: &mut Mesh) -> usize {
    let mut seen = HashSet::with_capacity(mesh.triangles.len());
    let before = mesh.triangles.len();
    let first = |t: &&[VertexId; 3]| {
        let mut key = **t;
        key.sort_unstable();
        seen.insert(key)
    };
    mesh.triangles = mesh.triangles.iter().filter(first).copied().collect();
    before - mesh.triangles.len()
}

/// Takes out vertices without triangles; also gives the old number of each new vertex.
fn drop_unused(mesh: Mesh) -> (Mesh, IdVec<VertexId, VertexId>) {
    let mut used = vec![false; mesh.points.len()];
    for v in mesh.triangles.iter().flatten() {
        used[v.index()] = true;
    }
    let origin: IdVec<VertexId, VertexId> = mesh.points.ids().filter(|v| used[v.index()]).collect();
    let mut new: IdVec<VertexId, VertexId> = mesh.points.ids().collect();
    for (now, &old) in origin.enumerate() {
        new[old] = now;
    }
    let points = origin.iter().map(|&v| mesh.points[v]).collect();
    let triangles = mesh.triangles.iter().map(|t| t.map(|v| new[v])).collect();
    (Mesh { points, triangles }, origin)
}

fn crowded_edges(mesh: &Mesh) -> Vec<[VertexId; 2]> {
    let sides = sorted_sides(&mesh.triangles);
    let groups = sides.chunk_by(|a, b| a.edge == b.edge);
    groups.filter(|g| g.len() > 2).map(|g| g[0].edge).collect()
}

#[cfg(test)]
#[path = "mend_tests.rs"]
mod tests;
