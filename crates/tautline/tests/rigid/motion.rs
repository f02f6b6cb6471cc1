//! Free motion against closed forms.

use std::sync::Arc;

use tautline::{Quat, RigidBody, Shape, Vec3, World};

use super::{add, awake, center, cube, run, weightless};

#[test]
fn free_fall_is_exact_near_the_origin_and_a_kilometre_away() {
    for (origin, tolerance) in [(Vec3::ZERO, 1e-4), (Vec3::new(1000.0, 1000.0, -1000.0), 5e-3)] {
        let mut world = World::new(awake()).unwrap();
        let velocity = Vec3::new(1.0, 2.0, -0.5);
        let body = add(&mut world, RigidBody::new(&cube(1.0)).position(origin).velocity(velocity));
        run(&mut world, 2.0);
        let expected = origin + velocity * 2.0 + Vec3::Y * (-0.5 * 9.81 * 4.0);
        assert!(center(&world, body).distance(expected) < tolerance, "{}", center(&world, body) - expected);
    }
}

#[test]
fn a_tumbling_box_keeps_its_energy_and_angular_momentum() {
    let mut world = World::new(weightless()).unwrap();
    let shape = Arc::new(Shape::cuboid(Vec3::new(0.5, 1.0, 1.5)).unwrap());
    add(&mut world, RigidBody::new(&shape).mass(1.0).angular_velocity(Vec3::new(2.0, 3.0, 1.0)));
    let (energy, momentum) = (world.kinetic_energy(), world.angular_momentum());
    run(&mut world, 60.0);
    let change = (world.kinetic_energy() / energy - 1.0).abs();
    let turned = (world.angular_momentum() - momentum).length() / momentum.length();
    assert!(change < 1e-3, "energy {change}");
    assert!(turned < 1e-5, "angular momentum {turned}");
}

#[test]
fn the_pose_given_is_the_pose_read() {
    let shape = Arc::new(
        Shape::convex_hull(&[Vec3::ZERO, Vec3::X, Vec3::Y * 2.0, Vec3::Z * 3.0, Vec3::new(1.0, 1.0, 1.0)])
            .unwrap(),
    );
    let (position, rotation) = (Vec3::new(3.0, -2.0, 7.0), Quat::from_xyzw(0.1, 0.7, -0.3, 0.6).normalize());
    let spin = Vec3::new(0.3, -1.0, 2.0);
    let mut world = World::new(weightless()).unwrap();
    let body =
        add(&mut world, RigidBody::new(&shape).position(position).rotation(rotation).angular_velocity(spin));
    let view = world.body(body).unwrap();
    let (read_position, read_rotation) = view.pose().unwrap();
    assert!(read_position.distance(position) < 1e-5);
    assert!(read_rotation.dot(rotation).abs() > 1.0 - 1e-6);
    assert!(view.angular_velocity().distance(spin) < 1e-4, "{}", view.angular_velocity());
}
