//! Edges and vertices at which surfaces are torn, open, or meet others.

use tautline::Vec3;
use tautline::mesh::doctor::{Action, Defect, Why, diagnose};
use tautline::mesh::{HalfEdgeMesh, TriMesh, primitives};

use super::{assert_clean, assert_mends, ball, cube, joined, mend, moved, turned, volume};

#[test]
fn a_hole_is_named_by_its_rim_and_filled() {
    let mut mesh = ball();
    let missing: Vec<usize> = (0..mesh.triangles.len()).filter(|&t| mesh.triangles[t].contains(&0)).collect();
    let rim = missing.len();
    mesh.triangles.retain(|t| !t.contains(&0));
    let report = diagnose(&mesh);
    let [Defect::Isolated { vertex: 0 }, Defect::Open { vertices, is_loop: true }] = &report.defects[..]
    else {
        panic!("{:?}", report.defects)
    };
    assert_eq!(vertices.len(), rim);
    let near = report.defects[1].place(&mesh).distance(ball().positions[0]);
    assert!(near < 0.1, "{near} m from the vertex that is missing");
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!(matches!(&repaired.actions[0], Action::Filled { triangles, .. } if *triangles == rim - 2));
    assert!((volume(&repaired.mesh) - volume(&ball())).abs() < 0.02);
}

#[test]
fn sheets_and_bowls_are_left_open() {
    let sheet = primitives::grid(4, 4, 1.0, 1.0).unwrap();
    let mut bowl = ball();
    bowl.triangles.retain(|t| t.iter().all(|&v| bowl.positions[v as usize].y < 0.3));
    for mesh in [sheet, bowl] {
        let repaired = mend(&mesh);
        assert!(
            repaired.report.is_clean_but_open() && !repaired.report.is_clean(),
            "{:?}",
            repaired.report.defects
        );
        assert!(!repaired.actions.iter().any(|action| matches!(action, Action::Filled { .. })));
        HalfEdgeMesh::from_mesh(&repaired.mesh).unwrap();
    }
}

#[test]
fn a_filling_that_would_cross_is_not_made() {
    // A spike goes through the hole.
    let mut mesh = ball();
    mesh.triangles.retain(|t| !t.contains(&0));
    let (mut spike, way) = (primitives::octahedron(1.0).unwrap(), ball().positions[0]);
    spike.positions.iter_mut().for_each(|p| *p = *p * 0.02 + way * (0.95 + 0.4 * p.y));
    let repaired = mend(&joined(&mesh, &spike));
    assert!(!repaired.report.defects.iter().any(|defect| matches!(defect, Defect::Crossing { .. })));
    assert!(
        repaired.report.defects.iter().any(|defect| matches!(defect, Defect::Open { .. })),
        "{:?}",
        repaired.actions
    );
}

/// A box of 2 m × 1 m × 1 m in two halves, with a wall between them that has both its faces: triangles 20 to 23.
fn box_with_wall() -> TriMesh {
    let ring = |x: u32| {
        (0..4).map(move |k: u32| Vec3::new(x as f32, !k.is_multiple_of(3) as u8 as f32, (k > 1) as u8 as f32))
    };
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for x in 0..2 {
        (0..4).for_each(|k| quad([4 * x + k, 4 * x + (k + 1) % 4, 4 * x + 4 + (k + 1) % 4, 4 * x + 4 + k]));
    }
    quad([3, 2, 1, 0]);
    quad([8, 9, 10, 11]);
    quad([4, 5, 6, 7]);
    triangles.extend([[6, 5, 4], [7, 6, 4]]);
    TriMesh { positions: (0..3).flat_map(ring).collect(), triangles }
}

#[test]
fn a_wall_inside_a_solid_is_taken_out() {
    let mut mesh = box_with_wall();
    if volume(&mesh) < 0.0 {
        mesh = turned(mesh);
    }
    let defects = diagnose(&mesh).defects;
    assert_eq!(defects.iter().filter(|defect| matches!(defect, Defect::Duplicate { .. })).count(), 2);
    assert_eq!(defects.iter().filter(|defect| matches!(defect, Defect::NonManifoldEdge { .. })).count(), 4);
    let dropped = Action::DroppedTriangles { why: Why::Wall, count: 4, triangles: vec![20, 21, 22, 23] };
    assert_mends(&mesh, 2.0, &[dropped]);
}

