//! The convex outline of points in the plane.

/// The corners of the convex outline, counter-clockwise where y points up, without those
/// that lie on a straight side (Andrew's monotone chain). Fewer than three where all points
/// lie on a line.
pub fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if turn(a, b, p) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

/// How far a point lies inside a convex outline, mm; outside it is negative, and then no more
/// than the distance from its longest side's line. Of fewer than three corners there is no inside.
pub fn depth_in(hull: &[[f64; 2]], p: [f64; 2]) -> f64 {
    if hull.len() < 3 {
        return f64::NEG_INFINITY;
    }
    let sides = (0..hull.len()).map(|i| (hull[i], hull[(i + 1) % hull.len()]));
    let depth = |(a, b): ([f64; 2], [f64; 2])| turn(a, b, p) / (b[0] - a[0]).hypot(b[1] - a[1]);
    sides.map(depth).fold(f64::INFINITY, f64::min)
}

/// Twice the area of a triangle, positive where it runs counter-clockwise.
fn turn(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn inner_points_and_points_on_sides_are_no_corners() {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
        assert_eq!(convex_hull(points), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert_eq!(convex_hull(vec![[1.0, 1.0], [0.0, 0.0], [2.0, 2.0]]).len(), 2);
        assert_eq!(convex_hull(vec![[1.0, 1.0]; 3]), [[1.0, 1.0]]);
    }

    #[test]
    fn depths_are_distances_from_the_sides() {
        let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        assert_eq!(depth_in(&square, [1.0, 2.0]), 1.0);
        assert_eq!(depth_in(&square, [2.0, 5.0]), -1.0);
        assert_eq!(depth_in(&square[..2], [2.0, 0.0]), f64::NEG_INFINITY);
    }

    proptest! {
        #[test]
        fn all_points_lie_inside(
            points in proptest::collection::vec(proptest::array::uniform2(-9.0..9.0_f64), 3..30),
        ) {
            let hull = convex_hull(points.clone());
            prop_assume!(hull.len() > 2);
            for p in points {
                prop_assert!(depth_in(&hull, p) > -1e-9);
            }
        }
    }
}
