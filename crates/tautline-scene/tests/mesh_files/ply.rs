//! PLY: the three encodings, faces before vertices, unknown elements, and every refusal.

use tautline_scene::mesh_file::Place;

use super::{CUBE, assert_closed, assert_truncations_are_refused, parse, read, refusal, volume};

/// A tetrahedron with what other programs add: a comment, normals, colours, a list, edges.
pub(super) const TEXT: &str = "ply\nformat ascii 1.0\ncomment made by hand – ünïcode\nobj_info nothing\n\
    element vertex 4\nproperty float nx\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n\
    property list uchar short marks\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n\
    element face 4\nproperty uchar quality\nproperty list uchar int vertex_indices\nend_header\n\
    nan 0 0 0 255 0\n0 1 0 0 0 2 7 8\n0 0 1 0 0 0\n0 0 0 1 0 0\n0 1\n1 2\n\
    9 3 0 2 1\n9 3 0 1 3\n9 3 1 2 3\n9 3 0 3 2\n";

/// A square pyramid, faces first, in the encoding and byte order of `put`.
fn pyramid(format: &str, put: impl Fn(&mut Vec<u8>, f64, &str)) -> Vec<u8> {
    let mut bytes = format!(
        "ply\r\nformat {format} 1.0\r\nelement face 5\r\nproperty list uint8 uint16 vertex_index\r\nproperty int8 flag\r\n\
         element vertex 5\r\nproperty float64 x\r\nproperty int16 y\r\nproperty float32 z\r\nelement none 1000000000000\r\n\
         end_header\r\n"
    )
    .into_bytes();
    for face in [&[0, 1, 2, 3][..], &[0, 4, 1], &[1, 4, 2], &[2, 4, 3], &[3, 4, 0]] {
        put(&mut bytes, face.len() as f64, "u8");
        face.iter().for_each(|&corner| put(&mut bytes, f64::from(corner), "u16"));
        put(&mut bytes, -1.0, "i8");
    }
    for [x, y, z] in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.5, 3.0, 0.5]] {
        put(&mut bytes, x, "f64");
        put(&mut bytes, y, "i16");
        put(&mut bytes, z, "f32");
    }
    bytes
}

fn little_endian(number: f64, kind: &str) -> Vec<u8> {
    match kind {
        "u8" => vec![number as u8],
        "i8" => (number as i8).to_le_bytes().into(),
        "u16" => (number as u16).to_le_bytes().into(),
        "i16" => (number as i16).to_le_bytes().into(),
        "f32" => (number as f32).to_le_bytes().into(),
        _ => number.to_le_bytes().into(),
    }
}

pub(super) fn pyramids() -> [Vec<u8>; 3] {
    [
        pyramid("ascii", |bytes, number, _| bytes.extend(format!("{number} ").bytes())),
        pyramid("binary_little_endian", |bytes, number, kind| bytes.extend(little_endian(number, kind))),
        pyramid("binary_big_endian", |bytes, number, kind| {
            bytes.extend(little_endian(number, kind).iter().rev())
        }),
    ]
}

#[test]
fn a_text_with_all_kinds_of_columns_is_read() {
    for text in [TEXT.to_owned(), TEXT.replace('\n', "\r\n"), TEXT.trim_end().to_owned()] {
        let file = parse("a.PLY", text).unwrap();
        assert_eq!(file.mesh.positions.len(), 4);
        assert_closed(&file.mesh);
        assert_eq!(volume(&file.mesh, tautline::Vec3::ZERO), 1.0 / 6.0);
        assert_eq!(file.notes.iter().map(ToString::to_string).collect::<Vec<_>>(), ["2 elements \"edge\""]);
    }
}

#[test]
fn the_three_encodings_say_the_same() {
    let [text, little, big] = pyramids();
    let mesh = read("a.ply", text);
    assert_closed(&mesh);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (5, 6));
    assert_eq!(volume(&mesh, tautline::Vec3::X), 1.0);
    assert_eq!(read("a.ply", little), mesh);
    assert_eq!(read("a.ply", big), mesh);
}

#[test]
fn what_is_written_is_read_to_the_bit() {
    let mesh = read("cube.obj", CUBE);
    let folder = tempfile::TempDir::new().unwrap();
    for name in ["cube.ply", "cube.obj"] {
        let path = folder.path().join(name);
        tautline_scene::mesh_file::write_mesh(&mesh, &path).unwrap();
        assert_eq!(read(name, std::fs::read(path).unwrap()), mesh);
    }
    let path = folder.path().join("cube.stl");
    tautline_scene::mesh_file::write_mesh(&mesh, &path).unwrap();
    assert_eq!(super::corners(&read("cube.stl", std::fs::read(path).unwrap())), super::corners(&mesh));
    assert!(tautline_scene::mesh_file::write_mesh(&mesh, &folder.path().join("cube.glb")).is_err());
}

