//! Mesh files: what other programs write and read, every truncation, and refusals that name the place.

mod gltf;
mod hostile;
mod ply;
mod seeds;
#[path = "../worked/mod.rs"]
mod worked;

use std::path::Path;

use proptest::prelude::*;
use tautline::Vec3;
use tautline::mesh::TriMesh;
use tautline_scene::Error;
use tautline_scene::mesh_file::{self, Format, Limits, MeshFile, Place, Refusal};
use tempfile::TempDir;

const CUBE: &str = "# a cube of squares, in two groups\r\nmtllib none.mtl\r\no cube\r\n\
    v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nv 0 0 1\r\nv 1 0 1\r\nv 1 1 1\r\nv 0 1 1\r\nv 9 9 9\r\n\
    vn 0 0 1\r\nvt 0 0\r\ng sides\r\nf 4 3 2 1\r\nf 5/1/1 6/1/1 7/1/1 8/1/1\r\nf 1//1 2//1 6//1 5//1\r\n\
    g others\r\nf 2/1 3/1 7/1 6/1 # seen from +X\r\nf 3 4 8 7\r\nf -9 -5 -2 -6\r\n";

fn parse(name: &str, bytes: impl AsRef<[u8]>) -> Result<MeshFile, Refusal> {
    mesh_file::parse(bytes.as_ref(), Format::of(Path::new(name)).unwrap(), &Limits::default())
}

fn read(name: &str, bytes: impl AsRef<[u8]>) -> TriMesh {
    parse(name, bytes).unwrap().mesh
}

/// The place and the message of a refusal.
fn refusal(name: &str, bytes: impl AsRef<[u8]>) -> (Option<Place>, String) {
    let refusal = parse(name, bytes).unwrap_err();
    (refusal.place, refusal.message)
}

/// The corners of the triangles, whatever the order of the vertices.
fn corners(mesh: &TriMesh) -> Vec<[Vec3; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize])).collect()
}

/// Volume by the divergence theorem; independent of the origin only if the surface is closed.
fn volume(mesh: &TriMesh, origin: Vec3) -> f32 {
    corners(mesh).iter().map(|&[a, b, c]| (a - origin).dot((b - origin).cross(c - origin)) / 6.0).sum()
}

fn assert_closed(mesh: &TriMesh) {
    let edges: Vec<[u32; 2]> =
        mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    for &[a, b] in &edges {
        assert_eq!(edges.iter().filter(|&&edge| edge == [b, a]).count(), 1, "{a} {b}");
    }
}

/// A text STL of a mesh.
fn text_stl(mesh: &TriMesh) -> String {
    let mut text = "solid a b\n".to_owned();
    for corners in corners(mesh) {
        text += "facet normal nan 0 0\n outer loop\n";
        for corner in corners {
            text += &format!("  vertex {} {} {}\n", corner.x, corner.y, corner.z);
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid a b"
}

/// A binary STL of a mesh, written by another library.
fn binary_stl(mesh: &TriMesh) -> Vec<u8> {
    let facet = |corners: &[Vec3; 3]| stl_io::Triangle {
        normal: stl_io::Normal::new([0.0; 3]),
        vertices: corners.map(|corner| stl_io::Vertex::new(corner.to_array())),
    };
    let facets: Vec<_> = corners(mesh).iter().map(facet).collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, facets.iter()).unwrap();
    bytes
}

#[test]
fn an_obj_of_groups_and_polygons_is_one_closed_surface() {
    for text in [CUBE.to_owned(), CUBE.replace('\r', "")] {
        let file = parse("cube.OBJ", text).unwrap();
        assert_eq!(
            file.notes.iter().map(ToString::to_string).collect::<Vec<_>>(),
            ["1 lines about materials"]
        );
        assert_eq!(file.mesh.positions.len(), 9, "as the file counts them");
        let mesh = file.without_unused_vertices();
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12));
        assert_closed(&mesh);
        assert_eq!(volume(&mesh, Vec3::ZERO), 1.0);
    }
}

#[test]
fn an_obj_has_the_triangles_that_another_reader_finds() {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    // It knows comments only on lines of their own.
    let cube = CUBE.replace(" # seen from +X", "");
    let (models, _) =
        tobj::load_obj_buf(&mut cube.as_bytes(), &options, |_| Err(tobj::LoadError::OpenFileFailed)).unwrap();
    let expected: Vec<[Vec3; 3]> = models
        .iter()
        .flat_map(|model| {
            let position = |&index: &u32| Vec3::from_slice(&model.mesh.positions[3 * index as usize..]);
            model
                .mesh
                .indices
                .as_chunks::<3>()
                .0
                .iter()
                .map(move |triangle| triangle.each_ref().map(position))
        })
        .collect();
    assert_eq!(corners(&read("cube.obj", CUBE)), expected);
}

