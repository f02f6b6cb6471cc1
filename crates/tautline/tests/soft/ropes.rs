//! Ropes: hung, over something, and under cloth.

use tautline::{Cloth, Quat, QueryFilter, Rope, Settings, Shape, Vec3, World};

use super::{center, pierced, positions, run, solid, stretch};

#[test]
fn a_rope_hangs_over_a_cylinder() {
    let roll = solid(Shape::cylinder(0.3, 1.0).unwrap()).rotation(Quat::from_rotation_x(1.570_796_4)).fixed();
    let mut world = World::new(Settings::default()).unwrap();
    world.add(roll.clone().friction(1.0)).unwrap();
    let (start, end) = (Vec3::new(-1.2, 0.4, 0.01), Vec3::new(1.2, 0.4, 0.01));
    let rope = world.add(Rope::straight(start, end, 48).friction(1.0)).unwrap();
    run(&mut world, 4.0);
    let mut alone = World::new(Settings::default()).unwrap();
    alone.add(roll).unwrap();
    for &at in &positions(&world, rope) {
        let distance = alone.closest_point(at, 9.0, QueryFilter::default()).unwrap().unwrap().distance;
        assert!(distance > 0.019, "{at} is {distance} m from the cylinder");
    }
    let at = positions(&world, rope);
    assert!(at[0].y < -0.3 && at[48].y < -0.3 && at[24].y > 0.3, "{} {} {}", at[0], at[24], at[48]);
    assert!(stretch(&world, rope) < 2e-3, "{}", stretch(&world, rope));
}

#[test]
fn a_cloth_hangs_over_a_rope() {
    let mut world = World::new(Settings::default()).unwrap();
    let rope = Rope::straight(Vec3::new(-1.5, 1.0, 0.0), Vec3::new(1.5, 1.0, 0.0), 60).pin_ends();
    let rope = world.add(rope.mass(0.3).length(3.03)).unwrap();
    let cloth = world.add(Cloth::grid(20, 20, 1.0, 1.0).mass(0.3).position(Vec3::Y * 1.1)).unwrap();
    run(&mut world, 3.0);
    let at = center(&world, cloth);
    assert!(at.y > 0.3 && at.y < 1.0, "the cloth is at {at}");
    assert_eq!(pierced(&world, rope, cloth), 0, "the rope goes through the cloth");
    assert!(stretch(&world, rope) < 5e-3, "{}", stretch(&world, rope));
    assert!(stretch(&world, cloth) < 0.05, "{}", stretch(&world, cloth));
}

/// The ends of shorter ropes were once pulled to where a longer one beside them went on.
#[test]
fn ropes_of_different_lengths_do_not_move_each_other() {
    let mut world = World::new(Settings { gravity: Vec3::ZERO, ..Settings::default() }).unwrap();
    let rope = |x: f32, segments: u32| {
        Rope::straight(Vec3::new(x, 0.0, 0.0), Vec3::new(x, 0.1 * segments as f32, 0.0), segments)
    };
    let ropes = [(0.0, 40), (5.0, 24), (10.0, 24), (15.0, 1)]
        .map(|(x, segments)| world.add(rope(x, segments)).unwrap());
    let before = ropes.map(|rope| positions(&world, rope));
    run(&mut world, 1.0);
    for (rope, before) in ropes.into_iter().zip(before) {
        let moved =
            positions(&world, rope).iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(moved < 1e-3, "a particle moved {moved} m");
    }
}

#[test]
fn a_hung_rope_sags_as_the_discrete_catenary() {
    let settings = Settings { damping: 2.0, sleep: None, ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let rope = world.add(Rope::straight(Vec3::NEG_X, Vec3::X, 50).length(3.0).pin_ends()).unwrap();
    run(&mut world, 20.0);
    let expected = sag(50, 3.0, 2.0);
    assert!((expected - 1.005_525_6).abs() < 1e-6);
    let found = -f64::from(positions(&world, rope)[25].y);
    assert!((found - expected).abs() < 2e-4, "it sags by {found} m, not {expected}");
    assert!(stretch(&world, rope) < 1e-3);
}

#[test]
fn a_rope_that_hits_another_stays_on_its_side() {
    let mut world = World::new(Settings::default()).unwrap();
    let lower = Rope::straight(Vec3::new(-1.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), 40).pin_ends();
    let lower = world.add(lower).unwrap();
    let upper = Rope::straight(Vec3::new(0.01, 1.3, -0.6), Vec3::new(0.01, 1.3, 0.6), 24).mass(0.2);
    let upper = world.add(upper.velocity(Vec3::Y * -3.0)).unwrap();
    run(&mut world, 1.0);
    let middle = positions(&world, upper)[12];
    let below = positions(&world, lower)[20];
    assert!(middle.y > below.y && middle.y < below.y + 0.1, "{middle} on {below}");
}

/// The lowest node of a hung chain of `segments` (even) equal links, in m below its ends. Link k carries the horizontal
/// tension H, by bisection from the span, and the vertical one (k − (n − 1)/2) m g.
fn sag(segments: usize, length: f64, span: f64) -> f64 {
    let link = length / segments as f64;
    let vertical = |k: usize| k as f64 - (segments as f64 - 1.0) / 2.0;
    let width = |h: f64| (0..segments).map(|k| link * h / h.hypot(vertical(k))).sum::<f64>();
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        if width(middle) < span { low = middle } else { high = middle }
    }
    (0..segments / 2).map(|k| -link * vertical(k) / low.hypot(vertical(k))).sum()
}
