//! DXF files of things in space, mm, z up; drawings become DXF in [`drawing::dxf`](crate::drawing::dxf).

use super::structure::Structure;
use crate::drawing::dxf::{Document, Kind, Layer};
use crate::surface::Mesh;

/// Colour indices of the classes in turn: those that are told apart on dark and on light
/// screens.
const COLORS: [u8; 7] = [Layer::BLACK, 5, 30, 3, 6, 1, 4];

/// The axes of the rods from end A to end B, as lines on a layer for each class: the text of
/// a DXF file.
pub fn axes_dxf(structure: &Structure) -> String {
    let mut document = Document::default();
    for rod in &structure.rods {
        let color = COLORS[document.layers.len() % COLORS.len()];
        let layer = document.layer(&format!("CLASS {}", rod.class), color);
        layer.add(layer.color, Kind::Line([rod.a, rod.b]));
    }
    document.layers.sort_by(|a, b| (a.name.len(), &a.name).cmp(&(b.name.len(), &b.name)));
    document.to_string()
}

/// The triangles of a surface as faces: the text of a DXF file.
pub fn mesh_dxf(mesh: &Mesh) -> String {
    let mut document = Document::default();
    let layer = document.layer("SURFACE", Layer::BLACK);
    for face in mesh.triangles.ids() {
        layer.add(layer.color, Kind::Face(mesh.corners(face).map(|p| [p.x, p.y, p.z])));
    }
    document.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::{fixture, lengths::classes};

    #[test]
    fn every_axis_is_a_line_on_the_layer_of_its_class() {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let classes = classes(&frame);
        let structure = Structure::from_frame(&frame, &classes, &[]);
        let text = axes_dxf(&structure);
        assert_eq!(text.matches("\nLINE\n").count(), structure.rods.len());
        for rod in &structure.rods {
            let layer = format!("\nAcDbEntity\n  8\nCLASS {}\n", rod.class);
            assert!(text.contains(&layer), "{layer}");
        }
    }

    #[test]
    fn every_triangle_is_a_face_with_its_last_corner_twice() {
        let mesh = crate::surface::samples::sample("flat").expect("a sample");
        let text = mesh_dxf(&mesh);
        let lines: Vec<&str> = text.lines().collect();
        let at = lines.iter().position(|l| *l == "AcDbFace").expect("a face");
        assert_eq!(lines[at + 13], " 12");
        let corner = |k: usize| [lines[at + k + 1], lines[at + k + 3], lines[at + k + 5]];
        assert_eq!(corner(13), corner(19));
        assert_ne!(corner(13), corner(7));
        assert_eq!(text.matches("\n3DFACE\n").count(), mesh.triangles.len());
    }
}
