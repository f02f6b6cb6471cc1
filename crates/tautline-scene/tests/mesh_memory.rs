//! What reading a mesh file takes: at most ten times the memory of the file, also where the file is made to take more.
//! Alone in its program, since it looks at the memory of the whole.
#![cfg(target_os = "linux")]

use std::fs;
use std::process::Command;

use tautline_scene::mesh_file::{Format, Limits, parse};

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

type Case = (&'static str, Format, fn() -> Vec<u8>);

const SIZE: usize = 8 << 20;

const CASES: [Case; 9] = [
    ("vertices", Format::Obj, || (lines("v 0 0 0\n") + "f 1 2 3").into()),
    ("triangles", Format::Obj, || ("v 0 0 0\n".to_owned() + &lines("f 1 1 1\n")).into()),
    ("one face", Format::Obj, || ("v 0 0 0\nf".to_owned() + &lines(" 1")).into()),
    ("bytes that are no text", Format::Obj, || [vec![b'#'], vec![0xff; SIZE]].concat()),
    ("facets", Format::Stl, || {
        let mut bytes = vec![0; 84 + SIZE / 50 * 50];
        bytes[80..84].copy_from_slice(&(SIZE as u32 / 50).to_le_bytes());
        bytes
    }),
    ("facets as text", Format::Stl, || {
        let facet = "facet outer loop\n outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet\n";
        ("solid\n".to_owned() + &lines(facet) + "endsolid").into()
    }),
    ("triangles of bytes", Format::Ply, || {
        let count = SIZE / 4;
        ply(1, count, &[&[0; 3], &b"\x03\0\0\0".repeat(count)[..]].concat())
    }),
    ("large faces", Format::Ply, large_faces),
    ("empty nodes", Format::Gltf, || {
        format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", lines("{},")).into()
    }),
];

fn lines(line: &str) -> String {
    line.repeat(SIZE / line.len())
}

/// Names the case that a run of this program is for.
const WHICH: &str = "MESH_MEMORY_CASE";

/// Every file is read by a program of its own: what is freed is not given back to the system at once.
#[test]
fn reading_takes_at_most_ten_times_the_file() {
    let Ok(which) = std::env::var(WHICH) else {
        for (case, (what, ..)) in CASES.iter().enumerate() {
            let mut child = Command::new(std::env::current_exe().unwrap());
            let done = child.args(["--exact", "reading_takes_at_most_ten_times_the_file", "--nocapture"]);
            let done = done.env(WHICH, case.to_string()).status().unwrap();
            assert!(done.success(), "{what}");
        }
        return;
    };
    let (what, format, bytes) = CASES[which.parse::<usize>().unwrap()];
    let bytes = bytes();
    let before = peak();
    let outcome = parse(&bytes, format, &Limits::default());
    let taken = peak() - before;
    let told = outcome.map(|file| file.mesh.triangles.len());
    println!("{what}: {:.1} × the file: {told:?}", taken as f64 / bytes.len() as f64 + 1.0);
    // The file itself is in memory too.
    assert!(taken + bytes.len() <= 10 * bytes.len(), "{what}: {taken} for {} bytes", bytes.len());
}
