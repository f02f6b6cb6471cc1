//! The same calls give the same bits, whatever the instructions and the threads, and after a snapshot.

use tautline::{Cloth, HalfSpace, Instructions, Quat, Rope, Settings, Shape, Vec3, World};

use super::{DT, solid};

/// A cloth with bending, one from a mesh with pins, ropes, boxes and balls that fall into each other.
fn scene(settings: Settings) -> World {
    let mut world = World::new(settings).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    world.add(solid(Shape::cuboid(Vec3::splat(0.4)).unwrap()).position(Vec3::Y * 0.4).fixed()).unwrap();
    world.add(Cloth::grid(21, 17, 1.5, 1.3).position(Vec3::Y * 0.9)).unwrap();
    let turn = Quat::from_rotation_z(0.2);
    let mesh = tautline::mesh::primitives::grid(9, 9, 1.0, 1.0).unwrap();
    world.add(Cloth::from_mesh(mesh).position(Vec3::new(0.2, 1.3, 0.1)).rotation(turn).pin(4)).unwrap();
    for k in 0..3 {
        let (start, end) = (Vec3::new(-0.8, 1.0 + 0.2 * k as f32, 0.2), Vec3::new(0.8, 1.2, -0.1 * k as f32));
        world.add(Rope::straight(start, end, 12 + 7 * k).self_collision(true).pin(k)).unwrap();
        let ball =
            solid(Shape::sphere(0.1).unwrap()).position(Vec3::new(0.1 * k as f32, 1.8 + 0.3 * k as f32, 0.0));
        world.add(ball.velocity(Vec3::Y * -2.0).mass(0.3)).unwrap();
    }
    world
}

/// The hash after every one of so many steps.
fn hashes(world: &mut World, steps: usize) -> Vec<u64> {
    let mut hash_of_step = || {
        world.step(DT).unwrap();
        world.state_hash()
    };
    (0..steps).map(|_| hash_of_step()).collect()
}

#[test]
fn all_instructions_give_the_same_bits() {
    let hash = |instructions| hashes(&mut scene(Settings { instructions, ..Settings::default() }), 75);
    let expected = hash(Instructions::Scalar);
    assert_eq!(hash(Instructions::Baseline), expected);
    assert_eq!(hash(Instructions::Widest), expected);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| hashes(&mut scene(Settings::default()), 75))
    };
    assert_eq!(hash(1), hash(2));
}

#[test]
fn a_snapshot_in_mid_flight_goes_on_with_the_same_bits() {
    let mut world = scene(Settings::default());
    for _ in 0..5 {
        hashes(&mut world, 13);
        let mut copy = World::restore(&world.snapshot()).unwrap();
        let mut ahead = world.clone();
        assert_eq!(hashes(&mut copy, 60), hashes(&mut ahead, 60));
    }
}
