//! Shapes whose pieces, loops and genus are known.

use super::*;
use crate::surface::bow_ties::split_bow_ties;
use crate::surface::samples;
use proptest::prelude::*;

fn mesh(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Mesh {
    Mesh {
        points: points.iter().map(|&p| Point3::from(p)).collect(),
        triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
    }
}

/// A grid of squares, each cut in two, wrapped round in the directions asked for.
/// Triangles of the squares in `left_out` are missing.
fn grid(n: usize, m: usize, wrap: [bool; 2], left_out: &[(usize, usize)]) -> Mesh {
    let columns = if wrap[0] { n } else { n + 1 };
    let rows = if wrap[1] { m } else { m + 1 };
    let at = |i: usize, j: usize| (j % rows) * columns + i % columns;
    let points: Vec<_> =
        (0..rows * columns).map(|k| [(k % columns) as f64, (k / columns) as f64, 0.0]).collect();
    let mut triangles = Vec::new();
    for j in 0..m {
        for i in (0..n).filter(|&i| !left_out.contains(&(i, j))) {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh(&points, &triangles)
}

fn tetrahedron() -> Mesh {
    mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
}

/// Loops and genus of each piece.
fn loops_and_genus(mesh: &Mesh) -> Vec<(usize, usize)> {
    let topology = Topology::new(mesh).expect("sound");
    let shape = Shape::new(mesh, &topology);
    shape.pieces.iter().map(|p| (p.borders.len(), p.genus)).collect()
}

#[test]
fn loops_and_genus_of_known_shapes() {
    assert_eq!(loops_and_genus(&grid(4, 3, [false, false], &[])), [(1, 0)]);
    assert_eq!(loops_and_genus(&grid(4, 3, [true, false], &[])), [(2, 0)]);
    assert_eq!(loops_and_genus(&grid(4, 3, [true, true], &[])), [(0, 1)]);
    assert_eq!(loops_and_genus(&grid(5, 5, [true, true], &[(2, 2)])), [(1, 1)]);
    assert_eq!(loops_and_genus(&grid(5, 5, [false, false], &[(1, 1), (3, 3)])), [(3, 0)]);
    assert_eq!(loops_and_genus(&tetrahedron()), [(0, 0)]);
    assert_eq!(loops_and_genus(&Mesh::default()), []);
}

#[test]
fn twins_run_the_other_way_and_next_stays_in_the_triangle() {
    let topology = require_disk(&samples::sample("igloo").expect("a sample")).expect("a disk");
    for h in topology.halfedges() {
        assert_eq!(h.next().prev(), h);
        assert_eq!(h.next().next().next(), h);
        assert_eq!(h.next().face(), h.face());
        if let Some(t) = topology.twin(h) {
            assert_eq!(topology.twin(t), Some(h));
            assert_eq!((topology.from(t), topology.to(t)), (topology.to(h), topology.from(h)));
        }
    }
    let (v, e, f) = (topology.vertex_count(), topology.edges().count(), topology.face_count());
    assert_eq!(v + f, e + 1, "Euler's formula of a disk");
}

#[test]
fn outgoing_half_edges_go_round_each_vertex_once() {
    let mesh = grid(5, 4, [false, false], &[(2, 2)]);
    let topology = Topology::new(&mesh).expect("sound");
    let mut total = 0;
    for v in mesh.points.ids() {
        let around: Vec<_> = topology.outgoing(v).collect();
        assert!(around.iter().all(|&h| topology.from(h) == v));
        for pair in around.windows(2) {
            // Counter-clockwise: the next one starts on the other side of the triangle.
            assert_eq!(topology.to(pair[1]), topology.from(pair[0].prev()));
        }
        assert_eq!(topology.is_border(v), topology.twin(around[0]).is_none());
        total += around.len();
    }
    assert_eq!(total, 3 * mesh.triangles.len());
}

#[test]
fn the_border_of_a_sheet_runs_counter_clockwise_and_that_of_a_hole_clockwise() {
    let mesh = grid(4, 4, [false, false], &[(1, 1)]);
    let area = |l: &Vec<VertexId>| -> f64 {
        (0..l.len())
            .map(|i| {
                mesh.points[l[i]].xy().coords.perp(&mesh.points[l[(i + 1) % l.len()]].xy().coords)
            })
            .sum()
    };
    let loops = Topology::new(&mesh).expect("sound").border_loops();
    assert_eq!(loops.iter().map(Vec::len).collect::<Vec<_>>(), [16, 4]);
    assert_eq!(loops.iter().map(area).collect::<Vec<_>>(), [32.0, -2.0]);
}

#[test]
fn an_edge_with_three_triangles_is_named() {
    let fin = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
        &[[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    );
    let error = require_disk(&fin).expect_err("three triangles at 1-2");
    assert!(matches!(error, TopologyError::NonManifoldEdges { count: 1, .. }));
    assert!(error.to_string().contains("between vertices 1-2"), "{error}");
}

#[test]
fn neighbours_that_face_opposite_ways_are_named() {
    let turned = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        &[[0, 1, 2], [1, 2, 3]],
    );
    let error = require_disk(&turned).expect_err("edge 2-3 is run through twice");
    assert!(matches!(error, TopologyError::Orientation { count: 1, .. }));
    assert!(error.to_string().contains("2-3"), "{error}");
}

#[test]
fn a_vertex_that_does_not_exist_is_named() {
    let error = Topology::new(&mesh(&[[0.0; 3]], &[[0, 0, 7]])).expect_err("vertex 8");
    assert_eq!(error.to_string(), "triangle 1 uses vertex 8, but the vertices end at 1");
}

#[test]
fn a_bow_tie_is_found_and_its_wings_are_two_pieces() {
    let tie = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]],
        &[[0, 1, 2], [0, 3, 4]],
    );
    let topology = Topology::new(&tie).expect("each edge is sound");
    assert_eq!(topology.bow_ties(), [VertexId::new(0)]);
    assert_eq!(topology.fans(VertexId::new(0)), 2);
    assert_eq!(loops_and_genus(&tie), [(1, 0), (1, 0)]);
    let error = require_disk(&tie).expect_err("a bow-tie");
    assert!(error.to_string().contains("vertex 1 at (0, 0, 0) mm"), "{error}");
}

