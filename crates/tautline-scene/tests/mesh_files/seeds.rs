//! The seeds that fuzzing begins with, and what it found: each is read, or refused in words.

use std::fs;
use std::path::PathBuf;

use tautline_scene::document;
use tautline_scene::mesh_file::{Format, Limits, parse};

fn seeds(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(target);
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(path).unwrap())).collect()
}

#[test]
fn seeds_of_mesh_files_are_read() {
    for (target, format) in
        [("obj", Format::Obj), ("stl", Format::Stl), ("ply", Format::Ply), ("gltf", Format::Gltf)]
    {
        let seeds = seeds(target);
        assert!(seeds.len() > 1, "{target}");
        for (path, bytes) in seeds {
            let file = parse(&bytes, format, &Limits::default());
            assert!(file.is_ok_and(|file| !file.mesh.triangles.is_empty()), "{}", path.display());
        }
    }
}

#[test]
fn seeds_of_scenes_are_sound() {
    for (path, bytes) in seeds("scene") {
        let text = std::str::from_utf8(&bytes[1..]).unwrap();
        let format =
            [document::Format::Json, document::Format::Json5, document::Format::Toml][bytes[0] as usize % 3];
        document::parse(text, format)
            .unwrap()
            .check()
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}
