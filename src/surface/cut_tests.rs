//! Areas, borders and shapes of cut surfaces that are known beforehand.

use super::*;
use crate::chart::PlanarChart;
use crate::ids::Id;
use crate::surface::shape::Shape;
use crate::surface::topology::{Topology, require_chartable, require_disk};
use crate::surface::{Vector3, samples};
use nalgebra::Rotation3;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn plane(text: &str) -> CutPlane {
    text.parse().expect("a plane")
}

fn at(z: f64) -> CutPlane {
    CutPlane::Height(Length::from_mm(z).expect("finite"))
}

fn area(mesh: &Mesh) -> f64 {
    mesh.triangles.ids().map(|f| 0.5 * mesh.area_vector(f).norm()).sum()
}

/// A closed ball of radius 100 with its poles on the z axis.
fn sphere(rings: usize, columns: usize) -> Mesh {
    let point = |i: usize, j: usize| {
        let (s, c) = (PI * i as f64 / rings as f64).sin_cos();
        let (y, x) = (TAU * j as f64 / columns as f64).sin_cos();
        Point3::new(100.0 * s * x, 100.0 * s * y, 100.0 * c)
    };
    let mut mesh = Mesh::default();
    let top = mesh.points.push(Point3::new(0.0, 0.0, 100.0));
    let bottom = mesh.points.push(Point3::new(0.0, 0.0, -100.0));
    for i in 1..rings {
        (0..columns).for_each(|j| _ = mesh.points.push(point(i, j)));
    }
    let v = |i: usize, j: usize| VertexId::new(2 + (i - 1) * columns + j % columns);
    for j in 0..columns {
        mesh.triangles.push([top, v(1, j), v(1, j + 1)]);
        for i in 1..rings - 1 {
            mesh.triangles.push([v(i, j), v(i + 1, j), v(i + 1, j + 1)]);
            mesh.triangles.push([v(i, j), v(i + 1, j + 1), v(i, j + 1)]);
        }
        mesh.triangles.push([v(rings - 1, j), bottom, v(rings - 1, j + 1)]);
    }
    mesh
}

/// A ring of radius 100 and 30, upright: its axis lies along x. The hole is between
/// -70 and 70.
fn torus() -> Mesh {
    const N: usize = 36;
    const M: usize = 18;
    let point = |k: usize| {
        let (s, c) = (TAU * (k / M) as f64 / N as f64 + 0.1).sin_cos();
        let (t, d) = (TAU * (k % M) as f64 / M as f64 + 0.1).sin_cos();
        Point3::new(30.0 * t, (100.0 + 30.0 * d) * c, (100.0 + 30.0 * d) * s)
    };
    let v = |i: usize, j: usize| VertexId::new((i % N) * M + j % M);
    let squares = (0..N * M).map(|k| (k / M, k % M));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh { points: (0..N * M).map(point).collect(), triangles: triangles.collect() }
}

fn turned(mesh: &Mesh, axis: [f64; 3], angle: f64) -> Mesh {
    let axis = nalgebra::Unit::new_normalize(Vector3::from(axis));
    let turn = Rotation3::from_axis_angle(&axis, angle);
    Mesh {
        points: mesh.points.iter().map(|p| turn * p).collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// The same surface upside down: what lies below comes to lie above.
fn mirrored(mesh: &Mesh) -> Mesh {
    Mesh {
        points: mesh.points.iter().map(|p| Point3::new(p.x, p.y, -p.z)).collect(),
        triangles: mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    }
}

/// Loops and genus of each piece; the mesh must be sound and without bow-ties.
fn loops_and_genus(mesh: &Mesh) -> Vec<(usize, usize)> {
    let topology = Topology::new(mesh).expect("sound");
    assert_eq!(topology.bow_ties(), []);
    let pieces = Shape::new(mesh, &topology).pieces;
    pieces.iter().map(|p| (p.borders.len(), p.genus)).collect()
}

#[test]
fn planes_are_read_and_shown() {
    for (text, shown) in [
        ("z=120mm", "z=120mm"),
        ("z=0.2m", "z=200mm"),
        ("z=-5", "z=-5mm"),
        (" Z = 1/2 in ", "z=12.7mm"),
        ("z=40%", "z=40%"),
        ("z= 33.3 %", "z=33.3%"),
    ] {
        assert_eq!(plane(text).to_string(), shown);
        assert_eq!(plane(shown), plane(text));
        let json = serde_json::to_string(&plane(text)).expect("a text");
        assert_eq!(serde_json::from_str::<CutPlane>(&json).expect("itself"), plane(text));
    }
    for (bad, word) in [
        ("120mm", "z=120mm"),
        ("x=3", "z=120mm"),
        ("z", "z=120mm"),
        ("z=", "number"),
        ("z=%", "number"),
        ("z=ten%", "`ten`"),
        ("z=120%", "0% to 100%"),
        ("z=-1%", "0% to 100%"),
        ("z=NaN%", "0% to 100%"),
        ("z=3 furlongs", "furlongs"),
    ] {
        let error = bad.parse::<CutPlane>().expect_err(bad).to_string();
        assert!(error.contains(word) && error.contains(bad), "{bad}: {error}");
    }
}

#[test]
fn a_triangle_is_split_on_its_edges() {
    let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 0.0, 4.0], [9.0, 9.0, 9.0]];
    let mesh = Mesh {
        points: points.iter().map(|&p| Point3::from(p)).collect(),
        triangles: vec![[0, 1, 2].map(VertexId::new)].into(),
    };
    let above = cut(&mesh, plane("z=1")).expect("a tip");
    let expected = [[0.0, 0.0, 4.0], [0.0, 0.0, 1.0], [3.0, 0.0, 1.0]].map(Point3::from);
    assert_eq!(above.points.to_vec(), expected);
    assert_eq!(above.triangles.to_vec(), [[0, 1, 2].map(VertexId::new)]);
    let below = cut(&mirrored(&mesh), plane("z=-1")).expect("a foot");
    assert_eq!((below.points.len(), below.triangles.len()), (4, 2));
    assert!((area(&above) + area(&below) - 8.0).abs() < 1e-12);
}

