//! Bodies at rest fall asleep, cost nothing, stay where they are, and wake when something changes.

use std::sync::Arc;

use tautline::body::Corner;
use tautline::{BodyHandle, Cloth, HalfSpace, RigidBody, Rope, Settings, Shape, TrussBody, Vec3, World};

use crate::{DT, cube, run};

/// Cubes of half a metre on a floor, run until they sleep.
fn sleeping_stack(count: usize) -> (World, Vec<BodyHandle>) {
    let mut world = World::new(Settings::default()).unwrap();
    let floor = world.add(HalfSpace::floor(0.0)).unwrap();
    let shape = cube(0.5);
    let mut handles = vec![floor];
    for level in 0..count {
        let position = Vec3::Y * (0.25 + 0.5 * level as f32);
        handles.push(world.add(TrussBody::new(&shape).position(position)).unwrap());
    }
    for _ in 0..600 {
        if world.step(DT).unwrap().awake_bodies == 0 {
            return (world, handles);
        }
    }
    panic!("a stack of {count} did not fall asleep in 10 s");
}

fn asleep(world: &World, body: BodyHandle) -> bool {
    world.body(body).unwrap().is_asleep()
}

fn height(world: &World, body: BodyHandle) -> f32 {
    world.body(body).unwrap().center_of_mass().y
}

#[test]
fn a_sleeping_stack_costs_nothing_and_does_not_creep() {
    let (mut world, handles) = sleeping_stack(4);
    assert!(handles[1..].iter().all(|&body| asleep(&world, body)));
    let before = world.positions().to_vec();
    for _ in 0..600 {
        let report = world.step(DT).unwrap();
        assert_eq!((report.visits, report.relaxations, report.contacts, report.pairs), (0, 0, 0, 0));
    }
    assert_eq!(before, world.positions());
    assert_eq!(world.kinetic_energy(), 0.0);
}

#[test]
fn a_hit_a_force_a_velocity_and_new_settings_wake() {
    let wakes = |act: &dyn Fn(&mut World, BodyHandle)| {
        let (mut world, handles) = sleeping_stack(1);
        act(&mut world, handles[1]);
        !asleep(&world, handles[1])
    };
    assert!(!wakes(&|world, _| run(world, 10)));
    assert!(wakes(&|world, body| world.apply_force(body, Vec3::X).unwrap()));
    assert!(wakes(&|world, body| world.apply_force_at(body, 0, Vec3::X).unwrap()));
    assert!(wakes(&|world, body| world.set_velocity(body, Vec3::X).unwrap()));
    assert!(wakes(&|world, body| world.set_particle_mass(body, 0, 2.0).unwrap()));
    assert!(wakes(&|world, body| world.wake(body).unwrap()));
    assert!(wakes(&|world, _| world.set_settings(Settings::paper()).unwrap()));
    assert!(wakes(&|world, _| {
        let bullet = TrussBody::new(&cube(0.2)).position(Vec3::new(2.0, 0.25, 0.0));
        world.add(bullet.velocity(Vec3::X * -8.0)).unwrap();
        run(world, 15);
    }));
}

/// A body about to fall asleep starts to count anew when it is pushed: 1 N on 1 kg for a step is 1/60 m/s.
#[test]
fn a_push_just_before_sleep_is_not_lost() {
    for still_steps in 25..35 {
        let mut world = World::new(Settings { gravity: Vec3::ZERO, ..Settings::default() }).unwrap();
        let body = world.add(TrussBody::new(&cube(0.5))).unwrap();
        run(&mut world, still_steps);
        world.apply_force(body, Vec3::X).unwrap();
        run(&mut world, 2);
        let speed = world.body(body).unwrap().velocity().x;
        assert!((speed - DT).abs() < 1e-4, "{speed} m/s after {still_steps} steps");
    }
}

/// A force that is too weak to move it lets it fall asleep again.
#[test]
fn a_woken_body_at_rest_falls_asleep_again() {
    let (mut world, handles) = sleeping_stack(2);
    world.wake(handles[2]).unwrap();
    run(&mut world, 120);
    assert!(asleep(&world, handles[1]) && asleep(&world, handles[2]));
}

#[test]
fn the_whole_stack_falls_when_its_support_is_removed() {
    for gone in [0, 1] {
        let (mut world, handles) = sleeping_stack(4);
        world.remove(handles[gone]).unwrap();
        let before: Vec<f32> = handles[2..].iter().map(|&body| height(&world, body)).collect();
        run(&mut world, 60);
        for (body, before) in handles[2..].iter().zip(before) {
            let fallen = before - height(&world, *body);
            assert!(fallen > 0.4, "without body {gone}, one fell {fallen} m only");
        }
    }
}

