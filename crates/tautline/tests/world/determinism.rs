//! The same calls give the same bits, whatever the threads, the broad phase, or who else is in the world.

use tautline::{BroadPhase, Cloth, HalfSpace, Settings, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron, mixed_scene, run};

/// Large enough for every phase that can be spread over threads to be spread.
fn big_scene() -> World {
    let mut world = World::new(Settings { substeps: 4, ..Settings::default() }).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    for normal in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
        world.add(HalfSpace::new(normal, -1.3)).unwrap();
    }
    let ball = icosahedron(0.25);
    for k in 0..180 {
        let (x, y, z) = (k % 6, k / 36, k / 6 % 6);
        let position = Vec3::new(x as f32 - 2.5, y as f32 + 0.7, z as f32 - 2.5) * 0.42;
        let nudge = Vec3::new((k % 7) as f32, 0.0, (k % 5) as f32) * 0.01;
        world.add(TrussBody::new(&ball).position(position + nudge)).unwrap();
    }
    world.add(Cloth::grid(20, 20, 2.0, 2.0).position(Vec3::Y * 2.6)).unwrap();
    world
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = big_scene();
            let mut most_pairs = 0;
            for _ in 0..25 {
                most_pairs = most_pairs.max(world.step(DT).unwrap().pairs / 4);
            }
            assert!(most_pairs > 300 && world.positions().len() > 2000, "{most_pairs} pairs: too small");
            world.state_hash()
        })
    };
    let one = hash(1);
    assert_eq!(one, hash(1), "the same run twice");
    assert_eq!(one, hash(2));
    assert_eq!(one, hash(3));
}

#[test]
fn both_broad_phases_give_the_same_bits() {
    let hash = |broad_phase| {
        let mut world = mixed_scene(Settings { broad_phase, ..Settings::default() });
        run(&mut world, 90);
        world.state_hash()
    };
    assert_eq!(hash(BroadPhase::AllPairs), hash(BroadPhase::SortAndSweep));
}

/// With dt and h powers of two, dt/n is exact, and so n substeps are n steps to the bit.
#[test]
fn n_substeps_are_n_short_steps() {
    let hash = |substeps: u32, dt: f32, steps: usize| {
        let mut world = mixed_scene(Settings { substeps, sleep: None, ..Settings::default() });
        for _ in 0..steps {
            world.step(dt).unwrap();
        }
        world.state_hash()
    };
    assert_eq!(hash(4, 1.0 / 64.0, 60), hash(1, 1.0 / 256.0, 240));
}

/// Bodies that never meet do not know of each other: neither the order in which they were added nor
/// their number changes a bit.
#[test]
fn unrelated_bodies_do_not_influence_each_other() {
    let (cube, ball) = (cube(0.5), icosahedron(0.4));
    let bodies = [
        TrussBody::new(&cube).position(Vec3::new(-4.0, 1.0, 0.0)).angular_velocity(Vec3::splat(1.0)),
        TrussBody::new(&ball).position(Vec3::new(0.0, 2.0, 3.0)).velocity(Vec3::X * 0.3),
        TrussBody::new(&cube).position(Vec3::new(4.0, 1.5, 0.0)).mass(7.0),
    ];
    let positions = |order: &[usize]| {
        let mut world = World::new(Settings::default()).unwrap();
        world.add(HalfSpace::floor(0.0)).unwrap();
        let handles: Vec<_> = order.iter().map(|&k| (k, world.add(bodies[k].clone()).unwrap())).collect();
        run(&mut world, 120);
        let view = |&(k, handle)| (k, world.body(handle).unwrap().positions().to_vec());
        let mut found: Vec<(usize, Vec<Vec3>)> = handles.iter().map(view).collect();
        found.sort_by_key(|&(k, _)| k);
        found
    };
    let all = positions(&[0, 1, 2]);
    assert_eq!(all, positions(&[2, 0, 1]));
    assert_eq!(all[1..], positions(&[2, 1]));
}
