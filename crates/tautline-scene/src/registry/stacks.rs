//! Rigid bodies that stand on each other.

use tautline::Vec3;

use super::rigid::camera;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{Body, Color, HalfSpace, Rigid, Scene};

pub(super) const TOWER: NamedScene = NamedScene {
    name: "tower",
    description: "Cubes of 1 m stand on top of each other.",
    parameters: &[Parameter::count("n", "how many cubes", 10, (1, 100))],
    document: tower,
};

fn tower(p: &Parameters) -> Scene {
    let n = p.count("n");
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    bodies.extend((0..n).map(|i| Body::Rigid(cube(0.0, i as f32 + 0.5, 1.0))));
    let camera = camera(Vec3::new(0.7, 0.6, 1.2) * (n as f32 + 3.0), Vec3::Y * (0.5 * n as f32));
    Scene { seconds: 5.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

pub(super) const PYRAMID: NamedScene = NamedScene {
    name: "pyramid",
    description: "Cubes of 1 m are stacked to a pyramid, each on two below it.",
    parameters: &[Parameter::count("n", "how many cubes its lowest row has", 20, (1, 40))],
    document: pyramid,
};

/// Distance of the middles of neighbours in a row of the pyramid, in m.
const PITCH: f32 = 1.1;

fn pyramid(p: &Parameters) -> Scene {
    let n = p.count("n");
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    for row in 0..n {
        let count = n - row;
        for i in 0..count {
            let x = (i as f32 - (count - 1) as f32 / 2.0) * PITCH;
            bodies.push(Body::Rigid(cube(x, row as f32 + 0.5, 1.0)));
        }
    }
    Scene { seconds: 5.0, record_every: 2, bodies, ..Scene::default() }
}

pub(super) const MASS_RATIO: NamedScene = NamedScene {
    name: "mass-ratio",
    description: "Cubes of 10, 100 and 1000 kg stand on cubes of 1 kg.",
    parameters: &[],
    document: mass_ratio,
};

fn mass_ratio(_: &Parameters) -> Scene {
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    let light = Color([236, 214, 150]);
    for (x, heavy, color) in
        [(-2.0, 10.0, [150, 156, 168]), (0.0, 100.0, [98, 104, 116]), (2.0, 1000.0, [46, 50, 60])]
    {
        bodies.push(Body::Rigid(Rigid { color: Some(light), ..cube(x, 0.5, 1.0) }));
        bodies.push(Body::Rigid(Rigid { color: Some(Color(color)), ..cube(x, 1.5, heavy) }));
    }
    let camera = camera(Vec3::new(2.2, 3.0, 7.5), Vec3::Y * 0.9);
    Scene { seconds: 5.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

/// 1 m; mass in kg.
fn cube(x: f32, y: f32, mass: f32) -> Rigid {
    Rigid { position: [x, y, 0.0], mass: Some(mass), ..Rigid::default() }
}
