//! Surface files, sound and broken, through the front door. Whatever the bytes, the
//! answer is a mesh or an error that names the fault, never a panic.

use proptest::prelude::*;
use rodwright::ids::{Id, VertexId};
use rodwright::surface::read::gltf::GltfError;
use rodwright::surface::read::{Cause, ReadError, Reading, read, read_bytes, read_polygons_bytes};
use rodwright::surface::topology::require_disk;
use rodwright::surface::{Mesh, Point3};
use serde_json::{Value, json};
use std::fs;

fn obj(text: &str) -> Result<Reading, ReadError> {
    read_bytes("test.obj", text.as_bytes(), None)
}

fn obj_error(text: &str) -> String {
    obj(text).expect_err("a broken file").to_string()
}

fn area(mesh: &Mesh) -> f64 {
    mesh.triangles.ids().map(|f| 0.5 * mesh.area_vector(f).norm()).sum()
}

const SQUARE: &str = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n";

// ---- OBJ

#[test]
fn obj_objects_groups_seams_and_polygons_make_one_disk() {
    let text = "mtllib none.mtl\no first\nv 0 0 0 1 0 0\nv 10 0 0 1 0 0\nv 10 10 0 1 0 0\nv 0 10 0 1 0 0\n\
        vt 0 0\nvt 1 1\nvn 0 0 1\ng wall\nusemtl red\nf 1/1/1 2/2/1 3/1/1 4/2/1\n\
        o second\nv 10 0 0\nv 20 0 0\nv 20 10 0\nv 10 10 0\ng\nf -4//1 -3//1 \\\n -2//1 -1//1\nl 1 2 3\n";
    let reading = obj(text).expect("sound");
    assert!(!reading.y_up_metres);
    assert_eq!(reading.mesh.points.len(), 6);
    require_disk(&reading.mesh).expect("one disk");
    assert!((area(&reading.mesh) - 200.0).abs() < 1e-9);
    assert_eq!(
        reading.notes,
        [
            "2 faces with more than three corners cut into triangles",
            "2 vertices at the place of another joined to it"
        ]
    );
}

#[test]
fn obj_concave_face_is_cut_within_its_outline() {
    let text = "v 0 0 0\nv 30 0 0\nv 30 10 0\nv 10 10 0\nv 10 30 0\nv 0 30 0\nf 2 3 4 5 6 1\n";
    let mesh = obj(text).expect("sound").mesh;
    assert!((area(&mesh) - 500.0).abs() < 1e-9);
    require_disk(&mesh).expect("one disk");
}

#[test]
fn obj_weights_divide_and_names_need_not_be_utf8() {
    let bytes = b"\xEF\xBB\xBFv 0 0 0\ng caf\xE9\nv 20 0 0 2\nv 0 10 0\nf 1 2 3\n";
    let mesh = read_bytes("test", bytes, None).expect("sound").mesh;
    assert!((area(&mesh) - 50.0).abs() < 1e-9);
}

#[test]
fn obj_faults_are_named_with_their_line() {
    let cases = [
        ("f 1 2 5\n", "line 5: the face uses vertex 5, but the vertices end at 4"),
        ("f 1 2 -5\n", "line 5: the face uses vertex -5, but the vertices end at 4"),
        ("f 1 2 0\n", "line 5: the face uses vertex 0"),
        ("f 1 2 9223372036854775807\n", "line 5: the face uses vertex 9223372036854775807"),
        ("f 1 2 -9223372036854775808\n", "line 5: the face uses vertex -9223372036854775808"),
        ("# note\nf 1 2 x\n", "line 6: a face needs whole numbers"),
        ("v 1 2\nf 1 2 3\n", "line 5: a vertex needs three numbers"),
        ("v 1 2 b\nf 1 2 3\n", "line 5: a vertex needs three numbers"),
        ("v 1 2 3 0\nf 1 2 3\n", "line 5: the weight of a vertex must not be 0"),
        ("v 1 2 3 4 5\nf 1 2 3\n", "line 5: a vertex has three numbers, or four, or six"),
        ("f 1 3 2 4\n", "line 5: the outline of the face crosses itself"),
        ("v nan 0 0\nf 1 2 5\n", "vertex 5 is at (NaN, 0, 0)"),
        ("v 1e999 0 0\nf 1 2 5\n", "vertex 5 is at (inf, 0, 0)"),
        ("f 1 2\n", "the file has 4 vertices but no faces"),
        ("", "the file has 4 vertices but no faces"),
        ("v 5 5 5\nv 5 5 -5\nf 1 2 5\nf 1 2 3\nf 1 2 6\n", "more than two triangles"),
    ];
    for (more, expected) in cases {
        let message = obj_error(&format!("{SQUARE}{more}"));
        assert!(message.contains(expected), "{more:?}: {message}");
        assert!(message.starts_with("test.obj: "), "{message}");
    }
}

