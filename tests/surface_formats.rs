//! The plain formats, polygons, sparse glTF, and a folder of broken files with what each
//! must be told.

use rodwright::surface::read::{
    PolygonReading, Reading, read, read_bytes, read_polygons, read_polygons_bytes,
};
use rodwright::surface::topology::require_disk;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn sound(bytes: &[u8]) -> Reading {
    read_bytes("test", bytes, None).expect("sound")
}

fn polygons(bytes: &[u8]) -> PolygonReading {
    read_polygons_bytes("test", bytes, None).expect("sound")
}

/// A square of 10 mm on the ground, in two triangles: welded, one disk, facing up.
fn assert_square(bytes: &[u8]) {
    let reading = sound(bytes);
    assert!(!reading.y_up_metres);
    let mesh = reading.mesh;
    assert_eq!((mesh.points.len(), mesh.triangles.len()), (4, 2));
    let area: f64 = mesh.triangles.ids().map(|f| 0.5 * mesh.area_vector(f).z).sum();
    assert!((area - 100.0).abs() < 1e-9, "{area}");
    require_disk(&mesh).expect("one disk");
}

// ---- STL

const FACETS: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]],
    [[0.0, 0.0, 0.0], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]],
];

fn text_stl(facets: &[[[f32; 3]; 3]]) -> String {
    let corner = |c: &[f32; 3]| format!("vertex {:e} {} {}\n", c[0], c[1], c[2]);
    let facet = |f: &[[f32; 3]; 3]| {
        let corners: String = f.iter().map(corner).collect();
        format!("facet normal 0 0 1\n outer loop\n{corners} endloop\nendfacet\n")
    };
    facets.iter().map(facet).collect()
}

fn binary_stl(start: &str) -> Vec<u8> {
    let mut bytes = start.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2_u32.to_le_bytes());
    for facet in FACETS {
        // The normal is not read: here it is no number.
        bytes.extend([f32::NAN; 3].iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend(facet.as_flattened().iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend([7, 7]);
    }
    bytes
}

#[test]
fn stl_text_in_its_variants_is_one_square() {
    let facets = text_stl(&FACETS);
    let whole = format!("solid a name\n{facets}endsolid a name\n");
    assert_square(whole.as_bytes());
    assert_square(whole.to_uppercase().as_bytes());
    assert_square(whole.replace('\n', "\r\n").as_bytes());
    assert_square(whole.replace('\n', "\r").as_bytes());
    assert_square(format!("\n  solid\n\n{facets}").as_bytes());
    let [a, b] = FACETS.map(|f| text_stl(&[f]));
    assert_square(format!("solid\n{a}endsolid\nsolid b\n{b}endsolid b\n").as_bytes());
}

#[test]
fn stl_binary_is_told_by_its_length() {
    for start in ["", "solid by a program", "ply\n", "OFF", "v 0 0 0\nf 1 2 3\n"] {
        assert_square(&binary_stl(start));
    }
}

// ---- PLY

const VERTICES: [[f64; 3]; 4] = [[0.0; 3], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0], [0.0, 10.0, 0.0]];

#[test]
fn ply_text_with_other_properties_and_elements_is_one_square() {
    let header = "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\n\
        element camera 1\nproperty list uchar float view\nproperty int number\n\
        element face 2\nproperty uchar red\nproperty list uint8 uint32 vertex_index\n\
        property list char double weights\nelement nothing 3\n\
        element vertex 4\nproperty double z\nproperty float32 quality\nproperty double y\n\
        property float64 x\nelement edge 1\nproperty int v1\nproperty int v2\nend_header\n";
    let body = "3 0.5 1 2 7\n255 3 0 1 2 0\n0 3 0 2 3 2 .5 .5\n\
        0 nan 0 0\n0 1 0 10\n\n0 1 10 10\n0 1 10 0\n0 1\n";
    let text = format!("{header}{body}");
    assert_square(text.as_bytes());
    assert_square(text.replace('\n', "\r\n").as_bytes());
}

