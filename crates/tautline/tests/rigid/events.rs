//! Contact events: when they come, in which order, and how hard it was.

use std::sync::Arc;

use tautline::ContactEventKind::{Began, Ended, Persists};
use tautline::{BodyHandle, ContactEvent, HalfSpace, Motion, Quat, RigidBody, Settings, Shape, Vec3, World};

use super::{DT, add, awake, center, cube, floor, run, weightless};

fn ball() -> RigidBody {
    RigidBody::new(&Arc::new(Shape::sphere(0.2).unwrap())).mass(3.0).report_contacts()
}

/// The only event of the last step.
fn event(world: &World) -> ContactEvent {
    let [event] = world.contact_events() else { panic!("{:?}", world.contact_events()) };
    *event
}

/// Steps, and says what happened, in short.
fn kinds(world: &mut World, steps: usize) -> Vec<tautline::ContactEventKind> {
    let mut kinds = Vec::new();
    for _ in 0..steps {
        world.step(DT).unwrap();
        kinds.extend(world.contact_events().iter().map(|event| event.kind));
    }
    kinds
}

#[test]
fn a_ball_that_bounces_begins_and_ends_each_time_with_the_impulse_it_turns_round_by() {
    let mut world = World::new(awake()).unwrap();
    let ground = world.add(HalfSpace::floor(0.0).restitution(0.8)).unwrap();
    let ball = add(&mut world, ball().position(Vec3::Y * 1.2));
    let mut events = Vec::new();
    while events.len() < 6 {
        let before = world.body(ball).unwrap().velocity().y;
        world.step(DT).unwrap();
        for event in world.contact_events() {
            events.push(event.kind);
            assert_eq!(event.bodies, [ground, ball]);
            assert!(event.normal.distance(Vec3::Y) < 1e-6, "{event:?}");
            if event.kind == Began {
                let change = 3.0 * (world.body(ball).unwrap().velocity().y - before + 9.81 * DT);
                assert!((event.impulse / change - 1.0).abs() < 1e-4, "{event:?}, not {change}");
                // It met with speed v and left with 0.8 v, apart from half a substep's gravity.
                let speed = change / (3.0 * 1.8);
                assert!((event.approach_speed - speed).abs() < 0.03, "{event:?}, not {speed}");
                assert!(event.point.length() < 0.01, "{event:?}");
            } else {
                assert_eq!((event.impulse, event.approach_speed), (0.0, 0.0));
            }
        }
    }
    assert_eq!(events, [Began, Ended, Began, Ended, Began, Ended]);
}

#[test]
fn a_resting_cube_persists_with_its_weight_and_is_silent_in_its_sleep() {
    let mut world = World::new(Settings::default()).unwrap();
    let ground = floor(&mut world);
    let cube = RigidBody::new(&cube(0.5)).mass(4.0).position(Vec3::Y * 0.25).report_contacts();
    let cube = add(&mut world, cube);
    assert_eq!(kinds(&mut world, 1), [Began]);
    run(&mut world, 0.3);
    let event = event(&world);
    assert_eq!((event.kind, event.bodies), (Persists, [ground, cube]));
    assert!((event.impulse / (4.0 * 9.81 * DT) - 1.0).abs() < 1e-4, "{event:?}");
    assert!(event.point.length() < 1e-3 && event.normal.distance(Vec3::Y) < 1e-6, "{event:?}");
    run(&mut world, 2.0);
    assert!(world.body(cube).unwrap().is_asleep() && world.contact_events().is_empty());
    world.wake(cube).unwrap();
    assert_eq!(kinds(&mut world, 1), [Persists]);
    run(&mut world, 2.0);
    let place = world.body(cube).unwrap().pose().unwrap();
    world.set_pose(cube, place.0 + Vec3::Y * 3.0, place.1).unwrap();
    assert_eq!(kinds(&mut world, 2), [Ended]);
}

#[test]
fn what_is_removed_or_fixed_ends_its_contacts() {
    for asleep in [false, true] {
        let mut world = World::new(Settings::default()).unwrap();
        let before = add(&mut world, ball().position(Vec3::X * 5.0).fixed());
        floor(&mut world);
        let place = |i: usize| Vec3::Y * (i as f32 + 0.5);
        let tower: Vec<BodyHandle> = (0..3)
            .map(|i| add(&mut world, RigidBody::new(&cube(1.0)).position(place(i)).report_contacts()))
            .collect();
        run(&mut world, if asleep { 3.0 } else { 0.2 });
        assert_eq!(world.body(tower[1]).unwrap().is_asleep(), asleep);
        world.remove(before).unwrap();
        world.remove(tower[1]).unwrap();
        world.step(DT).unwrap();
        let ended: Vec<[BodyHandle; 2]> = world
            .contact_events()
            .iter()
            .filter(|event| event.kind == Ended)
            .map(|event| event.bodies)
            .collect();
        assert_eq!(ended, [[tower[0], tower[1]], [tower[1], tower[2]]]);
        world.set_motion(tower[0], Motion::Fixed).unwrap();
        world.step(DT).unwrap();
        assert_eq!(event(&world).kind, Ended);
    }
}

