//! Every sample through every format and back.

use super::*;
use crate::surface::read::read_bytes;
use crate::surface::{Point3, samples};
use clap::ValueEnum;

/// Formats that are read as well: their files must come back as the same triangles.
const READ_BACK: [Format; 8] = [
    Format::Obj,
    Format::Stl,
    Format::StlAscii,
    Format::Ply,
    Format::PlyAscii,
    Format::Off,
    Format::Glb,
    Format::Gltf,
];

/// Single precision holds 24 binary digits; scaling to metres and back rounds twice more.
const SINGLE: f64 = 2.0 / (1 << 24) as f64;

/// A surface in a format for surfaces.
fn surface(mesh: &Mesh, format: Format) -> Vec<u8> {
    surface_file(mesh, format).expect("a file").expect("a format for surfaces")
}

#[test]
fn surfaces_are_written_in_the_formats_that_are_said_to_be_for_them() {
    let mesh = samples::sample("flat").expect("a sample");
    for format in Format::all() {
        let file = surface_file(&mesh, format).expect("no error");
        assert_eq!(file.is_some(), format.is_for_surfaces(), "{format}");
    }
}

#[test]
fn names_and_endings_lead_to_formats() {
    for format in Format::all() {
        let value = format.to_possible_value().expect("not hidden");
        assert_eq!(value.get_name(), format.to_string());
    }
    assert_eq!(Format::all().count(), Format::value_variants().len());
    for (file, format) in [
        ("a.obj", Some(Format::Obj)),
        ("b/a.STL", Some(Format::Stl)),
        ("a.gltf", Some(Format::Gltf)),
        ("a.stl-ascii", None),
        ("obj", None),
        ("a.3mf", None),
    ] {
        assert_eq!(Format::of_file(Path::new(file)), format, "{file}");
    }
}

#[test]
fn every_sample_comes_back_from_every_format() {
    for (name, _) in samples::NAMES {
        let mesh = samples::sample(name).expect("listed");
        for format in READ_BACK {
            let bytes = surface(&mesh, format);
            let back = read_bytes(&format.to_string(), &bytes, None).expect("read").mesh;
            assert_eq!(back.triangles.len(), mesh.triangles.len(), "{name} {format}");
            for face in mesh.triangles.ids() {
                for (p, q) in mesh.corners(face).iter().zip(back.corners(face)) {
                    assert_same(*p, q, format);
                }
            }
            // Writing again what was read gives the same file.
            assert!(surface(&back, format) == bytes, "{name} {format}");
        }
    }
}

fn assert_same(p: Point3, q: Point3, format: Format) {
    if format.is_single() {
        let within = SINGLE * p.coords.abs().max();
        assert!((p - q).abs().max() <= within, "{format}: {p} {q}");
    } else {
        assert_eq!(p, q, "{format}");
    }
}

/// Numbers of a text behind words that are left out, line by line.
fn numbers<'a>(text: &'a str, word: &'a str) -> Vec<[f64; 3]> {
    let lines = text.lines().filter_map(|l| l.trim_start().strip_prefix(word));
    lines
        .map(|l| {
            let n: Vec<f64> = l.split_whitespace().map(|x| x.parse().expect("a number")).collect();
            n.try_into().expect("three numbers")
        })
        .collect()
}

fn corners(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.triangles.ids().flat_map(|f| mesh.corners(f)).map(|p| [p.x, p.y, p.z]).collect()
}

#[test]
fn both_forms_of_stl_hold_the_corners_in_order() {
    let mesh = samples::sample("train-station").expect("a sample");
    let text = String::from_utf8(surface(&mesh, Format::StlAscii));
    assert_eq!(numbers(&text.expect("text"), "vertex "), corners(&mesh));
    let bytes = surface(&mesh, Format::Stl);
    let float = |b: &[u8]| f64::from(f32::from_le_bytes(b.try_into().expect("four bytes")));
    let found: Vec<[f64; 3]> = bytes[84..]
        .chunks(50)
        .flat_map(|t| t[12..48].chunks(12))
        .map(|p| [float(&p[..4]), float(&p[4..8]), float(&p[8..])])
        .collect();
    let expected: Vec<[f64; 3]> =
        corners(&mesh).iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
    assert_eq!(found, expected);
}

#[test]
fn ply_and_off_hold_vertices_and_triangles_in_order() {
    let mesh = samples::sample("saddle").expect("a sample");
    let (vertices, faces) = (mesh.points.len(), mesh.triangles.len());
    let points: Vec<[f64; 3]> = mesh.points.iter().map(|p| [p.x, p.y, p.z]).collect();
    let indices: Vec<[f64; 3]> =
        mesh.triangles.iter().map(|t| t.map(|v| crate::ids::Id::index(v) as f64)).collect();
    for (format, head) in [(Format::PlyAscii, 10), (Format::Off, 2)] {
        let text = String::from_utf8(surface(&mesh, format)).expect("text");
        let lines: Vec<&str> = text.lines().skip(head).collect();
        assert_eq!(lines.len(), vertices + faces);
        assert_eq!(numbers(&lines[..vertices].join("\n"), ""), points, "{format}");
        assert_eq!(numbers(&lines[vertices..].join("\n"), "3 "), indices, "{format}");
    }
    let bytes = surface(&mesh, Format::Ply);
    let body = &bytes[bytes.len() - 24 * vertices - 13 * faces..];
    let double = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
    let found: Vec<f64> = body[..24 * vertices].chunks(8).map(double).collect();
    assert_eq!(found, points.concat());
    let index = |b: &[u8]| f64::from(u32::from_le_bytes(b.try_into().expect("four bytes")));
    let found: Vec<f64> =
        body[24 * vertices..].chunks(13).flat_map(|t| t[1..].chunks(4).map(index)).collect();
    assert_eq!(found, indices.concat());
}

#[test]
fn rounding_far_from_the_origin_is_told() {
    let mut mesh = samples::sample("flat").expect("a sample");
    assert!(worst_rounding(&mesh) < 1e-4);
    mesh.points.iter_mut().for_each(|p| p.x += 5e8);
    assert!(worst_rounding(&mesh) > 1.0);
}