#[test]
fn two_holes_that_touch_in_a_vertex_are_one_loop_through_it_twice() {
    // Two missing squares that touch in a corner.
    let sheet = grid(4, 4, [false, false], &[(1, 1), (2, 2)]);
    assert_eq!(loops_and_genus(&sheet), [(2, 0)]);
    assert_eq!(Topology::new(&sheet).expect("sound").bow_ties().len(), 1);
}

#[test]
fn what_is_no_disk_is_told_in_a_table() {
    let mut two = grid(5, 5, [false, false], &[(2, 2)]);
    let other = tetrahedron();
    let shift = two.points.len();
    let points: Vec<_> = two.points.iter().chain(other.points.iter()).copied().collect();
    let moved = other.triangles.iter().map(|t| t.map(|v| VertexId::new(v.index() + shift)));
    let triangles: Vec<_> = two.triangles.iter().copied().chain(moved).collect();
    two = Mesh { points: points.into(), triangles: triangles.into() };
    let error = require_disk(&two).expect_err("two pieces");
    assert_eq!(
        error.to_string(),
        "the surface is not one piece with one border:\n  \
         piece  triangles  loops  genus   area, mm²  size, mm\n      \
         1         48      2      0          24  5 x 5 x 0 (1 hole)\n      \
         2          4      0      0        2.37  1 x 1 x 1 (closed)\n  \
         hole of 4 edges around (2.5, 2.5, 0) mm"
    );
    assert!(error.hint().starts_with("keep one piece with --component largest (piece 1)"));
    assert!(!error.hint().contains("--cut"), "the largest piece has a border");
}

