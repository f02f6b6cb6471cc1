//! Holding bodies at a point.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{Cloth, Error, Grip, RigidBody, Rope, Shape, Truss, TrussBody, Vec3, World};

use super::{DT, add, awake, center, cube, floor, run, weightless};

const TARGET: Vec3 = Vec3::new(1.0, 2.0, -1.0);

#[test]
fn what_is_held_follows_whatever_its_mass() {
    let mut paths: Vec<Vec<Vec3>> = Vec::new();
    for mass in [1e-3, 1.0, 1e4] {
        let mut world = World::new(awake()).unwrap();
        let body = add(&mut world, RigidBody::new(&cube(0.4)).mass(mass));
        let grab = world.grab(body, Vec3::splat(0.2), Grip::default()).unwrap();
        world.move_grab(grab, TARGET).unwrap();
        let step = |world: &mut World| {
            run(world, DT);
            world.grab_ends(grab).unwrap()[0]
        };
        paths.push((0..120).map(|_| step(&mut world)).collect());
        let speed = world.body(body).unwrap().velocity().length();
        assert!(speed < 5.0, "{speed} m/s at {mass} kg");
    }
    for path in &paths {
        let end = *path.last().unwrap();
        assert!(end.distance(TARGET) < 0.02, "{end}");
        // Critically damped, but the body swings about the point that it is held at.
        let beyond = path.iter().map(|x| x.dot(TARGET) / TARGET.length_squared()).fold(0.0, f32::max);
        assert!(beyond < 1.2, "{beyond}");
    }
    for (a, b) in paths[0].iter().zip(&paths[2]) {
        assert!(a.distance(*b) < 1e-3, "the same way for any mass");
    }
}

#[test]
fn a_point_in_the_middle_moves_as_a_critically_damped_spring() {
    let mut world = World::new(weightless()).unwrap();
    let body = add(&mut world, RigidBody::new(&cube(0.4)));
    let grip = Grip { frequency: 1.0, ..Grip::default() };
    let grab = world.grab(body, Vec3::ZERO, grip).unwrap();
    world.move_grab(grab, Vec3::X).unwrap();
    let omega = std::f32::consts::TAU;
    for step in 1..=60 {
        run(&mut world, DT);
        // The target takes the first step to get there.
        let t = (step as f32 - 0.5) * DT;
        let exact = 1.0 - (1.0 + omega * t) * (-omega * t).exp();
        assert!((center(&world, body).x - exact).abs() < 0.01, "{} {exact}", center(&world, body).x);
    }
}

#[test]
fn a_tiny_body_held_at_its_edge_comes_to_rest_or_swings_and_a_stiff_grip_is_stable() {
    for (side, frequency) in [(0.004, 8.0), (0.4, 1e4), (4.0, 100.0)] {
        let mut world = World::new(awake()).unwrap();
        let body = add(&mut world, RigidBody::new(&cube(side)));
        let grab = world.grab(body, Vec3::splat(side / 2.0), Grip { frequency, ..Grip::default() }).unwrap();
        for step in 0..240 {
            let angle = step as f32 * DT * 3.0;
            world.move_grab(grab, Vec3::new(angle.sin(), angle.cos(), 0.0) * 0.5).unwrap();
            run(&mut world, DT);
        }
        let [held, target] = world.grab_ends(grab).unwrap();
        assert!(held.distance(target) < 0.15, "{held} {target}");
        assert!(center(&world, body).distance(held) < side, "it has not come apart");
        let spin = world.body(body).unwrap().angular_velocity().length();
        assert!(spin < 200.0, "{spin} rad/s at {side} m");
    }
}

#[test]
fn a_released_body_flies_on() {
    let mut world = World::new(weightless()).unwrap();
    let body = add(&mut world, RigidBody::new(&cube(0.4)));
    let grab = world.grab(body, Vec3::ZERO, Grip::default()).unwrap();
    for step in 0..60 {
        world.move_grab(grab, Vec3::X * (2.0 * DT * step as f32)).unwrap();
        run(&mut world, DT);
    }
    let velocity = world.body(body).unwrap().velocity();
    assert!(velocity.distance(Vec3::X * 2.0) < 0.02, "{velocity}");
    world.release(grab).unwrap();
    run(&mut world, 0.5);
    assert!(world.body(body).unwrap().velocity().distance(velocity) < 1e-5);
    assert_eq!(world.release(grab), Err(Error::StaleHandle));
    assert_eq!(world.grab_ends(grab), Err(Error::StaleHandle));
}

