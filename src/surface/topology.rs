//! How the triangles of a surface hang together: which edge meets which, the
//! pieces, their borders and handles.
//!
//! Half-edges are stored as arrays: half-edge `3 f + k` runs along side `k` of
//! triangle `f`, so only the twins need memory (the "directed edges" of Campagna,
//! Kobbelt and Seidel, 1998). The genus comes from Euler's formula,
//! V - E + F = 2 - 2 genus - loops, for each piece. Nothing here looks at lengths
//! except to name places in messages.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::shape::{Shape, counted, place};
use crate::surface::{Mesh, Point3};
use std::fmt;

/// One side of one triangle, with the triangle on its left.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct HalfedgeId(u32);

impl Id for HalfedgeId {
    fn new(i: usize) -> Self {
        Self(u32::try_from(i).expect("fewer than 2^32 elements: memory ends first"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

impl HalfedgeId {
    /// The half-edge along side `k` (0, 1 or 2) of a triangle.
    pub fn of(face: FaceId, k: usize) -> Self {
        Self::new(3 * face.index() + k % 3)
    }

    /// The triangle on its left.
    pub fn face(self) -> FaceId {
        FaceId::new(self.index() / 3)
    }

    /// Which side of its triangle it is: 0, 1 or 2. Also the corner where it starts.
    pub fn side(self) -> usize {
        self.index() % 3
    }

    /// The next half-edge of the same triangle, counter-clockwise.
    pub fn next(self) -> Self {
        Self::of(self.face(), self.side() + 1)
    }

    /// The one before it in the same triangle.
    pub fn prev(self) -> Self {
        Self::of(self.face(), self.side() + 2)
    }
}

/// What cannot be used as a surface, or not yet.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum TopologyError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {face} uses vertex {vertex}, but the vertices end at {vertices}")]
    VertexOutOfRange {
        /// The triangle.
        face: FaceId,
        /// The vertex that it names.
        vertex: VertexId,
        /// How many vertices there are.
        vertices: usize,
    },
    /// Edges with three triangles or more.
    #[error(
        "{} more than two triangles: {}",
        counted(*.count, "edge carries", "edges carry"), edge_list(.first)
    )]
    NonManifoldEdges {
        /// How many such edges there are.
        count: usize,
        /// The first of them, by their end vertices.
        first: Vec<[VertexId; 2]>,
    },
    /// Neighbours that run round in opposite senses.
    #[error(
        "the triangles beside {} face opposite ways: {}",
        counted(*.count, "edge", "edges"), edge_list(.first)
    )]
    Orientation {
        /// How many such edges there are.
        count: usize,
        /// The first of them, by their end vertices.
        first: Vec<[VertexId; 2]>,
    },
    /// Vertices where two fans of triangles touch only in this point.
    #[error(
        "parts of the surface touch in {} without sharing an edge there: {}",
        counted(*.count, "vertex", "vertices"), vertex_list(.first)
    )]
    NonManifoldVertices {
        /// How many such vertices there are.
        count: usize,
        /// The first of them, with their places.
        first: Vec<(VertexId, Point3)>,
    },
    /// The surface is sound, but not one piece with one border.
    #[error("the surface is not one piece with one border:\n{0}")]
    NotADisk(Shape),
    /// The surface is sound, but has no chart.
    #[error("the surface is not one piece with a border and no handle:\n{0}")]
    NotChartable(Shape),
}

impl TopologyError {
    /// What to try.
    pub fn hint(&self) -> String {
        match self {
            Self::VertexOutOfRange { .. } => "export the surface again".into(),
            Self::NonManifoldEdges { .. } => {
                "in the modelling program, select non-manifold edges and delete the inner walls \
                 or fins that meet there"
                    .into()
            }
            Self::Orientation { .. } => {
                "in the modelling program, recalculate the normals so that all face outward".into()
            }
            Self::NonManifoldVertices { .. } => {
                "in the modelling program, split the surface at these points or join it along \
                 an edge"
                    .into()
            }
            Self::NotADisk(shape) if shape.is_chartable() => {
                "in the modelling program, fill the holes, or cut from each hole to the outer \
                 border"
                    .into()
            }
            Self::NotADisk(shape) | Self::NotChartable(shape) => shape.hint(),
        }
    }
}

