//! Small fast bodies against a thin wall.

use std::sync::Arc;

use tautline::mesh::TriMesh;
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

/// What is shot at, 2 m × 2 m.
#[derive(Clone, Copy)]
enum Wall {
    /// Of this half thickness, in m, and mass, in kg, or fixed.
    Board(f32, Option<f32>),
    /// Two fixed triangles.
    Mesh,
}

/// Half of its width and height, in m.
const HALF: f32 = 1.0;
const WALLS: [Wall; 6] = [
    Wall::Board(0.005, None),
    Wall::Board(0.005, Some(10.0)),
    Wall::Board(0.005, Some(1.0)),
    Wall::Board(0.0005, None),
    Wall::Board(0.0005, Some(10.0)),
    Wall::Mesh,
];
const PHASES: u32 = 40;

pub(super) fn cases() -> Vec<Case> {
    let trial = |(bullet, wall): (Bullet, Wall)| {
        Trial::one(move |conditions| {
            let mut passed = 0;
            for phase in 0..PHASES {
                let phase = phase as f32 / PHASES as f32;
                passed += u32::from(passes(conditions, bullet, wall, phase)?);
            }
            let name = format!("{}, {} m/s, {}", bullet.name, bullet.speed, wall.name());
            Ok(Part::at_most(name, f64::from(passed), 0.0, ""))
        })
    };
    let variants = bullets().into_iter().flat_map(|bullet| WALLS.map(|wall| (bullet, wall)));
    vec![Case {
        id: 22,
        group: "Tunnelling",
        name: "bullets at a thin wall",
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
        Bullet {
            name: "plate of 20 × 20 × 0.1 cm that spins",
            shape: || Shape::cuboid(Vec3::new(0.0005, 0.1, 0.1)),
            spin: Vec3::new(10.0, 30.0, -20.0),
            ..straight
        },
        Bullet {
            name: "plate of 20 × 20 × 0.1 cm that spins",
            shape: || Shape::cuboid(Vec3::new(0.0005, 0.1, 0.1)),
            speed: 1000.0,
            spin: Vec3::new(-40.0, 10.0, 60.0),
            rotation: askew,
        },
        Bullet {
            name: "rod of 50 × 2 cm that spins",
            shape: || Shape::capsule(0.01, 0.24),
            speed: 1000.0,
            spin: Vec3::new(50.0, 100.0, 60.0),
            ..straight
        },
    ]
}

impl Wall {
    fn name(self) -> String {
        match self {
            Self::Board(half, mass) => {
                let weight = mass.map_or("fixed".to_owned(), |mass| format!("{mass} kg"));
                format!("{} mm, {weight}", 2000.0 * half)
            }
            Self::Mesh => "mesh".to_owned(),
        }
    }

    fn body(self) -> Result<RigidBody, Error> {
        let board = |half: f32| cuboid(Vec3::new(half, HALF, HALF));
        Ok(match self {
            Self::Board(half, Some(mass)) => RigidBody::new(&board(half)?).mass(mass),
            Self::Board(half, None) => RigidBody::new(&board(half)?).fixed(),
            Self::Mesh => {
                let positions = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
                let positions = positions.map(|[y, z]| Vec3::new(0.0, y, z) * HALF).to_vec();
                let mesh = TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] };
                RigidBody::new(&Arc::new(Shape::triangle_mesh(&mesh)?)).fixed()
            }
        })
    }
}

/// Whether the bullet's centre goes through the wall's middle plane, within its outline: by where it is in the wall's
/// frame after each step, since a light wall that is hit turns over, and behind is in front then.
fn passes(conditions: &Conditions, bullet: Bullet, wall: Wall, phase: f32) -> Result<bool, Error> {
    let mut world = conditions.weightless()?;
    let wall = world.add(wall.body()?)?;
    let shape = Arc::new((bullet.shape)()?);
    let start = Vec3::new(-1.5 - phase * bullet.speed * DT, 0.013, -0.021);
    let body = RigidBody::new(&shape).mass(0.1).position(start).rotation(bullet.rotation);
    let body = world.add(body.velocity(Vec3::X * bullet.speed).angular_velocity(bullet.spin))?;
    let mut before = place_in(&world, wall, body)?;
    for _ in 0..30 {
        world.step(DT)?;
        let now = place_in(&world, wall, body)?;
        let crossing = before + (now - before) * (before.x / (before.x - now.x));
        if before.x < 0.0 && now.x >= 0.0 && (is_within(crossing) || is_within(now)) {
            return Ok(true);
        }
        before = now;
    }
    Ok(false)
}

fn is_within(place: DVec3) -> bool {
    place.y.abs().max(place.z.abs()) < f64::from(HALF)
}

/// Where the centre of a body is in the frame of the wall.
fn place_in(world: &World, wall: BodyHandle, body: BodyHandle) -> Result<DVec3, Error> {
    let (position, rotation) = pose(world, wall)?;
    let offset = center(world, body)? - position;
    Ok(DVec3::AXES.map(|axis| turned(rotation, axis).dot(offset)).into())
}
