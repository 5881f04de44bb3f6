//! The chart of a disk, with holes or without: flattened, scaled to the surface, and
//! turned so that the plane's x runs as nearly as possible along the model's x.

use super::distortion::measure;
use super::holes::Holes;
use super::rim::first_crossing;
use super::{Chart, ChartError, Conformal, Distortion, Method, Sheet, SurfacePoint, conformal};
use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::locate::{PlanarLocator, blend};
use crate::surface::topology::Topology;
use crate::surface::{Mesh, Point3, Vector3};
use nalgebra::{Point2, Rotation2, Vector2};

/// A mesh of one piece with its place in the plane.
#[derive(Clone, Debug)]
pub struct PlanarChart {
    mesh: Mesh,
    normals: IdVec<VertexId, Vector3>,
    flat: IdVec<VertexId, Point2<f64>>,
    locator: PlanarLocator,
    borders: Vec<Vec<VertexId>>,
    holes: Holes,
    distortion: Distortion,
}

impl PlanarChart {
    /// Flattens a mesh of one piece without handles. All borders but the longest are
    /// holes: they are filled while the mesh is flattened, and stay out of the chart.
    ///
    /// # Errors
    /// [`ChartError`] when the angles do not settle or the result folds over.
    pub fn new(mesh: Mesh, topology: &Topology, method: Method) -> Result<Self, ChartError> {
        let sheet = Sheet::new(&mesh, topology);
        let Conformal { flat, method, fallback, steps } = conformal(&mesh, &sheet, method)?;
        let flat = aligned(&mesh, &flat);
        let holes = Holes::new(&flat, &sheet.triangles[sheet.real..]);
        // Corners that fill a hole are of no more use.
        let flat: IdVec<VertexId, _> = flat[..mesh.points.len()].to_vec().into();
        if let Some(edge) = first_crossing(topology, &flat) {
            return Err(ChartError::Overlaps {
                at: mesh.points[topology.from(edge)].coords.into(),
            });
        }
        let angles = &sheet.angles[..sheet.real];
        let distortion =
            Distortion { method, fallback, steps, ..measure(&mesh, topology, angles, &flat) };
        let normals = vertex_normals(&mesh);
        let locator = PlanarLocator::new(&flat, &mesh.triangles);
        let borders = topology.border_loops();
        Ok(Self { mesh, normals, flat, locator, borders, holes, distortion })
    }

    /// The surface that is mapped.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Where the vertices lie in the plane, mm.
    pub fn flat(&self) -> &[Point2<f64>] {
        &self.flat
    }

    /// The border lines in the plane, mm, each closed: the outer one and those of holes.
    pub fn outline(&self) -> Vec<Vec<Point2<f64>>> {
        let place = |border: &Vec<VertexId>| border.iter().map(|&v| self.flat[v]).collect();
        self.borders.iter().map(place).collect()
    }

    /// The point of the plane in the chart that is nearest to a finite one, mm.
    pub fn inside(&self, p: Point2<f64>) -> Point2<f64> {
        // There is no mesh without triangles.
        self.locator.closest(p).map_or(p, |at| self.plane_point(at.face, at.barycentric))
    }

    /// The point of the plane that belongs to a place of the surface, mm.
    pub fn plane_point(&self, face: FaceId, barycentric: [f64; 3]) -> Point2<f64> {
        blend(&self.mesh.triangles[face].map(|v| self.flat[v]), barycentric)
    }

    /// How much the map distorts.
    pub fn distortion(&self) -> &Distortion {
        &self.distortion
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

    fn crosses_hole(&self, a: Point2<f64>, b: Point2<f64>, half_width: f64) -> bool {
        self.holes.meet(a, b, half_width)
    }
}

/// Scales to the mean edge length of the surface, centres on the surface's area,
/// and turns the plane's axes to the model's x and y as well as they go.
fn aligned(mesh: &Mesh, flat: &[Point2<f64>]) -> Vec<Point2<f64>> {
    let (mut long, mut short) = (0.0, 0.0);
    let (mut area, mut middle, mut center) = (0.0, Vector2::zeros(), Vector3::zeros());
    for f in mesh.triangles.ids() {
        let space = mesh.corners(f);
        let plane = mesh.triangles[f].map(|v| flat[v.index()]);
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
    // The integrals of p·q and p×q over the surface: of two linear functions f and g over a
    // triangle of area A it is A/12 (Σ fᵢgᵢ + Σ fᵢ Σ gᵢ).
    let (mut dot, mut cross) = (0.0, 0.0);
    for f in mesh.triangles.ids() {
        let weight = mesh.area_vector(f).norm();
        let p = mesh.triangles[f].map(|v| flat[v.index()].coords - middle);
        let q = mesh.corners(f).map(|c| (c - center).xy());
        for (p, q) in p.into_iter().zip(q).chain([(p.iter().sum(), q.iter().sum())]) {
            dot += weight * p.dot(&q);
            cross += weight * p.perp(&q);
        }
    }
    let turn = Rotation2::new(cross.atan2(dot));
    let scale = long / short;
    flat.iter().map(|p| (turn * (p.coords - middle) * scale).into()).collect()
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
        PlanarChart::new(mesh, &topology, Method::Abf).unwrap()
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
        let chart = chart("vault");
        let d = chart.distortion();
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
            let flat = chart.flat()[v.index()];
            let back = chart.lift(flat).unwrap();
            assert!((back.position - chart.mesh().points[v]).norm() < 1e-6, "vertex {v}");
            assert!((chart.inside(flat) - flat).norm() < 1e-9);
            // From beyond the rim the way goes back to it.
            let beyond = chart.inside(flat * 100.0);
            assert!((beyond - flat * 100.0).norm() <= 99.0 * flat.coords.norm() + 1e-9);
            assert!(chart.lift(beyond).is_some());
        }
    }
}
