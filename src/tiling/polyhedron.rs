//! Closed polyhedra: the five seeds, and the operators of Conway on them.
//!
//! Only who borders on whom matters here; places are rough and are made exact by
//! [`midsphere`](super::midsphere). Operators after J. H. Conway, H. Burgiel,
//! C. Goodman-Strauss, *The Symmetries of Things*, chapter 21; dual, ambo, kis and gyro
//! are built, the others are made of them.

use super::Net;
use crate::surface::Vector3;
use std::collections::BTreeMap;

/// A closed polyhedron about the origin.
#[derive(Clone, PartialEq, Debug)]
pub struct Polyhedron {
    /// Its vertices.
    pub vertices: Vec<Vector3>,
    /// Its faces, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// The five regular polyhedra, by the letters of Conway's notation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Seed {
    /// T, four triangles.
    Tetrahedron,
    /// O, eight triangles.
    Octahedron,
    /// C, six squares.
    Cube,
    /// I, twenty triangles.
    Icosahedron,
    /// D, twelve pentagons.
    Dodecahedron,
}

impl Seed {
    /// The polyhedron: I and O on a vertex, T, C and D on a face, so that a face of T
    /// lies below and one of C and D on top.
    pub fn polyhedron(self) -> Polyhedron {
        match self {
            Self::Tetrahedron => antiprism_like(&[(1.0, 1), (-1.0 / 3.0, 3)]),
            Self::Octahedron => antiprism_like(&[(1.0, 1), (0.0, 4), (-1.0, 1)]),
            Self::Icosahedron => {
                let z = 1.0 / 5f64.sqrt();
                antiprism_like(&[(1.0, 1), (z, 5), (-z, 5), (-1.0, 1)])
            }
            Self::Cube => Self::Octahedron.polyhedron().dual(),
            Self::Dodecahedron => Self::Icosahedron.polyhedron().dual(),
        }
    }
}

/// Rings of points on the unit sphere, from top to bottom, as heights and numbers of
/// points, with triangles between neighbouring rings. Rings of equal numbers are turned
/// by half a step.
fn antiprism_like(rings: &[(f64, usize)]) -> Polyhedron {
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    let mut above: Vec<usize> = Vec::new();
    let mut turned = false;
    for &(z, count) in rings {
        turned ^= above.len() == count;
        let shift = if turned { 0.5 } else { 0.0 };
        let first = vertices.len();
        for k in 0..count {
            let angle = std::f64::consts::TAU * (k as f64 + shift) / count as f64;
            let radius = (1.0 - z * z).max(0.0).sqrt();
            vertices.push(Vector3::new(radius * angle.cos(), radius * angle.sin(), z));
        }
        let ring: Vec<usize> = (first..first + count).collect();
        let (a, b) = (above.len(), count);
        match (a, b) {
            (0, _) => {}
            (1, _) => faces.extend((0..b).map(|k| vec![above[0], ring[k], ring[(k + 1) % b]])),
            (_, 1) => faces.extend((0..a).map(|k| vec![ring[0], above[(k + 1) % a], above[k]])),
            _ => faces.extend((0..a).flat_map(|k| {
                let next = (k + 1) % a;
                [vec![above[k], ring[k], above[next]], vec![above[next], ring[k], ring[next]]]
            })),
        }
        above = ring;
    }
    if above.len() > 2 {
        faces.push(above.into_iter().rev().collect());
    }
    Polyhedron { vertices, faces }
}

impl Polyhedron {
    /// Which face borders on which.
    pub fn net(&self) -> Net {
        Net::new(self.faces.iter().cloned())
    }

    /// d: a vertex for each face, a face for each vertex.
    pub fn dual(&self) -> Self {
        let vertices = self.faces.iter().map(|f| self.middle(f)).collect();
        let faces = self.fans().into_iter().map(|fan| fan.iter().map(|s| s.face).collect());
        Self { vertices, faces: faces.collect() }
    }

