//! Curtains on a rail.

use super::hold::on_body;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, BodyRef, Camera, Cloth, Color, Cue, HalfSpace, Motion, Rigid, Rotation, Scene, Shape,
    Surface,
};

pub(super) const CURTAINS: NamedScene = NamedScene {
    name: "curtains",
    description: "A ball is thrown through two curtains, which then are drawn aside on their rail.",
    parameters: &[
        Parameter::count("gliders", "gliders on the rail that hold each curtain", 7, (2, 12)),
        Parameter::count("cells", "cells of cloth from one glider to the next", 6, (1, 12)),
    ],
    document: curtains,
};

/// Of each curtain, in m.
const WIDTH: f32 = 1.2;
const DEPTH: f32 = 1.9;
/// The height of its upper edge, in m.
const TOP: f32 = 2.0;
const GLIDER: f32 = 0.02;
/// What is left of its width when it is drawn.
const DRAWN: f32 = 0.4;
/// When the curtains begin to be drawn, and how long that takes, in s.
const BEGIN: f32 = 1.6;
const DURATION: f32 = 1.5;

fn curtains(p: &Parameters) -> Scene {
    let (gliders, cells) = (p.count("gliders"), p.count("cells"));
    let columns = (gliders - 1) * cells + 1;
    let rows = (DEPTH / WIDTH * (columns - 1) as f32) as u32 + 2;
    let clearance = 0.6 * WIDTH / (columns - 1) as f32;
    let rail = Rigid {
        shape: Shape::Box { size: [2.2 * WIDTH, 0.03, 0.05] },
        position: [0.0, TOP + clearance + 2.0 * GLIDER + 0.015, 0.0],
        fixed: true,
        color: Some(Color([120, 92, 66])),
        ..Rigid::default()
    };
    let ball = Rigid {
        shape: Shape::Sphere { radius: 0.18 },
        position: [0.04, 0.75, -1.6],
        velocity: [0.0, 3.0, 4.5],
        mass: Some(1.5),
        restitution: Some(0.5),
        rolling_friction: Some(0.01),
        color: Some(Color([228, 142, 46])),
        ..Rigid::default()
    };
    let floor = HalfSpace { rolling_friction: Some(0.01), ..HalfSpace::default() };
    let mut bodies = vec![Body::HalfSpace(floor), Body::Rigid(rail), Body::Rigid(ball)];
    let (mut attachments, mut cues) = (Vec::new(), Vec::new());
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        bodies.push(Body::Cloth(curtain(name, side, [columns, rows])));
        for i in 0..gliders {
            // From the outer edge, which stays, to the inner one.
            let share = i as f32 / (gliders - 1) as f32;
            let x = side * (0.01 + WIDTH * (1.0 - share));
            let glider = format!("{name} {i}");
            let column = if side < 0.0 { i * cells } else { columns - 1 - i * cells };
            bodies.push(Body::Rigid(glider_at(&glider, [x, TOP + clearance + GLIDER, 0.0])));
            attachments.push(on_body(name, column, &glider, [x, TOP, 0.0]));
            let speed = side * share * (WIDTH - DRAWN) / DURATION;
            cues.extend(
                [(BEGIN, speed), (BEGIN + DURATION, 0.0)].map(|(at, speed)| lead(&glider, at, speed)),
            );
        }
    }
    let camera = Some(Camera { eye: [1.1, 1.6, 4.6], target: [0.0, 1.0, 0.0], fov: 34.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, attachments, cues, camera, ..Scene::default() }
}

/// A curtain that hangs beside the middle, on the side of `side`.
fn curtain(name: &str, side: f32, [columns, rows]: [u32; 2]) -> Cloth {
    Cloth {
        name: Some(name.to_owned()),
        surface: Surface::Grid { columns, rows, width: WIDTH, depth: DEPTH },
        position: [side * (0.01 + WIDTH / 2.0), TOP - DEPTH / 2.0, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.0, 0.0], degrees: 90.0 }),
        mass: 0.8,
        color: Some(if side < 0.0 { Color([62, 104, 138]) } else { Color([74, 122, 156]) }),
        ..Cloth::default()
    }
}

fn glider_at(name: &str, position: [f32; 3]) -> Rigid {
    Rigid {
        name: Some(name.to_owned()),
        shape: Shape::Sphere { radius: GLIDER },
        position,
        motion: Some(Motion::Kinematic),
        color: Some(Color([206, 182, 130])),
        ..Rigid::default()
    }
}

fn lead(glider: &str, at: f32, speed: f32) -> Cue {
    let body = BodyRef::Name(glider.to_owned());
    Cue { at, body, velocity: [speed, 0.0, 0.0], angular_velocity: [0.0; 3] }
}
