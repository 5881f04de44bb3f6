//! Grids of near-equilateral triangles on surfaces that are given by formula.
//!
//! All are made of rows of points, joined two by two. [`strip`] has rows of one count
//! across a four-sided patch; [`rows`] counts each row by its length, so that a patch
//! may narrow, even to a point; [`revolve`] and [`rings`] have closed rows round an
//! axis or a top.

use crate::ids::{IdVec, VertexId};
use crate::surface::{Mesh, Point3};
use std::f64::consts::{PI, TAU};

/// Height of an equilateral triangle of side 1.
const ROW: f64 = 0.866_025_403_784_438_6;

/// Lines along a patch over whose mean its rows are spaced: enough for the bulges of
/// the samples; each costs as much as a row.
const LINES: usize = 24;

/// Rows shorter than this are a single point, mm: far below any edge, far above the
/// rounding at the tip of a dome.
const TIP: f64 = 1e-3;

/// A patch in rows: `place(u, v)` for u and v from 0 to 1, about `size` mm long and
/// across. Points of a row are spaced evenly in space. Every second row has one point
/// more, so that rows are in step at the sides and set off by half an edge between.
/// The normal is on the side of ∂u × ∂v.
pub fn strip(size: [f64; 2], edge: f64, place: impl Fn(f64, f64) -> Point3) -> Mesh {
    // An even number, so that there is a row half way: symmetric shapes stay so.
    let rows = 2 * whole(size[0] / (2.0 * edge * ROW));
    let across = whole(size[1] / edge);
    let points = (0..=rows).map(|row| {
        let u = row as f64 / rows as f64;
        let even = Even::new(|v| place(u, v));
        let steps = across + row % 2;
        (0..=steps).map(|j| place(u, even.parameter(j as f64 / steps as f64))).collect()
    });
    let points: Vec<Vec<Point3>> = points.collect();
    let mut mesh = Mesh::default();
    let rows: Vec<Vec<VertexId>> = points.iter().map(|r| add_row(&mut mesh, r)).collect();
    for pair in rows.windows(2) {
        zip(&mut mesh, &pair[1], &pair[0]);
    }
    mesh
}

/// A patch in rows like [`strip`], with as many edges in a row as it has room for, odd
/// and even in turn. Rows without length, at either end, become a point.
pub fn rows(edge: f64, place: impl Fn(f64, f64) -> Point3) -> Mesh {
    let lines = (0..LINES).map(|i| {
        let v = (i as f64 + 0.5) / LINES as f64;
        Even::new(|u| place(u, v))
    });
    let along = Even::mean(lines);
    let count = 2 * whole(along.length / (2.0 * edge * ROW));
    let mut mesh = Mesh::default();
    let mut before: Vec<VertexId> = Vec::new();
    for row in 0..=count {
        let u = along.parameter(row as f64 / count as f64);
        let across = Even::new(|v| place(u, v));
        let odd = row % 2;
        let steps = 2 * whole((across.length / edge - odd as f64) / 2.0) + odd;
        let points: Vec<Point3> = if across.length < TIP {
            vec![place(u, 0.5)]
        } else {
            (0..=steps).map(|j| place(u, across.parameter(j as f64 / steps as f64))).collect()
        };
        let now = add_row(&mut mesh, &points);
        zip(&mut mesh, &now, &before);
        before = now;
    }
    mesh
}

/// A surface of revolution: `profile(s)` gives distance from the axis and height at s
/// along the profile, from 0 on the axis to `length`. Rings have as many points as
/// they have room for. The normal is up at the top.
pub fn revolve(length: f64, edge: f64, profile: impl Fn(f64) -> [f64; 2]) -> Mesh {
    let rings = whole(length / (edge * ROW));
    let mut mesh = Mesh::default();
    let top = profile(0.0)[1];
    let mut inner = vec![mesh.points.push(Point3::new(0.0, 0.0, top))];
    for ring in 1..=rings {
        let [radius, z] = profile(length * ring as f64 / rings as f64);
        let count = whole(TAU * radius / edge).max(6);
        // Half a step of turn from ring to ring where the counts agree.
        let turn = PI * (ring % 2) as f64 / count as f64;
        let points: Vec<Point3> = (0..count)
            .map(|i| {
                let (sin, cos) = (turn + TAU * i as f64 / count as f64).sin_cos();
                Point3::new(radius * cos, radius * sin, z)
            })
            .collect();
        inner = add_ring(&mut mesh, &points, &inner);
    }
    mesh
}

