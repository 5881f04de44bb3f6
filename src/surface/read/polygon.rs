//! Cuts a flat or nearly flat polygon into triangles on its own corners.
//!
//! Ears are clipped (Meisters 1975) on the plane of the polygon's area vector (Newell),
//! always the best-shaped ear first: so collinear corners do not end in triangles
//! without area, which would leave slits beside the neighbours. A quadrilateral is the
//! same thing: of its two diagonals the better is taken.

use crate::ids::VertexId;
use crate::surface::locate::segments_cross;
use crate::surface::{Point3, Vector3};
use nalgebra::{Point2, Vector2};

/// Why a polygon was not cut.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::surface) enum Uncut {
    /// Its outline crosses or touches itself.
    Crossed,
    /// More corners than [`MOST_CORNERS`].
    TooMany,
}

/// Most corners of a polygon. Clipping may take the cube of their number; a face with
/// more is an outline rather than a part of a surface.
pub(in crate::surface) const MOST_CORNERS: usize = 500;

/// Triangles of a polygon as positions in `corners`, none of them new. A polygon
/// without area gives triangles without area.
pub(in crate::surface) fn triangulate(corners: &[Point3]) -> Result<Vec<[usize; 3]>, Uncut> {
    match corners.len() {
        0..3 => return Ok(Vec::new()),
        3 => return Ok(vec![[0, 1, 2]]),
        n if n > MOST_CORNERS => return Err(Uncut::TooMany),
        _ => {}
    }
    let Some(flat) = flatten(corners) else {
        let fan: Vec<_> = (2..corners.len()).map(|k| [0, k - 1, k]).collect();
        let area = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|k| corners[k]);
            (b - a).cross(&(c - a)).norm()
        };
        // Parts with area that cancel out, as in a figure of eight.
        let crossed = fan.iter().any(|t| area(t) > 0.0);
        return if crossed { Err(Uncut::Crossed) } else { Ok(fan) };
    };
    if crosses_itself(&flat) {
        return Err(Uncut::Crossed);
    }
    let mut ring: Vec<usize> = (0..corners.len()).collect();
    let mut qualities: Vec<f64> = (0..ring.len()).map(|i| ear(&flat, &ring, i)).collect();
    let mut triangles = Vec::with_capacity(corners.len() - 2);
    while ring.len() > 3 {
        let best = (0..ring.len()).fold(0, |b, i| if qualities[i] > qualities[b] { i } else { b });
        if qualities[best] <= 0.0 {
            return Err(Uncut::Crossed);
        }
        triangles.push(around(&ring, best));
        ring.remove(best);
        qualities.remove(best);
        // A blocked corner may become free anywhere when a corner goes: those without
        // an ear are tried again, besides the two that were beside it.
        let n = ring.len();
        let beside = [(best + n - 1) % n, best % n];
        for (i, quality) in qualities.iter_mut().enumerate() {
            if beside.contains(&i) || *quality == BLOCKED {
                *quality = ear(&flat, &ring, i);
            }
        }
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    Ok(triangles)
}

/// Takes out corners that repeat the one before, and spikes that go to a corner and
/// straight back, round the end too. Fewer than three corners may be left.
pub(in crate::surface) fn tidy(face: &mut Vec<VertexId>) {
    // What stays, `face[..kept]`, never ends in a repeat or a spike.
    let mut kept = 0;
    for i in 0..face.len() {
        let corner = face[i];
        match kept {
            1.. if face[kept - 1] == corner => {}
            2.. if face[kept - 2] == corner => kept -= 1,
            _ => {
                face[kept] = corner;
                kept += 1;
            }
        }
    }
    let mut start = 0;
    while kept - start > 1 {
        let (first, last) = (face[start], face[kept - 1]);
        if first == last || (kept - start > 2 && face[kept - 2] == first) {
            kept -= 1;
        } else if kept - start > 2 && face[start + 1] == last {
            start += 1;
        } else {
            break;
        }
    }
    face.truncate(kept);
    face.drain(..start);
}

/// The polygon in its own plane, counter-clockwise; `None` if it has no area.
fn flatten(corners: &[Point3]) -> Option<Vec<Point2<f64>>> {
    let next = |i: usize| corners[(i + 1) % corners.len()] - corners[0];
    let area: Vector3 = (0..corners.len()).map(|i| (corners[i] - corners[0]).cross(&next(i))).sum();
    let normal = area.try_normalize(0.0)?;
    // The axis least along the normal makes a stable first direction.
    let mut axis = Vector3::zeros();
    axis[normal.iamin()] = 1.0;
    let x = normal.cross(&axis).try_normalize(0.0)?;
    let y = normal.cross(&x);
    let flat = |p: &Point3| Point2::new((p - corners[0]).dot(&x), (p - corners[0]).dot(&y));
    Some(corners.iter().map(flat).collect())
}

/// Whether two sides cross at inner points of both. Touching is left to the clipping.
fn crosses_itself(flat: &[Point2<f64>]) -> bool {
    let n = flat.len();
    let side = |i: usize| [flat[i], flat[(i + 1) % n]];
    (0..n).any(|i| (i + 2..n).any(|j| segments_cross(side(i), side(j))))
}

fn around(ring: &[usize], i: usize) -> [usize; 3] {
    let n = ring.len();
    [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]]
}

/// Quality of a convex corner with another corner inside its triangle.
const BLOCKED: f64 = 0.0;

/// Quality of a corner that turns inward or not at all.
const NO_EAR: f64 = -1.0;

