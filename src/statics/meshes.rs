//! The meshes of a frame: the faces between its rods, and what area in plan each rod carries.
//!
//! Rods that touch share a corner. Round a corner, the pieces of rods that start there are
//! in order by their angles about its normal; from a piece, the walk goes on with the next one
//! clockwise at its far end, and so runs round the mesh on its left. What the frame has round
//! it, and open holes in it, are run round the other way, and count as no mesh.

use super::beam::axes;
use super::model::Model;
use crate::surface::{Point3, Vector3};

/// A piece of rod walked along from one of its ends: beam times two, and one more where it is
/// walked from its second node to its first.
type Half = usize;

/// The area in plan that each beam carries, mm²: that of the meshes on both of its sides,
/// shared among the beams round each by their lengths in plan.
pub fn tributary(model: &Model) -> Vec<f64> {
    let corners = Corners::of(model);
    let plan: Vec<f64> = model.beams.iter().map(|b| model.along(b).xy().norm()).collect();
    let mut carried = vec![0.0; model.beams.len()];
    let mut walked = vec![false; 2 * model.beams.len()];
    for start in 0..walked.len() {
        if walked[start] {
            continue;
        }
        let face = corners.walk(start);
        face.iter().for_each(|&half| walked[half] = true);
        let area = corners.plan_area(&face);
        let round: f64 = face.iter().map(|half| plan[half / 2]).sum();
        if area > 0.0 && round > 0.0 {
            face.iter().for_each(|half| carried[half / 2] += area * plan[half / 2] / round);
        }
    }
    carried
}

/// Where rods touch, and the pieces that start there.
struct Corners {
    /// The corner at which each half starts.
    start: Vec<usize>,
    /// The half that a walk along each half goes on with.
    next: Vec<Half>,
    /// Where the corners are, and their normals.
    places: Vec<(Point3, Vector3)>,
}

impl Corners {
    fn of(model: &Model) -> Self {
        let corner = joined(model);
        let mut places = vec![(Point3::origin(), Vector3::zeros(), 0.0); model.nodes.len()];
        for (node, &corner) in corner.iter().enumerate() {
            places[corner].0 += model.nodes[node].coords;
            places[corner].2 += 1.0;
        }
        for joint in &model.joints {
            places[corner[joint.nodes[0]]].1 += joint.axis;
        }
        let places: Vec<(Point3, Vector3)> = places
            .into_iter()
            .map(|(sum, normal, n)| ((sum.coords / f64::max(n, 1.0)).into(), normal))
            .collect();
        let start: Vec<usize> =
            model.beams.iter().flat_map(|b| b.nodes.map(|node| corner[node])).collect();
        let mut leaving: Vec<Vec<Half>> = vec![Vec::new(); places.len()];
        for (half, &corner) in start.iter().enumerate() {
            leaving[corner].push(half);
        }
        let mut next = vec![0; start.len()];
        for (corner, halves) in leaving.iter_mut().enumerate() {
            let frame = sides(&places[corner].1);
            let angle = |half: Half| {
                let along = model.along(&model.beams[half / 2]);
                let along = if half.is_multiple_of(2) { along } else { -along };
                along.dot(&frame[1]).atan2(along.dot(&frame[0]))
            };
            halves.sort_by(|&p, &q| angle(p).total_cmp(&angle(q)).then(p.cmp(&q)));
            for (i, &half) in halves.iter().enumerate() {
                // Who comes in along a half leaves by the next one clockwise.
                let clockwise = halves[(i + halves.len() - 1) % halves.len()];
                next[half ^ 1] = clockwise;
            }
        }
        Self { start, next, places }
    }

    fn walk(&self, start: Half) -> Vec<Half> {
        let mut face = vec![start];
        let mut half = self.next[start];
        while half != start {
            face.push(half);
            half = self.next[half];
        }
        face
    }

    /// The area of a mesh seen from above; 0 of what is no mesh, or hangs over.
    fn plan_area(&self, face: &[Half]) -> f64 {
        let place = |half: &Half| self.places[self.start[*half]];
        let middle = place(&face[0]).0;
        let mut area = Vector3::zeros();
        let mut normal = Vector3::zeros();
        for (i, half) in face.iter().enumerate() {
            let [(p, n), (q, _)] = [place(half), place(&face[(i + 1) % face.len()])];
            area += (p - middle).cross(&(q - middle)) / 2.0;
            normal += n;
        }
        if area.dot(&normal) > 0.0 { area.z.max(0.0) } else { 0.0 }
    }
}

/// The corner of each node: the lowest number of a node that it is joined to by contacts.
fn joined(model: &Model) -> Vec<usize> {
    let mut corner: Vec<usize> = (0..model.nodes.len()).collect();
    fn root(corner: &[usize], mut node: usize) -> usize {
        while corner[node] != node {
            node = corner[node];
        }
        node
    }
    for joint in &model.joints {
        let [a, b] = joint.nodes.map(|node| root(&corner, node));
        corner[a.max(b)] = a.min(b);
    }
    (0..corner.len()).map(|node| root(&corner, node)).collect()
}

/// Two directions square to a normal and to each other, counter-clockwise seen against it;
/// any two where there is no normal.
fn sides(normal: &Vector3) -> [Vector3; 2] {
    let up = normal.try_normalize(f64::MIN_POSITIVE).unwrap_or(Vector3::z());
    let axes = axes(&up);
    [1, 2].map(|i| axes.row(i).transpose())
}
