//! A ball is thrown at three boxes that stand on each other.

use std::sync::Arc;

use tautline::{Error, HalfSpace, RigidBody, Settings, Shape, Vec3, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add(HalfSpace::floor(0.0))?;
    let cube = Arc::new(Shape::cuboid(Vec3::splat(0.5))?); // half its edges, in m
    let ball = Arc::new(Shape::sphere(0.3)?);
    let mut bodies = Vec::new();
    for k in 0..3 {
        bodies.push(world.add(RigidBody::new(&cube).position(Vec3::Y * (0.5 + k as f32)).mass(2.0))?);
    }
    let thrown = RigidBody::new(&ball).mass(2.0).position(Vec3::new(-4.0, 2.5, 0.0)).velocity(Vec3::X * 8.0);
    bodies.push(world.add(thrown)?);

    println!("      x and y in m of\n   s │ lowest box │ middle box │ top box    │ ball");
    for step in 0..=180 {
        if step % 30 == 0 {
            let places = bodies.iter().map(|&body| Ok(world.body(body)?.center_of_mass()));
            let row = places.map(|place| place.map(|Vec3 { x, y, .. }| format!("{x:5.2} {y:4.2}")));
            println!("{:4.1} │ {}", world.time(), row.collect::<Result<Vec<_>, Error>>()?.join(" │ "));
        }
        world.step(1.0 / 60.0)?;
    }
    let lowest = world.body(bodies[0])?.center_of_mass();
    assert!((lowest.y - 0.5).abs() < 0.01, "the lowest box stays on the floor, not at {lowest} m");
    Ok(())
}
