//! What stands stays, and sticks where friction says.

use tautline::{BodyHandle, Quat, RigidBody, Vec3, World};

use super::{add, awake, center, cube, floor, run};

/// Cubes of 1 m on each other, of these masses (kg), each put a little aside and turned.
fn tower(world: &mut World, masses: &[f32], aside: f32) -> Vec<BodyHandle> {
    floor(world);
    let place = |i: usize| {
        let (a, b, c) = ((i * 7 % 5) as f32 - 2.0, (i * 3 % 7) as f32 - 3.0, (i * 5 % 11) as f32 - 5.0);
        let turn = Quat::from_rotation_y(0.5 * aside * c);
        (Vec3::new(aside * a / 2.0, i as f32 + 0.5, aside * b / 3.0), turn)
    };
    let cube = |(i, &mass): (usize, &f32)| {
        let (position, rotation) = place(i);
        RigidBody::new(&cube(1.0)).mass(mass).position(position).rotation(rotation)
    };
    masses.iter().enumerate().map(cube).collect::<Vec<_>>().into_iter().map(|body| add(world, body)).collect()
}

/// Asserts that nothing has moved from where it was by more than this (m), and that all is at rest.
fn assert_stands(world: &World, bodies: &[BodyHandle], start: &[Vec3], limit: f32) {
    for (i, (&body, start)) in bodies.iter().zip(start).enumerate() {
        let (moved, speed) = (center(world, body) - *start, world.body(body).unwrap().velocity().length());
        assert!(moved.length() < limit, "cube {i} of {} has moved by {moved}", bodies.len());
        assert!(speed < 1e-5, "cube {i} of {} moves at {speed} m/s", bodies.len());
    }
}

fn centers(world: &World, bodies: &[BodyHandle]) -> Vec<Vec3> {
    bodies.iter().map(|&body| center(world, body)).collect()
}

#[test]
fn towers_stand_to_a_hundredth_of_a_millimetre_at_each_contact() {
    for (count, askew) in [(4, 0.02), (10, 0.02), (20, 0.02), (40, 0.0)] {
        for aside in [0.0, askew] {
            let mut world = World::new(awake()).unwrap();
            let bodies = tower(&mut world, &vec![1.0; count], aside);
            let start = centers(&world, &bodies);
            run(&mut world, 5.0);
            assert_stands(&world, &bodies, &start, 1e-5 * count as f32);
        }
    }
}

#[test]
fn a_cube_stands_on_one_a_thousand_times_lighter() {
    for ratio in [10.0, 100.0, 1000.0] {
        let mut world = World::new(awake()).unwrap();
        let bodies = tower(&mut world, &[1.0, ratio], 0.02);
        let start = centers(&world, &bodies);
        run(&mut world, 5.0);
        assert_stands(&world, &bodies, &start, 2e-5);
    }
}

/// Passes and exact solutions take turns while it sways.
#[test]
fn a_tower_that_is_pushed_sways_and_stands() {
    let mut world = World::new(awake()).unwrap();
    let bodies = tower(&mut world, &[1.0; 10], 0.02);
    run(&mut world, 1.0);
    let start = centers(&world, &bodies);
    world.set_velocity(bodies[5], Vec3::X).unwrap();
    run(&mut world, 0.05);
    assert!((center(&world, bodies[5]) - start[5]).x > 1e-3);
    for _ in 0..100 {
        run(&mut world, 0.1);
        assert!(world.kinetic_energy() < 1.0, "{} J", world.kinetic_energy());
    }
    for (&body, start) in bodies.iter().zip(start) {
        assert!((center(&world, body) - start).length() < 0.05);
    }
}

#[test]
fn a_tower_that_leans_too_far_falls() {
    let mut world = World::new(awake()).unwrap();
    floor(&mut world);
    let bodies: Vec<BodyHandle> = (0..6)
        .map(|i| Vec3::new(0.3 * i as f32, i as f32 + 0.5, 0.0))
        .map(|position| add(&mut world, RigidBody::new(&cube(1.0)).mass(1.0).position(position)))
        .collect();
    run(&mut world, 4.0);
    assert!(center(&world, bodies[5]).y < 3.0, "{}", center(&world, bodies[5]));
}
