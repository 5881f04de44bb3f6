//! The guiding surface: what a frame is to follow.

use crate::chart::Distortion;
use crate::surface::locate::Locator;
use crate::surface::polygons::PolygonMesh;
use crate::surface::topology::Topology;
use crate::surface::{Mesh, Point3};

/// A guiding surface, mm, z up.
#[derive(Clone, Debug)]
pub enum Guide {
    /// A mesh with a chart.
    Chart {
        /// The mesh.
        mesh: Mesh,
        /// How much its chart distorts.
        distortion: Distortion,
    },
    /// A mesh of polygons.
    Mesh(PolygonMesh),
    /// A sphere about the origin.
    Sphere {
        /// Faces of its polyhedron.
        faces: usize,
        /// Its radius.
        radius: f64,
        /// Height of the plane on which it stands.
        low: f64,
    },
}

impl Guide {
    /// Lower and upper corner of its bounding box.
    pub fn bounds(&self) -> Option<[Point3; 2]> {
        match self {
            Self::Chart { mesh, .. } => mesh.bounds(),
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Sphere { radius: r, low, .. } => {
                Some([Point3::new(-r, -r, *low), Point3::new(*r, *r, *r)])
            }
        }
    }

    /// Its lowest height.
    pub fn low(&self) -> f64 {
        self.bounds().map_or(0.0, |[lo, _]| lo.z)
    }

    /// Its border lines, closed; none where its triangles do not hang together, and none
    /// of a sphere.
    pub fn rims(&self) -> Vec<Vec<Point3>> {
        let rims = |mesh: &Mesh| {
            let loops = Topology::new(mesh).map(|t| t.border_loops()).unwrap_or_default();
            loops.iter().map(|rim| rim.iter().map(|&v| mesh.points[v]).collect()).collect()
        };
        match self {
            Self::Chart { mesh, .. } => rims(mesh),
            Self::Mesh(mesh) => rims(&mesh.triangles()),
            Self::Sphere { .. } => Vec::new(),
        }
    }

    /// How far each of many points lies from it.
    pub fn distances(&self, points: &[Point3]) -> Vec<f64> {
        let nearest = |mesh: &Mesh| {
            let locator = Locator::new(mesh);
            points.iter().map(|&p| locator.closest(p).distance).collect()
        };
        match self {
            Self::Chart { mesh, .. } => nearest(mesh),
            Self::Mesh(mesh) => nearest(&mesh.triangles()),
            Self::Sphere { radius, .. } => {
                points.iter().map(|p| (p.coords.norm() - radius).abs()).collect()
            }
        }
    }
}
