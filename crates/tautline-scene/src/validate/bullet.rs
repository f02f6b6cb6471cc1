//! Small fast bodies against a thin wall.

use std::sync::Arc;

use tautline::{BodyHandle, DVec3, Error, Quat, RigidBody, Shape, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, center, cuboid, pose, turned};

/// What is shot, along X.
#[derive(Clone, Copy)]
struct Bullet {
    name: &'static str,
    shape: fn() -> Result<Shape, Error>,
    /// In m/s.
    speed: f32,
    /// In rad/s.
    spin: Vec3,
    rotation: Quat,
}

/// Half of 2 m × 2 m × 1 cm.
const WALL: Vec3 = Vec3::new(0.005, 1.0, 1.0);
const PHASES: u32 = 40;

pub(super) fn cases() -> Vec<Case> {
    let trial = |(bullet, wall_mass): (Bullet, Option<f32>)| {
        Trial::one(move |conditions| {
            let mut passed = 0;
            for phase in 0..PHASES {
                let phase = phase as f32 / PHASES as f32;
                passed += u32::from(passes(conditions, bullet, wall_mass, phase)?);
            }
            let wall = wall_mass.map_or("fixed wall".to_owned(), |mass| format!("wall of {mass} kg"));
            let name = format!("{}, {} m/s, {wall}", bullet.name, bullet.speed);
            Ok(Part::at_most(name, f64::from(passed), 0.0, ""))
        })
    };
    let walls = [None, Some(10.0), Some(1.0)];
    let variants = bullets().into_iter().flat_map(|bullet| walls.map(|wall| (bullet, wall)));
    vec![Case {
        id: 22,
        group: "Tunnelling",
        name: "bullets at a wall of 1 cm",
        formula: "0 of 40 get through",
        note: "Started from 40 places that divide the way of one step evenly; bullets of 0.1 kg.",
        trials: variants.map(trial).collect(),
    }]
}

fn bullets() -> Vec<Bullet> {
    let straight = Bullet {
        name: "cube of 10 cm",
        shape: || Shape::cuboid(Vec3::splat(0.05)),
        speed: 100.0,
        spin: Vec3::ZERO,
        rotation: Quat::IDENTITY,
    };
    let askew = Quat::from_xyzw(0.3, -0.5, 0.2, 0.7);
    let tiny: fn() -> Result<Shape, Error> = || Shape::cuboid(Vec3::splat(0.01));
    vec![
        straight,
        Bullet {
            name: "cube of 10 cm askew",
            rotation: askew,
            spin: Vec3::new(20.0, -30.0, 10.0),
            ..straight
        },
        Bullet { name: "ball of 10 cm", shape: || Shape::sphere(0.05), ..straight },
        Bullet { name: "cube of 2 cm", shape: tiny, ..straight },
        Bullet { name: "cube of 2 cm askew", shape: tiny, rotation: askew, ..straight },
        Bullet { name: "ball of 2 cm", shape: || Shape::sphere(0.01), ..straight },
        Bullet { name: "ball of 2 cm", shape: || Shape::sphere(0.01), speed: 300.0, ..straight },
        Bullet {
            name: "rod of 50 × 2 cm that spins",
            shape: || Shape::capsule(0.01, 0.24),
            spin: Vec3::new(5.0, 10.0, 60.0),
            ..straight
        },
        Bullet {
            name: "stick of 50 × 1 × 1 cm that spins",
            shape: || Shape::cuboid(Vec3::new(0.25, 0.005, 0.005)),
            spin: Vec3::new(0.0, 40.0, 80.0),
            ..straight
        },
        Bullet {
            name: "plate of 40 × 40 × 1 cm that spins",
            shape: || Shape::cuboid(Vec3::new(0.005, 0.2, 0.2)),
            speed: 50.0,
            spin: Vec3::new(10.0, 30.0, -20.0),
            ..straight
        },
    ]
}

/// Whether the bullet's centre is seen behind the wall's middle plane, within its outline.
fn passes(
    conditions: &Conditions,
    bullet: Bullet,
    wall_mass: Option<f32>,
    phase: f32,
) -> Result<bool, Error> {
    let mut world = conditions.weightless()?;
    let wall = RigidBody::new(&cuboid(WALL)?);
    let wall = world.add(match wall_mass {
        Some(mass) => wall.mass(mass),
        None => wall.fixed(),
    })?;
    let shape = Arc::new((bullet.shape)()?);
    let start = Vec3::new(-1.5 - phase * bullet.speed * DT, 0.013, -0.021);
    let body = RigidBody::new(&shape).mass(0.1).position(start).rotation(bullet.rotation);
    let body = world.add(body.velocity(Vec3::X * bullet.speed).angular_velocity(bullet.spin))?;
    for _ in 0..30 {
        world.step(DT)?;
        if is_behind(&world, wall, body)? {
            return Ok(true);
        }
    }
    Ok(false)
}

fn is_behind(world: &World, wall: BodyHandle, body: BodyHandle) -> Result<bool, Error> {
    let (position, rotation) = pose(world, wall)?;
    let offset = center(world, body)? - position;
    let along = |axis: DVec3| turned(rotation, axis).dot(offset);
    let (y, z) = (along(DVec3::Y).abs(), along(DVec3::Z).abs());
    Ok(along(DVec3::X) > 0.0 && y < f64::from(WALL.y) && z < f64::from(WALL.z))
}
