//! Balls of cloth with gas in them.

use tautline::mesh::primitives::icosphere;

use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, Camera, Cloth, Color, HalfSpace, MeshSource, Rigid, Scene, Shape, Surface};

pub(super) const BALLOON: NamedScene = NamedScene {
    name: "balloon",
    description: "Inflated balls bounce, and carry a board with weights on it.",
    parameters: &[
        Parameter::count("fineness", "how often the triangles of each ball are divided", 3, (1, 4)),
        Parameter::count(
            "pressure",
            "of the gas in them over that of the air around, in Pa",
            1500,
            (50, 20_000),
        ),
    ],
    document: balloon,
};

const RADIUS: f32 = 0.35;
const COLORS: [Color; 4] =
    [Color([214, 84, 66]), Color([62, 122, 170]), Color([226, 172, 60]), Color([96, 152, 96])];

fn balloon(p: &Parameters) -> Scene {
    let ball = |(i, place): (usize, [f32; 3])| {
        Body::Cloth(Cloth {
            surface: Surface::Mesh(sphere(p.count("fineness"))),
            position: place,
            mass: 0.25,
            pressure: Some(p.count("pressure") as f32),
            color: Some(COLORS[i]),
            ..Cloth::default()
        })
    };
    let out = 0.55;
    let [low, high] = [RADIUS + 0.05, RADIUS + 0.9];
    let places = [[-out, low, -0.3], [out, low, -0.3], [0.0, low, 0.6], [0.1, high + 1.7, 0.1]];
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    bodies.extend(places.into_iter().enumerate().map(ball));
    let weight = |shape: Shape, position: [f32; 3], mass: f32, color: [u8; 3]| {
        let color = Some(Color(color));
        Body::Rigid(Rigid { shape, position, mass: Some(mass), color, ..Rigid::default() })
    };
    bodies.push(weight(Shape::Box { size: [2.0, 0.06, 1.7] }, [0.0, high, 0.1], 3.0, [176, 142, 102]));
    bodies.push(weight(Shape::Box { size: [0.25; 3] }, [-0.45, high + 0.5, 0.0], 2.0, [112, 118, 128]));
    bodies.push(weight(Shape::Icosahedron { radius: 0.18 }, [0.5, high + 0.7, 0.2], 2.0, [134, 110, 150]));
    let camera = Some(Camera { eye: [1.9, 2.1, 4.4], target: [0.0, 0.75, 0.1], fov: 38.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, camera, ..Scene::default() }
}

/// A ball's surface; none for a fineness there is not.
fn sphere(fineness: u32) -> MeshSource {
    let mesh = icosphere(RADIUS, fineness).unwrap_or_default();
    MeshSource {
        positions: mesh.positions.iter().map(|at| at.to_array()).collect(),
        triangles: mesh.triangles,
    }
}