/// One quadrilateral with numbers of the given types, in binary.
fn binary_ply(little: bool, coordinate: &str, length: &str, index: &str, end: &str) -> Vec<u8> {
    let form = if little { "little" } else { "big" };
    let header = format!(
        "ply\nformat binary_{form}_endian 1.0\nelement vertex 4\nproperty short skipped\n\
        property {coordinate} x\nproperty {coordinate} y\nproperty {coordinate} z\n\
        property list {length} short listed\nelement face 1\nproperty list {length} {index} \
        vertex_indices\nproperty float flatness\nend_header\n"
    );
    let mut bytes = header.replace('\n', end).into_bytes();
    let mut put = |kind: &str, value: f64| {
        let mut number = match kind {
            "char" | "int8" => (value as i8).to_le_bytes().to_vec(),
            "uchar" | "uint8" => (value as u8).to_le_bytes().to_vec(),
            "short" | "int16" => (value as i16).to_le_bytes().to_vec(),
            "ushort" | "uint16" => (value as u16).to_le_bytes().to_vec(),
            "int" | "int32" => (value as i32).to_le_bytes().to_vec(),
            "uint" | "uint32" => (value as u32).to_le_bytes().to_vec(),
            "float" | "float32" => (value as f32).to_le_bytes().to_vec(),
            _ => value.to_le_bytes().to_vec(),
        };
        if !little {
            number.reverse();
        }
        bytes.extend(number);
    };
    for at in VERTICES {
        put("short", -2.0);
        at.iter().for_each(|&c| put(coordinate, c));
        put(length, 1.0);
        put("short", 99.0);
    }
    put(length, 4.0);
    (0..4).for_each(|i| put(index, f64::from(i)));
    put("float", 0.5);
    bytes
}

#[test]
fn ply_binary_of_all_types_and_byte_orders_is_one_square() {
    let whole = ["char", "uchar", "short", "ushort", "int", "uint"];
    let new = ["int8", "uint8", "int16", "uint16", "int32", "uint32"];
    for little in [true, false] {
        for kind in whole.iter().chain(&new) {
            assert_square(&binary_ply(little, kind, kind, kind, "\n"));
            assert_square(&binary_ply(little, "double", kind, "int", "\n"));
        }
        for kind in ["float", "float32", "double", "float64"] {
            assert_square(&binary_ply(little, kind, "uchar", "int", "\r\n"));
            assert_square(&binary_ply(little, kind, "uchar", "int", "\r"));
        }
    }
}

#[test]
fn ply_cut_anywhere_is_refused() {
    let whole = binary_ply(true, "float", "uchar", "int", "\n");
    for length in 0..whole.len() {
        let error = read_bytes("x", &whole[..length], None).expect_err("cut short");
        assert!(!error.hint().is_empty());
    }
}

// ---- OFF

#[test]
fn off_headers_and_extra_numbers_are_understood() {
    let corners = ["0 0 0", "10 0 0", "10 10 0", "0 10 0"];
    let cases = [
        ("OFF\n4 2 5\n", "", ""),
        ("# first\n\nOFF # head\n# second\n4 2\n", " # corner", " 255 0 0"),
        ("OFF 4 2 0\n", "", " 0.5 0.5 0.5 1.0"),
        ("OFF4 2 0\n", "", " 7"),
        ("COFF\n4 2 0\n", " 255 0 0 255", ""),
        ("NOFF\r\n4 2 0\r\n", " 0 0 1", ""),
        ("STCNOFF 4 2 0\n", " 0 0 1 1 0 0 1 0.5 0.5", " 1 0 0"),
    ];
    for (header, beside, after) in cases {
        let vertices: String = corners.iter().map(|c| format!("{c}{beside}\n")).collect();
        assert_square(format!("{header}{vertices}3 0 1 2{after}\n3 0 2 3{after}\n").as_bytes());
    }
}

