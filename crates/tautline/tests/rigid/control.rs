//! Setting where bodies are, how they move and what they are.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{
    Cloth, CollisionGroups, HalfSpace, Motion, Quat, RigidBody, Shape, Surface, Truss, TrussBody, Vec3, World,
};

use super::{add, awake, center, cube, floor, run, weightless};

fn plank() -> Arc<Shape> {
    Arc::new(Shape::cuboid(Vec3::new(0.1, 0.4, 1.0)).unwrap())
}

/// |a − b| as part of what they are.
fn off(a: Vec3, b: Vec3) -> f32 {
    a.distance(b) / b.length().max(1.0)
}

#[test]
fn a_pose_is_set_and_the_motion_stays() {
    let mut world = World::new(weightless()).unwrap();
    let (v, w) = (Vec3::new(1.0, -2.0, 0.5), Vec3::new(0.3, 2.0, -1.0));
    let body = add(&mut world, RigidBody::new(&plank()).velocity(v).angular_velocity(w));
    run(&mut world, 0.1);
    let w = world.body(body).unwrap().angular_velocity();
    let (position, rotation) = (Vec3::new(3.0, 4.0, 5.0), Quat::from_rotation_x(1.0));
    world.set_pose(body, position, rotation * 1.5).unwrap();
    let view = world.body(body).unwrap();
    let (x, q) = view.pose().unwrap();
    assert!(x.distance(position) < 1e-6 && q.dot(rotation).abs() > 1.0 - 1e-6, "{x} {q}");
    assert!(off(view.velocity(), v) < 1e-6 && off(view.angular_velocity(), w) < 1e-5);
    assert!(off(view.velocity_at(position + Vec3::X), v + w.cross(Vec3::X)) < 1e-5);
    run(&mut world, 0.5);
    assert!(off(center(&world, body), position + v * 0.5) < 1e-5);
}

#[test]
fn velocities_are_set_one_without_the_other() {
    let mut world = World::new(awake()).unwrap();
    let spin = Vec3::new(0.5, 3.0, -1.0);
    let body = add(&mut world, RigidBody::new(&plank()).angular_velocity(spin));
    run(&mut world, 0.2);
    let before = world.body(body).unwrap().angular_velocity();
    world.set_velocity(body, Vec3::X * 4.0).unwrap();
    let view = world.body(body).unwrap();
    assert!(off(view.velocity(), Vec3::X * 4.0) < 1e-6 && off(view.angular_velocity(), before) < 1e-5);
    world.set_angular_velocity(body, spin).unwrap();
    let view = world.body(body).unwrap();
    assert!(off(view.velocity(), Vec3::X * 4.0) < 1e-6 && off(view.angular_velocity(), spin) < 1e-5);
    let start = center(&world, body);
    run(&mut world, 1.0);
    let expected = start + Vec3::new(4.0, -0.5 * 9.81, 0.0);
    assert!(center(&world, body).distance(expected) < 1e-4, "{}", center(&world, body) - expected);
}

#[test]
fn a_fixed_body_that_is_moved_away_leaves_what_it_carried_to_fall() {
    let mut world = World::new(awake()).unwrap();
    let shelf = add(&mut world, RigidBody::new(&cube(1.0)).fixed());
    let ball = add(&mut world, RigidBody::new(&cube(0.5)).position(Vec3::Y * 0.75));
    run(&mut world, 0.5);
    assert!((center(&world, ball).y - 0.75).abs() < 1e-3);
    world.set_pose(shelf, Vec3::new(0.0, -2.0, 0.0), Quat::IDENTITY).unwrap();
    run(&mut world, 0.4);
    assert!((center(&world, ball).y - (0.75 - 0.5 * 9.81 * 0.16)).abs() < 1e-2);
    run(&mut world, 1.0);
    assert!((center(&world, ball).y + 1.25).abs() < 1e-2, "it lies on the shelf again");
}

#[test]
fn what_moves_a_body_can_be_changed_and_its_mass_stays() {
    let mut world = World::new(awake()).unwrap();
    let rotation = Quat::from_rotation_z(0.7);
    let body = RigidBody::new(&plank()).mass(3.0).rotation(rotation).velocity(Vec3::X).fixed();
    let body = add(&mut world, body);
    run(&mut world, 0.2);
    assert!(center(&world, body).length() < 1e-6);
    let moments = world.body(body).unwrap().principal_moments();
    world.set_motion(body, Motion::Kinematic).unwrap();
    world.set_velocity(body, Vec3::X).unwrap();
    world.set_angular_velocity(body, Vec3::Z * FRAC_PI_2).unwrap();
    run(&mut world, 1.0);
    let (_, q) = world.body(body).unwrap().pose().unwrap();
    let turned = Quat::from_rotation_z(0.7 + FRAC_PI_2);
    assert!(off(center(&world, body), Vec3::X) < 1e-5 && q.dot(turned).abs() > 1.0 - 1e-5, "{q}");
    world.set_motion(body, Motion::Dynamic).unwrap();
    let view = world.body(body).unwrap();
    assert!((view.mass() - 3.0).abs() < 1e-6);
    assert_eq!((view.principal_moments(), view.motion()), (moments, Motion::Dynamic));
    assert!(off(view.velocity(), Vec3::X) < 1e-5 && off(view.angular_velocity(), Vec3::Z * FRAC_PI_2) < 1e-4);
    run(&mut world, 1.0);
    assert!(off(center(&world, body), Vec3::new(2.0, -0.5 * 9.81, 0.0)) < 2e-2);
    world.set_motion(body, Motion::Fixed).unwrap();
    let before = world.body(body).unwrap().pose();
    run(&mut world, 0.5);
    assert_eq!(world.body(body).unwrap().pose(), before);
    assert_eq!(world.body(body).unwrap().velocity(), Vec3::ZERO);
}