#[test]
fn truncations_are_refused() {
    // The last digit may be missing: what remains is a number too.
    assert_truncations_are_refused("a.ply", TEXT.as_bytes(), TEXT.len() - 1);
    let [text, little, big] = pyramids();
    assert_truncations_are_refused("a.ply", &text, text.len() - 3);
    assert_truncations_are_refused("a.ply", &little, little.len());
    assert_truncations_are_refused("a.ply", &big, big.len());
}

#[test]
fn malformed_files_are_refused_with_the_place() {
    let changed = |from: &str, to: &str| {
        assert!(TEXT.contains(from), "{from}");
        TEXT.replacen(from, to, 1)
    };
    let cases = [
        (String::new(), None, "does not end"),
        ("plx\n".into(), Some(1), "the first line"),
        (changed("ascii", "morse"), Some(2), "\"morse\" is none of"),
        (changed("element vertex 4", "element vertex four"), Some(5), "\"four\""),
        (changed("element vertex 4", "element vertex -4"), Some(5), "\"-4\""),
        (changed("element edge 2", "element vertex 2"), Some(12), "comes twice"),
        (changed("property float nx", "property half nx"), Some(6), "\"half\""),
        (changed("property list uchar short", "property list float short"), Some(11), "whole number"),
        (changed("property float nx", "property float nx ny nz"), Some(6), "`property TYPE NAME`"),
        (changed("obj_info", "what is this"), Some(4), "\"what is this nothing\""),
        (changed("format ascii 1.0\n", ""), Some(17), "no line `format`"),
        (changed("end_header\n", ""), Some(18), "is not a line"),
        (changed("float x", "float u"), None, "no property x"),
        (changed("element vertex", "element points"), None, "no element vertex"),
        (changed("element face", "element faces"), None, "points alone"),
        (changed("vertex_indices", "corners"), None, "vertex_indices"),
        (changed("1 0 0 0 2 7 8", "1 NaN 0 0 2 7 8"), Some(20), "\"NaN\" is not a coordinate"),
        (changed("1 0 0 0 2 7 8", "1 1e40 0 0 2 7 8"), Some(20), "\"1e40\""),
        (changed("9 3 0 2 1", "9 3 0 2 4"), Some(25), "vertex 4, but there are only 4"),
        (changed("9 3 0 2 1", "9 3 0 2 -1"), Some(25), "vertex -1"),
        (changed("9 3 0 2 1", "9 3 0 2 1.5"), Some(25), "\"1.5\" is not a whole number"),
        (changed("9 3 0 2 1", "9 2 0 2"), Some(25), "2 corners"),
        (changed("9 3 0 2 1", "9 -3 0 2 1"), Some(25), "-3 entries"),
        (changed("element face 4", "element face 5"), Some(28), "the file ends"),
        (changed("element face 4", "element face 0"), None, "no faces"),
        (changed("element face 4", "element face 1000000000000000000"), None, "announces"),
        (changed("element vertex 4", "element vertex 1000000000000000000"), None, "more than"),
    ];
    for (text, line, part) in cases {
        let (place, message) = refusal("a.ply", &text);
        assert!(message.contains(part), "{text}\n{message}");
        assert_eq!(place, line.map(Place::Line), "{text}\n{message}");
    }
}

#[test]
fn a_header_of_lines_that_end_in_cr_alone_is_refused() {
    let [_, little, big] = pyramids();
    for file in [little, big] {
        let numbers = file.windows(12).position(|window| window == b"end_header\r\n").unwrap() + 12;
        let header = file[..numbers].iter().copied().filter(|&byte| byte != b'\n');
        let file: Vec<u8> = header.chain(file[numbers..].iter().copied()).chain([b'\n']).collect();
        let (place, message) = refusal("a.ply", &file);
        assert_eq!(place, Some(Place::Line(1)));
        assert!(message.contains("end in CR alone"), "{message}");
    }
}

#[test]
fn binary_refusals_name_the_byte() {
    let [_, little, _] = pyramids();
    let end = little.len();
    let mut bytes = little.clone();
    bytes[end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(refusal("a.ply", &bytes), (Some(Place::Byte(end)), "a coordinate that is not finite".into()));
    let (place, message) = refusal("a.ply", &little[..end - 1]);
    assert!(place.is_some() && message.contains("do not fit"), "{message}");
    let first_count = little.windows(12).position(|window| window == b"end_header\r\n").unwrap() + 12;
    let mut bytes = little;
    bytes[first_count] = 255;
    assert!(refusal("a.ply", &bytes).0.is_some());
}