fn edge_list(edges: &[[VertexId; 2]]) -> String {
    let items: Vec<_> = edges.iter().map(|[a, b]| format!("{a}-{b}")).collect();
    format!("first between vertices {}", items.join(", "))
}

fn vertex_list(vertices: &[(VertexId, Point3)]) -> String {
    let items: Vec<_> =
        vertices.iter().map(|(v, p)| format!("vertex {v} at {}", place(*p))).collect();
    format!("first {}", items.join(", "))
}

/// How many places an error lists before it stops: enough to find the fault, short
/// enough to read.
pub(super) const PLACES: usize = 5;

/// One side of a triangle under its end vertices, the smaller first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// End vertices, the smaller first: equal for all sides that share an edge.
    pub edge: [VertexId; 2],
    /// The side itself.
    pub halfedge: HalfedgeId,
}

/// All sides of all triangles, sorted so that those on one edge stand together.
pub(super) fn sorted_sides(triangles: &IdVec<FaceId, [VertexId; 3]>) -> Vec<Side> {
    let mut sides: Vec<Side> = triangles
        .enumerate()
        .flat_map(|(face, t)| {
            (0..3).map(move |k| {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                Side { edge: [a.min(b), a.max(b)], halfedge: HalfedgeId::of(face, k) }
            })
        })
        .collect();
    sides.sort_unstable();
    sides
}

/// Edge connectivity of an oriented surface in which no edge has three triangles.
#[derive(Clone, PartialEq, Debug)]
pub struct Topology {
    triangles: IdVec<FaceId, [VertexId; 3]>,
    twins: IdVec<HalfedgeId, Option<HalfedgeId>>,
    /// One outgoing half-edge a vertex, the clockwise-most one on a border.
    outgoing: IdVec<VertexId, Option<HalfedgeId>>,
    /// Fans of triangles at each vertex: 1 on a surface, 2 at a bow-tie, 0 unused.
    fans: IdVec<VertexId, u32>,
}

impl Topology {
    /// Finds twins and fans.
    ///
    /// # Errors
    /// A vertex that does not exist, an edge with three triangles, or neighbours of
    /// opposite orientation. Bow-tie vertices are allowed here; see
    /// [`bow_ties`](Self::bow_ties).
    pub fn new(mesh: &Mesh) -> Result<Self, TopologyError> {
        check_range(mesh)?;
        let triangles = mesh.triangles.clone();
        let twins = pair_twins(&triangles)?;
        let mut topology = Self {
            triangles,
            twins,
            outgoing: vec![None; mesh.points.len()].into(),
            fans: vec![0; mesh.points.len()].into(),
        };
        topology.gather_fans();
        Ok(topology)
    }

    /// All half-edges in order.
    pub fn halfedges(&self) -> impl DoubleEndedIterator<Item = HalfedgeId> + use<> {
        self.twins.ids()
    }

