//! Unions of shapes.

use glam::{DMat3, DVec3};
use tautline::{Quat, Shape, Vec3};

use crate::{check_frame, close, close_matrix, particle_moments};

/// Eight cubes are one cube.
#[test]
fn cubes_make_a_cube() {
    let cube = Shape::cuboid(Vec3::splat(0.5)).unwrap();
    let turns = [Quat::IDENTITY, Quat::from_rotation_y(std::f32::consts::FRAC_PI_2)];
    let place = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 0 { -0.5 } else { 0.5 };
        (&cube, Vec3::new(sign(0) + 7.0, sign(1), sign(2)), turns[k % 2])
    };
    let parts: Vec<_> = (0..8).map(place).collect();
    let shape = Shape::compound(&parts).unwrap();
    check_frame(&shape);
    close(shape.volume(), 8.0, 1e-6);
    assert!(shape.center_of_mass().distance(Vec3::X * 7.0) < 1e-6);
    close_matrix(particle_moments(&shape), DMat3::from_diagonal(DVec3::splat(1.0 / 3.0)), 1e-6);
    assert_eq!(shape.principal_rotation(), Quat::IDENTITY);
    assert_eq!((shape.part_count(), shape.positions().len(), shape.triangles().len()), (8, 64, 96));
    close(shape.reach(), 3_f64.sqrt(), 1e-5);
    close(shape.inner_radius(), 0.5, 1e-5);
}

/// A dumbbell of two balls of volume V = 4π/3 r³ at distance ±d: second moments r²/5, and d² more along.
#[test]
fn dumbbell_along_any_axis() {
    let ball = Shape::sphere(0.5).unwrap();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, 2.0, -2.0) / 3.0] {
        let parts = [(&ball, axis * 2.0, Quat::IDENTITY), (&ball, axis * -2.0, Quat::from_rotation_z(1.0))];
        let shape = Shape::compound(&parts).unwrap();
        check_frame(&shape);
        close(shape.volume(), std::f64::consts::PI / 3.0, 1e-6);
        assert!(shape.second_moments().distance(Vec3::new(4.05, 0.05, 0.05)) < 1e-5);
        assert!((shape.principal_rotation() * Vec3::X).dot(axis).abs() > 0.999999);
        close(shape.reach(), 2.5, 1e-6);
        assert_eq!(shape.inner_radius(), 0.5);
    }
}

#[test]
fn compounds_of_compounds() {
    let capsule = Shape::capsule(0.2, 0.5).unwrap();
    let turn = Quat::from_rotation_z(0.5);
    let bent = Shape::compound(&[(&capsule, Vec3::ZERO, turn), (&capsule, Vec3::X, turn.inverse())]).unwrap();
    let outer = Quat::from_axis_angle(Vec3::ONE.normalize(), 2.0);
    let moved = Shape::compound(&[(&bent, Vec3::new(5.0, 6.0, 7.0), outer)]).unwrap();
    check_frame(&moved);
    assert!(moved.second_moments().distance(bent.second_moments()) < 1e-6);
    let expected = outer * bent.center_of_mass() + Vec3::new(5.0, 6.0, 7.0);
    assert!(moved.center_of_mass().distance(expected) < 1e-5);
    let turn = DMat3::from_quat(outer.as_dquat().normalize());
    close_matrix(particle_moments(&moved), turn * particle_moments(&bent) * turn.transpose(), 1e-6);
}
