//! Sample surfaces made by formula: mm, z up, ground at z = 0.
//!
//! To add one, write a function that returns a [`Mesh`] and give it a line in
//! `TABLE`. Meshes come from two grids: [`strip`], rows across a four-sided patch,
//! and [`revolve`], rings round an axis. Both keep triangles near equilateral; the
//! tests hold every sample to that.

use crate::ids::{IdVec, VertexId};
use crate::surface::{Mesh, Point3};
use std::f64::consts::{PI, TAU};

struct Sample {
    name: &'static str,
    about: &'static str,
    build: fn() -> Mesh,
}

const TABLE: [Sample; 5] = [
    Sample {
        name: "igloo",
        about: "dome on a round plan, 600 mm across, 220 mm high, steeper at the rim",
        build: igloo,
    },
    Sample {
        name: "train-station",
        about: "free-form hall open at both ends, 900 x 450 mm, 220 mm high",
        build: train_station,
    },
    Sample { name: "flat", about: "flat sheet, 600 x 600 mm", build: flat },
    Sample { name: "saddle", about: "saddle, 600 x 600 mm, 160 mm high", build: saddle },
    Sample {
        name: "vault",
        about: "barrel vault, 600 mm long, 400 mm across, 168 mm high",
        build: vault,
    },
];

/// Names of the samples, each with a line on what it is.
pub const NAMES: [(&str, &str); TABLE.len()] = {
    let mut names = [("", ""); TABLE.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = (TABLE[i].name, TABLE[i].about);
        i += 1;
    }
    names
};

/// A sample surface by name.
pub fn sample(name: &str) -> Option<Mesh> {
    TABLE.iter().find(|s| s.name == name).map(|s| (s.build)())
}

/// A spherical cap that runs over, with the same tangent, into a rim of smaller
/// radius: the profile of an igloo.
///
/// Angles are those of the surface against the ground. Ground radius a, height h, rim
/// radius r and angle at the ground β are given. With cap radius R and the angle α
/// where the two arcs meet,
///
/// ```text
/// (R - r) sin α       = a - r sin β
/// (R - r) (1 - cos α) = h - r (1 - cos β)
/// ```
///
/// whose quotient is tan(α / 2).
struct Dome {
    cap_radius: f64,
    rim_radius: f64,
    joint: f64,
    foot: f64,
}

impl Dome {
    fn new(ground_radius: f64, height: f64, rim_radius: f64, foot: f64) -> Self {
        let across = ground_radius - rim_radius * foot.sin();
        let up = height - rim_radius * (1.0 - foot.cos());
        let joint = 2.0 * (up / across).atan();
        Self { cap_radius: rim_radius + across / joint.sin(), rim_radius, joint, foot }
    }

    /// Length of the profile from the top to the ground.
    fn length(&self) -> f64 {
        self.cap_radius * self.joint + self.rim_radius * (self.foot - self.joint)
    }

    /// Distance from the axis and height above the ground at `s` from the top.
    fn profile(&self, s: f64) -> [f64; 2] {
        let (big, small) = (self.cap_radius, self.rim_radius);
        let cap = big * self.joint;
        let sink = big - small;
        let (radius, below_top) = if s <= cap {
            let angle = s / big;
            (big * angle.sin(), big * (1.0 - angle.cos()))
        } else {
            let angle = self.joint + (s - cap) / small;
            let (sin, cos) = angle.sin_cos();
            (
                sink * self.joint.sin() + small * sin,
                sink * (1.0 - self.joint.cos()) + small * (1.0 - cos),
            )
        };
        let height = sink * (1.0 - self.joint.cos()) + small * (1.0 - self.foot.cos());
        [radius, height - below_top]
    }
}

fn igloo() -> Mesh {
    let dome = Dome::new(300.0, 220.0, 120.0, 82_f64.to_radians());
    revolve(dome.length(), 14.0, |s| dome.profile(s))
}

/// Cross-sections are arcs of ellipses, 80° to either side of the top; width and
/// height swell along the hall, most a little past its middle.
fn train_station() -> Mesh {
    let reach = 80_f64.to_radians();
    strip([900.0, 610.0], 15.0, |u, v| {
        let swell = (0.75 * (u - 0.55)).cos().powi(3);
        let (half_width, height) = (225.0 * swell, 220.0 * swell);
        let (sin, cos) = (reach * (2.0 * v - 1.0)).sin_cos();
        let y = half_width * sin / reach.sin();
        let z = height * (cos - reach.cos()) / (1.0 - reach.cos());
        Point3::new(900.0 * (u - 0.5), y, z)
    })
}

fn flat() -> Mesh {
    strip([600.0, 600.0], 12.0, |u, v| Point3::new(600.0 * u - 300.0, 600.0 * v - 300.0, 0.0))
}

/// A hyperbolic paraboloid, high along x.
fn saddle() -> Mesh {
    strip([620.0, 620.0], 12.5, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        Point3::new(300.0 * x, 300.0 * y, 80.0 * (1.0 + x * x - y * y))
    })
}

/// An arc of a circle, 80° to either side of the top.
fn vault() -> Mesh {
    let reach = 80_f64.to_radians();
    let radius = 200.0 / reach.sin();
    strip([600.0, 2.0 * reach * radius], 12.0, |u, v| {
        let (sin, cos) = (reach * (2.0 * v - 1.0)).sin_cos();
        Point3::new(600.0 * (u - 0.5), radius * sin, radius * (cos - reach.cos()))
    })
}

