//! Relaxing on charts that are even and on such as are not.

use super::*;
use crate::chart::Method;
use crate::pattern::Pattern;
use crate::surface::Mesh;
use crate::surface::samples::{grid::strip, sample};
use crate::surface::topology::require_chartable;
use crate::tiling::Placement;
use proptest::prelude::*;

fn chart(mesh: Mesh) -> PlanarChart {
    let topology = require_chartable(&mesh).unwrap();
    PlanarChart::new(mesh, &topology, Method::Abf).unwrap()
}

fn named(name: &str) -> PlanarChart {
    chart(sample(name).unwrap())
}

/// A sheet with bumps of these heights, mm, in the middle and at a corner.
fn bumpy([middle, corner]: [f64; 2]) -> PlanarChart {
    let bump = |x: f64, y: f64| (-(x * x + y * y) / 3600.0).exp();
    chart(strip([300.0, 300.0], 12.0, |u, v| {
        let (x, y) = (300.0 * v - 150.0, 300.0 * u - 150.0);
        let height = middle * bump(x, y) + corner * bump(x - 70.0, y - 80.0);
        Point3::new(x, -y, height)
    }))
}

fn canvas<'a>(chart: &'a PlanarChart, name: &str, edge: f64) -> PlaneCanvas<'a, PlanarChart> {
    let pattern = Pattern::named(name).unwrap();
    let placement = Placement { origin: [3.0, -4.0].into(), rotation: 0.3, edge };
    PlaneCanvas::new(chart, pattern, placement, pattern.usual()).unwrap()
}

/// Ratio of the largest to the smallest distance between neighbours.
fn ratio(canvas: &PlaneCanvas<PlanarChart>, tiles: &[TileId]) -> f64 {
    let graph = Graph::new(canvas, tiles);
    let centers = places(canvas, tiles).expect("on the surface");
    let sizes: Vec<f64> = graph.length_errors(&centers, 1.0).iter().map(|e| e + 1.0).collect();
    let [least, most] = [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|pick| sizes.iter().copied().reduce(pick).expect("links"));
    most / least
}

/// Nothing is amiss with a pattern as it is moved: all tiles are woven, and none is folded.
fn is_whole(canvas: &PlaneCanvas<PlanarChart>, tiles: &[TileId]) -> bool {
    crop(canvas, &held(canvas)).len() == tiles.len()
        && faulty(canvas, tiles).is_empty()
        && weave(canvas, tiles).is_ok()
}

#[test]
fn a_plane_stays_as_it_is() {
    let chart = named("flat");
    for name in ["4.4.4.4", "3.4.6.4", "zigzag"] {
        let mut canvas = canvas(&chart, name, 60.0);
        let tiles = woven(&canvas);
        let done = relax(&mut canvas).unwrap();
        assert_eq!((done.steps, done.held_back), (0, 0), "{name}");
        for tile in tiles {
            for offset in [[0.0, 0.0], [0.4, 0.2], [-0.3, 0.5]] {
                let p = canvas.middle(tile) + Vector2::from(offset);
                let (here, plain) =
                    (canvas.place(tile, p), chart.lift(canvas.placement().apply(p)));
                let [here, plain] = [here, plain].map(|on| on.unwrap().position);
                assert!((here - plain).norm() < 1e-9 * 60.0, "{name}: {here} {plain}");
            }
        }
    }
}

/// A vault is rolled without stretching: there is next to nothing to relax.
#[test]
fn a_vault_hardly_moves() {
    let chart = named("vault");
    let mut canvas = canvas(&chart, "6.6.6", 40.0);
    let done = relax(&mut canvas).unwrap();
    assert!(done.length_spread.before.max < 0.05, "{done:?}");
    assert!(done.energy.after <= done.energy.before);
    assert!(done.length_spread.after.max < 0.05, "{done:?}");
}

/// Units over a bump are larger than the others; relaxed, they are less so, and what they
/// lose in shape is little.
#[test]
fn a_stretched_middle_becomes_more_even() {
    let chart = bumpy([60.0, 0.0]);
    for name in ["4.4.4.4", "3.6.3.6", "6.6.6"] {
        let mut canvas = canvas(&chart, name, 16.0);
        let tiles = woven(&canvas);
        let before = ratio(&canvas, &tiles);
        let done = relax(&mut canvas).unwrap();
        let after = ratio(&canvas, &tiles);
        assert!(before > 1.3 && after < before, "{name}: {before} {after}");
        assert!(done.energy.after < 0.75 * done.energy.before, "{name}: {:?}", done.energy);
        let [rms_before, rms_after] = [done.length_spread.before.rms, done.length_spread.after.rms];
        assert!(rms_after < 0.8 * rms_before, "{name}: {rms_before} {rms_after}");
        assert!(done.angle_spread.after.rms < 10.0, "{name}: {:?}", done.angle_spread);
        assert!(is_whole(&canvas, &tiles), "{name}");
    }
}

/// The figures are counted, not made up: as many before as after, one for each link.
#[test]
fn histograms_count_every_link_and_every_angle() {
    let chart = named("igloo");
    let mut canvas = canvas(&chart, "4.4.4.4", 55.0);
    let graph = Graph::new(&canvas, &woven(&canvas));
    let done = relax(&mut canvas).unwrap();
    for (change, count) in [(done.angles, graph.corners.len()), (done.lengths, graph.links.len())] {
        let all = [&change.before, &change.after].map(|h| h.total());
        assert_eq!((all[0], all[1]), (count, count));
        assert!(change.before != change.after);
    }
}

/// Whatever units a pattern has on a surface, it has relaxed.
#[test]
fn no_unit_is_lost_at_the_border() {
    for (surface, edge) in [("igloo", 50.0), ("seashell", 45.0), ("saddle", 60.0)] {
        let chart = named(surface);
        for name in ["4.4.4.4", "3.4.6.4", "4.8.8", "squares-resting", "stars"] {
            let mut canvas = canvas(&chart, name, edge);
            let tiles = woven(&canvas);
            let done = relax(&mut canvas).unwrap();
            assert!(done.energy.after < done.energy.before, "{surface} {name}");
            assert!(is_whole(&canvas, &tiles), "{surface} {name}");
        }
    }
}

#[test]
fn relaxing_twice_gives_the_same() {
    let chart = named("seashell");
    let mut canvas = canvas(&chart, "3.6.3.6", 40.0);
    let tiles = woven(&canvas);
    let (first, places_then) = (relax(&mut canvas).unwrap(), places(&canvas, &tiles));
    let (second, places_now) = (relax(&mut canvas).unwrap(), places(&canvas, &tiles));
    assert!(first == second && places_then == places_now);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    /// Over smooth bumps of any height the plane does not fold, no unit is lost, and the
    /// energy does not grow.
    #[test]
    fn bumps_do_not_fold_the_plane(
        middle in -120.0..120.0f64,
        corner in -70.0..70.0f64,
        kind in 0..5usize,
        edge in 14.0..40.0f64,
    ) {
        let name = ["4.4.4.4", "3.6.3.6", "3.3.3.3.3.3", "6.6.6", "3.4.6.4"][kind];
        let chart = bumpy([middle, corner]);
        let mut canvas = canvas(&chart, name, edge);
        let tiles = woven(&canvas);
        let Some(done) = relax(&mut canvas) else { return Ok(()) };
        prop_assert!(done.energy.after <= done.energy.before);
        prop_assert!(is_whole(&canvas, &tiles));
    }
}
