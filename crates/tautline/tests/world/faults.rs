//! Bodies that start where they cannot be, and numbers that leave what f32 can hold.

use std::sync::Arc;

use tautline::{Cloth, HalfSpace, Quat, RigidBody, Rope, Settings, Shape, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron, mixed_scene, run, weightless};

fn all_finite(world: &World) -> bool {
    world.positions().iter().all(|x| x.is_finite())
}

/// At 1e9 m numbers are 64 m apart.
#[test]
fn a_body_so_far_away_that_its_particles_coincide_has_a_frame_and_takes_torques() {
    let mut world = World::new(weightless()).unwrap();
    let shape = Arc::new(Shape::sphere(0.2).unwrap());
    let body = world.add(RigidBody::new(&shape)).unwrap();
    world.set_pose(body, Vec3::new(1e9, -1e9, 1e9), Quat::IDENTITY).unwrap();
    let view = world.body(body).unwrap();
    assert!(view.positions().iter().all(|x| *x == view.positions()[0]));
    let (position, rotation) = view.pose().unwrap();
    assert!(position.is_finite() && (rotation.length() - 1.0).abs() < 1e-6);
    world.apply_torque(body, Vec3::ONE).unwrap();
    World::restore(&world.snapshot()).unwrap();
    world.step(DT).unwrap();
    assert!(all_finite(&world));
    World::restore(&world.snapshot()).unwrap();
}

/// Its force divided by its mass overflows: the body is frozen where it was, and everything else goes on.
#[test]
fn a_body_that_turns_non_finite_is_frozen_where_it_was_and_reported() {
    for sleep in [Settings::default().sleep, None] {
        let mut world = World::new(Settings { sleep, ..weightless() }).unwrap();
        let start = Vec3::new(5.0, 6.0, 7.0);
        let body = world.add(TrussBody::new(&cube(0.5)).position(start)).unwrap();
        let near = TrussBody::new(&cube(0.5)).position(start + Vec3::X * 0.6).velocity(Vec3::Z);
        let near = world.add(near).unwrap();
        world.set_particle_mass(body, 3, 1e-30).unwrap();
        world.apply_force_at(body, 3, Vec3::X * 1e9).unwrap();
        let report = world.step(DT).unwrap();
        assert_eq!(report.faults.len(), 1);
        assert_eq!((report.faults[0].body, report.faults[0].particle), (body, 3));
        assert!(all_finite(&world) && world.body(body).unwrap().is_fixed());
        let frozen = world.body(body).unwrap().positions().to_vec();
        assert!(frozen.iter().all(|x| x.distance(start) < 0.6), "frozen at {frozen:?}");
        for _ in 0..60 {
            assert!(world.step(DT).unwrap().faults.is_empty());
        }
        assert_eq!(frozen, world.body(body).unwrap().positions());
        let passed = world.body(near).unwrap().center_of_mass() - (start + Vec3::X * 0.6);
        assert!(passed.distance(Vec3::Z * 61.0 * DT) < 1e-3, "its neighbour was moved by {passed}");
    }
}

/// The largest numbers every call takes, together: nothing panics, everything shown stays finite.
#[test]
fn extreme_but_allowed_numbers_leave_the_world_finite() {
    let shape = icosahedron(0.5);
    let mut world = mixed_scene(Settings { gravity: Vec3::splat(1e6), damping: 1e6, ..Settings::default() });
    let bodies = [
        TrussBody::new(&shape).position(Vec3::splat(1e9)).velocity(Vec3::splat(-1e9)),
        TrussBody::new(&shape).angular_velocity(Vec3::splat(1e9)).mass(1e-25),
        TrussBody::new(&shape).position(Vec3::Y * 2.0).mass(1e30).velocity(Vec3::Y * -1e9).friction(1e6),
    ];
    for body in bodies {
        world.add(body).unwrap();
    }
    world.add(Rope::straight(Vec3::ZERO, Vec3::X * 1e9, 5).radius(1e6).bending(1e12)).unwrap();
    world.add(Cloth::grid(4, 4, 1.0, 1.0).velocity(Vec3::X * 1e9).thickness(1e6).bending(0.0)).unwrap();
    for step in 0..40 {
        for body in world.bodies().collect::<Vec<_>>() {
            world.apply_force(body, Vec3::splat(if step % 2 == 0 { 1e9 } else { -1e9 })).unwrap();
        }
        world.step([1.0, 1e-7, DT][step % 3]).unwrap();
        assert!(all_finite(&world), "after step {step}");
    }
}

