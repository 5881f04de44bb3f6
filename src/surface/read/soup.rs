//! What every reader fills: points, and faces as the file has them.
//!
//! Only here are faces checked against the points, cut into triangles or handed on as
//! polygons. Faces lie in one flat list of corners, so that a file of small faces takes
//! little more memory here than on disk.

use super::polygon::{MOST_CORNERS, Uncut, tidy, triangulate};
use crate::ids::{Id, IdVec, VertexId};
use crate::surface::mend::{MendError, Mended, mend};
use crate::surface::polygons::{MendedPolygons, PolygonMesh, mend_polygons};
use crate::surface::shape::counted;
use crate::surface::{Mesh, Point3};
use std::fmt;

/// A face in a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaceName {
    /// The line that it starts on, counted from 1.
    Line(usize),
    /// Its number, counted from 1.
    Face(usize),
}

impl fmt::Display for FaceName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(n) => write!(f, "line {n}"),
            Self::Face(n) => write!(f, "face {n}"),
        }
    }
}

/// What is wrong with the faces of a file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum FaceError {
    /// A face names a vertex that the file does not have.
    #[error("{face}: the face uses vertex {vertex}, but the vertices {end}")]
    VertexOutOfRange {
        /// The face.
        face: FaceName,
        /// The vertex as written.
        vertex: String,
        /// Where the vertices end.
        end: LastVertex,
    },
    /// The outline of a polygon crosses itself.
    #[error("{face}: the outline of the face crosses itself")]
    Crossed {
        /// The face.
        face: FaceName,
    },
    /// The outline of a polygon passes through a vertex twice.
    #[error("{face}: the outline of the face passes vertex {vertex} twice")]
    MeetsItself {
        /// The face.
        face: FaceName,
        /// The vertex, counted from 1.
        vertex: VertexId,
    },
    /// A polygon of very many corners.
    #[error("{face}: the face has {corners} corners, more than {MOST_CORNERS}")]
    TooManyCorners {
        /// The face.
        face: FaceName,
        /// How many corners it has.
        corners: usize,
    },
    /// Vertices only.
    #[error("the file has {} but no faces", counted(*.vertices, "vertex", "vertices"))]
    NoFaces {
        /// How many vertices there are.
        vertices: usize,
    },
}

impl FaceError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::VertexOutOfRange { .. } => {
                "the file is damaged or cut short: export the surface again"
            }
            Self::Crossed { .. } | Self::MeetsItself { .. } | Self::TooManyCorners { .. } => {
                "export with faces cut into triangles"
            }
            Self::NoFaces { .. } => "export the surface as a mesh, with its faces",
        }
    }
}

/// Where the vertices of a file end, in the file's way of counting.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LastVertex {
    /// How many there are.
    pub vertices: usize,
    /// The number of the first.
    pub from: usize,
}

impl fmt::Display for LastVertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.vertices, self.from) {
            (0, _) => write!(f, "are missing"),
            (n, 1) => write!(f, "end at {n}"),
            (n, from) => write!(f, "run from {from} to {}", n - 1 + from),
        }
    }
}

/// Points and faces as a file has them.
#[derive(Default)]
pub(super) struct Soup {
    /// Positions, mm, z up.
    pub points: Vec<Point3>,
    /// The corners of all faces, one face after the other, counted from 0.
    corners: Vec<u32>,
    /// Where the corners of each face end.
    ends: Vec<usize>,
    /// The line of each face; empty for formats without lines.
    lines: Vec<usize>,
    /// The number of the first vertex in the file.
    pub count_from: usize,
}