// ---- Polygons

const PAIR: &str = "v 0 0 0\nv 10 0 0\nv 20 0 0\nv 20 10 0\nv 10 10 0\nv 0 10 0\n";

fn corner_counts(reading: &PolygonReading) -> Vec<usize> {
    reading.mesh.faces.iter().map(Vec::len).collect()
}

#[test]
fn polygons_come_as_the_file_has_them() {
    let obj = format!("{PAIR}v 30 5 0\nf 1 2 5 6\nf 2 3 7 4 5\nf 7 3\n");
    let reading = polygons(obj.as_bytes());
    assert_eq!(corner_counts(&reading), [4, 5]);
    assert_eq!(reading.notes, ["1 face with fewer than three corners left out"]);
    let mesh = reading.mesh.triangles();
    assert_eq!(mesh, sound(obj.as_bytes()).mesh);
    require_disk(&mesh).expect("one disk");

    let off = "OFF\n4 1 0\n0 0 0\n10 0 0\n10 10 0\n0 10 0\n4 0 1 2 3\n";
    assert_eq!(corner_counts(&polygons(off.as_bytes())), [4]);
    assert_eq!(corner_counts(&polygons(&binary_ply(true, "float", "uchar", "int", "\n"))), [4]);
    assert_eq!(corner_counts(&polygons(&binary_stl(""))), [3, 3]);
}

#[test]
fn polygon_faults_are_named_with_their_line() {
    let cases = [
        ("f 1 2 5\nf 1 5 2 6\n", "line 8: the outline of the face crosses itself"),
        ("f 1 2\nf 1 2 5 1 3 4\n", "line 8: the outline of the face passes vertex 1 twice"),
    ];
    for (faces, expected) in cases {
        let error = read_polygons_bytes("x", format!("{PAIR}{faces}").as_bytes(), None);
        let message = error.expect_err("broken").to_string();
        assert!(message.ends_with(expected), "{message}");
    }
}

#[test]
fn a_sample_has_the_same_triangles_through_both_doors() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/igloo.obj");
    let mesh = read(&path).expect("a sample").mesh;
    assert_eq!(read_polygons(&path).expect("a sample").mesh.triangles(), mesh);
}

// ---- glTF

/// Two triangles of a square of one metre; the last corner is at (0, 0, 7) but replaced.
fn sparse_document() -> (Value, Vec<u8>) {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -1.0], [0.0, 0.0, 7.0_f32]];
    let mut data: Vec<u8> = corners.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
    data.extend([0, 1, 2, 0, 2, 0, 0, 0]); // indices, the last one but two replaced by 3
    data.extend([5, 0, 0, 0, 3, 0, 0, 0]); // where, and by what
    data.extend([0, 1, 2, 3]);
    data.extend(
        [[1.0_f32, 0.0, -1.0], [0.0, 0.0, -1.0]]
            .as_flattened()
            .iter()
            .flat_map(|c| c.to_le_bytes()),
    );
    let view =
        |at: usize, length: usize| json!({ "buffer": 0, "byteOffset": at, "byteLength": length });
    let text = base64(&data);
    let document = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "buffers": [{ "byteLength": data.len(), "uri": format!("data:;base64,{text}") }],
        "bufferViews": [view(0, 48), view(48, 6), view(56, 1), view(60, 1), view(64, 4), view(68, 24)],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
                "count": 1,
                "indices": { "bufferView": 4, "byteOffset": 3, "componentType": 5121 },
                "values": { "bufferView": 5, "byteOffset": 12 } } },
            { "bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR", "sparse": {
                "count": 1,
                "indices": { "bufferView": 2, "componentType": 5121 },
                "values": { "bufferView": 3 } } }
        ]
    });
    (document, data)
}

fn base64(data: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |g: &[u8]| {
        let bits = g.iter().fold(0_u32, |bits, b| bits << 8 | u32::from(*b)) << (8 * (3 - g.len()));
        let digit = move |k: usize| DIGITS[(bits >> (18 - 6 * k)) as usize & 63] as char;
        (0..=g.len()).map(digit).collect::<String>()
    };
    data.chunks(3).map(group).collect()
}

