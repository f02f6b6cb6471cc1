//! A trampoline.

use super::frame::square_frame;
use super::hold::in_world;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Camera, Cloth, Color, HalfSpace, Rigid, Rotation, Scene, Shape, Surface,
};

pub(super) const TRAMPOLINE: NamedScene = NamedScene {
    name: "trampoline",
    description: "A ball and a dodecahedron bounce on a cloth that springs hold all around.",
    parameters: &[
        Parameter::count("n", "particles along each side of the cloth", 32, (8, 100)),
        Parameter::count(
            "stiffness",
            "of the springs on each metre of the rim, in N/m",
            8000,
            (1000, 100_000),
        ),
    ],
    document: trampoline,
};

/// Half the side of the cloth, and its height, in m.
const REACH: f32 = 1.2;
const HEIGHT: f32 = 0.8;
const POLE: f32 = 0.05;
const STEEL: Color = Color([70, 78, 92]);

fn trampoline(p: &Parameters) -> Scene {
    let side = p.count("n");
    let cell = 2.0 * REACH / (side - 1) as f32;
    let cloth = Cloth {
        name: Some("cloth".to_owned()),
        surface: Surface::Grid { columns: side, rows: side, width: 2.0 * REACH, depth: 2.0 * REACH },
        position: [0.0, HEIGHT, 0.0],
        mass: 2.0,
        color: Some(Color([46, 92, 150])),
        ..Cloth::default()
    };
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth)];
    let frame = square_frame(REACH + POLE + 0.08, HEIGHT, POLE, STEEL);
    bodies.extend(frame.into_iter().map(Body::Rigid));
    bodies.extend(jumpers().map(Body::Rigid));
    let compliance = 1.0 / (p.count("stiffness") as f32 * cell);
    let last = side - 1;
    let rim = |&(row, column): &(u32, u32)| [row, column].iter().any(|&k| k == 0 || k == last);
    let spring = |(row, column): (u32, u32)| {
        let [x, z] = [column, row].map(|k| k as f32 * cell - REACH);
        in_world("cloth", row * side + column, [x, HEIGHT, z], compliance)
    };
    let particles = (0..side).flat_map(|row| (0..side).map(move |column| (row, column)));
    let attachments = particles.filter(rim).map(spring).collect();
    let camera = Some(Camera { eye: [2.6, 2.5, 4.6], target: [0.0, 1.1, 0.0], fov: 38.0 });
    Scene { seconds: 5.0, record_every: 2, bodies, attachments, camera, ..Scene::default() }
}

fn jumpers() -> [Rigid; 2] {
    let jumper = |shape: Shape, position: [f32; 3], mass: f32, color: Color| Rigid {
        shape,
        position,
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.4, 0.2], degrees: 20.0 }),
        mass: Some(mass),
        color: Some(color),
        ..Rigid::default()
    };
    [
        jumper(Shape::Sphere { radius: 0.24 }, [-0.35, 1.9, 0.1], 12.0, Color([222, 120, 48])),
        jumper(Shape::Dodecahedron { radius: 0.22 }, [0.45, 2.3, -0.15], 8.0, Color([112, 158, 82])),
    ]
}
