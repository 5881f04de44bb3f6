//! Keeps one piece of a surface.

use crate::ids::{FaceId, Id, IdVec, VertexId};
use crate::surface::faces::renumbered;
use crate::surface::polygons::PolygonMesh;
use crate::surface::shape::{Shape, counted};
use crate::surface::topology::{Topology, TopologyError};
use crate::surface::{Mesh, Point3};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use std::str::FromStr;

/// Which piece of a surface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Component {
    /// The one of the largest area, the first of equal ones.
    Largest,
    /// The one of this number, counted from 1 as in the table of [`Shape`].
    Number(usize),
}

/// Why a piece cannot be kept.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ComponentError {
    /// The surface has no sound pieces.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// There is no piece of this number.
    #[error("there is no piece {number}: the surface has {}\n{shape}",
        counted(shape.pieces.len(), "piece", "pieces"))]
    Missing {
        /// The number asked for.
        number: usize,
        /// The pieces that there are.
        shape: Shape,
    },
}

impl ComponentError {
    /// What to try.
    pub fn hint(&self) -> String {
        match self {
            Self::Topology(e) => e.hint(),
            Self::Missing { .. } => {
                "take a number from the table, or --component largest; pieces are counted \
                 after --cut"
                    .into()
            }
        }
    }
}

/// The piece as a mesh of its own. Triangles and vertices keep their order; vertices
/// without triangles are left out.
///
/// # Errors
/// A piece that is not there, or a mesh without sound connectivity.
pub fn keep(mesh: &Mesh, component: Component) -> Result<Mesh, ComponentError> {
    let topology = Topology::new(mesh)?;
    let (piece_of, _) = topology.components();
    let wanted = chosen(mesh, &topology, component)?;
    Ok(part(mesh, |face| piece_of[face] == wanted))
}

/// The number of the piece asked for, counted from 0.
fn chosen(mesh: &Mesh, topology: &Topology, component: Component) -> Result<usize, ComponentError> {
    let shape = Shape::new(mesh, topology);
    let (wanted, number) = match component {
        Component::Number(n) => (n.checked_sub(1), n),
        Component::Largest => (shape.largest(), 1),
    };
    match wanted.filter(|&w| w < shape.pieces.len()) {
        Some(wanted) => Ok(wanted),
        None => Err(ComponentError::Missing { number, shape }),
    }
}

/// The same of a mesh of polygons, faces and vertices in their order.
///
/// # Errors
/// As [`keep`].
pub fn keep_polygons(
    mesh: &PolygonMesh,
    component: Component,
) -> Result<PolygonMesh, ComponentError> {
    let triangles = mesh.triangles();
    let topology = Topology::new(&triangles)?;
    let (piece_of, _) = topology.components();
    let wanted = chosen(&triangles, &topology, component)?;
    // Each face gives two triangles less than it has corners, in the order of the faces.
    let mut first = 0;
    let in_piece = |face: &&Vec<VertexId>| {
        let piece = piece_of[FaceId::new(first)];
        first += face.len() - 2;
        piece == wanted
    };
    Ok(part_of_polygons(mesh, mesh.faces.iter().filter(in_piece)))
}

/// The faces that are wanted, and the vertices that they use, in their order.
pub(super) fn part_of_polygons<'a>(
    mesh: &PolygonMesh,
    wanted: impl Iterator<Item = &'a Vec<VertexId>>,
) -> PolygonMesh {
    let kept: Vec<&Vec<VertexId>> = wanted.collect();
    let (points, new) = used(&mesh.points, kept.iter().flat_map(|f| f.iter()));
    let faces = kept.iter().map(|f| f.iter().map(|&v| new[v]).collect()).collect();
    PolygonMesh { points, faces }
}

/// The triangles that are wanted, and the vertices that they use, in their order.
pub(super) fn part(mesh: &Mesh, wanted: impl Fn(FaceId) -> bool) -> Mesh {
    let kept: Vec<[VertexId; 3]> =
        mesh.triangles.enumerate().filter(|(f, _)| wanted(*f)).map(|(_, t)| *t).collect();
    let (points, new) = used(&mesh.points, kept.iter().flatten());
    Mesh { points, triangles: kept.iter().map(|t| t.map(|v| new[v])).collect() }
}

/// The points of some corners, in their order, and the new number of each.
fn used<'a>(
    points: &IdVec<VertexId, Point3>,
    corners: impl Iterator<Item = &'a VertexId>,
) -> (IdVec<VertexId, Point3>, IdVec<VertexId, VertexId>) {
    let [origin, new] = renumbered(points, corners);
    (origin.iter().map(|&v| points[v]).collect(), new)
}

