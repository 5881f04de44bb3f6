//! Charts of surfaces with holes, deep pockets and failures.

use super::conformal::abf_or_lscm;
use super::*;
use crate::ids::{Id, VertexId};
use crate::surface::Mesh;
use crate::surface::samples::{grid::revolve, sample};
use crate::surface::topology::Topology;
use std::f64::consts::{FRAC_PI_2, PI};

/// Cells along a side of [`grid`].
const CELLS: usize = 24;

/// A square of 240 × 240 mm in cells of 10 mm, less those whose middle `open` names, each
/// corner lifted to a height.
fn grid(open: impl Fn(f64, f64) -> bool, height: impl Fn(f64, f64) -> f64) -> Mesh {
    let at = |i: usize| 10.0 * i as f64 - 5.0 * CELLS as f64;
    let mut number = vec![None; (CELLS + 1) * (CELLS + 1)];
    let mut mesh = Mesh::default();
    for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
        if open(at(i) + 5.0, at(j) + 5.0) {
            continue;
        }
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
            let (x, y) = (at(i), at(j));
            *number[i * (CELLS + 1) + j]
                .get_or_insert_with(|| mesh.points.push(Point3::new(x, y, height(x, y))))
        });
        mesh.triangles.push([a, b, c]);
        mesh.triangles.push([a, c, d]);
    }
    mesh
}

fn chart_of(mesh: Mesh, method: Method) -> PlanarChart {
    let topology = Topology::new(&mesh).unwrap();
    PlanarChart::new(mesh, &topology, method).unwrap()
}

/// A plate with a pocket deeper than wide in its middle: 60 mm across, 135 mm deep.
fn pocket(edge: f64) -> Mesh {
    let ends = [30.0 * FRAC_PI_2, 90.0, 15.0 * FRAC_PI_2, 60.0];
    revolve(ends.iter().sum(), edge, |s| {
        let mut rest = s;
        let [round, wall, lip, plate] = ends.map(|end| {
            let here = rest.clamp(0.0, end);
            rest -= here;
            here
        });
        let (round, lip) = (round / 30.0, lip / 15.0);
        let radius = 30.0 * round.sin() + 15.0 * (1.0 - lip.cos()) + plate;
        [radius, 30.0 * (1.0 - round.cos()) + wall + 15.0 * lip.sin()]
    })
}

/// A ball of radius 100 mm, open at the bottom by a hole of six edges, so that all of it
/// has to go through there. With slivers, every eighth triangle is cut in three at a
/// vertex where one of the corners is nearly 180°.
fn ball(edge: f64, slivers: bool) -> Mesh {
    let profile = |s: f64| [100.0 * (s / 100.0).sin(), 100.0 * (s / 100.0).cos()];
    let mut mesh = revolve(100.0 * PI - edge / 2.0, edge, profile);
    for f in mesh.triangles.ids().skip(3).step_by(8).filter(|_| slivers) {
        let corners = mesh.triangles[f];
        let [a, b, c] = mesh.corners(f).map(|p| p.coords);
        let middle = mesh.points.push((a * 0.46 + b * 0.46 + c * 0.08).into());
        let [first, second, third] = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3], middle]);
        mesh.triangles[f] = first;
        mesh.triangles.push(second);
        mesh.triangles.push(third);
    }
    mesh
}

fn bits(flat: &[Point2<f64>]) -> Vec<[u64; 2]> {
    flat.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect()
}

/// Whether the chart of a flat sheet is the sheet itself, by all its corners.
fn assert_itself(chart: &PlanarChart) {
    let d = chart.distortion();
    assert!(d.max_angle < 1e-6 && d.scale[1] - d.scale[0] < 1e-6, "{d:?}");
    for (flat, p) in chart.flat().iter().zip(&chart.mesh().points) {
        // Centre and turn follow the surface's own.
        let moved = flat - chart.flat()[0] - (p.xy() - chart.mesh().points[VertexId::new(0)].xy());
        assert!(moved.norm() < 1e-3, "{flat} {p}");
    }
}

/// Area inside closed lines: what holes enclose counts as nothing or is taken off, by the
/// sense in which they run.
fn enclosed(lines: &[Vec<Point2<f64>>]) -> f64 {
    let cross = |line: &Vec<Point2<f64>>, i: usize| {
        line[i].coords.perp(&line[(i + 1) % line.len()].coords) / 2.0
    };
    lines.iter().map(|line| (0..line.len()).map(|i| cross(line, i)).sum::<f64>()).sum()
}

