//! glTF: what the program itself writes, nodes that turn and mirror, buffers in every place, and every refusal.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fs;

use serde_json::{Value, json};
use tautline::mesh::{TriMesh, primitives};
use tautline::{Quat, Vec3};
use tautline_scene::export::write_glb;
use tautline_scene::mesh_file::{Limits, Place, read_mesh};
use tautline_scene::recording::{Motion, Recording, Surface, Track};
use tempfile::TempDir;

use super::{assert_closed, assert_truncations_are_refused, corners, parse, read, refusal, volume};

/// A corner of a cube with edges of 1 m: a tetrahedron of four triangles.
fn data() -> Vec<u8> {
    let positions: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut bytes: Vec<u8> = positions.iter().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend([0_u8, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]);
    bytes
}

/// A document of one tetrahedron, whose buffer has no name.
fn document() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "Tétraèdre" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "buffers": [{ "byteLength": 60 }],
    })
}

/// A binary file of a document and data.
pub(super) fn glb(document: &Value, data: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + text.len() as u32 + data.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text[..]), (b"BIN\0", data)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

pub(super) fn tetrahedron() -> Vec<u8> {
    glb(&document(), &data())
}

/// The document after a change at a JSON pointer.
fn changed(pointer: &str, value: Value) -> Value {
    let mut document = document();
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    let parent = document.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(list) => list[name.parse::<usize>().unwrap()] = value,
        _ => parent[name] = value,
    }
    document
}

/// `data:` and the digits of base64, written with another algorithm than the reader's.
fn data_uri(bytes: &[u8]) -> String {
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bit = |i: usize| bytes.get(i / 8).map_or(0, |byte| byte >> (7 - i % 8) & 1) as usize;
    let count = (bytes.len() * 8).div_ceil(6);
    let mut text = "data:application/octet-stream;base64,".to_owned();
    text.extend(
        (0..count).map(|d| char::from(digits[(0..6).fold(0, |value, k| value << 1 | bit(6 * d + k))])),
    );
    text + &"=".repeat(count.next_multiple_of(4) - count)
}

#[test]
fn what_the_program_writes_is_read_where_it_begins() {
    let still = primitives::icosphere(0.5, 2).unwrap();
    let moving = primitives::icosahedron(1.0).unwrap();
    let turn = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    let track = |name: &str, mesh: &TriMesh, motion| Track {
        name: name.into(),
        color: [90; 3],
        surface: Surface::Round,
        mesh: mesh.clone(),
        motion,
    };
    let motion = Motion::Rigid(vec![(Vec3::new(3.0, 0.0, 0.0), turn), (Vec3::ZERO, turn)]);
    let tracks = vec![track("still", &still, Motion::Still), track("moving", &moving, motion)];
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.glb");
    write_glb(&Recording { name: "a".into(), frame_rate: 30.0, tracks }, &path).unwrap();

    let file = read_mesh(&path, &Limits::default()).unwrap();
    assert_closed(&file.mesh);
    let mut expected = corners(&still);
    expected.extend(corners(&moving).iter().map(|triangle| triangle.map(|p| turn * p + Vec3::X * 3.0)));
    for (a, b) in corners(&file.mesh).iter().zip(&expected) {
        assert!(a.iter().zip(b).all(|(a, b)| a.distance(*b) < 1e-6), "{a:?} {b:?}");
    }
    assert_eq!(file.mesh.triangles.len(), expected.len());
    assert!(file.notes.iter().any(|note| note.what == "animations"), "{:?}", file.notes);
}

