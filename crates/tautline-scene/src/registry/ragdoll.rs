//! Figures of joints and limbs.

use tautline::{Quat, Vec3};

use super::rigid::camera;
use super::{NamedScene, Parameter, Parameters};
use crate::document::{
    Body, BodyRef, Color, Damping, HalfSpace, Joint, JointKind, Rigid, Rotation, Scene, Shape,
};
use crate::random::Random;
use crate::render::palette;

pub(super) const RAGDOLL: NamedScene = NamedScene {
    name: "ragdoll",
    description: "Figures whose joints bend as far as people's fall down a staircase.",
    parameters: &[Parameter::count("n", "how many figures", 6, (1, 60)), Parameter::SEED],
    document: ragdoll,
};

fn ragdoll(p: &Parameters) -> Scene {
    let mut random = Random::new(p.seed());
    let mut bodies = vec![Body::HalfSpace(HalfSpace::default())];
    bodies.extend((0..STEPS).map(step));
    let mut joints = Vec::new();
    for i in 0..p.count("n") {
        // Three abreast, and the later ones higher up.
        let across = (i % 3) as f32 - 1.0 + random.between(-0.1, 0.1);
        let place = Vec3::new(across, RISE * STEPS as f32 + 1.3 + 1.9 * (i / 3) as f32, -0.6);
        let turn = Quat::from_rotation_y(random.between(-0.6, 0.6));
        let lean = Quat::from_rotation_x(random.between(0.3, 0.7));
        let figure = Figure { place, turn: turn * lean, color: palette(i as usize), first: bodies.len() };
        figure.build(&mut bodies, &mut joints);
    }
    let camera = camera(Vec3::new(5.8, 3.6, 7.6), Vec3::new(0.0, 1.5, 1.4));
    Scene { seconds: 8.0, record_every: 2, bodies, joints, camera: Some(camera), ..Scene::default() }
}

/// How many steps the staircase has.
const STEPS: u32 = 10;
/// Of a step, in m: its height and its depth.
const RISE: f32 = 0.18;
const RUN: f32 = 0.3;
/// How far the top step goes on, in m.
const LANDING: f32 = 1.6;

/// The step of a number, from the top; it stands on the ground.
fn step(i: u32) -> Body {
    let height = RISE * (STEPS - i) as f32;
    let (depth, front) = if i == 0 { (LANDING, 0.0) } else { (RUN, RUN * i as f32) };
    Body::Rigid(Rigid {
        shape: Shape::Box { size: [4.0, height, depth] },
        position: [0.0, height / 2.0, front - depth / 2.0],
        fixed: true,
        ..Rigid::default()
    })
}

/// A figure 1.8 m tall that stands with its arms down and looks along Z.
struct Figure {
    /// The middle of the hips, in m.
    place: Vec3,
    turn: Quat,
    color: [u8; 3],
    /// Index of its first body in the scene.
    first: usize,
}

/// A part of a figure: how it is drawn and where, from the middle of the hips, in m.
struct Limb {
    shape: Shape,
    middle: Vec3,
    /// In kg.
    mass: f32,
}

/// What holds a limb to the one with the number `base`, at a point from the middle of the hips, in m.
struct Link {
    base: usize,
    anchor: Vec3,
    kind: JointKind,
}

/// How soon a limb stops turning, as no joint is without friction, in 1/s.
const STIFFNESS: f32 = 1.0;
const SKIN: Color = Color([226, 178, 148]);
/// The number of the head.
const HEAD: usize = 2;

impl Figure {
    fn build(&self, bodies: &mut Vec<Body>, joints: &mut Vec<Joint>) {
        for (k, (limb, link)) in limbs().into_iter().enumerate() {
            bodies.push(Body::Rigid(Rigid {
                shape: limb.shape,
                position: self.at(limb.middle),
                rotation: Rotation::Quaternion(self.turn.to_array()),
                velocity: (self.turn * Vec3::new(0.0, 0.0, 1.5)).with_y(0.0).to_array(),
                mass: Some(limb.mass),
                damping: Some(Damping { angular: STIFFNESS, ..Damping::default() }),
                color: Some(if k == HEAD { SKIN } else { Color(self.color) }),
                ..Rigid::default()
            }));
            let name = |limb: usize| BodyRef::Index((self.first + limb) as u32);
            joints.extend(link.map(|Link { base, anchor, kind }| Joint {
                anchor: Some(self.at(anchor)),
                ..Joint::new(name(k), Some(name(base)), self.turned(kind))
            }));
        }
    }