    /// One half-edge for each edge: the border ones and the first of each pair.
    pub fn edges(&self) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.halfedges().filter(|&h| self.twin(h).is_none_or(|t| h < t))
    }

    /// The same edge seen from the neighbour; `None` on the border.
    pub fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twins[h]
    }

    /// Where a half-edge starts.
    pub fn from(&self, h: HalfedgeId) -> VertexId {
        self.triangles[h.face()][h.side()]
    }

    /// Where a half-edge ends.
    pub fn to(&self, h: HalfedgeId) -> VertexId {
        self.from(h.next())
    }

    /// How many vertices the mesh has, used or not.
    pub fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }

    /// How many triangles there are.
    pub fn face_count(&self) -> usize {
        self.triangles.len()
    }

    /// Half-edges that leave a vertex, counter-clockwise. On a border the first is
    /// the border half-edge. At a bow-tie only one fan is listed.
    pub fn outgoing(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        self.counter_clockwise(self.outgoing[v])
    }

    /// All half-edges that leave the start of `h` in the same fan of triangles,
    /// counter-clockwise. On a border the first is the border half-edge, else `h`.
    pub fn fan(&self, h: HalfedgeId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let mut first = h;
        while let Some(twin) = self.twin(first) {
            first = twin.next();
            if first == h {
                break;
            }
        }
        self.counter_clockwise(Some(first))
    }

    fn counter_clockwise(&self, first: Option<HalfedgeId>) -> impl Iterator<Item = HalfedgeId> {
        std::iter::successors(first, move |&h| self.twin(h.prev()).filter(|&h| Some(h) != first))
    }

    /// Whether a vertex lies on the border. Unused vertices do not.
    pub fn is_border(&self, v: VertexId) -> bool {
        self.outgoing[v].is_some_and(|h| self.twin(h).is_none())
    }

    /// Vertices where several fans of triangles touch in a point.
    pub fn bow_ties(&self) -> Vec<VertexId> {
        self.fans.enumerate().filter(|(_, n)| **n > 1).map(|(v, _)| v).collect()
    }

    /// Number of fans at a vertex: 1 on a surface, 2 or more at a bow-tie.
    pub fn fans(&self, v: VertexId) -> usize {
        self.fans[v] as usize
    }

    /// Border loops as half-edges, each with the surface on its left: the outer loop
    /// of a disk runs counter-clockwise seen from outside. Ordered by their first
    /// half-edge.
    pub fn border_halfedges(&self) -> Vec<Vec<HalfedgeId>> {
        let mut seen: IdVec<HalfedgeId, bool> = vec![false; self.twins.len()].into();
        let mut loops = Vec::new();
        for start in self.halfedges().filter(|&h| self.twin(h).is_none()) {
            let mut border = Vec::new();
            let mut h = start;
            while !seen[h] {
                seen[h] = true;
                border.push(h);
                h = self.next_on_border(h);
            }
            if !border.is_empty() {
                loops.push(border);
            }
        }
        loops
    }

    /// Border loops as vertices, in the order of
    /// [`border_halfedges`](Self::border_halfedges).
    pub fn border_loops(&self) -> Vec<Vec<VertexId>> {
        let vertices = |l: &Vec<HalfedgeId>| l.iter().map(|&h| self.from(h)).collect();
        self.border_halfedges().iter().map(vertices).collect()
    }

    /// The piece of each triangle, counted from 0 in the order of their first
    /// triangles, and how many pieces there are. Pieces hang together by edges:
    /// touching in a vertex does not join them.
    pub fn components(&self) -> (IdVec<FaceId, usize>, usize) {
        const NONE: usize = usize::MAX;
        let mut piece: IdVec<FaceId, usize> = vec![NONE; self.face_count()].into();
        let mut count = 0;
        let mut stack = Vec::new();
        for seed in self.triangles.ids() {
            if piece[seed] != NONE {
                continue;
            }
            piece[seed] = count;
            stack.push(seed);
            while let Some(face) = stack.pop() {
                for twin in (0..3).filter_map(|k| self.twin(HalfedgeId::of(face, k))) {
                    if piece[twin.face()] == NONE {
                        piece[twin.face()] = count;
                        stack.push(twin.face());
                    }
                }
            }
            count += 1;
        }
        (piece, count)
    }

    /// The border half-edge that follows a border half-edge, round its end vertex
    /// through the triangles of the same fan.
    fn next_on_border(&self, h: HalfedgeId) -> HalfedgeId {
        let mut h = h.next();
        while let Some(twin) = self.twin(h) {
            h = twin.next();
        }
        h
    }

    /// Counts the fans at each vertex and keeps the clockwise-most half-edge of one.
    fn gather_fans(&mut self) {
        let mut seen: IdVec<HalfedgeId, bool> = vec![false; self.twins.len()].into();
        for start in self.twins.ids() {
            if seen[start] {
                continue;
            }
            let fan: Vec<HalfedgeId> = self.fan(start).collect();
            for &h in &fan {
                seen[h] = true;
            }
            let v = self.from(start);
            self.fans[v] += 1;
            // A border fan wins over a closed one, so that `is_border` sees it.
            if self.outgoing[v].is_none() || self.twins[fan[0]].is_none() {
                self.outgoing[v] = Some(fan[0]);
            }
        }
    }
}

