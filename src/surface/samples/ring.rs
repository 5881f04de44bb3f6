//! A ring of hexagons: a surface without a border, with a hole through it, whose own
//! polygons are the tiles.

use crate::ids::{IdVec, VertexId};
use crate::surface::Point3;
use crate::surface::polygons::PolygonMesh;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A torus lying on the ground, covered with hexagons. Lengths in mm.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// From the middle of the ring to the middle of its tube.
    pub radius: f64,
    /// Radius of the tube.
    pub tube: f64,
    /// Hexagons along the ring.
    pub along: usize,
    /// Hexagons round the tube: an even number.
    pub round: usize,
}

impl Ring {
    /// The sample.
    pub const SAMPLE: Self = Self { radius: 270.0, tube: 80.0, along: 16, round: 6 };

    /// Its polygons. Hexagon (p, q) has its middle at (2 p + q mod 2, 3 q) in steps of
    /// half a hexagon along and a third of a row round; so corners have whole numbers.
    pub fn polygons(&self) -> PolygonMesh {
        const CORNERS: [[isize; 2]; 6] = [[0, 2], [-1, 1], [-1, -1], [0, -2], [1, -1], [1, 1]];
        let [columns, rows] = [2 * self.along as isize, 3 * self.round as isize];
        let mut known: BTreeMap<[isize; 2], VertexId> = BTreeMap::new();
        let mut points = IdVec::new();
        let mut faces = Vec::new();
        for q in 0..self.round {
            for p in 0..self.along {
                let middle = [(2 * p + q % 2) as isize, 3 * q as isize];
                let face = CORNERS.iter().map(|[x, y]| {
                    let at =
                        [(middle[0] + x).rem_euclid(columns), (middle[1] + y).rem_euclid(rows)];
                    *known.entry(at).or_insert_with(|| points.push(self.point(at)))
                });
                faces.push(face.collect());
            }
        }
        PolygonMesh { points, faces }
    }

    fn point(&self, [x, y]: [isize; 2]) -> Point3 {
        let (sin, cos) = (TAU * x as f64 / (2 * self.along) as f64).sin_cos();
        let (up, out) = (TAU * y as f64 / (3 * self.round) as f64).sin_cos();
        let from_axis = self.radius + self.tube * out;
        Point3::new(from_axis * cos, from_axis * sin, self.tube * (1.0 + up))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::polygons::mend_polygons;
    use crate::surface::shape::Shape;
    use crate::surface::topology::Topology;

    #[test]
    fn the_ring_is_sound_closed_and_has_one_handle() {
        let ring = Ring::SAMPLE.polygons();
        assert_eq!((ring.faces.len(), ring.points.len()), (96, 192));
        let mended = mend_polygons(ring.clone()).expect("sound");
        assert_eq!((mended.mesh, mended.notes), (ring.clone(), Vec::new()));
        let mesh = ring.triangles();
        let shape = Shape::new(&mesh, &Topology::new(&mesh).expect("sound"));
        assert_eq!((shape.pieces.len(), shape.pieces[0].genus), (1, 1));
        assert!(shape.pieces[0].borders.is_empty());
    }
}
