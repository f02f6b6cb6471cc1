//! Cloth that tears.

use super::frame::square_frame;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Camera, Cloth, Color, HalfSpace, Pin, Rigid, Rotation, Scene, Shape, Surface,
};

pub(super) const TEAR: NamedScene = NamedScene {
    name: "tear",
    description: "A weight falls on a cloth in a frame, and tears through it.",
    parameters: &[
        Parameter::count("n", "particles along each side of the cloth", 41, (8, 100)),
        Parameter::count("mass", "of the weight, in kg", 25, (1, 1000)),
    ],
    document: tear,
};

/// Half the side of the cloth, and its height, in m.
const REACH: f32 = 1.0;
const HEIGHT: f32 = 1.1;
const POLE: f32 = 0.04;

fn tear(p: &Parameters) -> Scene {
    let side = p.count("n");
    let last = side - 1;
    let rim = (0..side * side).filter(|k| [k / side, k % side].iter().any(|&k| k == 0 || k == last));
    let cloth = Cloth {
        surface: Surface::Grid { columns: side, rows: side, width: 2.0 * REACH, depth: 2.0 * REACH },
        position: [0.0, HEIGHT, 0.0],
        mass: 0.6,
        pins: rim.map(Pin::Index).collect(),
        compliance: Some(2e-4),
        tear_at: Some(0.12),
        color: Some(Color([206, 196, 172])),
        ..Cloth::default()
    };
    let weight = Rigid {
        shape: Shape::Box { size: [0.36; 3] },
        position: [0.1, HEIGHT + 1.1, -0.08],
        // On a corner.
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.1, -1.0], degrees: 50.0 }),
        mass: Some(p.count("mass") as f32),
        color: Some(Color([88, 96, 110])),
        ..Rigid::default()
    };
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth), Body::Rigid(weight)];
    // Beyond the cloth, so that it does not lie on the poles.
    let cell = 2.0 * REACH / last as f32;
    let frame = square_frame(REACH + POLE + cell, HEIGHT, POLE, Color([120, 92, 66]));
    bodies.extend(frame.into_iter().map(Body::Rigid));
    let camera = Some(Camera { eye: [1.9, 2.3, 3.9], target: [0.0, 0.85, 0.0], fov: 38.0 });
    Scene { seconds: 4.0, record_every: 2, bodies, camera, ..Scene::default() }
}
