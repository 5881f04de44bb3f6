//! A mesh of polygons, and how it is made sound.
//!
//! Mended in the order of [`mend`](crate::surface::mend), on faces of any number of
//! corners: vertices at one place are joined; corners that repeat and spikes go out of
//! each face; faces without area go (one that fills the gap between two faces hands its
//! inner corners to the neighbour along its longest side, so that no slit stays open);
//! then repeated faces and unused vertices; then all are turned the same way. A face
//! must have a simple outline: it may be bent a little and need not be convex, but a
//! slit to a hole inside it is refused, because then it is no ring of corners.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::faces::{
    FLAT, FaceSide, NEEDLE_ROUNDS, Notes, WELD, area_vector, bounds, check, settle, sorted_sides,
};
use crate::surface::mend::{FaceKind, MendError};
use crate::surface::read::polygon::{MOST_CORNERS, Uncut, tidy, triangulate};
use crate::surface::weld::weld;
use crate::surface::{Mesh, Point3};
use std::collections::HashSet;

/// A mesh of polygons, mm, z up. Faces run counter-clockwise seen from outside, have at
/// least three corners, and no corner twice.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PolygonMesh {
    /// Vertex positions, all finite.
    pub points: IdVec<VertexId, Point3>,
    /// The corners of each face.
    pub faces: Vec<Vec<VertexId>>,
}

impl PolygonMesh {
    /// Lower and upper corner of the bounding box, mm; `None` for a mesh without points.
    pub fn bounds(&self) -> Option<[Point3; 2]> {
        bounds(&self.points)
    }

    /// The faces cut into triangles, on the same vertices. A face that crosses itself,
    /// which no mended mesh has, is cut as a fan.
    pub fn triangles(&self) -> Mesh {
        let mut triangles = IdVec::new();
        for face in &self.faces {
            let corners: Vec<Point3> = face.iter().map(|&v| self.points[v]).collect();
            let fan = || (2..face.len()).map(|k| [0, k - 1, k]).collect();
            for t in triangulate(&corners).unwrap_or_else(|_| fan()) {
                triangles.push(t.map(|k| face[k]));
            }
        }
        Mesh { points: self.points.clone(), triangles }
    }
}

/// A polygon mesh that can be worked with, and what was done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct MendedPolygons {
    /// The sound mesh.
    pub mesh: PolygonMesh,
    /// One sentence for each kind of mend.
    pub notes: Vec<String>,
}

/// Mends a polygon mesh as read from a file.
///
/// # Errors
/// What no mend is certain for; see [`MendError::hint`].
pub fn mend_polygons(mesh: PolygonMesh) -> Result<MendedPolygons, MendError> {
    let kind = FaceKind::Polygon;
    let PolygonMesh { mut points, mut faces } = mesh;
    let diagonal = check(&points, &faces, kind)?;
    let faces_read = faces.len();
    let mut notes = Notes::default();

    let weld = weld(&points, WELD * diagonal);
    weld.apply(&mut faces);
    notes.say_welded(&weld);
    let mut sound = Faces { points: &points, numbers: (0..faces_read).collect(), faces };
    for (number, corners) in sound.faces.iter_mut().enumerate() {
        tidy(corners);
        if corners.len() > MOST_CORNERS {
            let (face, corners) = (FaceId::new(number), corners.len());
            return Err(MendError::TooManyCorners { face, corners });
        }
    }
    let flat = sound.remove_flat(FLAT * diagonal);
    notes.say_faces(flat, kind, "", "without area left out");
    notes.say_faces(sound.remove_repeats(), kind, "repeated ", "left out");
    if sound.faces.is_empty() {
        return Err(MendError::NoArea { kind, faces: faces_read });
    }
    sound.check_outlines()?;
    let mut faces = sound.faces;
    settle(&mut points, &mut faces, kind, weld.joined, &mut notes)?;
    Ok(MendedPolygons { mesh: PolygonMesh { points, faces }, notes: notes.0 })
}

/// The faces that are left, and what their numbers were.
struct Faces<'a> {
    points: &'a IdVec<VertexId, Point3>,
    faces: Vec<Vec<VertexId>>,
    numbers: Vec<usize>,
}