#[test]
fn the_force_has_a_limit() {
    let mut world = World::new(weightless()).unwrap();
    let body = add(&mut world, RigidBody::new(&cube(0.4)).mass(7.0));
    let grip = Grip { max_acceleration: 2.0, ..Grip::default() };
    let grab = world.grab(body, Vec3::ZERO, grip).unwrap();
    world.move_grab(grab, Vec3::X * 100.0).unwrap();
    run(&mut world, 1.0);
    let speed = world.body(body).unwrap().velocity().x;
    assert!((speed - 2.0).abs() < 0.02, "{speed}");
}

#[test]
fn a_held_body_is_stopped_by_others() {
    let mut world = World::new(awake()).unwrap();
    floor(&mut world);
    let body = add(&mut world, RigidBody::new(&cube(1.0)).position(Vec3::Y * 0.5));
    let grab = world.grab(body, Vec3::Y * 0.5, Grip::default()).unwrap();
    world.move_grab(grab, Vec3::NEG_Y).unwrap();
    run(&mut world, 2.0);
    assert!(center(&world, body).y > 0.45, "{}", center(&world, body).y);
}

#[test]
fn trusses_cloth_and_rope_are_held_at_their_nearest_particle() {
    let mut world = World::new(awake()).unwrap();
    let truss = Arc::new(Truss::from_mesh(&primitives::cube(0.5).unwrap()).unwrap());
    let bodies = [
        world.add(TrussBody::new(&truss)).unwrap(),
        world.add(Cloth::grid(12, 12, 1.0, 1.0).position(Vec3::X * 3.0).mass(0.3)).unwrap(),
        world.add(Rope::straight(Vec3::X * 6.0, Vec3::X * 7.0, 20)).unwrap(),
    ];
    let points = [Vec3::splat(0.3), Vec3::new(2.4, 0.0, -0.6), Vec3::X * 5.9];
    let masses = |world: &World| bodies.map(|b| world.body(b).unwrap().inverse_masses().to_vec());
    let before = masses(&world);
    let grabs: Vec<_> =
        bodies.iter().zip(points).map(|(b, x)| world.grab(*b, x, Grip::default()).unwrap()).collect();
    let targets: Vec<Vec3> =
        grabs.iter().map(|grab| world.grab_ends(*grab).unwrap()[0] + Vec3::Y * 0.5).collect();
    assert!(targets[0].distance(Vec3::new(0.25, 0.75, 0.25)) < 1e-6);
    for (grab, target) in grabs.iter().zip(&targets) {
        world.move_grab(*grab, *target).unwrap();
    }
    run(&mut world, 4.0);
    for (grab, target) in grabs.iter().zip(&targets) {
        let [held, _] = world.grab_ends(*grab).unwrap();
        assert!(held.distance(*target) < 0.03, "{held} {target}");
    }
    assert_eq!(masses(&world), before, "the weight that was lent is taken back");
    for body in bodies {
        assert!(world.body(body).unwrap().center_of_mass().y < 0.7);
    }
    grabs.iter().for_each(|grab| world.release(*grab).unwrap());
    run(&mut world, 1.0);
    assert!(bodies.iter().all(|body| world.body(*body).unwrap().center_of_mass().y < -2.0));
}

#[test]
fn what_cannot_be_moved_cannot_be_held_and_what_is_gone_is_let_go() {
    let mut world = World::new(awake()).unwrap();
    let ground = floor(&mut world);
    let ball = Arc::new(Shape::sphere(0.5).unwrap());
    let fixed = add(&mut world, RigidBody::new(&ball).fixed());
    let driven = add(&mut world, RigidBody::new(&ball).kinematic());
    for body in [ground, fixed, driven] {
        let refused = world.grab(body, Vec3::ZERO, Grip::default());
        assert!(matches!(refused, Err(Error::Invalid { ref field, .. }) if field == "body"), "{refused:?}");
    }
    let body = add(&mut world, RigidBody::new(&ball).position(Vec3::Y * 3.0));
    let [first, second] = [0, 1].map(|_| world.grab(body, Vec3::Y * 3.0, Grip::default()).unwrap());
    world.release(first).unwrap();
    world.remove(body).unwrap();
    assert_eq!(world.move_grab(second, Vec3::ZERO), Err(Error::StaleHandle));
    run(&mut world, 0.1);
}

#[test]
fn a_held_cloth_goes_on_the_same_after_a_snapshot() {
    let mut world = World::new(awake()).unwrap();
    let cloth = world.add(Cloth::grid(8, 8, 1.0, 1.0)).unwrap();
    let grab = world.grab(cloth, Vec3::ZERO, Grip::default()).unwrap();
    world.move_grab(grab, TARGET).unwrap();
    run(&mut world, 0.2);
    let mut restored = World::restore(&world.snapshot()).unwrap();
    run(&mut world, 0.5);
    run(&mut restored, 0.5);
    assert_eq!(world.state_hash(), restored.state_hash());
    assert_eq!(world.grab_ends(grab), restored.grab_ends(grab));
}
