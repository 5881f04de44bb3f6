//! The chart of a disk: flattened by ABF++, scaled to the surface, and turned so
//! that the plane's x runs as nearly as possible along the model's x.

use super::{Chart, ChartError, SurfacePoint, flatten, layout};
use crate::ids::{Id, IdVec, VertexId};
use crate::surface::locate::PlanarLocator;
use crate::surface::topology::Topology;
use crate::surface::{Mesh, Point3, Vector3};
use nalgebra::{Point2, Rotation2, Vector2};

/// A disk-shaped mesh with its place in the plane.
#[derive(Clone, Debug)]
pub struct PlanarChart {
    mesh: Mesh,
    normals: IdVec<VertexId, Vector3>,
    flat: IdVec<VertexId, Point2<f64>>,
    locator: PlanarLocator,
    distortion: Distortion,
}

/// How much the plane differs from the surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Distortion {
    /// Mean difference of triangle angles, radians.
    pub mean_angle: f64,
    /// Largest difference of a triangle angle, radians.
    pub max_angle: f64,
    /// Least and greatest length on the surface of a unit length in the plane,
    /// over the triangles.
    pub scale: [f64; 2],
    /// Steps that the flattening took.
    pub steps: usize,
}

impl PlanarChart {
    /// Flattens a mesh of disk shape.
    ///
    /// # Errors
    /// [`ChartError`] when the angles do not settle or the result folds over.
    pub fn new(mesh: Mesh, topology: &Topology) -> Result<Self, ChartError> {
        let border: Vec<bool> = mesh.points.ids().map(|v| topology.is_border(v)).collect();
        let surface = corner_angles(&mesh);
        let flattening = flatten(&mesh.triangles, &surface, &border)?;
        let pins = far_pair(&mesh, &border);
        let distance = (mesh.points[pins[0]] - mesh.points[pins[1]]).norm();
        let flat: IdVec<VertexId, _> =
            layout(mesh.points.len(), &mesh.triangles, &flattening.angles, pins, distance)?.into();
        refuse_folds(&mesh, &flat)?;
        let flat = aligned(&mesh, flat);
        let distortion = measure(&mesh, &surface, &flat, flattening.steps);
        let normals = vertex_normals(&mesh);
        let locator = PlanarLocator::new(&flat, &mesh.triangles);
        Ok(Self { mesh, normals, flat, locator, distortion })
    }

    /// The surface that is mapped.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Where the vertices lie in the plane, mm.
    pub fn flat(&self) -> &[Point2<f64>] {
        &self.flat
    }

    /// How much the map distorts.
    pub fn distortion(&self) -> Distortion {
        self.distortion
    }
}

impl Chart for PlanarChart {
    fn bounds(&self) -> [Point2<f64>; 2] {
        let start = [Point2::origin(); 2];
        self.flat.iter().fold(start, |[lo, hi], p| [lo.inf(p), hi.sup(p)])
    }

    fn lift(&self, p: Point2<f64>) -> Option<SurfacePoint> {
        let at = self.locator.locate(p)?;
        let corners = self.mesh.triangles[at.face];
        let mut position = Vector3::zeros();
        let mut normal = Vector3::zeros();
        for (v, weight) in corners.into_iter().zip(at.barycentric) {
            position += self.mesh.points[v].coords * weight;
            normal += self.normals[v] * weight;
        }
        Some(SurfacePoint { position: position.into(), normal: normal.normalize() })
    }
}

/// The angle at each corner of each triangle, radians.
fn corner_angles(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.triangles
        .ids()
        .map(|f| {
            let p = mesh.corners(f);
            std::array::from_fn(|k| (p[(k + 1) % 3] - p[k]).angle(&(p[(k + 2) % 3] - p[k])))
        })
        .collect()
}

/// Two rim vertices far apart: the farthest from the first, and the farthest from that.
fn far_pair(mesh: &Mesh, border: &[bool]) -> [VertexId; 2] {
    let rim = || mesh.points.ids().filter(|v| border[v.index()]);
    let farthest = |from: VertexId| {
        let distance = |v: &VertexId| (mesh.points[*v] - mesh.points[from]).norm_squared();
        rim().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(from)
    };
    let first = farthest(rim().next().unwrap_or(VertexId::new(0)));
    [first, farthest(first)]
}

fn flat_area(mesh: &Mesh, flat: &IdVec<VertexId, Point2<f64>>, f: crate::ids::FaceId) -> f64 {
    let [a, b, c] = mesh.triangles[f].map(|v| flat[v]);
    (b - a).perp(&(c - a)) / 2.0
}

fn refuse_folds(mesh: &Mesh, flat: &IdVec<VertexId, Point2<f64>>) -> Result<(), ChartError> {
    let mut folded = mesh.triangles.ids().filter(|&f| {
        let area = flat_area(mesh, flat, f);
        area.is_nan() || area <= 0.0
    });
    match folded.next() {
        None => Ok(()),
        Some(first) => Err(ChartError::Folded {
            count: 1 + folded.count(),
            total: mesh.triangles.len(),
            first,
        }),
    }
}

