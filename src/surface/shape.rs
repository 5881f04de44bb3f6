//! What a surface is like as a whole: its pieces, their borders, handles and sizes.
//! Printed as a small table when a surface cannot be used as it is.

use crate::ids::{FaceId, IdVec};
use crate::surface::topology::{HalfedgeId, Topology};
use crate::surface::{Mesh, Point3};
use std::fmt;

/// A closed border line.
#[derive(Clone, PartialEq, Debug)]
pub struct Border {
    /// Edges along it.
    pub edges: usize,
    /// Its length, mm.
    pub length: f64,
    /// Mean of its vertices, mm: where to look for it.
    pub centre: Point3,
}

/// One connected piece.
#[derive(Clone, PartialEq, Debug)]
pub struct Piece {
    /// Its triangles.
    pub triangles: usize,
    /// Its borders, the longest first.
    pub borders: Vec<Border>,
    /// Handles: 0 for a sphere or disk, 1 for a torus.
    pub genus: usize,
    /// Lower and upper corner of its bounding box, mm.
    pub bounds: [Point3; 2],
}

impl Piece {
    /// One border and no handle.
    pub fn is_disk(&self) -> bool {
        self.borders.len() == 1 && self.genus == 0
    }

    /// The borders other than the longest one.
    pub fn holes(&self) -> &[Border] {
        self.borders.get(1..).unwrap_or_default()
    }

    fn kind(&self) -> String {
        let handles = match self.genus {
            0 => String::new(),
            1 => ", 1 handle".into(),
            n => format!(", {n} handles"),
        };
        let base = match self.borders.len() {
            0 => "closed".into(),
            1 => "one border".into(),
            2 => "1 hole".into(),
            n => format!("{} holes", n - 1),
        };
        base + &handles
    }
}

/// The pieces of a surface, in the order of their first triangles.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// All pieces.
    pub pieces: Vec<Piece>,
}

impl Shape {
    /// Measures the pieces of a mesh. Where fans of triangles touch in a vertex only,
    /// the vertex counts once for each fan.
    pub fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let (piece_of, count) = topology.components();
        let mut pieces = measure(mesh, &piece_of, count);
        for border in topology.border_halfedges() {
            let piece = piece_of[border[0].face()];
            pieces[piece].borders.push(measure_border(mesh, topology, &border));
        }
        for (piece, corners) in pieces.iter_mut().zip(count_fans(topology, &piece_of, count)) {
            piece.borders.sort_by(|a, b| b.length.total_cmp(&a.length));
            let border_edges: usize = piece.borders.iter().map(|b| b.edges).sum();
            // Each triangle has three sides; inner edges take two of them.
            let edges = (3 * piece.triangles + border_edges) / 2;
            // 2 genus = 2 - loops - (V - E + F), never negative for an oriented surface.
            let doubled =
                (2 + edges).saturating_sub(piece.borders.len() + corners + piece.triangles);
            piece.genus = doubled / 2;
        }
        Self { pieces }
    }

    /// One piece with one border and no handle.
    pub fn is_disk(&self) -> bool {
        matches!(&self.pieces[..], [piece] if piece.is_disk())
    }

    /// What would make a disk of it.
    pub fn hint(&self) -> String {
        let Some(piece) = self.pieces.first() else {
            return "the surface has no triangles: export it again".into();
        };
        let mut advice = Vec::new();
        if self.pieces.len() > 1 {
            advice.push("keep one piece and delete or separate the others");
        }
        if self.pieces.iter().any(|p| p.borders.is_empty()) {
            advice
                .push("cut the closed surface open, for example by deleting what is below ground");
        }
        if self.pieces.iter().any(|p| p.genus > 0) {
            advice.push("cut through each handle, or close it");
        }
        if self.pieces.iter().any(|p| p.borders.len() > 1) {
            advice.push("fill the holes, or cut from each hole to the outer border");
        }
        let mut hint = format!("in the modelling program, {}", advice.join("; "));
        if self.pieces.len() == 1 && !piece.holes().is_empty() {
            hint += &format!(" (first hole around {})", place(piece.holes()[0].centre));
        }
        hint
    }
}