/// Height of an equilateral triangle of side 1.
const ROW: f64 = 0.866_025_403_784_438_6;

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
        let mut outer = add_row(&mut mesh, &points);
        outer.push(outer[0]);
        zip(&mut mesh, &outer, &inner);
        inner = outer;
    }
    mesh
}

fn whole(x: f64) -> usize {
    (x.round() as usize).max(1)
}

fn add_row(mesh: &mut Mesh, points: &[Point3]) -> Vec<VertexId> {
    points.iter().map(|&p| mesh.points.push(p)).collect()
}

/// Triangles between two rows of points. Seen from the side of the normal, both run to
/// the right and `high` lies above `low`. At each step the shorter diagonal is taken.
fn zip(mesh: &mut Mesh, low: &[VertexId], high: &[VertexId]) {
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
struct Even {
    /// Length up to each knot, as a share of the whole.
    shares: Vec<f64>,
}

/// Chords per curve: enough that the spacing of some fifty points is even to 1e-4.
const CHORDS: usize = 1000;

impl Even {
    fn new(curve: impl Fn(f64) -> Point3) -> Self {
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
        Self { shares }
    }

    /// The curve's parameter at a share of its length.
    fn parameter(&self, share: f64) -> f64 {
        let k = self.shares.partition_point(|&s| s < share).clamp(1, CHORDS);
        let (a, b) = (self.shares[k - 1], self.shares[k]);
        ((k - 1) as f64 + ((share - a) / (b - a)).clamp(0.0, 1.0)) / CHORDS as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::shape::Shape;
    use crate::surface::topology::require_disk;

    fn each() -> impl Iterator<Item = (&'static str, Mesh)> {
        NAMES.iter().map(|(name, _)| (*name, sample(name).expect("listed")))
    }

    fn smallest_angle(mesh: &Mesh) -> f64 {
        let angles = mesh.triangles.ids().flat_map(|f| {
            let c = mesh.corners(f);
            (0..3)
                .map(move |k| (c[(k + 1) % 3] - c[k]).angle(&(c[(k + 2) % 3] - c[k])).to_degrees())
        });
        angles.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn unknown_names_are_no_sample() {
        assert_eq!(sample("Igloo"), None);
    }

    #[test]
    fn every_sample_is_a_disk_on_the_ground_with_good_triangles() {
        for (name, mesh) in each() {
            let topology = require_disk(&mesh).expect(name);
            assert!(Shape::new(&mesh, &topology).is_disk());
            assert!((3000..=8000).contains(&mesh.triangles.len()), "{name}");
            let angle = smallest_angle(&mesh);
            println!("{name}: {} triangles, smallest angle {angle:.1} deg", mesh.triangles.len());
            assert!(angle > 35.0, "{name}: {angle}");
            let low = mesh.bounds().expect("not empty")[0].z;
            assert!(low.abs() < 1e-9, "{name}: {low}");
            let up: f64 = mesh.triangles.ids().map(|f| mesh.area_vector(f).z).sum();
            assert!(up > 0.0, "{name} faces down");
        }
    }

    #[test]
    fn sizes_are_as_described() {
        let size = |name| {
            let [lo, hi] = sample(name).expect("listed").bounds().expect("not empty");
            hi - lo
        };
        let near = |name, x, y, z, within| {
            let d = size(name) - nalgebra::Vector3::new(x, y, z);
            assert!(d.amax() < within, "{name}: {:?}", size(name));
        };
        near("igloo", 600.0, 600.0, 220.0, 0.5);
        near("train-station", 900.0, 450.0, 220.0, 1.0);
        near("flat", 600.0, 600.0, 0.0, 1e-9);
        near("saddle", 600.0, 600.0, 160.0, 1e-9);
        near("vault", 600.0, 400.0, 167.8, 0.1);
    }

    #[test]
    fn the_dome_has_no_kink_and_meets_the_ground_as_steeply_as_asked() {
        let dome = Dome::new(300.0, 220.0, 120.0, 82_f64.to_radians());
        let length = dome.length();
        let slope = |s: f64| {
            let [[r0, z0], [r1, z1]] = [dome.profile(s - 1e-4), dome.profile(s + 1e-4)];
            (z0 - z1).atan2(r1 - r0).to_degrees()
        };
        let joint = dome.cap_radius * dome.joint;
        assert!((slope(joint - 0.01) - slope(joint + 0.01)).abs() < 0.02);
        assert!((slope(length) - 82.0).abs() < 1e-3);
        assert!(dome.cap_radius > 2.0 * dome.rim_radius && dome.joint < dome.foot);
        let [radius, z] = dome.profile(length);
        assert!((radius - 300.0).abs() < 1e-9 && z.abs() < 1e-9);
    }

    #[test]
    fn no_sample_but_the_saddle_bends_down_and_up() {
        // The angle defect of an inner vertex is its Gaussian curvature times its area.
        for (name, mesh) in each().filter(|(name, _)| *name != "saddle") {
            let topology = require_disk(&mesh).expect(name);
            for v in mesh.points.ids().filter(|&v| !topology.is_border(v)) {
                let angle: f64 = topology
                    .outgoing(v)
                    .map(|h| {
                        let p = mesh.points[v];
                        let to = mesh.points[topology.to(h)] - p;
                        to.angle(&(mesh.points[topology.from(h.prev())] - p))
                    })
                    .sum();
                assert!(angle < TAU + 2e-3, "{name}: {angle} at {}", mesh.points[v]);
            }
        }
    }
}
