//! What reading a file takes: at most ten times the memory of the file, also where the file is made to take more. Alone in
//! its program, since it looks at the memory of the whole.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use tautline::Vec3;
use tautline::mesh::TriMesh;
use tautline_scene::document;
use tautline_scene::mesh_file::{self, Format, Limits, read_mesh, write_mesh};

/// The most memory that this program has ever had in use, in bytes.
fn peak() -> usize {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<usize>().unwrap() * 1024
}

fn ply(vertices: usize, faces: usize, body: &[u8]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty char x\nproperty char y\n\
         property char z\nelement face {faces}\nproperty list uchar uchar vertex_indices\nend_header\n"
    )
    .into_bytes();
    bytes.extend(body);
    bytes
}

/// Faces of 255 corners that are one byte each, on a circle so that all are convex.
fn large_faces() -> Vec<u8> {
    let mut body = Vec::new();
    for i in 0..40_u8 {
        let angle = std::f64::consts::TAU * f64::from(i) / 40.0;
        body.extend([(100.0 * angle.cos()) as i8 as u8, (100.0 * angle.sin()) as i8 as u8, 0]);
    }
    let face: Vec<u8> = std::iter::once(40).chain(0..40).collect();
    body.extend(face.repeat(100_000));
    ply(40, 100_000, &body)
}

/// What it is, its extension, and its bytes.
type Case = (&'static str, &'static str, fn() -> Vec<u8>);

const SIZE: usize = 8 << 20;