#[test]
fn holes_are_chartable_but_no_disk() {
    let sheet = grid(5, 5, [false, false], &[(1, 1), (3, 3)]);
    require_chartable(&sheet).expect("holes are filled by the chart");
    let error = require_disk(&sheet).expect_err("two holes");
    assert!(matches!(error, TopologyError::NotADisk(_)));
    assert!(error.hint().contains("fill the holes"), "{}", error.hint());
}

#[test]
fn what_has_no_chart_is_told_with_the_option_that_helps() {
    let cases = [
        (tetrahedron(), &["--cut z=30%", "--pattern mesh"][..]),
        (grid(5, 5, [true, true], &[]), &["--cut z=50%", "--pattern mesh"]),
        (grid(5, 5, [true, true], &[(2, 2)]), &["--cut z=50%", "--pattern mesh"]),
        (Mesh::default(), &["no triangles"]),
    ];
    for (mesh, words) in cases {
        let error = require_chartable(&mesh).expect_err("no chart");
        assert!(error.to_string().contains("not one piece with a border and no handle"), "{error}");
        for word in words {
            assert!(error.hint().contains(word), "{}", error.hint());
        }
    }
}

#[test]
fn of_many_pieces_the_largest_are_shown() {
    let triangles: Vec<[usize; 3]> = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let points: Vec<[f64; 3]> = (1..=20)
        .flat_map(|i| {
            [[0.0, 0.0, f64::from(i)], [f64::from(i), 0.0, 0.0], [0.0, f64::from(i), 0.0]]
        })
        .collect();
    let many = mesh(&points, &triangles);
    let shape = Shape::new(&many, &Topology::new(&many).expect("sound"));
    let table = shape.to_string();
    assert_eq!(shape.largest(), Some(19));
    assert!(table.ends_with("and 8 smaller pieces"), "{table}");
    assert!(!table.contains("\n      8 ") && table.contains("\n      9 "), "{table}");
    assert!(shape.hint().contains("largest (piece 20)"), "{}", shape.hint());
}

#[test]
fn a_divided_bow_tie_leaves_the_triangles_where_they_are() {
    let tie = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]],
        &[[0, 1, 2], [0, 3, 4]],
    );
    let sheet = grid(4, 4, [false, false], &[(1, 1), (2, 2)]);
    for (before, shape) in [(tie, &[(1, 0), (1, 0)][..]), (sheet, &[(2, 0)])] {
        let (after, count) = split_bow_ties(before.clone());
        assert_eq!((count, after.points.len()), (1, before.points.len() + 1));
        assert_eq!(Topology::new(&after).expect("sound").bow_ties(), []);
        for face in before.triangles.ids() {
            assert_eq!(before.corners(face), after.corners(face));
        }
        assert_eq!(loops_and_genus(&after), shape);
        assert_eq!(split_bow_ties(after.clone()), (after, 0));
    }
    let sheet = split_bow_ties(grid(4, 4, [false, false], &[(1, 1), (2, 2)])).0;
    require_chartable(&sheet).expect("one hole of eight edges");
}

#[test]
fn an_empty_mesh_is_no_disk() {
    let error = require_disk(&Mesh::default()).expect_err("nothing there");
    assert!(error.hint().contains("no triangles"));
}

proptest! {
    #[test]
    fn any_triangles_give_an_answer(corners in proptest::collection::vec([0_usize..9, 0..9, 0..9], 0..30)) {
        let soup = mesh(&[[0.0; 3]; 8], &corners);
        let _ = require_disk(&soup);
        let (divided, count) = split_bow_ties(soup.clone());
        prop_assert_eq!(divided.triangles.len(), soup.triangles.len());
        if let Ok(topology) = Topology::new(&divided) {
            prop_assert!(topology.bow_ties().is_empty());
            prop_assert_eq!(divided.points.len() > soup.points.len(), count > 0);
        }
    }
}