/// Border lines of a sheet with two windows keep the sheet on their left, so that the area
/// that they enclose is that of its triangles.
#[test]
fn the_outline_holds_every_border_and_encloses_the_sheet() {
    let windows = |x: f64, y: f64| y.abs() < 40.0 && (x - 60.0).abs() < 20.0 || x.hypot(y) < 15.0;
    let chart = chart_of(grid(windows, |_, _| 0.0), Method::Abf);
    let mut lines = chart.outline();
    assert_eq!(lines.len(), 3);
    let area: f64 =
        chart.mesh().triangles.ids().map(|f| chart.mesh().area_vector(f).norm() / 2.0).sum();
    assert!((enclosed(&lines) - area).abs() < 1e-3, "{}", enclosed(&lines));
    lines.retain(|line| enclosed(std::slice::from_ref(line)) > 0.0);
    assert_eq!(lines.len(), 1);
}

#[test]
fn a_flat_sheet_with_a_concave_window_maps_to_itself() {
    // Open to the right, its middle lies outside it.
    let window =
        |x: f64, y: f64| x.abs() < 60.0 && y.abs() < 60.0 && !(x > -40.0 && y.abs() < 40.0);
    for method in [Method::Abf, Method::Lscm] {
        let chart = chart_of(grid(window, |_, _| 0.0), method);
        assert_eq!((chart.distortion().method, &chart.distortion().fallback), (method, &None));
        assert_itself(&chart);
        // From the sheet's plane to the chart's.
        let moved = chart.flat()[0] - chart.mesh().points[VertexId::new(0)].xy();
        let p = |x: f64, y: f64| Point2::new(x, y) + moved;
        assert!(chart.lift(p(-50.0, 0.0)).is_none() && chart.lift(p(0.0, 51.0)).is_none());
        assert!(chart.lift(p(0.0, 0.0)).is_some() && chart.lift(p(61.0, 61.0)).is_some());
        let crosses =
            |a: [f64; 2], b: [f64; 2], w| chart.crosses_hole(p(a[0], a[1]), p(b[0], b[1]), w);
        assert!(crosses([-100.0, 0.0], [0.0, 0.0], 0.0), "right through");
        assert!(!crosses([-35.0, 0.0], [100.0, 0.0], 1.0), "between its arms");
        assert!(!crosses([-100.0, 70.0], [100.0, 70.0], 9.0), "along its side");
        assert!(crosses([-100.0, 70.0], [100.0, 70.0], 11.0), "along its side, too wide");
        assert!(crosses([0.0, 50.0], [1.0, 50.0], 0.0), "all inside");
    }
}

#[test]
fn a_flat_ring_maps_to_itself() {
    let ring = |x: f64, y: f64| x.hypot(y) < 70.0;
    let mesh = grid(ring, |_, _| 0.0);
    let topology = Topology::new(&mesh).unwrap();
    let filling = fill(&mesh, &topology);
    assert_eq!(filling.rim.len(), 4 * CELLS);
    assert!(filling.mesh.points.len() > mesh.points.len() + 1, "rings and a tip");
    let area: f64 = filling.mesh.triangles.ids().map(|f| filling.mesh.area_vector(f).z / 2.0).sum();
    let cells = CELLS * CELLS - mesh.triangles.len() / 2;
    assert!((area - 100.0 * cells as f64).abs() < 1e-6, "{area}");
    let up = |f| filling.mesh.area_vector(f).z > 0.0;
    assert!(filling.mesh.triangles.ids().all(up), "no filler lies face down");
    for method in [Method::Abf, Method::Lscm] {
        let chart = chart_of(mesh.clone(), method);
        assert_itself(&chart);
        assert!(chart.crosses_hole(Point2::new(-1.0, 0.0), Point2::new(1.0, 0.0), 0.0));
    }
}

/// Windows let the map relax: it is no worse than that of the whole dome.
#[test]
fn a_dome_with_two_windows_keeps_its_angles() {
    let windows = |x: f64, y: f64| (x.abs() - 50.0).hypot(y) < 25.0;
    let dome = |x: f64, y: f64| (200.0_f64.powi(2) - x * x - y * y).sqrt();
    for method in [Method::Abf, Method::Lscm] {
        let whole = chart_of(grid(|_, _| false, dome), method);
        let chart = chart_of(grid(windows, dome), method);
        let d = chart.distortion();
        assert!(
            d.fallback.is_none() && d.mean_angle < 1.05 * whole.distortion().mean_angle,
            "{d:?}"
        );
        for v in chart.mesh().points.ids() {
            let back = chart.lift(chart.flat()[v.index()]).unwrap();
            assert!((back.position - chart.mesh().points[v]).norm() < 1e-6, "vertex {v}");
        }
        for x in [-50.0, 50.0] {
            let middle = Point2::new(x, 0.0);
            assert!(chart.lift(middle).is_none() && chart.crosses_hole(middle, middle, 0.0));
        }
        let (a, b) = (Point2::new(0.0, -50.0), Point2::new(0.0, 50.0));
        assert!(!chart.crosses_hole(a, b, 5.0), "between the windows");
    }
}

