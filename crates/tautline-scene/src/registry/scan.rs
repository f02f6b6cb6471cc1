//! Cloth over a scanned mesh.

use super::sculpture::scanned_head;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, Camera, Cloth, Color, HalfSpace, Rigid, Scene, Shape, Surface};

pub(super) const SCAN_DRAPE: NamedScene = NamedScene {
    name: "scan-drape",
    description: "A cloth falls over a scanned head of thousands of noisy triangles.",
    parameters: &[
        Parameter::count("n", "particles along each side of the cloth", 64, (8, 150)),
        Parameter::count("detail", "how often the triangles of the head are divided", 4, (2, 5)),
    ],
    document: scan_drape,
};

/// Of the head's middle over the floor, in m.
const HEIGHT: f32 = 0.85;
/// How far a scanned vertex is off, in m.
const NOISE: f32 = 0.001;

fn scan_drape(p: &Parameters) -> Scene {
    let stone = Color([188, 180, 168]);
    let head = Rigid {
        shape: Shape::Surface(Surface::Mesh(scanned_head(p.count("detail"), NOISE))),
        position: [0.0, HEIGHT, 0.0],
        fixed: true,
        color: Some(stone),
        ..Rigid::default()
    };
    let plinth = Rigid {
        shape: Shape::Cylinder { radius: 0.3, height: 0.3, segments: None },
        position: [0.0, 0.15, 0.0],
        fixed: true,
        color: Some(stone),
        ..Rigid::default()
    };
    let side = p.count("n");
    let cloth = Cloth {
        surface: Surface::Grid { columns: side, rows: side, width: 1.8, depth: 1.8 },
        position: [0.05, HEIGHT + 0.65, 0.0],
        mass: 0.5,
        color: Some(Color([150, 62, 70])),
        ..Cloth::default()
    };
    let bodies = vec![
        Body::HalfSpace(HalfSpace::default()),
        Body::Rigid(plinth),
        Body::Rigid(head),
        Body::Cloth(cloth),
    ];
    let camera = Some(Camera { eye: [3.0, 1.7, 1.3], target: [0.0, 0.75, 0.0], fov: 36.0 });
    Scene { seconds: 3.0, record_every: 2, bodies, camera, ..Scene::default() }
}
