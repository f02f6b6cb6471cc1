//! An icosahedron falls on the floor and comes to rest on a face.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{Error, HalfSpace, Settings, Truss, TrussBody, Vec3, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add(HalfSpace::floor(0.0))?;
    let shape = Arc::new(Truss::from_mesh(&primitives::icosahedron(0.5)?)?);
    let spin = Vec3::new(3.0, 0.0, 1.0);
    let body = world.add(TrussBody::new(&shape).position(Vec3::Y * 2.0).angular_velocity(spin))?;

    for step in 0..=240 {
        if step % 40 == 0 {
            println!("{:.2} s: {:.3} m above the floor", world.time(), world.body(body)?.center_of_mass().y);
        }
        world.step(1.0 / 60.0)?;
    }
    // From its centre to a face: 0.7947 of its radius.
    let height = world.body(body)?.center_of_mass().y;
    assert!((height - 0.7947 * 0.5).abs() < 0.01, "it rests at {height} m");
    Ok(())
}
