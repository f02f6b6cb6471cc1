//! A cloth falls over a cube, drapes, and stretches little.

use std::sync::Arc;

use tautline::{Cloth, Error, HalfSpace, RigidBody, Settings, Shape, Vec3, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add(HalfSpace::floor(0.0))?;
    let cube = Arc::new(Shape::cuboid(Vec3::splat(0.5))?);
    world.add(RigidBody::new(&cube).position(Vec3::Y * 0.5).fixed())?;
    let cloth = world.add(Cloth::grid(20, 20, 2.0, 2.0).position(Vec3::Y * 1.2))?;

    for second in 1..=4 {
        for _ in 0..60 {
            world.step(1.0 / 60.0)?;
        }
        let (lowest, highest) = heights(world.body(cloth)?.positions());
        let strain = world.strain();
        println!(
            "{second} s: from {lowest:.2} to {highest:.2} m high, stretched {:.1} % on average, {:.1} % at most",
            100.0 * strain.mean,
            100.0 * strain.max
        );
    }

    let positions = world.body(cloth)?.positions();
    let inside = |p: &&Vec3| p.x.abs() < 0.5 && p.z.abs() < 0.5 && p.y < 1.0;
    assert_eq!(positions.iter().filter(inside).count(), 0, "no particle is inside the cube");
    let (lowest, highest) = heights(positions);
    assert!(lowest < 0.6 && highest > 1.0, "it hangs down the sides and lies on top");
    assert!(world.strain().mean < 0.001 && world.strain().max < 0.02);
    Ok(())
}

fn heights(positions: &[Vec3]) -> (f32, f32) {
    positions.iter().fold((f32::MAX, f32::MIN), |(low, high), p| (low.min(p.y), high.max(p.y)))
}
