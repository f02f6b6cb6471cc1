//! The engine as a whole, seen from outside: closed forms, conservation, determinism, and hostile callers.

mod calls;
mod conservation;
mod determinism;
mod edits;
mod faults;
mod motion;
mod paper;
mod refusals;
mod rope;
mod sleep;
mod snapshot;

use std::sync::Arc;

use tautline::mesh::{TriMesh, primitives};
use tautline::{Cloth, HalfSpace, Rope, Settings, Truss, TrussBody, Vec3, World};

/// 1/60 s, the usual step.
const DT: f32 = 1.0 / 60.0;

fn truss(mesh: TriMesh) -> Arc<Truss> {
    Arc::new(Truss::from_mesh(&mesh).unwrap())
}

fn cube(side: f32) -> Arc<Truss> {
    truss(primitives::cube(side).unwrap())
}

fn icosahedron(radius: f32) -> Arc<Truss> {
    truss(primitives::icosahedron(radius).unwrap())
}

/// The default solver without gravity and without sleep.
fn weightless() -> Settings {
    Settings { gravity: Vec3::ZERO, sleep: None, ..Settings::default() }
}

fn run(world: &mut World, steps: usize) {
    for _ in 0..steps {
        world.step(DT).unwrap();
    }
}

/// A floor, a tower of cubes, icosahedra that fall on it, a cloth hung by two corners, and a rope over the tower.
fn mixed_scene(settings: Settings) -> World {
    let mut world = World::new(settings).unwrap();
    world.add(HalfSpace::floor(0.0)).unwrap();
    let (cube, ball) = (cube(0.5), icosahedron(0.3));
    for level in 0..3 {
        world.add(TrussBody::new(&cube).position(Vec3::Y * (0.25 + 0.5 * level as f32))).unwrap();
    }
    for k in 0..4 {
        let position = Vec3::new(0.7 * (k as f32 - 1.5), 2.0 + 0.4 * k as f32, 0.1);
        let spin = Vec3::new(1.0, 2.0, -k as f32);
        world.add(TrussBody::new(&ball).position(position).angular_velocity(spin).mass(0.5)).unwrap();
    }
    let cloth = Cloth::grid(8, 8, 1.5, 1.5).position(Vec3::new(0.0, 1.9, 0.0)).bending(0.1);
    world.add(cloth.pin(0).pin(7)).unwrap();
    let (start, end) = (Vec3::new(-1.0, 1.7, 0.05), Vec3::new(1.0, 1.7, 0.05));
    world.add(Rope::straight(start, end, 20).pin(0).mass(0.2)).unwrap();
    world
}
