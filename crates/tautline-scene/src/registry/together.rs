//! Scenes in which rigid bodies, cloth and rope meet.

use tautline::Vec3;

use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    Body, Camera, Cloth, HalfSpace, Pin, Rigid, Rope, Rotation, Scene, Shape, SheetPlace, Surface, Thread,
};
use crate::random::Random;

pub(super) const HAMMOCK: NamedScene = NamedScene {
    name: "hammock",
    description: "Icosahedra and a rope fall into a cloth held by its corners, and all move each other.",
    parameters: &[Parameter::count("n", "how many icosahedra", 8, (1, 12)), Parameter::SEED],
    document: hammock,
};

/// Of the cloth, in m.
const SIDE: f32 = 2.6;

fn hammock(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let cloth = Cloth {
        surface: Surface::Grid { columns: 28, rows: 28, width: SIDE, depth: SIDE },
        position: [0.0, 1.3, 0.0],
        sag: Some(0.5),
        mass: 1.0,
        thickness: Some(0.06),
        pins: vec![Pin::Place(SheetPlace::Corners)],
        ..Cloth::default()
    };
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth)];
    bodies.extend((0..p.count("n")).map(|i| Body::Rigid(ball(i, &mut random))));
    bodies.push(Body::Rope(Rope {
        path: Thread::Line { from: [-1.7, 2.6, -0.2], to: [1.7, 2.6, 0.2], segments: 60 },
        mass: 0.3,
        radius: 0.03,
        self_collision: true,
        bending: Some(2.0),
        ..Rope::default()
    }));
    let camera = Camera { eye: [3.4, 2.9, 4.6], target: [0.0, 1.0, 0.0], fov: 34.0 };
    Scene { seconds: 4.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

/// Four to a layer.
fn ball(i: u32, random: &mut Random) -> Rigid {
    const RADIUS: f32 = 0.26;
    let cell = [i & 1, i / 4, i >> 1 & 1].map(|k| k as f32);
    let corner = Vec3::from(cell) * (2.4 * RADIUS) + random.in_cube(0.1 * RADIUS);
    Rigid {
        shape: Shape::Icosahedron { radius: RADIUS },
        position: (corner + Vec3::new(-1.2 * RADIUS, 1.6, -1.2 * RADIUS)).to_array(),
        rotation: Rotation::Quaternion(random.rotation().to_array()),
        angular_velocity: random.vector(3.0).to_array(),
        mass: Some(0.1),
        ..Rigid::default()
    }
}