/// Two cubes whose last and first vertices are one, and as many more as are told.
fn cubes_sharing(vertices: &[(u32, u32)]) -> TriMesh {
    let (first, second) = (cube(), cube());
    let shift = first.positions[vertices[0].0 as usize] - second.positions[vertices[0].1 as usize];
    let mut mesh = joined(&first, &moved(second, shift));
    for &(a, b) in vertices {
        assert_eq!(mesh.positions[a as usize], mesh.positions[b as usize + 8]);
        mesh.triangles.as_flattened_mut().iter_mut().filter(|v| **v == b + 8).for_each(|v| *v = a);
    }
    mesh
}

fn vertex_at(mesh: &TriMesh, position: Vec3) -> u32 {
    mesh.positions.iter().position(|&p| p == position).unwrap() as u32
}

#[test]
fn solids_that_share_a_corner_are_parted() {
    let (high, low) = (vertex_at(&cube(), Vec3::ONE), vertex_at(&cube(), Vec3::NEG_ONE));
    let mesh = cubes_sharing(&[(high, low)]);
    let defects = [Defect::Isolated { vertex: low + 8 }, Defect::BowTie { vertex: high, fans: 2 }];
    assert_eq!(diagnose(&mesh).defects, defects);
    assert_eq!(defects[1].place(&mesh), Vec3::ONE);
    let actions =
        [Action::Parted { vertices: vec![high] }, Action::DroppedVertices { vertices: vec![low + 8] }];
    assert_mends(&mesh, 16.0, &actions);
    assert_eq!(mend(&mesh).report.components.len(), 2);
}

#[test]
fn solids_that_share_an_edge_are_parted() {
    let at = |x: f32, y: f32, z: f32| vertex_at(&cube(), Vec3::new(x, y, z));
    let shared = [(at(1.0, 1.0, -1.0), at(-1.0, -1.0, -1.0)), (at(1.0, 1.0, 1.0), at(-1.0, -1.0, 1.0))];
    let mesh = cubes_sharing(&shared);
    let defects = diagnose(&mesh).defects;
    let edge = defects.iter().find(|defect| matches!(defect, Defect::NonManifoldEdge { .. })).unwrap();
    assert_eq!(edge.place(&mesh), Vec3::new(1.0, 1.0, 0.0));
    assert!(matches!(edge, Defect::NonManifoldEdge { triangles, .. } if triangles.len() == 4));
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert_eq!(repaired.report.components.len(), 2);
    assert!((volume(&repaired.mesh) - 16.0).abs() < 1e-9);
}

#[test]
fn a_fin_is_parted_from_its_solid_and_told_of() {
    let mut mesh = cube();
    let [a, b, _] = mesh.triangles[0];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) * 1.5);
    mesh.triangles.push([a, b, 8]);
    let edge = Defect::NonManifoldEdge { edge: [a.min(b), a.max(b)], triangles: vec![] };
    assert!(diagnose(&mesh).defects.iter().any(|defect| defect.vertices(&mesh) == edge.vertices(&mesh)));
    let repaired = mend(&mesh);
    let [Defect::Open { vertices, is_loop: true }] = &repaired.report.defects[..] else {
        panic!("{:?}", repaired.report.defects)
    };
    assert_eq!(vertices.len(), 3, "the fin has a rim of its own");
}

#[test]
fn small_fins_are_dropped() {
    let mut mesh = ball();
    let [a, b, _] = mesh.triangles[7];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) * 0.52);
    mesh.triangles.push([a, b, mesh.positions.len() as u32 - 1]);
    let fin = mesh.triangles.len() as u32 - 1;
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    let dropped = Action::DroppedTriangles { why: Why::Fin, count: 1, triangles: vec![fin] };
    assert!(repaired.actions.contains(&dropped), "{:?}", repaired.actions);
}

