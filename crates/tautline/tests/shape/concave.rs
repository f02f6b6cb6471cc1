//! Solids from meshes, convex or not.

use std::sync::Arc;

use tautline::mesh::{MassProperties, TriMesh, convex_hull, primitives};
use tautline::shape::Decomposition;
use tautline::{Error, MeshDefect, Quat, QueryFilter, RigidBody, Settings, Shape, Vec3, World};

use crate::{check_frame, close, close_matrix, particle_moments};

fn check_mass(shape: &Shape, mesh: &TriMesh) {
    let expected = MassProperties::of(mesh, 1.0).unwrap();
    check_frame(shape);
    close(shape.volume(), expected.volume, 1e-6);
    assert!(shape.center_of_mass().as_dvec3().distance(expected.center_of_mass) < 1e-6);
    close_matrix(particle_moments(shape), expected.second_moments * (1.0 / expected.mass), 2e-6);
    assert_eq!((shape.positions(), shape.triangles()), (&mesh.positions[..], &mesh.triangles[..]));
}

#[test]
fn a_torus_has_the_mass_of_its_mesh() {
    let torus = primitives::torus(1.0, 0.3, 24, 12).unwrap();
    let shape = Shape::from_mesh(&torus).unwrap();
    check_mass(&shape, &torus);
    assert!((8..=32).contains(&shape.part_count()));
    assert!(shape.hull_excess() > 0.0 && shape.hull_excess() <= 0.02);
    assert!(shape.inner_radius() < 0.3);
    let finer = Shape::decomposed(&torus, &Decomposition::default().tolerance(0.008)).unwrap();
    check_mass(&finer, &torus);
    assert!(finer.part_count() > shape.part_count() && finer.hull_excess() <= 0.008);
    let cube = Shape::cuboid(Vec3::splat(0.5)).unwrap();
    let both =
        Shape::compound(&[(&shape, Vec3::ZERO, Quat::IDENTITY), (&cube, Vec3::Y, Quat::IDENTITY)]).unwrap();
    assert_eq!(both.part_count(), shape.part_count() + 1);
    close(both.hull_excess() * both.volume(), f64::from(shape.hull_excess() * shape.volume()), 1e-5);
    let coarse = Shape::decomposed(&torus, &Decomposition::default().max_parts(4)).unwrap();
    check_mass(&coarse, &torus);
    assert!(coarse.part_count() <= 4 && coarse.hull_excess() > 0.02);
}

#[test]
fn parts_of_fewer_corners_say_how_far_the_solid_sticks_out() {
    let torus = primitives::torus(1.0, 0.3, 24, 12).unwrap();
    let whole = Shape::from_mesh(&torus).unwrap();
    assert_eq!(whole.hull_shortfall(), 0.0);
    let mut last = f32::INFINITY;
    for corners in [8, 12, 16] {
        let coarse = Shape::decomposed(&torus, &Decomposition::default().max_corners(corners)).unwrap();
        check_mass(&coarse, &torus);
        assert_eq!((coarse.part_count(), coarse.hull_excess()), (whole.part_count(), whole.hull_excess()));
        // A vertex of the torus is no farther from the body's nearest point than is stated, and one is just so far.
        let mut world = World::new(Settings::default()).unwrap();
        let shape = Arc::new(coarse);
        world.add(RigidBody::new(&shape).fixed()).unwrap();
        let away = |&vertex: &Vec3| {
            let found = world.closest_point(vertex, 1.0, QueryFilter::default()).unwrap();
            found.unwrap().distance.max(0.0)
        };
        let farthest = torus.positions.iter().map(away).fold(0.0, f32::max);
        let stated = shape.hull_shortfall();
        assert!(farthest <= stated + 1e-6 && farthest > 0.2 * stated, "{corners}: {farthest} of {stated} m");
        assert!(stated > 0.0 && stated < last, "{stated}");
        last = stated;
        let twice =
            Shape::compound(&[(&whole, Vec3::ZERO, Quat::IDENTITY), (&shape, Vec3::Y, Quat::IDENTITY)]);
        assert_eq!(twice.unwrap().hull_shortfall(), stated);
    }
    let ball = primitives::icosphere(1.0, 3).unwrap();
    let coarse = Shape::decomposed(&ball, &Decomposition::default().max_corners(32)).unwrap();
    assert_eq!(
        coarse.hull_shortfall(),
        convex_hull(&ball.positions).unwrap().coarsened(32, 0.0).unwrap().error
    );
}

