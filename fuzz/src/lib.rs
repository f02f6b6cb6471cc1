//! What the targets do. The ordinary tests do the same with the seeds: they take these files as modules of their own.

pub mod distance;
pub mod repair;
pub mod scene;
pub mod world;

use tautline_scene::mesh_file::{Format, Limits, parse};

/// Reads bytes as a mesh file. It must be refused, or hold what it promises.
pub fn read_mesh(bytes: &[u8], format: Format) {
    let Ok(file) = parse(bytes, format, &Limits::default()) else { return };
    let mesh = file.mesh;
    assert!(!mesh.triangles.is_empty());
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.triangles.as_flattened().iter().all(|&vertex| (vertex as usize) < mesh.positions.len()));
}
