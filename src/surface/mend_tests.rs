//! One fault at a time, then any mesh at all.

use super::*;
use crate::surface::samples;
use crate::surface::topology::require_disk;
use proptest::prelude::*;

fn mesh(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Mesh {
    Mesh {
        points: points.iter().map(|&p| Point3::from(p)).collect(),
        triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
    }
}

const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [100.0, 0.0, 0.0], [100.0, 100.0, 0.0], [0.0, 100.0, 0.0]];

/// A square and more points.
fn square_and(more: &[[f64; 3]]) -> Vec<[f64; 3]> {
    SQUARE.iter().chain(more).copied().collect()
}

#[test]
fn a_sound_mesh_is_left_alone() {
    for (name, _) in samples::NAMES {
        let sample = samples::sample(name).expect("listed");
        let mended = mend(sample.clone()).expect(name);
        assert_eq!(mended, Mended { mesh: sample, notes: vec![] });
    }
}

#[test]
fn a_seam_is_joined_exactly_and_nearly() {
    let points = square_and(&[[0.0; 3], [100.0, 100.0, 5e-5]]);
    let mended = mend(mesh(&points, &[[0, 1, 2], [4, 5, 3]])).expect("mendable");
    assert_eq!(mended.mesh, mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]));
    assert_eq!(
        mended.notes,
        ["1 vertex at the place of another joined to it", "1 vertex next to another joined to it"]
    );
}

#[test]
fn vertices_farther_apart_than_the_tolerance_stay_apart() {
    let points = square_and(&[[0.0, 0.0, 0.01], [100.0, 100.0, 0.01]]);
    let mended = mend(mesh(&points, &[[0, 1, 2], [4, 5, 3]])).expect("two pieces are sound");
    assert_eq!(mended.mesh.points.len(), 6);
}

#[test]
fn folded_repeated_and_unused_things_are_left_out() {
    let points = square_and(&[[50.0, 50.0, 50.0]]);
    let triangles = [[0, 1, 2], [0, 2, 3], [1, 1, 2], [2, 0, 1], [1, 0, 2]];
    let mended = mend(mesh(&points, &triangles)).expect("mendable");
    assert_eq!(mended.mesh, mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]));
    assert_eq!(
        mended.notes,
        [
            "1 triangle without area left out",
            "2 repeated triangles left out",
            "1 unused vertex left out"
        ]
    );
}

#[test]
fn a_needle_leaves_no_slit() {
    // Vertex 5 lies on the diagonal: one side uses it, the other goes straight past,
    // and a needle fills the gap.
    let points = square_and(&[[50.0, 50.0, 0.0]]);
    let triangles = [[0, 1, 4], [1, 2, 4], [0, 2, 3], [0, 4, 2]];
    let mended = mend(mesh(&points, &triangles)).expect("mendable");
    assert_eq!(mended.notes, ["1 triangle without area left out"]);
    assert_eq!(mended.mesh.triangles.len(), 4);
    assert_eq!(require_disk(&mended.mesh).expect("no slit").border_loops()[0].len(), 4);
}

#[test]
fn needles_side_by_side_leave_no_slit() {
    let points = square_and(&[[40.0, 40.0, 0.0], [60.0, 60.0, 0.0]]);
    let triangles = [[0, 1, 4], [4, 1, 5], [1, 2, 5], [0, 2, 3], [0, 4, 5], [0, 5, 2]];
    let mended = mend(mesh(&points, &triangles)).expect("mendable");
    assert_eq!(mended.notes, ["2 triangles without area left out"]);
    assert_eq!(require_disk(&mended.mesh).expect("no slit").border_loops()[0].len(), 4);
}

#[test]
fn triangles_are_turned_to_face_up() {
    let mended = mend(mesh(&SQUARE, &[[0, 2, 1], [0, 2, 3]])).expect("mendable");
    assert!(mended.mesh.triangles.ids().all(|f| mended.mesh.area_vector(f).z > 0.0));
    assert_eq!(
        mended.notes,
        ["1 triangle turned round so that the surface faces one way, up or outward"]
    );
}

