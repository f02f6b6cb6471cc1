//! A flag.

use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Camera, Cloth, Color, HalfSpace, Pin, Rigid, Rotation, Scene, Settings, Shape, Surface,
};

pub(super) const FLAG: NamedScene = NamedScene {
    name: "flag",
    description: "A flag unfurls in the wind.",
    parameters: &[
        Parameter::count("n", "particles along its height", 25, (4, 120)),
        Parameter::count("wind", "in m/s", 7, (0, 30)),
    ],
    document: flag,
};

const WIDTH: f32 = 1.5;
const HEIGHT: f32 = 1.0;
/// Of the flag's upper edge, in m.
const TOP: f32 = 2.9;
const POLE: f32 = 0.035;

fn flag(p: &Parameters) -> Scene {
    let rows = p.count("n");
    let columns = (WIDTH / HEIGHT * (rows - 1) as f32) as u32 + 1;
    let cell = HEIGHT / (rows - 1) as f32;
    // Beside the pole, and no nearer to it than cloth is kept from what is solid.
    let gap = POLE + 0.6 * cell;
    let cloth = Cloth {
        surface: Surface::Grid { columns, rows, width: WIDTH, depth: HEIGHT },
        position: [gap + WIDTH / 2.0, TOP - HEIGHT / 2.0, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.0, 0.0], degrees: 90.0 }),
        mass: 0.18,
        pins: (0..rows).map(|row| Pin::Index(row * columns)).collect(),
        bending_stiffness: Some(2e-5),
        drag: Some(1.2),
        lift: Some(0.8),
        color: Some(Color([196, 70, 58])),
        ..Cloth::default()
    };
    let post = |radius: f32, height: f32, y: f32| Rigid {
        shape: Shape::Cylinder { radius, height, segments: None },
        position: [0.0, y, 0.0],
        fixed: true,
        color: Some(Color([206, 200, 188])),
        ..Rigid::default()
    };
    let bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rigid(post(POLE, TOP + 0.1, 0.5 * (TOP + 0.1))),
        Body::Rigid(post(0.22, 0.08, 0.04)),
        Body::Cloth(cloth),
    ];
    let speed = p.count("wind") as f32;
    // Askew, or the flag would stay in the plane that it begins in.
    let settings = Settings { wind: Some([speed, 0.0, 0.15 * speed]), ..Settings::default() };
    let camera = Some(Camera { eye: [0.9, 2.2, 4.4], target: [0.75, 1.9, 0.0], fov: 38.0 });
    Scene { seconds: 5.0, record_every: 2, settings, bodies, camera, ..Scene::default() }
}