#[test]
fn stl_corners_become_shared_vertices() {
    let cube = read("cube.obj", CUBE);
    let files: [(&str, Vec<u8>); 4] = [
        ("text", text_stl(&cube).into()),
        ("text with CRLF", text_stl(&cube).replace('\n', "\r\n").into()),
        ("capitals, negative zeros", text_stl(&cube).to_uppercase().replace(" 0 ", " -0 ").into()),
        ("binary", binary_stl(&cube)),
    ];
    for (what, bytes) in files {
        let mesh = read("cube.stl", bytes);
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12), "{what}");
        assert_closed(&mesh);
        assert_eq!(corners(&mesh), corners(&cube), "{what}");
    }
}

#[test]
fn a_binary_stl_may_begin_like_a_text() {
    let mut bytes = binary_stl(&read("cube.obj", CUBE));
    bytes[..6].copy_from_slice(b"solid ");
    assert_eq!(read("cube.stl", bytes).triangles.len(), 12);
}

#[test]
fn malformed_files_are_refused_with_the_line() {
    let obj = |face: &str| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}\n");
    let cases = [
        ("a.obj", obj("f 0 1 2"), Some(4), "the first vertex is 1"),
        ("a.obj", obj("f 1 2 4"), Some(4), "names vertex 4, but there are only 3"),
        ("a.obj", obj("f 1 2 -4"), Some(4), "names vertex -4, but there are only 3"),
        ("a.obj", obj("f 1 2 99999999999"), Some(4), "99999999999"),
        ("a.obj", obj("f 1 2 -9223372036854775808"), Some(4), "-9223372036854775808"),
        ("a.obj", obj("f 1 2 x"), Some(4), "\"x\" is not a corner"),
        ("a.obj", obj("f 1 2 \\\n3"), Some(4), "write it in one"),
        ("a.obj", obj("f 1 2 3\\\n1"), Some(4), "write it in one"),
        ("a.obj", obj("f 1 2"), Some(4), "2 corners"),
        ("a.obj", obj("f"), Some(4), "0 corners"),
        ("a.obj", obj("v 0 nan 0"), Some(4), "finite"),
        ("a.obj", obj("v 0 1e99 0"), Some(4), "finite"),
        ("a.obj", obj("v 0 0"), Some(4), "three coordinates"),
        ("a.obj", obj("# nothing"), None, "no faces"),
        ("a.obj", String::new(), None, "no faces"),
        (
            "a.stl",
            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n".into(),
            Some(4),
            "\"inf\" is not a coordinate",
        ),
        ("a.stl", "solid\n\nfacet normal 0 0 1\nouter loop\nvertex 0 0".into(), Some(5), "the file ends"),
        ("a.stl", "solid\nendsolid".into(), None, "no triangles"),
        ("a.stl", "solid".into(), Some(1), "the file ends"),
        ("a.stl", "solid\nfacets".into(), Some(2), "\"facets\" is not `facet`"),
        ("a.stl", "x".repeat(200), None, "announces"),
        ("a.stl", String::new(), None, "neither"),
    ];
    for (name, text, line, part) in cases {
        let (place, message) = refusal(name, &text);
        assert_eq!(place, line.map(Place::Line), "{text:?}: {message}");
        assert!(message.contains(part), "{text:?}: {message}");
    }
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_text() {
    let [ply, ..] = ply::pyramids();
    for (name, bytes) in [
        ("a.obj", CUBE.as_bytes().to_vec()),
        ("a.stl", text_stl(&read("cube.obj", CUBE)).into_bytes()),
        ("a.ply", ply),
    ] {
        let marked = [b"\xef\xbb\xbf", &bytes[..]].concat();
        assert_eq!(parse(name, &marked).unwrap(), parse(name, &bytes).unwrap(), "{name}");
    }
}

#[test]
fn what_is_something_else_than_its_name_says_is_told() {
    let utf_16 = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(bytes).collect()
    };
    for name in ["a.obj", "a.stl", "a.ply", "a.gltf", "a.glb"] {
        for (bytes, part) in [
            (utf_16(CUBE, u16::to_le_bytes), "save it as UTF-8"),
            (utf_16(CUBE, u16::to_be_bytes), "save it as UTF-8"),
            (b"\x1f\x8b\x08\0".repeat(50), "gzip"),
            (b"PK\x03\x04".repeat(50), "ZIP"),
            (CUBE.replace("\r\n", "\r").replace('\n', "\r").into_bytes(), "CR alone"),
            (b"solid a\rendsolid a\r".to_vec(), "CR alone"),
            (b"ply\rformat ascii 1.0\r".to_vec(), "CR alone"),
        ] {
            let message = refusal(name, &bytes).1;
            assert!(message.contains(part), "{name}: {message}");
        }
    }
}