const CASES: [Case; 45] = [
    ("vertices", "obj", || (lines("v 0 0 0\n") + "f 1 2 3").into()),
    ("triangles", "obj", || ("v 0 0 0\n".to_owned() + &lines("f 1 1 1\n")).into()),
    ("one face", "obj", || ("v 0 0 0\nf".to_owned() + &lines(" 1")).into()),
    ("bytes that are no text", "obj", || [vec![b'#'], vec![0xff; SIZE]].concat()),
    ("facets", "stl", || {
        let mut bytes = vec![0; 84 + SIZE / 50 * 50];
        bytes[80..84].copy_from_slice(&(SIZE as u32 / 50).to_le_bytes());
        bytes
    }),
    ("facets as text", "stl", || {
        let facet = "facet outer loop\n outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet\n";
        ("solid\n".to_owned() + &lines(facet) + "endsolid").into()
    }),
    ("triangles of bytes", "ply", || {
        let count = SIZE / 4;
        ply(1, count, &[&[0; 3], &b"\x03\0\0\0".repeat(count)[..]].concat())
    }),
    ("large faces", "ply", large_faces),
    ("empty nodes", "gltf", || {
        format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", lines("{},")).into()
    }),
    ("children", "gltf", || {
        format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"children\":[{}1]}}]}}", lines("1,"))
            .into()
    }),
    ("nodes of a scene", "gltf", || {
        let nodes = format!("\"scenes\":[{{\"nodes\":[{}0]}}],\"nodes\":[{{}}]", lines("0,"));
        format!("{{\"asset\":{{\"version\":\"2.0\"}},{nodes}}}").into()
    }),
    ("nodes that show a mesh", "gltf", || {
        let nodes =
            format!("\"nodes\":[{}{{}}],\"meshes\":[{{\"primitives\":[]}}]", lines("{\"mesh\":0  },"));
        format!("{{\"asset\":{{\"version\":\"2.0\"}},{nodes}}}").into()
    }),
    ("bodies", "json", || list("bodies", "{\"rope\":{}},")),
    ("cues", "json", || list("cues", "{},")),
    ("vertices of a scene", "json", || vertices("[0,0,0],")),
    ("brackets", "json", || vec![b'['; SIZE]),
    ("bodies in JSON5", "json5", || list("bodies", "{rope:{}},")),
    ("vertices in JSON5", "json5", || vertices("[0,0,0],")),
    ("tables in TOML", "toml", || toml(&lines("[[bodies]]\n"))),
    ("bodies in TOML", "toml", || toml(&lines("[[bodies]]\nrope={}\n"))),
    ("bodies with headers in TOML", "toml", || toml(&lines("[[bodies]]\n[bodies.rope]\n"))),
    ("bodies between comments in TOML", "toml", || {
        toml(&lines(&format!("# {}\n[[bodies]]\nrope={{}}\n", "x".repeat(600))))
    }),
    ("inline bodies in TOML", "toml", || toml(&format!("bodies=[{}]", lines("{rope={}},")))),
    ("vertices in TOML", "toml", || {
        toml(&format!("[[bodies]]\ncloth.surface.mesh.positions=[{}]", lines("[0,0,0],")))
    }),
    ("numbers in TOML", "toml", || toml(&format!("bodies=[{}]", lines("0,")))),
    ("empty tables in TOML", "toml", || toml(&format!("bodies=[{}]", lines("{},")))),
    ("tables with keys in TOML", "toml", || toml(&format!("bodies=[{}]", lines("{a.b=1,a.c=2},")))),
    ("one table in TOML", "toml", || toml(&format!("bodies={{{}}}", names("=1,")))),
    ("lists in TOML", "toml", || toml(&format!("bodies=[{}]", lines("[],")))),
    ("lists in lists in TOML", "toml", || {
        let deep = "[".repeat(60) + &"]".repeat(60) + ",";
        toml(&format!("bodies=[{}]", lines(&deep)))
    }),
    ("open brackets in TOML", "toml", || toml(&format!("bodies={}", lines("[")))),
    ("names in TOML", "toml", || toml(&names("={}\n"))),
    ("the same name in TOML", "toml", || toml(&lines("a={}\n"))),
    ("headers in TOML", "toml", || toml(&format!("[a.{}", names("]\n[a.")))),
    ("the same header in TOML", "toml", || toml(&lines("[a.b]\n"))),
    ("tables in tables in TOML", "toml", || toml(&lines("[[a]]\n[a.b]\n"))),
    ("long headers in TOML", "toml", || toml(&lines(&format!("[[a{}]]\n", ".a".repeat(60))))),
    ("many keys in tables in TOML", "toml", || {
        toml(&lines(&(0..490).fold("[[a]]\n".to_owned(), |text, i| text + &format!("{i}=0\n"))))
    }),
    ("dots in TOML", "toml", || toml(&lines("a."))),
    ("dotted keys in TOML", "toml", || toml(&format!("[[a]]\n{}", names(".a=1\n[[a]]\n")))),
    ("comments in TOML", "toml", || toml(&lines("#\n"))),
    ("text of lines in TOML", "toml", || toml(&format!("name='''{}'''", lines("\n")))),
    ("text of escapes in TOML", "toml", || toml(&format!("name=\"{}\"", lines("\\e")))),
    ("a name of escapes in TOML", "toml", || toml(&format!("\"{}\"=1", lines("\\e")))),
    ("an open text in TOML", "toml", || toml(&format!("name='''{}", lines("\\")))),
];

/// Reads a file as its extension says, and says what came of it.
fn read(bytes: &[u8], path: &Path) -> String {
    if let Some(format) = Format::of(path) {
        let outcome = mesh_file::parse(bytes, format, &Limits::default());
        return format!("{:?}", outcome.map(|file| file.mesh.triangles.len()));
    }
    let format = document::Format::of_path(path).unwrap();
    let outcome = document::parse(std::str::from_utf8(bytes).unwrap(), format);
    outcome.map_or_else(|error| error.to_string(), |scene| format!("{} bodies", scene.bodies.len()))
}

/// A scene whose list has many of an item.
fn list(name: &str, item: &str) -> Vec<u8> {
    format!("{{\"tautline\":1,\"{name}\":[{}]}}", lines(item)).into()
}

/// A scene of one mesh with many vertices.
fn vertices(vertex: &str) -> Vec<u8> {
    let vertices = lines(vertex);
    let vertices = vertices.trim_end_matches(',');
    let mesh = format!("{{\"positions\":[{vertices}],\"triangles\":[]}}");
    format!("{{\"tautline\":1,\"bodies\":[{{\"cloth\":{{\"surface\":{{\"mesh\":{mesh}}}}}}}]}}").into()
}