/// Closed rings round a top: `place(s, v)` for s from 0 at the top to 1 at the rim, and
/// v from 0 to 1 round it, counter-clockwise from above. The normal is up at the top.
pub fn rings(edge: f64, place: impl Fn(f64, f64) -> Point3) -> Mesh {
    let lines = (0..LINES).map(|i| Even::new(|s| place(s, i as f64 / LINES as f64)));
    let down = Even::mean(lines);
    let rings = whole(down.length / (edge * ROW));
    let mut mesh = Mesh::default();
    let mut inner = vec![mesh.points.push(place(0.0, 0.0))];
    for ring in 1..=rings {
        let s = down.parameter(ring as f64 / rings as f64);
        let round = Even::new(|v| place(s, v));
        let count = whole(round.length / edge).max(6);
        let half = 0.5 * (ring % 2) as f64;
        let points: Vec<Point3> = (0..count)
            .map(|i| place(s, round.parameter((half + i as f64) / count as f64)))
            .collect();
        inner = add_ring(&mut mesh, &points, &inner);
    }
    mesh
}

fn whole(x: f64) -> usize {
    (x.round() as usize).max(1)
}

fn add_row(mesh: &mut Mesh, points: &[Point3]) -> Vec<VertexId> {
    points.iter().map(|&p| mesh.points.push(p)).collect()
}

/// Adds a closed row round an inner one; returns it with its first point again at its end.
fn add_ring(mesh: &mut Mesh, points: &[Point3], inner: &[VertexId]) -> Vec<VertexId> {
    let mut outer = add_row(mesh, points);
    outer.push(outer[0]);
    zip(mesh, &outer, inner);
    outer
}

/// Triangles between two rows of points. Seen from the side of the normal, both run to
/// the right and `high` lies above `low`. At each step the shorter diagonal is taken.
fn zip(mesh: &mut Mesh, low: &[VertexId], high: &[VertexId]) {
    if high.is_empty() {
        return;
    }
    let distance =
        |points: &IdVec<VertexId, Point3>, a: VertexId, b: VertexId| (points[a] - points[b]).norm();
    let (mut i, mut j) = (0, 0);
    while i + 1 < low.len() || j + 1 < high.len() {
        let along_low = j + 1 == high.len()
            || (i + 1 < low.len()
                && distance(&mesh.points, low[i + 1], high[j])
                    < distance(&mesh.points, low[i], high[j + 1]));
        if along_low {
            mesh.triangles.push([low[i], low[i + 1], high[j]]);
            i += 1;
        } else {
            mesh.triangles.push([low[i], high[j + 1], high[j]]);
            j += 1;
        }
    }
}

/// Even spacing along a curve given over 0..1, by the lengths of many short chords.
pub struct Even {
    /// Length up to each knot, as a share of the whole.
    shares: Vec<f64>,
    /// The whole, mm.
    pub length: f64,
}

/// Chords per curve: enough that the spacing of some fifty points is even to 1e-4.
const CHORDS: usize = 1000;

impl Even {
    pub fn new(curve: impl Fn(f64) -> Point3) -> Self {
        let mut shares = vec![0.0];
        let mut before = curve(0.0);
        let mut length = 0.0;
        for k in 1..=CHORDS {
            let at = curve(k as f64 / CHORDS as f64);
            length += (at - before).norm();
            shares.push(length);
            before = at;
        }
        shares.iter_mut().for_each(|s| *s /= length);
        Self { shares, length }
    }

    /// Spacing that is even in the mean over several curves.
    fn mean(curves: impl Iterator<Item = Self>) -> Self {
        let mut mean = Self { shares: vec![0.0; CHORDS + 1], length: 0.0 };
        let mut count = 0.0;
        for curve in curves {
            count += 1.0;
            mean.length += curve.length;
            mean.shares.iter_mut().zip(&curve.shares).for_each(|(sum, s)| *sum += s);
        }
        mean.length /= count;
        mean.shares.iter_mut().for_each(|s| *s /= count);
        mean
    }

    /// The curve's parameter at a share of its length.
    pub fn parameter(&self, share: f64) -> f64 {
        let k = self.shares.partition_point(|&s| s < share).clamp(1, CHORDS);
        let (a, b) = (self.shares[k - 1], self.shares[k]);
        ((k - 1) as f64 + ((share - a) / (b - a)).clamp(0.0, 1.0)) / CHORDS as f64
    }
}
