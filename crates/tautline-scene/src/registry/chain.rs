//! Rigid bodies in a row.

use tautline::Vec3;

use super::rigid::camera;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, BodyRef, Color, Groups, HalfSpace, Joint, JointKind, Rigid, Rotation, Scene, Shape,
};

pub(super) const CHAIN: NamedScene = NamedScene {
    name: "chain",
    description: "A heavy ball on a chain of light links is let go level, and swings into a wall.",
    parameters: &[
        Parameter::count("links", "how many links the chain has", 24, (1, 200)),
        Parameter::count("ratio", "mass of the ball over that of a link", 200, (1, 1000)),
    ],
    document: chain,
};

/// Of the chain, in m.
const LENGTH: f32 = 4.0;
/// Of the ball, in m and kg.
const RADIUS: f32 = 0.4;
const MASS: f32 = 500.0;
/// Where the chain hangs.
const TOP: Vec3 = Vec3::new(0.0, 5.4, 0.0);
const IRON: Color = Color([86, 92, 104]);

fn chain(p: &Parameters) -> Scene {
    let links = p.count("links");
    let pitch = LENGTH / links as f32;
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    bodies.extend((0..BRICKS[0] * BRICKS[1]).map(brick));
    let first = bodies.len() as u32;
    let along = |way: f32| (TOP + Vec3::NEG_X * way).to_array();
    for i in 0..links {
        bodies.push(Body::Rigid(Rigid {
            shape: Shape::Capsule { radius: pitch / 4.0, height: pitch / 2.0, segments: None, rings: None },
            position: along((i as f32 + 0.5) * pitch),
            rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 0.0, 1.0], degrees: 90.0 }),
            mass: Some(MASS / p.count("ratio") as f32),
            color: Some(IRON),
            // Links meet all but each other.
            groups: Some(Groups { memberships: Some(vec![1]), filter: Some(vec![0]) }),
            ..Rigid::default()
        }));
    }
    bodies.push(Body::Rigid(Rigid {
        shape: Shape::Sphere { radius: RADIUS },
        position: along(LENGTH + RADIUS),
        mass: Some(MASS),
        color: Some(IRON),
        ..Rigid::default()
    }));
    // The first link is held by the world, every other one by the one before it.
    let joint = |i: u32| {
        let base = i.checked_sub(1).map(|before| BodyRef::Index(first + before));
        let joint = Joint::new(BodyRef::Index(first + i), base, JointKind::default());
        Joint { anchor: Some(along(i as f32 * pitch)), ..joint }
    };
    let joints = (0..=links).map(joint).collect();
    let camera = camera(Vec3::new(3.4, 3.4, 10.5), Vec3::new(-0.2, 2.6, 0.0));
    Scene { seconds: 6.0, record_every: 2, bodies, joints, camera: Some(camera), ..Scene::default() }
}

/// How many bricks the wall has beside and on each other.
const BRICKS: [u32; 2] = [5, 6];
/// Of a brick, in m.
const BRICK: Vec3 = Vec3::new(0.3, 0.3, 0.6);

/// The brick of a number, in rows that are shifted by half a brick.
fn brick(i: u32) -> Body {
    let (row, column) = (i / BRICKS[0], i % BRICKS[0]);
    let across = column as f32 - (BRICKS[0] - 1) as f32 / 2.0 + if row % 2 == 0 { 0.25 } else { -0.25 };
    let place = Vec3::new(0.7, (row as f32 + 0.5) * BRICK.y, across * BRICK.z);
    Body::Rigid(Rigid {
        shape: Shape::Box { size: BRICK.to_array() },
        position: place.to_array(),
        density: Some(400.0),
        color: Some(Color([188, 96, 72])),
        ..Rigid::default()
    })
}