#[test]
fn a_chart_without_holes_crosses_none() {
    let chart = chart_of(sample("flat").unwrap(), Method::Lscm);
    assert!(!chart.crosses_hole(Point2::new(-900.0, 0.0), Point2::new(900.0, 0.0), 100.0));
}

#[test]
fn abf_maps_a_deep_pocket_better_than_lscm() {
    let [abf, lscm] = [Method::Abf, Method::Lscm].map(|method| chart_of(pocket(7.0), method));
    assert!(abf.mesh().triangles.len() > 2000);
    let (a, l) = (abf.distortion(), lscm.distortion());
    assert_eq!((a.method, &a.fallback, l.method), (Method::Abf, &None, Method::Lscm));
    assert!(a.mean_angle <= l.mean_angle, "{a:?} {l:?}");
    assert_eq!(l.steps, 0);
    assert!(a.steps > 1);
}

/// The least sum of squares has angles below zero at the hole.
#[test]
fn a_ball_goes_through_a_hole_of_six_edges() {
    for slivers in [false, true] {
        let mesh = ball(14.0, slivers);
        let topology = Topology::new(&mesh).unwrap();
        let rim = topology.border_loops().concat();
        assert_eq!(rim.len(), 6);
        let sheet = Sheet::new(&mesh, &topology);
        // Not by `conformal`, which refuses maps that fold.
        let lscm = layout(&sheet, &sheet.angles, [rim[0], rim[3]], 100.0).unwrap();
        let lscm = distortion::measure(&mesh, &topology, &sheet.angles, &lscm.into());
        let chart = chart_of(mesh, Method::Abf);
        let d = chart.distortion();
        assert!(d.fallback.is_none() && d.steps < 12, "{d:?}");
        assert!(d.mean_angle < 0.3 * lscm.mean_angle, "{d:?} {lscm:?}");
    }
}

#[test]
fn units_in_a_deep_pocket_are_named_uneven() {
    let chart = chart_of(pocket(10.0), Method::Abf);
    let d = chart.distortion();
    let uneven = d.uneven().unwrap();
    // A flat disk inside the pocket takes up the whole wall: e^(wall / radius) at least.
    assert!(uneven.ratio > 3.0 && uneven.ratio < d.scale[1] / d.scale[0], "{uneven:?}");
    assert!(uneven.large.z < 45.0, "at the bottom: {}", uneven.large);
    assert!((uneven.small.z - 135.0).abs() < 5.0, "on the plate: {}", uneven.small);
    assert_eq!(chart_of(sample("igloo").unwrap(), Method::Abf).distortion().uneven(), None);
    let sentence = Uneven {
        ratio: 4.23,
        small: Point3::new(1.0, 2.2, 3.0),
        large: Point3::new(-4.0, 5.0, 6.0),
    };
    assert_eq!(
        sentence.to_string(),
        "units near (-4, 5, 6) would be 4.2 times larger than those near (1, 2, 3)"
    );
}

#[test]
fn where_abf_does_not_settle_lscm_makes_the_map_and_says_so() {
    let mesh = pocket(10.0);
    let sheet = Sheet::new(&mesh, &Topology::new(&mesh).unwrap());
    let found = abf_or_lscm(&mesh, &sheet, 1).unwrap();
    assert_eq!((found.method, found.steps), (Method::Lscm, 0));
    let why = "ABF++ did not settle in 1 steps, so the map was made by LSCM";
    assert_eq!(found.fallback.as_deref(), Some(why));
    let lscm = conformal(&mesh, &sheet, Method::Lscm).unwrap();
    assert_eq!(bits(&found.flat), bits(&lscm.flat));
}

/// A closed surface has no rim to open at: neither method makes a map of it.
#[test]
fn a_closed_surface_is_refused() {
    let p = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
    let mesh = Mesh {
        points: vec![p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0), p(0.0, 0.0, 1.0)].into(),
        triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
            .map(|t| t.map(VertexId::new))
            .to_vec()
            .into(),
    };
    let topology = Topology::new(&mesh).unwrap();
    for method in [Method::Abf, Method::Lscm] {
        let error = PlanarChart::new(mesh.clone(), &topology, method).unwrap_err();
        assert!(matches!(error, ChartError::Folded { .. }), "{error}");
    }
}

#[test]
fn the_same_surface_has_the_same_chart() {
    for method in [Method::Abf, Method::Lscm] {
        let [a, b] = [(); 2].map(|()| chart_of(pocket(12.0), method));
        assert_eq!(bits(a.flat()), bits(b.flat()));
        assert_eq!(a.distortion(), b.distortion());
    }
}

#[test]
fn methods_have_short_names() {
    let names = [Method::Abf, Method::Lscm].map(|m| serde_json::to_string(&m).unwrap());
    assert_eq!(names, ["\"abf\"", "\"lscm\""]);
    assert_eq!(Method::default(), Method::Abf);
}