#[test]
fn neighbours_share_the_new_vertices() {
    let dome = samples::sample("igloo").expect("a sample");
    for percent in [1.0, 30.0, 55.5, 99.0] {
        let above = cut(&dome, CutPlane::Percent(percent)).expect("a cap");
        let topology = require_disk(&above).expect("one disk");
        let height = above.bounds().expect("not empty")[0].z;
        for v in above.points.ids().filter(|&v| topology.is_border(v)) {
            assert_eq!(above.points[v].z, height);
        }
    }
}

#[test]
fn what_lies_in_the_plane_goes_and_a_plane_at_the_foot_cuts_nothing_else() {
    // A box on the ground: at z = 0 its floor is taken out, at the top all is gone.
    let corners = (0..8).map(|k| Point3::new((k & 1).into(), (k >> 1 & 1).into(), (k >> 2).into()));
    let faces = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    let cube = Mesh {
        points: corners.collect(),
        triangles: faces.iter().map(|t| t.map(VertexId::new)).collect(),
    };
    assert_eq!(loops_and_genus(&cube), [(0, 0)]);
    let open = cut(&cube, plane("z=0")).expect("a box");
    assert_eq!((area(&open), loops_and_genus(&open)), (5.0, vec![(1, 0)]));
    assert_eq!(open.points, cube.points);
    assert!(matches!(cut(&cube, plane("z=100%")), Err(CutFault::NothingAbove { .. })));
    let dome = samples::sample("igloo").expect("a sample");
    assert_eq!(cut(&dome, plane("z=0%")), Ok(dome));
}

#[test]
fn a_plane_that_passes_by_is_refused_with_the_heights() {
    let ball = sphere(6, 8);
    for text in ["z=101", "z=-0.2m"] {
        let fault = cut(&ball, plane(text)).expect_err("outside");
        assert!(fault.to_string().contains("reaches from -100 to 100 mm"), "{fault}");
    }
    assert_eq!(cut(&Mesh::default(), plane("z=50%")), Err(CutFault::Empty));
    let fault = CutFault::NothingAbove { plane: at(0.3), range: [-1e-9, 0.1 + 0.2] };
    assert!(fault.to_string().contains("from 0 to 0.3 mm"), "{fault}");
}

#[test]
fn an_upright_torus_falls_into_what_topology_says() {
    let ring = torus();
    assert_eq!(loops_and_genus(&ring), [(0, 1)]);
    let of = |z: f64| loops_and_genus(&cut(&ring, at(z)).expect("a part"));
    assert_eq!(of(0.0), [(2, 0)], "half a ring is a tube");
    assert_eq!(of(50.0), [(2, 0)]);
    assert_eq!(of(-90.0), [(1, 1)], "the handle is still there");
    assert_eq!(of(100.0), [(1, 0)], "above the hole only a cap is left");
}

