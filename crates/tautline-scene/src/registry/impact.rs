//! Rigid bodies that fly or fall.

use tautline::Vec3;

use super::rigid::camera;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Bounds, Color, HalfSpace, PartOfCompound, Rigid, Rotation, Scene, Shape,
};
use crate::random::Random;

pub(super) const BULLETS: NamedScene = NamedScene {
    name: "bullets",
    description: "Balls, cubes, spinning rods and plates are shot at a thin wall; none gets through.",
    parameters: &[
        Parameter::count("n", "how many", 40, (1, 400)),
        Parameter::count("speed", "how fast they are, in m/s", 100, (1, 300)),
        Parameter::SEED,
    ],
    document: bullets,
};

/// Of the wall, in m: so large that what bounces off it does not come round it.
const WALL: [f32; 3] = [0.02, 60.0, 120.0];

fn bullets(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let wall = Rigid {
        shape: Shape::Box { size: WALL },
        position: [0.0, WALL[1] / 2.0, 0.0],
        fixed: true,
        ..Rigid::default()
    };
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Rigid(wall)];
    let shapes = [
        Shape::Sphere { radius: 0.05 },
        Shape::Box { size: [0.1; 3] },
        Shape::Capsule { radius: 0.02, height: 0.4, segments: None, rings: None },
        Shape::Box { size: [0.3, 0.02, 0.2] },
    ];
    let columns = 10;
    let n = p.count("n");
    for i in 0..n {
        // A volley of ten at a time, each a tenth of a second after the one before.
        let (column, volley) = (i % columns, i / columns);
        let place = Vec3::new(0.0, 1.0 + random.between(0.0, 1.6), (column as f32 - 4.5) * 0.5);
        let speed = p.count("speed") as f32;
        let distance = speed * (0.1 * volley as f32 + random.between(0.02, 0.05)) + 1.0;
        bodies.push(Body::Rigid(Rigid {
            shape: shapes[i as usize % shapes.len()].clone(),
            position: (place - Vec3::X * distance).to_array(),
            rotation: Rotation::Quaternion(random.rotation().to_array()),
            velocity: [speed, 0.0, 0.0],
            angular_velocity: random.vector(40.0).to_array(),
            density: Some(2000.0),
            restitution: Some(0.3),
            ..Rigid::default()
        }));
    }
    let bounds = Bounds { min: [-1e4, 0.0, -1e4], max: [0.0, 1e3, 1e4] };
    let camera = camera(Vec3::new(-8.0, 3.5, 7.5), Vec3::new(-0.5, 1.3, 0.0));
    Scene { seconds: 3.0, bodies, bounds: Some(bounds), camera: Some(camera), ..Scene::default() }
}

pub(super) const MIXED_PILE: NamedScene = NamedScene {
    name: "mixed-pile",
    description: "Balls, capsules, boxes, cylinders, hulls and crosses are poured into a bowl.",
    parameters: &[
        Parameter::count("n", "how many bodies; the bowl grows with them", 240, (1, 4000)),
        Parameter::SEED,
    ],
    document: mixed_pile,
};

fn mixed_pile(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let n = p.count("n");
    let layer = 6.0 + libm::ceilf(libm::sqrtf(n as f32 / 8.0));
    let reach = 0.55 * layer + 2.0;
    let mut bodies = vec![Body::Rigid(bowl(reach))];
    let across = layer as u32 - 5;
    for i in 0..n {
        let cell = Vec3::new((i % across) as f32, (i / across.pow(2)) as f32, (i / across % across) as f32);
        let middle = Vec3::new((across - 1) as f32 / 2.0, 0.0, (across - 1) as f32 / 2.0);
        let place = (cell - middle) * 0.9 + Vec3::Y * (0.6 * reach + 0.5) + random.in_cube(0.1);
        bodies.push(Body::Rigid(Rigid {
            shape: some_shape(&mut random),
            position: place.to_array(),
            rotation: Rotation::Quaternion(random.rotation().to_array()),
            ..Rigid::default()
        }));
    }
    let camera = camera(Vec3::new(0.8, 2.1, 2.8) * reach, Vec3::Y * (0.3 * reach));
    // What falls through the bowl or over its rim is below it.
    let bounds = Bounds { min: [-1e4, 0.0, -1e4], max: [1e4; 3] };
    let (bounds, camera) = (Some(bounds), Some(camera));
    Scene { seconds: 8.0, record_every: 2, bodies, bounds, camera, ..Scene::default() }
}

/// A paraboloid of heights up to a level rim; `reach` in m.
fn bowl(reach: f32) -> Rigid {
    const COUNT: u32 = 41;
    let cell_size = 2.0 * reach / (COUNT - 1) as f32;
    let squared = |i: u32| {
        let along = (i as f32 - (COUNT - 1) as f32 / 2.0) * cell_size;
        along * along
    };
    let height = |i: u32| {
        let share = (squared(i % COUNT) + squared(i / COUNT)) / (reach * reach);
        0.6 * reach * share.min(1.0)
    };
    Rigid {
        shape: Shape::HeightField {
            columns: COUNT,
            rows: COUNT,
            cell_size,
            heights: (0..COUNT * COUNT).map(height).collect(),
        },
        fixed: true,
        color: Some(Color([198, 180, 156])),
        ..Rigid::default()
    }
}

/// Of about 0.6 m.
fn some_shape(random: &mut Random) -> Shape {
    let size = random.between(0.8, 1.2);
    match random.below(6) {
        0 => Shape::Sphere { radius: 0.3 * size },
        1 => Shape::Capsule { radius: 0.16 * size, height: 0.4 * size, segments: None, rings: None },
        2 => Shape::Box { size: [0.6 * size, 0.4 * size, 0.3 * size] },
        3 => Shape::Cylinder { radius: 0.22 * size, height: 0.4 * size, segments: None },
        4 => Shape::Dodecahedron { radius: 0.32 * size },
        _ => cross(0.7 * size),
    }
}

/// Two bars through each other; `length` in m.
fn cross(length: f32) -> Shape {
    let bar = |degrees: f32| PartOfCompound {
        shape: Shape::Box { size: [length, length / 4.0, length / 4.0] },
        rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 1.0, 0.0], degrees }),
        ..PartOfCompound::default()
    };
    Shape::Compound { parts: vec![bar(0.0), bar(90.0)] }
}