impl Soup {
    /// Adds a face. All faces of a soup have lines, or none.
    pub fn push(&mut self, corners: impl IntoIterator<Item = u32>, line: Option<usize>) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len());
        self.lines.extend(line);
    }

    /// How many corners all faces have together.
    pub fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// How many faces there are.
    pub fn face_count(&self) -> usize {
        self.ends.len()
    }

    /// What a face is called in messages.
    pub fn name(&self, face: usize) -> FaceName {
        self.lines.get(face).map_or(FaceName::Face(face + 1), |&line| FaceName::Line(line))
    }

    fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.corners[start..end])
    }

    fn check_range(&self) -> Result<(), FaceError> {
        let vertices = self.points.len();
        for (i, face) in self.faces().enumerate() {
            if let Some(&corner) = face.iter().find(|&&c| c as usize >= vertices) {
                let vertex = (corner as usize + self.count_from).to_string();
                let end = LastVertex { vertices, from: self.count_from };
                return Err(FaceError::VertexOutOfRange { face: self.name(i), vertex, end });
            }
        }
        Ok(())
    }

    /// Cuts all faces into triangles and mends them.
    pub fn into_triangles(self, notes: &mut Vec<String>) -> Result<Mesh, super::Cause> {
        self.check_range()?;
        let mut triangles = IdVec::new();
        let (mut cut, mut short) = (0, 0);
        let mut corners: Vec<VertexId> = Vec::new();
        for (i, face) in self.faces().enumerate() {
            corners.clear();
            corners.extend(face.iter().map(|&c| VertexId::new(c as usize)));
            if let &[a, b, c] = &corners[..] {
                triangles.push([a, b, c]);
                continue;
            }
            tidy(&mut corners);
            if corners.len() < 3 {
                short += 1;
                continue;
            }
            let at: Vec<Point3> = corners.iter().map(|v| self.points[v.index()]).collect();
            let parts = triangulate(&at).map_err(|e| match e {
                Uncut::Crossed => FaceError::Crossed { face: self.name(i) },
                Uncut::TooMany => {
                    FaceError::TooManyCorners { face: self.name(i), corners: corners.len() }
                }
            })?;
            cut += usize::from(parts.len() > 1);
            for t in parts {
                triangles.push(t.map(|k| corners[k]));
            }
        }
        if triangles.is_empty() {
            return Err(FaceError::NoFaces { vertices: self.points.len() }.into());
        }
        if cut > 0 {
            let faces = counted(cut, "face", "faces");
            notes.push(format!("{faces} with more than three corners cut into triangles"));
        }
        note_short(short, notes);
        let Mended { mesh, notes: mends } = mend(Mesh { points: self.points.into(), triangles })?;
        notes.extend(mends);
        Ok(mesh)
    }

    /// Mends all faces as the polygons that they are.
    pub fn into_polygons(mut self, notes: &mut Vec<String>) -> Result<PolygonMesh, super::Cause> {
        self.check_range()?;
        let points: IdVec<VertexId, Point3> = std::mem::take(&mut self.points).into();
        let vertices = points.len();
        let (mut faces, mut numbers) = (Vec::new(), Vec::new());
        for (i, face) in self.faces().enumerate().filter(|(_, f)| f.len() > 2) {
            faces.push(face.iter().map(|&c| VertexId::new(c as usize)).collect());
            numbers.push(i);
        }
        if faces.is_empty() {
            return Err(FaceError::NoFaces { vertices }.into());
        }
        note_short(self.face_count() - faces.len(), notes);
        let name = |face: crate::ids::FaceId| self.name(numbers[face.index()]);
        let mended = mend_polygons(PolygonMesh { points, faces });
        let MendedPolygons { mesh, notes: mends } = mended.map_err(|e| match e {
            MendError::Crossed { face } => FaceError::Crossed { face: name(face) }.into(),
            MendError::MeetsItself { face, vertex } => {
                FaceError::MeetsItself { face: name(face), vertex }.into()
            }
            MendError::TooManyCorners { face, corners } => {
                FaceError::TooManyCorners { face: name(face), corners }.into()
            }
            other => super::Cause::Mesh(other),
        })?;
        notes.extend(mends);
        Ok(mesh)
    }
}

fn note_short(short: usize, notes: &mut Vec<String>) {
    if short > 0 {
        let faces = counted(short, "face", "faces");
        notes.push(format!("{faces} with fewer than three corners left out"));
    }
}
