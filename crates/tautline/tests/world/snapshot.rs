//! Worlds as bytes: restored ones go on bit for bit, and damaged bytes are refused or do no harm.

use std::sync::Arc;

use tautline::body::BodyDescription;
use tautline::{Cloth, Error, HalfSpace, RigidBody, Rope, Settings, Shape, TrussBody, Vec3, World};

use crate::{DT, cube, mixed_scene, run};

#[test]
fn a_restored_world_goes_on_bit_for_bit() {
    let mut world = mixed_scene(Settings::default());
    let handles: Vec<_> = world.bodies().collect();
    run(&mut world, 10);
    world.remove(handles[5]).unwrap();
    let late = world.add(TrussBody::new(&cube(0.4)).position(Vec3::new(3.0, 0.2, 0.0))).unwrap();
    let mut slept = false;
    for round in 0..5 {
        run(&mut world, 30);
        slept |= world.bodies().any(|body| world.body(body).unwrap().is_asleep());
        world.apply_force(handles[7], Vec3::X * 3.0).unwrap();
        let bytes = world.snapshot();
        let mut restored = World::restore(&bytes).unwrap();
        assert_eq!(restored.snapshot(), bytes, "round {round}");
        assert!(restored.body(handles[5]).is_err() && restored.body(late).is_ok());
        run(&mut restored, 45);
        let mut original = world.clone();
        run(&mut original, 45);
        assert_eq!(original.state_hash(), restored.state_hash(), "round {round}");
        assert_eq!(original.snapshot(), restored.snapshot(), "round {round}");
        assert_eq!(original.add(HalfSpace::floor(-1.0)), restored.add(HalfSpace::floor(-1.0)));
    }
    assert!(slept, "the scene should have had a sleeper");
}

#[test]
fn a_world_that_a_body_has_just_come_to_is_restored() {
    let shape = Arc::new(Shape::sphere(0.2).unwrap());
    let ball = |x: f32| RigidBody::new(&shape).position(Vec3::new(x, 0.2, 0.0));
    let additions: [BodyDescription; 5] = [
        HalfSpace::floor(-1.0).into(),
        ball(2.0).into(),
        Cloth::grid(4, 4, 1.0, 1.0).position(Vec3::new(4.0, 1.0, 0.0)).into(),
        Rope::straight(Vec3::new(6.0, 1.0, 0.0), Vec3::new(7.0, 1.0, 0.0), 5).into(),
        TrussBody::new(&cube(0.4)).position(Vec3::new(9.0, 1.0, 0.0)).into(),
    ];
    for body in additions {
        let mut world = World::new(Settings::default()).unwrap();
        world.add(HalfSpace::floor(0.0)).unwrap();
        world.add(ball(0.0)).unwrap();
        run(&mut world, 10);
        world.add(body).unwrap();
        for _ in 0..2 {
            let mut restored = World::restore(&world.snapshot()).unwrap();
            run(&mut restored, 10);
            run(&mut world, 10);
            assert_eq!(world.state_hash(), restored.state_hash());
        }
    }
}

/// Every stripe of bodies has a copy of those that are kinematic.
#[test]
fn a_world_that_a_kinematic_body_has_just_left_is_restored() {
    let shape = Arc::new(Shape::sphere(0.2).unwrap());
    let ball = |x: f32| RigidBody::new(&shape).position(Vec3::new(x, 0.2, 0.0));
    for removed in 0..3 {
        let mut world = World::new(Settings::default()).unwrap();
        let bodies = [ball(0.0), ball(0.5).kinematic(), ball(0.9).kinematic()];
        let bodies = bodies.map(|body| world.add(body).unwrap());
        run(&mut world, 3);
        world.remove(bodies[removed]).unwrap();
        let mut restored = World::restore(&world.snapshot()).unwrap();
        run(&mut restored, 3);
        run(&mut world, 3);
        assert_eq!(world.state_hash(), restored.state_hash());
    }
}

#[test]
fn other_bytes_are_refused() {
    let bytes = mixed_scene(Settings::paper()).snapshot();
    let mut other_version = bytes.clone();
    other_version[8] += 1;
    let longer = [&bytes[..], &[0]].concat();
    for wrong in [&[][..], b"tautline", b"GIF89a..........", &other_version, &longer] {
        assert!(matches!(World::restore(wrong), Err(Error::Snapshot(_))));
    }
}

#[test]
fn a_truncated_snapshot_is_refused_wherever_it_ends() {
    let bytes = small_world().snapshot();
    for length in 0..bytes.len() {
        assert!(World::restore(&bytes[..length]).is_err(), "cut to {length} of {} bytes", bytes.len());
    }
}

/// A truss, a rope and a floor in contact.
fn small_world() -> World {
    let mut world = World::new(Settings { substeps: 1, ..Settings::default() }).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let shape = crate::truss(tautline::mesh::primitives::tetrahedron(0.5).unwrap());
    world.add(TrussBody::new(&shape).position(Vec3::Y * 0.3)).unwrap();
    let (start, end) = (Vec3::new(-0.4, 0.3, 0.0), Vec3::new(0.4, 0.3, 0.1));
    world.add(Rope::straight(start, end, 3).self_collision(true).bending(0.1).pin(0)).unwrap();
    run(&mut world, 3);
    world
}

/// Whatever a flipped byte makes of a world: it is refused with an error, or it steps without a panic and
/// shows finite positions.
fn survives(bytes: &[u8]) -> bool {
    let Ok(mut world) = World::restore(bytes) else { return true };
    if world.settings().substeps > 16 || world.settings().relaxation.sweeps > 16 {
        return true; // allowed, and slow
    }
    for _ in 0..3 {
        world.step(DT).unwrap();
    }
    world.penetration();
    world.strain();
    world.snapshot();
    world.positions().iter().all(|x| x.is_finite())
}

#[test]
fn every_flipped_byte_is_refused_or_harmless() {
    let bytes = small_world().snapshot();
    let mut damaged = bytes.clone();
    let mut refused = 0;
    for place in 0..bytes.len() {
        for value in [bytes[place] ^ 0x01, bytes[place] ^ 0x80, 0xff, 0x00, bytes[place] ^ 0x7f] {
            damaged[place] = value;
            refused += usize::from(World::restore(&damaged).is_err());
            assert!(survives(&damaged), "byte {place} set to {value}");
        }
        damaged[place] = bytes[place];
    }
    println!("{refused} of {} refused", 5 * bytes.len());
}

#[test]
fn damaged_bytes_of_a_mixed_scene_are_refused_or_harmless() {
    let mut world = mixed_scene(Settings { substeps: 1, ..Settings::default() });
    run(&mut world, 40);
    let bytes = world.snapshot();
    // A fixed sequence of places and values (Knuth's 64-bit congruential generator).
    let mut random = 1u64;
    let mut next = move || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize
    };
    for _ in 0..400 {
        let mut damaged = bytes.clone();
        for _ in 0..1 + next() % 3 {
            let place = 12 + next() % (bytes.len() - 12);
            damaged[place] = next() as u8;
        }
        assert!(survives(&damaged));
    }
}