fn gltf_area(document: &Value) -> f64 {
    let mesh = sound(document.to_string().as_bytes()).mesh;
    mesh.triangles.ids().map(|f| 0.5 * mesh.area_vector(f).z).sum()
}

#[test]
fn sparse_accessors_replace_positions_and_indices() {
    let (mut document, _) = sparse_document();
    assert!((gltf_area(&document) - 1e6).abs() < 1e-3);

    // Without a base all is zero but for what is replaced.
    let positions = &mut document["accessors"][0];
    positions.as_object_mut().expect("an accessor").remove("bufferView");
    positions["sparse"] = json!({
        "count": 3,
        "indices": { "bufferView": 4, "byteOffset": 1, "componentType": 5121 },
        "values": { "bufferView": 0, "byteOffset": 12 }
    });
    document["accessors"][1].as_object_mut().expect("an accessor").remove("sparse");
    // The triangle 0, 1, 2; the other one, 0, 2, 0, has no area.
    assert!((gltf_area(&document) - 5e5).abs() < 1e-3);
}

#[test]
fn skins_and_morph_targets_are_noted_and_not_applied() {
    let (mut document, _) = sparse_document();
    document["nodes"] = json!([{ "mesh": 0, "skin": 0 }, {}]);
    document["skins"] = json!([{ "joints": [1] }]);
    document["meshes"][0]["weights"] = json!([1.0]);
    document["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    let reading = sound(document.to_string().as_bytes());
    assert_eq!(
        reading.notes,
        [
            "1 mesh read at rest: skins are not applied",
            "1 mesh read at rest: morph targets are not applied"
        ]
    );
}

// ---- Broken files

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken")
}

/// File, step and phrase of each row of the table.
fn table() -> Vec<[String; 3]> {
    let text = fs::read_to_string(folder().join("expected.txt")).expect("the table");
    let rows = text.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty());
    let row = |line: &str| {
        let mut cells = line.splitn(3, " | ").map(|cell| cell.trim_end().to_owned());
        [(); 3].map(|()| cells.next().expect("three cells"))
    };
    rows.map(row).collect()
}

#[test]
fn the_table_of_broken_files_is_complete() {
    let listed: Vec<String> = table().into_iter().map(|[file, ..]| file).collect();
    let set: BTreeSet<&String> = listed.iter().collect();
    assert_eq!(set.len(), listed.len(), "a file is listed twice");
    let files: BTreeSet<String> = fs::read_dir(folder())
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("plain names"))
        .filter(|name| name != "expected.txt")
        .collect();
    assert_eq!(files.iter().collect::<BTreeSet<_>>(), set);
    assert!(files.len() >= 45);
}

#[test]
fn broken_files_are_refused_with_the_phrase_of_the_table() {
    let mut wrong = Vec::new();
    for [file, step, phrase] in table() {
        let path = folder().join(&file);
        let triangles = read(&path);
        let polygons = read_polygons(&path);
        let messages = match step.as_str() {
            "read" => vec![
                triangles.expect_err(&file).to_string(),
                polygons.expect_err(&file).to_string(),
            ],
            "polygons" => {
                triangles.expect(&file);
                vec![polygons.expect_err(&file).to_string()]
            }
            "disk" => {
                let doors = [triangles.expect(&file).mesh, polygons.expect(&file).mesh.triangles()];
                let refusal = |mesh| require_disk(mesh).expect_err(&file).to_string();
                doors.iter().map(|mesh| format!("{file}: {}", refusal(mesh))).collect()
            }
            other => panic!("{file}: {other} is no step"),
        };
        let fits = |m: &String| m.contains(&phrase) && m.contains(&file);
        wrong.extend(messages.into_iter().filter(|m| !fits(m)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
