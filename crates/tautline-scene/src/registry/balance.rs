//! Rigid bodies that only stand because they lean on each other, and those that fall one after another.

use std::f32::consts::PI;

use tautline::Vec3;

use super::rigid::camera;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{AxisAngle, Body, HalfSpace, Rigid, Rotation, Scene, Shape};

pub(super) const ARCH: NamedScene = NamedScene {
    name: "arch",
    description: "Wedges stand as a half circle, held by nothing but their weight and friction.",
    parameters: &[Parameter::count("n", "how many wedges", 17, (3, 61))],
    document: arch,
};

/// Of the arch's middle line, in m.
const ARCH_RADIUS: f32 = 3.0;
/// Of a wedge along the radius, in m. A half circle stands on its own from 0.107 of its radius on (Heyman 1969).
const ARCH_THICKNESS: f32 = 0.7;
/// Of a wedge along the axis, in m.
const ARCH_DEPTH: f32 = 1.2;

fn arch(p: &Parameters) -> Scene {
    let n = p.count("n");
    let mut bodies = vec![ground()];
    bodies
        .extend((0..n).map(|i| Body::Rigid(wedge(PI * i as f32 / n as f32, PI * (i + 1) as f32 / n as f32))));
    let camera = camera(Vec3::new(3.0, 2.6, 9.5), Vec3::Y * 1.5);
    Scene { seconds: 10.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

/// The part of the arch between two angles from the X axis.
fn wedge(from: f32, to: f32) -> Rigid {
    let on_circle = |angle: f32, radius: f32| Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0) * radius;
    let middle = on_circle((from + to) / 2.0, ARCH_RADIUS);
    let mut points = Vec::new();
    for angle in [from, to] {
        for radius in [ARCH_RADIUS - ARCH_THICKNESS / 2.0, ARCH_RADIUS + ARCH_THICKNESS / 2.0] {
            for z in [-ARCH_DEPTH / 2.0, ARCH_DEPTH / 2.0] {
                points.push((on_circle(angle, radius) + Vec3::Z * z - middle).to_array());
            }
        }
    }
    Rigid { shape: Shape::Hull { points }, position: middle.to_array(), friction: ROUGH, ..Rigid::default() }
}

pub(super) const CARD_HOUSE: NamedScene = NamedScene {
    name: "card-house",
    description: "Cards lean on each other in pairs, storey on storey.",
    parameters: &[Parameter::count("n", "how many storeys, and how many pairs the lowest has", 4, (1, 8))],
    document: card_house,
};

/// Of a card, in m: its height as it stands, its thickness, its width.
const CARD: [f32; 3] = [1.0, 0.02, 0.7];
/// How far a card leans, in degrees.
const LEAN: f32 = 25.0;

/// What stands: L = length, t = thickness, α = lean. A pair touches along an edge, the apex. From there its outer
/// upper edges are t cos α aside, its feet L sin α, and L cos α + t sin α below the outer upper edges.
fn card_house(p: &Parameters) -> Scene {
    let [length, thickness, _] = CARD;
    let (sin, cos) = (libm::sinf(LEAN.to_radians()), libm::cosf(LEAN.to_radians()));
    let height = length * cos + thickness * sin;
    // A level card reaches from apex to apex, where it shares the room between the edges with its neighbour.
    let pitch = length + thickness * cos;
    let aside = (length * sin + thickness * cos) / 2.0;
    let n = p.count("n");
    let mut bodies = vec![ground()];
    for storey in 0..n {
        let pairs = n - storey;
        let y = storey as f32 * (height + thickness);
        for i in 0..pairs {
            let x = (i as f32 - (pairs - 1) as f32 / 2.0) * pitch;
            bodies.push(card(x - aside, y + height / 2.0, 90.0 - LEAN));
            bodies.push(card(x + aside, y + height / 2.0, 90.0 + LEAN));
            if i > 0 {
                bodies.push(card(x - pitch / 2.0, y + height + thickness / 2.0, 0.0));
            }
        }
    }
    let size = n as f32;
    let camera = camera(Vec3::new(0.5, 0.65, 1.5) * (size + 1.0), Vec3::Y * (0.42 * size));
    Scene { seconds: 10.0, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

/// A card whose middle is there, turned so far up from lying along X.
fn card(x: f32, y: f32, degrees: f32) -> Body {
    Body::Rigid(Rigid {
        shape: Shape::Box { size: CARD },
        position: [x, y, 0.0],
        rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 0.0, 1.0], degrees }),
        friction: ROUGH,
        ..Rigid::default()
    })
}

pub(super) const DOMINOES: NamedScene = NamedScene {
    name: "dominoes",
    description: "Dominoes stand along a spiral; the innermost is pushed, and all fall.",
    parameters: &[Parameter::count("n", "how many dominoes", 120, (2, 1000))],
    document: dominoes,
};

/// Of a domino, in m: its thickness, height and width.
const DOMINO: [f32; 3] = [0.08, 0.5, 0.25];
/// Of one domino from the next, in m.
const DOMINO_PITCH: f32 = 0.22;
/// Of the spiral at its start, and how much it widens with each turn, in m.
const SPIRAL: [f32; 2] = [1.2, 0.9];
/// Of the first domino, in rad/s. 0.86 is enough to lift its middle over its edge.
const PUSH: f32 = 2.0;

fn dominoes(p: &Parameters) -> Scene {
    let mut bodies = vec![ground()];
    let [start, widening] = SPIRAL;
    let widening = widening / (2.0 * PI);
    let mut angle = 0.0_f32;
    for i in 0..p.count("n") {
        let radius = start + widening * angle;
        let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
        let along = Vec3::new(widening * cos - radius * sin, 0.0, widening * sin + radius * cos);
        let mut domino = domino(Vec3::new(radius * cos, DOMINO[1] / 2.0, radius * sin), along.normalize());
        if i == 0 {
            push(&mut domino, along.normalize());
        }
        bodies.push(Body::Rigid(domino));
        angle += DOMINO_PITCH / along.length();
    }
    let reach = start + widening * angle;
    let camera = camera(Vec3::new(0.4, 1.6, 2.3) * reach, Vec3::ZERO);
    // The wave passes some nine a second.
    let seconds = 3.0 + p.count("n") as f32 / 8.0;
    Scene { seconds, record_every: 2, bodies, camera: Some(camera), ..Scene::default() }
}

/// Its thickness is along `along`, a unit vector in the ground.
fn domino(position: Vec3, along: Vec3) -> Rigid {
    let degrees = libm::atan2f(-along.z, along.x).to_degrees();
    Rigid {
        shape: Shape::Box { size: DOMINO },
        position: position.to_array(),
        rotation: Rotation::AxisAngle(AxisAngle { axis: [0.0, 1.0, 0.0], degrees }),
        density: Some(700.0),
        ..Rigid::default()
    }
}

/// Turns a domino about its lower edge.
fn push(domino: &mut Rigid, along: Vec3) {
    let spin = Vec3::Y.cross(along) * PUSH;
    domino.velocity = spin.cross(Vec3::Y * (DOMINO[1] / 2.0)).to_array();
    domino.angular_velocity = spin.to_array();
}

/// Of what would slide apart otherwise.
const ROUGH: f32 = 0.8;

fn ground() -> Body {
    Body::HalfSpace(HalfSpace { friction: ROUGH, ..HalfSpace::default() })
}
