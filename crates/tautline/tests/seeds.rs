//! The seeds that fuzzing begins with, run by the code of its targets.

#[path = "../../../fuzz/src/distance.rs"]
mod distance;
#[path = "../../../fuzz/src/repair.rs"]
mod repair;
#[path = "../../../fuzz/src/world/mod.rs"]
mod world;

use std::fs;
use std::path::Path;

/// Runs every seed of a target; its name is told if it fails.
fn run_seeds(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(target);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() > 1, "{target}");
    for path in paths {
        println!("{}", path.display());
        run(&fs::read(path).unwrap());
    }
}

#[test]
fn seeds_of_distances_are_measured() {
    run_seeds("distance", distance::run);
}

#[test]
fn seeds_of_meshes_are_repaired() {
    run_seeds("repair", repair::run);
}

#[test]
fn seeds_of_calls_leave_a_sound_world() {
    run_seeds("world", |bytes| world::run(bytes, true));
}