#[test]
fn two_hills_that_meet_in_a_saddle_get_a_vertex_each() {
    let points = [[0, 0, 1], [1, 0, 2], [0, 1, 0], [-1, 0, 2], [0, -1, 0]];
    let mesh = Mesh {
        points: points.iter().map(|p| Point3::from(p.map(f64::from))).collect(),
        triangles: (1..5).map(|k| [0, k, k % 4 + 1].map(VertexId::new)).collect(),
    };
    let hills = cut(&mesh, plane("z=1")).expect("two hills");
    assert_eq!(loops_and_genus(&hills), [(1, 0), (1, 0)]);
}

#[test]
fn areas_add_up_to_rounding_where_nothing_is_moved() {
    let ring = torus();
    for z in [-101.3, -31.7, 0.37, 71.9] {
        let above = area(&cut(&ring, at(z)).expect("a part"));
        let below = area(&cut(&mirrored(&ring), at(-z)).expect("a part"));
        assert!(((above + below) / area(&ring) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn cutting_again_at_the_same_height_changes_nothing() {
    let once = cut(&torus(), plane("z=12.5")).expect("a part");
    assert_eq!(cut(&once, plane("z=12.5")), Ok(once));
}

/// Vertices within [`SNAP`] are moved: areas then differ by about that share.
const MOVED: f64 = 10.0 * SNAP;

proptest! {
    #[test]
    fn a_cut_ball_is_a_disk_wherever_it_is_cut(
        axis in [-1.0..1.0_f64, -1.0..1.0, 0.1..1.0], angle in 0.0..TAU, z in -99.0..99.0_f64,
    ) {
        let ball = turned(&sphere(12, 16), axis, angle);
        let [lo, hi] = ball.bounds().expect("not empty");
        prop_assume!(lo.z + 0.1 < z && z < hi.z - 0.1);
        let above = cut(&ball, at(z)).expect("a cap");
        let topology = require_disk(&above).expect("a disk");
        for v in above.points.ids() {
            prop_assert!(above.points[v].z >= z);
            prop_assert!(!topology.is_border(v) || (above.points[v].z - z).abs() <= 1e-9 * 100.0);
        }
        let below = cut(&mirrored(&ball), at(-z)).expect("the rest");
        prop_assert!(((area(&above) + area(&below)) / area(&ball) - 1.0).abs() < MOVED);
    }

    /// Whole heights put vertices, edges and triangles into the plane in every way.
    #[test]
    fn a_rough_ground_stays_sound_and_whole(heights in proptest::collection::vec(0..5_u8, 42)) {
        let v = |i: usize, j: usize| VertexId::new(7 * i + j);
        let points = (0..42).map(|k| {
            Point3::new((k % 7) as f64, (k / 7) as f64, f64::from(heights[k]))
        });
        let triangles = (0..30).map(|k| (k / 6, k % 6)).flat_map(|(i, j)| {
            let [a, b, c, d] = [v(i, j), v(i, j + 1), v(i + 1, j + 1), v(i + 1, j)];
            [[a, b, c], [a, c, d]]
        });
        let ground = Mesh { points: points.collect(), triangles: triangles.collect() };
        let shadow = |mesh: &Mesh| -> f64 {
            mesh.triangles.ids().map(|f| 0.5 * mesh.area_vector(f).z).sum()
        };
        let flat = ground.triangles.ids().filter(|&f| ground.corners(f).iter().all(|p| p.z == 2.0));
        let mut total = 0.5 * flat.count() as f64;
        for (mesh, z, sign) in [(&ground, 2.0, 1.0), (&mirrored(&ground), -2.0, -1.0)] {
            // A plane that passes by, or touches from outside, leaves nothing.
            let Ok(part) = cut(mesh, at(z)) else { continue };
            loops_and_genus(&part);
            for f in part.triangles.ids() {
                prop_assert!(sign * part.area_vector(f).z > 1e-6);
                prop_assert!(part.corners(f).iter().all(|p| p.z >= z));
            }
            total += sign * shadow(&part);
        }
        prop_assert!((total - 30.0).abs() < 1e-9, "{total}");
    }
}

/// The thinnest triangles come up where the plane just misses vertices.
#[test]
fn a_dome_cut_next_to_its_vertices_still_has_a_chart() {
    let dome = samples::sample("igloo").expect("a sample");
    let [lo, hi] = dome.bounds().expect("not empty");
    let snap = SNAP * (hi - lo).norm();
    let ring = dome.points[VertexId::new(dome.points.len() / 2)].z;
    for beside in [-100.0, -1.1, 0.0, 1.1, 100.0] {
        let above = cut(&dome, at(ring + beside * snap)).expect("a cap");
        let topology = require_chartable(&above).expect("a disk");
        let chart = PlanarChart::new(above, &topology, crate::chart::Method::Abf).expect("a chart");
        assert!(chart.distortion().max_angle < 0.03, "{beside}: {:?}", chart.distortion());
    }
}