fn measure(mesh: &Mesh, piece_of: &IdVec<FaceId, usize>, count: usize) -> Vec<Piece> {
    let far = f64::INFINITY;
    let empty = Piece {
        triangles: 0,
        borders: Vec::new(),
        genus: 0,
        bounds: [Point3::new(far, far, far), Point3::new(-far, -far, -far)],
    };
    let mut pieces = vec![empty; count];
    for (face, &p) in piece_of.enumerate() {
        let piece = &mut pieces[p];
        piece.triangles += 1;
        for corner in mesh.corners(face) {
            let [lo, hi] = piece.bounds;
            piece.bounds = [lo.inf(&corner), hi.sup(&corner)];
        }
    }
    pieces
}

fn measure_border(mesh: &Mesh, topology: &Topology, border: &[HalfedgeId]) -> Border {
    let mut length = 0.0;
    let mut sum = nalgebra::Vector3::zeros();
    for &h in border {
        let a = mesh.points[topology.from(h)];
        length += (mesh.points[topology.to(h)] - a).norm();
        sum += a.coords;
    }
    Border { edges: border.len(), length, centre: (sum / border.len() as f64).into() }
}

/// Vertices of each piece, a bow-tie counted once for each fan.
fn count_fans(topology: &Topology, piece_of: &IdVec<FaceId, usize>, count: usize) -> Vec<usize> {
    let mut seen: IdVec<HalfedgeId, bool> = vec![false; 3 * topology.face_count()].into();
    let mut fans = vec![0; count];
    for start in topology.halfedges() {
        if seen[start] {
            continue;
        }
        fans[piece_of[start.face()]] += 1;
        // Counter-clockwise round the start vertex, then clockwise from it.
        let mut next = Some(start);
        while let Some(h) = next.filter(|&h| !seen[h]) {
            seen[h] = true;
            next = topology.twin(h.prev());
        }
        let mut next = topology.twin(start).map(HalfedgeId::next);
        while let Some(h) = next.filter(|&h| !seen[h]) {
            seen[h] = true;
            next = topology.twin(h).map(HalfedgeId::next);
        }
    }
    fans
}

/// A number with the word for one or for many.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

/// A point as text, to the nearest millimetre or three digits, whichever is finer.
pub(super) fn place(p: Point3) -> String {
    format!("({}, {}, {}) mm", short(p.x), short(p.y), short(p.z))
}

fn short(x: f64) -> String {
    let digits = if x.abs() >= 100.0 { 0 } else { 2 };
    let text = format!("{x:.digits$}");
    let text = if digits == 0 { &text } else { text.trim_end_matches('0').trim_end_matches('.') };
    if text == "-0" { "0".into() } else { text.to_owned() }
}

/// How many pieces the table shows: a scan may have thousands of specks.
const ROWS: usize = 12;

/// How many holes are placed below the table.
const HOLES: usize = 5;

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "  piece  triangles  loops  genus  size, mm")?;
        for (i, p) in self.pieces.iter().take(ROWS).enumerate() {
            let size = p.bounds[1] - p.bounds[0];
            write!(
                f,
                "\n  {:>5}  {:>9}  {:>5}  {:>5}  {} x {} x {} ({})",
                i + 1,
                p.triangles,
                p.borders.len(),
                p.genus,
                short(size.x),
                short(size.y),
                short(size.z),
                p.kind(),
            )?;
        }
        if self.pieces.len() > ROWS {
            write!(f, "\n  and {} more pieces", self.pieces.len() - ROWS)?;
        }
        let holes: Vec<&Border> = self.pieces.iter().flat_map(Piece::holes).collect();
        for hole in holes.iter().take(HOLES) {
            write!(f, "\n  hole of {} edges around {}", hole.edges, place(hole.centre))?;
        }
        if holes.len() > HOLES {
            write!(f, "\n  and {} more holes", holes.len() - HOLES)?;
        }
        Ok(())
    }
}
