//! Rigid bodies that are thrown.

use tautline::Vec3;

use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, Camera, Color, Rigid, Room, Rotation, Scene, Shape};
use crate::random::Random;

pub(super) const ICOSAHEDRA: NamedScene = NamedScene {
    name: "icosahedra",
    description: "Icosahedra of 36 sticks are thrown into a cubical room (paper, figure 8a).",
    parameters: &[
        Parameter::count("n", "how many icosahedra; the room grows with them", 50, (1, 5000)),
        Parameter::SEED,
    ],
    document: icosahedra,
};

/// Distance of an icosahedron's vertices from its middle, in m.
const RADIUS: f32 = 0.5;

fn icosahedra(p: &Parameters) -> Scene {
    let n = p.count("n") as usize;
    let layers = (1..).find(|k: &usize| k.pow(3) >= n).unwrap_or(1);
    // 1.4 m of the room's side for each body along it, and never less than they need beside each other.
    let side = (1.4 * libm::cbrtf(n as f32)).max(2.1 * RADIUS * layers as f32);
    let cell = side / layers as f32;
    let mut random = Random::new(p.seed());
    let (min, max) = ([-side / 2.0, 0.0, -side / 2.0], [side / 2.0, side, side / 2.0]);
    let room = Room { min, max, color: Some(Color([210, 212, 218])), ..Room::default() };
    let mut bodies = vec![Body::Room(room)];
    for i in random.choose(n, layers.pow(3)) {
        let at = [i % layers, i / layers.pow(2), i / layers % layers].map(|k| (k as f32 + 0.5) * cell);
        let jitter = random.in_cube((cell / 2.0 - 1.01 * RADIUS).max(0.0));
        bodies.push(Body::Rigid(Rigid {
            shape: Shape::Icosahedron { radius: RADIUS },
            position: (Vec3::from(at) + jitter - Vec3::new(side, 0.0, side) / 2.0).to_array(),
            rotation: Rotation::Quaternion(random.rotation().to_array()),
            velocity: random.vector(5.0).to_array(),
            angular_velocity: random.vector(5.0).to_array(),
            mass: Some(1.0),
            ..Rigid::default()
        }));
    }
    let target = Vec3::new(0.0, 0.4 * side, 0.0);
    let eye = target + Vec3::new(0.7, 0.8, 1.9) * side;
    Scene { seconds: 6.0, record_every: 2, bodies, camera: Some(camera(eye, target)), ..Scene::default() }
}

pub(super) fn camera(eye: Vec3, target: Vec3) -> Camera {
    Camera { eye: eye.to_array(), target: target.to_array(), ..Camera::default() }
}