#[test]
fn obj_texture_indices_out_of_range_do_no_harm() {
    let text = format!("{SQUARE}vt 0 0\nvn 0 0 1\nf 1/9223372036854775807/-99 2/7/0 3//\n");
    obj(&text).expect("texture indices are not read");
}

#[test]
fn two_pieces_a_closed_surface_and_a_bow_tie_are_read_but_are_no_disk() {
    let two = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 0 0\nv 10 0 0\nv 9 1 0\nf 1 2 3\nf 4 5 6\n";
    let closed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let tie = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n";
    for (text, expected) in [(two, "    2          1"), (closed, "closed"), (tie, "vertex 1 at")] {
        let mesh = obj(text).expect("sound").mesh;
        let message = require_disk(&mesh).expect_err("no disk").to_string();
        assert!(message.contains(expected), "{message}");
    }
}

// ---- Formats and files

#[test]
fn empty_and_foreign_files_are_named() {
    for empty in ["", "\n", " \r\n\t "] {
        assert!(obj_error(empty).contains("the file is empty"));
    }
    let cases: [(&[u8], &str); 3] = [
        (b"Kaydara FBX Binary  \0", "FBX"),
        (b"PK\x03\x04rest", "ZIP"),
        (b"\x89PNG\r\n", "not known"),
    ];
    for (bytes, expected) in cases {
        let message = read_bytes("x", bytes, None).expect_err("foreign").to_string();
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("STL (.stl), PLY (.ply) and OFF (.off)"), "{message}");
    }
}

#[test]
fn missing_files_and_folders_are_told_from_broken_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    for path in [folder.path().join("none.obj"), folder.path().to_owned()] {
        assert!(read(&path).expect_err("no file").is_io());
    }
    let broken = folder.path().join("broken.obj");
    fs::write(&broken, "f 1 2 3").expect("a file");
    assert!(!read(&broken).expect_err("broken").is_io());
}

#[test]
fn the_format_follows_the_content_not_the_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("surface.txt");
    fs::write(&path, format!("{SQUARE}f 1 2 3 4\n")).expect("a file");
    assert!(!read(&path).expect("an OBJ file").y_up_metres);
    fs::write(&path, glb(&document(), &data())).expect("a file");
    assert!(read(&path).expect("a GLB file").y_up_metres);
}

// ---- glTF

/// Four corners of a square of one metre in the ground plane, then indices: a list at
/// byte 48, a strip at 60, a fan at 68.
fn data() -> Vec<u8> {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, -1.0], [0.0, 0.0, -1.0_f32]];
    let mut bytes: Vec<u8> = corners.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
    let indices: [u16; 14] = [0, 1, 2, 0, 2, 3, 0, 1, 3, 2, 0, 1, 2, 3];
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

fn document() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "buffers": [{ "byteLength": 76 }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 28 }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [0.0, 0.0, -1.0], "max": [1.0, 0.0, 0.0] },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" }
        ]
    })
}

fn glb(document: &Value, data: &[u8]) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], content: &[u8]| {
        [&(content.len() as u32).to_le_bytes(), &kind[..], content].concat()
    };
    let body = [chunk(b"JSON", &json), chunk(b"BIN\0", data)].concat();
    let length = (12 + body.len() as u32).to_le_bytes();
    [&b"glTF"[..], &2_u32.to_le_bytes(), &length, &body].concat()
}

