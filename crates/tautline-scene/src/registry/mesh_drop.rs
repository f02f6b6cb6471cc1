//! Concave meshes in a heap.

use tautline::Vec3;

use super::sculpture::{bent_tube, rabbit, star};
use super::{NamedScene, Parameter, Parameters};
use crate::document::{AxisAngle, Body, Camera, Color, HalfSpace, Rigid, Rotation, Scene, Shape, SoftSolid};
use crate::random::Random;

pub(super) const MESH_DROP: NamedScene = NamedScene {
    name: "mesh-drop",
    description: "Rings, bent tubes and stars fall in a heap, and soft rabbits, of which coarser ones are simulated, on it.",
    parameters: &[
        Parameter::count("n", "how many meshes fall", 24, (1, 100)),
        Parameter::count("coarse", "triangles of a rabbit that are simulated", 240, (60, 2000)),
        Parameter::SEED,
    ],
    document: mesh_drop,
};

/// One mesh of so many is a rabbit.
const RABBIT_EVERY: u32 = 8;

fn mesh_drop(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let shapes = [
        Shape::Torus { radius: 0.26, tube_radius: 0.08, segments: 20, tube_segments: 10 },
        Shape::Mesh(bent_tube(0.2, 0.07, 16, 8)),
        Shape::Mesh(star(5, 0.34, 0.14)),
    ];
    let rabbit = Shape::Mesh(rabbit(4));
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    for i in 0..p.count("n") {
        let place = Vec3::Y * (0.5 + 0.3 * i as f32) + random.in_cube(0.3) * Vec3::new(1.0, 0.0, 1.0);
        let axis = Vec3::Y * 0.2 + random.in_cube(1.0);
        let turn = AxisAngle { axis: axis.to_array(), degrees: random.between(0.0, 360.0) };
        let (position, rotation) = (place.to_array(), Rotation::AxisAngle(turn));
        bodies.push(if i % RABBIT_EVERY == RABBIT_EVERY - 1 {
            Body::SoftSolid(soft_rabbit(&rabbit, position, rotation, p.count("coarse")))
        } else {
            let shape = shapes[i as usize % shapes.len()].clone();
            Body::Rigid(Rigid { shape, position, rotation, density: Some(300.0), ..Rigid::default() })
        });
    }
    let camera = Some(Camera { eye: [1.8, 1.9, 3.4], target: [0.0, 0.45, 0.0], fov: 40.0 });
    Scene { seconds: 6.0, record_every: 2, bodies, camera, ..Scene::default() }
}

fn soft_rabbit(shape: &Shape, position: [f32; 3], rotation: Rotation, coarse_triangles: u32) -> SoftSolid {
    SoftSolid {
        shape: shape.clone(),
        coarse_triangles: Some(coarse_triangles),
        position,
        rotation,
        density: Some(200.0),
        young_modulus: 4e4,
        color: Some(Color([226, 196, 168])),
        ..SoftSolid::default()
    }
}