/// Area against squared lengths of the triangle at corner `i` (√3/6 when equilateral),
/// or [`BLOCKED`] or [`NO_EAR`].
fn ear(flat: &[Point2<f64>], ring: &[usize], i: usize) -> f64 {
    let corner = around(ring, i);
    let [a, b, c] = corner.map(|k| flat[k]);
    let turn = (b - a).perp(&(c - b));
    let lengths = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    let quality = turn / lengths;
    // Collinear within rounding counts as not turning.
    if quality.is_nan() || quality <= 1e-12 {
        return NO_EAR;
    }
    let side = |p: Point2<f64>, d: Vector2<f64>, q: &Point2<f64>| d.perp(&(q - p)) >= 0.0;
    let inside = |q: &Point2<f64>| side(a, b - a, q) && side(b, c - b, q) && side(c, a - c, q);
    // A corner visited twice (a slit to a hole) lies on this one without blocking it.
    let blocks =
        |&&k: &&usize| !corner.contains(&k) && ![a, b, c].contains(&flat[k]) && inside(&flat[k]);
    if ring.iter().find(blocks).is_some() { BLOCKED } else { quality }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn lift(flat: &[[f64; 2]]) -> Vec<Point3> {
        // On a slope, so that the plane is found and not taken for granted.
        flat.iter().map(|[x, y]| Point3::new(*x, *y, 0.5 * x - 0.25 * y)).collect()
    }

    fn signed_areas(flat: &[[f64; 2]], triangles: &[[usize; 3]]) -> Vec<f64> {
        let area = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|k| Point2::from(flat[k]));
            0.5 * (b - a).perp(&(c - a))
        };
        triangles.iter().map(area).collect()
    }

    #[test]
    fn repeats_and_spikes_go_round_the_end_too() {
        let cases: [(&[usize], &[usize]); 9] = [
            (&[0, 1, 2], &[0, 1, 2]),
            (&[0, 1, 1, 2, 2, 0], &[0, 1, 2]),
            (&[0, 1, 9, 1, 2], &[0, 1, 2]),
            (&[9, 0, 1, 2, 0], &[0, 1, 2]),
            (&[0, 1, 2, 0, 9], &[0, 1, 2]),
            (&[1, 2, 3, 0, 3], &[1, 2, 3]),
            (&[0, 1, 2, 1], &[0, 1]),
            (&[5, 5, 5], &[5]),
            (&[0, 1, 2, 3, 2, 1], &[0, 1]),
        ];
        for (corners, expected) in cases {
            let mut face: Vec<_> = corners.iter().map(|&i| VertexId::new(i)).collect();
            tidy(&mut face);
            let first = (0..face.len()).min_by_key(|&k| face[k]).unwrap_or(0);
            face.rotate_left(first);
            let left: Vec<_> = face.iter().map(|v| v.index()).collect();
            assert_eq!(left, expected, "{corners:?}");
        }
    }

    #[test]
    fn a_concave_polygon_is_covered_once() {
        let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let areas = signed_areas(&l, &triangulate(&lift(&l)).expect("simple"));
        assert_eq!(areas.len(), 4);
        assert!(areas.iter().all(|a| *a > 0.0));
        assert!((areas.iter().sum::<f64>() - 5.0).abs() < 1e-12);
    }

    #[test]
    fn corners_on_a_straight_side_do_not_make_flat_triangles() {
        let p = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]];
        let areas = signed_areas(&p, &triangulate(&lift(&p)).expect("simple"));
        assert!(areas.iter().all(|a| *a > 0.1), "{areas:?}");
    }

    #[test]
    fn a_quadrilateral_is_cut_along_the_diagonal_inside() {
        let arrow = [[0.0, 0.0], [2.0, 2.0], [0.0, 1.0], [-2.0, 2.0]];
        let cut = triangulate(&lift(&arrow)).expect("simple");
        assert!(cut.iter().all(|t| t.contains(&0) && t.contains(&2)), "{cut:?}");
    }

    #[test]
    fn a_crossed_outline_is_refused() {
        let star: Vec<_> = (0..5).map(|i| (TAU * 0.4 * f64::from(i)).sin_cos().into()).collect();
        assert_eq!(triangulate(&lift(&star)), Err(Uncut::Crossed));
    }

    #[test]
    fn a_polygon_of_too_many_corners_is_refused() {
        assert_eq!(triangulate(&[Point3::origin(); MOST_CORNERS + 1]), Err(Uncut::TooMany));
    }

    proptest! {
        #[test]
        fn a_star_shaped_polygon_is_covered_once(radii in proptest::collection::vec(0.2..2.0_f64, 4..40)) {
            let n = radii.len() as f64;
            let polygon: Vec<[f64; 2]> = radii
                .iter()
                .enumerate()
                .map(|(i, r)| {
                    let (sin, cos) = (TAU * i as f64 / n).sin_cos();
                    [r * cos, r * sin]
                })
                .collect();
            let areas = signed_areas(&polygon, &triangulate(&lift(&polygon)).expect("simple"));
            prop_assert_eq!(areas.len(), polygon.len() - 2);
            prop_assert!(areas.iter().all(|a| *a > -1e-12));
            let whole: f64 = (0..polygon.len())
                .map(|i| Point2::from(polygon[i]).coords
                    .perp(&Point2::from(polygon[(i + 1) % polygon.len()]).coords) / 2.0)
                .sum();
            prop_assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9);
        }

        #[test]
        fn any_corners_give_an_answer(corners in proptest::collection::vec([-2_i32..2, -2..2, -2..2], 0..12)) {
            let corners: Vec<_> = corners.iter().map(|c| Point3::from(c.map(f64::from))).collect();
            let _ = triangulate(&corners);
        }
    }
}
