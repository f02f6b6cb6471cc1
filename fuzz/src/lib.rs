//! What the targets of mesh files share. Those of the files beside it are modules of their targets, and of the ordinary
//! tests, which run them on the seeds.

use tautline_scene::mesh_file::{Format, Limits, parse};

/// Reads bytes as a mesh file. It must be refused, or hold what it promises.
pub fn read_mesh(bytes: &[u8], format: Format) {
    let Ok(file) = parse(bytes, format, &Limits::default()) else { return };
    let mesh = file.mesh;
    assert!(!mesh.triangles.is_empty());
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.triangles.as_flattened().iter().all(|&vertex| (vertex as usize) < mesh.positions.len()));
}
