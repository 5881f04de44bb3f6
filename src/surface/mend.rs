//! Makes a sound mesh of what a file holds, where the mend is certain, and says what
//! it did; refuses the rest with the places.
//!
//! In order: check numbers and indices; join vertices at one place; take out triangles
//! without area (a needle hands its middle vertex to the neighbour along its longest
//! side, so that no slit stays open), repeated triangles and unused vertices; refuse
//! edges with three triangles; turn triangles so that all face the same way (see
//! `orient`). Numbers in messages are those of the mesh as it came in, counted from 1.
//! Polygons have a mender of their own, in [`polygons`](crate::surface::polygons).

use crate::ids::{FaceId, Id, VertexId};
use crate::surface::faces::{FLAT, NEEDLE_ROUNDS, Notes, WELD, check, settle};
use crate::surface::read::polygon::MOST_CORNERS;
use crate::surface::shape::{counted, place};
use crate::surface::topology::{Side, sorted_sides};
use crate::surface::weld::weld;
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

/// What the faces of a mesh are called in messages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaceKind {
    /// Of a triangle mesh.
    Triangle,
    /// Of a polygon mesh.
    Polygon,
}

impl FaceKind {
    /// The word for one.
    pub(super) fn one(self) -> &'static str {
        match self {
            Self::Triangle => "triangle",
            Self::Polygon => "face",
        }
    }

    /// The word for several.
    pub(super) fn many(self) -> &'static str {
        match self {
            Self::Triangle => "triangles",
            Self::Polygon => "faces",
        }
    }
}

/// What cannot be mended.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum MendError {
    /// No faces at all.
    #[error("the surface has no {}", .kind.many())]
    Empty {
        /// What its faces are called.
        kind: FaceKind,
    },
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
    /// A face names a vertex that does not exist.
    #[error("{} {face} uses vertex {vertex}, but the vertices end at {vertices}", .kind.one())]
    VertexOutOfRange {
        /// What the face is called.
        kind: FaceKind,
        /// The face.
        face: FaceId,
        /// The vertex that it names.
        vertex: VertexId,
        /// How many vertices there are.
        vertices: usize,
    },
    /// The outline of a polygon crosses itself.
    #[error("the outline of face {face} crosses itself")]
    Crossed {
        /// The face.
        face: FaceId,
    },
    /// A polygon passes through a vertex twice.
    #[error("face {face} passes vertex {vertex} twice")]
    MeetsItself {
        /// The face.
        face: FaceId,
        /// The vertex, numbered as in the file.
        vertex: VertexId,
    },
    /// A polygon of very many corners.
    #[error("face {face} has {corners} corners, more than {MOST_CORNERS}")]
    TooManyCorners {
        /// The face.
        face: FaceId,
        /// How many corners it has.
        corners: usize,
    },
    /// All faces are points or lines.
    #[error("the surface has no area: all {faces} {} are points or lines", .kind.many())]
    NoArea {
        /// What the faces are called.
        kind: FaceKind,
        /// How many there are.
        faces: usize,
    },
    /// Edges with three faces or more.
    #[error(
        "{} more than two {}, first {}",
        counted(*.count, "edge carries", "edges carry"), .kind.many(), edges(.first)
    )]
    NonManifold {
        /// What the faces are called.
        kind: FaceKind,
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
            Self::Empty { .. } => "export the surface as a mesh, with its faces",
            Self::NotFinite { .. } | Self::VertexOutOfRange { .. } => {
                "the file is damaged or was written wrongly: export it again"
            }
            Self::TooFar { .. } => "move the surface to the origin and check its units",
            Self::Crossed { .. } | Self::MeetsItself { .. } | Self::TooManyCorners { .. } => {
                "cut the face into simple ones, or export with faces cut into triangles"
            }
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

/// Mends a mesh as read from a file.
///
/// # Errors
/// What no mend is certain for; see [`MendError::hint`].
pub fn mend(mut mesh: Mesh) -> Result<Mended, MendError> {
    let kind = FaceKind::Triangle;
    let diagonal = check(&mesh.points, &mesh.triangles, kind)?;
    let triangles_read = mesh.triangles.len();
    let mut notes = Notes::default();

    let weld = weld(&mesh.points, WELD * diagonal);
    weld.apply(&mut mesh.triangles);
    notes.say_welded(&weld);
    let flat = remove_needles(&mut mesh, FLAT * diagonal);
    notes.say_faces(flat, kind, "", "without area left out");
    notes.say_faces(remove_repeats(&mut mesh), kind, "repeated ", "left out");
    if mesh.triangles.is_empty() {
        return Err(MendError::NoArea { kind, faces: triangles_read });
    }
    settle(&mut mesh.points, &mut mesh.triangles, kind, weld.joined, &mut notes)?;
    Ok(Mended { mesh, notes: notes.0 })
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

#[cfg(test)]
#[path = "mend_tests.rs"]
mod tests;