    fn at(&self, point: Vec3) -> [f32; 3] {
        (self.place + self.turn * point).to_array()
    }

    fn turned(&self, mut kind: JointKind) -> JointKind {
        if let JointKind::Ball { axis, .. } | JointKind::Hinge { axis, .. } = &mut kind {
            *axis = (self.turn * Vec3::from(*axis)).to_array();
        }
        kind
    }
}

/// The limbs of a figure, each after the one that holds it.
fn limbs() -> Vec<(Limb, Option<Link>)> {
    let solid = |shape: Shape, middle: Vec3, mass: f32| Limb { shape, middle, mass };
    let size = |x, y, z| Shape::Box { size: [x, y, z] };
    let pelvis = solid(size(0.3, 0.18, 0.2), Vec3::ZERO, 12.0);
    let chest = solid(size(0.36, 0.44, 0.22), Vec3::Y * 0.35, 24.0);
    let head = solid(Shape::Sphere { radius: 0.12 }, Vec3::Y * 0.76, 5.0);
    let spine = Link { base: 0, anchor: Vec3::Y * 0.11, kind: ball(Vec3::Y, 35.0, 30.0) };
    let neck = Link { base: 1, anchor: Vec3::Y * 0.62, kind: ball(Vec3::Y, 40.0, 60.0) };
    let mut limbs = vec![(pelvis, None), (chest, Some(spine)), (head, Some(neck))];
    for side in [-1.0, 1.0] {
        let number = limbs.len();
        let (shoulder, elbow) = (Vec3::new(0.25 * side, 0.52, 0.0), Vec3::new(0.25 * side, 0.22, 0.0));
        let hand = Vec3::new(0.25 * side, -0.1, 0.0);
        limbs.push((
            capsule(shoulder, elbow, 0.05, 2.2),
            Some(Link { base: 1, anchor: shoulder, kind: ball(Vec3::NEG_Y, 110.0, 60.0) }),
        ));
        limbs.push((
            capsule(elbow, hand, 0.042, 1.8),
            // It bends forwards.
            Some(Link { base: number, anchor: elbow, kind: hinge(Vec3::NEG_X, [0.0, 145.0]) }),
        ));
    }
    for side in [-1.0, 1.0] {
        let number = limbs.len();
        let (hip, knee) = (Vec3::new(0.1 * side, -0.06, 0.0), Vec3::new(0.1 * side, -0.5, 0.0));
        let ankle = Vec3::new(0.1 * side, -0.9, 0.0);
        limbs.push((
            capsule(hip, knee, 0.075, 8.0),
            Some(Link { base: 0, anchor: hip, kind: ball(Vec3::NEG_Y, 80.0, 30.0) }),
        ));
        limbs.push((
            capsule(knee, ankle, 0.055, 4.0),
            // It bends backwards.
            Some(Link { base: number, anchor: knee, kind: hinge(Vec3::X, [0.0, 140.0]) }),
        ));
        limbs.push((
            solid(size(0.09, 0.07, 0.26), ankle + Vec3::new(0.0, -0.02, 0.06), 1.0),
            Some(Link { base: number + 1, anchor: ankle, kind: hinge(Vec3::X, [-20.0, 45.0]) }),
        ));
    }
    limbs
}

/// From one point down to another, with round ends there.
fn capsule(from: Vec3, to: Vec3, radius: f32, mass: f32) -> Limb {
    let height = from.distance(to) - 2.0 * radius;
    let shape = Shape::Capsule { radius, height, segments: None, rings: None };
    Limb { shape, middle: (from + to) / 2.0, mass }
}

fn ball(axis: Vec3, cone: f32, twist: f32) -> JointKind {
    JointKind::Ball { axis: axis.to_array(), cone_degrees: Some(cone), twist_degrees: Some([-twist, twist]) }
}

fn hinge(axis: Vec3, limits: [f32; 2]) -> JointKind {
    JointKind::Hinge { axis: axis.to_array(), limits_degrees: Some(limits), motor: None }
}