fn lines(line: &str) -> String {
    line.repeat(SIZE / line.len())
}

fn toml(text: &str) -> Vec<u8> {
    format!("tautline=1\n{text}").into()
}

/// Many names, each with the same after it.
fn names(rest: &str) -> String {
    (0..SIZE / (6 + rest.len())).fold(String::new(), |text, i| text + &format!("{i:06}") + rest)
}

/// Names the file that a run of this program is to read.
const FILE: &str = "MEMORY_FILE";

/// Runs a test of this program on a file, in a program of its own: what has been freed is not given back to the system.
fn run_alone(test: &str, path: &Path) {
    let mut program = Command::new(std::env::current_exe().unwrap());
    let arguments = ["--exact", test, "--nocapture", "--include-ignored"];
    assert!(program.args(arguments).env(FILE, path).status().unwrap().success(), "{}", path.display());
}

#[test]
fn reading_takes_at_most_ten_times_the_file() {
    let Some(path) = std::env::var_os(FILE).map(PathBuf::from) else {
        let folder = tempfile::tempdir().unwrap();
        for (what, extension, bytes) in CASES {
            let path = folder.path().join(what).with_extension(extension);
            fs::write(&path, bytes()).unwrap();
            run_alone("reading_takes_at_most_ten_times_the_file", &path);
            fs::remove_file(path).unwrap();
        }
        return;
    };
    let bytes = fs::read(&path).unwrap();
    let (before, start) = (peak(), Instant::now());
    let outcome = read(&bytes, &path);
    let (taken, seconds) = (peak() - before, start.elapsed().as_secs_f64());
    let what = path.file_name().unwrap().display();
    let times = taken as f64 / bytes.len() as f64 + 1.0;
    println!("{what}: {times:.1} × the file in {seconds:.2} s: {outcome}");
    // The file itself is in memory too.
    assert!(taken + bytes.len() <= 10 * bytes.len(), "{what}: {taken} for {} bytes", bytes.len());
}

/// A hilly square of so many vertices along each edge.
fn hills(count: usize) -> TriMesh {
    let at = |i: usize| (i as f32 * 0.0137).sin() + i as f32 * 0.01;
    let positions =
        (0..count * count).map(|i| Vec3::new(at(i % count), at(i) * 1e-3, at(i / count))).collect();
    let cell = |i: usize| {
        let a = (i / (count - 1) * count + i % (count - 1)) as u32;
        let (b, c) = (a + 1, a + count as u32);
        [[a, c, b], [b, c, c + 1]]
    };
    TriMesh { positions, triangles: (0..(count - 1) * (count - 1)).flat_map(cell).collect() }
}

/// Files of some 100 MB, of which no mesh has been made to take more.
#[test]
#[ignore = "half a minute: by its name, to know how much large files take"]
fn large_files_take_a_few_times_their_size() {
    let Some(path) = std::env::var_os(FILE).map(PathBuf::from) else {
        let folder = tempfile::tempdir().unwrap();
        for (name, count) in [("large.obj", 1240), ("large.stl", 1010), ("large.ply", 1650)] {
            let path = folder.path().join(name);
            write_mesh(&hills(count), &path).unwrap();
            run_alone("large_files_take_a_few_times_their_size", &path);
            fs::remove_file(path).unwrap();
        }
        return;
    };
    let bytes = fs::metadata(&path).unwrap().len() as usize;
    let limits =
        Limits { file_bytes: u64::MAX, vertices: usize::MAX, triangles: usize::MAX, ..Limits::default() };
    let (before, start) = (peak(), Instant::now());
    let file = read_mesh(&path, &limits).unwrap();
    let (taken, seconds) = (peak() - before, start.elapsed().as_secs_f64());
    println!(
        "{}: {:.1} × {} MB in {seconds:.2} s, of which the mesh is {} MB",
        path.file_name().unwrap().display(),
        taken as f64 / bytes as f64,
        bytes / 1_000_000,
        12 * (file.mesh.positions.len() + file.mesh.triangles.len()) / 1_000_000
    );
    assert!(taken <= 10 * bytes, "{taken} for {bytes} bytes");
}
