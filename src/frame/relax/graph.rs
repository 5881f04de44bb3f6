//! The graph of the units: their centres, the links between neighbours, and the angles
//! between successive links round a centre (paper, section 5.1).

use crate::frame::canvas::Canvas;
use crate::ids::TileId;
use crate::surface::Point3;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// The graph as it is in the plane of the pattern. Nodes are numbered as the tiles that it
/// was made of.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Graph {
    /// The links.
    pub links: Vec<Link>,
    /// The angles.
    pub corners: Vec<Corner>,
}

/// Two units side by side.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Link {
    /// The nodes that it joins.
    pub ends: [usize; 2],
    /// Its length in the plane, in tile edges.
    pub length: f64,
}

/// Two successive links at a node.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Corner {
    /// The node.
    pub at: usize,
    /// The nodes at the other ends of the links.
    pub ends: [usize; 2],
    /// The angle θ⁰ between the links in the plane, radians.
    pub angle: f64,
}

/// Angles this near to half a turn are left out, radians: there units are missing between
/// the links, and the cosine, which has no slope, would hold nothing.
const STRAIGHT: f64 = 1e-3;

impl Graph {
    /// The graph of the units on these tiles of a plane pattern.
    pub fn new(canvas: &impl Canvas, tiles: &[TileId]) -> Self {
        let node: BTreeMap<TileId, usize> =
            tiles.iter().enumerate().map(|(i, &tile)| (tile, i)).collect();
        let net = canvas.net();
        let mut graph = Self::default();
        for (at, &tile) in tiles.iter().enumerate() {
            let way = |other: usize| canvas.middle(tiles[other]) - canvas.middle(tile);
            let round: Vec<usize> =
                net.neighbours(tile).filter_map(|t| node.get(&t).copied()).collect();
            for (i, &one) in round.iter().enumerate() {
                if at < one {
                    graph.links.push(Link { ends: [at, one], length: way(one).norm() });
                }
                let next = round[(i + 1) % round.len()];
                let (u, v) = (way(one), way(next));
                let angle = u.perp(&v).atan2(u.dot(&v)).rem_euclid(TAU);
                if next != one && angle < PI - STRAIGHT {
                    graph.corners.push(Corner { at, ends: [one, next], angle });
                }
            }
        }
        graph
    }

    /// Mean length of the links in space, mm, and in the plane, in tile edges.
    pub fn mean_lengths(&self, centers: &[Point3]) -> [f64; 2] {
        let n = self.links.len().max(1) as f64;
        let space: f64 = self.links.iter().map(|link| length(link, centers)).sum();
        let plane: f64 = self.links.iter().map(|link| link.length).sum();
        [space / n, plane / n]
    }

    /// By how much angles differ from those in the plane, degrees.
    pub fn angle_errors(&self, centers: &[Point3]) -> Vec<f64> {
        let error = |corner: &Corner| {
            let [a, b] = corner.ends.map(|end| centers[end] - centers[corner.at]);
            (a.angle(&b) - corner.angle).to_degrees()
        };
        self.corners.iter().map(error).collect()
    }

    /// By how much links differ from `unit` mm for every tile edge of their length, as part
    /// of that.
    pub fn length_errors(&self, centers: &[Point3], unit: f64) -> Vec<f64> {
        let error = |link: &Link| length(link, centers) / (link.length * unit) - 1.0;
        self.links.iter().map(error).collect()
    }
}

fn length(link: &Link, centers: &[Point3]) -> f64 {
    let [a, b] = link.ends.map(|end| centers[end]);
    (b - a).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::canvas::PlaneCanvas;
    use crate::frame::canvas::fixture::Sheet;
    use crate::frame::crop::{crop, held};
    use crate::pattern::Pattern;
    use crate::tiling::Placement;
    use nalgebra::Point2;

    /// On a flat sheet nothing differs from the plane. Of hexagons in a row of the border
    /// some have angles on one side only.
    #[test]
    fn a_flat_sheet_differs_by_nothing() {
        for name in ["4.4.4.4", "3.4.6.4", "6.6.6", "4.8.8"] {
            let pattern = Pattern::named(name).expect("of the library");
            let placement = Placement { origin: Point2::new(0.1, 0.2), rotation: 0.3, edge: 0.8 };
            let canvas =
                PlaneCanvas::new(&Sheet, pattern, placement, pattern.usual()).expect("few tiles");
            let tiles = crop(&canvas, &held(&canvas));
            let graph = Graph::new(&canvas, &tiles);
            let place = |&t: &TileId| canvas.place(t, canvas.middle(t)).expect("held").position;
            let centers: Vec<Point3> = tiles.iter().map(place).collect();
            let [space, plane] = graph.mean_lengths(&centers);
            assert!((space / plane - 0.8).abs() < 1e-12);
            let lengths = graph.length_errors(&centers, 0.8);
            let angles = graph.angle_errors(&centers);
            assert!(lengths.len() >= tiles.len() && angles.len() >= tiles.len());
            assert!(lengths.iter().chain(&angles).all(|e| e.abs() < 1e-5), "{name}");
            // Round an inner unit the angles make a whole turn; round no unit more.
            for at in 0..tiles.len() {
                let round: f64 = graph.corners.iter().filter(|c| c.at == at).map(|c| c.angle).sum();
                assert!(round < TAU + 1e-9);
            }
        }
    }
}
