//! How regular the inner polygons of the units are (paper, Fig. 12 and 14).

use crate::surface::Point3;
use std::f64::consts::PI;

/// How far polygons are from regular ones, one figure a corner and one a side.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Regularity {
    /// Each angle less that of a regular polygon, degrees.
    pub angles: Vec<f64>,
    /// Each side less the mean side of its polygon, as part of that mean.
    pub sides: Vec<f64>,
}

/// Measures polygons, each given by its corners in order; those of fewer than three are
/// passed over.
pub fn regularity(polygons: impl IntoIterator<Item = Vec<Point3>>) -> Regularity {
    let mut found = Regularity::default();
    for corners in polygons {
        let n = corners.len();
        if n < 3 {
            continue;
        }
        let corner = |i: usize| corners[i % n];
        let regular = PI - 2.0 * PI / n as f64;
        let lengths: Vec<f64> = (0..n).map(|i| (corner(i + 1) - corner(i)).norm()).collect();
        let mean = lengths.iter().sum::<f64>() / n as f64;
        found.sides.extend(lengths.iter().map(|length| length / mean - 1.0));
        found.angles.extend((0..n).map(|i| {
            let (back, ahead) = (corner(i) - corner(i + 1), corner(i + 2) - corner(i + 1));
            (back.angle(&ahead) - regular).to_degrees()
        }));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn regular_polygons_of_any_size_are_regular() {
        for n in 3..9 {
            let corner = |i: usize| {
                let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
                Point3::new(7.0 * cos, 4.0, 7.0 * sin)
            };
            let found = regularity([(0..n).map(corner).collect()]);
            assert_eq!((found.angles.len(), found.sides.len()), (n, n));
            assert!(found.angles.iter().chain(&found.sides).all(|x| x.abs() < 1e-12));
        }
    }

    #[test]
    fn a_rectangle_is_off_in_its_sides_and_a_rhombus_in_its_angles() {
        let at = |x: f64, y: f64| Point3::new(x, y, 1.0);
        let rectangle = vec![at(0.0, 0.0), at(3.0, 0.0), at(3.0, 1.0), at(0.0, 1.0)];
        let (sin, cos) = 60f64.to_radians().sin_cos();
        let rhombus = vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0 + cos, sin), at(cos, sin)];
        let near = |found: &[f64], wanted: [f64; 4]| {
            found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        let found = regularity([rectangle, Vec::new()]);
        assert!(near(&found.sides, [0.5, -0.5, 0.5, -0.5]) && near(&found.angles, [0.0; 4]));
        let found = regularity([rhombus]);
        assert!(near(&found.sides, [0.0; 4]));
        assert!(near(&found.angles, [30.0, -30.0, 30.0, -30.0]), "{:?}", found.angles);
    }
}
