//! Turns faces so that neighbours agree, and pieces so that they face up or out.
//!
//! A flood fill over edges makes each piece agree with its first face. Then a closed
//! piece is turned so that its volume is positive, an open one so that its area vectors
//! add up to one that points up. Where that says nothing (a wall, a figure without
//! volume) the sense that most faces have already is kept.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::Point3;
use crate::surface::faces::{FaceSide, area_vector};

/// The surface is one-sided; this edge is run through twice in one direction whatever
/// is turned.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Unorientable(pub [VertexId; 2]);

/// How far up the sum of area vectors must point, or how large the volume must be
/// against a ball of the same area, to decide which side is out. Smaller, and rounding
/// decides for upright walls.
const DECIDED: f64 = 1e-9;

/// Turns faces; returns how many. `sides` are all of them, sorted by edge; no edge may
/// have more than two faces.
pub(super) fn orient<F: AsRef<[VertexId]> + AsMut<[VertexId]>>(
    points: &IdVec<VertexId, Point3>,
    faces: &mut [F],
    sides: &[FaceSide],
) -> Result<usize, Unorientable> {
    let neighbours = Neighbours::new(faces, sides);
    let mut turn: IdVec<FaceId, Option<bool>> = vec![None; faces.len()].into();
    let mut turned = 0;
    for seed in turn.ids() {
        if turn[seed].is_some() {
            continue;
        }
        let piece = flood(faces, &neighbours, &mut turn, seed)?;
        if faces_wrong_way(points, faces, &neighbours, &turn, &piece) {
            for &f in &piece {
                turn[f] = turn[f].map(|t| !t);
            }
        }
        for &f in piece.iter().filter(|&&f| turn[f] == Some(true)) {
            faces[f.index()].as_mut()[1..].reverse();
            turned += 1;
        }
    }
    Ok(turned)
}

/// The face across an edge.
#[derive(Clone, Copy)]
struct Neighbour {
    face: FaceId,
    /// Neighbours that agree run along their edge in opposite directions.
    agrees: bool,
}

/// The faces across all sides, those of one face after those of the one before.
struct Neighbours {
    across: Vec<Option<Neighbour>>,
    starts: Vec<usize>,
}

impl Neighbours {
    fn new<F: AsRef<[VertexId]>>(faces: &[F], sides: &[FaceSide]) -> Self {
        let mut starts = vec![0];
        for face in faces {
            starts.push(starts[starts.len() - 1] + face.as_ref().len());
        }
        let mut across = vec![None; sides.len()];
        let mut set = |a: &FaceSide, b: &FaceSide| {
            let agrees = a.forward != b.forward;
            let at = starts[a.face.index()] + a.side as usize;
            across[at] = Some(Neighbour { face: b.face, agrees });
        };
        for group in sides.chunk_by(|a, b| a.edge == b.edge) {
            if let [a, b] = group {
                set(a, b);
                set(b, a);
            }
        }
        Self { across, starts }
    }

    fn of(&self, face: FaceId) -> &[Option<Neighbour>] {
        &self.across[self.starts[face.index()]..self.starts[face.index() + 1]]
    }
}

/// Marks which faces of the seed's piece to turn to agree with the seed.
fn flood<F: AsRef<[VertexId]>>(
    faces: &[F],
    neighbours: &Neighbours,
    turn: &mut IdVec<FaceId, Option<bool>>,
    seed: FaceId,
) -> Result<Vec<FaceId>, Unorientable> {
    turn[seed] = Some(false);
    let mut piece = vec![seed];
    let mut at = 0;
    while let Some(&face) = piece.get(at) {
        at += 1;
        for (k, neighbour) in neighbours.of(face).iter().enumerate() {
            let Some(Neighbour { face: other, agrees }) = *neighbour else { continue };
            let wanted = turn[face].map(|t| t ^ !agrees);
            match turn[other] {
                None => {
                    turn[other] = wanted;
                    piece.push(other);
                }
                found if found != wanted => {
                    let corners = faces[face.index()].as_ref();
                    return Err(Unorientable([corners[k], corners[(k + 1) % corners.len()]]));
                }
                Some(_) => {}
            }
        }
    }
    Ok(piece)
}

fn faces_wrong_way<F: AsRef<[VertexId]>>(
    points: &IdVec<VertexId, Point3>,
    faces: &[F],
    neighbours: &Neighbours,
    turn: &IdVec<FaceId, Option<bool>>,
    piece: &[FaceId],
) -> bool {
    let sign = |f: FaceId| if turn[f] == Some(true) { -1.0 } else { 1.0 };
    let corners = |f: FaceId| faces[f.index()].as_ref();
    let vector = |f: FaceId| area_vector(points, corners(f));
    let area: f64 = piece.iter().map(|&f| vector(f).norm()).sum();
    let closed = piece.iter().all(|&f| neighbours.of(f).iter().all(Option::is_some));
    let measure = if closed {
        // Six times the volume, from a corner of the piece to keep figures small.
        let o = points[corners(piece[0])[0]];
        let six_volumes: f64 =
            piece.iter().map(|&f| sign(f) * (points[corners(f)[0]] - o).dot(&vector(f))).sum();
        six_volumes / area.powf(1.5)
    } else {
        piece.iter().map(|&f| sign(f) * vector(f).z).sum::<f64>() / area
    };
    if measure.abs() > DECIDED {
        return measure < 0.0;
    }
    2 * piece.iter().filter(|&&f| turn[f] == Some(true)).count() > piece.len()
}
