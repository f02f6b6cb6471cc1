//! The doctor: every defect is named where it is, and what repair makes of it; random damage; brute force.

mod edges;
#[cfg(target_os = "linux")]
mod large;
mod random;
mod triangles;

use tautline::Vec3;
use tautline::mesh::doctor::{Action, RepairOptions, Repaired, Report, repair};
use tautline::mesh::{MassProperties, TriMesh, primitives};

fn cube() -> TriMesh {
    primitives::cuboid(Vec3::ONE).unwrap()
}

fn ball() -> TriMesh {
    primitives::icosphere(1.0, 2).unwrap()
}

fn mend(mesh: &TriMesh) -> Repaired {
    repair(mesh, &RepairOptions::default())
}

/// Both meshes as one.
fn joined(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let first = a.positions.len() as u32;
    let mut mesh = a.clone();
    mesh.positions.extend(&b.positions);
    mesh.triangles.extend(b.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    mesh
}

fn moved(mut mesh: TriMesh, by: Vec3) -> TriMesh {
    mesh.positions.iter_mut().for_each(|position| *position += by);
    mesh
}

fn turned(mut mesh: TriMesh) -> TriMesh {
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    mesh
}

fn volume(mesh: &TriMesh) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize].as_dvec3());
    mesh.triangles.iter().map(corners).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum()
}

/// Clean, as the rest of the engine sees it too.
fn assert_clean(mesh: &TriMesh, report: &Report) {
    assert!(report.is_clean(), "{:?}", report.defects);
    MassProperties::of(mesh, 1000.0).unwrap();
}

/// Repairing it gives a closed surface of this volume, by these actions.
fn assert_mends(mesh: &TriMesh, expected: f64, actions: &[Action]) {
    let repaired = mend(mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!((volume(&repaired.mesh) - expected).abs() < 1e-5, "{} and {expected}", volume(&repaired.mesh));
    assert_eq!(repaired.actions, actions);
    assert_eq!(mend(&repaired.mesh).actions, [], "the second repair has nothing to do");
}
