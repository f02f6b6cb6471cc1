//! Sleep and waking.

use tautline::{Cloth, HalfSpace, Rope, Settings, Shape, Vec3, World};

use super::{DT, positions, run, solid};

#[test]
fn a_cloth_sleeps_until_a_ball_hits_it() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let cloth = world.add(Cloth::grid(15, 15, 1.0, 1.0).position(Vec3::Y * 0.2)).unwrap();
    run(&mut world, 3.0);
    assert!(world.body(cloth).unwrap().is_asleep());
    let asleep = positions(&world, cloth);
    let ball = solid(Shape::sphere(0.1).unwrap()).mass(1.0).position(Vec3::new(0.1, 1.0, 0.0));
    world.add(ball.velocity(Vec3::new(2.0, -3.0, 0.0))).unwrap();
    let mut was_awake = false;
    for _ in 0..60 {
        world.step(DT).unwrap();
        was_awake |= !world.body(cloth).unwrap().is_asleep();
    }
    assert!(was_awake);
    let moved = positions(&world, cloth).iter().zip(&asleep).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    assert!(moved > 2e-3, "it has moved by {moved} m");
}

#[test]
fn a_cloth_that_falls_or_swings_does_not_sleep() {
    let mut world = World::new(Settings::default()).unwrap();
    let falling = world.add(Cloth::grid(8, 8, 1.0, 1.0).position(Vec3::X * 5.0)).unwrap();
    let swinging = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 20).pin(0)).unwrap();
    run(&mut world, 2.0);
    assert!(!world.body(falling).unwrap().is_asleep() && !world.body(swinging).unwrap().is_asleep());
    let fallen = -super::center(&world, falling).y;
    assert!((fallen / (0.5 * 9.81 * 4.0) - 1.0).abs() < 1e-4, "it has fallen {fallen} m");
}

/// Rows of a sheet that hung moved to and fro by 0.3 mm for ever.
#[test]
fn a_sheet_that_hangs_does_not_tremble() {
    let mut world = World::new(Settings { damping: 2.0, sleep: None, ..Settings::default() }).unwrap();
    let cloth =
        (0..21).fold(Cloth::grid(21, 21, 0.1, 0.1), |cloth, row| cloth.pin(row * 21).pin(row * 21 + 20));
    let cloth = world.add(cloth).unwrap();
    let flat = positions(&world, cloth);
    // From a V, its held edges 9 cm apart.
    for (particle, at) in (0..).zip(flat) {
        let place = Vec3::new(0.9 * at.x, 0.43 * (at.x.abs() - 0.05), at.z);
        world.set_particle_position(cloth, particle, place).unwrap();
    }
    // Until its slow swinging has died out.
    run(&mut world, 10.0);
    let before = positions(&world, cloth);
    let mut farthest = 0.0_f32;
    for _ in 0..30 {
        world.step(DT).unwrap();
        let now = positions(&world, cloth);
        farthest = now.iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(farthest, f32::max);
    }
    assert!(farthest < 2e-6, "it moves by {farthest} m");
}
