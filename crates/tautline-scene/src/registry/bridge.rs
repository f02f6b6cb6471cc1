//! A bridge of planks on two ropes.

use tautline::Vec3;

use super::hold::on_body;
use super::rope::hanging;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Camera, Color, HalfSpace, Pin, Rigid, Rope, RopeEnd, Rotation, Scene, Shape, Thread,
};

pub(super) const BRIDGE: NamedScene = NamedScene {
    name: "bridge",
    description: "A heavy ball rolls onto a bridge of planks that are tied to two ropes, and crates fall on it.",
    parameters: &[
        Parameter::count("planks", "how many planks", 24, (4, 48)),
        Parameter::count("load", "mass of the ball, in kg", 40, (1, 200)),
    ],
    document: bridge,
};

/// Between its ends, and of each rope, in m.
const SPAN: f32 = 5.0;
const LENGTH: f32 = 5.12;
const HEIGHT: f32 = 1.7;
/// Of planks across the bridge, and of their thickness, in m.
const ACROSS: f32 = 1.0;
const THICKNESS: f32 = 0.04;
const ROPE: f32 = 0.02;
const WOOD: Color = Color([170, 122, 78]);
const SIDES: [(&str, f32); 2] = [("back rope", -1.0), ("front rope", 1.0)];

fn bridge(p: &Parameters) -> Scene {
    let planks = p.count("planks");
    // Four segments to a plank, two of which are tied to it.
    let path = hanging(f64::from(SPAN), f64::from(LENGTH), f64::from(HEIGHT), 4 * planks);
    let across = ACROSS / 2.0 + 1.5 * ROPE;
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    bodies.extend([-1.0, 1.0].map(|side| Body::Rigid(bank(side))));
    bodies.extend(SIDES.map(|(name, side)| Body::Rope(rope(name, side * across, &path))));
    let mut attachments = Vec::new();
    for k in 0..planks {
        let name = format!("plank {k}");
        let tied = [4 * k + 1, 4 * k + 3];
        let [from, to] = tied.map(|i| Vec3::from(path[i as usize]));
        bodies.push(Body::Rigid(plank(&name, from, to)));
        for ((rope, side), i) in SIDES.into_iter().flat_map(|side| tied.map(|i| (side, i))) {
            let [x, y, _] = path[i as usize];
            attachments.push(on_body(rope, i, &name, [x, y, side * across]));
        }
    }
    bodies.extend(loads(p.count("load") as f32).into_iter().map(Body::Rigid));
    let camera = Some(Camera { eye: [1.6, 3.1, 7.0], target: [-0.05, 1.3, 0.0], fov: 42.0 });
    Scene { seconds: 6.0, record_every: 2, bodies, attachments, camera, ..Scene::default() }
}

fn rope(name: &str, z: f32, path: &[[f32; 3]]) -> Rope {
    Rope {
        name: Some(name.to_owned()),
        path: Thread::Points(path.iter().map(|&[x, y, _]| [x, y, z]).collect()),
        radius: ROPE,
        mass: 3.0,
        pins: vec![Pin::Place(RopeEnd::First), Pin::Place(RopeEnd::Last)],
        color: Some(Color([206, 186, 142])),
        ..Rope::default()
    }
}

/// A plank that is tied at two points along each rope, at `from` and `to`.
fn plank(name: &str, from: Vec3, to: Vec3) -> Rigid {
    let along = to - from;
    Rigid {
        name: Some(name.to_owned()),
        shape: Shape::Box { size: [1.6 * along.length(), THICKNESS, ACROSS] },
        position: ((from + to) / 2.0).to_array(),
        rotation: Rotation::AxisAngle(AxisAngle {
            axis: [0.0, 0.0, 1.0],
            degrees: libm::atan2f(along.y, along.x).to_degrees(),
        }),
        density: Some(600.0),
        color: Some(WOOD),
        ..Rigid::default()
    }
}

/// What the ropes end at.
fn bank(side: f32) -> Rigid {
    let height = HEIGHT + THICKNESS / 2.0;
    Rigid {
        shape: Shape::Box { size: [1.4, height, 1.6] },
        position: [side * (SPAN / 2.0 + 0.72), height / 2.0, 0.0],
        fixed: true,
        color: Some(Color([146, 150, 142])),
        ..Rigid::default()
    }
}

fn loads(mass: f32) -> Vec<Rigid> {
    const BALL: f32 = 0.28;
    let ball = Rigid {
        shape: Shape::Sphere { radius: BALL },
        position: [-SPAN / 2.0 - 0.7, HEIGHT + THICKNESS / 2.0 + BALL, 0.0],
        velocity: [1.6, 0.0, 0.0],
        angular_velocity: [0.0, 0.0, -1.6 / BALL],
        mass: Some(mass),
        color: Some(Color([84, 90, 104])),
        ..Rigid::default()
    };
    let crate_at = |x: f32, y: f32, degrees: f32| Rigid {
        shape: Shape::Box { size: [0.4; 3] },
        position: [x, y, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 1.0, 0.0], degrees }),
        mass: Some(8.0),
        color: Some(Color([214, 150, 70])),
        ..Rigid::default()
    };
    vec![ball, crate_at(0.5, 5.0, 20.0), crate_at(1.1, 8.0, 50.0)]
}