/// The document changed at one place (a JSON pointer) and read as GLB.
fn changed(place: &str, value: Value) -> Result<Reading, ReadError> {
    let mut document = document();
    let (parent, key) = place.rsplit_once('/').expect("a JSON pointer");
    let parent = document.pointer_mut(parent).expect("a place in the document");
    match parent {
        Value::Array(items) => items[key.parse::<usize>().expect("a number")] = value,
        parent => parent[key] = value,
    }
    read_bytes("test.glb", &glb(&document, &data()), None)
}

fn gltf_error(place: &str, value: Value) -> GltfError {
    match changed(place, value).expect_err("a broken file").cause {
        Cause::Gltf(e) => e,
        other => panic!("{place}: {other}"),
    }
}

#[test]
fn glb_becomes_millimetres_with_z_up() {
    let reading = read_bytes("test.glb", &glb(&document(), &data()), None).expect("sound");
    assert!(reading.y_up_metres);
    assert_eq!(reading.notes, Vec::<String>::new());
    assert_eq!(reading.mesh.points[VertexId::new(2)], Point3::new(1000.0, 1000.0, 0.0));
    assert!((area(&reading.mesh) - 1e6).abs() < 1e-3);
    require_disk(&reading.mesh).expect("one disk");
}

#[test]
fn strips_fans_and_bare_triangles_cover_the_square() {
    let modes = [(5, 12, 4), (6, 20, 4)];
    for (mode, offset, count) in modes {
        let mut d = document();
        d["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        d["accessors"][1]["byteOffset"] = json!(offset);
        d["accessors"][1]["count"] = json!(count);
        let reading = read_bytes("x", &glb(&d, &data()), None).expect("sound");
        assert_eq!(reading.notes, Vec::<String>::new(), "mode {mode}");
        assert!((area(&reading.mesh) - 1e6).abs() < 1e-3, "mode {mode}");
    }
    let mut d = document();
    d["meshes"][0]["primitives"][0].as_object_mut().expect("a primitive").remove("indices");
    let mesh = read_bytes("x", &glb(&d, &data()), None).expect("sound").mesh;
    assert!((area(&mesh) - 5e5).abs() < 1e-3);
}

#[test]
fn nodes_place_their_meshes() {
    let mut d = document();
    // A quarter turn about y takes x to -z; then doubled, then moved up by 3 m.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    d["nodes"] = json!([
        { "translation": [0.0, 3.0, 0.0], "scale": [2.0, 2.0, 2.0], "children": [1] },
        { "rotation": [0.0, half, 0.0, half], "mesh": 0 }
    ]);
    let mesh = read_bytes("x", &glb(&d, &data()), None).expect("sound").mesh;
    let [lo, hi] = mesh.bounds().expect("not empty");
    assert!((lo - Point3::new(-2000.0, 0.0, 3000.0)).norm() < 1e-2, "{lo}");
    assert!((hi - Point3::new(0.0, 2000.0, 3000.0)).norm() < 1e-2, "{hi}");

    // A mirroring matrix does not turn the surface inside out: nothing to mend.
    d["nodes"] = json!([{ "mesh": 0, "matrix":
        [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0] }]);
    let reading = read_bytes("x", &glb(&d, &data()), None).expect("sound");
    assert_eq!(reading.notes, Vec::<String>::new());
    assert_eq!(reading.mesh.bounds().expect("not empty")[0].x, -1000.0);
}

#[test]
fn quantized_positions_are_read() {
    let mut d = document();
    d["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    d["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    d["accessors"][0]["componentType"] = json!(5123);
    d["accessors"][0]["normalized"] = json!(true);
    d["bufferViews"][0]["byteStride"] = json!(8);
    d["bufferViews"][0]["byteLength"] = json!(32);
    let corners: [u16; 16] = [0, 0, 0, 0, 65535, 0, 0, 0, 65535, 0, 65535, 0, 0, 0, 65535, 0];
    let mut bytes = data();
    for (i, c) in corners.iter().enumerate() {
        bytes[2 * i..2 * i + 2].copy_from_slice(&c.to_le_bytes());
    }
    let mesh = read_bytes("x", &glb(&d, &bytes), None).expect("sound").mesh;
    assert!((area(&mesh) - 1e6).abs() < 1e-6);
}

#[test]
fn gltf_buffers_are_embedded_or_beside_the_document() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("the data.bin"), data()).expect("a file");
    let mut d = document();
    d["buffers"][0]["uri"] = json!("the%20data.bin");
    let path = folder.path().join("test.gltf");
    fs::write(&path, d.to_string()).expect("a file");
    assert_eq!(read(&path).expect("sound").mesh.triangles.len(), 2);

    fs::write(folder.path().join("the data.bin"), &data()[..75]).expect("a file");
    let message = read(&path).expect_err("cut short").to_string();
    assert!(message.contains("buffer 0 says that it has 76 bytes, but there are 75"), "{message}");
}

