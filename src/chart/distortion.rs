//! How much the plane differs from the surface. Triangles that fill holes do not count.

use super::Method;
use crate::ids::{FaceId, IdVec, VertexId};
use crate::surface::topology::{HalfedgeId, Topology};
use crate::surface::{Mesh, Point3, Vector3};
use nalgebra::Point2;
use std::fmt;

/// How much a map distorts, and how it was made.
#[derive(Clone, PartialEq, Debug)]
pub struct Distortion {
    /// What made the map.
    pub method: Method,
    /// Why it was made by another method than asked for: a sentence.
    pub fallback: Option<String>,
    /// Steps that ABF++ took; 0 for LSCM.
    pub steps: usize,
    /// Mean difference of a triangle angle, radians.
    pub mean_angle: f64,
    /// Largest difference of a triangle angle, radians.
    pub max_angle: f64,
    /// Least and greatest length on the surface of a unit length in the plane, over
    /// the triangles.
    pub scale: [f64; 2],
    /// The same length at a twentieth of the surface's area from either end.
    pub scale_most: [f64; 2],
    /// Where on the surface the lengths are beyond those two.
    pub scale_places: [Point3; 2],
}

/// Units of very different size.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Uneven {
    /// How many times larger the large ones are.
    pub ratio: f64,
    /// Where on the surface units are small, mm.
    pub small: Point3,
    /// Where they are large, mm.
    pub large: Point3,
}

/// Part of the area left aside at either end, so that a few triangles do not tell.
const TAIL: f64 = 0.05;

/// Ratio of lengths from which units count as uneven: a stick that suits one end of
/// this range is hopeless at the other, since the rise grows with the square.
const UNEVEN: f64 = 3.0;

impl Distortion {
    /// Whether and where units would come out of very different size.
    pub fn uneven(&self) -> Option<Uneven> {
        let ratio = self.scale_most[1] / self.scale_most[0];
        let [small, large] = self.scale_places;
        (ratio > UNEVEN).then_some(Uneven { ratio, small, large })
    }
}

impl fmt::Display for Uneven {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [small, large] =
            [self.small, self.large].map(|p| format!("({:.0}, {:.0}, {:.0})", p.x, p.y, p.z));
        write!(
            f,
            "units near {large} would be {:.1} times larger than those near {small}",
            self.ratio
        )
    }
}

/// Compares a surface, given with the angles of its triangles, with its map; says
/// nothing yet of how the map was made.
pub(super) fn measure(
    mesh: &Mesh,
    topology: &Topology,
    angles: &[[f64; 3]],
    flat: &IdVec<VertexId, Point2<f64>>,
) -> Distortion {
    let (mut sum, mut max_angle) = (0.0, 0.0_f64);
    let mut scales: IdVec<FaceId, f64> = IdVec::new();
    for (f, angles) in mesh.triangles.ids().zip(angles) {
        let p = mesh.triangles[f].map(|v| flat[v]);
        for k in 0..3 {
            let planar = (p[(k + 1) % 3] - p[k]).angle(&(p[(k + 2) % 3] - p[k]));
            sum += (planar - angles[k]).abs();
            max_angle = max_angle.max((planar - angles[k]).abs());
        }
        let area = (p[1] - p[0]).perp(&(p[2] - p[0]));
        scales.push((mesh.area_vector(f).norm() / area).sqrt());
    }
    let mut order: Vec<FaceId> = mesh.triangles.ids().collect();
    order.sort_by(|&a, &b| scales[a].total_cmp(&scales[b]));
    let small = tail(mesh, order.iter().copied());
    let large = tail(mesh, order.iter().rev().copied());
    let end = |of: &[FaceId]| of.last().map_or(1.0, |&f| scales[f]);
    Distortion {
        method: Method::default(),
        fallback: None,
        steps: 0,
        mean_angle: sum / (3 * angles.len()) as f64,
        max_angle,
        scale: [end(&order[..order.len().min(1)]), end(&order)],
        scale_most: [end(&small), end(&large)],
        scale_places: [middle(mesh, topology, &small), middle(mesh, topology, &large)],
    }
}

fn area(mesh: &Mesh, f: FaceId) -> f64 {
    mesh.area_vector(f).norm() / 2.0
}

/// The first triangles of an order, up to [`TAIL`] of the area.
fn tail(mesh: &Mesh, order: impl Iterator<Item = FaceId>) -> Vec<FaceId> {
    let total: f64 = mesh.triangles.ids().map(|f| area(mesh, f)).sum();
    let mut so_far = 0.0;
    let mut taken = Vec::new();
    for f in order {
        taken.push(f);
        so_far += area(mesh, f);
        if so_far >= TAIL * total {
            break;
        }
    }
    taken
}

/// A place in the largest connected part of some triangles: the centre of the one
/// nearest to that part's mean, so that it lies on the surface also where the part
/// runs round a ring.
fn middle(mesh: &Mesh, topology: &Topology, some: &[FaceId]) -> Point3 {
    let mut open: IdVec<FaceId, bool> = vec![false; mesh.triangles.len()].into();
    some.iter().for_each(|&f| open[f] = true);
    let mut best: (f64, Vec<FaceId>) = (f64::NEG_INFINITY, Vec::new());
    for &seed in some {
        if !std::mem::replace(&mut open[seed], false) {
            continue;
        }
        let mut part = vec![seed];
        let mut next = 0;
        while next < part.len() {
            let f = part[next];
            next += 1;
            let twins = (0..3).filter_map(|k| topology.twin(HalfedgeId::of(f, k)));
            for other in twins.map(HalfedgeId::face) {
                if std::mem::replace(&mut open[other], false) {
                    part.push(other);
                }
            }
        }
        let size = part.iter().map(|&f| area(mesh, f)).sum();
        if size > best.0 {
            best = (size, part);
        }
    }
    let (size, part) = best;
    let centre =
        |f: FaceId| -> Vector3 { mesh.corners(f).iter().map(|p| p.coords).sum::<Vector3>() / 3.0 };
    let mean = part.iter().map(|&f| centre(f) * area(mesh, f)).sum::<Vector3>() / size;
    let away = |f: &&FaceId| (centre(**f) - mean).norm_squared();
    let nearest = part.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    nearest.map_or_else(Point3::origin, |&f| centre(f).into())
}
