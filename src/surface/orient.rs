//! Turns triangles so that neighbours agree, and pieces so that they face up or out.
//!
//! A flood fill over edges makes each piece agree with its first triangle. Then a
//! closed piece is turned so that its volume is positive, an open one so that its area
//! vectors add up to one that points up. Where that says nothing (a wall, a figure
//! without volume) the sense that most triangles have already is kept.

use crate::ids::{FaceId, IdVec, VertexId};
use crate::surface::topology::{HalfedgeId, sorted_sides};
use crate::surface::{Mesh, Point3};

/// The surface is one-sided; this edge is run through twice in one direction whatever
/// is turned.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Unorientable(pub [VertexId; 2]);

/// How far up the sum of area vectors must point, or how large the volume must be
/// against a ball of the same area, to decide which side is out. Smaller, and rounding
/// decides for upright walls.
const DECIDED: f64 = 1e-9;

/// Turns triangles; returns how many. No edge may have more than two triangles.
pub(super) fn orient(mesh: &mut Mesh) -> Result<usize, Unorientable> {
    let twins = twins(mesh);
    let mut turn: IdVec<FaceId, Option<bool>> = vec![None; mesh.triangles.len()].into();
    let mut turned = 0;
    for seed in mesh.triangles.ids() {
        if turn[seed].is_some() {
            continue;
        }
        let piece = flood(mesh, &twins, &mut turn, seed)?;
        if faces_wrong_way(mesh, &twins, &turn, &piece) {
            for &f in &piece {
                turn[f] = turn[f].map(|t| !t);
            }
        }
        for &f in piece.iter().filter(|&&f| turn[f] == Some(true)) {
            mesh.triangles[f].swap(1, 2);
            turned += 1;
        }
    }
    Ok(turned)
}

fn twins(mesh: &Mesh) -> IdVec<HalfedgeId, Option<HalfedgeId>> {
    let mut twins: IdVec<HalfedgeId, _> = vec![None; 3 * mesh.triangles.len()].into();
    for group in sorted_sides(&mesh.triangles).chunk_by(|a, b| a.edge == b.edge) {
        if let [a, b] = group {
            twins[a.halfedge] = Some(b.halfedge);
            twins[b.halfedge] = Some(a.halfedge);
        }
    }
    twins
}

/// Marks which triangles of the seed's piece to turn to agree with the seed.
fn flood(
    mesh: &Mesh,
    twins: &IdVec<HalfedgeId, Option<HalfedgeId>>,
    turn: &mut IdVec<FaceId, Option<bool>>,
    seed: FaceId,
) -> Result<Vec<FaceId>, Unorientable> {
    let start = |h: HalfedgeId| mesh.triangles[h.face()][h.side()];
    turn[seed] = Some(false);
    let mut piece = vec![seed];
    let mut at = 0;
    while let Some(&face) = piece.get(at) {
        at += 1;
        for h in (0..3).map(|k| HalfedgeId::of(face, k)) {
            let Some(twin) = twins[h] else { continue };
            // Neighbours that agree run along their edge in opposite directions.
            let wanted = turn[face].map(|t| t ^ (start(h) == start(twin)));
            match turn[twin.face()] {
                None => {
                    turn[twin.face()] = wanted;
                    piece.push(twin.face());
                }
                found if found != wanted => {
                    return Err(Unorientable([start(h), start(h.next())]));
                }
                Some(_) => {}
            }
        }
    }
    Ok(piece)
}

fn faces_wrong_way(
    mesh: &Mesh,
    twins: &IdVec<HalfedgeId, Option<HalfedgeId>>,
    turn: &IdVec<FaceId, Option<bool>>,
    piece: &[FaceId],
) -> bool {
    let sign = |f: FaceId| if turn[f] == Some(true) { -1.0 } else { 1.0 };
    let area: f64 = piece.iter().map(|&f| mesh.area_vector(f).norm()).sum();
    let closed = piece.iter().all(|&f| (0..3).all(|k| twins[HalfedgeId::of(f, k)].is_some()));
    let measure = if closed {
        // Six times the volume, from a corner of the piece to keep figures small.
        let o: Point3 = mesh.corners(piece[0])[0];
        let six_volumes: f64 = piece
            .iter()
            .map(|&f| sign(f) * (mesh.corners(f)[0] - o).dot(&mesh.area_vector(f)))
            .sum();
        six_volumes / area.powf(1.5)
    } else {
        piece.iter().map(|&f| sign(f) * mesh.area_vector(f).z).sum::<f64>() / area
    };
    if measure.abs() > DECIDED {
        return measure < 0.0;
    }
    2 * piece.iter().filter(|&&f| turn[f] == Some(true)).count() > piece.len()
}