#[test]
fn torn_surfaces_are_welded() {
    for noise in [0.0, 2e-7] {
        let mut mesh = TriMesh::default();
        for (t, triangle) in ball().triangles.iter().enumerate() {
            let corner =
                |k: usize| ball().positions[triangle[k] as usize] * (1.0 + noise * ((3 * t + k) % 5) as f32);
            mesh.positions.extend([corner(0), corner(1), corner(2)]);
            mesh.triangles.push([3 * t as u32, 3 * t as u32 + 1, 3 * t as u32 + 2]);
        }
        let report = diagnose(&mesh);
        let unwelded =
            report.defects.iter().filter(|defect| matches!(defect, Defect::Unwelded { .. })).count();
        assert!(noise > 0.0 || unwelded == ball().positions.len(), "{unwelded}");
        assert_eq!(report.components.len(), mesh.triangles.len());
        let repaired = mend(&mesh);
        assert_clean(&repaired.mesh, &repaired.report);
        assert_eq!(repaired.mesh.positions.len(), ball().positions.len());
        let [Action::Welded { pairs }] = &repaired.actions[..] else { panic!("{:?}", repaired.actions) };
        assert_eq!(pairs.len(), mesh.positions.len() - ball().positions.len());
    }
}

#[test]
fn a_triangle_without_area_gets_one() {
    // The middle of an edge is a corner on one side of it, and a triangle without area lies between.
    let mut mesh = cube();
    let [a, b, c] = mesh.triangles[0];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) / 2.0);
    mesh.triangles[0] = [a, 8, c];
    mesh.triangles.extend([[8, b, c], [a, b, 8]]);
    let defects = diagnose(&mesh).defects;
    assert_eq!(defects[0], Defect::Degenerate { triangle: 13 });
    let touches =
        |defect: &Defect| matches!(defect, Defect::Crossing { triangles: [a, b] } if *a == 0 || *b == 12);
    assert!(defects[1..].iter().all(touches), "only what the new corner touches: {defects:?}");
    assert_mends(&mesh, 8.0, &[Action::Swapped { count: 1, triangles: vec![13] }]);
    // An edge without length.
    let mut mesh = cube();
    mesh.positions.push(mesh.positions[a as usize]);
    mesh.triangles[0] = [8, b, c];
    mesh.triangles.push([a, b, 8]);
    mesh.triangles.push([a, 8, c]);
    assert_eq!(diagnose(&mesh).defects, [12, 13].map(|triangle| Defect::Degenerate { triangle }));
    let dropped = Action::DroppedTriangles { why: Why::NoArea, count: 2, triangles: vec![12, 13] };
    assert_mends(&mesh, 8.0, &[Action::Welded { pairs: vec![[8, a]] }, dropped]);
}

#[test]
fn a_moebius_strip_is_cut_open() {
    let n = 12;
    let corner = |i: u32, side: f32| {
        let angle = std::f32::consts::TAU * i as f32 / n as f32;
        let (out, up) = (side * (angle / 2.0).cos(), side * (angle / 2.0).sin());
        Vec3::new((3.0 + out) * angle.cos(), up, (3.0 + out) * angle.sin())
    };
    let positions = (0..n).flat_map(|i| [corner(i, -1.0), corner(i, 1.0)]).collect();
    let next = |i: u32| if i + 1 < n { [2 * i + 2, 2 * i + 3] } else { [1, 0] };
    let triangles =
        (0..n).flat_map(|i| [[2 * i, 2 * i + 1, next(i)[1]], [2 * i, next(i)[1], next(i)[0]]]).collect();
    let mesh = TriMesh { positions, triangles };
    let defects = diagnose(&mesh).defects;
    assert!(defects.iter().any(|defect| matches!(defect, Defect::OneSided { .. })), "{defects:?}");
    let repaired = mend(&mesh);
    // What was cut is told of as torn: that is why it is not clean.
    assert!(matches!(
        repaired.report.defects[..],
        [Defect::Unwelded { .. }, Defect::Unwelded { .. }, Defect::Open { .. }]
    ));
    assert_eq!(repaired.mesh.positions.len(), 2 * n as usize + 2);
    HalfEdgeMesh::from_mesh(&repaired.mesh).unwrap();
}
