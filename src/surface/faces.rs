//! What the menders of triangles and of polygons have in common.
//!
//! Faces are slices of vertices here, of three corners or of any number. The checks come
//! first; [`settle`] does what is left when all faces have area: it takes out unused
//! vertices, refuses crowded edges and turns faces the same way.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::mend::{EdgePlace, FaceKind, MendError};
use crate::surface::orient::{Unorientable, orient};
use crate::surface::shape::counted;
use crate::surface::topology::PLACES;
use crate::surface::weld::Weld;
use crate::surface::{Point3, Vector3};

/// The farthest coordinate taken, mm: a thousand kilometres. Products of four lengths
/// stay far from overflow.
const FARTHEST: f64 = 1e9;

/// Vertices nearer than this share of the bounding box's diagonal are one vertex. Files
/// with six digits differ by that much at seams; larger, and fine detail is lost.
pub(super) const WELD: f64 = 1e-6;

/// A face lower than this share of the bounding box's diagonal has no area: it is as
/// flat as the places of its corners are uncertain.
pub(super) const FLAT: f64 = WELD;

/// Rounds of handing on the corners of faces without area. Each round mends all that do
/// not lie side by side; rows of them are shorter than this.
pub(super) const NEEDLE_ROUNDS: usize = 32;

/// One sentence for each kind of mend.
#[derive(Default)]
pub(super) struct Notes(pub Vec<String>);

impl Notes {
    pub fn say(&mut self, count: usize, one: &str, many: &str) {
        if count > 0 {
            self.0.push(counted(count, one, many));
        }
    }

    pub fn say_welded(&mut self, weld: &Weld) {
        self.say(
            weld.joined - weld.near,
            "vertex at the place of another joined to it",
            "vertices at the place of another joined to it",
        );
        let (one, many) =
            ("vertex next to another joined to it", "vertices next to another joined to it");
        self.say(weld.near, one, many);
    }

    /// A number of faces and what was done with them.
    pub fn say_faces(&mut self, count: usize, kind: FaceKind, before: &str, after: &str) {
        if count > 0 {
            self.0.push(counted(
                count,
                &format!("{before}{} {after}", kind.one()),
                &format!("{before}{} {after}", kind.many()),
            ));
        }
    }
}

/// Lower and upper corner of the bounding box; `None` without points.
pub(super) fn bounds(points: &[Point3]) -> Option<[Point3; 2]> {
    let first = *points.first()?;
    Some(points.iter().fold([first, first], |[lo, hi], p| [lo.inf(p), hi.sup(p)]))
}

/// Twice the area of a face times its unit normal: the sum over a fan (Newell).
pub(super) fn area_vector(points: &IdVec<VertexId, Point3>, face: &[VertexId]) -> Vector3 {
    let Some(&first) = face.first() else { return Vector3::zeros() };
    let to = |v: VertexId| points[v] - points[first];
    face[1..].windows(2).map(|w| to(w[0]).cross(&to(w[1]))).sum()
}

/// Checks numbers and indices; gives the diagonal of the bounding box, mm.
pub(super) fn check<F: AsRef<[VertexId]>>(
    points: &IdVec<VertexId, Point3>,
    faces: &[F],
    kind: FaceKind,
) -> Result<f64, MendError> {
    if faces.is_empty() {
        return Err(MendError::Empty { kind });
    }
    for (vertex, p) in points.enumerate() {
        let at = [p.x, p.y, p.z];
        if !at.iter().all(|c| c.is_finite()) {
            return Err(MendError::NotFinite { vertex, at });
        }
        if at.iter().any(|c| c.abs() > FARTHEST) {
            return Err(MendError::TooFar { vertex, at });
        }
    }
    let vertices = points.len();
    for (i, corners) in faces.iter().enumerate() {
        if let Some(&vertex) = corners.as_ref().iter().find(|v| v.index() >= vertices) {
            let face = FaceId::new(i);
            return Err(MendError::VertexOutOfRange { kind, face, vertex, vertices });
        }
    }
    let [lo, hi] = bounds(points).ok_or(MendError::Empty { kind })?;
    Ok((hi - lo).norm())
}

