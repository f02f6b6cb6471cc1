//! A cloth under crockery.

use super::hold::on_body;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, BodyRef, Camera, Cloth, Color, Cue, HalfSpace, Motion, PartOfCompound, Rigid, Rotation,
    Scene, Shape, Surface,
};

pub(super) const TABLECLOTH: NamedScene = NamedScene {
    name: "tablecloth",
    description: "The cloth is pulled away from under the crockery; most of it stays on the table.",
    parameters: &[
        Parameter::count(
            "speed",
            "how fast the cloth is pulled, in m/s; slowly, it takes all along",
            6,
            (1, 20),
        ),
        Parameter::count("n", "particles along the shorter side of the cloth", 38, (10, 100)),
    ],
    document: tablecloth,
};

/// Of the table's top, in m.
const TOP: [f32; 3] = [1.6, 0.04, 0.9];
const HEIGHT: f32 = 0.74;
/// Of the cloth, in m.
const LONG: f32 = 1.72;
const SHORT: f32 = 0.84;
const THICKNESS: f32 = 0.012;
/// Where its held edge is: beyond the table's. The others are on the table.
const EDGE: f32 = 0.94;
/// When the cloth is pulled, in s.
const PULLED: f32 = 1.0;
const BAR: f32 = 0.012;

fn tablecloth(p: &Parameters) -> Scene {
    let rows = p.count("n");
    let columns = (LONG / SHORT * (rows - 1) as f32) as u32 + 1;
    let level = HEIGHT + THICKNESS;
    let cloth = Cloth {
        name: Some("cloth".to_owned()),
        surface: Surface::Grid { columns, rows, width: LONG, depth: SHORT },
        position: [EDGE - LONG / 2.0, level, 0.0],
        mass: 0.3,
        friction: 0.01,
        thickness: Some(THICKNESS),
        color: Some(Color([176, 44, 52])),
        ..Cloth::default()
    };
    let bar = Rigid {
        name: Some("bar".to_owned()),
        shape: Shape::Capsule { radius: BAR, height: SHORT, segments: None, rings: None },
        position: [EDGE + BAR + THICKNESS, level, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.0, 0.0], degrees: 90.0 }),
        motion: Some(Motion::Kinematic),
        ..Rigid::default()
    };
    let held = |row: u32| {
        let z = SHORT * (row as f32 / (rows - 1) as f32 - 0.5);
        on_body("cloth", (row + 1) * columns - 1, "bar", [EDGE, level, z])
    };
    let mut bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rigid(table()),
        Body::Cloth(cloth),
        Body::Rigid(bar),
    ];
    bodies.extend(crockery().into_iter().map(Body::Rigid));
    let speed = p.count("speed") as f32;
    let pull = Cue {
        at: PULLED,
        body: BodyRef::Name("bar".to_owned()),
        velocity: [speed, 0.0, 0.0],
        angular_velocity: [0.0; 3],
    };
    Scene {
        seconds: 3.0,
        record_every: 2,
        bodies,
        attachments: (0..rows).map(held).collect(),
        cues: vec![pull],
        camera: Some(Camera { eye: [1.2, 1.8, 2.8], target: [0.3, 0.6, 0.0], fov: 38.0 }),
        ..Scene::default()
    }
}

fn table() -> Rigid {
    let part = |size: [f32; 3], position: [f32; 3]| PartOfCompound {
        shape: Shape::Box { size },
        position,
        ..PartOfCompound::default()
    };
    let leg_height = HEIGHT - TOP[1];
    let mut parts = vec![part(TOP, [0.0, HEIGHT - TOP[1] / 2.0, 0.0])];
    for [x, z] in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
        let [x, z] = [x * (TOP[0] / 2.0 - 0.06), z * (TOP[2] / 2.0 - 0.06)];
        parts.push(part([0.06, leg_height, 0.06], [x, leg_height / 2.0, z]));
    }
    Rigid {
        shape: Shape::Compound { parts },
        fixed: true,
        friction: 0.4,
        color: Some(Color([150, 104, 66])),
        ..Rigid::default()
    }
}

/// Four places with a plate, a cup on it and a glass; a bottle and a dish in the middle.
fn crockery() -> Vec<Rigid> {
    const PLATE: [f32; 3] = [0.22, 0.02, 0.22];
    const CUP: [f32; 2] = [0.04, 0.07];
    const GLASS: [f32; 2] = [0.045, 0.12];
    const WHITE: Color = Color([236, 236, 230]);
    let floor = HEIGHT + 2.0 * THICKNESS;
    let piece = |shape: Shape, place: [f32; 3], mass: f32, color: Color| Rigid {
        shape,
        position: place,
        mass: Some(mass),
        friction: 0.4,
        color: Some(color),
        ..Rigid::default()
    };
    let round = |[radius, height]: [f32; 2]| Shape::Cylinder { radius, height, segments: Some(12) };
    let mut pieces = Vec::new();
    for [x, z] in [[-0.5, -0.25], [0.3, -0.25], [-0.5, 0.25], [0.3, 0.25]] {
        let on_plate = floor + PLATE[1] + CUP[1] / 2.0;
        pieces.push(piece(Shape::Box { size: PLATE }, [x, floor + PLATE[1] / 2.0, z], 0.5, WHITE));
        pieces.push(piece(round(CUP), [x, on_plate, z], 0.25, Color([70, 116, 176])));
        let beside = [x + 0.2, floor + GLASS[1] / 2.0, 0.8 * z];
        pieces.push(piece(round(GLASS), beside, 0.2, Color([168, 208, 214])));
    }
    let dish = Shape::Box { size: [0.3, 0.06, 0.16] };
    pieces.push(piece(dish, [-0.2, floor + 0.03, 0.0], 0.9, Color([222, 176, 74])));
    let bottle = vec![part_of_bottle(0.05, 0.18, 0.0), part_of_bottle(0.018, 0.08, 0.13)];
    pieces.push(Rigid {
        shape: Shape::Compound { parts: bottle },
        position: [0.06, floor + 0.09, 0.0],
        mass: Some(1.0),
        friction: 0.4,
        color: Some(Color([44, 96, 62])),
        ..Rigid::default()
    });
    pieces
}

fn part_of_bottle(radius: f32, height: f32, y: f32) -> PartOfCompound {
    let shape = Shape::Cylinder { radius, height, segments: Some(12) };
    PartOfCompound { shape, position: [0.0, y, 0.0], ..PartOfCompound::default() }
}
