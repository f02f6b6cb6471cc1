//! Rigid bodies of four particles: how they move, touch, bounce and rest.

mod bounce;
mod control;
mod events;
mod faults;
mod flight;
mod forces;
mod friction;
mod measures;
mod motion;
mod picking;
mod queries;
mod refusals;
mod sleep;
mod stacks;
mod surfaces;
mod thrown;
mod tunnel;

use std::sync::Arc;

use tautline::{BodyHandle, HalfSpace, RigidBody, Settings, Shape, Vec3, World};

const DT: f32 = 1.0 / 60.0;

/// Default settings, without sleep.
fn awake() -> Settings {
    Settings { sleep: None, ..Settings::default() }
}

fn weightless() -> Settings {
    Settings { gravity: Vec3::ZERO, ..awake() }
}

fn cube(side: f32) -> Arc<Shape> {
    Arc::new(Shape::cuboid(Vec3::splat(side / 2.0)).unwrap())
}

fn run(world: &mut World, seconds: f32) {
    for _ in 0..(seconds / DT).round() as usize {
        let report = world.step(DT).unwrap();
        assert!(report.faults.is_empty(), "{:?}", report.faults);
    }
}

fn floor(world: &mut World) -> BodyHandle {
    world.add(HalfSpace::floor(0.0)).unwrap()
}

fn center(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().center_of_mass()
}

fn add(world: &mut World, body: RigidBody) -> BodyHandle {
    world.add(body).unwrap()
}
