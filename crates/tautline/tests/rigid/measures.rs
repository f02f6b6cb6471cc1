//! Energies, momenta and penetration of rigid bodies against closed forms.

use std::sync::Arc;

use tautline::{CollisionGroups, DVec3, HalfSpace, Quat, RigidBody, Settings, Shape, Vec3, World};

use super::{DT, add, cube, weightless};

#[test]
fn energies_and_momenta_are_those_of_a_rigid_body() {
    let mut world = World::new(Settings::default()).unwrap();
    let plank = Arc::new(Shape::cuboid(Vec3::new(0.1, 0.4, 1.0)).unwrap());
    let rotation = Quat::from_rotation_x(0.4) * Quat::from_rotation_y(1.0);
    let (x, v, w) = (Vec3::new(1.0, 2.0, -3.0), Vec3::new(0.5, -1.0, 2.0), Vec3::new(3.0, 1.0, -2.0));
    let body = RigidBody::new(&plank).mass(2.0).position(x).rotation(rotation).velocity(v);
    let body = add(&mut world, body.angular_velocity(w).gravity_scale(0.5));
    // Not moved by forces, so without energy.
    add(&mut world, RigidBody::new(&plank).velocity(v).position(x * 9.0).kinematic());
    // I = m/3 (b² + c²) in its own frame.
    let own = rotation.inverse() * w;
    let momentum = Vec3::new(1.16, 1.01, 0.17) * (2.0 / 3.0) * own;
    let kinetic = 0.5 * 2.0 * v.length_squared() + 0.5 * momentum.dot(own);
    assert!((world.kinetic_energy() - f64::from(kinetic)).abs() < 1e-5);
    assert!((world.potential_energy() - 2.0 * 0.5 * 9.81 * 2.0).abs() < 1e-5);
    assert!((world.momentum() - (v * 2.0).as_dvec3()).length() < 1e-5);
    let angular = x.cross(v * 2.0) + rotation * momentum;
    assert!((world.angular_momentum() - angular.as_dvec3()).length() < 1e-5);
    let hash = world.state_hash();
    world.set_angular_velocity(body, w * 1.001).unwrap();
    assert_ne!(world.state_hash(), hash);
}

#[test]
fn energy_and_momenta_are_kept_in_flight() {
    let mut world = World::new(weightless()).unwrap();
    let plank = Arc::new(Shape::cuboid(Vec3::new(0.1, 0.4, 1.0)).unwrap());
    add(&mut world, RigidBody::new(&plank).velocity(Vec3::X).angular_velocity(Vec3::new(3.0, 1.0, -2.0)));
    let before = (world.kinetic_energy(), world.momentum(), world.angular_momentum());
    (0..60).for_each(|_| drop(world.step(DT).unwrap()));
    assert!((world.kinetic_energy() / before.0 - 1.0).abs() < 1e-3);
    let off = |a: DVec3, b: DVec3| (a - b).length() / b.length();
    assert!(off(world.momentum(), before.1) < 1e-5 && off(world.angular_momentum(), before.2) < 1e-4);
}

#[test]
fn penetration_is_the_depth_of_the_overlap() {
    let mut world = World::new(weightless()).unwrap();
    let shapes = [
        cube(1.0),
        Arc::new(Shape::sphere(0.5).unwrap()),
        Arc::new(Shape::capsule(0.25, 0.25).unwrap()),
        Arc::new(Shape::cylinder(0.5, 0.5).unwrap()),
    ];
    // Half a metre high each, and stacked by pairs that are 1 cm in each other.
    for (k, lower) in shapes.iter().enumerate() {
        for (l, upper) in shapes.iter().enumerate() {
            let x = Vec3::new(4.0 * k as f32, 10.0, 4.0 * l as f32);
            add(&mut world, RigidBody::new(lower).position(x));
            add(&mut world, RigidBody::new(upper).position(x + Vec3::Y * 0.99));
        }
    }
    let found = world.penetration();
    assert_eq!(found.count, 16);
    assert!((found.max - 0.01).abs() < 1e-4 && (found.mean - 0.01).abs() < 1e-4, "{found:?}");
}

#[test]
fn penetration_of_half_spaces_and_meshes_counts_radii_and_only_what_can_collide() {
    let mut world = World::new(weightless()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let ball = Arc::new(Shape::sphere(0.5).unwrap());
    add(&mut world, RigidBody::new(&ball).position(Vec3::Y * 0.48));
    let deepest = |world: &World| (world.penetration().count, world.penetration().max);
    let (count, depth) = deepest(&world);
    assert!(count == 1 && (depth - 0.02).abs() < 1e-6, "{depth}");
    add(&mut world, RigidBody::new(&ball).position(Vec3::new(3.0, 0.1, 0.0)).fixed());
    add(&mut world, RigidBody::new(&ball).position(Vec3::new(6.0, 0.1, 0.0)).kinematic());
    let nothing = CollisionGroups { memberships: 0, filter: 0 };
    add(&mut world, RigidBody::new(&ball).position(Vec3::new(0.0, 0.9, 0.0)).groups(nothing));
    assert_eq!(deepest(&world), (count, depth), "these collide with nothing that is there");
    let mesh = tautline::mesh::primitives::grid(5, 5, 4.0, 4.0).unwrap();
    let mesh = Arc::new(Shape::triangle_mesh(&mesh).unwrap());
    add(&mut world, RigidBody::new(&mesh).position(Vec3::new(0.0, 5.0, 9.0)).fixed());
    add(&mut world, RigidBody::new(&ball).position(Vec3::new(0.1, 5.45, 9.2)));
    let (count, depth) = deepest(&world);
    assert!(count == 2 && (depth - 0.05).abs() < 1e-5, "{depth}");
}
