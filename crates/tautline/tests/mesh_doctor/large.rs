//! Large and heaped meshes take seconds, by the time that Linux tells.

use tautline::Vec3;
use tautline::mesh::doctor::diagnose;
use tautline::mesh::{TriMesh, primitives};

use super::{assert_clean, mend};

/// What this thread has worked, in s: other programs on the machine do not count.
fn worked() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e-9
}

#[test]
fn large_meshes_take_seconds() {
    let mut mesh = primitives::torus(1.0, 0.4, 320, 160).unwrap();
    let count = mesh.triangles.len();
    assert!(count > 100_000);
    (0..count).step_by(997).for_each(|t| mesh.triangles[t].swap(0, 1));
    (0..count).step_by(1499).for_each(|t| mesh.triangles[t] = mesh.triangles[(t + 7) % count]);
    let start = worked();
    let report = diagnose(&mesh);
    let examined = worked() - start;
    let repaired = mend(&mesh);
    let all = worked() - start;
    println!("{count} triangles: {examined:.2} s, with repair {all:.2} s");
    assert!(report.defects.len() > 100);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!(all < 5.0 * count as f64 / 1e5, "{all} s");
}

/// Triangles around one edge, and closed surfaces inside each other: all lie over all others.
#[test]
fn heaps_take_seconds_too() {
    let count = 40_000_u32;
    let around = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / f64::from(count);
        Vec3::new(angle.cos() as f32, angle.sin() as f32, 0.0)
    };
    let fan = TriMesh {
        positions: [Vec3::Z, -Vec3::Z].into_iter().chain((0..count).map(around)).collect(),
        triangles: (0..count).map(|k| [0, 1, k + 2]).collect(),
    };
    let mut shells = TriMesh::default();
    for k in 0..count / 4 {
        let first = shells.positions.len() as u32;
        let size = 1.0 + k as f32 * 0.01;
        let corners =
            [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|corner| (corner - Vec3::splat(0.1)) * size);
        shells.positions.extend(corners);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        shells.triangles.extend(faces.map(|face| face.map(|corner| corner + first)));
    }
    for (what, mesh) in [("fan", fan), ("shells", shells)] {
        let start = worked();
        let report = diagnose(&mesh);
        let took = worked() - start;
        println!("{what}: {took:.2} s for {} defects", report.defects.len());
        assert!(!report.is_clean() && took < 5.0 * f64::from(count) / 1e5, "{what}: {took} s");
    }
}
