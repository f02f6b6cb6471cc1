//! Defects of single vertices and triangles, and what repair makes of them.

use tautline::Vec3;
use tautline::mesh::doctor::{Action, Defect, Why, diagnose};
use tautline::mesh::{TriMesh, primitives};

use super::{assert_clean, assert_mends, ball, cube, joined, mend, turned, volume};

#[test]
fn sound_meshes_have_no_defects() {
    for mesh in
        [cube(), ball(), primitives::torus(1.0, 0.3, 24, 12).unwrap(), primitives::dodecahedron(1.0).unwrap()]
    {
        let report = diagnose(&mesh);
        assert_clean(&mesh, &report);
        assert!(report.has_all_crossings);
        let [component] = report.components[..] else { panic!("{:?}", report.components) };
        assert!(component.is_closed && component.triangles == mesh.triangles.len());
        assert!((component.volume - volume(&mesh)).abs() < 1e-6);
        let repaired = mend(&mesh);
        assert_eq!((repaired.mesh, repaired.actions), (mesh, vec![]));
    }
}

#[test]
fn nothing_is_named_empty() {
    assert_eq!(diagnose(&TriMesh::default()).defects, [Defect::Empty]);
    assert_eq!(mend(&TriMesh::default()).report.defects, [Defect::Empty]);
}

#[test]
fn numbers_that_are_none_are_named_and_dropped() {
    let mut mesh = cube();
    mesh.positions.push(Vec3::new(0.0, f32::NAN, 0.0));
    mesh.triangles.extend([[0, 1, 8], [0, 1, 4_000_000_000], [2, 2, 5]]);
    let expected = [
        Defect::NotFinite { vertex: 8 },
        Defect::MissingVertex { triangle: 13, vertex: 4_000_000_000 },
        Defect::Degenerate { triangle: 14 },
    ];
    assert_eq!(diagnose(&mesh).defects, expected);
    let dropped = |why, triangles: &[u32]| Action::DroppedTriangles {
        why,
        count: triangles.len(),
        triangles: triangles.to_vec(),
    };
    let actions = [
        dropped(Why::NoPlace, &[12, 13]),
        dropped(Why::NoArea, &[14]),
        Action::DroppedVertices { vertices: vec![8] },
    ];
    assert_mends(&mesh, 8.0, &actions);
}

#[test]
fn isolated_vertices_are_named_and_dropped() {
    let mut mesh = cube();
    mesh.positions.insert(3, Vec3::splat(7.0));
    mesh.triangles.as_flattened_mut().iter_mut().filter(|v| **v >= 3).for_each(|v| *v += 1);
    let defect = Defect::Isolated { vertex: 3 };
    assert_eq!(defect.place(&mesh), Vec3::splat(7.0));
    assert_eq!(diagnose(&mesh).defects, [defect]);
    assert_mends(&mesh, 8.0, &[Action::DroppedVertices { vertices: vec![3] }]);
}

#[test]
fn a_flipped_triangle_is_named_and_turned() {
    let mut mesh = ball();
    mesh.triangles[17].swap(0, 1);
    assert_eq!(diagnose(&mesh).defects, [Defect::Flipped { triangle: 17 }]);
    assert_mends(&mesh, volume(&ball()), &[Action::Turned { count: 1, triangles: vec![17] }]);
}

#[test]
fn duplicates_are_named_and_dropped() {
    let mut mesh = cube();
    let [a, b, c] = mesh.triangles[5];
    mesh.triangles.extend([[b, c, a], [c, b, a]]);
    let duplicate = |triangle| Defect::Duplicate { triangle, first: 5 };
    assert_eq!(diagnose(&mesh).defects, [duplicate(12), duplicate(13)]);
    let dropped = Action::DroppedTriangles { why: Why::Duplicate, count: 2, triangles: vec![12, 13] };
    assert_mends(&mesh, 8.0, &[dropped]);
}

#[test]
fn what_is_inside_out_is_told_from_a_cavity() {
    let small = |turn: bool| {
        let mut mesh = primitives::icosahedron(0.3).unwrap();
        mesh.positions.iter_mut().for_each(|p| *p += Vec3::new(0.01, 0.02, 0.03));
        if turn { turned(mesh) } else { mesh }
    };
    let inner = volume(&small(false));
    assert_eq!(diagnose(&turned(cube())).defects, [Defect::InsideOut { triangle: 0 }]);
    assert_mends(&turned(cube()), 8.0, &[Action::Turned { count: 12, triangles: (0..12).collect() }]);
    let hollow = joined(&cube(), &small(true));
    assert_clean(&hollow, &diagnose(&hollow));
    let nested = joined(&cube(), &small(false));
    assert_eq!(diagnose(&nested).defects, [Defect::InsideOut { triangle: 12 }]);
    assert_mends(&nested, 8.0 - inner, &[Action::Turned { count: 20, triangles: (12..32).collect() }]);
    // On a ray through corners and edges too: the small one is in the middle of the cube's faces.
    let mut centred = primitives::octahedron(0.5).unwrap();
    centred = joined(&cube(), &turned(std::mem::take(&mut centred)));
    assert_clean(&centred, &diagnose(&centred));
}
