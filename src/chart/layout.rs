//! Positions in the plane from given triangle angles.
//!
//! Least squares over the whole mesh (ABF++ paper, section 3.2): the angles of a
//! triangle fix its shape, so its third corner is a complex multiple of its first
//! side. With angles that close exactly every triangle gets exactly its shape;
//! with the angles of a curved mesh the result is the least squares conformal
//! map (Lévy, Petitjean, Ray, Maillot 2002).

use super::ChartError;
use crate::ids::{Id, VertexId};
use crate::linalg::{SpdSolver, block_entries};
use nalgebra::{Complex, Point2};

/// Places the vertices so that triangles have the given angles, radians.
///
/// `pins` are two vertices and the distance to put between them; they fix
/// position, turn and size. Triangles come out counter-clockwise.
///
/// # Errors
/// [`ChartError::Linear`] when the mesh is not connected or degenerate.
pub fn layout(
    vertex_count: usize,
    triangles: &[[VertexId; 3]],
    angles: &[[f64; 3]],
    pins: [VertexId; 2],
    distance: f64,
) -> Result<Vec<Point2<f64>>, ChartError> {
    let fixed = [(pins[0].index(), [0.0, 0.0]), (pins[1].index(), [distance, 0.0])];
    let mut unknown = vec![None; vertex_count];
    let mut count = 0;
    for (v, slot) in unknown.iter_mut().enumerate() {
        if fixed.iter().all(|&(pin, _)| pin != v) {
            *slot = Some(count);
            count += 2;
        }
    }
    let rows = |triangle: &[VertexId; 3]| -> [Option<usize>; 6] {
        let first = triangle.map(|v| unknown[v.index()]);
        std::array::from_fn(|k| first[k / 2].map(|row| row + k % 2))
    };
    let mut entries = Vec::with_capacity(21 * triangles.len());
    let mut values = Vec::with_capacity(21 * triangles.len());
    let mut x = vec![0.0; count];
    for (triangle, angles) in triangles.iter().zip(angles) {
        let rows = rows(triangle);
        let equation = shape_equation(angles);
        let at: [f64; 6] = std::array::from_fn(|k| {
            let v = triangle[k / 2].index();
            fixed.iter().find(|(pin, _)| *pin == v).map_or(0.0, |(_, p)| p[k % 2])
        });
        let known: [f64; 2] = std::array::from_fn(|i| (0..6).map(|k| equation[i][k] * at[k]).sum());
        for (row, k) in rows.iter().zip(0..6) {
            if let Some(row) = *row {
                x[row] -= equation[0][k] * known[0] + equation[1][k] * known[1];
            }
        }
        for (i, j) in block_entries(6) {
            if let (Some(row), Some(column)) = (rows[i], rows[j]) {
                entries.push((row, column));
                values.push(equation[0][i] * equation[0][j] + equation[1][i] * equation[1][j]);
            }
        }
    }
    if count > 0 {
        let mut solver = SpdSolver::new(count, &entries)?;
        solver.factor(&values)?;
        solver.solve(&mut x);
    }
    Ok((0..vertex_count)
        .map(|v| match unknown[v] {
            Some(row) => Point2::new(x[row], x[row + 1]),
            None => fixed
                .iter()
                .find(|(pin, _)| *pin == v)
                .map_or_else(Point2::origin, |(_, p)| Point2::new(p[0], p[1])),
        })
        .collect())
}

/// The two real rows over (x₀, y₀, x₁, y₁, x₂, y₂) that vanish when the corners
/// have the given angles: sin α₁ … written without division, so that slivers
/// weigh as little as their area.
fn shape_equation(angles: &[f64; 3]) -> [[f64; 6]; 2] {
    // (z₂ − z₀) sin α₂ = (z₁ − z₀) sin α₁ e^{iα₀}
    let [s1, s2] = [angles[1].sin(), angles[2].sin()];
    let turn = Complex::from_polar(s1, angles[0]);
    let c = [turn - s2, -turn, Complex::new(s2, 0.0)];
    let mut rows = [[0.0; 6]; 2];
    for (k, c) in c.iter().enumerate() {
        rows[0][2 * k] = c.re;
        rows[0][2 * k + 1] = -c.im;
        rows[1][2 * k] = c.im;
        rows[1][2 * k + 1] = c.re;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_two_triangles_comes_back() {
        use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
        let v = VertexId::new;
        let triangles = [[v(0), v(1), v(2)], [v(0), v(2), v(3)]];
        let angles = [[FRAC_PI_4, FRAC_PI_2, FRAC_PI_4], [FRAC_PI_4, FRAC_PI_4, FRAC_PI_2]];
        let p = layout(4, &triangles, &angles, [v(0), v(1)], 2.0).unwrap();
        let wanted = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        for (p, (x, y)) in p.iter().zip(wanted) {
            assert!((p.x - x).abs() < 1e-12 && (p.y - y).abs() < 1e-12, "{p}");
        }
    }
}
