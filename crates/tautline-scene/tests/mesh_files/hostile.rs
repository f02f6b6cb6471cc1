//! Files that want too much: they are refused at once, whatever they claim. Memory is measured in `memory.rs`.

use std::path::Path;

use serde_json::json;
use tautline_scene::mesh_file::{Format, Limits, parse};

use super::gltf::glb;
use super::worked::worked;
use super::{binary_stl, read};

/// Refused with these words, in a tenth of a second.
fn assert_refused(name: &str, bytes: &[u8], part: &str) {
    let start = worked();
    let refusal = parse(bytes, Format::of(Path::new(name)).unwrap(), &Limits::default()).unwrap_err();
    let time = worked() - start;
    assert!(refusal.message.contains(part), "{name}: {refusal}");
    assert!(refusal.message.len() < 500, "a message for people");
    assert!(time < 0.1, "{name}: {time} s for {refusal}");
}

#[test]
fn counts_are_not_believed() {
    let mut stl = binary_stl(&read("cube.obj", super::CUBE));
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_refused("a.stl", &stl, "announces");
    for format in ["ascii", "binary_little_endian"] {
        for count in ["1000000000000000000", "18446744073709551615", "99999999999999999999999"] {
            let header = |vertices, faces| {
                format!(
                    "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
                     property float z\nelement face {faces}\nproperty list uint int vertex_indices\nend_header\n"
                )
            };
            assert_refused("a.ply", header(count, "1").as_bytes(), "");
            assert_refused("a.ply", header("0", count).as_bytes(), "");
        }
    }
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n4000000000 0 0 0";
    assert_refused("a.ply", text.as_bytes(), "4000000000 entries");
}

#[test]
fn long_words_and_deep_brackets_are_cut_short() {
    let long = "Ä".repeat(1 << 19);
    assert_refused("a.obj", format!("v 0 0 0\nf 1 1 {long}").as_bytes(), "…");
    assert_refused("a.stl", format!("solid\n{long}").as_bytes(), "…");
    assert_refused("a.ply", format!("ply\n{long}").as_bytes(), "…");
    assert_refused("a.ply", format!("ply\nformat {long} 1.0").as_bytes(), "…");
    assert_refused("a.ply", "ply\ncomment\n".repeat(1 << 16).as_bytes(), "not a line");
    let document = |field: &str| format!("{{\"asset\":{{\"version\":\"2.0\"}},{field}:\"{long}\"}}");
    assert_refused("a.gltf", format!("{{\"asset\":{{\"version\":\"{long}\"}}}}").as_bytes(), "…");
    assert_refused("a.gltf", document("\"scene\"").as_bytes(), "expected u32");
    assert_refused("a.gltf", document("\"extensionsRequired\":[\"\\u001b[2J\"],\"x\"").as_bytes(), "u{1b}");
    assert_refused("a.gltf", "[".repeat(100_000).as_bytes(), "");
    assert_refused("a.gltf", format!("{{\"asset\":{}", "[".repeat(100_000)).as_bytes(), "");
    assert_refused("a.gltf", format!("{{\"extras\":{}", "{\"a\":".repeat(100_000)).as_bytes(), "objects");
}

#[test]
fn empty_objects_and_long_chains_of_nodes_are_no_scene() {
    let empty = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", "{},".repeat(300_000));
    assert_refused("a.gltf", empty.as_bytes(), "are no glTF");
    let chain: Vec<_> = (1..2000).map(|next| json!({ "children": [next] })).collect();
    let document = json!({ "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "nodes": chain });
    assert_refused("a.glb", &glb(&document, &[]), "more than 64 deep");
}

#[test]
fn a_mesh_that_is_repeated_many_times_is_refused() {
    let nodes = vec![json!({ "mesh": 0 }); 9000];
    let document = json!({
        "asset": { "version": "2.0" },
        "nodes": nodes,
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3000, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36_000 }],
        "buffers": [{ "byteLength": 36_000 }],
    });
    assert_refused("a.glb", &glb(&document, &[0; 36_000]), "repeated meshes");
}

#[test]
fn limits_are_kept() {
    let small = Limits { file_bytes: 1000, vertices: 8, triangles: 12, nesting: 1 };
    let refusal = |name: &str, bytes: &[u8], limits| {
        parse(bytes, Format::of(Path::new(name)).unwrap(), &limits)
            .map_or_else(|refusal| refusal.message, |_| String::new())
    };
    let cube = read("cube.obj", super::CUBE);
    let stl = binary_stl(&cube);
    let [ply, ..] = super::ply::pyramids();
    let cases: [(&str, &[u8], Limits, &str); 6] = [
        ("a.stl", &stl, small, ""),
        ("a.stl", &stl, Limits { triangles: 11, ..small }, "12 triangles are more than 11"),
        ("a.stl", &stl, Limits { file_bytes: 600, ..small }, "684 bytes are more than 600"),
        ("a.obj", super::CUBE.as_bytes(), small, "9 vertices are more than 8"),
        ("a.ply", &ply, Limits { triangles: 5, ..small }, "6 triangles are more than 5"),
        ("a.ply", &ply, Limits { vertices: 4, ..small }, "5 vertices are more than 4"),
    ];
    for (name, bytes, limits, message) in cases {
        assert_eq!(refusal(name, bytes, limits), message, "{name} {limits:?}");
    }
    let gltf = super::gltf::tetrahedron();
    assert_eq!(refusal("a.glb", &gltf, Limits { triangles: 3, ..small }), "4 triangles are more than 3");
    assert_eq!(refusal("a.glb", &gltf, Limits { vertices: 3, ..small }), "4 vertices are more than 3");
}

#[test]
fn faces_that_take_too_long_to_divide_are_refused() {
    // A comb with many teeth: each ear is found late.
    let teeth = 124;
    let mut text = String::new();
    for i in 0..teeth {
        text += &format!("v {i} 0 0\nv {i}.5 {} 0\n", 1000 + i % 7);
    }
    text += "f";
    text.extend((1..=2 * teeth).rev().map(|i| format!(" {i}")));
    let one = parse(text.as_bytes(), Format::Obj, &Limits::default()).unwrap();
    assert_eq!(one.mesh.triangles.len(), 2 * teeth - 2);
    let face = text[text.rfind('f').unwrap()..].to_owned() + "\n";
    let many = format!("{text}\n{}", face.repeat(2_000));
    assert_refused("a.obj", many.as_bytes(), "divide them into triangles");
}
