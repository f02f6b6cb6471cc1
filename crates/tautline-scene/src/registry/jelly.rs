//! A scene with soft solids.

use super::{NamedScene, Parameter, Parameters};
use crate::document::{AxisAngle, Body, Camera, HalfSpace, Rigid, Rotation, Scene, Shape, SoftSolid};

pub(super) const JELLY: NamedScene = NamedScene {
    name: "jelly",
    description: "A jelly cube and a soft torus fall on a post, and balls into them.",
    parameters: &[
        Parameter::count("cells", "cells along each edge of the cube", 6, (1, 20)),
        Parameter::count("segments", "sections of the torus", 24, (6, 96)),
    ],
    document: jelly,
};

fn jelly(p: &Parameters) -> Scene {
    let post = Rigid {
        shape: Shape::Cylinder { radius: 0.12, height: 1.0, segments: None },
        position: [-0.7, 0.5, 0.0],
        fixed: true,
        ..Rigid::default()
    };
    let torus = SoftSolid {
        shape: Shape::Torus {
            radius: 0.42,
            tube_radius: 0.16,
            segments: p.count("segments"),
            tube_segments: 10,
        },
        position: [-0.6, 1.6, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 0.0, 1.0], degrees: 12.0 }),
        young_modulus: 3e4,
        ..SoftSolid::default()
    };
    let cube = SoftSolid {
        shape: Shape::Box { size: [0.6; 3] },
        cells: Some([p.count("cells"); 3]),
        position: [0.6, 1.3, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.3, 0.0], degrees: 35.0 }),
        young_modulus: 3e4,
        ..SoftSolid::default()
    };
    let ball = |x: f32, y: f32| Rigid {
        shape: Shape::Sphere { radius: 0.14 },
        position: [x, y, 0.05],
        mass: Some(4.0),
        ..Rigid::default()
    };
    let bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rigid(post),
        Body::SoftSolid(torus),
        Body::SoftSolid(cube),
        Body::Rigid(ball(0.65, 2.6)),
        Body::Rigid(ball(-0.2, 3.0)),
    ];
    let camera = Camera { eye: [0.9, 2.0, 4.4], target: [0.0, 0.6, 0.0], fov: 38.0 };
    Scene { seconds: 4.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}
