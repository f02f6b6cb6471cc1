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
