//! One fault at a time, then any mesh at all.

use super::*;
use crate::surface::topology::{Topology, require_disk};
use proptest::prelude::*;

fn mesh(points: &[[f64; 3]], faces: &[&[usize]]) -> PolygonMesh {
    PolygonMesh {
        points: points.iter().map(|&p| Point3::from(p)).collect(),
        faces: faces.iter().map(|f| f.iter().map(|&i| VertexId::new(i)).collect()).collect(),
    }
}

/// Two squares side by side.
const PAIR: [[f64; 3]; 6] = [
    [0.0; 3],
    [100.0, 0.0, 0.0],
    [200.0, 0.0, 0.0],
    [200.0, 100.0, 0.0],
    [100.0, 100.0, 0.0],
    [0.0, 100.0, 0.0],
];

fn pair_and(more: &[[f64; 3]]) -> Vec<[f64; 3]> {
    PAIR.iter().chain(more).copied().collect()
}

fn area(mesh: &PolygonMesh) -> f64 {
    mesh.faces.iter().map(|f| 0.5 * area_vector(&mesh.points, f).z).sum()
}

#[test]
fn a_sound_mesh_is_left_alone() {
    let pair = mesh(&PAIR, &[&[0, 1, 4, 5], &[1, 2, 3, 4]]);
    let mended = mend_polygons(pair.clone()).expect("sound");
    assert_eq!(mended, MendedPolygons { mesh: pair.clone(), notes: vec![] });
    assert_eq!(pair.bounds(), Some([Point3::origin(), Point3::new(200.0, 100.0, 0.0)]));
    let triangles = pair.triangles();
    assert_eq!(triangles.points, pair.points);
    assert_eq!(triangles.triangles.len(), 4);
    require_disk(&triangles).expect("one disk");
}

#[test]
fn seams_repeats_spikes_and_unused_vertices_are_mended() {
    // The second square has its own copies of vertices 1 and 4, and a spike to vertex 8.
    let points = pair_and(&[[100.0, 0.0, 0.0], [100.0, 100.0, 5e-5], [150.0, 50.0, 0.0], [9.0; 3]]);
    let faces: [&[usize]; 4] =
        [&[0, 1, 1, 4, 5, 0], &[6, 2, 8, 2, 3, 7], &[3, 2, 6, 7], &[5, 5, 4]];
    let mended = mend_polygons(mesh(&points, &faces)).expect("mendable");
    assert_eq!(mended.mesh, mesh(&PAIR, &[&[0, 1, 4, 5], &[1, 2, 3, 4]]));
    assert_eq!(
        mended.notes,
        [
            "1 vertex at the place of another joined to it",
            "1 vertex next to another joined to it",
            "1 face without area left out",
            "1 repeated face left out",
            "2 unused vertices left out"
        ]
    );
}

#[test]
fn a_face_without_area_leaves_no_slit() {
    // The left square has the edge between vertices 1 and 4 in one piece, the right one
    // in three; a flat face fills the gap, either way round.
    let points = pair_and(&[[100.0, 30.0, 0.0], [100.0, 60.0, 0.0]]);
    for flat in [[1, 6, 7, 4], [4, 7, 6, 1]] {
        let faces: [&[usize]; 3] = [&[0, 1, 4, 5], &[1, 2, 3, 4, 7, 6], &flat];
        let mended = mend_polygons(mesh(&points, &faces)).expect("mendable");
        assert_eq!(mended.notes, ["1 face without area left out"]);
        assert_eq!(mended.mesh, mesh(&points, &[&[0, 1, 6, 7, 4, 5], &[1, 2, 3, 4, 7, 6]]));
        let topology = require_disk(&mended.mesh.triangles()).expect("no slit");
        assert_eq!(topology.border_loops()[0].len(), 6);
    }
}

#[test]
fn faces_are_turned_to_agree_and_to_face_up_or_outward() {
    let mended = mend_polygons(mesh(&PAIR, &[&[5, 4, 1, 0], &[1, 2, 3, 4]])).expect("mendable");
    assert!((area(&mended.mesh) - 20_000.0).abs() < 1e-9);
    assert_eq!(
        mended.notes,
        ["1 face turned round so that the surface faces one way, up or outward"]
    );

    let cube: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
    // All inward.
    let faces: [&[usize]; 6] =
        [&[0, 1, 3, 2], &[4, 6, 7, 5], &[0, 4, 5, 1], &[2, 3, 7, 6], &[0, 2, 6, 4], &[1, 5, 7, 3]];
    let mended = mend_polygons(mesh(&cube, &faces)).expect("mendable").mesh;
    for face in &mended.faces {
        let outward = mended.points[face[0]] - Point3::new(0.5, 0.5, 0.5);
        assert!(area_vector(&mended.points, face).dot(&outward) > 0.0);
    }
}

