//! Random triangles for the mesh doctor.

use tautline::Vec3;
use tautline::mesh::doctor::{RepairOptions, diagnose, repair};
use tautline::mesh::{HalfEdgeMesh, TriMesh};

/// The first byte is the number of vertices. Three bytes are a place: on a coarse grid, so that vertices coincide and lie
/// on lines and planes, or one of some numbers that are hard. Each byte after them is a corner.
pub(crate) fn run(bytes: &[u8]) {
    let Some((&count, rest)) = bytes.split_first() else { return };
    let (places, corners) = rest.split_at((usize::from(count) * 3).min(rest.len()));
    let positions =
        places.chunks_exact(3).map(|p| Vec3::new(coordinate(p[0]), coordinate(p[1]), coordinate(p[2])));
    let triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(u32::from));
    let mesh = TriMesh { positions: positions.collect(), triangles: triangles.collect() };
    let is_surface = HalfEdgeMesh::from_mesh(&mesh).is_ok();
    let report = diagnose(&mesh);
    assert!(is_surface || !report.is_clean());
    let repaired = repair(&mesh, &RepairOptions::default());
    if repaired.report.is_clean() {
        assert!(HalfEdgeMesh::from_mesh(&repaired.mesh).is_ok_and(|mesh| mesh.require_closed().is_ok()));
        assert_eq!(repair(&repaired.mesh, &RepairOptions::default()).actions, []);
    }
}

fn coordinate(byte: u8) -> f32 {
    match byte {
        250 => f32::NAN,
        251 => f32::INFINITY,
        252 => f32::MAX,
        253 => 1e-45,
        254 => -0.0,
        255 => 1.0 + f32::EPSILON,
        other => f32::from(other % 16) / 4.0,
    }
}
