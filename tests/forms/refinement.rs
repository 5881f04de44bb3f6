//! Where flattening is exact, finer triangles on the same surface change nothing.

use super::case::Case;
use super::motion::apart;
use rodwright::frame::close::Way;
use rodwright::ids::{Id, IdVec, VertexId};
use rodwright::surface::{Mesh, Point3};
use std::collections::BTreeMap;

/// How far ends of the same rod may lie apart, in diameters.
const SAME: f64 = 1e-6;

/// Every triangle split in four, in its plane.
fn split(mesh: &Mesh) -> Mesh {
    let mut points: IdVec<VertexId, Point3> = mesh.points.iter().copied().collect();
    let mut middles: BTreeMap<[VertexId; 2], VertexId> = BTreeMap::new();
    let mut triangles = IdVec::new();
    for &[a, b, c] in mesh.triangles.iter() {
        let [p, q, r] = [[a, b], [b, c], [c, a]].map(|[s, t]| {
            *middles.entry([s.min(t), s.max(t)]).or_insert_with(|| {
                let middle = nalgebra::center(&points[s], &points[t]);
                points.push(middle)
            })
        });
        for corners in [[a, p, r], [p, b, q], [r, q, c], [p, q, r]] {
            triangles.push(corners);
        }
    }
    Mesh { points, triangles }
}

/// An arc of flat strips, drawn along x: it unrolls without error.
fn strips() -> Mesh {
    const STRIPS: usize = 24;
    const ROWS: usize = 30;
    let (half, radius, step) = (1.2, 200.0, 20.0);
    let mut mesh = Mesh::default();
    let at = |row: usize, strip: usize| VertexId::new(row * (STRIPS + 1) + strip);
    for row in 0..=ROWS {
        for strip in 0..=STRIPS {
            let x = step * (row as f64 - ROWS as f64 / 2.0);
            let (sin, cos) = (half * (2.0 * strip as f64 / STRIPS as f64 - 1.0)).sin_cos();
            mesh.points.push(Point3::new(x, radius * sin, radius * cos));
        }
    }
    for row in 0..ROWS {
        for strip in 0..STRIPS {
            let [a, b] = [at(row, strip), at(row + 1, strip)];
            let [c, d] = [at(row + 1, strip + 1), at(row, strip + 1)];
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}

/// The frame on a mesh and on the same one split, with the same edge.
fn compare(mut case: Case) {
    let chart = case.chart().expect("a disk");
    case.edge = Some(case.fitted(&chart).expect("room for the rods"));
    let finer = split(&case.mesh);
    for way in [Way::Least, Way::Shape] {
        case.settings.way = way;
        let frame = case.form().expect("a frame").frame;
        let fine = Case { mesh: finer.clone(), ..case.clone() };
        let other = fine.form().expect("the same surface").frame;
        let most = apart(&frame, &other, |p| p);
        assert!(most < SAME, "{}, {way:?}: {most:e} diameters", case.pattern.name);
    }
}

#[test]
fn finer_triangles_on_a_flat_sheet_change_nothing() {
    for pattern in ["4.4.4.4", "3.6.3.6"] {
        compare(Case::on("flat", pattern));
    }
}

#[test]
fn finer_triangles_on_a_vault_of_flat_strips_change_nothing() {
    for pattern in ["4.4.4.4", "3.6.3.6"] {
        compare(Case { mesh: strips(), rotation: 0.3, ..Case::on("vault", pattern) });
    }
}