/// Scales to the mean edge length of the surface, centres on the surface's area,
/// and turns the plane's axes to the model's x and y as well as they go.
fn aligned(mesh: &Mesh, flat: IdVec<VertexId, Point2<f64>>) -> IdVec<VertexId, Point2<f64>> {
    let (mut long, mut short) = (0.0, 0.0);
    let (mut area, mut middle, mut center) = (0.0, Vector2::zeros(), Vector3::zeros());
    for f in mesh.triangles.ids() {
        let space = mesh.corners(f);
        let plane = mesh.triangles[f].map(|v| flat[v]);
        for k in 0..3 {
            long += (space[(k + 1) % 3] - space[k]).norm();
            short += (plane[(k + 1) % 3] - plane[k]).norm();
        }
        let weight = mesh.area_vector(f).norm() / 6.0;
        area += 3.0 * weight;
        for k in 0..3 {
            middle += plane[k].coords * weight;
            center += space[k].coords * weight;
        }
    }
    let (middle, center) = (middle / area, Point3::from(center / area));
    let (mut dot, mut cross) = (0.0, 0.0);
    for v in mesh.points.ids() {
        let p = flat[v].coords - middle;
        let q = (mesh.points[v] - center).xy();
        dot += p.dot(&q);
        cross += p.perp(&q);
    }
    let turn = Rotation2::new(cross.atan2(dot));
    let scale = long / short;
    flat.iter().map(|p| (turn * (p.coords - middle) * scale).into()).collect()
}

fn measure(
    mesh: &Mesh,
    surface: &[[f64; 3]],
    flat: &IdVec<VertexId, Point2<f64>>,
    steps: usize,
) -> Distortion {
    let (mut sum, mut max_angle) = (0.0, 0.0f64);
    let mut scale = [f64::INFINITY, 0.0f64];
    for (f, angles) in mesh.triangles.ids().zip(surface) {
        let p = mesh.triangles[f].map(|v| flat[v]);
        for k in 0..3 {
            let planar = (p[(k + 1) % 3] - p[k]).angle(&(p[(k + 2) % 3] - p[k]));
            sum += (planar - angles[k]).abs();
            max_angle = max_angle.max((planar - angles[k]).abs());
        }
        let ratio = (mesh.area_vector(f).norm() / 2.0 / flat_area(mesh, flat, f)).sqrt();
        scale = [scale[0].min(ratio), scale[1].max(ratio)];
    }
    let mean_angle = sum / (3 * surface.len()) as f64;
    Distortion { mean_angle, max_angle, scale, steps }
}

/// Unit normals at the vertices, weighted by triangle area.
fn vertex_normals(mesh: &Mesh) -> IdVec<VertexId, Vector3> {
    let mut normals: IdVec<VertexId, Vector3> =
        mesh.points.iter().map(|_| Vector3::zeros()).collect();
    for f in mesh.triangles.ids() {
        let n = mesh.area_vector(f);
        for v in mesh.triangles[f] {
            normals[v] += n;
        }
    }
    normals.iter().map(|n| n.try_normalize(0.0).unwrap_or_else(Vector3::z)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::samples::sample;
    use crate::surface::topology::require_disk;

    fn chart(name: &str) -> PlanarChart {
        let mesh = sample(name).unwrap();
        let topology = require_disk(&mesh).unwrap();
        PlanarChart::new(mesh, &topology).unwrap()
    }

    #[test]
    fn a_flat_sheet_maps_to_itself() {
        let chart = chart("flat");
        let d = chart.distortion();
        assert!(d.max_angle < 1e-8 && (d.scale[1] - d.scale[0]).abs() < 1e-8, "{d:?}");
        let p = chart.lift(Point2::new(30.0, -70.0)).unwrap();
        assert!((p.position - Point3::new(30.0, -70.0, 0.0)).norm() < 1e-5, "{}", p.position);
        assert!((p.normal - Vector3::z()).norm() < 1e-12);
    }

    /// A cylinder is developable: its chart is its unrolled self, all lengths kept.
    #[test]
    fn a_vault_unrolls() {
        let d = chart("vault").distortion();
        assert!(d.scale[1] / d.scale[0] < 1.01, "{d:?}");
    }

    /// On a dome the map is conformal up to the size of the triangles, and no
    /// vertex leaves its place under plane and back.
    #[test]
    fn a_dome_keeps_its_angles() {
        let chart = chart("igloo");
        let d = chart.distortion();
        assert!(d.mean_angle < 0.01, "{d:?}");
        for v in chart.mesh().points.ids() {
            let back = chart.lift(chart.flat()[v.index()]).unwrap();
            assert!((back.position - chart.mesh().points[v]).norm() < 1e-6, "vertex {v}");
        }
    }
}