#[test]
fn gltf_buffers_elsewhere_are_refused_by_name() {
    let uris = ["https://example.org/a.bin", "/etc/passwd", "../a.bin", "a/../../b", "file:///a"];
    for uri in uris {
        let error = changed("/buffers/0/uri", json!(uri)).expect_err("elsewhere");
        assert!(matches!(&error.cause, Cause::Gltf(GltfError::Uri { .. })), "{error}");
        assert!(error.to_string().contains(uri), "{error}");
    }
    let error = gltf_error("/buffers/0/uri", json!("data:;base64,&&&&"));
    assert!(error.to_string().contains("not base64"), "{error}");
}

#[test]
fn compressed_files_are_refused_by_name() {
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_new"] {
        let error = gltf_error("/extensionsRequired", json!([name]));
        assert_eq!(error, GltfError::Extension(name.into()));
    }
}

#[test]
fn gltf_sizes_that_lie_are_refused() {
    let huge = u64::MAX;
    for (place, value) in [
        ("/buffers/0/byteLength", json!(77)),
        ("/buffers/0/byteLength", json!(huge)),
        ("/bufferViews/0/byteLength", json!(huge)),
        ("/bufferViews/0/byteOffset", json!(huge)),
        ("/bufferViews/0/byteOffset", json!(40)),
        ("/bufferViews/0/byteStride", json!(252)),
        ("/accessors/0/count", json!(5)),
        ("/accessors/0/count", json!(huge)),
        ("/accessors/0/byteOffset", json!(huge)),
        ("/accessors/0/byteOffset", json!(4)),
        ("/accessors/1/count", json!(4_000_000_000_u64)),
        ("/accessors/0/type", json!("SCALAR")),
        ("/accessors/0/componentType", json!(5125)),
        ("/accessors/1/componentType", json!(5126)),
        ("/accessors/0/bufferView", json!(7)),
        ("/accessors/0/bufferView", Value::Null),
        ("/bufferViews/0/buffer", json!(1)),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(9)),
        ("/meshes/0/primitives/0/mode", json!(77)),
        ("/meshes/0/primitives/0/mode", json!(1)),
        ("/nodes/0/mesh", json!(3)),
        ("/nodes/0/children", json!([0])),
        ("/nodes/0/children", json!([5])),
        ("/scene", json!(4)),
        ("/scenes/0/nodes", json!([0, 0])),
        ("/scenes/0/nodes", json!([])),
        ("/asset", Value::Null),
    ] {
        let error = gltf_error(place, value);
        assert!(!error.hint().is_empty(), "{place}: {error}");
    }
}

#[test]
fn a_gltf_index_without_a_vertex_is_named() {
    let mut bytes = data();
    bytes[48] = 9;
    let message = read_bytes("x", &glb(&document(), &bytes), None).expect_err("bad").to_string();
    assert_eq!(message, "x: mesh \"0\": an index names vertex 10, but the vertices end at 4");
}

