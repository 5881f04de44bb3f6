//! Sample surfaces made by formula: mm, z up, ground at z = 0.
//!
//! Each is a struct of named measures with one constant, the sample, and a function
//! that gives its mesh; change the measures to make a shape of your own. To add one,
//! write another and give it a line in `TABLE`. The meshes come from a few [`grid`]s
//! that keep triangles near equilateral; the tests hold every sample to that.
//!
//! [`dome`], [`hall`], [`body`], [`vessel`], [`sheet`] and [`ring`] are the families. The igloo,
//! the free forms and the animals are after those of Song and others (2013), Fig. 18
//! and 20, in likeness, not in measure.

pub mod body;
pub mod dome;
pub mod grid;
pub mod hall;
pub mod ring;
pub mod sheet;
pub mod vessel;

#[cfg(test)]
mod tests;

use crate::surface::Mesh;
use crate::surface::polygons::PolygonMesh;

struct Sample {
    name: &'static str,
    about: &'static str,
    build: fn() -> Mesh,
}

const fn row(name: &'static str, about: &'static str, build: fn() -> Mesh) -> Sample {
    Sample { name, about, build }
}

const TABLE: [Sample; 13] = [
    row("igloo", "dome on a round plan, 600 mm across, 220 mm high, steeper at the rim", || {
        dome::Igloo::SAMPLE.mesh()
    }),
    row("ellipsoid", "top of an ellipsoid, 692 x 475 mm, 178 mm high", || {
        dome::Ellipsoid::SAMPLE.mesh()
    }),
    row("bridge", "arched footbridge, 885 x 372 mm, 247 mm high, slimmer in the middle", || {
        hall::Bridge::SAMPLE.mesh()
    }),
    row("hut", "hut with a soft hipped roof, 643 x 490 mm, 253 mm high", || {
        dome::Hut::SAMPLE.mesh()
    }),
    row("train-station", "free-form hall open at both ends, 900 x 450 mm, 220 mm high", || {
        hall::TrainStation::SAMPLE.mesh()
    }),
    row("peanut", "peanut on its side, 760 x 326 mm, 163 mm high", || body::Peanut::SAMPLE.mesh()),
    row("vase", "vase upside down, 620 mm across, 220 mm high, with a waist", || {
        vessel::Vase::SAMPLE.mesh()
    }),
    row("seashell", "scallop with gentle flutes, 509 x 501 mm, 220 mm high near the hinge", || {
        vessel::Seashell::SAMPLE.mesh()
    }),
    row("small-bug", "beetle of body and head, 635 x 410 mm, 180 mm high", || {
        body::SMALL_BUG.mesh()
    }),
    row("super-bug", "beetle of abdomen, thorax and head, 890 x 430 mm, 190 mm high", || {
        body::SUPER_BUG.mesh()
    }),
    row("flat", "flat sheet, 600 x 600 mm", || sheet::Flat::SAMPLE.mesh()),
    row("saddle", "saddle, 600 x 600 mm, 160 mm high", || sheet::Saddle::SAMPLE.mesh()),
    row("vault", "barrel vault, 600 mm long, 400 mm across, 168 mm high", || {
        hall::Vault::SAMPLE.mesh()
    }),
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

/// Names of the samples that are polygons to be used as they are.
pub const POLYGONS: [(&str, &str); 1] =
    [("ring", "closed ring of 96 hexagons, 700 mm across, 160 mm high, for --pattern mesh")];

/// A sample of polygons by name.
pub fn sample_polygons(name: &str) -> Option<PolygonMesh> {
    (name == POLYGONS[0].0).then(|| ring::Ring::SAMPLE.polygons())
}

/// A sample surface by name.
pub fn sample(name: &str) -> Option<Mesh> {
    TABLE.iter().find(|s| s.name == name).map(|s| (s.build)())
}
