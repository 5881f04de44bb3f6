//! Positions in the plane from given triangle angles.
//!
//! Least squares over the whole mesh (ABF++ paper, section 3.2): the angles of a
//! triangle fix its shape, so its third corner is a complex multiple of its first
//! side. With angles that close exactly every triangle gets exactly its shape;
//! with the angles of a curved mesh the result is the least squares conformal
//! map (Lévy, Petitjean, Ray, Maillot 2002).

use super::ChartError;
use super::sheet::Sheet;
use crate::ids::{Id, VertexId};
use crate::linalg::{Cholesky, LowerPattern};
use nalgebra::{Complex, Point2};

/// Places the vertices of a sheet so that its triangles have the given angles, radians.
///
/// `pins` are two vertices and `distance` the distance to put between them; they fix
/// position, turn and size. Triangles come out counter-clockwise.
///
/// # Errors
/// [`ChartError::Linear`] when the sheet is not connected or degenerate.
pub fn layout(
    sheet: &Sheet,
    angles: &[[f64; 3]],
    pins: [VertexId; 2],
    distance: f64,
) -> Result<Vec<Point2<f64>>, ChartError> {
    let [zero, one] = pins.map(Id::index);
    let mut flat = vec![Complex::from(0.0); sheet.rim.len()];
    flat[one] = distance.into();
    // The unknowns are the other vertices, in order.
    let unknown = |v: VertexId| {
        let v = v.index();
        let pins_before = usize::from(v > zero) + usize::from(v > one && one != zero);
        (v != zero && v != one).then(|| v - pins_before)
    };
    let count = flat.len() - if zero == one { 1 } else { 2 };
    let pairs = sheet.triangles.iter().flat_map(|t| {
        let corners = t.map(unknown);
        (0..3).filter_map(move |k| corners[k].zip(corners[(k + 1) % 3]))
    });
    let pattern = LowerPattern::new(count, pairs)?;
    let mut values = vec![Complex::from(0.0); pattern.entries()];
    let mut x = vec![Complex::from(0.0); count];
    for (t, (triangle, angles)) in sheet.triangles.iter().zip(angles).enumerate() {
        let weight = if t < sheet.real { 1.0 } else { FILLER_WEIGHT };
        let equation = shape_equation(angles);
        for (v, c) in triangle.iter().zip(equation) {
            let Some(row) = unknown(*v) else { continue };
            for (v, d) in triangle.iter().zip(equation) {
                let value = c.conj() * d * weight;
                match unknown(*v) {
                    Some(column) if column <= row => values[pattern.position(row, column)] += value,
                    Some(_) => {}
                    None => x[row] -= value * flat[v.index()],
                }
            }
        }
    }
    if count > 0 {
        let mut solver = Cholesky::new(pattern)?;
        solver.factor(&values)?;
        solver.solve(&mut x);
    }
    for (v, z) in flat.iter_mut().enumerate() {
        if let Some(row) = unknown(VertexId::new(v)) {
            *z = x[row];
        }
    }
    Ok(flat.iter().map(|z| Point2::new(z.re, z.im)).collect())
}

/// Weight of the triangles that fill a hole, against 1 of the surface's own: larger,
/// and holes stiffen the surface; smaller, and rounding tells in the system.
const FILLER_WEIGHT: f64 = 1e-3;

/// The complex factors of the three corners whose sum vanishes when the corners have
/// the given angles. The common factor makes the sum of squares the energy of Lévy and
/// others, which does not depend on how the surface is divided into triangles.
fn shape_equation(angles: &[f64; 3]) -> [Complex<f64>; 3] {
    // (z₂ − z₀) sin α₂ = (z₁ − z₀) sin α₁ e^{iα₀}
    let [s0, s1, s2] = angles.map(f64::sin);
    let turn = Complex::from_polar(s1, angles[0]);
    let scale = (s0 * s1 * s2).max(LEAST_SHAPE).sqrt().recip();
    [turn - s2, -turn, Complex::from(s2)].map(|c| c * scale)
}

/// Least product of the three sines, so that the weight of a needle stays finite:
/// larger, and needles lose their shape; smaller, and rounding tells in the system.
const LEAST_SHAPE: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_two_triangles_comes_back() {
        use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
        let v = VertexId::new;
        let triangles = [[v(0), v(1), v(2)], [v(0), v(2), v(3)]];
        let angles = [[FRAC_PI_4, FRAC_PI_2, FRAC_PI_4], [FRAC_PI_4, FRAC_PI_4, FRAC_PI_2]];
        let sheet = Sheet {
            triangles: triangles.into(),
            real: 2,
            angles: angles.into(),
            rim: vec![true; 4],
        };
        let p = layout(&sheet, &angles, [v(0), v(1)], 2.0).unwrap();
        let wanted = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        for (p, (x, y)) in p.iter().zip(wanted) {
            assert!((p.x - x).abs() < 1e-12 && (p.y - y).abs() < 1e-12, "{p}");
        }
    }
}
