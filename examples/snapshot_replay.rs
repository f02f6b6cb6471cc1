//! A world written to bytes and restored goes on exactly as the original does: the same bits, the same hash.

use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::{Error, HalfSpace, Settings, Truss, TrussBody, Vec3, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add(HalfSpace::floor(0.0))?;
    let shape = Arc::new(Truss::from_mesh(&primitives::dodecahedron(0.4)?)?);
    for i in 0..8 {
        let position = Vec3::new(0.1 * i as f32, 1.0 + i as f32, 0.05 * (i * i) as f32);
        world.add(TrussBody::new(&shape).position(position))?;
    }
    run(&mut world, 60)?;

    let bytes = world.snapshot();
    let mut replay = World::restore(&bytes)?;
    println!(
        "snapshot of {} bodies after {:.1} s: {} bytes",
        world.bodies().len(),
        world.time(),
        bytes.len()
    );

    run(&mut world, 120)?;
    run(&mut replay, 120)?;
    println!("original {:016x}\nreplay   {:016x}", world.state_hash(), replay.state_hash());
    assert_eq!(world.state_hash(), replay.state_hash());
    Ok(())
}

fn run(world: &mut World, steps: u32) -> Result<(), Error> {
    for _ in 0..steps {
        world.step(1.0 / 60.0)?;
    }
    Ok(())
}