impl Faces<'_> {
    /// Takes out faces lower than `height`; counts those of the file, not those that
    /// come up on the way.
    fn remove_flat(&mut self, height: f64) -> usize {
        let mut found = 0;
        for round in 0.. {
            let flat: Vec<usize> =
                (0..self.faces.len()).filter(|&f| self.is_flat(f, height)).collect();
            if flat.is_empty() {
                break;
            }
            if round == 0 {
                found = flat.len();
            }
            let sides = sorted_sides(&self.faces);
            let mut gone = vec![false; self.faces.len()];
            for face in flat {
                if round < NEEDLE_ROUNDS
                    && let Some(gap) = self.gap(&sides, face)
                {
                    if gone[gap.neighbour] || !self.faces[gap.neighbour].has_side(gap.from, gap.to)
                    {
                        continue; // to the next round
                    }
                    self.faces[gap.neighbour].insert_after(gap.from, &gap.between);
                }
                gone[face] = true;
            }
            self.keep(|f| !gone[f]);
        }
        found
    }

    fn keep(&mut self, stays: impl Fn(usize) -> bool) {
        let pick = |i: &usize| stays(*i);
        let kept: Vec<usize> = (0..self.faces.len()).filter(pick).collect();
        self.numbers = kept.iter().map(|&i| self.numbers[i]).collect();
        self.faces = kept.iter().map(|&i| std::mem::take(&mut self.faces[i])).collect();
    }

    /// Whether a face is a point, a line, or lower than `height`. Parts that cancel out,
    /// as in a figure of eight, do not make a face flat.
    fn is_flat(&self, face: usize, height: f64) -> bool {
        let corners = &self.faces[face];
        if corners.len() < 3 {
            return true;
        }
        let at: Vec<Point3> = corners.iter().map(|&v| self.points[v]).collect();
        let Some([lo, hi]) = bounds(&at) else { return true };
        // For a triangle the longest side serves as its length, as in the other mender.
        let side = |k: usize| (at[(k + 1) % at.len()] - at[k]).norm();
        let length = match at.len() {
            3 => (0..3).map(side).fold(0.0, f64::max),
            _ => (hi - lo).norm(),
        };
        let low = |area: f64| area <= height * length;
        let part = |k: usize| (at[k] - at[0]).cross(&(at[k + 1] - at[0])).norm();
        low(area_vector(self.points, corners).norm()) && (1..at.len() - 1).all(|k| low(part(k)))
    }

    /// The gap that a flat face fills: its longest side, if all its other corners lie
    /// along it in order, and the neighbour there. `None` on a border, at an edge of
    /// more than two faces, and beside a face that has one of the corners.
    fn gap(&self, sides: &[FaceSide], face: usize) -> Option<Gap> {
        let c = &self.faces[face];
        let n = c.len();
        let along = |k: usize| self.points[c[(k + 1) % n]] - self.points[c[k % n]];
        let lengths: Vec<f64> = (0..n).map(|k| along(k).norm_squared()).collect();
        let k = (0..n).reduce(|best, k| if lengths[k] > lengths[best] { k } else { best })?;
        let (a, b) = (c[k], c[(k + 1) % n]);
        // On from b and back to a; from a to b they are met the other way round.
        let between: Vec<VertexId> = (2..n).map(|i| c[(k + i) % n]).collect();
        let back = |i: usize| along(k + i).dot(&along(k)) < 0.0;
        if between.is_empty() || !(1..n).all(back) {
            return None;
        }
        let edge = [a.min(b), a.max(b)];
        let beside = &sides[sides.partition_point(|s| s.edge < edge)..];
        let count = beside.partition_point(|s| s.edge == edge);
        let [one, two] = beside[..count] else { return None };
        let other = if one.face.index() == face { two } else { one };
        let neighbour = other.face.index();
        let known: HashSet<VertexId> = self.faces[neighbour].iter().copied().collect();
        let full = known.len() + between.len() > MOST_CORNERS;
        if full || neighbour == face || between.iter().any(|v| known.contains(v)) {
            return None;
        }
        let runs_as_this = other.forward == (a < b);
        Some(if runs_as_this {
            Gap { neighbour, from: a, to: b, between: between.into_iter().rev().collect() }
        } else {
            Gap { neighbour, from: b, to: a, between }
        })
    }

    /// Takes out faces with the same ring of corners as an earlier one, either way round.
    fn remove_repeats(&mut self) -> usize {
        let mut seen = HashSet::with_capacity(self.faces.len());
        let first: Vec<bool> = self.faces.iter().map(|f| seen.insert(ring(f))).collect();
        self.keep(|f| first[f]);
        first.iter().filter(|first| !**first).count()
    }

    /// Refuses faces whose outline is not simple. Skew ones are looked at both ways round, as
    /// they may be turned: on the brink of crossing, rounding decides.
    fn check_outlines(&self) -> Result<(), MendError> {
        for (corners, &number) in self.faces.iter().zip(&self.numbers) {
            let face = FaceId::new(number);
            let mut sorted = corners.clone();
            sorted.sort_unstable();
            if let Some(twice) = sorted.windows(2).find(|w| w[0] == w[1]) {
                return Err(MendError::MeetsItself { face, vertex: twice[0] });
            }
            let mut at: Vec<Point3> = corners.iter().map(|&v| self.points[v]).collect();
            for _ in 0..2 {
                triangulate(&at).map_err(|e| match e {
                    Uncut::Crossed => MendError::Crossed { face },
                    Uncut::TooMany => MendError::TooManyCorners { face, corners: corners.len() },
                })?;
                at[1..].reverse();
            }
        }
        Ok(())
    }
}

/// Corners to go between two others in a neighbour.
struct Gap {
    neighbour: usize,
    from: VertexId,
    to: VertexId,
    between: Vec<VertexId>,
}

trait Ring {
    fn has_side(&self, from: VertexId, to: VertexId) -> bool;
    fn insert_after(&mut self, from: VertexId, more: &[VertexId]);
}

impl Ring for Vec<VertexId> {
    fn has_side(&self, from: VertexId, to: VertexId) -> bool {
        (0..self.len()).any(|k| self[k] == from && self[(k + 1) % self.len()] == to)
    }

    fn insert_after(&mut self, from: VertexId, more: &[VertexId]) {
        if let Some(k) = self.iter().position(|&v| v == from) {
            self.splice(k + 1..k + 1, more.iter().copied());
        }
    }
}

/// The corners from the smallest one on, towards its smaller neighbour: the same for
/// all ways to write one ring.
fn ring(face: &[VertexId]) -> Vec<VertexId> {
    let n = face.len();
    let start = (0..n).min_by_key(|&k| face[k]).unwrap_or_default();
    let on: Vec<VertexId> = (0..n).map(|i| face[(start + i) % n]).collect();
    let back: Vec<VertexId> = (0..n).map(|i| face[(start + n - i) % n]).collect();
    on.min(back)
}

#[cfg(test)]
#[path = "polygons_tests.rs"]
mod tests;
