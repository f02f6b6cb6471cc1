//! Crossings, also against brute force, and random damage.

use proptest::prelude::*;
use tautline::mesh::doctor::{Defect, diagnose};
use tautline::mesh::{HalfEdgeMesh, MassProperties, TriMesh, primitives};
use tautline::{DVec3, Vec3};

use super::{cube, joined, mend, moved};

#[test]
fn crossings_are_named_and_stay() {
    let mesh = joined(&cube(), &moved(cube(), Vec3::new(1.1, 0.7, 0.3)));
    let report = diagnose(&mesh);
    assert!(!report.defects.is_empty());
    for defect in &report.defects {
        let Defect::Crossing { triangles: [a, b] } = *defect else { panic!("{defect}") };
        assert!(a < 12 && b >= 12, "{defect}");
        assert!(defect.place(&mesh).distance(Vec3::new(0.55, 0.35, 0.15)) < 2.0);
    }
    let repaired = mend(&mesh);
    assert_eq!((repaired.mesh, repaired.actions), (mesh, vec![]));
    assert_eq!(repaired.report, report);
}

#[test]
fn solids_that_touch_cross_but_are_not_joined() {
    let mesh = joined(&cube(), &moved(cube(), Vec3::X * 2.0));
    assert!(diagnose(&mesh).defects.iter().all(|defect| matches!(defect, Defect::Crossing { .. })));
    assert_eq!(mend(&mesh).mesh, mesh);
}

/// Whether two triangles in general position cross, in f64: an edge of one goes through the other.
fn cross_by_force(mesh: &TriMesh, a: usize, b: usize) -> bool {
    let corners = |t: usize| mesh.triangles[t].map(|v| mesh.positions[v as usize].as_dvec3());
    let side = |[a, b, c]: [DVec3; 3], p: DVec3| (b - a).cross(c - a).dot(p - a) > 0.0;
    let pierces = |p: DVec3, q: DVec3, [a, b, c]: [DVec3; 3]| {
        let turns = [side([p, q, a], b), side([p, q, b], c), side([p, q, c], a)];
        side([a, b, c], p) != side([a, b, c], q) && turns[0] == turns[1] && turns[1] == turns[2]
    };
    let any =
        |[a, b, c]: [DVec3; 3], other| [[a, b], [b, c], [c, a]].iter().any(|&[p, q]| pierces(p, q, other));
    any(corners(a), corners(b)) || any(corners(b), corners(a))
}

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from)
}

/// Coordinates that files hold, and should not.
const STRANGE: [f32; 7] = [0.0, 1.0, -1.0, 0.5, f32::NAN, f32::MAX, 1e-45];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn crossings_are_those_that_brute_force_finds(positions in prop::collection::vec(point(), 60)) {
        let triangles = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = TriMesh { positions, triangles };
        let found: Vec<[u32; 2]> = diagnose(&mesh).defects.iter().filter_map(|defect| match defect {
            Defect::Crossing { triangles } => Some(*triangles),
            _ => None,
        }).collect();
        let pairs = (0..20_u32).flat_map(|a| (a + 1..20).map(move |b| [a, b]));
        let expected: Vec<_> = pairs.filter(|&[a, b]| cross_by_force(&mesh, a as usize, b as usize)).collect();
        prop_assert_eq!(found, expected);
    }

    /// Whatever happens to a mesh, the two never break, agree with the half-edge mesh, and find an end.
    #[test]
    fn damage_is_named_and_mended(
        damage in prop::collection::vec((0_usize..7, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..12),
    ) {
        let mut mesh = primitives::icosphere(1.0, 1).unwrap();
        for (kind, first, second) in damage {
            if mesh.triangles.is_empty() {
                break;
            }
            let (t, v) = (first.index(mesh.triangles.len()), second.index(mesh.positions.len()));
            match kind {
                0 => drop(mesh.triangles.swap_remove(t)),
                1 => mesh.triangles[t].swap(0, 1),
                2 => mesh.triangles.push(mesh.triangles[t]),
                3 => mesh.triangles[t][v % 3] = v as u32,
                4 => mesh.positions[v] = mesh.positions[mesh.triangles[t][0] as usize],
                5 => {
                    mesh.positions.push(mesh.positions[v]);
                    mesh.triangles[t][v % 3] = mesh.positions.len() as u32 - 1;
                }
                _ => mesh.positions[v] *= -0.5,
            }
        }
        let report = diagnose(&mesh);
        let is_surface = report.defects.iter().all(|defect| {
            matches!(defect, Defect::Open { .. } | Defect::Unwelded { .. } | Defect::Crossing { .. } | Defect::InsideOut { .. })
        });
        prop_assert_eq!(is_surface, HalfEdgeMesh::from_mesh(&mesh).is_ok(), "{:?}", report.defects);
        let repaired = mend(&mesh);
        prop_assert_eq!(&repaired.report, &diagnose(&repaired.mesh));
        if repaired.report.is_clean() {
            prop_assert!(MassProperties::of(&repaired.mesh, 1.0).is_ok());
            prop_assert_eq!(mend(&repaired.mesh).actions, vec![]);
        }
    }

    #[test]
    fn soup_is_survived(
        positions in prop::collection::vec(prop::array::uniform3(prop::sample::select(STRANGE.to_vec())), 0..12),
        triangles in prop::collection::vec(prop::array::uniform3(0_u32..13), 0..40),
    ) {
        let mesh = TriMesh { positions: positions.into_iter().map(Vec3::from).collect(), triangles };
        let repaired = mend(&mesh);
        prop_assert_eq!(&repaired.report, &diagnose(&repaired.mesh));
        let wanted = |defect: &Defect| {
            use Defect::{Duplicate, Isolated, MissingVertex, NotFinite};
            matches!(defect, NotFinite { .. } | MissingVertex { .. } | Isolated { .. } | Duplicate { .. })
        };
        prop_assert!(!repaired.report.defects.iter().any(wanted), "{:?}", repaired.report.defects);
    }
}
