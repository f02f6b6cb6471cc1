//! Joints, seen from outside: closed forms, conservation, and hostile callers.

mod kinds;
mod pendulum;
mod refusals;
mod together;

use std::sync::Arc;

use tautline::{BodyHandle, RigidBody, Settings, Shape, Vec3, World};

/// 1/60 s, the usual step.
const DT: f32 = 1.0 / 60.0;

fn cuboid(x: f32, y: f32, z: f32) -> Arc<Shape> {
    Arc::new(Shape::cuboid(Vec3::new(x, y, z)).unwrap())
}

fn sleepless() -> Settings {
    Settings { sleep: None, ..Settings::default() }
}

fn weightless() -> Settings {
    Settings { gravity: Vec3::ZERO, ..sleepless() }
}

fn run(world: &mut World, steps: usize) {
    for _ in 0..steps {
        let report = world.step(DT).unwrap();
        assert!(report.faults.is_empty());
    }
}

fn center(world: &World, body: BodyHandle) -> Vec3 {
    world.body(body).unwrap().center_of_mass()
}

fn add(world: &mut World, half: Vec3, position: Vec3, mass: f32) -> BodyHandle {
    let body = RigidBody::new(&cuboid(half.x, half.y, half.z)).position(position).mass(mass);
    world.add(body).unwrap()
}
