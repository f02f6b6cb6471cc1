//! Cloth on cloth.

use tautline::{Cloth, HalfSpace, Settings, Shape, Vec3, World};

use super::{center, pierced, run, solid, stretch};

#[test]
fn two_cloths_fall_on_each_other_and_do_not_mix() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    world
        .add(solid(Shape::cuboid(Vec3::new(0.3, 0.5, 0.3)).unwrap()).position(Vec3::Y * 0.5).fixed())
        .unwrap();
    let lower = world.add(Cloth::grid(20, 20, 1.4, 1.4).position(Vec3::Y * 1.2)).unwrap();
    let turn = tautline::Quat::from_rotation_y(0.5);
    let upper = Cloth::grid(18, 22, 1.2, 1.4).position(Vec3::new(0.05, 1.5, 0.0)).rotation(turn);
    let upper = world.add(upper).unwrap();
    run(&mut world, 3.0);
    for (a, b) in [(lower, upper), (upper, lower)] {
        assert_eq!(pierced(&world, a, b), 0);
    }
    assert!(center(&world, upper).y > center(&world, lower).y + 0.01, "the upper one is on top");
    for cloth in [lower, upper] {
        assert!(center(&world, cloth).y > 0.4, "it has slid off the box");
        assert!(stretch(&world, cloth) < 0.05, "{}", stretch(&world, cloth));
    }
}
