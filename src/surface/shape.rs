//! What a surface is like as a whole: its pieces, their borders, handles and sizes.
//! Printed as a small table by `inspect`, and where a surface cannot be used as it is.

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
    /// Its area, mm².
    pub area: f64,
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

    /// A border and no handle: a disk once its holes are filled.
    pub fn is_chartable(&self) -> bool {
        !self.borders.is_empty() && self.genus == 0
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

    /// One piece with a border and no handle: a disk once its holes are filled.
    pub fn is_chartable(&self) -> bool {
        matches!(&self.pieces[..], [piece] if piece.is_chartable())
    }

    /// The piece of the largest area, the first of equal ones; counted from 0.
    pub fn largest(&self) -> Option<usize> {
        let area = |&i: &usize| self.pieces[i].area;
        // `max_by` takes the last of equal ones.
        (0..self.pieces.len()).rev().max_by(|i, j| area(i).total_cmp(&area(j)))
    }

    /// The steps that would make one piece with a border and no handle of it; none if it
    /// is one.
    ///
    /// Where there are several pieces, what is said of borders and handles is about the
    /// largest, which `--component largest` keeps.
    pub fn advice(&self) -> Vec<String> {
        let Some(largest) = self.largest() else {
            return vec!["export the surface again: it has no triangles".into()];
        };
        let piece = &self.pieces[largest];
        let mut advice = Vec::new();
        if self.pieces.len() > 1 {
            advice.push(format!(
                "keep one piece with --component largest (piece {}), or --component N with its \
                 number in the table",
                largest + 1
            ));
        }
        if piece.genus > 0 {
            advice.push(
                "keep a part without handles with --cut z=50%, or as high as it takes, or let \
                 its own polygons be the pattern with --pattern mesh"
                    .into(),
            );
        } else if piece.borders.is_empty() {
            advice.push(
                "cut the closed surface open with --cut z=30%, which keeps what lies above 30 % \
                 of its height, or let its own polygons be the pattern with --pattern mesh"
                    .into(),
            );
        }
        advice
    }

    /// The [`advice`](Self::advice) in one sentence.
    pub fn hint(&self) -> String {
        self.advice().join("; then ")
    }
}

fn measure(mesh: &Mesh, piece_of: &IdVec<FaceId, usize>, count: usize) -> Vec<Piece> {
    let far = f64::INFINITY;
    let empty = Piece {
        triangles: 0,
        area: 0.0,
        borders: Vec::new(),
        genus: 0,
        bounds: [Point3::new(far, far, far), Point3::new(-far, -far, -far)],
    };
    let mut pieces = vec![empty; count];
    for (face, &p) in piece_of.enumerate() {
        let piece = &mut pieces[p];
        piece.triangles += 1;
        piece.area += 0.5 * mesh.area_vector(face).norm();
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
        for h in topology.fan(start) {
            seen[h] = true;
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

impl Shape {
    /// The pieces that the table shows, in order: the largest, if there are too many.
    fn shown(&self) -> Vec<usize> {
        let mut shown: Vec<usize> = (0..self.pieces.len()).collect();
        // A stable sort: of equal pieces the first are shown.
        shown.sort_by(|&i, &j| self.pieces[j].area.total_cmp(&self.pieces[i].area));
        shown.truncate(ROWS);
        shown.sort_unstable();
        shown
    }
}

/// A table with a line for each piece, numbered from 1, and the places of holes.
impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "  piece  triangles  loops  genus  {:>10}  size, mm", "area, mm²")?;
        for i in self.shown() {
            let p = &self.pieces[i];
            let size = p.bounds[1] - p.bounds[0];
            write!(
                f,
                "\n  {:>5}  {:>9}  {:>5}  {:>5}  {:>10}  {} x {} x {} ({})",
                i + 1,
                p.triangles,
                p.borders.len(),
                p.genus,
                short(p.area),
                short(size.x),
                short(size.y),
                short(size.z),
                p.kind(),
            )?;
        }
        if self.pieces.len() > ROWS {
            let more = counted(self.pieces.len() - ROWS, "smaller piece", "smaller pieces");
            write!(f, "\n  and {more}")?;
        }
        let holes: Vec<&Border> = self.pieces.iter().flat_map(Piece::holes).collect();
        for hole in holes.iter().take(HOLES) {
            write!(f, "\n  hole of {} edges around {}", hole.edges, place(hole.centre))?;
        }
        if holes.len() > HOLES {
            write!(f, "\n  and {}", counted(holes.len() - HOLES, "more hole", "more holes"))?;
        }
        Ok(())
    }
}