fn check_range(mesh: &Mesh) -> Result<(), TopologyError> {
    let vertices = mesh.points.len();
    for (face, t) in mesh.triangles.enumerate() {
        if let Some(&vertex) = t.iter().find(|v| v.index() >= vertices) {
            return Err(TopologyError::VertexOutOfRange { face, vertex, vertices });
        }
    }
    Ok(())
}

fn pair_twins(
    triangles: &IdVec<FaceId, [VertexId; 3]>,
) -> Result<IdVec<HalfedgeId, Option<HalfedgeId>>, TopologyError> {
    let start = |h: HalfedgeId| triangles[h.face()][h.side()];
    let mut twins: IdVec<HalfedgeId, _> = vec![None; 3 * triangles.len()].into();
    let (mut crowded, mut turned) = (Vec::new(), Vec::new());
    for group in sorted_sides(triangles).chunk_by(|a, b| a.edge == b.edge) {
        match group {
            [_] => {}
            [a, b] if start(a.halfedge) != start(b.halfedge) => {
                twins[a.halfedge] = Some(b.halfedge);
                twins[b.halfedge] = Some(a.halfedge);
            }
            [a, _] => turned.push(a.edge),
            more => crowded.push(more[0].edge),
        }
    }
    let first = |edges: &[[VertexId; 2]]| edges.iter().take(PLACES).copied().collect();
    if !crowded.is_empty() {
        let first = first(&crowded);
        return Err(TopologyError::NonManifoldEdges { count: crowded.len(), first });
    }
    if !turned.is_empty() {
        let first = first(&turned);
        return Err(TopologyError::Orientation { count: turned.len(), first });
    }
    Ok(twins)
}

/// Connectivity of a surface that is one disk: one piece, one border, no handle, no
/// bow-tie.
///
/// # Errors
/// Anything else, with a table of what was found; see [`TopologyError::hint`].
pub fn require_disk(mesh: &Mesh) -> Result<Topology, TopologyError> {
    let topology = without_bow_ties(mesh)?;
    let shape = Shape::new(mesh, &topology);
    if shape.is_disk() { Ok(topology) } else { Err(TopologyError::NotADisk(shape)) }
}

/// Connectivity of a surface that can be laid out flat once its holes are filled: one
/// piece, a border, no handle, no bow-tie.
///
/// # Errors
/// Anything else, with a table of what was found; see [`TopologyError::hint`].
pub fn require_chartable(mesh: &Mesh) -> Result<Topology, TopologyError> {
    let topology = without_bow_ties(mesh)?;
    let shape = Shape::new(mesh, &topology);
    if shape.is_chartable() { Ok(topology) } else { Err(TopologyError::NotChartable(shape)) }
}

fn without_bow_ties(mesh: &Mesh) -> Result<Topology, TopologyError> {
    let topology = Topology::new(mesh)?;
    let bow_ties = topology.bow_ties();
    if bow_ties.is_empty() {
        return Ok(topology);
    }
    let first = bow_ties.iter().take(PLACES).map(|&v| (v, mesh.points[v])).collect();
    Err(TopologyError::NonManifoldVertices { count: bow_ties.len(), first })
}

impl fmt::Display for HalfedgeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "side {} of triangle {}", self.side() + 1, self.face())
    }
}

#[cfg(test)]
#[path = "topology_tests.rs"]
mod tests;
