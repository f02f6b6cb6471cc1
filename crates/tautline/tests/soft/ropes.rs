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