#[test]
fn convex_meshes_are_one_part() {
    for mesh in [primitives::cube(1.0), primitives::icosphere(1.0, 2), primitives::capsule(0.3, 1.0, 16, 4)] {
        let mesh = mesh.unwrap();
        let shape = Shape::from_mesh(&mesh).unwrap();
        check_mass(&shape, &mesh);
        assert_eq!(shape.part_count(), 1);
        assert!(shape.hull_excess() < 1e-5);
    }
}

fn joined(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let first = a.positions.len() as u32;
    let second = b.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex));
    TriMesh {
        positions: [&a.positions[..], &b.positions].concat(),
        triangles: a.triangles.iter().copied().chain(second).collect(),
    }
}

#[test]
fn separate_bodies_are_separate_parts() {
    let mut far = primitives::cube(1.0).unwrap();
    far.positions.iter_mut().for_each(|position| position.x += 3.0);
    let mesh = joined(&primitives::cube(1.0).unwrap(), &far);
    let shape = Shape::from_mesh(&mesh).unwrap();
    check_mass(&shape, &mesh);
    assert_eq!(shape.part_count(), 2);
    assert!(shape.hull_excess() < 1e-9);
}

/// Its walls are 0.1 thick.
#[test]
fn a_hollow_box_is_its_walls() {
    let mut inner = primitives::cube(0.8).unwrap();
    inner.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    let mesh = joined(&primitives::cube(1.0).unwrap(), &inner);
    let shape = Shape::from_mesh(&mesh).unwrap();
    check_mass(&shape, &mesh);
    assert!(shape.part_count() <= 12 && shape.hull_excess() < 0.02, "{}", shape.part_count());
    close(shape.volume(), 1.0 - 0.8_f64.powi(3), 1e-6);
}

#[test]
fn the_same_mesh_gives_the_same_shape() {
    let torus = primitives::torus(1.0, 0.4, 12, 8).unwrap();
    assert_eq!(Shape::from_mesh(&torus).unwrap(), Shape::from_mesh(&torus).unwrap());
}

fn defect(mesh: &TriMesh) -> MeshDefect {
    match Shape::from_mesh(mesh) {
        Err(Error::Mesh(defect)) => defect,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_solid_is_refused() {
    let torus = primitives::torus(1.0, 0.3, 12, 8).unwrap();
    let mut open = torus.clone();
    open.triangles.pop();
    assert!(matches!(defect(&open), MeshDefect::OpenEdge { .. }));
    let mut inside_out = torus.clone();
    inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    assert!(matches!(defect(&inside_out), MeshDefect::NotPositiveVolume { .. }));
    let mut flipped = torus.clone();
    flipped.triangles[7].swap(1, 2);
    assert!(matches!(defect(&flipped), MeshDefect::FlippedTriangle { .. }));
    let mut lost = torus.clone();
    lost.positions[3].x = f32::NAN;
    assert!(matches!(defect(&lost), MeshDefect::NotFinite { vertex: 3 }));
    assert_eq!(defect(&TriMesh::default()), MeshDefect::Empty);
    let flat = TriMesh {
        positions: torus.positions.iter().map(|p| *p * Vec3::new(1.0, 1e-6, 1.0)).collect(),
        ..torus.clone()
    };
    assert!(matches!(Shape::from_mesh(&flat), Err(Error::Invalid { field, .. }) if field == "mesh"));
    let far = TriMesh { positions: torus.positions.iter().map(|p| *p * 1e10).collect(), ..torus.clone() };
    assert!(
        matches!(Shape::from_mesh(&far), Err(Error::OutOfRange { field, .. }) if field.starts_with("positions["))
    );

    for (bad, field) in [
        (Decomposition::default().max_parts(0), "max_parts"),
        (Decomposition::default().max_parts(1 << 20), "max_parts"),
        (Decomposition::default().tolerance(-0.1), "tolerance"),
        (Decomposition::default().tolerance(f32::NAN), "tolerance"),
        (Decomposition::default().max_corners(3), "max_corners"),
        (Decomposition::default().max_corners(1 << 16), "max_corners"),
    ] {
        let refused = Shape::decomposed(&torus, &bad);
        assert!(matches!(refused, Err(Error::OutOfRange { field: found, .. }) if found == field));
    }
}
