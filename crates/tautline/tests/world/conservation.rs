//! What a closed system keeps: momentum, nearly angular momentum, and energy that it may only lose.

use tautline::{Cloth, DVec3, Rope, Settings, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron, weightless};

/// Trusses, a cloth and two ropes that fly into each other.
fn cloud(friction: f32, settings: Settings) -> World {
    let mut world = World::new(settings).unwrap();
    let shapes = [cube(0.5), icosahedron(0.35)];
    for k in 0..12 {
        let turn = k as f32 * 0.9;
        let position = Vec3::new(turn.cos(), 0.4 * (k as f32 - 6.0), turn.sin()) * 1.1;
        let body = TrussBody::new(&shapes[k % 2]).position(position).velocity(position * -1.5);
        let spin = Vec3::new(1.0, -2.0, 0.5 * k as f32);
        world.add(body.angular_velocity(spin).mass(0.5 + k as f32 * 0.3).friction(friction)).unwrap();
    }
    let cloth = Cloth::grid(10, 10, 1.2, 1.2).velocity(Vec3::Y * -2.0).mass(0.8).friction(friction);
    world.add(cloth.position(Vec3::Y * 3.2).bending(0.05)).unwrap();
    for side in [-1.0f32, 1.0] {
        let (start, end) = (Vec3::new(-1.0, side * 3.6, 0.1), Vec3::new(1.0, side * 3.6, -0.1));
        let rope = Rope::straight(start, end, 16).velocity(Vec3::Y * (-2.5 * side)).self_collision(true);
        world.add(rope.mass(0.4).friction(friction)).unwrap();
    }
    world
}

/// Σ m |v|: what a change of momentum is to be measured against.
fn momentum_scale(world: &World) -> f64 {
    let speed = |handle| {
        let view = world.body(handle).unwrap();
        f64::from(view.mass() * view.velocity().length())
    };
    world.bodies().map(speed).sum()
}

#[derive(Debug, Default)]
struct Drift {
    momentum: f64,
    angular: f64,
    /// Greatest energy over the first.
    growth: f64,
    contacts: usize,
}

fn drift(mut world: World, steps: usize) -> Drift {
    // Before its first step a body's displacements are velocities: both sums are right from the start.
    let (momentum, angular, energy) = (world.momentum(), world.angular_momentum(), world.kinetic_energy());
    let scale = momentum_scale(&world);
    let mut drift = Drift::default();
    for _ in 0..steps {
        drift.contacts += world.step(DT).unwrap().contacts;
        drift.momentum = drift.momentum.max((world.momentum() - momentum).length() / scale);
        drift.angular = drift.angular.max((world.angular_momentum() - angular).length() / scale);
        drift.growth = drift.growth.max(world.kinetic_energy() / energy);
    }
    drift
}

/// Every internal constraint moves its particles by opposite impulses. Angular momentum (in units of the scale,
/// per metre of arm) is not exact: a projection acts along where a stick is, not where it was (so spin is
/// lost, dω/dt = −ω³h), and friction acts at two points a depth apart.
#[test]
fn a_closed_cloud_keeps_its_momentum_and_gains_no_energy() {
    let paper = Settings { gravity: Vec3::ZERO, sleep: None, ..Settings::paper() };
    for (name, settings, angular) in [("default", weightless(), 0.1), ("paper", paper, 0.2)] {
        let drift = drift(cloud(0.5, settings), 180);
        println!("{name}: {drift:?}");
        assert!(drift.contacts > 500, "they hardly met: {} contacts", drift.contacts);
        assert!(drift.momentum < 1e-5, "{name}: {drift:?}");
        assert!(drift.angular < angular, "{name}: {drift:?}");
        assert!(drift.growth < 1.05, "{name}: {drift:?}");
    }
}

/// Spin dies out as dω/dt = −ω³h for particles on rigid sticks, so that ω⁻² grows by 2h per second.
#[test]
fn a_free_body_loses_spin_as_projection_predicts() {
    for substeps in [1, 4, 16] {
        let mut world = World::new(Settings { substeps, ..weightless() }).unwrap();
        let spin = 4.0f64;
        world.add(TrussBody::new(&icosahedron(0.5)).angular_velocity(Vec3::Y * spin as f32)).unwrap();
        let before = world.angular_momentum().y;
        for _ in 0..60 {
            world.step(DT).unwrap();
        }
        let h = f64::from(DT) / f64::from(substeps);
        let expected = 1.0 / (1.0 + 2.0 * h * spin * spin * world.time()).sqrt();
        let kept = world.angular_momentum().y / before;
        println!("{substeps} substeps keep {kept}, expected {expected}");
        assert!((kept - expected).abs() < 0.1 * (1.0 - expected) + 1e-3, "{kept}, expected {expected}");
    }
}

/// A frictionless separation moves p_A and p_B along the line between them: it conserves angular momentum, too,
/// but for what the positions themselves move (x × d with x after the motion), second order in the depth.
#[test]
fn a_separation_keeps_angular_momentum() {
    let mut settings = weightless();
    settings.relaxation.tolerance = 0.5;
    settings.relaxation.sweeps = 1;
    settings.substeps = 1;
    for friction in [0.0, 0.5] {
        let mut world = World::new(settings.clone()).unwrap();
        let spin = Vec3::new(0.3, 0.2, 1.0);
        let lower = TrussBody::new(&cube(1.0)).velocity(Vec3::new(1.0, 0.5, 0.0));
        world.add(lower.friction(friction)).unwrap();
        let upper = TrussBody::new(&icosahedron(0.5)).position(Vec3::new(0.2, 0.92, 0.1));
        world.add(upper.angular_velocity(spin).friction(friction)).unwrap();
        let before: DVec3 = world.angular_momentum();
        let report = world.step(DT).unwrap();
        let change = (world.angular_momentum() - before).length();
        println!("friction {friction}: {change} of {before} in {} contacts", report.contacts);
        assert!(report.contacts > 0);
        assert!(change < 0.05, "friction {friction}: angular momentum changed by {change} of {before}");
    }
}