#[test]
fn a_gltf_position_that_is_no_number_is_named() {
    let mut bytes = data();
    bytes[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let message = read_bytes("x", &glb(&document(), &bytes), None).expect_err("bad").to_string();
    assert!(message.contains("vertex 2 is at (NaN"), "{message}");
}

#[test]
fn a_mesh_placed_very_often_is_refused_before_memory_ends() {
    let mut d = document();
    let count = 500_000;
    d["nodes"] = json!(vec![json!({ "mesh": 0 }); count]);
    d["scenes"][0]["nodes"] = json!((0..count).collect::<Vec<_>>());
    d["bufferViews"][1] = json!({ "buffer": 0, "byteOffset": 48, "byteLength": 240_000 });
    d["accessors"][1]["count"] = json!(120_000);
    d["buffers"][0]["byteLength"] = json!(240_048);
    let mut bytes = data();
    bytes.resize(240_048, 0);
    let error = read_bytes("x", &glb(&d, &bytes), None).expect_err("too often");
    assert!(matches!(error.cause, Cause::Gltf(GltfError::TooManyCopies { .. })), "{error}");
}

#[test]
fn a_deep_chain_of_nodes_does_not_overflow_the_stack() {
    let mut d = document();
    let count = 100_000;
    let node = |i: usize| {
        if i + 1 < count { json!({ "children": [i + 1] }) } else { json!({ "mesh": 0 }) }
    };
    d["nodes"] = json!((0..count).map(node).collect::<Vec<_>>());
    read_bytes("x", &glb(&d, &data()), None).expect("sound");
}

#[test]
fn a_glb_cut_anywhere_is_refused() {
    let whole = glb(&document(), &data());
    for length in 0..whole.len() {
        let error = read_bytes("x", &whole[..length], None).expect_err("cut short");
        assert!(!error.hint().is_empty());
    }
}

#[test]
fn a_glb_header_or_chunk_length_that_lies_does_not_panic() {
    let whole = glb(&document(), &data());
    for at in [4, 8, 12] {
        for lie in [0, 1, 11, 12, 19, 20, whole.len() as u32 + 1, u32::MAX] {
            let mut bytes = whole.clone();
            bytes[at..at + 4].copy_from_slice(&lie.to_le_bytes());
            assert!(read_bytes("x", &bytes, None).is_err(), "{lie} at byte {at}");
        }
    }
}

// ---- Any bytes

/// Lines that look like OBJ, with whatever in them.
fn obj_like() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        "-?[0-9]{1,3}",
        "-?[0-9]{1,2}/[0-9]{0,20}/[0-9]?",
        "[0-9.e-]{1,6}",
        "nan|inf|\\\\|#|/|é",
    ];
    let words = proptest::collection::vec(word, 0..7);
    let key = prop_oneof!["v", "f", "vt", "vn", "l", "o", "g", "usemtl", "mtllib", "p", ""];
    let line = (key, words).prop_map(|(key, words)| format!("{key} {}", words.join(" ")));
    proptest::collection::vec(line, 0..30).prop_map(|lines| lines.join("\n"))
}

/// So much of each format that the rest is read by it.
const STARTS: [&[u8]; 8] = [
    b"glTF\x02\0\0\0",
    b"{",
    b"v 0 0 0\nf ",
    b"solid\nfacet normal 0 0 1\nouter loop\n",
    b"OFF\n2 2 0\n",
    b"ply\n",
    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\n\
        element face 9\nproperty list int int vertex_index\nend_header\n",
    b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n\
        property char z\nelement face 9\nproperty list uchar uchar vertex_index\nend_header\n",
];

proptest! {
    #[test]
    fn any_bytes_give_an_answer(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = read_bytes("x", &bytes, None);
        for start in STARTS {
            let bytes = [start, &bytes].concat();
            let _ = (read_bytes("x", &bytes, None), read_polygons_bytes("x", &bytes, None));
        }
    }

    #[test]
    fn anything_like_obj_gives_an_answer(text in obj_like()) {
        let _ = obj(&text);
    }

    #[test]
    fn a_glb_with_changed_bytes_gives_an_answer(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)
    ) {
        let mut bytes = glb(&document(), &data());
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let _ = read_bytes("x", &bytes, None);
    }

    #[test]
    fn a_document_with_changed_numbers_gives_an_answer(
        which in any::<prop::sample::Index>(),
        value in prop_oneof![Just(u64::MAX), Just(1 << 62), Just(u64::from(u32::MAX)), 0..90_u64]
    ) {
        let text = document().to_string();
        let numbers: Vec<_> = text.match_indices(|c: char| c.is_ascii_digit()).collect();
        let (at, digit) = numbers[which.index(numbers.len())];
        let changed = format!("{}{value}{}", &text[..at], &text[at + digit.len()..]);
        if let Ok(document) = serde_json::from_str::<Value>(&changed) {
            let _ = read_bytes("x", &glb(&document, &data()), None);
        }
    }
}