#[test]
fn every_truncation_is_refused_or_whole() {
    let cube = read("cube.obj", CUBE);
    let text = text_stl(&cube);
    let last_keyword = text.rfind("endsolid").unwrap() + "endsolid".len();
    let binary = binary_stl(&cube);
    let first_face = CUBE.find("\r\nf ").unwrap();
    assert_truncations_are_refused("cube.obj", CUBE.as_bytes(), first_face);
    assert_truncations_are_refused("cube.stl", text.as_bytes(), last_keyword);
    assert_truncations_are_refused("cube.stl", &binary, binary.len());
}

/// What is left of a file that was cut off is refused, or has at least the bytes that are needed and is sound.
fn assert_truncations_are_refused(name: &str, bytes: &[u8], needed: usize) {
    for end in 0..bytes.len() {
        if let Ok(MeshFile { mesh, .. }) = parse(name, &bytes[..end]) {
            assert!(end >= needed, "{name} {end}");
            assert!(mesh.triangles.as_flattened().iter().all(|&v| (v as usize) < mesh.positions.len()));
        }
    }
}

#[test]
fn a_count_that_the_file_cannot_hold_is_refused_without_being_believed() {
    let mut bytes = binary_stl(&read("cube.obj", CUBE));
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(refusal("cube.stl", &bytes).1.contains("announces"));
    bytes[80..84].copy_from_slice(&12u32.to_le_bytes());
    bytes[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(refusal("cube.stl", &bytes).1.contains("triangle 1"));
}

#[test]
fn a_path_must_stay_in_the_folder() {
    let outer = TempDir::new().unwrap();
    let folder = outer.path().join("scenes");
    std::fs::create_dir_all(folder.join("meshes")).unwrap();
    std::fs::write(outer.path().join("secret.obj"), CUBE).unwrap();
    std::fs::write(folder.join("meshes/cube.obj"), CUBE).unwrap();
    let inside = |path: &str| mesh_file::read_inside(&folder, path, &Limits::default());
    let is_read = |path: &str| inside(path).is_ok();
    assert!(is_read("meshes/cube.obj"));
    assert!(is_read("./meshes/cube.obj"));
    let absolute = outer.path().join("secret.obj");
    for path in [
        "",
        "../secret.obj",
        "meshes/../../secret.obj",
        "meshes/../meshes/cube.obj",
        absolute.to_str().unwrap(),
    ] {
        assert!(matches!(inside(path), Err(Error::Mesh { .. })), "{path}");
    }
    std::fs::create_dir(folder.join("folder.obj")).unwrap();
    for path in ["meshes/none.obj", "folder.obj"] {
        assert!(matches!(inside(path), Err(Error::Io { .. })), "{path}");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../../secret.obj", folder.join("meshes/out.obj")).unwrap();
        std::os::unix::fs::symlink("cube.obj", folder.join("meshes/in.obj")).unwrap();
        assert!(matches!(inside("meshes/out.obj"), Err(Error::Mesh { .. })));
        assert!(is_read("meshes/in.obj"));
    }
}

/// A polygon with corners on rays around the origin, some of them far in: star-shaped, not convex.
fn star(radii: &[f32]) -> Vec<Vec3> {
    let corner = |(i, &radius): (usize, &f32)| {
        let angle = std::f32::consts::TAU * i as f32 / radii.len() as f32;
        Vec3::new(radius * angle.cos(), 2.0, -radius * angle.sin())
    };
    radii.iter().enumerate().map(corner).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn a_polygon_is_covered_once(radii in prop::collection::vec(0.1f32..1.0, 3..30)) {
        let polygon = star(&radii);
        let mut text: String = polygon.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
        text += "f";
        text.extend((1..=polygon.len()).map(|i| format!(" {i}")));
        let mesh = read("star.obj", text);
        prop_assert_eq!(mesh.triangles.len(), polygon.len() - 2);
        // No triangle turns the other way, and together they have the polygon's area: no overlap, no gap.
        let areas: Vec<f32> = corners(&mesh).iter().map(|[a, b, c]| (b - a).cross(c - a).y / 2.0).collect();
        let expected: f32 =
            polygon.iter().zip(polygon.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b).y / 2.0).sum();
        prop_assert!(areas.iter().all(|&area| area > -1e-6), "{areas:?}");
        prop_assert!((areas.iter().sum::<f32>() - expected).abs() < 1e-5);
    }

    #[test]
    fn no_bytes_break_a_reader(bytes in prop::collection::vec(any::<u8>(), 0..300), damage in 0usize..400, byte: u8) {
        for name in ["noise.stl", "noise.obj", "noise.ply", "noise.glb"] {
            let _ = parse(name, &bytes);
        }
        let mut damaged = CUBE.as_bytes().to_vec();
        let place = damage % damaged.len();
        damaged[place] = byte;
        let _ = parse("damaged.obj", &damaged);
    }
}
