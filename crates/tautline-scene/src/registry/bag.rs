//! A bag of marbles.

use tautline::Vec3;

use super::hold::on_body;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    Body, BodyRef, Camera, Cloth, Color, Cue, HalfSpace, Motion, Rigid, Scene, Shape, Surface,
};
use crate::random::Random;

pub(super) const MARBLES: NamedScene = NamedScene {
    name: "marbles",
    description: "Marbles fall on a cloth, whose rim is gathered to a bag, lifted and carried aside.",
    parameters: &[
        Parameter::count("n", "how many marbles", 60, (1, 150)),
        Parameter::count("hooks", "hooks along each side of the cloth", 3, (2, 6)),
        Parameter::count("cells", "cells of cloth from one hook to the next", 13, (2, 30)),
        Parameter::SEED,
    ],
    document: marbles,
};

/// Half the side of the cloth, and its height, in m.
const REACH: f32 = 0.7;
const HEIGHT: f32 = 0.9;
const HOOK: f32 = 0.015;
const MARBLE: f32 = 0.05;
/// When the rim begins to be gathered, how long that takes, and how long it is carried, in s.
const BEGIN: f32 = 0.9;
const GATHERED: f32 = 1.6;
const CARRIED: f32 = 1.2;
/// How far the hooks are from the middle then, and how much higher, in m.
const NECK: f32 = 0.24;
const LIFT: f32 = 0.5;
/// How it is carried, in m/s.
const CARRY: Vec3 = Vec3::new(0.6, 0.0, 0.0);

fn marbles(p: &Parameters) -> Scene {
    let (hooks, cells) = (p.count("hooks"), p.count("cells"));
    let side = hooks * cells + 1;
    let cloth = Cloth {
        name: Some("cloth".to_owned()),
        surface: Surface::Grid { columns: side, rows: side, width: 2.0 * REACH, depth: 2.0 * REACH },
        position: [0.0, HEIGHT, 0.0],
        mass: 0.5,
        color: Some(Color([128, 72, 112])),
        ..Cloth::default()
    };
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth)];
    let (mut attachments, mut cues) = (Vec::new(), Vec::new());
    let is_rim = |&(i, j): &(u32, u32)| [i, j].iter().any(|&k| k == 0 || k == hooks);
    for (i, j) in (0..=hooks).flat_map(|i| (0..=hooks).map(move |j| (i, j))).filter(is_rim) {
        let [x, z] = [i, j].map(|k| REACH * (2.0 * k as f32 / hooks as f32 - 1.0));
        let (name, rim) = (format!("hook {i} {j}"), Vec3::new(x, HEIGHT, z));
        bodies.push(Body::Rigid(hook(&name, rim)));
        attachments.push(on_body("cloth", j * cells * side + i * cells, &name, rim.to_array()));
        cues.extend(way(&name, rim));
    }
    let mut random = Random::new(p.seed());
    bodies.extend((0..p.count("n")).map(|i| Body::Rigid(marble(i, &mut random))));
    let camera = Some(Camera { eye: [1.5, 1.9, 2.7], target: [0.3, 0.85, 0.0], fov: 38.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, attachments, cues, camera, ..Scene::default() }
}

/// On the rim, outside of it.
fn hook(name: &str, rim: Vec3) -> Rigid {
    let out = Vec3::new(rim.x, 0.0, rim.z).normalize_or_zero();
    Rigid {
        name: Some(name.to_owned()),
        shape: Shape::Sphere { radius: HOOK },
        position: (rim + out * (3.0 * HOOK)).to_array(),
        motion: Some(Motion::Kinematic),
        color: Some(Color([90, 94, 100])),
        ..Rigid::default()
    }
}

/// How a hook is led: to the neck, then aside.
fn way(name: &str, rim: Vec3) -> [Cue; 3] {
    let out = Vec3::new(rim.x, 0.0, rim.z).normalize_or_zero();
    let neck = Vec3::Y * (HEIGHT + LIFT) + out * NECK;
    let gathering = (neck - rim) / GATHERED;
    let (gathered, carried) = (BEGIN + GATHERED, BEGIN + GATHERED + CARRIED);
    [(BEGIN, gathering), (gathered, CARRY), (carried, Vec3::ZERO)].map(|(at, velocity)| Cue {
        at,
        body: BodyRef::Name(name.to_owned()),
        velocity: velocity.to_array(),
        angular_velocity: [0.0; 3],
    })
}

/// In layers of 16 above the cloth.
fn marble(i: u32, random: &mut Random) -> Rigid {
    let cell = Vec3::new((i % 4) as f32 - 1.5, (i / 16) as f32, (i / 4 % 4) as f32 - 1.5);
    let place = cell * (2.4 * MARBLE) + Vec3::Y * (HEIGHT + 0.15) + random.in_cube(0.1 * MARBLE);
    Rigid {
        shape: Shape::Sphere { radius: MARBLE },
        position: place.to_array(),
        mass: Some(0.2),
        ..Rigid::default()
    }
}
