//! Turns a surface whose file has another axis up.

use crate::surface::mend::{MendError, mend};
use crate::surface::{Mesh, Point3};
use std::fmt;
use std::str::FromStr;

/// The axis of a file that points up.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// x is up.
    X,
    /// y is up, as in many animation programs.
    Y,
    /// z is up, as in most drawing and building programs.
    #[default]
    Z,
}

impl Up {
    /// Turns a point so that this axis becomes z: a rotation, never a mirror image.
    pub fn upright(self, p: Point3) -> Point3 {
        match self {
            Self::X => Point3::new(p.y, p.z, p.x),
            Self::Y => Point3::new(p.x, -p.z, p.y),
            Self::Z => p,
        }
    }
}

impl FromStr for Up {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        match s {
            "x" | "X" => Ok(Self::X),
            "y" | "Y" => Ok(Self::Y),
            "z" | "Z" => Ok(Self::Z),
            other => Err(format!("{other:?} is no axis: x, y or z")),
        }
    }
}

impl fmt::Display for Up {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        })
    }
}

/// Turns a mended mesh so that `up` becomes z, and its pieces so that they face up.
///
/// # Errors
/// None on a mesh that [`mend`] has passed already.
pub fn upright(mesh: &Mesh, up: Up) -> Result<Mesh, MendError> {
    let points = mesh.points.iter().map(|&p| up.upright(p)).collect();
    Ok(mend(Mesh { points, triangles: mesh.triangles.clone() })?.mesh)
}

/// A point that was read with y up, in the axes of its file.
pub fn file_axes(p: Point3) -> Point3 {
    Point3::new(p.x, p.z, -p.y)
}

/// Turns a mesh that was read with y up back to the axes of its file, so that another
/// axis can be taken as up.
pub fn with_file_axes(mesh: &Mesh) -> Mesh {
    let points = mesh.points.iter().map(|&p| file_axes(p)).collect();
    Mesh { points, triangles: mesh.triangles.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::samples;

    #[test]
    fn each_axis_becomes_z_and_handedness_stays() {
        let [x, y, z] =
            [Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0), Point3::new(0.0, 0.0, 1.0)];
        for (up, axis) in [(Up::X, x), (Up::Y, y), (Up::Z, z)] {
            assert_eq!(up.upright(axis), z);
            let turned = [x, y, z].map(|p| up.upright(p).coords);
            assert_eq!(turned[0].cross(&turned[1]).dot(&turned[2]), 1.0);
            assert_eq!(up.to_string().parse(), Ok(up));
        }
        assert!("w".parse::<Up>().is_err());
    }

    #[test]
    fn a_dome_laid_on_its_side_stands_up_again() {
        let dome = samples::sample("igloo").expect("a sample");
        assert_eq!(upright(&with_file_axes(&dome), Up::Y), Ok(dome));
    }
}