/// The rest comes down when a body is shot out of a sleeping stack.
#[test]
fn a_sleeping_stack_falls_when_a_body_is_shot_out_of_it() {
    for (target, speed) in [(1, 20.0f32), (1, 60.0), (2, 30.0), (2, 100.0)] {
        let (mut world, handles) = sleeping_stack(4);
        let position = Vec3::new(-0.6, 0.25 + 0.5 * (target - 1) as f32, 0.0);
        let bullet = TrussBody::new(&cube(0.3)).position(position).mass(20.0);
        world.add(bullet.velocity(Vec3::X * speed)).unwrap();
        let before: Vec<f32> = handles[target + 1..].iter().map(|&body| height(&world, body)).collect();
        run(&mut world, 120);
        for (body, before) in handles[target + 1..].iter().zip(before) {
            let fallen = before - height(&world, *body);
            assert!(fallen > 0.2, "body {target} shot away at {speed} m/s: one fell {fallen} m only");
        }
    }
}

/// A body asleep on a cloth falls when the cloth is let go.
#[test]
fn a_sleeper_falls_with_the_cloth_that_carries_it() {
    let mut world = World::new(Settings { damping: 1.0, ..Settings::default() }).unwrap();
    let corners = [Corner::First, Corner::RowEnd, Corner::ColumnEnd, Corner::Last];
    let cloth = corners.into_iter().fold(Cloth::grid(10, 10, 2.0, 2.0), Cloth::pin_corner);
    let cloth = world.add(cloth).unwrap();
    let shape = Arc::new(Shape::cuboid(Vec3::splat(0.2)).unwrap());
    let body = world.add(RigidBody::new(&shape).mass(1.0).position(Vec3::Y * 0.3)).unwrap();
    for _ in 0..1800 {
        if world.step(DT).unwrap().awake_bodies == 0 {
            break;
        }
    }
    assert!(asleep(&world, body) && asleep(&world, cloth), "they did not come to rest in 30 s");
    let before = height(&world, body);
    for particle in [0, 9, 90, 99] {
        world.unpin(cloth, particle).unwrap();
    }
    run(&mut world, 60);
    assert!(before - height(&world, body) > 2.0, "it fell {} m", before - height(&world, body));
}

#[test]
fn a_hung_rope_wakes_when_its_pin_is_moved() {
    let mut world = World::new(Settings { damping: 2.0, ..Settings::default() }).unwrap();
    let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::NEG_Y, 10).pin(0)).unwrap();
    run(&mut world, 300);
    assert!(asleep(&world, rope));
    world.set_particle_position(rope, 0, Vec3::X * 0.3).unwrap();
    run(&mut world, 300);
    let end = world.body(rope).unwrap().positions()[10];
    assert!(end.distance(Vec3::new(0.3, -1.0, 0.0)) < 0.05, "its end hangs at {end}");
}

/// What never moves by itself, put where a body sleeps, pushes it out.
#[test]
fn a_sleeper_is_woken_by_a_wall_put_into_it() {
    let (mut world, handles) = sleeping_stack(1);
    world.add(HalfSpace::floor(0.003)).unwrap();
    run(&mut world, 120);
    let y = height(&world, handles[1]);
    assert!((y - 0.253).abs() < 5e-4, "at {y}");
    let (mut world, handles) = sleeping_stack(1);
    let block = world.add(TrussBody::new(&cube(0.5)).position(Vec3::new(5.0, 0.25, 0.0)).fixed()).unwrap();
    for particle in 0..8 {
        let old = world.body(block).unwrap().positions()[particle as usize];
        world.set_particle_position(block, particle, old - Vec3::X * 4.505).unwrap();
    }
    run(&mut world, 120);
    let x = world.body(handles[1]).unwrap().center_of_mass().x;
    assert!(x < -0.004, "the block moved it to x = {x}");
}

/// A sleeper has the displacement 0 of a body at rest half a substep ago: woken, it moves by ½ a (t² + h t).
#[test]
fn a_woken_body_falls_from_rest() {
    let (mut world, handles) = sleeping_stack(1);
    let settings = Settings { gravity: Vec3::Y * 9.81, sleep: None, ..Settings::default() };
    let before = height(&world, handles[1]);
    world.set_settings(settings).unwrap();
    let start = world.time();
    run(&mut world, 60);
    let (t, h) = (world.time() - start, f64::from(DT) / 8.0);
    let risen = f64::from(height(&world, handles[1]) - before);
    assert!((risen - 0.5 * 9.81 * (t * t + h * t)).abs() < 1e-3, "rose {risen} m in {t} s");
}