#[test]
fn nodes_turn_scale_and_mirror() {
    let mut document = document();
    document["nodes"] = json!([
        { "children": [1, 2], "translation": [0, 5, 0], "scale": [2, 2, 2] },
        { "mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1] },
        { "mesh": 0, "rotation": [0, 0, FRAC_1_SQRT_2, FRAC_1_SQRT_2] },
    ]);
    let mesh = read("a.glb", glb(&document, &data()));
    assert_closed(&mesh);
    assert_eq!(mesh.positions.len(), 8);
    assert!((volume(&mesh, Vec3::ZERO) - 2.0 * 8.0 / 6.0).abs() < 1e-4, "a mirrored surface is turned round");
    let expected = [Vec3::new(20.0, 5.0, 0.0), Vec3::new(18.0, 5.0, 0.0), Vec3::new(0.0, 7.0, 0.0)];
    for place in expected {
        assert!(
            mesh.positions.iter().any(|p| p.distance(place) < 1e-5),
            "{place} is not in {:?}",
            mesh.positions
        );
    }
}

#[test]
fn strips_fans_and_lists_without_indices_are_triangles() {
    let square = |mode: u32, order: [usize; 4]| {
        let corner = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let bytes: Vec<u8> = order.iter().flat_map(|&i| corner[i]).flat_map(f32::to_le_bytes).collect();
        let mut document = changed("/meshes/0/primitives/0/mode", json!(mode));
        document["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
        document["bufferViews"] = json!([{ "buffer": 0, "byteLength": 48 }]);
        document["buffers"][0]["byteLength"] = json!(48);
        read("a.glb", glb(&document, &bytes))
    };
    for mesh in [square(5, [0, 1, 3, 2]), square(6, [0, 1, 2, 3])] {
        let normals = corners(&mesh).into_iter().map(|[a, b, c]| (b - a).cross(c - a));
        assert_eq!(normals.collect::<Vec<_>>(), [Vec3::Z; 2]);
    }
    assert_eq!(square(4, [0, 1, 2, 3]).triangles.len(), 1, "the fourth corner begins no triangle");
}

#[test]
fn buffers_may_be_in_the_text_or_beside_it_but_nowhere_else() {
    let outer = TempDir::new().unwrap();
    let folder = outer.path().join("Ordner mit Ü");
    fs::create_dir_all(folder.join("sub")).unwrap();
    fs::write(folder.join("sub/my data.bin"), data()).unwrap();
    fs::write(outer.path().join("secret.bin"), data()).unwrap();
    let read_with = |uri: &str| {
        let path = folder.join("a.gltf");
        fs::write(&path, changed("/buffers/0/uri", json!(uri)).to_string()).unwrap();
        read_mesh(&path, &Limits::default()).map_err(|error| error.to_string())
    };
    for uri in [&data_uri(&data()), "sub/my%20data.bin", "sub/my data.bin"] {
        assert_closed(&read_with(uri).unwrap().mesh);
    }
    let absolute = outer.path().join("secret.bin");
    let refused = [
        "../secret.bin",
        "sub/../../secret.bin",
        "%2e%2e/secret.bin",
        absolute.to_str().unwrap(),
        "file:secret.bin",
        "http:secret.bin",
        "sub",
        "none.bin",
        "%ff.bin",
        "%zz",
        "",
        "data:,abc",
    ];
    for uri in refused {
        let message = read_with(uri).unwrap_err();
        assert!(message.contains("buffers[0].uri"), "{uri}: {message}");
    }
    let alone = refusal("a.gltf", changed("/buffers/0/uri", json!("sub/my data.bin")).to_string());
    assert!(alone.1.contains("there is only this one"), "{}", alone.1);
}

#[test]
fn a_file_that_many_buffers_name_is_read_once() {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("data.bin"), data()).unwrap();
    let path = folder.path().join("a.gltf");
    let read = |names: &[&str]| {
        let mut document = document();
        document["buffers"] = names.iter().map(|uri| json!({ "byteLength": 60, "uri": uri })).collect();
        fs::write(&path, document.to_string()).unwrap();
        let limits = Limits { file_bytes: 64_000, ..Limits::default() };
        read_mesh(&path, &limits).map(|file| file.mesh).map_err(|error| error.to_string())
    };
    let names = ["data.bin", "./data.bin", "././data.bin", "d%61ta.bin"];
    assert_closed(&read(&names).unwrap());
    assert_closed(&read(&["data.bin"; 1000]).unwrap());
    assert!(read(&["data.bin"; 1001]).unwrap_err().contains("buffers[1000].uri: more than 1000"));
    fs::write(folder.path().join("data.bin"), [&data()[..], &[0; 63_000]].concat()).unwrap();
    assert_closed(&read(&names).unwrap());
    fs::write(folder.path().join("other.bin"), [0; 1000]).unwrap();
    assert!(
        read(&["data.bin", "other.bin"]).unwrap_err().contains("other.bin: 1000 bytes are more than 940")
    );
}

#[test]
fn malformed_documents_are_refused_with_the_field() {
    let cases = [
        ("/asset/version", json!("1.0"), "asset.version", "only 2.0"),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            "extensionsRequired[0]",
            "without compression",
        ),
        ("/scene", json!(3), "scene", "only 1 scenes"),
        ("/scene", json!(-1), "scene", "invalid value"),
        ("/scenes/0/nodes/0", json!(7), "nodes[7]", "only 1 nodes"),
        ("/nodes/0/children", json!([0]), "nodes[0]", "comes twice"),
        ("/nodes/0/mesh", json!(1), "nodes[0].mesh", "only 1"),
        ("/nodes/0/translation", json!([1, 2]), "nodes[0].translation", "length"),
        (
            "/nodes/0/translation",
            json!([1e39, 0, 0]),
            "meshes[0].primitives[0].attributes.POSITION",
            "not finite",
        ),
        ("/meshes/0/primitives/0/attributes", json!({}), "meshes[0].primitives[0].attributes", "no POSITION"),
        ("/meshes/0/primitives/0/mode", json!(9), "meshes[0].primitives[0].mode", "no mode"),
        ("/meshes/0/primitives/0/indices", json!(5), "meshes[0].primitives[0].indices", "only 2"),
        ("/accessors/0/type", json!("VEC2"), "accessors[0]", "VEC3"),
        ("/accessors/0/componentType", json!(5123), "accessors[0]", "5126"),
        ("/accessors/0/sparse", json!({}), "accessors[0].sparse", "sparse"),
        ("/accessors/0/count", json!(1_000_000_000_000_000_000_u64), "accessors[0]", "beyond the end"),
        ("/accessors/0/count", json!(u64::MAX), "accessors[0]", "beyond the end"),
        ("/accessors/0/count", json!(3), "accessors[1]", "vertex 3, but there are only 3"),
        ("/accessors/0/byteOffset", json!(4), "accessors[0]", "beyond the end"),
        ("/accessors/0/bufferView", json!(2), "accessors[0]", "only 2"),
        ("/accessors/1/type", json!("VEC3"), "accessors[1]", "SCALAR"),
        ("/bufferViews/0/buffer", json!(1), "bufferViews[0].buffer", "no buffer 1"),
        ("/bufferViews/0/byteLength", json!(61), "bufferViews[0]", "beyond the end"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "bufferViews[0]", "beyond the end"),
        ("/bufferViews/0/byteStride", json!(8), "bufferViews[0].byteStride", "less than"),
        ("/bufferViews/0/byteStride", json!(u64::MAX), "accessors[0]", "beyond the end"),
        ("/buffers/0/byteLength", json!(61), "buffers[0].byteLength", "60 bytes"),
        ("/buffers/0/byteLength", json!("60"), "buffers[0].byteLength", "invalid type"),
    ];
    for (pointer, value, field, part) in cases {
        let (place, message) = refusal("a.glb", glb(&changed(pointer, value.clone()), &data()));
        assert!(message.contains(part), "{pointer} {value}: {message}");
        assert_eq!(place, Some(Place::Field(field.into())), "{pointer} {value}: {message}");
    }
}

#[test]
fn points_lines_and_materials_are_noted() {
    let mut document = document();
    document["materials"] = json!([{}, {}]);
    document["meshes"][0]["primitives"].as_array_mut().unwrap().push(json!({ "attributes": {}, "mode": 1 }));
    let file = parse("a.glb", glb(&document, &data())).unwrap();
    let notes: Vec<String> = file.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes, ["2 materials", "1 primitives of points or lines"]);
    document["meshes"][0]["primitives"].as_array_mut().unwrap().remove(0);
    assert!(refusal("a.glb", glb(&document, &data())).1.contains("no triangles"));
}

#[test]
fn truncations_are_refused() {
    let bytes = tetrahedron();
    assert_truncations_are_refused("a.glb", &bytes, bytes.len());
    let text = changed("/buffers/0/uri", json!(data_uri(&data()))).to_string();
    assert_truncations_are_refused("a.gltf", text.as_bytes(), text.len());
}
