//! What rests falls asleep, island by island, and wakes when something happens to it.

use std::sync::Arc;

use tautline::{BallJoint, BodyHandle, Quat, RigidBody, Settings, Shape, Vec3, World};

use super::{DT, add, awake, center, cube, floor, run};

/// A tower of cubes of 1 m and 1 kg on whatever is at height 0.
fn tower(world: &mut World, x: f32, count: usize) -> Vec<BodyHandle> {
    let place = |i: usize| Vec3::new(x, i as f32 + 0.5, 0.0);
    (0..count).map(|i| add(world, RigidBody::new(&cube(1.0)).mass(1.0).position(place(i)))).collect()
}

/// A tower of five that sleeps.
fn sleeping_tower() -> (World, Vec<BodyHandle>) {
    let mut world = World::new(Settings::default()).unwrap();
    floor(&mut world);
    let bodies = tower(&mut world, 0.0, 5);
    run(&mut world, 3.0);
    assert_eq!(sleepers(&world, &bodies), 5);
    (world, bodies)
}

fn sleepers(world: &World, bodies: &[BodyHandle]) -> usize {
    bodies.iter().filter(|&&body| world.body(body).unwrap().is_asleep()).count()
}

fn ball() -> RigidBody {
    RigidBody::new(&Arc::new(Shape::sphere(0.3).unwrap())).mass(1.0)
}

#[test]
fn a_sleeping_tower_changes_no_bit() {
    let (mut world, _) = sleeping_tower();
    let hash = world.state_hash();
    for _ in 0..60 {
        assert_eq!(world.step(DT).unwrap().awake_bodies, 0);
    }
    assert_eq!(world.state_hash(), hash);
    assert_eq!(world.kinetic_energy(), 0.0);
}

#[test]
fn without_sleep_nothing_sleeps() {
    let mut world = World::new(awake()).unwrap();
    floor(&mut world);
    let bodies = tower(&mut world, 0.0, 5);
    run(&mut world, 3.0);
    assert_eq!(sleepers(&world, &bodies), 0);
    assert_eq!(world.step(DT).unwrap().awake_bodies, 5);
}

#[test]
fn one_that_never_sleeps_keeps_its_island_awake() {
    let mut world = World::new(Settings::default()).unwrap();
    floor(&mut world);
    let bodies = tower(&mut world, 0.0, 2);
    let top = RigidBody::new(&cube(1.0)).mass(1.0).position(Vec3::Y * 2.5).never_sleep();
    add(&mut world, top);
    run(&mut world, 3.0);
    assert_eq!(sleepers(&world, &bodies), 0);
}

#[test]
fn a_ball_wakes_a_tower_and_gives_it_its_momentum() {
    let (mut world, bodies) = sleeping_tower();
    add(&mut world, ball().position(Vec3::new(-3.0, 4.5, 0.0)).velocity(Vec3::X * 10.0));
    run(&mut world, 0.1);
    assert_eq!(sleepers(&world, &bodies), 5, "before it arrives");
    run(&mut world, 0.3);
    assert_eq!(sleepers(&world, &bodies), 0);
    let momentum = world.body(bodies[4]).unwrap().velocity().x;
    assert!(momentum > 1.0, "{momentum}");
}

#[test]
fn a_tower_falls_when_its_lowest_cube_goes() {
    let (mut world, bodies) = sleeping_tower();
    world.remove(bodies[0]).unwrap();
    assert_eq!(sleepers(&world, &bodies[1..]), 0);
    run(&mut world, 2.0);
    assert!((center(&world, bodies[1]).y - 0.5).abs() < 0.02);
}

#[test]
fn a_push_at_the_lowest_cube_wakes_the_tower() {
    let (mut world, bodies) = sleeping_tower();
    world.apply_force(bodies[0], Vec3::X * 10.0).unwrap();
    assert_eq!(sleepers(&world, &bodies), 0);
}

#[test]
fn a_box_taken_away_wakes_what_rests_on_it() {
    for is_moved in [false, true] {
        let mut world = World::new(Settings::default()).unwrap();
        let slab = Arc::new(Shape::cuboid(Vec3::new(5.0, 0.5, 5.0)).unwrap());
        let slab = add(&mut world, RigidBody::new(&slab).position(Vec3::Y * -0.5).fixed());
        let bodies = tower(&mut world, 3.0, 2);
        run(&mut world, 3.0);
        assert_eq!(sleepers(&world, &bodies), 2);
        match is_moved {
            false => world.remove(slab).unwrap(),
            true => world.set_pose(slab, Vec3::Y * -9.0, Quat::IDENTITY).unwrap(),
        }
        run(&mut world, 1.0);
        assert!(center(&world, bodies[1]).y < -1.0, "{}", center(&world, bodies[1]));
    }
}

