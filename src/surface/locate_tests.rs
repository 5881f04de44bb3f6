//! Against closed forms and against looking at every triangle.

use super::*;
use crate::surface::samples;
use proptest::prelude::*;
use std::sync::LazyLock;

fn coordinate() -> impl Strategy<Value = f64> {
    // Whole numbers as often as not, to meet corners, sides and needles.
    prop_oneof![(-6_i32..6).prop_map(f64::from), -6.0..6.0_f64]
}

fn point() -> impl Strategy<Value = Point3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Point3::new(x, y, z))
}

fn soup() -> impl Strategy<Value = Mesh> {
    proptest::collection::vec([point(), point(), point()], 1..40).prop_map(|corners| {
        let triangles = (0..corners.len()).map(|i| [0, 1, 2].map(|k| VertexId::new(3 * i + k)));
        Mesh {
            triangles: triangles.collect(),
            points: corners.into_iter().flatten().collect::<Vec<_>>().into(),
        }
    })
}

/// The nearest point by ternary search in both directions: slow and independent.
fn sampled_distance(p: Point3, [a, b, c]: [Point3; 3]) -> f64 {
    let least = |f: &dyn Fn(f64) -> f64| {
        let (mut lo, mut hi) = (0.0, 1.0);
        for _ in 0..80 {
            let (m, n) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
            if f(m) < f(n) { hi = n } else { lo = m }
        }
        f(0.5 * (lo + hi)).min(f(0.0)).min(f(1.0))
    };
    let from_row = |s: f64| {
        let (d, e) = (a + (b - a) * s, a + (c - a) * s);
        least(&|t| (d + (e - d) * t - p).norm())
    };
    least(&from_row)
}

proptest! {
    #[test]
    fn closest_on_triangle_is_no_farther_than_a_search_finds(
        p in point(), corners in [point(), point(), point()]
    ) {
        let w = closest_on_triangle(&p, &corners);
        prop_assert!(w.iter().all(|w| (0.0..=1.0).contains(w)), "{:?}", w);
        prop_assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let distance = (blend(&corners, w) - p).norm();
        prop_assert!(distance <= sampled_distance(p, corners) + 1e-6);
    }

    #[test]
    fn the_tree_finds_what_a_look_at_every_triangle_finds(mesh in soup(), p in point()) {
        let found = Locator::new(&mesh).closest(p);
        let distance = |f| {
            let corners = mesh.corners(f);
            (blend(&corners, closest_on_triangle(&p, &corners)) - p).norm()
        };
        let brute = mesh.triangles.ids().map(distance).fold(f64::INFINITY, f64::min);
        prop_assert!((found.distance - brute).abs() < 1e-12);
        prop_assert!((distance(found.face) - brute).abs() < 1e-12);
        prop_assert_eq!(closest(&mesh, p), found);
    }

    #[test]
    fn the_tree_meets_the_ray_where_the_first_triangle_does(
        mesh in soup(), p in point(), towards in point()
    ) {
        let direction = towards.coords;
        let hit = Locator::new(&mesh).ray(p, direction);
        let brute = mesh
            .triangles
            .ids()
            .filter_map(|f| ray_triangle(p, direction, &mesh.corners(f)))
            .map(|(along, _)| along)
            .fold(f64::INFINITY, f64::min);
        prop_assert_eq!(hit.map_or(f64::INFINITY, |h| h.along), brute);
    }

    #[test]
    fn a_planar_point_lies_in_the_triangle_it_was_made_from(
        face in 0_usize..5000, u in 0.0..1.0_f64, v in 0.0..1.0_f64
    ) {
        let (positions, mesh, locator) = &*FLAT;
        let face = FaceId::new(face % mesh.triangles.len());
        let w = if u + v > 1.0 { [u + v - 1.0, 1.0 - u, 1.0 - v] } else { [1.0 - u - v, u, v] };
        let corners = mesh.triangles[face].map(|c| positions[c.index()]);
        let p = blend(&corners, w);
        let found = locator.locate(p).expect("inside");
        let again = mesh.triangles[found.face].map(|c| positions[c.index()]);
        prop_assert!((blend(&again, found.barycentric) - p).norm() < 1e-6);
        if w.iter().all(|w| *w > 1e-6) {
            prop_assert_eq!(found.face, face);
        }
    }
}

/// A flat sheet: its points in the plane, its mesh, its locator.
static FLAT: LazyLock<(Vec<Point2<f64>>, Mesh, PlanarLocator)> = LazyLock::new(|| {
    let mesh = samples::sample("flat").expect("a sample");
    let positions: Vec<_> = mesh.points.iter().map(|p| p.xy()).collect();
    let locator = PlanarLocator::new(&positions, &mesh.triangles);
    (positions, mesh, locator)
});

#[test]
fn every_corner_and_edge_midpoint_of_a_flat_mesh_is_found() {
    let (positions, mesh, locator) = &*FLAT;
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (positions[t[k].index()], positions[t[(k + 1) % 3].index()]);
            for p in [a, nalgebra::center(&a, &b)] {
                let found = locator.locate(p).expect("on the mesh");
                let corners = mesh.triangles[found.face].map(|c| positions[c.index()]);
                assert!((blend(&corners, found.barycentric) - p).norm() < 1e-7);
            }
        }
    }
}

#[test]
fn a_point_outside_a_flat_mesh_is_in_no_triangle_but_near_one() {
    let (positions, mesh, locator) = &*FLAT;
    let p = Point2::new(310.0, 12.5);
    assert_eq!(locator.locate(p), None);
    let found = locator.closest(p).expect("a mesh with triangles");
    let corners = mesh.triangles[found.face].map(|c| positions[c.index()]);
    assert!((blend(&corners, found.barycentric) - Point2::new(300.0, 12.5)).norm() < 1e-9);
}

#[test]
fn a_flat_mesh_without_triangles_or_area_holds_no_point() {
    let p = Point2::new(0.0, 0.0);
    assert_eq!(PlanarLocator::new(&[], &[]).locate(p), None);
    assert_eq!(PlanarLocator::new(&[], &[]).closest(p), None);
    let point = PlanarLocator::new(&[p], &[[VertexId::new(0); 3]]);
    assert_eq!(point.locate(p), None);
}

#[test]
fn distance_from_a_dome_follows_its_radius() {
    let mesh = samples::sample("igloo").expect("a sample");
    let locator = Locator::new(&mesh);
    let hit = locator.ray(Point3::new(0.0, 0.0, 500.0), -Vector3::z()).expect("the top");
    assert!((hit.point.z - 220.0).abs() < 1e-9 && (hit.along - 280.0).abs() < 1e-9);
    let found = locator.closest(Point3::new(0.0, 0.0, 250.0));
    assert!((found.distance - 30.0).abs() < 1e-9);
    assert_eq!(locator.ray(Point3::new(0.0, 0.0, 500.0), Vector3::z()), None);
}

#[test]
fn a_query_that_is_not_finite_does_not_panic() {
    let mesh = samples::sample("flat").expect("a sample");
    let locator = Locator::new(&mesh);
    let nan = Point3::new(f64::NAN, 0.0, 0.0);
    assert!(locator.closest(nan).distance.is_nan());
    assert_eq!(locator.ray(nan, Vector3::z()), None);
    assert_eq!(locator.ray(Point3::origin(), Vector3::zeros()), None);
}