#[test]
fn a_closed_surface_is_turned_to_face_outward() {
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let inside_out = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
    let mended = mend(mesh(&points, &inside_out)).expect("mendable").mesh;
    let centre = Point3::new(0.25, 0.25, 0.25);
    for f in mended.triangles.ids() {
        assert!(mended.area_vector(f).dot(&(mended.corners(f)[0] - centre)) > 0.0);
    }
}

#[test]
fn a_wall_keeps_the_side_that_most_triangles_face() {
    let wall = SQUARE.map(|[x, y, _]| [x, 0.0, y]);
    let mended = mend(mesh(&wall, &[[0, 1, 2], [0, 2, 3]])).expect("mendable");
    assert_eq!(mended.notes, Vec::<String>::new());
}

#[test]
fn what_is_no_number_is_refused_with_its_vertex() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = mend(mesh(&square_and(&[[0.0, bad, 0.0]]), &[[0, 1, 2]])).expect_err("bad");
        assert!(error.to_string().starts_with("vertex 5 is at"), "{error}");
    }
    let error = mend(mesh(&square_and(&[[0.0, 1e200, 0.0]]), &[[0, 1, 4]])).expect_err("far");
    assert!(matches!(error, MendError::TooFar { .. }));
}

#[test]
fn what_has_no_triangles_vertices_or_area_is_refused() {
    assert_eq!(mend(Mesh::default()), Err(MendError::Empty { kind: FaceKind::Triangle }));
    let line = mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], &[[0, 1, 2]]);
    let no_area = Err(MendError::NoArea { kind: FaceKind::Triangle, faces: 1 });
    assert_eq!(mend(line), no_area);
    let point = mesh(&[[3.0; 3]; 3], &[[0, 1, 2]]);
    assert_eq!(mend(point), no_area);
    let error = mend(mesh(&SQUARE, &[[0, 1, 2], [0, 2, 4]])).expect_err("no vertex 5");
    assert_eq!(error.to_string(), "triangle 2 uses vertex 5, but the vertices end at 4");
}

#[test]
fn an_edge_with_three_triangles_is_refused_by_the_numbers_of_the_file() {
    let points = [
        [9.0; 3],
        [0.0; 3],
        [100.0, 0.0, 0.0],
        [0.0, 50.0, 0.0],
        [0.0, -50.0, 0.0],
        [0.0, 0.0, 50.0],
    ];
    let error = mend(mesh(&points, &[[1, 2, 3], [2, 1, 4], [1, 2, 5]])).expect_err("a fin");
    assert_eq!(
        error.to_string(),
        "1 edge carries more than two triangles, first between vertices 2 and 3 near (50, 0, 0) mm"
    );
}

#[test]
fn a_moebius_band_is_refused() {
    let n = 24;
    let points: Vec<_> = (0..n)
        .flat_map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            [-10.0, 10.0].map(|across| {
                let r = 50.0 + across * (angle / 2.0).cos();
                [r * angle.cos(), r * angle.sin(), across * (angle / 2.0).sin()]
            })
        })
        .collect();
    let n = n as usize;
    let triangles: Vec<_> = (0..n)
        .flat_map(|i| {
            // After one turn inside and outside have changed places.
            let [a, b] = [2 * i, 2 * i + 1];
            let [c, d] = if i + 1 == n { [1, 0] } else { [2 * i + 2, 2 * i + 3] };
            [[a, b, c], [b, d, c]]
        })
        .collect();
    let error = mend(mesh(&points, &triangles)).expect_err("one side only");
    assert!(matches!(error, MendError::OneSided { .. }), "{error}");
}

proptest! {
    #[test]
    fn what_is_mended_is_sound_and_mending_again_changes_nothing(
        points in proptest::collection::vec([-2_i32..3, -2..3, -2..3], 1..10),
        triangles in proptest::collection::vec([0_usize..10, 0..10, 0..10], 0..16),
    ) {
        let points: Vec<_> = points.iter().map(|p| p.map(f64::from)).collect();
        if let Ok(Mended { mesh, .. }) = mend(mesh(&points, &triangles)) {
            prop_assert!(crate::surface::topology::Topology::new(&mesh).is_ok());
            let again = mend(mesh.clone());
            prop_assert_eq!(again, Ok(Mended { mesh, notes: vec![] }));
        }
    }
}