#[test]
fn stacks_sleep_each_by_itself() {
    let mut world = World::new(Settings::default()).unwrap();
    floor(&mut world);
    let (left, right) = (tower(&mut world, -1.0, 3), tower(&mut world, 1.0, 3));
    for _ in 0..20 {
        run(&mut world, 0.1);
        world.wake(right[1]).unwrap();
    }
    assert_eq!((sleepers(&world, &left), sleepers(&world, &right)), (3, 0));
    assert_eq!(world.step(DT).unwrap().awake_bodies, 3);
    run(&mut world, 2.0);
    assert_eq!(sleepers(&world, &right), 3);
    world.wake(right[2]).unwrap();
    assert_eq!((sleepers(&world, &left), sleepers(&world, &right)), (3, 0));
}

#[test]
fn a_lift_wakes_what_stands_on_it_and_carries_it_awake() {
    let mut world = World::new(Settings::default()).unwrap();
    let slab = Arc::new(Shape::cuboid(Vec3::new(2.0, 0.5, 2.0)).unwrap());
    let lift = add(&mut world, RigidBody::new(&slab).position(Vec3::Y * -0.5).kinematic());
    let bodies = tower(&mut world, 0.0, 2);
    run(&mut world, 3.0);
    assert_eq!(sleepers(&world, &bodies), 2);
    // Slower than what puts a body to sleep.
    world.set_velocity(lift, Vec3::Y * 0.01).unwrap();
    run(&mut world, 3.0);
    assert_eq!(sleepers(&world, &bodies), 0);
    assert!((center(&world, bodies[1]).y - 1.53).abs() < 5e-3, "{}", center(&world, bodies[1]));
}

#[test]
fn a_pendulum_stays_awake_and_a_hanging_one_sleeps() {
    for (swings, arm) in [(true, Vec3::X), (false, -Vec3::Y)] {
        let mut world = World::new(Settings::default()).unwrap();
        let pivot = add(&mut world, RigidBody::new(&cube(0.2)).position(Vec3::Y * 5.0).fixed());
        let links: Vec<_> = (1..=2)
            .map(|i| {
                add(&mut world, RigidBody::new(&cube(0.2)).mass(1.0).position(Vec3::Y * 5.0 + arm * i as f32))
            })
            .collect();
        world.add_joint(BallJoint::new(links[0], pivot).anchor(Vec3::Y * 5.0)).unwrap();
        world.add_joint(BallJoint::new(links[1], links[0]).anchor(Vec3::Y * 5.0 + arm)).unwrap();
        run(&mut world, 4.0);
        assert_eq!(sleepers(&world, &links), if swings { 0 } else { 2 });
        world.apply_impulse(links[1], Vec3::X).unwrap();
        run(&mut world, DT);
        assert_eq!(sleepers(&world, &links), 0);
    }
}

#[test]
fn a_snapshot_of_sleepers_goes_on_to_the_bit() {
    let (mut world, bodies) = sleeping_tower();
    let mut other = World::restore(&world.snapshot()).unwrap();
    for world in [&mut world, &mut other] {
        add(world, ball().position(Vec3::new(-2.0, 4.5, 0.0)).velocity(Vec3::X * 10.0));
    }
    for _ in 0..60 {
        run(&mut world, DT);
        run(&mut other, DT);
        assert_eq!(world.state_hash(), other.state_hash());
    }
    assert_eq!(sleepers(&world, &bodies), 0);
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = World::new(Settings::default()).unwrap();
            floor(&mut world);
            let towers: Vec<_> = (0..40).flat_map(|i| tower(&mut world, 1.5 * i as f32, 4)).collect();
            run(&mut world, 2.0);
            assert_eq!(sleepers(&world, &towers), towers.len());
            add(&mut world, ball().position(Vec3::new(-3.0, 3.5, 0.0)).velocity(Vec3::X * 10.0));
            run(&mut world, 1.0);
            world.state_hash()
        })
    };
    assert_eq!(hash(1), hash(2));
}
