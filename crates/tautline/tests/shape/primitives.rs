//! Closed forms of ball, box, capsule and cylinder.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, dvec3};
use tautline::{Quat, Shape, Vec3};

use crate::{check_frame, close, close_matrix, particle_moments};

fn check(shape: &Shape, volume: f64, second_moments: DVec3) {
    check_frame(shape);
    close(shape.volume(), volume, 1e-7);
    assert_eq!(shape.center_of_mass(), Vec3::ZERO);
    close_matrix(particle_moments(shape), DMat3::from_diagonal(second_moments), 1e-6);
    assert_eq!(shape.part_count(), 1);
}

#[test]
fn ball() {
    let shape = Shape::sphere(0.5).unwrap();
    check(&shape, PI / 6.0, DVec3::splat(0.05));
    assert_eq!((shape.reach(), shape.inner_radius()), (0.5, 0.5));
    assert_eq!(shape.principal_rotation(), Quat::IDENTITY);
}

#[test]
fn boxes_of_every_order_of_sides() {
    for half in [[1.0, 2.0, 3.0], [3.0, 1.0, 2.0], [2.0, 3.0, 1.0], [1.0, 3.0, 2.0], [2.0, 1.0, 3.0]] {
        let half = Vec3::from(half);
        let shape = Shape::cuboid(half).unwrap();
        check(&shape, 48.0, half.as_dvec3().powf(2.0) / 3.0);
        close(shape.reach(), 14_f64.sqrt(), 1e-6);
        assert_eq!(shape.inner_radius(), 1.0);
    }
    for half in [Vec3::new(3.0, 2.0, 1.0), Vec3::new(2.0, 2.0, 1.0), Vec3::ONE] {
        assert_eq!(Shape::cuboid(half).unwrap().principal_rotation(), Quat::IDENTITY, "{half}");
    }
}

#[test]
fn capsule() {
    let shape = Shape::capsule(0.5, 1.0).unwrap();
    let (rod, balls) = (PI * 0.25 * 2.0, PI / 6.0);
    let across = (rod * 0.0625 + balls * 0.05) / (rod + balls);
    // Half balls: 0.05 about the flat side, whose distance from the middle is 1, the centre of mass 3/16 beyond.
    let along = (rod / 3.0 + balls * (0.05 + 1.0 + 2.0 * 0.1875)) / (rod + balls);
    check(&shape, rod + balls, dvec3(across, along, across));
    assert_eq!((shape.reach(), shape.inner_radius()), (1.5, 0.5));
    assert!((shape.principal_rotation() * Vec3::X).distance(Vec3::Y) < 1e-6);
}

/// The true cylinder's mass on a prism.
#[test]
fn cylinder() {
    for half_height in [0.1, 1.0] {
        let shape = Shape::cylinder(0.5, half_height).unwrap();
        let h = f64::from(half_height);
        check(&shape, PI * 0.25 * 2.0 * h, dvec3(0.0625, h * h / 3.0, 0.0625));
        close(shape.reach(), (0.25 + h * h).sqrt(), 1e-6);
        close(shape.inner_radius(), h.min(0.5 * (PI / 32.0).cos()), 1e-6);
    }
}

/// From a grain of dust to a mountain.
#[test]
fn sizes() {
    for scale in [2e-6_f32, 1e-3, 1.0, 1e4, 1e9] {
        let s = f64::from(scale);
        let shape = Shape::cuboid(Vec3::new(1.0, 0.5, 0.5) * scale).unwrap();
        check(&shape, 2.0 * s * s * s, dvec3(1.0, 0.25, 0.25) * (s * s / 3.0));
        assert_eq!(shape.positions().len(), 8);
    }
}