impl FromStr for Component {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let s = s.trim();
        match s.parse() {
            _ if s.eq_ignore_ascii_case("largest") => Ok(Self::Largest),
            Ok(n) if n > 0 => Ok(Self::Number(n)),
            _ => Err(format!("{s:?} is no piece: write largest, or a number from 1")),
        }
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Largest => f.write_str("largest"),
            Self::Number(n) => n.fmt(f),
        }
    }
}

/// As `largest` or a number.
impl Serialize for Component {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Largest => s.serialize_str("largest"),
            Self::Number(n) => n.serialize(s),
        }
    }
}

/// From a number or a text.
impl<'de> Deserialize<'de> for Component {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Raw {
            Number(i64),
            Text(String),
        }
        let text = match Raw::deserialize(d)? {
            Raw::Number(n) => n.to_string(),
            Raw::Text(t) => t,
        };
        text.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two pieces of polygons, the second larger.
    #[test]
    fn a_piece_of_polygons_keeps_its_faces_whole() {
        let square = |x: f64, side: f64| {
            [[x, 0.0], [x + side, 0.0], [x + side, side], [x, side]]
                .map(|[x, y]| Point3::new(x, y, 0.0))
        };
        let points = [square(0.0, 1.0), square(5.0, 2.0)].concat();
        let face = |first: usize| (first..first + 4).map(VertexId::new).collect();
        let mesh = PolygonMesh { points: points.into(), faces: vec![face(0), face(4)] };
        let largest = keep_polygons(&mesh, Component::Largest).expect("two pieces");
        assert_eq!(largest.faces, [face(0)]);
        assert_eq!(largest.points[VertexId::new(0)], Point3::new(5.0, 0.0, 0.0));
        assert_eq!(keep_polygons(&mesh, Component::Number(2)), Ok(largest));
        assert!(keep_polygons(&mesh, Component::Number(3)).is_err());
    }

    use crate::surface::{Point3, samples};

    /// A small vault, the igloo, and the vault once more; some vertices are not used.
    fn three() -> Mesh {
        let (vault, dome) = (sample("vault"), sample("igloo"));
        let mut all = Mesh::default();
        all.points.push(Point3::origin());
        for (mesh, shift) in [(&vault, 0.0), (&dome, 900.0), (&vault, 1800.0)] {
            let first = all.points.len();
            for p in &mesh.points {
                all.points.push(Point3::new(p.x + shift, p.y, p.z));
            }
            for t in &mesh.triangles {
                all.triangles.push(t.map(|v| VertexId::new(v.index() + first)));
            }
            all.points.push(Point3::origin());
        }
        all
    }

    fn sample(name: &str) -> Mesh {
        samples::sample(name).expect("a sample")
    }

    #[test]
    fn each_piece_comes_out_as_it_went_in() {
        let all = three();
        assert_eq!(keep(&all, Component::Number(1)), Ok(sample("vault")));
        let dome = keep(&all, Component::Number(2)).expect("there");
        assert_eq!(dome.triangles, sample("igloo").triangles);
        assert_eq!(keep(&all, Component::Largest), Ok(dome.clone()), "by area");
        assert_eq!(keep(&dome, Component::Largest), Ok(dome));
    }

    #[test]
    fn a_piece_that_is_not_there_is_refused_with_the_table() {
        for number in [0, 4, usize::MAX] {
            let error = keep(&three(), Component::Number(number)).expect_err("not there");
            let text = error.to_string();
            assert!(text.contains("the surface has 3 pieces\n  piece  triangles"), "{text}");
        }
        assert!(keep(&Mesh::default(), Component::Largest).is_err());
        assert!(keep(&Mesh::default(), Component::Number(1)).is_err());
    }

    #[test]
    fn names_are_read_and_shown() {
        for (text, component) in [("largest", Component::Largest), ("3", Component::Number(3))] {
            assert_eq!(text.parse(), Ok(component));
            assert_eq!(component.to_string(), text);
            let json = serde_json::to_string(&component).expect("a name");
            assert_eq!(serde_json::from_str::<Component>(&json).expect("itself"), component);
        }
        for bad in ["0", "-1", "", "two", "1.5"] {
            assert!(bad.parse::<Component>().is_err(), "{bad}");
        }
        assert!(serde_json::from_str::<Component>("0").is_err());
        assert_eq!(serde_json::from_str::<Component>("\"2\"").ok(), Some(Component::Number(2)));
    }
}
