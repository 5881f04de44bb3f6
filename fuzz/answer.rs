//! What every target checks: whatever the bytes, the readers answer with an error or
//! with a mesh that is sound.
//!
//! The files of the room `surface` are compiled here as they are, with what it imports. The whole crate would
//! take twenty times as long to build with the sanitizer, and none of the rest is used.

#[path = "../src/ids.rs"]
pub mod ids;
#[path = "../src/surface/mod.rs"]
pub mod surface;
#[path = "../src/units.rs"]
pub mod units;

use ids::Id;
use surface::read::{read_bytes, read_polygons_bytes};

/// Reads bytes through both front doors, without a folder.
pub fn check(bytes: &[u8]) {
    match read_bytes("fuzzed", bytes, None) {
        Ok(reading) => {
            let mesh = reading.mesh;
            let vertices = mesh.points.len();
            assert!(!mesh.triangles.is_empty());
            assert!(mesh.points.iter().all(|p| p.iter().all(|c| c.is_finite())));
            for t in mesh.triangles.iter() {
                assert!(t.iter().all(|v| v.index() < vertices));
                assert!(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
            }
        }
        Err(error) => {
            assert!(error.to_string().starts_with("fuzzed: ") && !error.hint().is_empty())
        }
    }
    match read_polygons_bytes("fuzzed", bytes, None) {
        Ok(reading) => {
            let mesh = reading.mesh;
            let vertices = mesh.points.len();
            assert!(!mesh.faces.is_empty());
            assert!(mesh.points.iter().all(|p| p.iter().all(|c| c.is_finite())));
            let mut used = vec![false; vertices];
            for face in &mesh.faces {
                assert!(face.len() >= 3);
                let mut corners: Vec<usize> = face.iter().map(|v| v.index()).collect();
                corners.iter().for_each(|&v| used[v] = true);
                corners.sort_unstable();
                corners.dedup();
                assert_eq!(corners.len(), face.len());
            }
            assert!(used.iter().all(|used| *used));
            let triangles: usize = mesh.faces.iter().map(|f| f.len() - 2).sum();
            assert_eq!(mesh.triangles().triangles.len(), triangles);
        }
        Err(error) => {
            assert!(error.to_string().starts_with("fuzzed: ") && !error.hint().is_empty())
        }
    }
}