#[test]
fn only_those_that_report_are_heard_of() {
    let mut world = World::new(awake()).unwrap();
    floor(&mut world);
    let silent = add(&mut world, RigidBody::new(&cube(1.0)).position(Vec3::Y * 0.5));
    assert_eq!(kinds(&mut world, 5), []);
    world.set_report_contacts(silent, true).unwrap();
    assert_eq!(kinds(&mut world, 2), [Began, Persists]);
    world.set_report_contacts(silent, false).unwrap();
    assert_eq!(kinds(&mut world, 5), []);
    let ground = world.bodies().next().unwrap();
    assert!(world.set_report_contacts(ground, true).is_err());
}

#[test]
fn bodies_of_many_parts_have_one_contact_and_a_moving_one_is_where_it_is() {
    let mut world = World::new(awake()).unwrap();
    let bar = Shape::cuboid(Vec3::new(0.1, 0.1, 1.0)).unwrap();
    let bar = |x: f32| (&bar, Vec3::X * x, Quat::IDENTITY);
    let sledge = Arc::new(Shape::compound(&[bar(-0.5), bar(0.5)]).unwrap());
    let belt = Arc::new(Shape::cuboid(Vec3::new(50.0, 0.5, 2.0)).unwrap());
    let belt = RigidBody::new(&belt).position(Vec3::Y * -0.5).velocity(Vec3::X * 2.0).kinematic();
    let belt = add(&mut world, belt);
    let sledge = RigidBody::new(&sledge).mass(10.0).position(Vec3::Y * 0.1).velocity(Vec3::X * 2.0);
    let sledge = add(&mut world, sledge.report_contacts());
    run(&mut world, 1.0);
    let event = event(&world);
    assert_eq!((event.kind, event.bodies), (Persists, [belt, sledge]));
    assert!((event.impulse / (10.0 * 9.81 * DT) - 1.0).abs() < 1e-3, "{event:?}");
    // In the middle of its step, about.
    let place = center(&world, sledge).with_y(0.0) - Vec3::X * DT;
    assert!((event.point - place).length() < 0.03 && event.normal.dot(Vec3::Y) > 0.9999, "{event:?} {place}");
}

/// A heap of balls and boxes that report.
fn heap() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    floor(&mut world);
    for i in 0..120_u32 {
        let cell = Vec3::new((i % 4) as f32, (i / 16) as f32 + 0.5, (i / 4 % 4) as f32);
        let body = if i % 2 == 0 { ball() } else { RigidBody::new(&cube(0.45)).report_contacts() };
        add(&mut world, body.position(cell * 0.5 + Vec3::X * 0.01 * (i % 7) as f32));
    }
    world
}

#[test]
fn events_are_the_same_on_any_number_of_threads_and_from_a_snapshot_on() {
    let events = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = heap();
            let mut events = Vec::new();
            for _ in 0..60 {
                world.step(DT).unwrap();
                events.push(world.contact_events().to_vec());
            }
            events
        })
    };
    let one = events(1);
    assert_eq!(one, events(2));
    assert!(one.iter().flatten().any(|event| event.kind == Ended));
    for events in &one {
        assert!(events.is_sorted_by(|a, b| a.bodies < b.bodies));
    }
    let mut world = heap();
    run(&mut world, 0.5);
    let removed = world.contact_events()[0].bodies[1];
    world.remove(removed).unwrap();
    let mut restored = World::restore(&world.snapshot()).unwrap();
    for _ in 0..20 {
        world.step(DT).unwrap();
        restored.step(DT).unwrap();
        assert_eq!(world.contact_events(), restored.contact_events());
    }
}

#[test]
fn two_that_meet_tell_how_fast_they_came_together() {
    let mut world = World::new(weightless()).unwrap();
    let first = add(&mut world, ball().position(Vec3::NEG_X).velocity(Vec3::X * 3.0));
    let second = add(&mut world, ball().position(Vec3::X).velocity(Vec3::NEG_X * 2.0).mass(1.0));
    let mut began = Vec::new();
    for _ in 0..60 {
        world.step(DT).unwrap();
        began.extend(world.contact_events().iter().copied().filter(|event| event.kind == Began));
    }
    let [event] = began[..] else { panic!("{began:?}") };
    assert_eq!(event.bodies, [first, second]);
    assert!(event.normal.distance(Vec3::X) < 1e-6, "{event:?}");
    assert!((event.approach_speed - 5.0).abs() < 1e-4, "{event:?}");
    // The reduced mass times the speed: they do not bounce.
    assert!((event.impulse - 0.75 * 5.0).abs() < 1e-3, "{event:?}");
}