/// One side of one face under its end vertices, the smaller first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FaceSide {
    /// End vertices, the smaller first: equal for all sides that share an edge.
    pub edge: [VertexId; 2],
    /// The face.
    pub face: FaceId,
    /// Which side of it: the corner where it starts.
    pub side: u32,
    /// Whether it runs from the smaller end to the larger.
    pub forward: bool,
}

/// All sides of all faces, sorted so that those on one edge stand together.
pub(super) fn sorted_sides<F: AsRef<[VertexId]>>(faces: &[F]) -> Vec<FaceSide> {
    let mut sides = Vec::new();
    for (i, corners) in faces.iter().enumerate() {
        let c = corners.as_ref();
        let side = |k: usize| {
            let (a, b) = (c[k], c[(k + 1) % c.len()]);
            let (edge, forward) = ([a.min(b), a.max(b)], a < b);
            FaceSide { edge, face: FaceId::new(i), side: k as u32, forward }
        };
        sides.extend((0..c.len()).map(side));
    }
    sides.sort_unstable();
    sides
}

/// Takes out unused vertices, refuses edges with more than two faces and turns faces so
/// that all face the same way. `joined` vertices were said already and are not counted
/// as unused.
pub(super) fn settle<F: AsRef<[VertexId]> + AsMut<[VertexId]>>(
    points: &mut IdVec<VertexId, Point3>,
    faces: &mut [F],
    kind: FaceKind,
    joined: usize,
    notes: &mut Notes,
) -> Result<(), MendError> {
    let read = points.len();
    let origin = drop_unused(points, faces);
    let unused = read - joined - points.len();
    notes.say(unused, "unused vertex left out", "unused vertices left out");

    let at = |[a, b]: [VertexId; 2]| EdgePlace {
        ends: [origin[a], origin[b]],
        middle: nalgebra::center(&points[a], &points[b]),
    };
    let sides = sorted_sides(faces);
    let crowded = sides.chunk_by(|a, b| a.edge == b.edge).filter(|g| g.len() > 2);
    let crowded: Vec<[VertexId; 2]> = crowded.map(|g| g[0].edge).collect();
    if !crowded.is_empty() {
        let first = crowded.iter().take(PLACES).map(|&e| at(e)).collect();
        return Err(MendError::NonManifold { kind, count: crowded.len(), first });
    }
    let turned = orient(points, faces, &sides)
        .map_err(|Unorientable(e)| MendError::OneSided { at: at(e) })?;
    notes.say_faces(
        turned,
        kind,
        "",
        "turned round so that the surface faces one way, up or outward",
    );
    Ok(())
}

/// The numbers that the vertices of some corners have, in their order, and from each of
/// them the new one, counted without the vertices between that are not used.
pub(super) fn renumbered<'a>(
    points: &IdVec<VertexId, Point3>,
    corners: impl Iterator<Item = &'a VertexId>,
) -> [IdVec<VertexId, VertexId>; 2] {
    let mut used = vec![false; points.len()];
    for v in corners {
        used[v.index()] = true;
    }
    let origin: IdVec<VertexId, VertexId> = points.ids().filter(|v| used[v.index()]).collect();
    let mut new: IdVec<VertexId, VertexId> = points.ids().collect();
    for (now, &old) in origin.enumerate() {
        new[old] = now;
    }
    [origin, new]
}

/// Takes out vertices without faces; gives the old number of each new vertex.
fn drop_unused<F: AsRef<[VertexId]> + AsMut<[VertexId]>>(
    points: &mut IdVec<VertexId, Point3>,
    faces: &mut [F],
) -> IdVec<VertexId, VertexId> {
    let [origin, new] = renumbered(points, faces.iter().flat_map(|f| f.as_ref()));
    *points = origin.iter().map(|&v| points[v]).collect();
    for v in faces.iter_mut().flat_map(|f| f.as_mut()) {
        *v = new[*v];
    }
    origin
}
