//! The guiding surface: a triangle mesh, how it is read, what shape it has, and
//! where points lie on it.

pub mod bow_ties;
pub mod bvh;
pub mod component;
pub mod cut;
mod faces;
pub mod hull;
pub mod locate;
pub mod mend;
mod orient;
pub mod polygons;
pub mod prepare;
pub mod read;
pub mod samples;
pub mod shape;
pub mod topology;
pub mod up;
mod weld;

use crate::ids::{FaceId, IdVec, VertexId};

/// A point in space, mm.
pub type Point3 = nalgebra::Point3<f64>;
/// A displacement or direction in space.
pub type Vector3 = nalgebra::Vector3<f64>;

/// A triangle mesh, mm, z up. Triangles run counter-clockwise seen from outside.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Mesh {
    /// Vertex positions, all finite.
    pub points: IdVec<VertexId, Point3>,
    /// The corners of each triangle.
    pub triangles: IdVec<FaceId, [VertexId; 3]>,
}

impl Mesh {
    /// The three corner positions of a triangle.
    pub fn corners(&self, face: FaceId) -> [Point3; 3] {
        self.triangles[face].map(|v| self.points[v])
    }

    /// Twice the area of a triangle times its outward unit normal.
    pub fn area_vector(&self, face: FaceId) -> Vector3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// Lower and upper corner of the bounding box; `None` for a mesh without points.
    pub fn bounds(&self) -> Option<[Point3; 2]> {
        faces::bounds(&self.points)
    }
}