#[test]
fn gravity_damping_friction_and_groups_change_what_happens_next() {
    let mut world = World::new(awake()).unwrap();
    let ground = floor(&mut world);
    let up = |x: f32| Vec3::new(x, 50.0, 0.0);
    let bodies = [0.0, 3.0, 6.0].map(|x| add(&mut world, RigidBody::new(&cube(1.0)).position(up(x))));
    world.set_gravity_scale(bodies[0], -0.5).unwrap();
    world.set_damping(bodies[1], 2.0, 0.0).unwrap();
    let slider = add(&mut world, RigidBody::new(&cube(1.0)).position(Vec3::new(0.0, 0.5, 5.0)));
    run(&mut world, 1.0);
    assert!((center(&world, bodies[0]).y - (50.0 + 0.25 * 9.81)).abs() < 1e-3);
    // v' = −g − c v: y = −g/c t + g/c² (1 − e^{−ct}).
    let damped = 9.81 / 2.0 - 9.81 / 4.0 * (1.0 - (-2.0_f32).exp());
    assert!((50.0 - center(&world, bodies[1]).y - damped).abs() < 0.01 * damped);
    let ice = Surface { friction: 0.0, ..Surface::default() };
    world.set_surface(slider, ice).unwrap();
    world.set_velocity(slider, Vec3::X).unwrap();
    run(&mut world, 1.0);
    assert!((center(&world, slider).x - 1.0).abs() < 1e-3, "it slides freely");
    world.set_surface(slider, Surface { friction: 0.8, ..ice }).unwrap();
    run(&mut world, 1.0);
    assert!(world.body(slider).unwrap().velocity().length() < 1e-3, "it has been stopped");
    world.set_surface(ground, Surface { friction: 0.0, ..ice }).unwrap();
    world.set_velocity(slider, Vec3::X).unwrap();
    run(&mut world, 0.5);
    assert!((world.body(slider).unwrap().velocity().x - 1.0).abs() < 1e-3);
    world.set_groups(slider, CollisionGroups { memberships: 0, filter: 0 }).unwrap();
    run(&mut world, 0.5);
    assert!(center(&world, slider).y < -0.5, "it falls through the floor");
}

#[test]
fn inertia_is_that_of_a_box() {
    let mut world = World::new(weightless()).unwrap();
    let rotation = Quat::from_rotation_z(FRAC_PI_2);
    let body = add(&mut world, RigidBody::new(&plank()).mass(6.0).rotation(rotation));
    let view = world.body(body).unwrap();
    // m/3 (b² + c²) with half extents 0.1, 0.4, 1; turned about z, x and y change places.
    let expected = Vec3::new(2.0 * 1.01, 2.0 * 1.16, 2.0 * 0.17);
    let inertia = view.inertia();
    assert!((inertia.to_cols_array()[0] - expected.x).abs() < 1e-5);
    assert!((inertia * Vec3::ONE).distance(expected) < 1e-5, "{inertia}");
    assert!(view.principal_moments().distance(Vec3::new(0.34, 2.02, 2.32)) < 1e-5);
    assert!(view.shape().is_some_and(|shape| shape.part_count() == 1));
}

#[test]
fn every_kind_of_body_has_a_surface_to_draw() {
    let mut world = World::new(awake()).unwrap();
    let center_of_mass = Arc::new(
        Shape::convex_hull(&[Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE * 2.0, Vec3::new(3.0, 1.0, 0.0)]).unwrap(),
    );
    let at = Vec3::new(1.0, 2.0, 3.0);
    let rotation = Quat::from_rotation_y(1.0);
    let body = RigidBody::new(&center_of_mass).position(at).rotation(rotation);
    let hull = add(&mut world, body);
    let drawn = world.body(hull).unwrap().surface_positions();
    for (x, own) in drawn.iter().zip(center_of_mass.positions()) {
        assert!(x.distance(at + rotation * *own) < 1e-5);
    }
    let truss = Arc::new(Truss::from_mesh(&primitives::cube(1.0).unwrap()).unwrap());
    world.add(TrussBody::new(&truss)).unwrap();
    world.add(Cloth::grid(4, 4, 1.0, 1.0)).unwrap();
    world.add(HalfSpace::floor(-1.0)).unwrap();
    for handle in world.bodies() {
        let view = world.body(handle).unwrap();
        let count = view.surface_positions().len();
        assert!(view.triangles().iter().flatten().all(|&v| (v as usize) < count));
    }
}
