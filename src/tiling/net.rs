//! Which tile borders on which, wherever the tiles lie: in a plane, on a sphere, or
//! as the polygons of a mesh.

use crate::ids::{Id, IdVec, TileEdgeId, TileId};
use std::collections::BTreeMap;

/// Tiles and the edges between them, without places.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Net {
    /// The polygons.
    pub tiles: IdVec<TileId, Tile>,
    /// Their sides, each once.
    pub edges: IdVec<TileEdgeId, TileEdge>,
}

/// A polygon of a net.
#[derive(Clone, PartialEq, Debug)]
pub struct Tile {
    /// Vertices, counter-clockwise.
    pub corners: Vec<usize>,
    /// Edges; edge i joins corners i and i + 1.
    pub edges: Vec<TileEdgeId>,
}

/// A side of one or two polygons.
#[derive(Clone, PartialEq, Debug)]
pub struct TileEdge {
    /// Vertices, in the order in which the left tile runs through them.
    pub ends: [usize; 2],
    /// The tile on the left.
    pub left: TileId,
    /// The tile on the right, if there is one.
    pub right: Option<TileId>,
}

impl Net {
    /// Joins polygons, given by their vertices counter-clockwise, along the edges that
    /// they share. Two polygons share an edge when they run through it in opposite
    /// senses; a third one at the same edge keeps a side of its own.
    pub fn new(polygons: impl IntoIterator<Item = Vec<usize>>) -> Self {
        let mut net = Self::default();
        let mut open: BTreeMap<[usize; 2], TileEdgeId> = BTreeMap::new();
        for corners in polygons {
            let tile = TileId::new(net.tiles.len());
            let n = corners.len();
            let edges = (0..n).map(|i| {
                let (from, to) = (corners[i], corners[(i + 1) % n]);
                if let Some(known) = open.remove(&[to, from]) {
                    net.edges[known].right = Some(tile);
                    return known;
                }
                let edge = net.edges.push(TileEdge { ends: [from, to], left: tile, right: None });
                open.insert([from, to], edge);
                edge
            });
            let edges = edges.collect();
            net.tiles.push(Tile { corners, edges });
        }
        net
    }

    /// The tiles on the other side of a tile's edges, in the order of the edges.
    pub fn neighbours(&self, tile: TileId) -> impl Iterator<Item = TileId> + '_ {
        self.tiles[tile].edges.iter().filter_map(move |&e| self.across(e, tile))
    }

    /// The tile on the other side of an edge of `tile`.
    pub fn across(&self, edge: TileEdgeId, tile: TileId) -> Option<TileId> {
        let edge = &self.edges[edge];
        if edge.left == tile { edge.right } else { Some(edge.left) }
    }

    /// How many steps from tile to neighbour each tile lies from the nearest of
    /// `starts`; tiles that cannot be reached come last.
    pub fn rings(&self, starts: impl IntoIterator<Item = TileId>) -> IdVec<TileId, usize> {
        let mut rings: IdVec<TileId, usize> = vec![usize::MAX; self.tiles.len()].into();
        let mut queue: Vec<TileId> = starts.into_iter().collect();
        queue.iter().for_each(|&t| rings[t] = 0);
        let mut next = 0;
        while let Some(&tile) = queue.get(next) {
            next += 1;
            for other in self.neighbours(tile) {
                if rings[other] == usize::MAX {
                    rings[other] = rings[tile] + 1;
                    queue.push(other);
                }
            }
        }
        rings
    }

    /// Two colours such that neighbours differ: true for the first tile of each connected
    /// piece. `None` where there are no such colours.
    pub fn colours(&self) -> Option<IdVec<TileId, bool>> {
        let mut colours: IdVec<TileId, Option<bool>> = vec![None; self.tiles.len()].into();
        for start in self.tiles.ids() {
            if colours[start].is_some() {
                continue;
            }
            colours[start] = Some(true);
            let mut queue = vec![start];
            while let Some(tile) = queue.pop() {
                for other in self.neighbours(tile) {
                    match colours[other] {
                        None => {
                            colours[other] = colours[tile].map(|c| !c);
                            queue.push(other);
                        }
                        same if same == colours[tile] => return None,
                        Some(_) => {}
                    }
                }
            }
        }
        colours.iter().copied().collect()
    }

    /// The number of tiles round the vertex that has most.
    pub fn greatest_valence(&self) -> usize {
        let mut valences: BTreeMap<usize, usize> = BTreeMap::new();
        for &corner in self.tiles.iter().flat_map(|t| &t.corners) {
            *valences.entry(corner).or_default() += 1;
        }
        valences.into_values().max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces of a cube.
    fn cube() -> Net {
        let faces =
            [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        Net::new(faces.map(Vec::from))
    }

    #[test]
    fn a_cube_has_twelve_edges_each_between_two_tiles() {
        let net = cube();
        assert_eq!((net.tiles.len(), net.edges.len()), (6, 12));
        for (e, edge) in net.edges.enumerate() {
            let right = edge.right.expect("a cube is closed");
            assert_eq!(net.across(e, edge.left), Some(right));
            assert_eq!(net.across(e, right), Some(edge.left));
            assert!(net.tiles[right].edges.contains(&e) && net.tiles[edge.left].edges.contains(&e));
        }
        let rings = net.rings([TileId::new(0)]);
        assert_eq!(rings.iter().copied().collect::<Vec<_>>(), [0, 2, 1, 1, 1, 1]);
        assert_eq!(net.greatest_valence(), 3);
    }

    #[test]
    fn a_third_polygon_at_an_edge_is_not_joined() {
        let net = Net::new([vec![0, 1, 2], vec![1, 0, 3], vec![1, 0, 4]]);
        let shared: Vec<_> = net.edges.iter().filter(|e| e.right.is_some()).collect();
        assert_eq!(shared.len(), 1);
        assert_eq!(net.neighbours(TileId::new(2)).count(), 0);
    }
}