#[test]
fn faults_are_refused_by_the_numbers_of_the_file() {
    let hole = pair_and(&[[40.0, 40.0, 0.0], [60.0, 40.0, 0.0], [50.0, 60.0, 0.0]]);
    let cases: [(&[&[usize]], &str); 6] = [
        (&[], "the surface has no faces"),
        (&[&[0, 1, 9, 4]], "face 1 uses vertex 10, but the vertices end at 9"),
        (&[&[1, 2, 3, 4], &[0, 4, 1, 5]], "the outline of face 2 crosses itself"),
        (&[&[0, 1, 4, 5, 0, 6, 8, 7, 6]], "face 1 passes vertex 1 twice"),
        (&[&[0, 1], &[0, 1, 2]], "the surface has no area: all 2 faces are points or lines"),
        (
            &[&[0, 1, 4, 5], &[1, 2, 3, 4], &[1, 4, 6]],
            "1 edge carries more than two faces, first between vertices 2 and 5 near (100, 50, 0) mm",
        ),
    ];
    for (faces, expected) in cases {
        let error = mend_polygons(mesh(&hole, faces)).expect_err(expected);
        assert_eq!(error.to_string(), expected);
        assert!(!error.hint().is_empty());
    }
    let error = mend_polygons(mesh(&[[0.0; 3], [1.0, f64::NAN, 0.0]], &[&[0, 1, 0]]));
    assert!(error.expect_err("no number").to_string().starts_with("vertex 2 is at (1, NaN, 0)"));
    let error = mend_polygons(mesh(&[[0.0; 3], [1e10, 0.0, 0.0]], &[&[0, 1, 0]]));
    assert!(matches!(error, Err(MendError::TooFar { .. })));
}

#[test]
fn a_figure_of_eight_without_net_area_is_crossed_and_not_flat() {
    let points = [[0.0; 3], [10.0, 10.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]];
    let error = mend_polygons(mesh(&points, &[&[0, 1, 2, 3]])).expect_err("crossed");
    assert_eq!(error, MendError::Crossed { face: FaceId::new(0) });
}

/// A skew square with a spike back to itself: whether it crosses hung on which way round it was
/// looked at, and it was turned in between.
#[test]
fn a_face_on_the_brink_of_crossing_is_told_the_same_both_ways_round() {
    let points = [[-2.0, -2.0, 0.0], [-1.0, -2.0, 2.0], [-1.0, 1.0, -1.0], [0.0; 3]];
    let crossed = Err(MendError::Crossed { face: FaceId::new(0) });
    for face in [[0, 1, 2, 3], [0, 3, 2, 1]] {
        assert_eq!(mend_polygons(mesh(&points, &[&face])), crossed);
    }
}

#[test]
fn a_polygon_of_too_many_corners_is_refused_before_work_is_done() {
    let n = MOST_CORNERS + 1;
    let points: Vec<_> = (0..n).map(|i| [(i as f64).cos() * 9.0, i as f64, 0.0]).collect();
    let ring: Vec<usize> = (0..n).collect();
    let error = mend_polygons(mesh(&points, &[&ring])).expect_err("too many");
    assert_eq!(error, MendError::TooManyCorners { face: FaceId::new(0), corners: n });
}

proptest! {
    #[test]
    fn what_is_mended_is_sound_and_mending_again_changes_nothing(
        points in proptest::collection::vec([-2_i32..3, -2..3, -2..3], 1..10),
        faces in proptest::collection::vec(proptest::collection::vec(0_usize..10, 1..7), 0..8),
    ) {
        let points: Vec<_> = points.iter().map(|p| p.map(f64::from)).collect();
        let faces: Vec<&[usize]> = faces.iter().map(|f| &f[..]).collect();
        if let Ok(MendedPolygons { mesh, .. }) = mend_polygons(mesh(&points, &faces)) {
            let sides = sorted_sides(&mesh.faces);
            for edge in sides.chunk_by(|a, b| a.edge == b.edge) {
                prop_assert!(edge.len() == 1 || edge.len() == 2 && edge[0].forward != edge[1].forward);
            }
            prop_assert_eq!(mend_polygons(mesh.clone()), Ok(MendedPolygons { mesh, notes: vec![] }));
        }
    }

    #[test]
    fn triangles_are_mended_as_by_their_own_mender(
        points in proptest::collection::vec([-2_i32..3, -2..3], 3..9),
        triangles in proptest::collection::vec([0_usize..9, 0..9, 0..9], 1..8),
    ) {
        // Without needles, which the two cut in different ways.
        let points: Vec<_> =
            points.iter().enumerate().map(|(i, p)| [f64::from(p[0]), f64::from(p[1]), (i * i) as f64 * 0.37]).collect();
        let faces: Vec<&[usize]> = triangles.iter().map(|f| &f[..]).collect();
        let polygons = mesh(&points, &faces);
        let triangles = Mesh {
            points: polygons.points.clone(),
            triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
        };
        match (mend_polygons(polygons), crate::surface::mend::mend(triangles)) {
            (Ok(a), Ok(b)) if !b.notes.iter().any(|n| n.contains("without area")) => {
                prop_assert!(Topology::new(&b.mesh).is_ok());
                prop_assert_eq!(a.mesh.triangles(), b.mesh);
            }
            (a, b) => prop_assert_eq!(a.is_ok(), b.is_ok()),
        }
    }
}