    /// a: a vertex on each edge, a face for each face and each vertex.
    pub fn ambo(&self) -> Self {
        let mut edges: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut vertices = Vec::new();
        let mut on = |a: usize, b: usize| {
            *edges.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                vertices.push((self.vertices[a] + self.vertices[b]).normalize());
                vertices.len() - 1
            })
        };
        let mut faces = Vec::new();
        for face in &self.faces {
            faces.push(sides(face).map(|[a, b]| on(a, b)).collect());
        }
        for (vertex, fan) in self.fans().iter().enumerate() {
            faces.push(fan.iter().map(|s| on(vertex, s.next)).collect());
        }
        Self { vertices, faces }
    }

    /// k: a pyramid on each face, or on those of `sides` corners.
    pub fn kis(&self, sides_wanted: Option<usize>) -> Self {
        let mut vertices = self.vertices.clone();
        let mut faces = Vec::new();
        for face in &self.faces {
            if sides_wanted.is_some_and(|n| n != face.len()) {
                faces.push(face.clone());
                continue;
            }
            vertices.push(self.middle(face));
            let tip = vertices.len() - 1;
            faces.extend(sides(face).map(|[a, b]| vec![a, b, tip]));
        }
        Self { vertices, faces }
    }

    /// g: each face of n corners falls into n pentagons, all turned one way.
    pub fn gyro(&self) -> Self {
        let mut vertices = self.vertices.clone();
        let mut thirds: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut faces = Vec::new();
        // The point on the edge from a to b that is nearer to a.
        let mut near = |vertices: &mut Vec<Vector3>, a: usize, b: usize| {
            *thirds.entry([a, b]).or_insert_with(|| {
                vertices.push((self.vertices[a] * 2.0 + self.vertices[b]).normalize());
                vertices.len() - 1
            })
        };
        for face in &self.faces {
            vertices.push(self.middle(face));
            let middle = vertices.len() - 1;
            let n = face.len();
            for i in 0..n {
                let [a, b, c] = [0, 1, 2].map(|k| face[(i + k) % n]);
                let [ab, ba, bc] = [(a, b), (b, a), (b, c)].map(|(p, q)| near(&mut vertices, p, q));
                faces.push(vec![middle, ab, ba, b, bc]);
            }
        }
        Self { vertices, faces }
    }

    fn middle(&self, face: &[usize]) -> Vector3 {
        face.iter().map(|&v| self.vertices[v]).sum::<Vector3>().normalize()
    }

    /// The faces round each vertex, counter-clockwise.
    fn fans(&self) -> Vec<Vec<Spoke>> {
        // By the edge that leaves the vertex: the face on its left, and the vertex
        // before, to which the next face's edge leaves.
        let mut leaving: BTreeMap<[usize; 2], (usize, usize)> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            for i in 0..n {
                leaving.insert([face[i], face[(i + 1) % n]], (f, face[(i + n - 1) % n]));
            }
        }
        let mut fans = vec![Vec::new(); self.vertices.len()];
        for (vertex, fan) in fans.iter_mut().enumerate() {
            let first = leaving.range([vertex, 0]..=[vertex, usize::MAX]).next();
            let Some((&[_, start], _)) = first else { continue };
            let mut next = start;
            loop {
                let (face, before) = leaving[&[vertex, next]];
                fan.push(Spoke { face, next });
                next = before;
                if next == start {
                    break;
                }
            }
        }
        fans
    }
}

/// A face at a vertex, and the vertex at the end of the edge where it begins.
#[derive(Clone, Copy)]
struct Spoke {
    face: usize,
    next: usize,
}

fn sides(face: &[usize]) -> impl Iterator<Item = [usize; 2]> + '_ {
    (0..face.len()).map(|i| [face[i], face[(i + 1) % face.len()]])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEEDS: [(Seed, [usize; 3]); 5] = [
        (Seed::Tetrahedron, [4, 6, 4]),
        (Seed::Octahedron, [6, 12, 8]),
        (Seed::Cube, [8, 12, 6]),
        (Seed::Icosahedron, [12, 30, 20]),
        (Seed::Dodecahedron, [20, 30, 12]),
    ];

    fn counts(p: &Polyhedron) -> [usize; 3] {
        [p.vertices.len(), p.net().edges.len(), p.faces.len()]
    }

    fn faces_outward(p: &Polyhedron) -> bool {
        p.faces.iter().all(|f| {
            let middle = p.middle(f);
            let area: Vector3 = sides(f)
                .map(|[a, b]| (p.vertices[a] - middle).cross(&(p.vertices[b] - middle)))
                .sum();
            area.dot(&middle) > 0.0
        })
    }

    fn closed(p: &Polyhedron) -> bool {
        let net = p.net();
        net.edges.iter().all(|e| e.right.is_some())
    }

    #[test]
    fn seeds_are_regular() {
        for (seed, wanted) in SEEDS {
            let p = seed.polyhedron();
            assert_eq!(counts(&p), wanted, "{seed:?}");
            assert!(closed(&p) && faces_outward(&p), "{seed:?}");
            let lengths: Vec<f64> = p
                .faces
                .iter()
                .flat_map(|f| sides(f).map(|[a, b]| (p.vertices[a] - p.vertices[b]).norm()))
                .collect();
            assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-12), "{seed:?}");
        }
    }

    /// Counts of vertices, edges and faces under each operator, from those of the seed.
    #[test]
    fn operators_count_as_they_should() {
        for (seed, [v, e, f]) in SEEDS {
            let p = seed.polyhedron();
            let cases = [
                (p.dual(), [f, e, v]),
                (p.ambo(), [e, 2 * e, f + v]),
                (p.kis(None), [v + f, 3 * e, 2 * e]),
                (p.gyro(), [v + f + 2 * e, 5 * e, 2 * e]),
            ];
            for (made, wanted) in cases {
                assert_eq!(counts(&made), wanted, "{seed:?}");
                assert!(closed(&made) && faces_outward(&made), "{seed:?}");
            }
        }
    }

    #[test]
    fn kis_can_take_some_faces_only() {
        let p = Seed::Cube.polyhedron().ambo();
        assert_eq!(p.kis(Some(4)).faces.len(), 8 + 6 * 4);
        assert_eq!(p.kis(Some(5)), p);
    }
}