/// Verlet reads a projection as velocity: 0.4 m in a substep of 1/480 s would be 192 m/s. What overlaps from the start
/// is moved apart at `separation_speed` instead.
#[test]
fn a_body_put_into_another_or_into_the_floor_leaves_at_the_separation_speed() {
    let settings = weightless();
    let limit = settings.separation_speed.unwrap();
    let shape = icosahedron(0.5);
    let mut pair = World::new(settings.clone()).unwrap();
    let a = pair.add(TrussBody::new(&shape)).unwrap();
    let b = pair.add(TrussBody::new(&shape).position(Vec3::X * 0.4)).unwrap();
    let mut sunk = World::new(settings).unwrap();
    sunk.add(HalfSpace::floor(0.0)).unwrap();
    let c = sunk.add(TrussBody::new(&shape).position(Vec3::Y * -3.0)).unwrap();
    for step in 0..180 {
        pair.step(DT).unwrap();
        sunk.step(DT).unwrap();
        let apart = pair.body(b).unwrap().velocity() - pair.body(a).unwrap().velocity();
        assert!(apart.length() < 1.5 * limit, "step {step}: {apart}");
        let up = sunk.body(c).unwrap().velocity();
        assert!(up.length() < 1.5 * limit, "step {step}: {up}");
    }
    assert_eq!(pair.penetration().count, 0);
    assert!(sunk.body(c).unwrap().center_of_mass().y > 0.0);
}

/// Each of a hundred is pushed by all others, each at no more than 3 m/s a contact.
#[test]
fn a_hundred_bodies_at_one_point_fly_apart_and_stay_whole() {
    let mut world = World::new(weightless()).unwrap();
    let shape = icosahedron(0.3);
    for _ in 0..100 {
        world.add(TrussBody::new(&shape)).unwrap();
    }
    for _ in 0..60 {
        assert!(world.step(DT).unwrap().faults.is_empty());
    }
    let fastest = world.bodies().map(|b| world.body(b).unwrap().velocity().length()).fold(0.0, f32::max);
    println!("fastest {fastest} m/s, strain {:?}, {:?}", world.strain(), world.penetration());
    assert!(fastest > 0.0 && fastest < 50.0, "{fastest} m/s");
    assert!(all_finite(&world));
}

/// Two cloths in the same place, and one whose particles coincide.
#[test]
fn coincident_cloths_come_apart() {
    let mut world = World::new(weightless()).unwrap();
    let first = world.add(Cloth::grid(6, 6, 1.0, 1.0)).unwrap();
    let second = world.add(Cloth::grid(6, 6, 1.0, 1.0)).unwrap();
    let crumpled = world.add(Cloth::grid(4, 4, 0.5, 0.5).position(Vec3::Y * 9.0)).unwrap();
    for particle in 0..16 {
        world.set_particle_position(crumpled, particle, Vec3::Y * 9.0).unwrap();
    }
    for _ in 0..120 {
        assert!(world.step(DT).unwrap().faults.is_empty());
    }
    assert!(all_finite(&world));
    let center = |body| world.body(body).unwrap().center_of_mass();
    assert!(center(first).distance(center(second)) > 0.1, "{} {}", center(first), center(second));
}

/// A body wholly inside a wall, and a ball in the middle of a fixed cube, come out.
#[test]
fn bodies_deep_in_solids_come_out() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let sunk = world.add(TrussBody::new(&cube(0.5)).position(Vec3::Y * -3.0)).unwrap();
    let block = world.add(TrussBody::new(&cube(1.0)).position(Vec3::new(5.0, 0.5, 0.0)).fixed()).unwrap();
    let inside = Vec3::new(5.0, 0.6, 0.1);
    let ball = world.add(TrussBody::new(&icosahedron(0.2)).position(inside)).unwrap();
    let cloth = world.add(Cloth::grid(5, 5, 0.4, 0.4).position(Vec3::new(5.0, 0.9, 0.0))).unwrap();
    for _ in 0..120 {
        assert!(world.step(DT).unwrap().faults.is_empty());
    }
    let low = |body| world.body(body).unwrap().positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
    assert!(low(sunk) > -0.01, "still at {}", low(sunk));
    let solid = world.body(block).unwrap().positions().to_vec();
    let away = tautline::geometry::distance::distance(&solid, world.body(ball).unwrap().positions()).unwrap();
    assert!(away.distance > -0.01, "the ball is {} m deep", -away.distance);
    let center = world.body(cloth).unwrap().center_of_mass();
    assert!(all_finite(&world) && low(cloth) > -0.01, "cloth about {center}");
    run(&mut world, 1);
}
