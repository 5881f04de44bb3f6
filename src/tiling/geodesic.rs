//! Geodesic frequency: every edge of a polyhedron of triangles or squares is cut into f
//! parts, every face into f² smaller ones (class I; Kenner, *Geodesic Math and How to
//! Use It*, 1976).

use super::polyhedron::Polyhedron;
use crate::surface::Vector3;
use std::collections::BTreeMap;

/// A point as whole-number weights of corners: the same for all faces that share it.
type Weights = Vec<(usize, usize)>;

/// Divides the faces of a polyhedron, all triangles or all squares, and moves the new
/// vertices out to the unit sphere. `None` where a face has more corners.
pub fn divide(p: &Polyhedron, frequency: usize) -> Option<Polyhedron> {
    let mut grid = Grid { p, vertices: BTreeMap::new(), places: Vec::new() };
    let mut faces = Vec::new();
    for face in &p.faces {
        match face[..] {
            [a, b, c] => triangles(&mut grid, [a, b, c], frequency, &mut faces),
            [a, b, c, d] => squares(&mut grid, [a, b, c, d], frequency, &mut faces),
            _ => return None,
        }
    }
    Some(Polyhedron { vertices: grid.places, faces })
}

struct Grid<'a> {
    p: &'a Polyhedron,
    vertices: BTreeMap<Weights, usize>,
    places: Vec<Vector3>,
}

impl Grid<'_> {
    fn vertex(&mut self, weights: impl IntoIterator<Item = (usize, usize)>) -> usize {
        let mut key: Weights = weights.into_iter().filter(|&(_, weight)| weight > 0).collect();
        key.sort_unstable();
        let sum: Vector3 = key.iter().map(|&(v, weight)| self.p.vertices[v] * weight as f64).sum();
        *self.vertices.entry(key).or_insert_with(|| {
            self.places.push(sum.normalize());
            self.places.len() - 1
        })
    }
}

fn triangles(grid: &mut Grid, [a, b, c]: [usize; 3], f: usize, faces: &mut Vec<Vec<usize>>) {
    let mut at = |i: usize, j: usize| grid.vertex([(a, f - i - j), (b, i), (c, j)]);
    for j in 0..f {
        for i in 0..f - j {
            faces.push(vec![at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j + 2 <= f {
                faces.push(vec![at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
}

fn squares(grid: &mut Grid, [a, b, c, d]: [usize; 4], f: usize, faces: &mut Vec<Vec<usize>>) {
    let mut at = |i: usize, j: usize| {
        grid.vertex([(a, (f - i) * (f - j)), (b, i * (f - j)), (c, i * j), (d, (f - i) * j)])
    };
    for j in 0..f {
        for i in 0..f {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tiling::polyhedron::Seed;

    #[test]
    fn faces_grow_with_the_square_of_the_frequency_and_stay_joined() {
        for seed in [Seed::Tetrahedron, Seed::Octahedron, Seed::Icosahedron, Seed::Cube] {
            let p = seed.polyhedron();
            for f in 1..=5 {
                let divided = divide(&p, f).expect("triangles or squares");
                assert_eq!(divided.faces.len(), p.faces.len() * f * f);
                let net = divided.net();
                assert!(net.edges.iter().all(|e| e.right.is_some()), "{seed:?} {f}");
                // Euler: V − E + F = 2.
                assert_eq!(divided.vertices.len() + net.tiles.len(), net.edges.len() + 2);
            }
        }
        assert_eq!(divide(&Seed::Dodecahedron.polyhedron(), 2), None);
    }

    #[test]
    fn frequency_one_changes_nothing() {
        let p = Seed::Octahedron.polyhedron();
        assert_eq!(divide(&p, 1).expect("triangles").faces.len(), 8);
    }
}
