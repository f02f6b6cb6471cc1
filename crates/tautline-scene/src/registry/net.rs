//! A net that catches what falls.

use tautline::Vec3;

use super::frame::square_frame;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, Camera, Color, HalfSpace, Pin, Rigid, Rope, Rotation, Scene, Shape, Thread};
use crate::random::Random;

pub(super) const NET: NamedScene = NamedScene {
    name: "net",
    description: "Icosahedra fall into a net, which catches them all.",
    parameters: &[
        Parameter::count("n", "how many icosahedra", 50, (1, 100)),
        Parameter::count("meshes", "meshes along each side of the net", 16, (12, 32)),
        Parameter::SEED,
    ],
    document: net,
};

/// Half the side of the net, and how high it is held, in m.
const REACH: f32 = 1.5;
const HEIGHT: f32 = 1.8;
/// How deep it hangs before anything falls into it, in m.
const SAG: f32 = 0.7;
/// Of the frame it is held by.
const POLE: f32 = 0.04;
const RADIUS: f32 = 0.16;

fn net(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    let frame = square_frame(REACH + POLE + 0.02, HEIGHT, POLE, Color([96, 104, 116]));
    bodies.extend(frame.into_iter().map(Body::Rigid));
    bodies.push(Body::Rope(knotted(p.count("meshes"))));
    bodies.extend((0..p.count("n")).map(|i| Body::Rigid(falling(i, &mut random))));
    let camera = Some(Camera { eye: [3.0, 2.2, 5.2], target: [0.0, 1.35, 0.0], fov: 36.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, camera, ..Scene::default() }
}

/// The net, with a particle where its strings cross, and one between: pinned along its border.
fn knotted(meshes: u32) -> Rope {
    let last = 2 * meshes;
    let is_there = |i: u32, j: u32| i.is_multiple_of(2) || j.is_multiple_of(2);
    let mut numbers = vec![None; ((last + 1) * (last + 1)) as usize];
    let at = |i: u32, j: u32| (i * (last + 1) + j) as usize;
    let (mut points, mut pins, mut segments) = (Vec::new(), Vec::new(), Vec::new());
    for (i, j) in (0..=last).flat_map(|i| (0..=last).map(move |j| (i, j))).filter(|&(i, j)| is_there(i, j)) {
        let number = points.len() as u32;
        let [u, v] = [i, j].map(|k| 2.0 * k as f32 / last as f32 - 1.0);
        points.push([REACH * u, HEIGHT - SAG * (1.0 - u * u) * (1.0 - v * v), REACH * v]);
        let is_border = [i, j].iter().any(|&k| k == 0 || k == last);
        pins.extend(is_border.then_some(Pin::Index(number)));
        let before = [i.checked_sub(1).map(|i| (i, j)), j.checked_sub(1).map(|j| (i, j))];
        for (i, j) in before.into_iter().flatten() {
            segments.extend(numbers[at(i, j)].map(|other: u32| [other, number]));
        }
        numbers[at(i, j)] = Some(number);
    }
    Rope {
        path: Thread::Network { points, segments },
        radius: 0.012,
        mass: 4.0,
        pins,
        color: Some(Color([214, 196, 150])),
        ..Rope::default()
    }
}

/// In layers of 25 above the net.
fn falling(i: u32, random: &mut Random) -> Rigid {
    let cell = Vec3::new((i % 5) as f32 - 2.0, (i / 25) as f32, (i / 5 % 5) as f32 - 2.0);
    let place = cell * (2.5 * RADIUS) + Vec3::Y * (HEIGHT + 0.3) + random.in_cube(0.2 * RADIUS);
    Rigid {
        shape: Shape::Icosahedron { radius: RADIUS },
        position: place.to_array(),
        rotation: Rotation::Quaternion(random.rotation().to_array()),
        angular_velocity: random.vector(3.0).to_array(),
        mass: Some(1.0),
        ..Rigid::default()
    }
}
