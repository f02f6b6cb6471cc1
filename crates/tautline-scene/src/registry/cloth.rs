//! Scenes with cloth.

use super::rope::hanging;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    AxisAngle, Body, Cloth, HalfSpace, Pin, Rigid, Rope, RopeEnd, Rotation, Scene, Settings, SheetPlace,
    Surface, Thread,
};

const RESOLUTION: Parameter = Parameter::count("n", "particles along each side of the cloth", 30, (2, 200));

pub(super) const CLOTH_ON_CUBE: NamedScene = NamedScene {
    name: "cloth-on-cube",
    description: "A cloth of 2 m falls on a cube of 1 m (paper, figure 8b).",
    parameters: &[RESOLUTION],
    document: cloth_on_cube,
};

fn cloth_on_cube(p: &Parameters) -> Scene {
    let cube = Rigid { position: [0.0, 0.5, 0.0], fixed: true, ..Rigid::default() };
    let bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rigid(cube),
        Body::Cloth(Cloth { position: [0.0, 1.5, 0.0], ..square(p.count("n")) }),
    ];
    in_small_steps(bodies)
}

pub(super) const CLOTH_ON_ROPE: NamedScene = NamedScene {
    name: "cloth-on-rope",
    description: "A cloth of 2 m falls on a rope of 3 m that hangs by both ends (paper, figure 8c).",
    parameters: &[RESOLUTION, Parameter::count("segments", "segments of the rope", 50, (2, 500))],
    document: cloth_on_rope,
};

/// Friction enough that a swaying cloth does not creep over the rope until it falls off.
const ROUGH: f32 = 0.8;

fn cloth_on_rope(p: &Parameters) -> Scene {
    let rope = Rope {
        path: Thread::Points(hanging(2.6, 3.0, 2.5, p.count("segments"))),
        radius: 0.03,
        friction: ROUGH,
        pins: vec![Pin::Place(RopeEnd::First), Pin::Place(RopeEnd::Last)],
        ..Rope::default()
    };
    let bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rope(rope),
        Body::Cloth(Cloth { position: [0.0, 2.5, 0.0], friction: ROUGH, ..square(p.count("n")) }),
    ];
    in_small_steps(bodies)
}

/// 240 steps a second: at 60, the paper's solver lets a cloth slip off a cube and through a rope. Thin things
/// need very small steps, as the paper says (section 7). The default solver makes its own, whatever the step.
fn in_small_steps(bodies: Vec<Body>) -> Scene {
    Scene { seconds: 5.0, dt: 1.0 / 240.0, record_every: 8, bodies, ..Scene::default() }
}

pub(super) const HUNG_CLOTH: NamedScene = NamedScene {
    name: "hung-cloth",
    description: "A cloth held by two corners swings down and comes to rest.",
    parameters: &[RESOLUTION],
    document: hung_cloth,
};

fn hung_cloth(p: &Parameters) -> Scene {
    let cloth = Cloth {
        position: [0.0, 2.2, 1.0],
        pins: vec![Pin::Place(SheetPlace::BackLeft), Pin::Place(SheetPlace::BackRight)],
        ..square(p.count("n"))
    };
    let bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth)];
    let settings = Settings { damping: Some(1.0), ..Settings::default() };
    Scene { seconds: 6.0, record_every: 2, settings, bodies, ..Scene::default() }
}

pub(super) const CURTAIN: NamedScene = NamedScene {
    name: "curtain-self-collision",
    description: "A curtain falls on the floor upright, and folds up on itself.",
    parameters: &[Parameter::count("n", "particles along its width", 21, (2, 101))],
    document: curtain,
};

fn curtain(p: &Parameters) -> Scene {
    let columns = p.count("n");
    // As high as wide and half as much again, in cells as good as square.
    let (width, depth, rows) = (1.0, 1.5, 3 * (columns - 1) / 2 + 1);
    let cloth = Cloth {
        surface: Surface::Grid { columns, rows, width, depth },
        position: [0.0, 0.1 + depth / 2.0, 0.0],
        // Not quite upright, or nothing would tell it which way to fold.
        rotation: Rotation::AxisAngle(AxisAngle { axis: [1.0, 0.0, 0.0], degrees: 85.0 }),
        ..Cloth::default()
    };
    let bodies = vec![Body::HalfSpace(HalfSpace::default()), Body::Cloth(cloth)];
    Scene { seconds: 4.0, record_every: 2, bodies, ..Scene::default() }
}

/// 2 m, 1 kg.
fn square(n: u32) -> Cloth {
    Cloth { surface: Surface::Grid { columns: n, rows: n, width: 2.0, depth: 2.0 }, ..Cloth::default() }
}
